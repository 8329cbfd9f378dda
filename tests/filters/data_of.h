#ifndef bindpose_tests_filters_data_of_h
#define bindpose_tests_filters_data_of_h

// Conversion of meshes and handles to VTK datasets.

#include "conversion.h"
#include "pose/pose.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

namespace bindpose::test
{

inline vtkSmartPointer<vtkPolyData> data_of(const TriangleMesh& mesh)
{
  return to_polydata(mesh.points, mesh.triangles);
}

inline vtkSmartPointer<vtkUnstructuredGrid> data_of(const TetMesh& mesh)
{
  return to_unstructured_grid(mesh.points, mesh.tets);
}

/// Return a handle dataset at rest in which every handle has mode full. Methods that compute
/// rotations must keep the whole transform of a handle with mode full.
inline vtkSmartPointer<vtkPolyData> to_polydata_with_mode_full(const Handles& handles)
{
  const vtkSmartPointer<vtkPolyData> data = to_polydata(handles);
  Handles list;
  std::vector<Index> cells;
  EXPECT_TRUE(to_handles(data, list, &cells).ok());
  Pose rest(list.size());
  for (HandlePose& handle : rest)
  {
    handle.mode = HandleMode::full;
  }
  set_pose(data, cells, rest);
  return data;
}

} // namespace bindpose::test

#endif
