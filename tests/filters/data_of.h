#ifndef bindpose_tests_filters_data_of_h
#define bindpose_tests_filters_data_of_h

// Conversion of meshes to VTK datasets.

#include "conversion.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

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

} // namespace bindpose::test

#endif
