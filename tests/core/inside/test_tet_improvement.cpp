#include "inside/tet_improvement.h"

#include "inside/tet_quality.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace bindpose;

namespace
{
/// The box with its inner vertices moved by up to `by`.
TetMesh shaken_box(double by)
{
  constexpr int n = 6;
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

bool improve(TetMesh& mesh, const std::vector<char>& held, Improvement& done)
{
  ExecutionContext context;
  return improve_tets(mesh, held, {}, ImproveOptions(), done, context);
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
  TetMesh mesh = test::tet_box(4, 4, 4); // no angle below 45 degrees
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
  // A square of two triangles on a pyramid, and a nearly flat tet in front of it.
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

TEST(TetImprovement, CancelledAtOnceIsStillAMesh)
{
  TetMesh mesh = shaken_box(0.055);
  ExecutionContext context;
  context.request_cancel();
  Improvement done;
  EXPECT_FALSE(improve_tets(mesh, std::vector<char>(mesh.points.rows(), 0), {}, {}, done, context));
  EXPECT_TRUE(check_tets(mesh.points, mesh.tets).ok());
  EXPECT_NEAR(tet_volumes(mesh.points, mesh.tets).sum(), 1.0, 1e-12);
}

TEST(TetImprovement, KeepsTheBoundaryWhenAsked)
{
  // Beside inner vertices, those of the sides move within their planes: there are flat tets there.
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
    improve_tets(mesh, std::vector<char>(mesh.points.rows(), 0), {}, options, done, context));
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
