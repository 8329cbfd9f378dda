#include "poses/pose_source_data.h"

#include "conversion.h"
#include "pseudo_edge_cells.h"
#include "skinning/endpoint_weights.h"
#include "weights_input.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

namespace bindpose
{

namespace
{
/// Return the rows of a point array, padded with zeros to three components. The result is empty if
/// the array is missing, has fewer than `minimum_components` components, or has more than three.
Points padded_rows(vtkPolyData* surface, const char* name, int minimum_components)
{
  vtkDataArray* array = surface->GetPointData()->GetArray(name);
  if (!array || array->GetNumberOfComponents() < minimum_components ||
    array->GetNumberOfComponents() > 3)
  {
    return {};
  }
  const SharedMatrix<Weights> values = to_matrix(array);
  Points rows = Points::Zero(values.view().rows(), 3);
  rows.leftCols(values.view().cols()) = values.view();
  return rows;
}
} // namespace

Status to_pose_source(
  vtkPolyData* surface, vtkUnstructuredGrid* tets, vtkPolyData* handles, PoseSource& source)
{
  source = PoseSource();
  SurfaceInput input;
  std::vector<Index> cells;
  Status status = to_surface(surface, input);
  status = status.ok() ? to_handles(handles, source.handles, &cells) : status;
  if (!status.ok())
  {
    return status;
  }
  source.points = input.points.view();
  source.triangles = input.triangles.view();
  vtkPointData* arrays = surface->GetPointData();
  if (vtkDataArray* weights = arrays->GetArray("Weights"))
  {
    status = check_weights(weights, surface->GetNumberOfPoints(), source.handles);
    if (!status.ok())
    {
      return status;
    }
    source.weights = to_matrix(weights).view();
  }
  if (vtkDataArray* endpoints = arrays->GetArray("EndpointWeights"))
  {
    status = check_weights(endpoints, surface->GetNumberOfPoints(), source.handles);
    if (status.ok())
    {
      source.endpoints = to_matrix(endpoints).view();
      status = check_endpoint_weights(source.endpoints, source.handles, "EndpointWeights");
    }
    if (!status.ok())
    {
      return status;
    }
  }
  if (arrays->GetArray("RegionId"))
  {
    status = to_region_ids(surface, "RegionId", source.arrays.region_ids);
    if (!status.ok())
    {
      return status;
    }
  }
  if (vtkDataArray* fixed = arrays->GetArray("Fixed"))
  {
    for (vtkIdType v = 0; v < fixed->GetNumberOfTuples(); ++v)
    {
      source.arrays.fixed.push_back(fixed->GetComponent(v, 0) != 0.0);
    }
  }
  source.arrays.parameters = padded_rows(surface, "Parameterization", 2);
  source.arrays.tangents = padded_rows(surface, "Tangents", 3);
  source.arrays.load = padded_rows(surface, "Load", 3);
  source.pseudo_edges_status = to_pseudo_edges(handles, source.handles, cells, source.pseudo_edges);

  TetInput volume;
  vtkDataArray* tet_weights_array = tets ? tets->GetPointData()->GetArray("Weights") : nullptr;
  if (tet_weights_array && to_tets(tets, volume).ok() &&
    check_weights(tet_weights_array, tets->GetNumberOfPoints(), source.handles).ok())
  {
    source.tet_points = volume.points.view();
    source.tets = volume.tets.view();
    source.tet_weights = to_matrix(tet_weights_array).view();
  }
  return {};
}

} // namespace bindpose
