// Connects the kernel bindpose::monotone_smoothing() to VTK.
#include "vtkMonotoneSmoothing.h"

#include "base/execution.h"
#include "conversion.h"
#include "output_type.h"
#include "weights/monotone_smoothing.h"

#include "vtkCellArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSignedCharArray.h"

#include <cmath>

using namespace bindpose;

vtkStandardNewMacro(vtkMonotoneSmoothing);

namespace
{
constexpr char default_list_name[] = "Extrema";

std::string point_arrays(vtkDataSet* mesh)
{
  std::string names;
  for (int a = 0; a < mesh->GetPointData()->GetNumberOfArrays(); ++a)
  {
    const char* name = mesh->GetPointData()->GetArrayName(a);
    names += (names.empty() ? "" : ", ") + std::string(name ? name : "");
  }
  return names.empty() ? "it has no point arrays" : "its point arrays: " + names;
}

/// Convert the data array.
/// @param name  name of the array; empty: the active scalars
Status to_data(
  vtkDataArray* array, vtkDataSet* mesh, const std::string& name, Eigen::VectorXd& data)
{
  if (!array)
  {
    return Status::invalid_input(name.empty()
        ? "the mesh has no active point scalars to smooth; select a point array (" +
          point_arrays(mesh) + ")"
        : "the mesh has no point array '" + name + "' of numeric type (" + point_arrays(mesh) +
          ")");
  }
  if (array->GetNumberOfComponents() != 1 ||
    array->GetNumberOfTuples() != mesh->GetNumberOfPoints())
  {
    return Status::invalid_input("the array '" +
      std::string(array->GetName() ? array->GetName() : "") + "' has " +
      std::to_string(array->GetNumberOfComponents()) + " components and " +
      std::to_string(array->GetNumberOfTuples()) +
      " tuples; expected 1 component and one tuple for each of the " +
      std::to_string(mesh->GetNumberOfPoints()) + " points");
  }
  data = to_matrix(array).view().col(0);
  return {};
}

Status to_list(vtkDataSet* mesh, const std::string& name, ExtremaList& list)
{
  list.clear();
  vtkAbstractArray* found =
    name.empty() ? nullptr : mesh->GetPointData()->GetAbstractArray(name.c_str());
  if (!found)
  {
    return name.empty() || name == default_list_name
      ? Status()
      : Status::invalid_input("the mesh has no point array '" + name + "' of extrema");
  }
  auto* array = vtkDataArray::SafeDownCast(found);
  if (!array || array->GetNumberOfComponents() != 1)
  {
    return Status::invalid_input("the point array '" + name +
      "' of extrema must have one component: 1 is a maximum, -1 a minimum, 0 neither");
  }
  for (vtkIdType v = 0; v < array->GetNumberOfTuples(); ++v)
  {
    const double kind = array->GetComponent(v, 0);
    if (std::isnan(kind))
    {
      return Status::invalid_input(
        "the point array '" + name + "' of extrema is NaN at point " + std::to_string(v));
    }
    list.push_back(kind > 0.0 ? 1 : kind < 0.0 ? -1 : 0);
  }
  return {};
}

void write_extrema(const Eigen::VectorXd& data, const PointsView& positions,
  const MonotoneSmoothingResult& result, vtkPolyData* output)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> vertices;
  vtkNew<vtkIntArray> kinds, listed;
  vtkNew<vtkIdTypeArray> ids;
  vtkNew<vtkDoubleArray> values, data_values, persistences;
  const auto add = [&](const Extremum& extremum, bool in_list)
  {
    const Vec3 position = positions.row(extremum.vertex);
    const vtkIdType id = points->InsertNextPoint(position.data());
    vertices->InsertNextCell(1, &id);
    kinds->InsertNextValue(extremum.maximum ? 1 : -1);
    values->InsertNextValue(result.values[extremum.vertex]);
    data_values->InsertNextValue(data[extremum.vertex]);
    persistences->InsertNextValue(extremum.persistence);
    ids->InsertNextValue(extremum.vertex);
    listed->InsertNextValue(in_list);
  };
  for (const Extremum& extremum : result.extrema)
  {
    add(extremum, true);
  }
  for (const Extremum& extremum : result.spurious)
  {
    add(extremum, false);
  }
  output->Initialize();
  output->SetPoints(points);
  output->SetVerts(vertices);
  const std::pair<vtkDataArray*, const char*> arrays[] = { { kinds, "Kind" }, { values, "Value" },
    { data_values, "DataValue" }, { persistences, "Persistence" }, { ids, "PointId" },
    { listed, "Listed" } };
  for (const auto& [array, name] : arrays)
  {
    array->SetName(name);
    output->GetPointData()->AddArray(array);
  }
}
} // namespace

vtkMonotoneSmoothing::vtkMonotoneSmoothing()
{
  this->SetNumberOfOutputPorts(2);
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

vtkMonotoneSmoothing::~vtkMonotoneSmoothing() = default;

void vtkMonotoneSmoothing::SetExtremaArrayName(const std::string& name)
{
  if (this->ExtremaArrayName != name)
  {
    this->ExtremaArrayName = name;
    this->Modified();
  }
}

void vtkMonotoneSmoothing::SetResultArrayName(const std::string& name)
{
  if (this->ResultArrayName != name)
  {
    this->ResultArrayName = name;
    this->Modified();
  }
}

int vtkMonotoneSmoothing::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  return 1;
}

int vtkMonotoneSmoothing::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkPointSet" : "vtkPolyData");
  return 1;
}

int vtkMonotoneSmoothing::RequestDataObject(
  vtkInformation*, vtkInformationVector** input, vtkInformationVector* output)
{
  match_output_type(vtkDataObject::GetData(input[0], 0), output);
  return 1;
}

Status vtkMonotoneSmoothing::Execute(
  ExecutionContext& context, vtkInformationVector** input, vtkInformationVector* output)
{
  vtkPointSet* mesh = vtkPointSet::GetData(input[0]);
  vtkPointSet* result = vtkPointSet::GetData(output);
  if (!mesh || !result)
  {
    return Status::invalid_input("the input mesh is missing");
  }
  Domain domain;
  std::vector<Index> cell_of_element;
  Status status = to_domain(mesh, domain, cell_of_element);
  const char* name = this->GetInputArrayInformation(0)->Get(vtkDataObject::FIELD_NAME());
  Eigen::VectorXd data;
  if (status.ok())
  {
    status = to_data(this->GetInputArrayToProcess(0, input), mesh, name ? name : "", data);
  }
  MonotoneSmoothingOptions options;
  if (status.ok())
  {
    status = to_list(mesh, this->ExtremaArrayName, options.extrema);
  }
  if (!status.ok())
  {
    return status;
  }
  options.order = this->Order;
  options.data_weight = this->DataWeight;
  options.persistence = this->Persistence;
  options.extrema_count = this->NumberOfExtrema;
  options.keep_values = this->KeepValues;
  options.guide = static_cast<SmoothingGuide>(this->Guide);
  options.rebuilds = this->Rebuilds;
  options.epsilon = this->Epsilon;
  options.tolerance = this->Tolerance;
  options.maximum_iterations = this->MaximumIterations;
  options.solver.memory_limit = this->MemoryLimit;
  MonotoneSmoothingResult smoothed;
  status = monotone_smoothing(context, domain, data, options, smoothed);
  if (!status.usable())
  {
    return status;
  }
  result->ShallowCopy(mesh);
  vtkNew<vtkDoubleArray> values;
  values->SetName(this->ResultArrayName.c_str());
  values->SetNumberOfTuples(smoothed.values.size());
  std::copy(
    smoothed.values.data(), smoothed.values.data() + smoothed.values.size(), values->GetPointer(0));
  result->GetPointData()->AddArray(values);
  result->GetPointData()->SetActiveScalars(this->ResultArrayName.c_str());
  vtkNew<vtkSignedCharArray> list;
  list->SetName((this->ResultArrayName + "Extrema").c_str());
  list->SetNumberOfTuples(smoothed.values.size());
  std::copy(smoothed.list.begin(), smoothed.list.end(), list->GetPointer(0));
  result->GetPointData()->AddArray(list);
  const std::pair<const char*, double> certificate[] = { { "RelativeGap",
                                                           smoothed.certificate.relative_gap },
    { "KKTResidual", smoothed.certificate.kkt_residual } };
  for (const auto& [suffix, value] : certificate)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName((this->ResultArrayName + suffix).c_str());
    array->InsertNextValue(value);
    result->GetFieldData()->AddArray(array);
  }
  write_extrema(data, domain.points, smoothed, vtkPolyData::GetData(output, 1));
  return status;
}

void vtkMonotoneSmoothing::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Order: " << this->Order << "\n";
  os << indent << "DataWeight: " << this->DataWeight << "\n";
  os << indent << "ExtremaArrayName: " << this->ExtremaArrayName << "\n";
  os << indent << "Persistence: " << this->Persistence << "\n";
  os << indent << "NumberOfExtrema: " << this->NumberOfExtrema << "\n";
  os << indent << "KeepValues: " << (this->KeepValues ? "on" : "off") << "\n";
  os << indent << "Guide: " << (this->Guide == HARMONIC ? "harmonic" : "unconstrained") << "\n";
  os << indent << "Rebuilds: " << this->Rebuilds << "\n";
  os << indent << "Epsilon: " << this->Epsilon << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "MaximumIterations: " << this->MaximumIterations << "\n";
  os << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
  os << indent << "ResultArrayName: " << this->ResultArrayName << "\n";
}
