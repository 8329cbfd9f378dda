// Implements bindpose rig ASSET -o OUT.glb. The points of all meshes of a glTF file get weights,
// and a copy of the file is written with the new skin. With --handles ASSET the joints are kept.
#include "cli/session.h"
#include "cli/verbs/verbs.h"
#include "cli/verbs/weights_stage.h"

#include "vtkGLTFSkinWriter.h"
#include "vtkWeightsAlgorithm.h"

#include "vtkDataSet.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <filesystem>

namespace bindpose::cli
{

namespace
{
/// Return the asset's points with weights, or null on failure.
vtkSmartPointer<vtkDataSet> compute_weights(
  Session& session, vtkPolyData* mesh, vtkPolyData* handles)
{
  const auto weights = make_weights(session, mesh);
  if (!weights)
  {
    return nullptr;
  }
  weights->SetInputData(0, mesh);
  weights->SetInputData(1, handles);
  if (!session.run(weights, "weights", 0.0, 0.98, Merge::all))
  {
    return nullptr;
  }
  auto* weighted = vtkDataSet::SafeDownCast(weights->GetOutputDataObject(0));
  return session.arguments().text("domain") == "surface"
    ? transfer_to_points(session, mesh, weighted)
    : vtkSmartPointer<vtkDataSet>(weighted);
}
} // namespace

void run_rig(Session& session)
{
  const Arguments& arguments = session.arguments();
  const std::string output = arguments.text("output");
  if (!session.check_output(output, vtkGLTFSkinWriter::GetFileExtensions()))
  {
    return;
  }
  const std::string asset = arguments.text("ASSET");
  vtkSmartPointer<vtkPolyData> mesh, handles;
  if (!session.read_asset(asset, mesh, handles))
  {
    return;
  }
  const std::string handle_file = arguments.text("handles");
  std::error_code not_a_file; // such as the word skeleton
  if (!std::filesystem::equivalent(handle_file, asset, not_a_file))
  {
    handles = session.read_handles(handle_file, mesh);
  }
  else if (handles->GetNumberOfCells() == 0)
  {
    session.invalid(asset + " has no joints; use --handles skeleton");
    return;
  }
  const auto weighted = handles ? compute_weights(session, mesh, handles) : nullptr;
  if (!weighted)
  {
    return;
  }
  vtkNew<vtkGLTFSkinWriter> writer;
  writer->SetInputData(0, weighted);
  writer->SetHandlesData(handles);
  writer->SetAssetFileName(asset.c_str());
  writer->SetMaximumInfluences(arguments.integer("influences"));
  writer->SetPoseFileName(arguments.text("pose").c_str());
  writer->SetFileName(output.c_str());
  session.write_rig(writer);
}

} // namespace bindpose::cli
