#ifndef bindpose_tests_viewer_poses_rigs_h
#define bindpose_tests_viewer_poses_rigs_h

// Shapes with artificial weights. Each shape is available as datasets for the filters and as a
// PoseSource for the posers of the window.

#include "poses/pose_source_data.h"

#include "support/handles.h"
#include "support/meshes.h"
#include "support/poses.h"

#include "conversion.h"
#include "weights_arrays.h"

#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <memory>

namespace bindpose::test
{

struct Rig
{
  vtkSmartPointer<vtkPolyData> surface; ///< surface with the array Weights
  vtkSmartPointer<vtkUnstructuredGrid> tets; ///< tets with the array Weights
  vtkSmartPointer<vtkPolyData> handles;
  Handles list;
  std::vector<Index> cells;

  std::shared_ptr<const PoseSource> source() const
  {
    auto made = std::make_shared<PoseSource>();
    to_pose_source(this->surface, this->tets, this->handles, *made);
    return made;
  }
};

/// Return a beam of tets along x, with its boundary as the surface. The handles are two points on
/// the surface and two bones along the beam.
inline Rig beam()
{
  Rig rig;
  const TetMesh mesh = tet_box(12, 3, 3, Vec3(0, 0, 0), Vec3(4, 1, 1));
  rig.list = { point_handle("left", Vec3(1, 0, 0)), point_handle("right", Vec3(3, 1, 1)),
    bone_handle("upper", Vec3(0, 0.5, 0.5), Vec3(2, 0.5, 0.5)),
    bone_handle("lower", Vec3(2.05, 0.5, 0.5), Vec3(4, 0.5, 0.5)) };
  rig.handles = to_polydata(rig.list);
  to_handles(rig.handles, rig.list, &rig.cells);
  rig.surface = to_polydata(mesh.points, boundary_triangles(mesh.tets));
  rig.tets = to_unstructured_grid(mesh.points, mesh.tets);
  const Weights weights = distance_weights(mesh.points, rig.list);
  for (vtkDataSet* data :
    { static_cast<vtkDataSet*>(rig.surface), static_cast<vtkDataSet*>(rig.tets) })
  {
    data->GetPointData()->AddArray(to_weights_array("Weights", weights, rig.list));
  }
  return rig;
}

} // namespace bindpose::test

#endif
