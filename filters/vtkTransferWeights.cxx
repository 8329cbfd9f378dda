// Connects the kernels transfer() and inpaint_weights() to VTK. The transferred array is cached
// like that of the weights filters: an upstream edit of the pose must not create a new array,
// because downstream filters would then bind again.
#include "vtkTransferWeights.h"

#include "base/execution.h"
#include "bind_key.h"
#include "conversion.h"
#include "output_type.h"
#include "transfer/inpaint.h"
#include "transfer/transfer.h"
#include "weights_arrays.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

using namespace bindpose;

vtkStandardNewMacro(vtkTransferWeights);

struct vtkTransferWeights::Cache
{
  bool valid = false;
  BindKey key;
  Status status;
  vtkSmartPointer<vtkDoubleArray> weights;
  vtkSmartPointer<vtkUnsignedCharArray> matched; ///< null for the method NEAREST
  vtkSmartPointer<vtkFieldData> certificates; ///< of inpainted weights
};

namespace
{
/// Create an array of doubles with the name, the number of components and the component names of
/// `weights`. The values are not initialized.
vtkSmartPointer<vtkDoubleArray> array_like(vtkDataArray* weights, vtkIdType tuples)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(weights->GetName());
  array->SetNumberOfComponents(weights->GetNumberOfComponents());
  array->CopyComponentNames(weights);
  array->SetNumberOfTuples(tuples);
  return array;
}

/// Add the relative gaps and residuals of the columns to field data.
void add_certificates(
  const std::string& name, const std::vector<Certificate>& certificates, vtkFieldData* data)
{
  vtkNew<vtkDoubleArray> gaps;
  vtkNew<vtkDoubleArray> residuals;
  gaps->SetName((name + "RelativeGap").c_str());
  residuals->SetName((name + "KKTResidual").c_str());
  for (const Certificate& certificate : certificates)
  {
    gaps->InsertNextValue(certificate.relative_gap);
    residuals->InsertNextValue(certificate.kkt_residual);
  }
  data->AddArray(gaps);
  data->AddArray(residuals);
}
} // namespace

vtkTransferWeights::vtkTransferWeights() : BindCache(this->GetBlock())
{
  this->SetNumberOfInputPorts(2);
}

vtkTransferWeights::~vtkTransferWeights() = default;

void vtkTransferWeights::SetArrayName(const std::string& name)
{
  this->SetBindParameter(this->ArrayName, name);
}

void vtkTransferWeights::SetMethod(int method)
{
  this->SetBindParameter(this->Method, std::clamp(method, int(NEAREST), int(INPAINT)));
}

void vtkTransferWeights::SetMaximumDistance(double distance)
{
  this->SetBindParameter(this->MaximumDistance, distance);
}

void vtkTransferWeights::SetMaximumAngle(double degrees)
{
  this->SetBindParameter(this->MaximumAngle, degrees);
}

void vtkTransferWeights::SetSmallestGroup(double fraction)
{
  this->SetBindParameter(this->SmallestGroup, fraction);
}

void vtkTransferWeights::SetMaximumInfluences(int influences)
{
  this->SetBindParameter(this->MaximumInfluences, influences);
}

void vtkTransferWeights::SetSmoothingSteps(int steps)
{
  this->SetBindParameter(this->SmoothingSteps, steps);
}

int vtkTransferWeights::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  if (port > 0)
  {
    AcceptBlocks(info);
  }
  return 1;
}

int vtkTransferWeights::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPointSet");
  return 1;
}

int vtkTransferWeights::RequestDataObject(
  vtkInformation*, vtkInformationVector** input, vtkInformationVector* output)
{
  match_output_type(vtkDataObject::GetData(input[0], 0), output);
  return 1;
}

Status vtkTransferWeights::Execute(
  ExecutionContext& context, vtkInformationVector** input, vtkInformationVector* output)
{
  vtkPointSet* target = vtkPointSet::GetData(input[0]);
  vtkPointSet* mesh = vtkPointSet::GetData(input[1]);
  vtkPointSet* result = vtkPointSet::GetData(output);
  const bool empty_piece = this->IsEmptyPiece(input, output);
  if (!empty_piece && (!target || !result || target->GetNumberOfPoints() == 0))
  {
    return Status::invalid_input("the input mesh, to which weights are transferred, has no points");
  }
  vtkDataArray* weights = mesh ? mesh->GetPointData()->GetArray(this->ArrayName.c_str()) : nullptr;
  if (!weights)
  {
    return Status::invalid_input("the source mesh has no point array '" + this->ArrayName + "'");
  }
  if (empty_piece)
  {
    if (target)
    {
      result->ShallowCopy(target);
    }
    result->GetPointData()->AddArray(array_like(weights, 0));
    pass_certificates(mesh->GetFieldData(), result->GetFieldData(), this->ArrayName);
    Status status;
    status.report.set("counts.vertices", 0);
    status.report.set("counts.handles", weights->GetNumberOfComponents());
    return status;
  }
  BindKey key;
  key.add(this->BindTime.GetMTime());
  key.add(target->GetPoints()->GetData());
  for (vtkObject* object : bind_objects(mesh, { this->ArrayName }))
  {
    key.add(object);
  }
  if (this->Method == INPAINT)
  {
    for (vtkObject* object : bind_objects(target, {}))
    {
      key.add(object);
    }
  }
  const bool bind = !this->BindCache->valid || this->BindCache->key != key;
  if (bind)
  {
    const Phase phase(context, "transfer");
    Cache new_cache;
    new_cache.status = this->Method == INPAINT ? this->Inpaint(context, target, mesh, new_cache)
                                               : this->Transfer(context, target, mesh, new_cache);
    if (!new_cache.status.usable())
    {
      return new_cache.status;
    }
    new_cache.key = key;
    new_cache.valid = true;
    *this->BindCache = std::move(new_cache);
    this->NumberOfBinds += 1;
  }
  result->ShallowCopy(target);
  result->GetPointData()->AddArray(this->BindCache->weights);
  const bool inpainted = this->BindCache->matched != nullptr;
  pass_certificates(inpainted ? this->BindCache->certificates.GetPointer() : mesh->GetFieldData(),
    result->GetFieldData(), this->ArrayName);
  if (inpainted)
  {
    result->GetPointData()->AddArray(this->BindCache->matched);
  }

  Status status = this->BindCache->status;
  status.report.set("counts.vertices", Report::Value(std::int64_t(target->GetNumberOfPoints())));
  status.report.set(
    "counts.handles", Report::Value(std::int64_t(weights->GetNumberOfComponents())));
  status.report.set("binds", this->NumberOfBinds);
  if (!bind && !status.warnings.empty())
  {
    status.report.set("warnings[]", status.warnings);
    status.warnings.clear();
  }
  return status;
}

Status vtkTransferWeights::Transfer(
  ExecutionContext& context, vtkPointSet* target, vtkPointSet* mesh, Cache& cache)
{
  vtkDataArray* weights = mesh->GetPointData()->GetArray(this->ArrayName.c_str());
  Domain domain;
  std::vector<Index> cells;
  Status status = to_domain(mesh, domain, cells);
  if (!status.ok())
  {
    return status;
  }
  const SharedMatrix<Points> points = to_points(target);
  const SharedMatrix<Weights> rows = to_matrix(weights);
  Weights values;
  TransferCounts counts;
  status = transfer(context, domain, rows.view(), points.view(), TransferOptions(), values, counts);
  if (!status.usable())
  {
    return status;
  }
  // A mesh that is cut open has several vertices at the same position. Use the vertex with the id
  // of the target point, because the weights filters keep the ids of the input vertices.
  for (Index v = 0; v < std::min<Index>(values.rows(), domain.points.rows()); ++v)
  {
    if (points.view().row(v) == domain.points.row(v))
    {
      values.row(v) = rows.view().row(v);
    }
  }
  cache.weights = array_like(weights, values.rows());
  std::copy(values.data(), values.data() + values.size(), cache.weights->GetPointer(0));
  return status;
}

Status vtkTransferWeights::Inpaint(
  ExecutionContext& context, vtkPointSet* target, vtkPointSet* mesh, Cache& cache)
{
  vtkDataArray* weights = mesh->GetPointData()->GetArray(this->ArrayName.c_str());
  Domain source_domain;
  Domain target_domain;
  std::vector<Index> cells;
  Status status = to_domain(mesh, source_domain, cells);
  status = status.ok() ? to_domain(target, target_domain, cells) : status;
  if (!status.ok())
  {
    return status;
  }
  InpaintOptions options;
  options.match.maximum_distance = this->MaximumDistance;
  options.match.maximum_angle = this->MaximumAngle;
  options.smallest_group = this->SmallestGroup;
  options.maximum_influences = this->MaximumInfluences;
  options.smoothing_steps = this->SmoothingSteps;
  InpaintedWeights result;
  status = inpaint_weights(
    context, source_domain, to_matrix(weights).view(), target_domain, options, result);
  if (!status.usable())
  {
    return status;
  }
  cache.weights = array_like(weights, result.weights.rows());
  std::copy(result.weights.data(), result.weights.data() + result.weights.size(),
    cache.weights->GetPointer(0));
  cache.matched = vtkSmartPointer<vtkUnsignedCharArray>::New();
  cache.matched->SetName("Matched");
  cache.matched->SetNumberOfTuples(result.weights.rows());
  std::copy(result.matched.begin(), result.matched.end(), cache.matched->GetPointer(0));
  cache.certificates = vtkSmartPointer<vtkFieldData>::New();
  add_certificates(this->ArrayName, result.certificates, cache.certificates);
  return status;
}

void vtkTransferWeights::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ArrayName: " << this->ArrayName << "\n";
  os << indent << "Method: " << this->Method << "\n";
  os << indent << "MaximumDistance: " << this->MaximumDistance << "\n";
  os << indent << "MaximumAngle: " << this->MaximumAngle << "\n";
  os << indent << "SmallestGroup: " << this->SmallestGroup << "\n";
  os << indent << "MaximumInfluences: " << this->MaximumInfluences << "\n";
  os << indent << "SmoothingSteps: " << this->SmoothingSteps << "\n";
  os << indent << "NumberOfBinds: " << this->NumberOfBinds << "\n";
}
