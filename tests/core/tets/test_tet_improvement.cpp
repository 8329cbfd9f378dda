// Improvement of tets by smoothing, flips, contraction and insertion of vertices.
#include "tets/tet_improvement.h"

#include "tets/tet_quality.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace bindpose;

namespace
{
/// Return a box of n x n x n cells whose inner vertices are moved by up to `by`.
TetMesh shaken_box(double by, int n = 6)
{
  TetMesh mesh = test::tet_box(n, n, n);
  test::Random random(3);
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    const Vec3 p = mesh.points.row(v);
    if (p.minCoeff() > 1e-9 && p.maxCoeff() < 1.0 - 1e-9)
    {
      mesh.points.row(v) += random.in_box(Vec3::Constant(-by), Vec3::Constant(by)).transpose();
    }
  }
  return mesh;
}

double angle(const TetMesh& mesh)
{
  return measure_tets(mesh.points, mesh.tets).min_dihedral_angle;
}

/// Insert a vertex on an edge and split all tets at the edge. @return The id of the new vertex.
Index split_edge(TetMesh& mesh, Index a, Index b, double where)
{
  const Index fresh = mesh.points.rows();
  mesh.points.conservativeResize(fresh + 1, 3);
  mesh.points.row(fresh) = (1.0 - where) * mesh.points.row(a) + where * mesh.points.row(b);
  const Index tets = mesh.tets.rows();
  for (Index t = 0; t < tets; ++t)
  {
    const auto has = [&](Index v) { return (mesh.tets.row(t).array() == v).any(); };
    if (has(a) && has(b))
    {
      mesh.tets.conservativeResize(mesh.tets.rows() + 1, 4);
      mesh.tets.bottomRows(1) = mesh.tets.row(t);
      for (int k = 0; k < 4; ++k)
      {
        Index& here = mesh.tets(t, k);
        Index& there = mesh.tets(mesh.tets.rows() - 1, k);
        here = here == a ? fresh : here;
        there = there == b ? fresh : there;
      }
    }
  }
  return fresh;
}

std::vector<std::array<Index, 4>> tet_set(const Tets& tets)
{
  std::vector<std::array<Index, 4>> set;
  for (Index t = 0; t < tets.rows(); ++t)
  {
    set.push_back({ tets(t, 0), tets(t, 1), tets(t, 2), tets(t, 3) });
    std::sort(set.back().begin(), set.back().end());
  }
  std::sort(set.begin(), set.end());
  return set;
}

Index vertex_at(const TetMesh& mesh, const Vec3& p)
{
  Index best = 0;
  (mesh.points.rowwise() - p.transpose()).rowwise().squaredNorm().minCoeff(&best);
  return best;
}

bool uses(const TetMesh& mesh, Index v)
{
  return (mesh.tets.array() == v).any();
}

Index unused_vertices(const TetMesh& mesh)
{
  Index count = 0;
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    count += !uses(mesh, v);
  }
  return count;
}

bool improve(TetMesh& mesh, const std::vector<char>& constrained, Improvement& done)
{
  ExecutionContext context;
  return improve_tets(context, mesh, constrained, {}, ImproveOptions(), done);
}
} // namespace

TEST(TetImprovement, MakesTheFlattestBetterAndKeepsTheVolume)
{
  TetMesh mesh = shaken_box(0.055);
  ASSERT_TRUE(check_tets(mesh.points, mesh.tets).ok());
  const double before = angle(mesh);
  const Triangles skin = boundary_triangles(mesh.tets);
  Improvement done;
  ASSERT_TRUE(improve(mesh, std::vector<char>(mesh.points.rows(), 0), done));
  EXPECT_TRUE(check_tets(mesh.points, mesh.tets).ok());
  EXPECT_LT(before, 10.0);
  EXPECT_GE(angle(mesh), 12.0);
  EXPECT_GT(done.moved_vertices, 0);
  EXPECT_NEAR(tet_volumes(mesh.points, mesh.tets).sum(), 1.0, 1e-12);
  EXPECT_TRUE(count_edges(boundary_triangles(mesh.tets)).closed);
  EXPECT_NEAR(surface_area(mesh.points, boundary_triangles(mesh.tets)), 6.0, 1e-12);
}

TEST(TetImprovement, HeldVerticesMoveOnlyWhenNothingElseHelps)
{
  TetMesh mesh = test::tet_box(4, 4, 4); // no dihedral angle is below 45 degrees
  const TetMesh before = mesh;
  Improvement done;
  ASSERT_TRUE(improve(mesh, std::vector<char>(mesh.points.rows(), 1), done));
  EXPECT_EQ(mesh.points, before.points);
  EXPECT_EQ(mesh.tets, before.tets);
  TetMesh flat = shaken_box(0.055);
  const double angle_before = angle(flat);
  ASSERT_TRUE(improve(flat, std::vector<char>(flat.points.rows(), 1), done));
  EXPECT_EQ(done.moved_vertices, 0);
  EXPECT_GT(angle(flat), angle_before);
}

TEST(TetImprovement, AFlatTetOnTheBoundaryGoes)
{
  // The mesh is a pyramid with a square base of two triangles, and a nearly flat tet in front of
  // the base.
  TetMesh mesh;
  mesh.points.resize(5, 3);
  mesh.points << 0, 0, 0, 1, 0, -1e-4, 1, 1, 0, 0, 1, -1e-4, 0.5, 0.5, -0.8;
  mesh.tets.resize(3, 4);
  mesh.tets << 0, 1, 2, 3, 0, 1, 3, 4, 1, 2, 3, 4;
  for (Index t = 0; t < mesh.tets.rows(); ++t)
  {
    if (tet_volumes(mesh.points, mesh.tets)[t] < 0.0)
    {
      mesh.tets.row(t).tail<2>().reverseInPlace();
    }
  }
  ASSERT_TRUE(check_tets(mesh.points, mesh.tets).ok());
  ASSERT_TRUE(count_edges(boundary_triangles(mesh.tets)).closed);
  ASSERT_LT(angle(mesh), 1.0);
  Improvement done;
  ASSERT_TRUE(improve(mesh, std::vector<char>(5, 1), done));
  EXPECT_EQ(mesh.tets.rows(), 2);
  EXPECT_GT(angle(mesh), 30.0);
  EXPECT_TRUE(count_edges(boundary_triangles(mesh.tets)).closed);
}

TEST(TetImprovement, OfTwoFlatTetsOnOneEdgeOnlyOneGoes)
{
  // Four thin tets share the edge 0-1. Two tets are wedges: their dihedral angle at the edge is
  // tiny. The other two tets are flat: their dihedral angle at the edge is near 180 degrees. The
  // flat tets are on opposite sides of the edge. If both flat tets were removed, the boundary would
  // touch itself along the edge.
  TetMesh mesh;
  mesh.points.resize(6, 3);
  constexpr double thin = 1e-4;
  mesh.points << 0, 0, -1, 0, 0, 1, 1, thin, 0, 1, -thin, 0, -1, thin, 0, -1, -thin, 0;
  mesh.tets.resize(4, 4);
  mesh.tets << 0, 1, 2, 3, 0, 1, 4, 5, 0, 1, 2, 4, 0, 1, 3, 5;
  for (Index t = 0; t < mesh.tets.rows(); ++t)
  {
    if (tet_volumes(mesh.points, mesh.tets)[t] < 0.0)
    {
      mesh.tets.row(t).tail<2>().reverseInPlace();
    }
  }
  ASSERT_TRUE(check_tets(mesh.points, mesh.tets).ok());
  Improvement done;
  ASSERT_TRUE(improve(mesh, std::vector<char>(6, 1), done));
  EXPECT_TRUE(check_tets(mesh.points, mesh.tets).ok());
  EXPECT_TRUE(count_edges(boundary_triangles(mesh.tets)).closed);
  EXPECT_EQ(count_edges(boundary_triangles(mesh.tets)).nonmanifold, 0);
}

TEST(TetImprovement, CanceledAtOnceIsStillAMesh)
{
  TetMesh mesh = shaken_box(0.055);
  ExecutionContext context;
  context.request_cancel();
  Improvement done;
  EXPECT_FALSE(improve_tets(context, mesh, std::vector<char>(mesh.points.rows(), 0), {}, {}, done));
  EXPECT_TRUE(check_tets(mesh.points, mesh.tets).ok());
  EXPECT_NEAR(tet_volumes(mesh.points, mesh.tets).sum(), 1.0, 1e-12);
}

TEST(TetImprovement, ThreadsMakeNoDifference)
{
  // Flat tets occur everywhere, also as neighbors of each other.
  const TetMesh shaken = shaken_box(0.02, 12);
  ASSERT_TRUE(check_tets(shaken.points, shaken.tets).ok());
  for (const bool keep_boundary : { false, true })
  {
    SCOPED_TRACE(keep_boundary);
    ImproveOptions options;
    options.keep_boundary = keep_boundary;
    options.insert = keep_boundary;
    options.angle = 25.0;
    options.insert_angle = 20.0;
    TetMesh one;
    for (const int threads : { 1, 2, 8 })
    {
      SCOPED_TRACE(threads);
      TetMesh mesh = shaken;
      ExecutionContext context;
      context.set_threads(threads);
      Improvement done;
      ASSERT_TRUE(
        improve_tets(context, mesh, std::vector<char>(mesh.points.rows(), 0), {}, options, done));
      EXPECT_GT(done.moved_vertices, 100);
      EXPECT_TRUE(check_tets(mesh.points, mesh.tets).ok());
      EXPECT_NEAR(tet_volumes(mesh.points, mesh.tets).sum(), 1.0, 1e-12);
      if (threads == 1)
      {
        one = mesh;
      }
      EXPECT_EQ(mesh.points, one.points);
      EXPECT_EQ(mesh.tets, one.tets);
    }
  }
}

TEST(TetImprovement, KeepsTheBoundaryWhenAsked)
{
  // Vertices on the top move within the plane of the top, so some tets on the boundary are flat.
  TetMesh mesh = shaken_box(0.05);
  test::Random random(5);
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    const Vec3 p = mesh.points.row(v);
    if (p.z() > 1.0 - 1e-9 && p.head<2>().minCoeff() > 1e-9 && p.head<2>().maxCoeff() < 1.0 - 1e-9)
    {
      mesh.points(v, 0) += random.uniform(-0.05, 0.05);
    }
  }
  ASSERT_TRUE(check_tets(mesh.points, mesh.tets).ok());
  const auto sorted = [](const Triangles& triangles)
  {
    std::vector<std::array<Index, 3>> list;
    for (Index t = 0; t < triangles.rows(); ++t)
    {
      list.push_back({ triangles(t, 0), triangles(t, 1), triangles(t, 2) });
      std::rotate(list.back().begin(), std::min_element(list.back().begin(), list.back().end()),
        list.back().end());
    }
    std::sort(list.begin(), list.end());
    return list;
  };
  const auto before = sorted(boundary_triangles(mesh.tets));
  const Points points = mesh.points;
  const double angle_before = angle(mesh);
  ImproveOptions options;
  options.keep_boundary = true;
  options.angle = 20.0;
  ExecutionContext context;
  Improvement done;
  ASSERT_TRUE(
    improve_tets(context, mesh, std::vector<char>(mesh.points.rows(), 0), {}, options, done));
  EXPECT_GT(angle(mesh), angle_before);
  EXPECT_EQ(sorted(boundary_triangles(mesh.tets)), before);
  for (const auto& triangle : before)
  {
    for (const Index v : triangle)
    {
      ASSERT_EQ(mesh.points.row(v), points.row(v));
    }
  }
  EXPECT_EQ(done.removed_tets, 0);
}

TEST(TetImprovement, VerticesTooNearToOthersGo)
{
  const TetMesh box = test::tet_box(4, 4, 4);
  struct Case
  {
    const char* name;
    Vec3 from, to;
  };
  for (const Case& c : { Case{ "inside", Vec3(0.5, 0.5, 0.5), Vec3(0.5, 0.5, 0.75) },
         Case{ "beside a side", Vec3(0.5, 0.5, 0.0), Vec3(0.5, 0.5, 0.25) },
         Case{ "in a side", Vec3(0.5, 0.5, 0.0), Vec3(0.75, 0.5, 0.0) },
         Case{ "on an edge", Vec3(0.5, 0.0, 0.0), Vec3(0.75, 0.0, 0.0) },
         Case{ "in a side next to its edge", Vec3(0.5, 0.0, 0.0), Vec3(0.5, 0.25, 0.0) },
         Case{ "at a corner", Vec3(0, 0, 0), Vec3(0.25, 0, 0) } })
  {
    SCOPED_TRACE(c.name);
    TetMesh mesh = box;
    const Index fresh = split_edge(mesh, vertex_at(mesh, c.from), vertex_at(mesh, c.to), 1e-6);
    ASSERT_TRUE(check_tets(mesh.points, mesh.tets).ok());
    ASSERT_LT(angle(mesh), 1e-3);
    std::vector<char> constrained(mesh.points.rows(), 1);
    constrained[fresh] = 0;
    Improvement done;
    ASSERT_TRUE(improve(mesh, constrained, done));
    EXPECT_EQ(done.collapsed_edges, 1);
    EXPECT_FALSE(uses(mesh, fresh));
    EXPECT_EQ(tet_set(mesh.tets), tet_set(box.tets));
    EXPECT_EQ(mesh.points.topRows(fresh), box.points);
  }
}

TEST(TetImprovement, HeldVerticesNeverGo)
{
  TetMesh mesh = test::tet_box(4, 4, 4);
  const Index inside = vertex_at(mesh, Vec3(0.5, 0.5, 0.5));
  const Index fresh = split_edge(mesh, inside, vertex_at(mesh, Vec3(0.5, 0.5, 0.75)), 1e-6);
  ImproveOptions options;
  // The release angle 0 means that constrained vertices never move.
  options.release_angle = 0.0;
  ExecutionContext context;
  Improvement done;
  for (const bool both : { true, false })
  {
    TetMesh better = mesh;
    std::vector<char> constrained(mesh.points.rows(), 1);
    constrained[inside] = both;
    ASSERT_TRUE(improve_tets(context, better, constrained, {}, options, done));
    EXPECT_TRUE(uses(better, fresh));
    EXPECT_EQ(uses(better, inside), both);
    EXPECT_EQ(better.points, mesh.points);
    EXPECT_TRUE(check_tets(better.points, better.tets).ok());
    EXPECT_NEAR(tet_volumes(better.points, better.tets).sum(), 1.0, 1e-12);
    EXPECT_EQ(angle(better) > 12.0, !both);
  }
}

TEST(TetImprovement, BoundaryVerticesStayWhenTheBoundaryIsKept)
{
  TetMesh mesh = test::tet_box(4, 4, 4);
  const Index side = vertex_at(mesh, Vec3(0.5, 0.5, 0.0));
  const Index on_side = split_edge(mesh, side, vertex_at(mesh, Vec3(0.75, 0.5, 0.0)), 1e-6);
  const Index middle = vertex_at(mesh, Vec3(0.5, 0.5, 0.5));
  const Index inside = split_edge(mesh, middle, vertex_at(mesh, Vec3(0.5, 0.5, 0.75)), 1e-6);
  ImproveOptions options;
  options.keep_boundary = true;
  ExecutionContext context;
  Improvement done;
  const Points points = mesh.points;
  ASSERT_TRUE(improve_tets(context, mesh, std::vector<char>(points.rows(), 0), {}, options, done));
  EXPECT_TRUE(uses(mesh, side));
  EXPECT_TRUE(uses(mesh, on_side));
  EXPECT_EQ(mesh.points.row(on_side), points.row(on_side));
  EXPECT_FALSE(uses(mesh, inside) && uses(mesh, middle));
  EXPECT_TRUE(check_tets(mesh.points, mesh.tets).ok());
  EXPECT_NEAR(tet_volumes(mesh.points, mesh.tets).sum(), 1.0, 1e-12);
}

TEST(TetImprovement, ContractionClosesNoHole)
{
  // The mesh is a ring of eight cells around a hole of one cell. Random edges of the mesh are split
  // by new vertices.
  const TetMesh box = test::tet_box(3, 3, 1, Vec3::Zero(), Vec3(3, 3, 1));
  int good = 0;
  for (int seed = 1; seed <= 20; ++seed)
  {
    SCOPED_TRACE(seed);
    TetMesh mesh = box;
    Index count = 0;
    for (Index t = 0; t < box.tets.rows(); ++t)
    {
      Vec3 center = Vec3::Zero();
      for (int k = 0; k < 4; ++k)
      {
        center += 0.25 * box.points.row(box.tets(t, k)).transpose();
      }
      if (center.head<2>().minCoeff() < 1.0 || center.head<2>().maxCoeff() > 2.0)
      {
        mesh.tets.row(count++) = box.tets.row(t);
      }
    }
    mesh.tets.conservativeResize(count, 4);
    ASSERT_EQ(test::euler_characteristic(mesh) - unused_vertices(mesh), 0);
    test::Random random(static_cast<std::uint64_t>(seed));
    for (int i = 0; i < 40; ++i)
    {
      const Index t = random.below(mesh.tets.rows());
      const Index k = random.below(4);
      const Index a = mesh.tets(t, k);
      const Index b = mesh.tets(t, (k + 1 + random.below(3)) % 4);
      if (std::max(a, b) < box.points.rows())
      {
        split_edge(mesh, a, b, std::pow(10.0, random.uniform(-6.0, -0.5)));
      }
    }
    const double before = angle(mesh);
    Improvement done;
    ASSERT_TRUE(improve(mesh, std::vector<char>(mesh.points.rows(), 0), done));
    EXPECT_GT(done.collapsed_edges, 5);
    EXPECT_GT(angle(mesh), before);
    good += angle(mesh) > 8.0;
    EXPECT_TRUE(check_tets(mesh.points, mesh.tets).ok());
    EXPECT_EQ(test::euler_characteristic(mesh) - unused_vertices(mesh), 0);
    EXPECT_TRUE(count_edges(boundary_triangles(mesh.tets)).closed);
    EXPECT_NEAR(tet_volumes(mesh.points, mesh.tets).sum(), 8.0, 1e-9) << "sides and edges stay";
    EXPECT_NEAR(surface_area(mesh.points, boundary_triangles(mesh.tets)), 32.0, 1e-9);
  }
  EXPECT_GE(good, 15) << "but not where vertices crowd at one";
}

TEST(TetImprovement, AFlatTetByItselfGoes)
{
  TetMesh mesh = test::tet_box(2, 2, 2);
  const Index first = mesh.points.rows();
  mesh.points.conservativeResize(first + 4, 3);
  mesh.points.bottomRows(4) << 2, 0, 0, 3, 1, 0.05, 3, 0, 0, 2, 1, 0;
  mesh.tets.conservativeResize(mesh.tets.rows() + 1, 4);
  mesh.tets.bottomRows(1) << first, first + 1, first + 2, first + 3;
  if (tet_volumes(mesh.points, mesh.tets).tail<1>()[0] < 0.0)
  {
    mesh.tets.bottomRows(1).rightCols<2>().reverseInPlace();
  }
  ASSERT_TRUE(check_tets(mesh.points, mesh.tets).ok());
  ASSERT_LT(angle(mesh), 8.0);
  for (const bool constrained : { false, true })
  {
    TetMesh better = mesh;
    Improvement done;
    ASSERT_TRUE(improve(better, std::vector<char>(mesh.points.rows(), constrained), done));
    EXPECT_EQ(done.removed_tets, constrained ? 0 : 1);
    EXPECT_EQ(better.tets.rows(), mesh.tets.rows() - (constrained ? 0 : 1));
  }
}
