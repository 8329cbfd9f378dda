#include "term_arrays.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <cmath>
#include <limits>

namespace bindpose
{

namespace
{
vtkDataArray* find(vtkDataSet* mesh, const std::string& name)
{
  return name.empty() ? nullptr : mesh->GetPointData()->GetArray(name.c_str());
}

Status check_components(vtkDataArray* array, const std::string& name, Index component_count)
{
  if (array && array->GetNumberOfComponents() != component_count)
  {
    return Status::invalid_input("the point array '" + name + "' must have " +
      (component_count == 1 ? std::string("one component")
                            : std::to_string(component_count) + " components (one per handle)") +
      ", not " + std::to_string(array->GetNumberOfComponents()));
  }
  return {};
}

Status to_whole_numbers(vtkDataArray* array, const std::string& name, std::vector<Index>& numbers)
{
  const Status status = check_components(array, name, 1);
  if (!array || !status.ok())
  {
    return status;
  }
  for (vtkIdType v = 0; v < array->GetNumberOfTuples(); ++v)
  {
    const double number = array->GetComponent(v, 0);
    if (!(std::abs(number) < 1e15) || number != std::floor(number))
    {
      return Status::invalid_input("the point array '" + name +
        "' has a value that is not an integer at point " + std::to_string(v));
    }
    numbers.push_back(static_cast<Index>(number));
  }
  return {};
}

Status to_matrix(
  vtkDataArray* array, const std::string& name, Index columns, Eigen::MatrixXd& values)
{
  const Status status = check_components(array, name, columns);
  if (!array || !status.ok())
  {
    return status;
  }
  values.resize(array->GetNumberOfTuples(), columns);
  for (vtkIdType v = 0; v < array->GetNumberOfTuples(); ++v)
  {
    for (int j = 0; j < array->GetNumberOfComponents(); ++j)
    {
      values(v, j) = array->GetComponent(v, j);
    }
  }
  return {};
}
} // namespace

std::vector<std::string> TermArrayNames::all() const
{
  return { this->rigidity, this->rigid_sets, this->lower, this->upper, this->pinned, this->mirror };
}

Status to_terms(
  vtkDataSet* mesh, const TermArrayNames& names, Index handle_count, WeightTerms& terms)
{
  Eigen::MatrixXd rigidity;
  Status status = to_matrix(find(mesh, names.rigidity), names.rigidity, 1, rigidity);
  if (rigidity.size() > 0)
  {
    terms.rigidity = rigidity.col(0);
  }
  const std::pair<const std::string*, Eigen::MatrixXd*> matrices[] = {
    { &names.lower, &terms.lower }, { &names.upper, &terms.upper }, { &names.pinned, &terms.pinned }
  };
  for (const auto& [name, values] : matrices)
  {
    status = status.ok() ? to_matrix(find(mesh, *name), *name, handle_count, *values) : status;
  }
  status = status.ok()
    ? to_whole_numbers(find(mesh, names.rigid_sets), names.rigid_sets, terms.rigid_sets)
    : status;
  return status.ok() ? to_whole_numbers(find(mesh, names.mirror), names.mirror, terms.mirror)
                     : status;
}

Status to_handle_bounds(vtkPolyData* handles, const std::vector<Index>& cells,
  const double (&everywhere)[2], WeightTerms& terms)
{
  vtkDataArray* bounds_array = handles->GetCellData()->GetArray(handle_bounds_name);
  if (bounds_array && bounds_array->GetNumberOfComponents() != 2)
  {
    return Status::invalid_input(std::string("the handles' array '") + handle_bounds_name +
      "' has " + std::to_string(bounds_array->GetNumberOfComponents()) +
      " components; expected 2, the smallest and the largest weight");
  }
  if (!bounds_array && everywhere[0] == 0.0 && everywhere[1] == 1.0)
  {
    return {};
  }
  terms.handle_bounds.resize(static_cast<Index>(cells.size()), 2);
  for (Index j = 0; j < terms.handle_bounds.rows(); ++j)
  {
    for (int k = 0; k < 2; ++k)
    {
      const double handle_bound = bounds_array
        ? bounds_array->GetComponent(cells[static_cast<std::size_t>(j)], k)
        : std::numeric_limits<double>::quiet_NaN();
      terms.handle_bounds(j, k) = std::isnan(handle_bound) ? everywhere[k] : handle_bound;
    }
  }
  return {};
}

} // namespace bindpose
