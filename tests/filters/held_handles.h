#ifndef bindpose_tests_held_handles_h
#define bindpose_tests_held_handles_h

#include "conversion.h"
#include "pose/pose.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

namespace bindpose::test
{

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
