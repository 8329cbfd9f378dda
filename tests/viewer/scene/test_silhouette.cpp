// Silhouettes are compared with the known results for convex shapes, and with a brute-force
// computation that tests both triangles of every edge.
#include "shapes/silhouette.h"

#include "shapes/outline.h"
#include "shapes/shaded_surface.h"

#include "conversion.h"
#include "support/meshes.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

using namespace bindpose;

namespace
{
std::vector<Silhouette::Edge> silhouette_edges(const TriangleMesh& mesh, const Eye& eye)
{
  Silhouette silhouette(mesh.points, mesh.triangles);
  std::vector<Silhouette::Edge> edges;
  silhouette.find(mesh.points, eye, edges);
  return edges;
}

/// Return the edges as pairs of points, with the lower id first.
std::set<std::pair<Index, Index>> as_set(const std::vector<Silhouette::Edge>& edges)
{
  std::set<std::pair<Index, Index>> result;
  for (const Silhouette::Edge& edge : edges)
  {
    EXPECT_TRUE(result.emplace(std::min(edge[0], edge[1]), std::max(edge[0], edge[1])).second);
  }
  return result;
}

bool faces_eye(const TriangleMesh& mesh, Index t, const Eye& eye)
{
  const auto corner = [&](int k) { return Vec3(mesh.points.row(mesh.triangles(t, k))); };
  const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
  return normal.dot(eye.parallel ? Vec3(-eye.direction) : Vec3(eye.position - corner(0))) >= 0.0;
}

/// Return the silhouette, computed by brute force: all edges between a triangle that faces the eye
/// and a triangle that does not. The surface must be consistently oriented, with two triangles per
/// edge.
std::set<std::pair<Index, Index>> brute_force_silhouette(const TriangleMesh& mesh, const Eye& eye)
{
  std::map<std::pair<Index, Index>, std::set<bool>> facing;
  for (Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Index a = mesh.triangles(t, k), b = mesh.triangles(t, (k + 1) % 3);
      facing[{ std::min(a, b), std::max(a, b) }].insert(faces_eye(mesh, t, eye));
    }
  }
  std::set<std::pair<Index, Index>> result;
  for (const auto& [edge, ways] : facing)
  {
    if (ways.size() == 2)
    {
      result.insert(edge);
    }
  }
  return result;
}

Eye eye_at(const Vec3& position)
{
  Eye eye;
  eye.position = position;
  return eye;
}
} // namespace

TEST(Silhouette, OfASphereIsTheCircleThatTheEyeSees)
{
  const TriangleMesh ball = test::sphere(5);
  const double distance = 3.0;
  const auto edges = silhouette_edges(ball, eye_at(Vec3(0, 0, distance)));
  ASSERT_FALSE(edges.empty());
  double length = 0.0;
  for (const Silhouette::Edge& edge : edges)
  {
    for (const Index end : edge)
    {
      // The silhouette is at the height z at which tangents of the sphere pass through the eye.
      EXPECT_NEAR(ball.points(end, 2), 1.0 / distance, 0.05);
    }
    length += (ball.points.row(edge[0]) - ball.points.row(edge[1])).norm();
  }
  const double circle = 2.0 * EIGEN_PI * std::sqrt(1.0 - 1.0 / (distance * distance));
  EXPECT_GT(length, circle); // the silhouette zigzags along mesh edges
  EXPECT_LT(length, 1.5 * circle);
}

TEST(Silhouette, IsThatOfATwin)
{
  const TriangleMesh ring = test::torus(40, 20, 1.0, 0.4);
  for (int k = 0; k < 20; ++k)
  {
    const Eye eye = eye_at(Vec3(3.0 * std::cos(k), 2.0 * std::sin(2.0 * k), 0.3 * k - 3.0));
    EXPECT_EQ(as_set(silhouette_edges(ring, eye)), brute_force_silhouette(ring, eye)) << k;
  }
  Eye along;
  along.parallel = true;
  along.direction = Vec3(0.3, -0.5, -0.8).normalized();
  const auto edges = as_set(silhouette_edges(ring, along));
  EXPECT_EQ(edges, brute_force_silhouette(ring, along));
  along.position = Vec3(100, 100, 100); // in a parallel view the position has no effect
  EXPECT_EQ(as_set(silhouette_edges(ring, along)), edges);
}

TEST(Silhouette, DoesNotDependOnHowTrianglesAreTurnedOrParted)
{
  const TriangleMesh ring = test::torus(40, 20, 1.0, 0.4);
  const Eye eye = eye_at(Vec3(2.0, -3.0, 1.5));
  const auto expected = as_set(silhouette_edges(ring, eye));
  TriangleMesh turned = ring;
  for (Index t = 0; t < turned.triangles.rows(); t += 3)
  {
    std::swap(turned.triangles(t, 0), turned.triangles(t, 1));
  }
  EXPECT_EQ(as_set(silhouette_edges(turned, eye)), expected);
  const TriangleMesh soup = test::unwelded(ring);
  EXPECT_EQ(silhouette_edges(soup, eye).size(), expected.size());
}

TEST(Silhouette, OpenEdgesAreAlwaysThere)
{
  const TriangleMesh sheet = test::grid(4, 3);
  const auto edges = silhouette_edges(sheet, eye_at(Vec3(0.3, 0.2, 5.0)));
  // The silhouette consists of all boundary edges of the sheet.
  EXPECT_EQ(edges.size(), 14u);
  Silhouette nothing(Points(0, 3), Triangles(0, 3));
  std::vector<Silhouette::Edge> none = edges;
  nothing.find(Points(0, 3), Eye(), none);
  EXPECT_TRUE(none.empty());
  // Add a triangle without area, and an edge with three triangles. Both must be harmless.
  TriangleMesh bad = sheet;
  bad.triangles.conservativeResize(bad.triangles.rows() + 2, 3);
  bad.triangles.bottomRows(2) << 0, 0, 1, 0, 1, 7;
  EXPECT_GE(silhouette_edges(bad, eye_at(Vec3(0.3, 0.2, 5.0))).size(), 14u);
}

TEST(Outline, FollowsShapeAndView)
{
  const TriangleMesh cube = test::cube();
  // The points of the shaded surface are doubled at the sharp edges of the cube.
  ShadedSurface shape(to_polydata(cube.points, cube.triangles));
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetSize(200, 200);
  window->AddRenderer(renderer);
  Outline outline(renderer);
  outline.set_shape(&shape);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(0, 0, 10);
  window->Render();
  EXPECT_TRUE(outline.edges().empty()); // the outline is hidden
  outline.show(true, 2.0);
  window->Render();
  EXPECT_EQ(outline.edges().size(), 4u); // these are the edges of the front face
  camera->SetPosition(6, 7, 8);
  window->Render();
  EXPECT_EQ(outline.edges().size(), 6u); // viewed from a corner
  shape.move(Points(cube.points * 100.0)); // the eye is now inside, so it is behind all faces
  window->Render();
  EXPECT_TRUE(outline.edges().empty());
  outline.set_shape(nullptr);
  window->Render();
}

TEST(Silhouette, IsCheap)
{
  const TriangleMesh ring = test::torus(430, 100, 1.0, 0.4); // 86,000 triangles
  const auto start = std::chrono::steady_clock::now();
  Silhouette silhouette(ring.points, ring.triangles);
  const auto made = std::chrono::steady_clock::now();
  std::vector<Silhouette::Edge> edges;
  constexpr int times = 20;
  for (int k = 0; k < times; ++k)
  {
    silhouette.find(ring.points, eye_at(Vec3(3, 0.1 * k, 2)), edges);
  }
  const auto end = std::chrono::steady_clock::now();
  const std::chrono::duration<double, std::milli> first = made - start, each = end - made;
  std::printf("silhouette of %d triangles: %.1f ms once, %.2f ms a picture, %d edges\n",
    static_cast<int>(ring.triangles.rows()), first.count(), each.count() / times,
    static_cast<int>(edges.size()));
  EXPECT_LT(each.count() / times, 20.0); // limit in milliseconds for a busy machine
}
