// Comparison of inside tests with VTK's vtkSelectEnclosedPoints. Both filters get the same surfaces
// and points, and the ground truth is independent of both. Bindpose must be right at every point.
// For VTK's filter the test asserts only results that do not depend on its random rays, and prints
// the number of its errors.
//
// Measured with VTK 9.1 and the default tolerance, vtkSelectEnclosedPoints gives these results:
// - It is right on spheres, cubes, rings and single thin plates, also near the surface.
// - It is right on a sphere with a small hole if CheckSurface is off.
// - It is wrong at 46 and 5762 of 20000 points among 200 closed plates of thickness 2e-3 and 2e-4,
// respectively. At thickness 2e-3, 52 of 10000 results depend on the other points of the query.
// - It is wrong at all points that are inside two components.
// - It refuses open surfaces if CheckSurface is on.
// With PyVista's tolerance of 1e-3 it is wrong at 3 of 23822 points around closed real surfaces
// (compare PyVista's issues 4240, 8133 and 2973).
#include "TestFilter.h"

#include "conversion.h"
#include "surface/triangle_predicates.h"
#include "winding/winding_number.h"
#include "support/demo_meshes.h"
#include "support/meshes.h"
#include "vtkWindingNumberField.h"

#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSelectEnclosedPoints.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <sstream>
#include <string>

using namespace bindpose;
using bindpose::test::Listener;

namespace
{
enum Truth
{
  outside,
  inside,
  unknown ///< the point is too close to the surface for a ground truth
};

/// Return the query points as the input dataset of both filters.
vtkSmartPointer<vtkPolyData> query_data(const Points& points)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(to_vtk_points(points));
  return data;
}

/// Return Bindpose's result for each point: 1 inside, 0 outside.
vtkSmartPointer<vtkDataArray> inside_by_bindpose(
  const TriangleMesh& mesh, const Points& points, bool orient = false)
{
  vtkNew<vtkWindingNumberField> field;
  field->SetInputData(to_polydata(mesh.points, mesh.triangles));
  field->SetPointsData(query_data(points));
  field->SetOrientPatches(orient);
  field->ComputeInsideOn();
  field->Update();
  EXPECT_EQ(field->GetStatus(), vtkBindposeAlgorithm::OK) << field->GetStatusMessage();
  return vtkDataSet::SafeDownCast(field->GetOutput())->GetPointData()->GetArray("Inside");
}

/// Return the result of VTK's filter for each point (1 inside, 0 outside), or null if the filter
/// refuses the surface. The tolerance is in bounding-box diagonals. Its default equals that of VTK;
/// PyVista uses 1e-3.
vtkSmartPointer<vtkDataArray> inside_by_vtk(
  const TriangleMesh& mesh, const Points& points, bool check_surface, double tolerance = 1e-4)
{
  vtkNew<vtkSelectEnclosedPoints> select;
  vtkNew<Listener> listener;
  listener->listen(select);
  select->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, listener);
  select->SetInputData(query_data(points));
  select->SetSurfaceData(to_polydata(mesh.points, mesh.triangles));
  select->SetCheckSurface(check_surface);
  select->SetTolerance(tolerance);
  select->Update();
  return select->GetOutput()->GetPointData()->GetArray("SelectedPoints");
}

struct Mismatches
{
  Index bindpose = 0, vtk = 0, points = 0;
};

/// Compare both filters with the ground truth.
Mismatches compare(const std::string& name, const TriangleMesh& mesh, const Points& points,
  const std::function<Truth(const Vec3&)>& truth, bool orient = false, double tolerance = 1e-4)
{
  const auto by_bindpose = inside_by_bindpose(mesh, points, orient);
  const auto by_vtk = inside_by_vtk(mesh, points, false, tolerance);
  Mismatches mismatches;
  for (Index i = 0; i < points.rows(); ++i)
  {
    const Truth expected = truth(points.row(i));
    if (expected != unknown)
    {
      ++mismatches.points;
      mismatches.bindpose += by_bindpose->GetTuple1(i) != (expected == inside ? 1.0 : 0.0);
      mismatches.vtk += !by_vtk || by_vtk->GetTuple1(i) != (expected == inside ? 1.0 : 0.0);
    }
  }
  std::cout << "[ facts ] " << name << ", " << mismatches.points
            << " points: " << mismatches.bindpose << " wrong by vtkWindingNumberField, "
            << mismatches.vtk << " by vtkSelectEnclosedPoints\n";
  return mismatches;
}

/// Return a lattice of n^3 points on [lower, upper]^3.
Points lattice(Index n, double lower, double upper)
{
  Points points(n * n * n, 3);
  const double step = (upper - lower) / static_cast<double>(n - 1);
  for (Index i = 0; i < points.rows(); ++i)
  {
    points.row(i) << lower + step * static_cast<double>(i % n),
      lower + step * static_cast<double>(i / n % n), lower + step * static_cast<double>(i / n / n);
  }
  return points;
}

Points random_queries(Index count, double size)
{
  test::Random random(17);
  Points points(count, 3);
  for (Index i = 0; i < count; ++i)
  {
    points.row(i) = random.in_box(Vec3::Constant(-size), Vec3::Constant(size)).transpose();
  }
  return points;
}

/// Return the ground truth for a convex surface: a point is inside if it is behind the planes of
/// all triangles.
std::function<Truth(const Vec3&)> behind_all_planes(const TriangleMesh& mesh)
{
  return [mesh](const Vec3& p)
  {
    double highest = -1e300;
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
    {
      const Vec3 a = mesh.points.row(mesh.triangles(t, 0));
      const Vec3 b = mesh.points.row(mesh.triangles(t, 1));
      const Vec3 c = mesh.points.row(mesh.triangles(t, 2));
      highest = std::max(highest, (b - a).cross(c - a).normalized().dot(p - a));
    }
    return std::abs(highest) < 1e-9 ? unknown : highest < 0.0 ? inside : outside;
  };
}

Truth in_ball(const Vec3& p, const Vec3& center, double radius, double unsure)
{
  const double height = (p - center).norm() - radius;
  return std::abs(height) < unsure ? unknown : height < 0.0 ? inside : outside;
}

/// Number of closed plates of size 2 x 2 x thickness, distributed evenly from z = -1 to 1.
constexpr int plates = 200;
TriangleMesh stack_of_plates(double thickness)
{
  TriangleMesh plate = test::cube(), stack;
  plate.points.col(2) *= 0.5 * thickness;
  for (int i = 0; i < plates; ++i)
  {
    stack = test::join(stack, test::translated(plate, Vec3(0, 0, -1.0 + 2.0 * (i + 0.5) / plates)));
  }
  return stack;
}

Truth in_plates(double thickness, const Vec3& p)
{
  const double layer = std::clamp(std::floor(0.5 * plates * (p.z() + 1.0)), 0.0, plates - 1.0);
  const double across = std::abs(p.z() - (-1.0 + 2.0 * (layer + 0.5) / plates));
  const double height =
    std::max({ std::abs(p.x()), std::abs(p.y()), across / (0.5 * thickness) }) - 1.0;
  return std::abs(height) < 1e-6 ? unknown : height < 0.0 ? inside : outside;
}

/// Remove the triangles whose centers are close to a direction from the origin. `cosine` is the
/// cosine of the largest angle between this direction and a removed center.
TriangleMesh with_hole(TriangleMesh mesh, const Vec3& direction, double cosine)
{
  Index kept = 0;
  for (Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    const Vec3 middle = mesh.points.row(mesh.triangles(t, 0)) +
      mesh.points.row(mesh.triangles(t, 1)) + mesh.points.row(mesh.triangles(t, 2));
    if (middle.normalized().dot(direction) < cosine)
    {
      mesh.triangles.row(kept++) = mesh.triangles.row(t).eval();
    }
  }
  mesh.triangles.conservativeResize(kept, 3);
  return mesh;
}
} // namespace

TEST(SelectEnclosedPoints, ClosedManifoldSurfaces)
{
  const TriangleMesh ball = test::sphere(3);
  const auto in_sphere = behind_all_planes(ball);
  EXPECT_EQ(
    compare("sphere, random points", ball, random_queries(30000, 1.2), in_sphere).bindpose, 0);
  EXPECT_EQ(compare("sphere, lattice", ball, lattice(33, -1.2, 1.2), in_sphere).bindpose, 0);

  // Rays through a cube made of small squares hit many edges and vertices.
  TriangleMesh box;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const bool upper : { false, true })
    {
      const TriangleMesh sheet = test::translated(test::grid(10, 10, 2.0, 2.0), Vec3(-1, -1, 0));
      TriangleMesh side = upper ? sheet : test::flipped(sheet);
      for (Index v = 0; v < side.points.rows(); ++v)
      {
        const Vec3 p = sheet.points.row(v);
        side.points(v, (axis + 1) % 3) = p.x();
        side.points(v, (axis + 2) % 3) = p.y();
        side.points(v, axis) = upper ? 1.0 : -1.0;
      }
      box = test::join(box, side);
    }
  }
  const auto in_box = [](const Vec3& p)
  {
    const double height = p.cwiseAbs().maxCoeff() - 1.0;
    return std::abs(height) < 1e-9 ? unknown : height < 0.0 ? inside : outside;
  };
  EXPECT_EQ(compare("cube, random points", box, random_queries(60000, 1.2), in_box).bindpose, 0);
  EXPECT_EQ(compare("cube, lattice", box, lattice(41, -1.2, 1.2), in_box).bindpose, 0);

  // The torus is made of polygons, which deviate from its circles by at most 1 - cos(pi / n).
  const TriangleMesh ring = test::torus(120, 60, 1.0, 0.4);
  const auto in_ring = [](const Vec3& p)
  {
    const double height = std::hypot(std::hypot(p.x(), p.y()) - 1.0, p.z()) - 0.4;
    return std::abs(height) < 2e-3 ? unknown : height < 0.0 ? inside : outside;
  };
  EXPECT_EQ(compare("ring, random points", ring, random_queries(60000, 1.5), in_ring).bindpose, 0);
  EXPECT_EQ(compare("ring, lattice", ring, lattice(41, -1.5, 1.5), in_ring).bindpose, 0);
}

TEST(SelectEnclosedPoints, StacksOfPlates)
{
  // Rays cross hundreds of plates. The distances between the faces of the plates are close to the
  // tolerance of VTK's filter.
  for (const double thickness : { 2e-3, 2e-4 })
  {
    std::ostringstream name;
    name << plates << " plates of " << thickness;
    EXPECT_EQ(compare(name.str(), stack_of_plates(thickness), random_queries(20000, 1.1),
                [=](const Vec3& p) { return in_plates(thickness, p); })
                .bindpose,
      0);
  }
}

TEST(SelectEnclosedPoints, ScannedAndModeledSurfaces)
{
  // These are closed manifold surfaces. The ground truth is the direct sum over all triangles.
  // Points closer to the surface than 1e-3 bounding-box diagonals are not compared.
  for (const char* name : { "cow.off", "femur.off", "anchor.off" })
  {
    const TriangleMesh mesh = test::demo_mesh(name);
    ASSERT_GT(mesh.triangles.rows(), 0);
    const Box box = bounding_box(mesh.points, mesh.triangles);
    Points points = lattice(20, -0.02, 1.02);
    for (Index i = 0; i < points.rows(); ++i)
    {
      points.row(i) =
        (box.lower + Vec3(points.row(i)).cwiseProduct(box.upper - box.lower)).transpose();
    }
    const double near = 1e-3 * box.diagonal();
    const auto truth = [&](const Vec3& p)
    {
      for (Index t = 0; t < mesh.triangles.rows(); ++t)
      {
        const auto corner = [&](int k) { return Vec3(mesh.points.row(mesh.triangles(t, k))); };
        if ((closest_point(p, corner(0), corner(1), corner(2)) - p).norm() < near)
        {
          return unknown;
        }
      }
      const double winding = winding_number_direct(mesh.points, mesh.triangles, p);
      EXPECT_NEAR(winding, std::round(winding), 1e-9);
      return winding > 0.5 ? inside : outside;
    };
    constexpr double of_pyvista = 1e-3;
    const Mismatches mismatches = compare(name, mesh, points, truth, false, of_pyvista);
    EXPECT_EQ(mismatches.bindpose, 0);
  }
}

TEST(SelectEnclosedPoints, PointsNearTheSurface)
{
  // The points are above and below the faces of a convex surface, at distances from 1e-2 down to
  // 1e-9.
  const TriangleMesh ball = test::sphere(3);
  for (const double height : { 1e-2, 1e-4, 1e-6, 1e-9 })
  {
    Points points(2 * ball.triangles.rows(), 3);
    for (Index t = 0; t < ball.triangles.rows(); ++t)
    {
      const Vec3 a = ball.points.row(ball.triangles(t, 0));
      const Vec3 b = ball.points.row(ball.triangles(t, 1));
      const Vec3 c = ball.points.row(ball.triangles(t, 2));
      const Vec3 up = height * (b - a).cross(c - a).normalized();
      points.row(2 * t) = ((a + b + c) / 3.0 + up).transpose();
      points.row(2 * t + 1) = ((a + b + c) / 3.0 - up).transpose();
    }
    Index asked = 0; // points above and below a face alternate
    const auto truth = [&](const Vec3&) { return asked++ % 2 == 0 ? outside : inside; };
    std::ostringstream name;
    name << "sphere, " << height << " off its faces";
    EXPECT_EQ(compare(name.str(), ball, points, truth).bindpose, 0);
  }
}

TEST(SelectEnclosedPoints, ThinPlate)
{
  // The plate is 2 x 2 x 2e-5. The distance between its two large faces is below the tolerance of
  // VTK's filter.
  TriangleMesh plate = test::cube();
  plate.points.col(2) *= 1e-5;
  Points points = random_queries(20000, 1.2);
  for (Index i = 0; i < points.rows(); ++i)
  {
    points(i, 2) *= i % 2 == 0 ? 2e-5 : 1.0;
  }
  const auto truth = [](const Vec3& p)
  {
    const double height =
      std::max({ std::abs(p.x()), std::abs(p.y()), 1e5 * std::abs(p.z()) }) - 1.0;
    return std::abs(height) < 1e-6 ? unknown : height < 0.0 ? inside : outside;
  };
  EXPECT_EQ(compare("plate", plate, points, truth).bindpose, 0);
}

TEST(SelectEnclosedPoints, OverlappingComponents)
{
  // A ray from a point inside of both balls crosses two surfaces, which is an even number. VTK's
  // filter therefore reports the point as outside.
  const Vec3 aside(0.5, 0.0, 0.0);
  const TriangleMesh ball = test::sphere(4);
  const TriangleMesh both =
    test::join(test::translated(ball, -aside), test::translated(ball, aside));
  const auto one = [&](const Vec3& p, double side) { return in_ball(p, side * aside, 1.0, 5e-3); };
  const auto in_union = [&](const Vec3& p)
  {
    const Truth left = one(p, -1.0), right = one(p, 1.0);
    return left == inside || right == inside ? inside
      : left == unknown || right == unknown  ? unknown
                                             : outside;
  };
  EXPECT_EQ(compare("two balls", both, random_queries(30000, 1.6), in_union).bindpose, 0);
  const auto in_both = [&](const Vec3& p)
  { return one(p, -1.0) == inside && one(p, 1.0) == inside ? inside : unknown; };
  const Mismatches overlap =
    compare("two balls, what they share", both, random_queries(30000, 1.6), in_both);
  EXPECT_EQ(overlap.bindpose, 0);
  EXPECT_GT(2 * overlap.vtk, overlap.points);

  // A cavity is a component of opposite orientation. Both filters report the inside of the cavity
  // as outside.
  const TriangleMesh hollow = test::join(ball, test::flipped(test::sphere(4, 0.5)));
  const auto in_shell = [&](const Vec3& p)
  {
    const Truth large = in_ball(p, Vec3::Zero(), 1.0, 5e-3);
    const Truth small = in_ball(p, Vec3::Zero(), 0.5, 5e-3);
    return large == unknown || small == unknown ? unknown
      : large == inside && small == outside     ? inside
                                                : outside;
  };
  EXPECT_EQ(
    compare("ball with a cavity", hollow, random_queries(30000, 1.2), in_shell).bindpose, 0);
}

TEST(SelectEnclosedPoints, FlippedSurfaces)
{
  // VTK's filter ignores orientations. The winding number inside of a flipped surface is -1.
  // Bindpose reports these points as inside only if OrientPatches is on.
  const TriangleMesh ball = test::sphere(3);
  const Points points = random_queries(20000, 1.2);
  const auto truth = behind_all_planes(ball);
  EXPECT_EQ(
    compare("sphere inside out, turned", test::flipped(ball), points, truth, true).bindpose, 0);
  const auto not_turned = inside_by_bindpose(test::flipped(ball), points);
  for (Index i = 0; i < points.rows(); ++i)
  {
    ASSERT_EQ(not_turned->GetTuple1(i), 0.0);
  }
  // Every seventh triangle is flipped, which makes no difference for VTK's filter.
  TriangleMesh mixed = ball;
  for (Index t = 0; t < mixed.triangles.rows(); t += 7)
  {
    std::swap(mixed.triangles(t, 0), mixed.triangles(t, 1));
  }
  EXPECT_EQ(compare("sphere with turned triangles", mixed, points, truth, true).bindpose, 0);
}

TEST(SelectEnclosedPoints, OpenSurfaces)
{
  // The radius of the hole is a tenth of the radius of the sphere. There is no ground truth for
  // points near the hole.
  const Vec3 up(0.0, 0.0, 1.0);
  const TriangleMesh open = with_hole(test::sphere(4), up, 0.995);
  const auto truth = [&](const Vec3& p)
  { return (p - up).norm() < 0.3 ? unknown : in_ball(p, Vec3::Zero(), 1.0, 5e-3); };
  const Points points = random_queries(30000, 1.2);
  EXPECT_EQ(compare("sphere with a hole", open, points, truth).bindpose, 0);
  EXPECT_NE(inside_by_vtk(test::sphere(4), points, true), nullptr);
  EXPECT_EQ(inside_by_vtk(open, points, true), nullptr) << "it no longer refuses open surfaces";
}

TEST(SelectEnclosedPoints, AnotherBatch)
{
  // The second query contains half of the points of the first query. Bindpose's result for a point
  // does not depend on the other points.
  const TriangleMesh stack = stack_of_plates(2e-3);
  const Points points = random_queries(20000, 1.1);
  const Points second = points.bottomRows(10000);
  const auto by_bindpose = inside_by_bindpose(stack, points),
             by_bindpose_again = inside_by_bindpose(stack, second);
  const auto by_vtk = inside_by_vtk(stack, points, false);
  const auto by_vtk_again = inside_by_vtk(stack, second, false);
  Index changed = 0;
  for (Index i = 0; i < 10000; ++i)
  {
    ASSERT_EQ(by_bindpose->GetTuple1(10000 + i), by_bindpose_again->GetTuple1(i));
    changed += by_vtk->GetTuple1(10000 + i) != by_vtk_again->GetTuple1(i);
  }
  std::cout << "[ facts ] plates, asked in another batch: " << changed
            << " of 10000 answers of vtkSelectEnclosedPoints changed\n";
}
