// ShadedSurface computes normals for shading. Sharp edges stay sharp, and smooth regions stay
// smooth. If the points move, the normals are updated.
#include "conversion.h"
#include "shapes/shaded_surface.h"
#include "support/meshes.h"

#include "vtkCellData.h"
#include "vtkCleanPolyData.h"
#include "vtkCubeSource.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
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
  // A rigid motion rotates the normals. It does not change which edges are sharp.
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).matrix();
  Points moved = mesh.points * rotation.transpose();
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
    const Vec3 position(surface.polydata()->GetPoint(v));
    EXPECT_EQ(position, moved.row(surface.input_points()[v]).transpose());
    Vec3 n;
    surface.polydata()->GetPointData()->GetNormals()->GetTuple(v, n.data());
    EXPECT_LT((n - rotation * before[v]).norm(), 1e-5);
  }
}

namespace
{
/// Return a box of quads with arrays that number its faces and corners.
vtkSmartPointer<vtkPolyData> numbered_box(double first)
{
  vtkNew<vtkCubeSource> source;
  source->Update();
  vtkNew<vtkCleanPolyData> joined; // the shaded surface splits the points again at sharp edges
  joined->SetInputConnection(source->GetOutputPort());
  joined->Update();
  auto box = vtkSmartPointer<vtkPolyData>::New();
  box->CopyStructure(joined->GetOutput());
  vtkNew<vtkDoubleArray> heights, sides;
  heights->SetName("Heights");
  for (vtkIdType v = 0; v < box->GetNumberOfPoints(); ++v)
  {
    heights->InsertNextValue(first + static_cast<double>(v));
  }
  sides->SetName("Sides");
  for (vtkIdType c = 0; c < box->GetNumberOfCells(); ++c)
  {
    sides->InsertNextValue(first + static_cast<double>(c));
  }
  box->GetPointData()->AddArray(heights);
  box->GetCellData()->AddArray(sides);
  return box;
}

double value_at(vtkDataSetAttributes* data, const char* name, vtkIdType i)
{
  return data->GetArray(name)->GetComponent(i, 0);
}
} // namespace

TEST(ShadedSurface, CarriesArraysOfPointsAndCells)
{
  const auto box = numbered_box(10.0);
  const ShadedSurface shaded(box);
  vtkPolyData* drawn = shaded.polydata();
  ASSERT_EQ(drawn->GetNumberOfPoints(), 24);
  ASSERT_EQ(drawn->GetNumberOfPolys(), 12);
  for (vtkIdType v = 0; v < 24; ++v)
  {
    EXPECT_EQ(value_at(drawn->GetPointData(), "Heights", v), 10.0 + shaded.input_points()[v]);
  }
  for (Index t = 0; t < 12; ++t)
  {
    // Find the face of the box that contains the corners of the triangle.
    vtkNew<vtkIdList> corners;
    const auto side = static_cast<vtkIdType>(value_at(drawn->GetCellData(), "Sides", t) - 10.0);
    box->GetCellPoints(side, corners);
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_GE(corners->IsId(shaded.input_points()[shaded.triangles()(t, k)]), 0);
    }
  }
}

TEST(ShadedSurface, TakesOtherArraysOfTheSameMeshAndGoesBackToRest)
{
  const auto box = numbered_box(10.0);
  ShadedSurface shaded(box);
  const ShadedSurface untouched(box);
  const auto other = vtkSmartPointer<vtkPolyData>::New();
  other->CopyStructure(box);
  other->GetPointData()->ShallowCopy(numbered_box(50.0)->GetPointData());
  EXPECT_TRUE(shaded.has_same_mesh(other));
  EXPECT_FALSE(shaded.has_same_mesh(numbered_box(10.0))) << "equal, but not the same";
  const Points larger = 2.0 * to_points(box).view();
  shaded.move(larger);
  shaded.set_arrays(other);
  vtkPolyData* drawn = shaded.polydata();
  EXPECT_FALSE(drawn->GetCellData()->HasArray("Sides"));
  for (vtkIdType v = 0; v < drawn->GetNumberOfPoints(); ++v)
  {
    EXPECT_EQ(value_at(drawn->GetPointData(), "Heights", v), 50.0 + shaded.input_points()[v]);
    EXPECT_EQ(Vec3(drawn->GetPoint(v)), Vec3(untouched.polydata()->GetPoint(v)));
    EXPECT_EQ(Vec3(drawn->GetPointData()->GetNormals()->GetTuple3(v)),
      Vec3(untouched.polydata()->GetPointData()->GetNormals()->GetTuple3(v)));
  }
}

namespace
{
/// Give every triangle in `apart` vertices of its own, at the same positions.
TriangleMesh with_seams(const TriangleMesh& mesh, const std::vector<Index>& apart)
{
  TriangleMesh result = mesh;
  for (const Index t : apart)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Index v = result.points.rows();
      result.points.conservativeResize(v + 1, 3);
      result.points.row(v) = mesh.points.row(mesh.triangles(t, k));
      result.triangles(t, k) = v;
    }
  }
  return result;
}

/// Return the normal that is drawn at a corner of a triangle.
Vec3 corner_normal(const ShadedSurface& surface, Index triangle, int corner)
{
  Vec3 normal;
  surface.polydata()->GetPointData()->GetNormals()->GetTuple(
    surface.triangles()(triangle, corner), normal.data());
  return normal;
}
} // namespace

TEST(ShadedSurface, SeamsDoNotChangeNormals)
{
  const TriangleMesh mesh = test::join(test::cube(), test::sphere(2, 1.0, Vec3(3, 0, 0)));
  std::vector<Index> some, all;
  for (Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    all.push_back(t);
    if (t % 5 < 2)
    {
      some.push_back(t);
    }
  }
  const Points bent =
    mesh.points.array() + 0.2 * mesh.points.col(1).array().square().replicate(1, 3);
  ShadedSurface whole(to_polydata(mesh.points, mesh.triangles));
  whole.move(bent);
  for (const std::vector<Index>& apart : { some, all })
  {
    const TriangleMesh seams = with_seams(mesh, apart);
    ShadedSurface surface(to_polydata(seams.points, seams.triangles));
    Points moved =
      seams.points.array() + 0.2 * seams.points.col(1).array().square().replicate(1, 3);
    surface.move(moved);
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
    {
      for (int k = 0; k < 3; ++k)
      {
        EXPECT_LT((corner_normal(surface, t, k) - corner_normal(whole, t, k)).norm(), 1e-6);
        EXPECT_EQ(surface.input_points()[surface.triangles()(t, k)], seams.triangles(t, k));
      }
    }
  }
}

TEST(ShadedSurface, CoincidentSurfacesWithOppositeOrientationShareNoNormals)
{
  // A part of a sphere, and the same part inside out. Their boundaries are at the same position.
  TriangleMesh sphere = test::sphere(2);
  sphere.triangles.conservativeResize(sphere.triangles.rows() / 2, 3);
  TriangleMesh both = test::join(sphere, sphere);
  both.triangles.bottomRows(sphere.triangles.rows())
    .col(0)
    .swap(both.triangles.bottomRows(sphere.triangles.rows()).col(1));
  const ShadedSurface surface(to_polydata(both.points, both.triangles));
  for (vtkIdType v = 0; v < surface.polydata()->GetNumberOfPoints(); ++v)
  {
    const Vec3 normal(surface.polydata()->GetPointData()->GetNormals()->GetTuple3(v));
    const Vec3 position(surface.polydata()->GetPoint(v));
    const double side = surface.input_points()[v] < sphere.points.rows() ? 1.0 : -1.0;
    EXPECT_GT(side * normal.dot(position), 0.8);
  }
}

TEST(ShadedSurface, SharesArraysWhereNoPointIsDoubled)
{
  const TriangleMesh sphere = test::sphere(3);
  const auto surface = to_polydata(sphere.points, sphere.triangles);
  vtkNew<vtkDoubleArray> heights;
  heights->SetName("Heights");
  heights->SetNumberOfValues(surface->GetNumberOfPoints());
  heights->Fill(1.0);
  surface->GetPointData()->AddArray(heights);
  const ShadedSurface shaded(surface);
  EXPECT_EQ(shaded.polydata()->GetPointData()->GetArray("Heights"), heights);
  EXPECT_FALSE(surface->GetPointData()->HasArray("Normals")) << "the input stays as it is";
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
