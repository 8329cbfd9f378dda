// tetrahedralize() inserts vertices at handles inside of the surface: at point handles, along
// bones, and on cage faces.
#include "inside/tetrahedralize.h"

#include "core/inside/tet_outcome.h"
#include "support/meshes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace bindpose;
using test::Cdt;
using test::expect_valid;
using test::handle_elements_of;
using test::run;
using Outcome = test::TetOutcome;
using testing::HasSubstr;

namespace
{
/// Return the positions of the vertices on the segment between two points, as sorted fractions of
/// its length.
std::vector<double> parameters_on_segment(const Points& points, const Vec3& a, const Vec3& b)
{
  std::vector<double> at;
  for (Index v = 0; v < points.rows(); ++v)
  {
    const Vec3 d = points.row(v).transpose() - a;
    const double t = d.dot(b - a) / (b - a).squaredNorm();
    if (t > -1e-9 && t < 1.0 + 1e-9 && (d - t * (b - a)).norm() < 1e-9)
    {
      at.push_back(t);
    }
  }
  std::sort(at.begin(), at.end());
  return at;
}
} // namespace

TEST_F(Cdt, PointsOfHandlesBecomeVertices)
{
  const TriangleMesh ball = test::sphere(3);
  TetrahedralizeOptions options;
  options.method = TetMethod::cdt;
  // The handles are inside, at a vertex of the surface, outside, and at the center of a triangle.
  const Vec3 vertex = ball.points.row(7);
  const Vec3 middle =
    (ball.points.row(ball.triangles(5, 0)) + ball.points.row(ball.triangles(5, 1)) +
      ball.points.row(ball.triangles(5, 2)))
      .transpose() /
    3.0;
  options.handles = handle_elements_of({ Vec3(0.1, 0.2, 0.3), vertex, Vec3(2, 0, 0), middle });
  const Outcome outcome = run(ball, options);
  expect_valid(outcome, ball);
  const auto& found = outcome.result.handle_vertices;
  ASSERT_EQ(found.size(), 4u);
  ASSERT_GE(found[0], 0);
  EXPECT_EQ(Vec3(outcome.result.mesh.points.row(found[0])), Vec3(0.1, 0.2, 0.3));
  ASSERT_GE(found[1], 0);
  EXPECT_EQ(outcome.result.original_vertices[found[1]], 7);
  EXPECT_EQ(found[2], -1);
  EXPECT_EQ(found[3], -1) << "the surface's triangles stay as they are";
  EXPECT_EQ(outcome.number("counts.handle_points"), 4);
  EXPECT_EQ(outcome.number("counts.handle_vertices"), 2);
  EXPECT_NEAR(outcome.volume(), signed_volume(ball.points, ball.triangles), 1e-12);
  EXPECT_EQ(boundary_triangles(outcome.result.mesh.tets).rows(), ball.triangles.rows());
}

TEST_F(Cdt, BonesAndCagesGetVerticesAtTheLocalEdgeLength)
{
  const TriangleMesh ball = test::sphere(4);
  const Vec3 head(-0.6, 0.05, 0.02), tail(0.6, -0.03, 0.01);
  const Vec3 a(-0.3, 0.3, 0.2), b(0.4, 0.35, 0.25), c(0.1, -0.1, 0.5);
  TetrahedralizeOptions options;
  options.method = TetMethod::cdt;
  options.interior_edge = 0.04;
  options.handles = handle_elements_of({ head, tail, a, b, c });
  options.handles.segments.resize(1, 2);
  options.handles.segments << 0, 1;
  options.handles.triangles.resize(1, 3);
  options.handles.triangles << 2, 3, 4;
  const Outcome outcome = run(ball, options);
  expect_valid(outcome, ball);
  const TetMesh& mesh = outcome.result.mesh;
  const std::vector<double> on = parameters_on_segment(mesh.points, head, tail);
  ASSERT_GE(on.size(), 8u);
  EXPECT_NEAR(on.front(), 0.0, 1e-12);
  EXPECT_NEAR(on.back(), 1.0, 1e-12);
  const double largest = options.interior_edge * bounding_box(ball.points).diagonal();
  for (std::size_t i = 1; i < on.size(); ++i)
  {
    EXPECT_LT((on[i] - on[i - 1]) * (tail - head).norm(), 1.01 * largest);
  }
  // Every point of the cage's face is near a mesh vertex on the face.
  std::vector<Vec3> face;
  const Vec3 normal = (b - a).cross(c - a).normalized();
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    const Vec3 p = mesh.points.row(v);
    if (std::abs((p - a).dot(normal)) < 1e-9)
    {
      face.push_back(p);
    }
  }
  for (int i = 0; i <= 10; ++i)
  {
    for (int j = 0; i + j <= 10; ++j)
    {
      const Vec3 p = a + 0.1 * i * (b - a) + 0.1 * j * (c - a);
      double nearest = 1e9;
      for (const Vec3& q : face)
      {
        nearest = std::min(nearest, (p - q).norm());
      }
      EXPECT_LT(nearest, largest);
    }
  }
}

TEST_F(Cdt, HandlesNeedNoRefinement)
{
  TetrahedralizeOptions options;
  options.method = TetMethod::cdt;
  options.bare = true;
  options.handles = handle_elements_of({ Vec3(0.1, 0.0, 0.2) });
  const Outcome outcome = run(test::cube(), options);
  expect_valid(outcome, test::cube());
  EXPECT_EQ(outcome.result.mesh.points.rows(), 9);
  EXPECT_EQ(outcome.result.handle_vertices, std::vector<Index>{ 8 });
  EXPECT_NEAR(outcome.volume(), 8.0, 1e-12);
}

TEST(Tetrahedralize, BadHandlesAreRefused)
{
  TetrahedralizeOptions options;
  options.handles = handle_elements_of({ Vec3(0, 0, std::numeric_limits<double>::quiet_NaN()) });
  EXPECT_THAT(run(test::cube(), options).status.message, HasSubstr("not finite"));
  options.handles = handle_elements_of({ Vec3::Zero() });
  options.handles.segments.resize(1, 2);
  options.handles.segments << 0, 1;
  const Outcome outcome = run(test::cube(), options);
  EXPECT_EQ(outcome.status.code, StatusCode::invalid_input);
  EXPECT_THAT(outcome.status.message, HasSubstr("handle segment 0 references point 1"));
}
