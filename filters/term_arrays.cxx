#include "term_arrays.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkStaticPointLocator.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
vtkDataArray* find(vtkDataSet* mesh, const std::string& name)
{
  return name.empty() ? nullptr : mesh->GetPointData()->GetArray(name.c_str());
}

Status check_components(vtkDataArray* array, const std::string& name, Index wanted)
{
  if (array && array->GetNumberOfComponents() != wanted)
  {
    return Status::invalid_input("the point array '" + name + "' must have " +
      (wanted == 1 ? std::string("one number a point")
                   : std::to_string(wanted) + " components, one a handle") +
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
      return Status::invalid_input(
        "the point array '" + name + "' holds no whole number at point " + std::to_string(v));
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

Index carry_terms(vtkDataSet* surface, const TermArrayNames& names, vtkDataSet* tets)
{
  vtkDataArray* originals = tets->GetPointData()->GetArray("OriginalPointIds");
  const vtkIdType count = tets->GetNumberOfPoints();
  std::vector<vtkIdType> original(static_cast<std::size_t>(count), -1);
  std::vector<vtkIdType> carried_to(static_cast<std::size_t>(surface->GetNumberOfPoints()), -1);
  for (vtkIdType v = 0; v < count; ++v)
  {
    original[v] = originals ? static_cast<vtkIdType>(originals->GetComponent(v, 0)) : -1;
    if (original[v] >= 0)
    {
      carried_to[original[v]] = v;
    }
  }
  std::vector<char> lost(carried_to.size(), 0);
  for (const std::string& name : names.all())
  {
    vtkDataArray* from = find(surface, name);
    if (!from)
    {
      continue;
    }
    for (vtkIdType v = 0; v < surface->GetNumberOfPoints() && name != names.rigidity; ++v)
    {
      for (int c = 0; c < from->GetNumberOfComponents() && carried_to[v] < 0; ++c)
      {
        const double value = from->GetComponent(v, c);
        const bool asked = name == names.rigid_sets ? value > 0.0
          : name == names.mirror                    ? value >= 0.0
                                                    : !std::isnan(value);
        lost[v] = lost[v] || asked;
      }
    }
    const bool whole = name == names.rigid_sets || name == names.mirror;
    const double elsewhere = name == names.mirror ? -1.0 : whole ? 0.0 : std::nan("");
    vtkSmartPointer<vtkDataArray> to;
    to.TakeReference(whole ? static_cast<vtkDataArray*>(vtkIdTypeArray::New())
                           : static_cast<vtkDataArray*>(vtkDoubleArray::New()));
    to->SetName(name.c_str());
    to->SetNumberOfComponents(from->GetNumberOfComponents());
    to->SetNumberOfTuples(count);
    vtkNew<vtkStaticPointLocator> nearest;
    if (name == names.rigidity)
    {
      nearest->SetDataSet(surface);
      nearest->BuildLocator();
    }
    for (vtkIdType v = 0; v < count; ++v)
    {
      const vtkIdType source = original[v] >= 0 || name != names.rigidity
        ? original[v]
        : nearest->FindClosestPoint(tets->GetPoint(v));
      for (int c = 0; c < from->GetNumberOfComponents(); ++c)
      {
        double value = source >= 0 ? from->GetComponent(source, c) : elsewhere;
        if (name == names.mirror && value >= 0 && value < static_cast<double>(carried_to.size()))
        {
          value = static_cast<double>(carried_to[static_cast<std::size_t>(value)]);
        }
        to->SetComponent(v, c, value);
      }
    }
    tets->GetPointData()->AddArray(to);
  }
  return static_cast<Index>(std::count(lost.begin(), lost.end(), 1));
}

} // namespace bindpose
