// Checks and converts weights and their handles, for all filters that use weights.
#include "weights_input.h"

#include "base/number_text.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

namespace bindpose
{

Status check_weights(vtkDataArray* weights, vtkIdType points, const Handles& handles)
{
  const std::string array = std::string("the array '") + weights->GetName() + "'";
  if (weights->GetNumberOfTuples() != points)
  {
    return Status::invalid_input(array + " has " + std::to_string(weights->GetNumberOfTuples()) +
      " tuples, but the mesh has " + std::to_string(points) +
      " points; use the mesh for which the weights were computed");
  }
  const int columns = weights->GetNumberOfComponents();
  if (columns != static_cast<int>(handles.size()))
  {
    return Status::invalid_input(array + " has " + std::to_string(columns) +
      " components, but there are " + std::to_string(handles.size()) + " handles");
  }
  for (int j = 0; j < columns; ++j)
  {
    const char* name = weights->HasAComponentName() ? weights->GetComponentName(j) : nullptr;
    if (name && *name && handles[static_cast<std::size_t>(j)].name != name)
    {
      return Status::invalid_input(array + " has the handle name '" + name + "' at component " +
        std::to_string(j) + ", but the handle with this index is named '" +
        handles[static_cast<std::size_t>(j)].name +
        "'; use the handles for which the weights were computed");
    }
  }
  return {};
}

Status missing_weights_error(vtkPointSet* mesh, const std::string& array_name)
{
  std::string names;
  for (int i = 0; i < mesh->GetPointData()->GetNumberOfArrays(); ++i)
  {
    const char* name = mesh->GetPointData()->GetArrayName(i);
    names += std::string(i ? ", " : "") + (name ? name : "(unnamed)");
  }
  return Status::invalid_input("the mesh has no point array '" + array_name +
    "' with weights (its point arrays: " + (names.empty() ? "none" : names) + ")");
}

Status to_weights_input(
  vtkPointSet* mesh, const std::string& array_name, vtkPolyData* handles, WeightsInput& input)
{
  if (!mesh || mesh->GetNumberOfPoints() == 0)
  {
    return Status::invalid_input("the mesh with weights is empty");
  }
  vtkDataArray* weights = mesh->GetPointData()->GetArray(array_name.c_str());
  if (!weights)
  {
    return missing_weights_error(mesh, array_name);
  }
  if (!handles)
  {
    return Status::invalid_input("the input has no handles");
  }
  Status status = to_handles(handles, input.handles, &input.cells);
  if (status.ok())
  {
    status = check_weights(weights, mesh->GetNumberOfPoints(), input.handles);
  }
  input.weights = to_matrix(weights);
  return status;
}

Status to_region_ids(vtkDataSet* mesh, const std::string& name, std::vector<Index>& region_ids)
{
  region_ids.clear();
  vtkAbstractArray* found = mesh->GetPointData()->GetAbstractArray(name.c_str());
  auto* array = vtkDataArray::SafeDownCast(found);
  if (!found)
  {
    return {};
  }
  if (!array || array->GetNumberOfComponents() != 1)
  {
    return Status::invalid_input(
      "the point array '" + name + "' of region labels must have one component");
  }
  if (array->GetNumberOfTuples() != mesh->GetNumberOfPoints())
  {
    return Status::invalid_input("the point array '" + name + "' of region labels has " +
      std::to_string(array->GetNumberOfTuples()) + " values, but the mesh has " +
      std::to_string(mesh->GetNumberOfPoints()) + " points");
  }
  region_ids.resize(static_cast<std::size_t>(array->GetNumberOfTuples()));
  for (vtkIdType v = 0; v < array->GetNumberOfTuples(); ++v)
  {
    const double label = array->GetComponent(v, 0);
    if (!to_integer(label, region_ids[v]))
    {
      return Status::invalid_input("the region label of point " + std::to_string(v) +
        " in the array '" + name + "' must be an integer, not " + short_number(label));
    }
  }
  return {};
}

} // namespace bindpose
