#include "tets_data.h"

#include "conversion.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>

namespace bindpose
{

namespace
{
vtkSmartPointer<vtkDoubleArray> to_array(const char* name, const Eigen::VectorXd& values)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfValues(values.size());
  std::copy(values.data(), values.data() + values.size(), array->GetPointer(0));
  return array;
}
} // namespace

vtkSmartPointer<vtkUnstructuredGrid> to_unstructured_grid(
  const TetrahedralizeResult& result, const std::string& method)
{
  const auto grid = to_unstructured_grid(result.mesh.points, result.mesh.tets);
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("OriginalPointIds");
  ids->SetNumberOfValues(static_cast<vtkIdType>(result.original_vertices.size()));
  std::copy(result.original_vertices.begin(), result.original_vertices.end(), ids->GetPointer(0));
  grid->GetPointData()->AddArray(ids);
  vtkNew<vtkIntArray> labels;
  labels->SetName("Label");
  for (const TetLabel label : result.labels)
  {
    labels->InsertNextValue(static_cast<int>(label));
  }
  grid->GetCellData()->SetScalars(to_array("WindingNumber", result.winding_numbers));
  grid->GetCellData()->AddArray(labels);
  grid->GetCellData()->AddArray(to_array("MinDihedralAngle", result.min_dihedral_angles));
  if (result.inside_fractions.size() > 0)
  {
    grid->GetCellData()->AddArray(to_array("InsideFraction", result.inside_fractions));
  }
  // Store the method also outside of the report: if the tets are written to a file and read again,
  // the reader's own report replaces this report.
  vtkNew<vtkStringArray> name;
  name->SetName("Method");
  name->InsertNextValue(method);
  grid->GetFieldData()->AddArray(name);
  return grid;
}

} // namespace bindpose
