#ifndef bindpose_tests_viewer_app_columns_h
#define bindpose_tests_viewer_app_columns_h

// A column along z and weights that are linear along z.

#include "conversion.h"
#include "support/meshes.h"

#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

namespace bindpose::test
{

/// Return a column from z = -1 to 1. The tests put a point handle at each end.
inline TriangleMesh column(int levels)
{
  TriangleMesh mesh = sphere(levels);
  mesh.points.col(0) *= 0.4;
  mesh.points.col(1) *= 0.4;
  return mesh;
}

/// Add the array Weights to a shape that extends from z = -1 to 1. The first weight is 1 at the
/// lower end, the second weight is 1 at the upper end.
inline void add_linear_weights(vtkDataSet* data)
{
  vtkNew<vtkDoubleArray> weights;
  weights->SetName("Weights");
  weights->SetNumberOfComponents(2);
  for (vtkIdType v = 0; v < data->GetNumberOfPoints(); ++v)
  {
    const double height_fraction = 0.5 * (1.0 + data->GetPoint(v)[2]);
    weights->InsertNextTuple2(1.0 - height_fraction, height_fraction);
  }
  data->GetPointData()->AddArray(weights);
}

inline vtkSmartPointer<vtkPolyData> with_linear_weights(const TriangleMesh& mesh)
{
  const auto data = to_polydata(mesh.points, mesh.triangles);
  add_linear_weights(data);
  return data;
}

} // namespace bindpose::test

#endif
