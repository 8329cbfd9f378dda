// Implements bindpose transfer SOURCE TARGET -o OUT: the weights of one mesh on another. A glTF
// output is the target with the joints of the source; the rest of the target's file is kept.
#include "cli/session.h"
#include "cli/set_options.h"
#include "cli/verbs/verbs.h"

#include "conversion.h"
#include "file_kind.h"
#include "vtkAssetReader.h"
#include "vtkGLTFSkinWriter.h"
#include "vtkTransferWeights.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

namespace bindpose::cli
{

namespace
{
bool is_gltf(const std::string& path)
{
  return is_listed(file_extension(path), "glb gltf");
}

/// Read the handles of a glTF output. Return null on failure.
vtkSmartPointer<vtkPolyData> read_output_handles(Session& session)
{
  const std::string source = session.arguments().text("SOURCE");
  const std::string file = session.arguments().text("handles");
  if (file.empty() && !is_gltf(source))
  {
    session.invalid("--handles is required for a .glb or .gltf output, because " + source +
      " contains no joints");
    return nullptr;
  }
  return session.read_handles(file.empty() ? source : file, nullptr);
}

/// Report whether the output is a copy of the target's file.
bool is_asset(const Session& session)
{
  return is_gltf(session.arguments().text("output")) &&
    is_listed(
      file_extension(session.arguments().text("TARGET")), vtkAssetReader::GetFileExtensions());
}

/// Read a surface or tets. Return null on failure.
vtkSmartPointer<vtkDataSet> read_point_set(Session& session, const std::string& path)
{
  const auto data = session.read(path);
  if (data && !data->IsA("vtkPointSet"))
  {
    session.invalid(path + " must contain a surface or tets");
    return nullptr;
  }
  return data;
}

/// Read the target. Read all meshes of an asset, because the output is a copy of the whole file.
vtkSmartPointer<vtkDataSet> read_target(Session& session)
{
  const std::string path = session.arguments().text("TARGET");
  if (!is_asset(session))
  {
    return read_point_set(session, path);
  }
  vtkSmartPointer<vtkPolyData> surface, old_handles;
  return session.read_asset(path, surface, old_handles) ? surface : nullptr;
}

/// Check, before the work, that the output can store the target, and that the handles are those of
/// the weights.
bool check_types(Session& session, vtkDataSet* source, vtkDataSet* mesh, vtkPolyData* handles)
{
  const std::string extension = file_extension(session.arguments().text("output"));
  const bool is_polydata = mesh->IsA("vtkPolyData") != 0;
  if ((extension == "vtp" && !is_polydata) || (extension == "vtu" && is_polydata))
  {
    return session.invalid(session.arguments().text("TARGET") + " is " +
      (is_polydata ? "a polygon dataset; the output must be .vtp"
                   : "not a polygon dataset; the output must be .vtu") +
      ", .vtk or .dmat");
  }
  vtkDataArray* weights = source->GetPointData()->GetArray("Weights");
  Handles list;
  if (!handles || !weights)
  {
    return true;
  }
  const Status status = to_handles(handles, list);
  if (!status.ok())
  {
    return session.fail(status);
  }
  if (static_cast<Index>(list.size()) != weights->GetNumberOfComponents())
  {
    const std::string file = session.arguments().text("handles");
    return session.invalid((file.empty() ? session.arguments().text("SOURCE") : file) + " has " +
      std::to_string(list.size()) + " handles, but the weights are those of " +
      std::to_string(weights->GetNumberOfComponents()));
  }
  return true;
}

void write_rig(Session& session, vtkDataSet* mesh, vtkPolyData* handles, const std::string& asset)
{
  vtkNew<vtkGLTFSkinWriter> writer;
  writer->SetInputData(0, mesh);
  writer->SetHandlesData(handles);
  writer->SetAssetFileName(asset.c_str());
  writer->SetFileName(session.arguments().text("output").c_str());
  session.write_rig(writer);
}
} // namespace

void run_transfer(Session& session)
{
  const Arguments& arguments = session.arguments();
  const std::string output = arguments.text("output");
  const std::string target = arguments.text("TARGET");
  if (!session.check_output(output, "vtp vtu vtk dmat glb gltf"))
  {
    return;
  }
  if (!is_gltf(output) && arguments.has("handles"))
  {
    session.invalid("--handles is only used for a .glb or .gltf output");
    return;
  }
  vtkSmartPointer<vtkPolyData> handles;
  if (is_gltf(output) && !(handles = read_output_handles(session)))
  {
    return;
  }
  const auto source = read_point_set(session, arguments.text("SOURCE"));
  const auto mesh = source ? read_target(session) : nullptr;
  if (!mesh || !check_types(session, source, mesh, handles))
  {
    return;
  }
  vtkNew<vtkTransferWeights> transfer;
  transfer->SetInputData(0, mesh);
  transfer->SetInputData(1, source);
  set_transfer_weights_options(arguments, transfer.Get());
  if (!session.run(transfer, "transfer", 0.0, 1.0, Merge::all))
  {
    return;
  }
  if (is_gltf(output))
  {
    write_rig(session, transfer->GetOutput(), handles, is_asset(session) ? target : std::string());
    return;
  }
  session.write(transfer->GetOutput(), output);
}

} // namespace bindpose::cli
