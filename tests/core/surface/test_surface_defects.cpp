// Defects of surfaces: every defect is found, and each is listed with its triangles or edges.
#include "surface/surface_defects.h"

#include "support/meshes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

using namespace bindpose;
using testing::ElementsAre;

namespace
{
struct Listed
{
  RepairedSurface repaired;
  std::vector<DefectOccurrence> places;

  std::vector<DefectOccurrence> of(Defect defect) const
  {
    std::vector<DefectOccurrence> some;
    for (const DefectOccurrence& place : this->places)
    {
      if (place.defect == defect)
      {
        some.push_back(place);
      }
    }
    return some;
  }
};

Listed listed(const TriangleMesh& mesh, bool orient = true)
{
  Listed result;
  ExecutionContext context;
  RepairOptions options;
  options.orient = orient;
  EXPECT_TRUE(repair_surface(context, mesh.points, mesh.triangles, options, result.repaired).ok());
  result.places = list_defects(mesh.points, mesh.triangles, result.repaired);
  return result;
}

void expect_the_counts(const Listed& listed)
{
  const SurfaceDiagnosis& found = listed.repaired.found;
  const auto count = [&](Defect defect) { return static_cast<Index>(listed.of(defect).size()); };
  EXPECT_EQ(count(Defect::duplicate_vertex), found.duplicate_vertices);
  EXPECT_EQ(count(Defect::unreferenced_vertex), found.unreferenced_vertices);
  EXPECT_EQ(count(Defect::boundary_edge), found.boundary_edges);
  EXPECT_EQ(count(Defect::nonmanifold_edge), found.nonmanifold_edges);
  EXPECT_EQ(count(Defect::misoriented_edge), found.misoriented_edges);
  EXPECT_EQ(count(Defect::degenerate_triangle), found.degenerate_triangles);
  EXPECT_EQ(count(Defect::duplicate_triangle), found.duplicate_triangles);
  EXPECT_EQ(count(Defect::self_intersection) == 0, found.self_intersections == 0);
  EXPECT_EQ(count(Defect::inward_component) == 0, found.inward_components == 0);
}
} // namespace

TEST(SurfaceDefects, ACleanSurfaceHasNone)
{
  EXPECT_TRUE(listed(test::sphere(2)).places.empty());
}

TEST(SurfaceDefects, AnOpenCubeShowsItsRim)
{
  const TriangleMesh cube = test::open_cube();
  const Listed found = listed(cube);
  expect_the_counts(found);
  ASSERT_EQ(found.places.size(), 4u);
  for (const DefectOccurrence& place : found.places)
  {
    EXPECT_EQ(place.defect, Defect::boundary_edge);
    ASSERT_EQ(place.vertices.size(), 2u);
    EXPECT_EQ(place.component, 0);
    EXPECT_EQ(cube.points(place.vertices[0], 2), 1.0);
    EXPECT_EQ(cube.points(place.vertices[1], 2), 1.0);
  }
}

TEST(SurfaceDefects, LooseTrianglesAreDuplicateVerticesNotEdges)
{
  const Listed found = listed(test::unwelded(test::cube()));
  expect_the_counts(found);
  EXPECT_EQ(found.places.size(), 36u - 8u);
  EXPECT_EQ(found.of(Defect::duplicate_vertex).size(), found.places.size());
}

TEST(SurfaceDefects, TrianglesOfNoUse)
{
  TriangleMesh mesh = test::cube();
  const Index t = mesh.triangles.rows();
  mesh.points.conservativeResize(mesh.points.rows() + 1, 3);
  mesh.points.row(mesh.points.rows() - 1) << 5.0, 5.0, 5.0; // used by no triangle
  mesh.triangles.conservativeResize(t + 2, 3);
  mesh.triangles.row(t) << mesh.triangles(3, 1), mesh.triangles(3, 2), mesh.triangles(3, 0);
  mesh.triangles.row(t + 1) << 0, 1, 0;
  const Listed found = listed(mesh);
  expect_the_counts(found);
  const auto degenerate = found.of(Defect::degenerate_triangle);
  ASSERT_EQ(degenerate.size(), 1u);
  EXPECT_EQ(degenerate[0].triangle, t + 1);
  EXPECT_THAT(degenerate[0].vertices, ElementsAre(0, 1, 0));
  const auto duplicates = found.of(Defect::duplicate_triangle);
  ASSERT_EQ(duplicates.size(), 1u);
  EXPECT_EQ(duplicates[0].triangle, t);
  const auto unreferenced = found.of(Defect::unreferenced_vertex);
  ASSERT_EQ(unreferenced.size(), 1u);
  EXPECT_THAT(unreferenced[0].vertices, ElementsAre(8));
  EXPECT_EQ(unreferenced[0].component, -1);
  // The three edges of the duplicate triangle are non-manifold.
  EXPECT_EQ(found.of(Defect::nonmanifold_edge).size(), 3u);
}

TEST(SurfaceDefects, MisorientedEdgesAreThoseOfTheInputEvenWhenRepaired)
{
  TriangleMesh mesh = test::sphere(2);
  std::swap(mesh.triangles(7, 1), mesh.triangles(7, 2));
  for (const bool orient : { false, true })
  {
    const Listed found = listed(mesh, orient);
    expect_the_counts(found);
    const auto edges = found.of(Defect::misoriented_edge);
    ASSERT_EQ(edges.size(), 3u);
    for (const DefectOccurrence& edge : edges)
    {
      for (const Index v : edge.vertices)
      {
        EXPECT_TRUE((mesh.triangles.row(7).array() == v).any());
      }
    }
  }
}

TEST(SurfaceDefects, CrossingTrianglesNameEachOther)
{
  const TriangleMesh mesh =
    test::join(test::sphere(2), test::sphere(2, 1.0, Vec3(0.9, 0.05, 0.02)));
  const Listed found = listed(mesh);
  expect_the_counts(found);
  const auto crossings = found.of(Defect::self_intersection);
  ASSERT_FALSE(crossings.empty());
  const Index half = mesh.triangles.rows() / 2;
  std::map<Index, Index> crossing_of_triangle;
  for (const DefectOccurrence& place : crossings)
  {
    EXPECT_NE(place.triangle < half, place.crossed_triangle < half)
      << "a sphere does not cross itself";
    EXPECT_EQ(place.component, place.triangle < half ? 0 : 1);
    crossing_of_triangle[place.triangle] = place.crossed_triangle;
  }
  EXPECT_EQ(crossing_of_triangle.size(), crossings.size()) << "each triangle once";
  for (const auto& [s, t] : crossing_of_triangle)
  {
    EXPECT_EQ(crossing_of_triangle.count(t), 1u);
  }
  // The list of crossings contains each crossing triangle once. The pairs of crossing triangles
  // must contain the same number of distinct triangles.
  std::map<Index, int> in_pairs;
  for (const auto& [s, t] : found.repaired.crossings)
  {
    in_pairs[s] = in_pairs[t] = 1;
  }
  EXPECT_EQ(in_pairs.size(), crossings.size());
}

TEST(SurfaceDefects, InwardComponents)
{
  const TriangleMesh mesh =
    test::join(test::sphere(1), test::flipped(test::sphere(1, 1.0, Vec3(3.0, 0.0, 0.0))));
  const Listed found = listed(mesh);
  expect_the_counts(found);
  const auto inward = found.of(Defect::inward_component);
  ASSERT_EQ(static_cast<Index>(inward.size()), mesh.triangles.rows() / 2);
  for (const DefectOccurrence& place : inward)
  {
    EXPECT_GE(place.triangle, mesh.triangles.rows() / 2);
    EXPECT_EQ(place.component, 1);
  }
}

TEST(SurfaceDefects, EveryKindHasAWord)
{
  for (int k = 0; k < defect_kinds; ++k)
  {
    EXPECT_STRNE(to_string(static_cast<Defect>(k)), "");
  }
}
