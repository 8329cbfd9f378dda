// Implements bindpose info FILE, which describes the content of a file, as a table for people and
// as a report for programs.
#include "cli/interrupt.h"
#include "cli/session.h"
#include "cli/verbs/verbs.h"

#include "base/number_text.h"
#include "conversion.h"
#include "file_kind.h"
#include "surface/surface_repair.h"
#include "vtkGLTFSkinReader.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSurfaceDefects.h"
#include "vtkUnstructuredGrid.h"

#include <cstdio>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace bindpose::cli
{

namespace
{
/// Rows of the table, in the order in which they are added. The report gets the same entries.
class Table
{
public:
  void add(const std::string& name, const std::string& value)
  {
    this->text_ << "  " << std::left << std::setw(20) << name << value << "\n";
  }
  void add(const std::string& name, Index value) { this->add(name, std::to_string(value)); }
  void add(const std::string& name, double value) { this->add(name, number(value)); }
  std::string text() const { return this->text_.str(); }

  static std::string number(double value)
  {
    char digits[40];
    std::snprintf(digits, sizeof(digits), "%.6g", value);
    return digits;
  }

private:
  std::ostringstream text_;
};

struct InfoOutput
{
  Table table;
  Report report;

  void count(const std::string& words, const std::string& key, Index value)
  {
    this->table.add(words, value);
    this->report.set("counts." + key, value);
  }
  void measure(const std::string& key, double value)
  {
    this->table.add(key, value);
    this->report.set(key, value);
  }
};

Status describe_surface(vtkDataSet* data, InfoOutput& facts)
{
  SurfaceInput surface;
  Status status = to_surface(data, surface);
  if (!status.ok())
  {
    return status;
  }
  const PointsView points = surface.points.view();
  const TrianglesView triangles = surface.triangles.view();
  ExecutionContext context({}, interrupted);
  RepairOptions options;
  options.orient = false;
  options.count_self_intersections = false;
  RepairedSurface repaired;
  status = repair_surface(context, points, triangles, options, repaired);
  if (!status.ok())
  {
    return status;
  }
  const SurfaceDiagnosis& diagnosis = repaired.found;
  // Limit the time, because a triangle soup can have quadratically many crossings.
  const double time_limit = 1.5 + 1e-5 * static_cast<double>(triangles.rows());
  ExecutionContext limited(
    {}, [&context, time_limit] { return interrupted() || context.elapsed_seconds() > time_limit; });
  const bool counted = find_self_intersections(limited, repaired).ok();
  if (!counted && interrupted())
  {
    return Status::canceled();
  }
  facts.count("triangles", "triangles", diagnosis.triangles);
  if (surface.triangulated_cells > 0)
  {
    facts.count("  from polygons", "triangulated_cells", surface.triangulated_cells);
  }
  if (surface.ignored_cells > 0)
  {
    facts.count("other cells", "ignored_cells", surface.ignored_cells);
  }
  facts.table.add("components", diagnosis.components);
  facts.table.add("boundary edges", diagnosis.boundary_edges);
  facts.table.add("non-manifold edges", diagnosis.nonmanifold_edges);
  facts.table.add("misoriented edges", diagnosis.misoriented_edges);
  facts.table.add("inward components", diagnosis.inward_components);
  facts.table.add("self-intersections",
    counted ? std::to_string(diagnosis.self_intersections) + " pairs, " +
        std::to_string(diagnosis.crossing_triangles) + " intersecting triangles"
            : "counting stopped at its time limit of " + short_number(time_limit, 3) + " s");
  facts.table.add("duplicates",
    std::to_string(diagnosis.duplicate_vertices) + " vertices, " +
      std::to_string(diagnosis.duplicate_triangles) + " triangles");
  facts.table.add("degenerate", diagnosis.degenerate_triangles);
  facts.table.add("unused points", diagnosis.unreferenced_vertices);
  facts.table.add("closed", diagnosis.closed ? "yes" : "no");
  add_to_report(diagnosis, facts.report);
  if (!counted)
  {
    facts.report.erase("counts.self_intersections");
    facts.report.erase("counts.crossing_triangles");
  }
  facts.report.set("closed", diagnosis.closed ? "yes" : "no");
  facts.measure("area", surface_area(points, triangles));
  if (diagnosis.closed)
  {
    facts.measure("volume", signed_volume(points, triangles));
  }
  return {};
}

Status describe_tets(vtkDataSet* data, InfoOutput& facts)
{
  TetInput tets;
  Status status = to_tets(data, tets);
  if (!status.ok())
  {
    return status;
  }
  const Eigen::VectorXd volumes = tet_volumes(tets.points.view(), tets.tets.view());
  facts.count("tets", "tets", tets.tets.view().rows());
  facts.count("inverted tets", "inverted_tets", (volumes.array() <= 0.0).count());
  facts.count("components", "components",
    connected_components(tets.points.view().rows(), tets.tets.view()).count);
  facts.count(
    "boundary triangles", "boundary_triangles", boundary_triangles(tets.tets.view()).rows());
  facts.measure("volume", volumes.sum());
  return {};
}

void describe_bounds(vtkDataSet* data, InfoOutput& facts)
{
  const Box box = bounding_box(to_points(data).view());
  const char* axes[3] = { "x", "y", "z" };
  std::vector<double> bounds;
  for (int k = 0; k < 3; ++k)
  {
    facts.table.add(k == 0 ? "bounds" : "",
      std::string(axes[k]) + "  " + Table::number(box.lower[k]) + "  " +
        Table::number(box.upper[k]));
    bounds.push_back(box.lower[k]);
    bounds.push_back(box.upper[k]);
  }
  facts.report.set("bounds[]", bounds);
  facts.measure("diagonal", box.diagonal());
}

void describe_arrays(vtkDataSet* data, InfoOutput& facts)
{
  std::vector<std::string> names;
  std::vector<std::string> associations;
  std::vector<std::string> types;
  std::vector<std::int64_t> components;
  const std::pair<const char*, vtkFieldData*> attributes[] = { { "point", data->GetPointData() },
    { "cell", data->GetCellData() } };
  for (const auto& [association, fields] : attributes)
  {
    for (int i = 0; i < fields->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* array = fields->GetAbstractArray(i);
      const int count = array->GetNumberOfComponents();
      names.emplace_back(array->GetName() ? array->GetName() : "");
      associations.emplace_back(association);
      types.emplace_back(array->GetDataTypeAsString());
      components.push_back(count);
      std::string text = std::string(association) + "  " + names.back() + "  " +
        (count > 1 ? std::to_string(count) + " x " : "") + types.back();
      auto* numbers = vtkDataArray::SafeDownCast(array);
      if (numbers && count == 1 && numbers->GetNumberOfTuples() > 0)
      {
        double range[2];
        numbers->GetRange(range);
        text += "  " + Table::number(range[0]) + " to " + Table::number(range[1]);
      }
      for (int c = 0; c < count && count > 1 && array->GetComponentName(c); ++c)
      {
        text += std::string(c ? ", " : "  ") + array->GetComponentName(c);
      }
      facts.table.add(names.size() == 1 ? "arrays" : "", text);
    }
  }
  if (!names.empty())
  {
    facts.report.set("arrays[].name", names);
    facts.report.set("arrays[].place", associations);
    facts.report.set("arrays[].type", types);
    facts.report.set("arrays[].components", components);
  }
}

void describe_handles(const Handles& handles, InfoOutput& facts)
{
  facts.count("handles", "handles", static_cast<Index>(handles.size()));
  std::vector<std::string> names;
  std::vector<std::string> kinds;
  for (const Handle& handle : handles)
  {
    names.push_back(handle.name);
    kinds.emplace_back(to_string(handle.kind));
    std::string text = kinds.back() + "  " + handle.name;
    if (handle.parent >= 0)
    {
      text += "  parent " + handles[handle.parent].name;
    }
    facts.table.add("", text);
  }
  facts.report.set("handles[].name", names);
  facts.report.set("handles[].kind", kinds);
}

void describe_image(vtkImageData* image, InfoOutput& facts)
{
  int dimensions[3];
  image->GetDimensions(dimensions);
  facts.table.add("samples",
    std::to_string(dimensions[0]) + " x " + std::to_string(dimensions[1]) + " x " +
      std::to_string(dimensions[2]));
  facts.report.set(
    "dimensions[]", std::vector<std::int64_t>{ dimensions[0], dimensions[1], dimensions[2] });
  const double* spacing = image->GetSpacing();
  facts.table.add("spacing",
    Table::number(spacing[0]) + "  " + Table::number(spacing[1]) + "  " +
      Table::number(spacing[2]));
  facts.report.set("spacing[]", std::vector<double>{ spacing[0], spacing[1], spacing[2] });
}

/// Report whether the data can be handles: a polydata with cells but without polygons.
bool looks_like_handles(vtkDataSet* data)
{
  auto* cells = vtkPolyData::SafeDownCast(data);
  return cells && cells->GetNumberOfCells() > 0 && cells->GetNumberOfPolys() == 0 &&
    cells->GetNumberOfStrips() == 0;
}

/// Report the rig of a glTF file: its joints as handles, the number of weight sets, and the
/// animation.
bool describe_rig(Session& session, const std::string& path, InfoOutput& facts)
{
  vtkNew<vtkGLTFSkinReader> reader;
  reader->SetFileName(path.c_str());
  if (!session.run(reader, "read", 0.0, 0.0, Merge::numbers))
  {
    return false;
  }
  Handles handles;
  auto* data = vtkPolyData::SafeDownCast(reader->GetOutput(1));
  if (data->GetNumberOfCells() > 0 && to_handles(data, handles).ok())
  {
    facts.table.add(
      "weights per vertex", "up to " + Table::number(4.0 * session.report().number("sets", 0.0)));
    describe_handles(handles, facts);
  }
  if (reader->GetNumberOfFrames() > 0)
  {
    facts.table.add("animation",
      std::to_string(reader->GetNumberOfFrames()) + " frames, " +
        Table::number(reader->GetFramesPerSecond()) + " per second");
  }
  return true;
}

Status describe(vtkDataSet* data, InfoOutput& facts)
{
  facts.count("points", "vertices", data->GetNumberOfPoints());
  Status status;
  Handles handles;
  TetInput tets;
  if (auto* image = vtkImageData::SafeDownCast(data))
  {
    describe_image(image, facts);
  }
  else if (looks_like_handles(data))
  {
    status = to_handles(vtkPolyData::SafeDownCast(data), handles);
    if (status.ok())
    {
      describe_handles(handles, facts);
    }
  }
  else if (to_tets(data, tets).ok())
  {
    status = describe_tets(data, facts);
  }
  else if (vtkPointSet::SafeDownCast(data))
  {
    status = describe_surface(data, facts);
  }
  if (status.ok())
  {
    describe_bounds(data, facts);
    describe_arrays(data, facts);
  }
  return status;
}
} // namespace

void run_info(Session& session)
{
  const std::string path = session.arguments().text("FILE");
  const std::string format = file_extension(path);
  const std::string defects_path = session.arguments().text("defects");
  if (!defects_path.empty() && !session.check_output(defects_path, "vtp"))
  {
    return;
  }
  const auto data = session.read_any(path);
  if (!data)
  {
    return;
  }
  InfoOutput facts;
  Status status = describe(data, facts);
  if (!status.ok())
  {
    status.message = path + ": " + status.message;
    session.fail(status);
    return;
  }
  if (is_listed(format, vtkGLTFSkinReader::GetFileExtensions()) &&
    !describe_rig(session, path, facts))
  {
    return;
  }
  if (!defects_path.empty())
  {
    vtkNew<vtkSurfaceDefects> defects;
    defects->SetInputData(0, data);
    if (!session.run(defects, "defects", 0.0, 1.0, Merge::nothing))
    {
      return;
    }
    if (defects->GetOutput()->GetNumberOfCells() == 0)
    {
      session.warn("the surface has no defects, so " + defects_path + " was not written");
    }
    else if (!session.write(defects->GetOutput(), defects_path))
    {
      return;
    }
  }
  const std::string kind = data->GetClassName();
  session.report().set("format", format);
  session.report().set("dataset", kind);
  session.report().merge(facts.report);
  if (session.arguments().text("report") != "-")
  {
    std::cout << path << "  (" << format << ", " << kind << ")\n" << facts.table.text();
  }
}

} // namespace bindpose::cli
