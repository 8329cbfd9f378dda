#include "rotation_arrays.h"

#include "pose/transform_parts.h"

#include "vtkDoubleArray.h"
#include "vtkPointData.h"

namespace bindpose
{

void add_rotations(const RotationGroups& groups, const std::vector<Eigen::Matrix3d>& rotations,
  vtkSmartPointer<vtkIntArray>& clusters, vtkPointData* data)
{
  const auto points = static_cast<vtkIdType>(groups.group_of_vertex.size());
  if (!clusters)
  {
    clusters = vtkSmartPointer<vtkIntArray>::New();
    clusters->SetName("RotationCluster");
    clusters->SetNumberOfValues(points);
    for (vtkIdType v = 0; v < points; ++v)
    {
      clusters->SetValue(v, static_cast<int>(groups.group_of_vertex[static_cast<std::size_t>(v)]));
    }
  }
  std::vector<Vec3> vectors;
  for (const Eigen::Matrix3d& rotation : rotations)
  {
    vectors.push_back(rotation_vector(rotation));
  }
  auto rotation_vectors = vtkSmartPointer<vtkDoubleArray>::New();
  rotation_vectors->SetName("Rotation");
  rotation_vectors->SetNumberOfComponents(3);
  rotation_vectors->SetNumberOfTuples(points);
  const Vec3 none = Vec3::Zero();
  for (vtkIdType v = 0; v < points; ++v)
  {
    const int cluster = clusters->GetValue(v);
    rotation_vectors->SetTuple(
      v, (cluster < 0 ? none : vectors[static_cast<std::size_t>(cluster)]).data());
  }
  data->AddArray(clusters);
  data->AddArray(rotation_vectors);
}

} // namespace bindpose
