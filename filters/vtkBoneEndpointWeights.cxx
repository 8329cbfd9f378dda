// Connects the kernel bindpose::solve_endpoint_weights() to VTK.
#include "vtkBoneEndpointWeights.h"

#include "bind_key.h"
#include "conversion.h"
#include "poser/bone_endpoints.h"
#include "weights_arrays.h"

#include "vtkDoubleArray.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

using namespace bindpose;

vtkStandardNewMacro(vtkBoneEndpointWeights);

static_assert(vtkBoneEndpointWeights::JOINTS == static_cast<int>(EndpointMethod::joints));
static_assert(vtkBoneEndpointWeights::BOUNDED == static_cast<int>(EndpointMethod::bounded));

namespace
{
constexpr const char* endpoint_array_name = "EndpointWeights";
} // namespace

struct vtkBoneEndpointWeights::Cache
{
  bool valid = false;
  BindKey key;
  Status status;
  vtkSmartPointer<vtkDoubleArray> weights;
};

vtkBoneEndpointWeights::vtkBoneEndpointWeights() : BindCache(this->GetBlock()) {}

vtkBoneEndpointWeights::~vtkBoneEndpointWeights() = default;

Status vtkBoneEndpointWeights::Execute(
  ExecutionContext& context, vtkInformationVector** input, vtkInformationVector* output)
{
  vtkPointSet* mesh = vtkPointSet::GetData(input[0]);
  vtkPolyData* handle_data = vtkPolyData::GetData(input[1]);
  vtkPointSet* result = vtkPointSet::GetData(output);
  if (!mesh || !result || mesh->GetNumberOfPoints() == 0)
  {
    return Status::invalid_input("the input mesh is missing");
  }
  if (!handle_data)
  {
    return Status::invalid_input("the input has no handles");
  }
  BindKey key;
  key.add(static_cast<vtkMTimeType>(this->Method));
  key.add(static_cast<vtkMTimeType>(this->Domain));
  for (vtkObject* object : bind_objects(mesh, {}))
  {
    key.add(object);
  }
  for (vtkObject* object : bind_objects(handle_data))
  {
    key.add(object);
  }
  const bool bind = !this->BindCache->valid || this->BindCache->key != key;
  if (bind)
  {
    const Phase phase(context, "endpoints");
    Handles handles;
    bindpose::Domain domain;
    std::vector<Index> cells;
    Status status = to_handles(handle_data, handles);
    status = status.ok() ? to_domain(mesh, domain, cells) : status;
    if (!status.ok())
    {
      return status;
    }
    Weights endpoints;
    status =
      solve_endpoint_weights(context, domain, handles, static_cast<EndpointMethod>(this->Method),
        static_cast<WeightsDomain>(this->Domain), endpoints);
    if (!status.usable())
    {
      return status;
    }
    Cache new_cache;
    new_cache.weights = to_weights_array(endpoint_array_name, endpoints, handles);
    status.report.set("counts.handles", static_cast<Index>(handles.size()));
    new_cache.status = status;
    new_cache.key = key;
    new_cache.valid = true;
    *this->BindCache = std::move(new_cache);
    this->NumberOfBinds += 1;
  }
  result->ShallowCopy(mesh);
  result->GetPointData()->AddArray(this->BindCache->weights);
  Status status = this->BindCache->status;
  status.report.set("counts.vertices", Report::Value(std::int64_t(mesh->GetNumberOfPoints())));
  status.report.set("binds", this->NumberOfBinds);
  if (!bind && !status.warnings.empty())
  {
    // Warnings are issued only by the update that computes the weights; the report keeps them.
    status.report.set("warnings[]", status.warnings);
    status.warnings.clear();
  }
  return status;
}

void vtkBoneEndpointWeights::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << to_string(static_cast<EndpointMethod>(this->Method)) << "\n";
  os << indent << "Domain: " << to_string(static_cast<WeightsDomain>(this->Domain)) << "\n";
  os << indent << "NumberOfBinds: " << this->NumberOfBinds << "\n";
}
