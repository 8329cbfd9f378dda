// Sharp edges stay sharp, smooth places smooth, and a moved surface is the one made anew.
#include "conversion.h"
#include "scene/shaded_surface.h"
#include "support/meshes.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace bindpose;

TEST(ShadedSurface, CubeHasFlatSidesAndSphereHasNoSeams)
{
  const TriangleMesh cube = test::cube();
  const ShadedSurface sharp(to_polydata(cube.points, cube.triangles));
  EXPECT_EQ(sharp.polydata()->GetNumberOfPoints(), 24);
  vtkDataArray* normals = sharp.polydata()->GetPointData()->GetNormals();
  for (vtkIdType v = 0; v < 24; ++v)
  {
    Vec3 n;
    normals->GetTuple(v, n.data());
    EXPECT_NEAR(n.cwiseAbs().maxCoeff(), 1.0, 1e-6);
    EXPECT_GT(n.dot(Vec3(sharp.polydata()->GetPoint(v))), 0.0) << "outwards";
  }
  const TriangleMesh sphere = test::sphere(3);
  const ShadedSurface smooth(to_polydata(sphere.points, sphere.triangles));
  ASSERT_EQ(smooth.polydata()->GetNumberOfPoints(), sphere.points.rows());
  normals = smooth.polydata()->GetPointData()->GetNormals();
  for (vtkIdType v = 0; v < sphere.points.rows(); ++v)
  {
    Vec3 n;
    normals->GetTuple(v, n.data());
    EXPECT_GT(n.dot(Vec3(smooth.polydata()->GetPoint(v))), 0.999);
  }
}

TEST(ShadedSurface, MovesAsTheInputDoes)
{
  const TriangleMesh mesh = test::join(test::cube(), test::sphere(2, 1.0, Vec3(3, 0, 0)));
  ShadedSurface surface(to_polydata(mesh.points, mesh.triangles));
  // A rigid motion turns normals along; it is not a new decision on edges.
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).matrix();
  Points moved = mesh.points * turn.transpose();
  moved.rowwise() += Eigen::RowVector3d(5, 6, 7);
  std::vector<Vec3> before;
  for (vtkIdType v = 0; v < surface.polydata()->GetNumberOfPoints(); ++v)
  {
    before.emplace_back();
    surface.polydata()->GetPointData()->GetNormals()->GetTuple(v, before.back().data());
  }
  const vtkMTimeType time = surface.polydata()->GetMTime();
  surface.move(moved);
  EXPECT_GT(surface.polydata()->GetMTime(), time);
  for (vtkIdType v = 0; v < surface.polydata()->GetNumberOfPoints(); ++v)
  {
    const Vec3 place(surface.polydata()->GetPoint(v));
    EXPECT_EQ(place, moved.row(surface.input_points()[v]).transpose());
    Vec3 n;
    surface.polydata()->GetPointData()->GetNormals()->GetTuple(v, n.data());
    EXPECT_LT((n - turn * before[v]).norm(), 1e-5);
  }
}

TEST(ShadedSurface, DegenerateTrianglesAndNothingAreHarmless)
{
  TriangleMesh mesh = test::cube();
  mesh.triangles.row(0).setConstant(3);
  const ShadedSurface surface(to_polydata(mesh.points, mesh.triangles));
  vtkDataArray* normals = surface.polydata()->GetPointData()->GetNormals();
  for (vtkIdType v = 0; v < normals->GetNumberOfTuples(); ++v)
  {
    Vec3 n;
    normals->GetTuple(v, n.data());
    EXPECT_NEAR(n.norm(), 1.0, 1e-6);
  }
  const auto empty = vtkSmartPointer<vtkPolyData>::New();
  EXPECT_EQ(ShadedSurface(empty).polydata()->GetNumberOfPoints(), 0);
}
