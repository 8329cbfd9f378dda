#include "weights_arrays.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>

namespace bindpose
{

namespace
{
constexpr const char* certificate_suffixes[] = { "RelativeGap", "KKTResidual", "Minimum", "Maximum",
  "InteriorExtrema", "Zeros", "Ones", "Iterations", "RowSumError" };
} // namespace

vtkSmartPointer<vtkDoubleArray> to_weights_array(
  const std::string& name, const Weights& weights, const Handles& handles)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(static_cast<int>(weights.cols()));
  for (std::size_t j = 0; j < handles.size(); ++j)
  {
    array->SetComponentName(static_cast<vtkIdType>(j), handles[j].name.c_str());
  }
  array->SetNumberOfTuples(weights.rows());
  std::copy(weights.data(), weights.data() + weights.size(), array->GetPointer(0));
  return array;
}

std::vector<vtkSmartPointer<vtkDoubleArray>> to_certificate_arrays(
  const std::string& name, const WeightsResult& result)
{
  std::vector<vtkSmartPointer<vtkDoubleArray>> arrays;
  for (const char* suffix : certificate_suffixes)
  {
    arrays.push_back(vtkSmartPointer<vtkDoubleArray>::New());
    arrays.back()->SetName((name + suffix).c_str());
  }
  for (const WeightsColumn& column : result.columns)
  {
    arrays[0]->InsertNextValue(column.certificate.relative_gap);
    arrays[1]->InsertNextValue(column.certificate.kkt_residual);
    arrays[2]->InsertNextValue(column.minimum);
    arrays[3]->InsertNextValue(column.maximum);
    arrays[4]->InsertNextValue(static_cast<double>(column.extrema.size()));
    arrays[5]->InsertNextValue(column.zero_fraction);
    arrays[6]->InsertNextValue(column.one_fraction);
    arrays[7]->InsertNextValue(column.iterations);
  }
  arrays[8]->InsertNextValue(result.row_sum_error);
  return arrays;
}

vtkSmartPointer<vtkPolyData> to_extrema(const WeightsProblem& problem, const WeightsResult& result)
{
  auto extrema = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> vertices;
  vtkNew<vtkIntArray> kinds, handles;
  vtkNew<vtkDoubleArray> values, persistences;
  kinds->SetName("Kind");
  handles->SetName("Handle");
  values->SetName("Value");
  persistences->SetName("Persistence");
  for (std::size_t j = 0; j < result.columns.size(); ++j)
  {
    for (const Extremum& extremum : result.columns[j].extrema)
    {
      const Vec3 position =
        problem.frame.point_from_frame(problem.mesh.domain.points.row(extremum.vertex));
      const vtkIdType id = points->InsertNextPoint(position.data());
      vertices->InsertNextCell(1, &id);
      kinds->InsertNextValue(extremum.maximum ? 1 : -1);
      handles->InsertNextValue(static_cast<int>(j));
      values->InsertNextValue(extremum.value);
      persistences->InsertNextValue(extremum.persistence);
    }
  }
  extrema->SetPoints(points);
  extrema->SetVerts(vertices);
  for (vtkDataArray* array :
    { static_cast<vtkDataArray*>(kinds), static_cast<vtkDataArray*>(handles),
      static_cast<vtkDataArray*>(values), static_cast<vtkDataArray*>(persistences) })
  {
    extrema->GetPointData()->AddArray(array);
  }
  return extrema;
}

void pass_certificates(vtkFieldData* from, vtkFieldData* to, const std::string& name)
{
  for (const char* suffix : certificate_suffixes)
  {
    const std::string full = name + suffix;
    to->RemoveArray(full.c_str());
    if (vtkAbstractArray* array = from->GetAbstractArray(full.c_str()))
    {
      to->AddArray(array);
    }
  }
}

} // namespace bindpose
