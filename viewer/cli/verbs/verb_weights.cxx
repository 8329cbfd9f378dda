// Implements bindpose weights MESH --handles H. The weights are solved on the input mesh if the
// mesh consists of tets or --domain is surface; otherwise on a mesh that the filter creates. The
// filter may add points to the input mesh. In this case the weights are transferred to the original
// points, unless the output is a .vtu file.
#include "cli/session.h"
#include "cli/verbs/verbs.h"
#include "cli/verbs/weights_stage.h"

#include "conversion.h"
#include "file_kind.h"
#include "report_field_data.h"
#include "vtkBoneEndpointWeights.h"
#include "vtkGLTFSkinWriter.h"
#include "vtkWeightsAlgorithm.h"
#include "weights_input.h"

#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <map>
#include <vector>

namespace bindpose::cli
{

namespace
{
bool is_tets(vtkDataSet* data)
{
  return data->GetNumberOfCells() > 0 && data->GetCellType(0) == VTK_TETRA;
}

/// Append a region handle for each label above 0 that has no handle. The name of the new handle
/// contains the label, and its pivot is the centroid of the labeled points.
bool add_region_handles(Session& session, vtkDataSet* mesh, const std::string& array_name,
  vtkSmartPointer<vtkPolyData>& data)
{
  std::vector<Index> labels;
  Status status = to_region_ids(mesh, array_name, labels);
  if (!status.ok())
  {
    return session.fail(status);
  }
  if (labels.empty())
  {
    return session.invalid("--regions: the mesh has no point array '" + array_name + "'");
  }
  std::map<Index, std::pair<Vec3, Index>> sums;
  for (vtkIdType v = 0; v < mesh->GetNumberOfPoints(); ++v)
  {
    if (labels[v] > 0)
    {
      auto& sum = sums.insert({ labels[v], { Vec3::Zero(), 0 } }).first->second;
      sum.first += Vec3(mesh->GetPoint(v));
      sum.second += 1;
    }
  }
  if (sums.empty())
  {
    return session.invalid("--regions: the point array '" + array_name + "' has no label above 0");
  }
  Handles handles;
  status = to_handles(data, handles);
  if (!status.ok())
  {
    return session.fail(status);
  }
  for (const Handle& handle : handles)
  {
    sums.erase(handle.kind == HandleKind::region ? handle.region_id : 0);
  }
  for (const auto& [label, sum] : sums)
  {
    Handle region;
    region.kind = HandleKind::region;
    region.name = "r" + std::to_string(label);
    region.region_id = label;
    region.head = region.tail = sum.first / static_cast<double>(sum.second);
    handles.push_back(region);
  }
  status = check_handles(handles);
  if (!status.ok())
  {
    return session.fail(status);
  }
  if (!sums.empty())
  {
    data = to_polydata(handles);
  }
  return true;
}

/// Write the mesh, with the array EndpointWeights if requested; glTF files include the joints.
void write_with_endpoints(
  Session& session, vtkDataSet* mesh, vtkPolyData* handles, const std::string& output)
{
  const Arguments& arguments = session.arguments();
  static const std::map<std::string, int> methods = {
    { "projection", vtkBoneEndpointWeights::PROJECTION },
    { "joints", vtkBoneEndpointWeights::JOINTS },
    { "bounded", vtkBoneEndpointWeights::BOUNDED },
  };
  const std::string extension = file_extension(output);
  if (extension == "glb" || extension == "gltf")
  {
    vtkNew<vtkGLTFSkinWriter> writer;
    writer->SetInputData(0, mesh);
    writer->SetHandlesData(handles);
    writer->SetMaximumInfluences(arguments.integer("gltf-maximum-influences"));
    writer->SetFileName(output.c_str());
    session.write_rig(writer);
    return;
  }
  const auto method = methods.find(arguments.text("endpoints"));
  if (method == methods.end())
  {
    session.write(mesh, output);
    return;
  }
  vtkNew<vtkBoneEndpointWeights> endpoints;
  endpoints->SetInputData(0, mesh);
  endpoints->SetInputData(1, handles);
  endpoints->SetMethod(method->second);
  const int domain = arguments.choice("domain",
    { { "auto", vtkWeightsAlgorithm::AUTO }, { "volume", vtkWeightsAlgorithm::VOLUME },
      { "embedding", vtkWeightsAlgorithm::EMBEDDING }, { "cage", vtkWeightsAlgorithm::AUTO },
      { "surface", vtkWeightsAlgorithm::SURFACE } });
  endpoints->SetDomain(domain);
  if (session.run(endpoints, "endpoints", 0.98, 1.0, Merge::nothing))
  {
    session.report().set("endpoints.method", method->first);
    auto result = shallow_copy(endpoints->GetOutput());
    attach_report(result, read_report(mesh));
    session.write(result, output);
  }
}

} // namespace

void run_weights(Session& session)
{
  const Arguments& arguments = session.arguments();
  const std::string output = arguments.text("output");
  const std::string domain = arguments.text("domain");
  if (!session.check_output(output, "vtp vtu dmat glb gltf"))
  {
    return;
  }
  const auto mesh = session.read(arguments.text("MESH"));
  if (!mesh)
  {
    return;
  }
  const std::string extension = file_extension(output);
  const bool input_is_tets = is_tets(mesh);
  const bool solve_on_surface = domain == "surface";
  if (input_is_tets && (solve_on_surface || extension == "vtp"))
  {
    session.invalid(arguments.text("MESH") + " contains tets; " +
      (solve_on_surface ? "--domain surface needs a surface" : "write .vtu or .dmat, not .vtp"));
    return;
  }
  if (solve_on_surface && extension == "vtu")
  {
    session.invalid("--domain surface creates no tets; write .vtp or .dmat, not .vtu");
    return;
  }
  auto handles = session.read_handles(arguments.text("handles"), mesh);
  const std::string regions = arguments.text("regions");
  if (!handles || (!regions.empty() && !add_region_handles(session, mesh, regions, handles)))
  {
    return;
  }
  const auto weights = make_weights(session, mesh);
  if (!weights)
  {
    return;
  }
  weights->SetInputData(0, mesh);
  weights->SetInputData(1, handles);
  if (!regions.empty())
  {
    weights->SetRegionArrayName(regions.c_str());
  }
  const bool solved_on_input = input_is_tets || solve_on_surface;
  if (!session.run(weights, "weights", 0.0, 0.98, Merge::all))
  {
    return;
  }
  if (input_is_tets)
  {
    session.report().set("domain", "volume");
  }
  const bool writes_tets = extension == "vtu";
  if (writes_tets || !solved_on_input)
  {
    // output port of the solved mesh (2) or of the input mesh (0)
    const int port = writes_tets && !solved_on_input ? 2 : 0;
    auto* data = vtkDataSet::SafeDownCast(weights->GetOutputDataObject(port));
    if (data->GetNumberOfPoints() == 0)
    {
      session.invalid("a planar shape has no tets; write .vtp or .dmat, not .vtu");
      return;
    }
    write_with_endpoints(session, data, handles, output);
    return;
  }
  if (const auto result = transfer_to_points(session, mesh, weights->GetOutput()))
  {
    write_with_endpoints(session, result, handles, output);
  }
}

} // namespace bindpose::cli
