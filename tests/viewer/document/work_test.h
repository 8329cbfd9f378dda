#ifndef bindpose_tests_viewer_document_work_test_h
#define bindpose_tests_viewer_document_work_test_h

// A small bound shape for tests of the document, and fingerprints that cover every byte of the
// user's work.

#include "document/document.h"

#include "conversion.h"
#include "weights_arrays.h"

#include "support/meshes.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkStringArray.h"

#include <QCryptographicHash>

#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <sstream>

namespace bindpose::test
{

inline vtkSmartPointer<vtkPolyData> ball()
{
  const TriangleMesh mesh = sphere(1);
  return to_polydata(mesh.points, mesh.triangles);
}

/// Return a bone and two points. The bone is the parent of the first point.
inline Handles three_handles()
{
  Handles handles(3);
  handles[0].name = "bottom";
  handles[0].head = handles[0].tail = Vec3(0, 0, -0.9);
  handles[1].name = "top";
  handles[1].head = handles[1].tail = Vec3(0, 0.1, 0.9);
  handles[2].name = "spine";
  handles[2].kind = HandleKind::bone;
  handles[2].head = Vec3(0, 0, -0.3);
  handles[2].tail = Vec3(0.1, 0, 0.3);
  handles[0].parent = 2;
  return handles;
}

/// Return arbitrary weights. Each row sums to one.
inline Weights some_weights(Index points, Index columns, double phase)
{
  Weights weights(points, columns);
  for (Index v = 0; v < points; ++v)
  {
    for (Index c = 0; c < columns; ++c)
    {
      weights(v, c) = 1.0 + std::sin(0.7 * v + 1.3 * c + phase);
    }
    weights.row(v) /= weights.row(v).sum();
  }
  return weights;
}

inline vtkSmartPointer<vtkPolyData> with_weights(
  vtkPolyData* surface, const Handles& handles, double phase)
{
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->ShallowCopy(surface);
  result->GetPointData()->AddArray(to_weights_array("Weights",
    some_weights(surface->GetNumberOfPoints(), static_cast<Index>(handles.size()), phase),
    handles));
  return result;
}

inline void bind(Document& document, double phase)
{
  document.begin_bind();
  document.set_bound(
    with_weights(document.work().surface, document.bound_handles(), phase), nullptr);
}

/// Open a document with three handles and bind it.
inline void open_bound_document(Document& document)
{
  document.set_mesh(ball(), "ball");
  document.set_handles(to_polydata(three_handles()), "handles");
  bind(document, 0.0);
}

inline void print_bits(std::ostream& out, double value)
{
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  out << std::hex << bits << ' ';
}

inline void print_data(std::ostream& out, vtkPolyData* data, bool pose_arrays = true)
{
  if (!data)
  {
    out << "none\n";
    return;
  }
  for (vtkIdType v = 0; v < data->GetNumberOfPoints(); ++v)
  {
    for (int k = 0; k < 3; ++k)
    {
      print_bits(out, data->GetPoint(v)[k]);
    }
  }
  for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c)
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    data->GetCellPoints(c, size, ids);
    out << '\n' << data->GetCellType(c);
    for (vtkIdType k = 0; k < size; ++k)
    {
      out << ' ' << ids[k];
    }
  }
  const std::set<std::string> pose_array_names{ "Mode", "Transform", "Stretch", "Twist" };
  for (vtkDataSetAttributes* attributes :
    { static_cast<vtkDataSetAttributes*>(data->GetPointData()),
      static_cast<vtkDataSetAttributes*>(data->GetCellData()) })
  {
    // A map, because the order of the arrays does not matter.
    std::map<std::string, std::string> arrays;
    for (int a = 0; a < attributes->GetNumberOfArrays(); ++a)
    {
      vtkAbstractArray* array = attributes->GetAbstractArray(a);
      if (!pose_arrays && pose_array_names.count(array->GetName()))
      {
        continue;
      }
      std::ostringstream text;
      text << array->GetDataTypeAsString() << ' ';
      for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
      {
        if (auto* numbers = vtkDataArray::SafeDownCast(array))
        {
          print_bits(text, numbers->GetVariantValue(i).ToDouble());
        }
        else
        {
          text << array->GetVariantValue(i).ToString() << ' ';
        }
      }
      for (int c = 0; c < array->GetNumberOfComponents(); ++c)
      {
        text << (array->GetComponentName(c) ? array->GetComponentName(c) : "") << ' ';
      }
      arrays[array->GetName()] = text.str();
    }
    for (const auto& [name, values] : arrays)
    {
      out << '\n' << name << ' ' << values;
    }
  }
  out << '\n';
}

/// Print a pose. Minus zero is printed as zero, because same_pose() treats them as equal.
inline void print_pose(std::ostream& out, const Pose& pose)
{
  for (const HandlePose& handle : pose)
  {
    out << static_cast<int>(handle.mode) << ' ';
    for (int k = 0; k < 12; ++k)
    {
      print_bits(out, handle.transform.data()[k] + 0.0);
    }
    print_bits(out, handle.stretch);
    print_bits(out, handle.twist[0] + 0.0);
    print_bits(out, handle.twist[1] + 0.0);
    out << '\n';
  }
}

inline std::string digest(const std::string& text)
{
  return QCryptographicHash::hash(QByteArray::fromStdString(text), QCryptographicHash::Sha256)
    .toHex()
    .toStdString();
}

/// Return a map from the name of each part of the work to the SHA-256 digest of its content.
inline std::map<std::string, std::string> fingerprints(const Work& work)
{
  std::map<std::string, std::string> parts;
  const auto add = [&parts](const std::string& name, const auto& print)
  {
    std::ostringstream out;
    print(out);
    parts[name] = digest(out.str());
  };
  add("name", [&](std::ostream& out) { out << work.name.toStdString(); });
  add("surface", [&](std::ostream& out) { print_data(out, work.surface); });
  add("handles", [&](std::ostream& out) { print_data(out, work.handles, false); });
  add("bound handles", [&](std::ostream& out) { print_data(out, work.bound_handles, false); });
  add("pose", [&](std::ostream& out) { print_pose(out, work.pose); });
  // The key poses are sorted by name, because the order of storage does not matter.
  add("key poses",
    [&](std::ostream& out) {
      out << nlohmann::json(to_json(work.stored_poses ? *work.stored_poses : StoredPoses())).dump();
    });
  for (auto option = work.options.begin(); option != work.options.end(); ++option)
  {
    const bool list = option.value().type() == QVariant::List;
    const QString value =
      list ? option.value().toStringList().join(' ') : option.value().toString();
    parts["option " + option.key().toStdString()] = value.toStdString();
  }
  add("sources",
    [&](std::ostream& out)
    {
      for (const Source* source : { &work.mesh_source, &work.handle_source, &work.picture_source,
             &work.volume_source, &work.curve_source })
      {
        out << source->path.toStdString() << ' ' << source->checksum.toStdString() << '\n';
      }
    });
  return parts;
}

inline std::string fingerprint(const Work& work)
{
  std::string text;
  for (const auto& [name, part] : fingerprints(work))
  {
    text += name + ' ' + part + '\n';
  }
  return digest(text);
}

/// Return the fingerprint of a document: the work as it is stored, and the data that the handle
/// widget uses.
inline std::string fingerprint(const Document& document)
{
  std::ostringstream out;
  out << fingerprint(document.work());
  print_data(out, document.handle_data());
  print_data(out, document.surface());
  out << document.is_bound() << document.rebind_reason().toStdString();
  return digest(out.str());
}

} // namespace bindpose::test

#endif
