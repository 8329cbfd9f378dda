// Connects the kernel bindpose::Crowd to VTK. The bind stores the space of deformations, which all
// instances share. An execution computes the transforms of all instances and blends them in one
// call.
#include "vtkCrowdDeformation.h"

#include "arap/crowd.h"
#include "arap_input.h"
#include "base/execution.h"
#include "instance_poses.h"
#include "output_type.h"
#include "pose/found_rotations.h"
#include "pose_input.h"
#include "vtkArapEnergy.h"
#include "vtkReducedPoseAlgorithm.h"

#include "vtkAppendFilter.h"
#include "vtkAppendPolyData.h"
#include "vtkCompositeDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>

using namespace bindpose;

vtkStandardNewMacro(vtkCrowdDeformation);

struct vtkCrowdDeformation::Internals
{
  Crowd crowd;
};

namespace
{
vtkSmartPointer<vtkFloatArray> make_vectors(Index count)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(count);
  return array;
}

vtkSmartPointer<vtkDoubleArray> to_array(const std::vector<Affine>& transforms, Index count)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName("HandleTransforms");
  array->SetNumberOfComponents(12);
  for (Index j = 0; j < count; ++j)
  {
    array->InsertNextTuple(transforms[static_cast<std::size_t>(j)].data());
  }
  return array;
}

/// Append all instances to one dataset. `Append` is VTK's filter that appends datasets of class
/// `Data`.
template <typename Append, typename Data>
void append(const std::vector<vtkSmartPointer<vtkPointSet>>& instances, vtkDataObject* result)
{
  vtkNew<Append> all;
  for (std::size_t i = 0; i < instances.size(); ++i)
  {
    vtkNew<vtkIntArray> number;
    number->SetName("Instance");
    number->SetNumberOfTuples(instances[i]->GetNumberOfPoints());
    number->FillValue(static_cast<int>(i));
    instances[i]->GetPointData()->AddArray(number);
    all->AddInputData(Data::SafeDownCast(instances[i]));
  }
  all->Update();
  result->ShallowCopy(all->GetOutput());
}
} // namespace

vtkCrowdDeformation::vtkCrowdDeformation() : Internal(this->GetBlock())
{
  this->SetNumberOfInputPorts(3);
}

vtkCrowdDeformation::~vtkCrowdDeformation() = default;

int vtkCrowdDeformation::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port < 2)
  {
    return this->Superclass::FillInputPortInformation(port, info);
  }
  info->Set(INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  info->Append(INPUT_REQUIRED_DATA_TYPE(), "vtkTable");
  info->Append(INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

int vtkCrowdDeformation::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataObject");
  return 1;
}

int vtkCrowdDeformation::RequestDataObject(
  vtkInformation*, vtkInformationVector** input, vtkInformationVector* output)
{
  vtkNew<vtkPartitionedDataSetCollection> collection;
  match_output_type(this->OutputType == APPENDED ? vtkDataObject::GetData(input[0], 0)
                                                 : static_cast<vtkDataObject*>(collection.Get()),
    output);
  return 1;
}

void vtkCrowdDeformation::SetEnergy(int energy)
{
  energy = std::clamp<int>(energy, vtkArapEnergy::AUTO, vtkArapEnergy::SPOKES);
  this->SetBindParameter(this->Energy, energy);
}

void vtkCrowdDeformation::SetNumberOfClusters(int clusters)
{
  clusters = std::max(clusters, 0);
  this->SetBindParameter(this->NumberOfClusters, clusters);
}

void vtkCrowdDeformation::SetNumberOfExtraWeights(int extra)
{
  extra = std::max(extra, 0);
  this->SetBindParameter(this->NumberOfExtraWeights, extra);
}

void vtkCrowdDeformation::SetExtraWeightsKind(int kind)
{
  kind = std::clamp<int>(kind, vtkReducedPoseAlgorithm::BUMPS, vtkReducedPoseAlgorithm::EIGENMODES);
  this->SetBindParameter(this->ExtraWeightsKind, kind);
}

void vtkCrowdDeformation::SetSmallestWeight(double smallest)
{
  smallest = std::clamp(smallest, 0.0, 1.0);
  this->SetBindParameter(this->SmallestWeight, smallest);
}

Status vtkCrowdDeformation::Bind(ExecutionContext& context, const PoseInput& input)
{
  ReducedArapOptions options;
  options.skinning.smallest_weight = this->SmallestWeight;
  return bind_reduced(context, *this, this->Internal->crowd, input, options);
}

Status vtkCrowdDeformation::Execute(
  ExecutionContext& context, vtkInformationVector** input, vtkInformationVector* output)
{
  if (this->GetBlock().composite && this->OutputType != APPENDED)
  {
    return Status::invalid_input("a crowd of a composite mesh needs the output type appended, "
                                 "because a collection cannot be a "
                                 "block");
  }
  if (this->IsEmptyPiece(input, output))
  {
    vtkDataObject::GetData(output, 0)->Initialize();
    Status status;
    status.report.set("counts.instances", 0);
    return status;
  }
  const Status prepared = this->Prepare(context, input);
  if (!prepared.usable())
  {
    return prepared;
  }
  const PoseInput& bound = this->GetPoseInput();
  InstancePoses instances;
  const Status converted =
    to_instance_poses(vtkDataObject::GetData(input[2], 0), bound.handles, bound.pose, instances);
  if (!converted.ok())
  {
    return converted;
  }

  for (Pose& pose : instances.poses)
  {
    pose = resolve_automatic_modes(bound.handles, pose);
  }

  Crowd& crowd = this->Internal->crowd;
  Status status;
  std::string unused;
  for (std::size_t i = 0; i < instances.poses.size() && unused.empty(); ++i)
  {
    unused = unused_stretch(instances.poses[i], StretchUse::ends);
  }
  {
    Phase phase(context, "solve", 0.8, 0.9);
    ReducedSolveOptions options;
    options.tolerance = this->Tolerance;
    options.max_iterations = this->MaximumIterations;
    options.anderson_window = this->AndersonWindow;
    options.mixed_precision = this->MixedPrecision;
    options.start = this->WarmStart ? ReducedStart::last : ReducedStart::guess;
    status = crowd.solve(context, instances.poses, options);
    if (!status.usable())
    {
      return status;
    }
  }
  auto* polydata = vtkPolyData::SafeDownCast(bound.mesh);
  vtkDataArray* rest_normals = polydata ? polydata->GetPointData()->GetNormals() : nullptr;
  std::vector<vtkSmartPointer<vtkFloatArray>> points;
  std::vector<FloatPoints> normals;
  {
    Phase phase(context, "skin", 0.9, 1.0);
    std::vector<float*> rows;
    for (std::size_t i = 0; i < instances.poses.size(); ++i)
    {
      points.push_back(make_vectors(bound.points.rows()));
      rows.push_back(points.back()->GetPointer(0));
    }
    Status moved = crowd.deform(context, bound.points, rows, instances.placements);
    if (moved.ok() && rest_normals)
    {
      const SharedMatrix<Weights> rest = to_matrix(rest_normals);
      const Eigen::Map<const Points> directions(rest.view().data(), rest.view().rows(), 3);
      moved = crowd.deform_normals(context, directions, normals, instances.placements);
    }
    if (!moved.ok())
    {
      return moved;
    }
  }

  std::vector<vtkSmartPointer<vtkPointSet>> posed;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    vtkSmartPointer<vtkPointSet> instance;
    instance.TakeReference(bound.mesh->NewInstance());
    instance->ShallowCopy(bound.mesh);
    vtkNew<vtkPoints> at;
    at->SetData(points[i]);
    instance->SetPoints(at);
    instance->GetFieldData()->AddArray(to_array(crowd.transforms()[i], bound.weights.cols()));
    if (rest_normals)
    {
      vtkSmartPointer<vtkFloatArray> posed_normals = make_vectors(normals[i].rows());
      std::copy_n(normals[i].data(), normals[i].size(), posed_normals->GetPointer(0));
      posed_normals->SetName(rest_normals->GetName());
      instance->GetPointData()->SetNormals(posed_normals);
    }
    posed.push_back(instance);
  }
  vtkDataObject* result = vtkDataObject::GetData(output, 0);
  result->Initialize();
  if (this->OutputType == APPENDED && polydata)
  {
    append<vtkAppendPolyData, vtkPolyData>(posed, result);
  }
  else if (this->OutputType == APPENDED && vtkUnstructuredGrid::SafeDownCast(bound.mesh))
  {
    append<vtkAppendFilter, vtkDataSet>(posed, result);
  }
  else if (this->OutputType == APPENDED)
  {
    return Status::invalid_input(std::string("instances of a ") + bound.mesh->GetClassName() +
      " cannot be appended; set the output type to collection");
  }
  else
  {
    auto* collection = vtkPartitionedDataSetCollection::SafeDownCast(result);
    collection->SetNumberOfPartitionedDataSets(static_cast<unsigned int>(posed.size()));
    for (unsigned int i = 0; i < posed.size(); ++i)
    {
      collection->SetPartition(i, 0, posed[i]);
      collection->GetMetaData(i)->Set(
        vtkCompositeDataSet::NAME(), ("instance " + std::to_string(i)).c_str());
    }
  }
  status.warnings.insert(
    status.warnings.begin(), converted.warnings.begin(), converted.warnings.end());
  if (!unused.empty())
  {
    status.warnings.push_back(unused);
  }
  return this->WithBindReport(status);
}

void vtkCrowdDeformation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Energy: " << arap_energy_name(this->Energy) << "\n";
  os << indent << "NumberOfClusters: " << this->NumberOfClusters << "\n";
  os << indent << "NumberOfExtraWeights: " << this->NumberOfExtraWeights << "\n";
  os << indent << "ExtraWeightsKind: "
     << (this->ExtraWeightsKind == vtkReducedPoseAlgorithm::EIGENMODES ? "eigenmodes" : "bumps")
     << "\n";
  os << indent << "SmallestWeight: " << this->SmallestWeight << "\n";
  os << indent << "MaximumIterations: " << this->MaximumIterations << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "AndersonWindow: " << this->AndersonWindow << "\n";
  os << indent << "WarmStart: " << (this->WarmStart ? "on" : "off") << "\n";
  os << indent << "MixedPrecision: " << (this->MixedPrecision ? "on" : "off") << "\n";
  os << indent << "OutputType: " << (this->OutputType == APPENDED ? "appended" : "collection")
     << "\n";
}
