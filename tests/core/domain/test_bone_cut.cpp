// Meshes cut open along bones: Euler characteristic, edges, and the side of each vertex.
#include "domain/bone_cut.h"

#include "weights_shapes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace bindpose;

namespace
{
/// Return the Euler characteristic: used vertices - edges + triangles.
Index euler(const Triangles& triangles)
{
  std::vector<bool> used(static_cast<std::size_t>(triangles.maxCoeff() + 1), false);
  for (Index i = 0; i < triangles.size(); ++i)
  {
    used[static_cast<std::size_t>(triangles.data()[i])] = true;
  }
  return std::count(used.begin(), used.end(), true) -
    static_cast<Index>(mesh_edges(triangles).size()) + triangles.rows();
}

/// Return the unit square, divided into 8 x 8 cells.
TriangleMesh square_of_cells()
{
  return test::grid(8, 8);
}

BoneCut cut(const TriangleMesh& mesh, const Handles& bones)
{
  ExecutionContext context;
  BoneCut result;
  const Status status = cut_along_bones(context, mesh.points, mesh.triangles, bones, {}, result);
  EXPECT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(
    status.report.number("counts.doubled_vertices", -1), result.points.rows() - mesh.points.rows());
  // The corners of the triangles keep their positions.
  for (Index i = 0; i < mesh.triangles.size(); ++i)
  {
    const Index original = result.original[static_cast<std::size_t>(result.triangles.data()[i])];
    EXPECT_EQ(original, mesh.triangles.data()[i]);
  }
  for (Index v = 0; v < result.points.rows(); ++v)
  {
    EXPECT_EQ(result.points.row(v), mesh.points.row(result.original[static_cast<std::size_t>(v)]));
  }
  return result;
}

/// Return the number of points on one side of the bones.
Index count(const BoneCut& cut, Index side)
{
  return std::count(cut.side.begin(), cut.side.end(), side);
}
} // namespace

TEST(BoneCut, ASlitInsideIsAHole)
{
  const TriangleMesh mesh = square_of_cells();
  const Handles bones{ test::bone_handle("b", Vec3(0.25, 0.5, 0), Vec3(0.75, 0.5, 0)) };
  const BoneCut result = cut(mesh, bones);
  // Five vertices are on the bone. The three inner ones are duplicated, the two ends are not.
  EXPECT_EQ(result.points.rows() - mesh.points.rows(), 3);
  EXPECT_EQ(euler(mesh.triangles), 1);
  EXPECT_EQ(euler(result.triangles), 0);
  EXPECT_EQ(count(result, 1), 3);
  EXPECT_EQ(count(result, 2), 3);
  // The left side of a bone along +x is toward +y, so triangles with vertices of the left side are
  // above the bone.
  for (Index t = 0; t < result.triangles.rows(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Index v = result.triangles(t, k);
      const Index side = result.side[static_cast<std::size_t>(v)];
      double height = 0.0;
      for (int m = 0; m < 3; ++m)
      {
        height += result.points(result.triangles(t, m), 1) / 3.0;
      }
      if (side > 0)
      {
        EXPECT_EQ(height > 0.5, side == 1);
      }
    }
  }
}

TEST(BoneCut, ABoneFromEdgeToEdgeMakesTwoPieces)
{
  const TriangleMesh mesh = square_of_cells();
  const Handles bones{ test::bone_handle("b", Vec3(0.5, 0, 0), Vec3(0.5, 1, 0)) };
  const BoneCut result = cut(mesh, bones);
  EXPECT_EQ(result.points.rows() - mesh.points.rows(), 9);
  EXPECT_EQ(connected_components(result.points.rows(), result.triangles).count, 2);
  EXPECT_EQ(count(result, 1), 9);
  EXPECT_EQ(count(result, 2), 9);
}

TEST(BoneCut, BonesThatMeetAndCross)
{
  const TriangleMesh mesh = square_of_cells();
  // The cross does not touch the boundary, so it opens one hole. The vertex in the middle of the
  // cross becomes four points.
  const Handles cross{ test::bone_handle("a", Vec3(0.25, 0.5, 0), Vec3(0.75, 0.5, 0)),
    test::bone_handle("b", Vec3(0.5, 0.25, 0), Vec3(0.5, 0.75, 0)) };
  const BoneCut crossed = cut(mesh, cross);
  EXPECT_EQ(crossed.points.rows() - mesh.points.rows(), 2 + 2 + 3);
  EXPECT_EQ(euler(crossed.triangles), 0);
  // The four points in the middle are on the sides of the first bone, two on each side.
  EXPECT_EQ(count(crossed, 1), 2 + 2);
  EXPECT_EQ(count(crossed, 3), 2);
  // Four bones that form a closed square separate its inside from the rest.
  const Vec3 corners[4] = { Vec3(0.25, 0.25, 0), Vec3(0.75, 0.25, 0), Vec3(0.75, 0.75, 0),
    Vec3(0.25, 0.75, 0) };
  Handles ring;
  for (int k = 0; k < 4; ++k)
  {
    ring.push_back(test::bone_handle("r" + std::to_string(k), corners[k], corners[(k + 1) % 4]));
  }
  const BoneCut closed = cut(mesh, ring);
  EXPECT_EQ(closed.points.rows() - mesh.points.rows(), 16);
  EXPECT_EQ(connected_components(closed.points.rows(), closed.triangles).count, 2);
  for (Index v = mesh.points.rows(); v < closed.points.rows(); ++v)
  {
    EXPECT_GT(closed.side[static_cast<std::size_t>(v)], 0) << "a closed curve has no tip";
  }
}

TEST(BoneCut, BonesOfOneEdgeEachOpenTogether)
{
  const TriangleMesh mesh = test::grid(3, 3, 3.0, 3.0);
  const Vec3 corners[4] = { Vec3(1, 1, 0), Vec3(2, 1, 0), Vec3(2, 2, 0), Vec3(1, 2, 0) };
  Handles ring;
  for (int k = 0; k < 4; ++k)
  {
    ring.push_back(test::bone_handle("r" + std::to_string(k), corners[k], corners[(k + 1) % 4]));
  }
  ExecutionContext context;
  BoneCut result;
  const Status status = cut_along_bones(context, mesh.points, mesh.triangles, ring, {}, result);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(result.points.rows() - mesh.points.rows(), 4);
  EXPECT_EQ(connected_components(result.points.rows(), result.triangles).count, 2);
  // Each of the four corners is a vertex of two bones and is assigned to the first of them. No
  // corner remains for the last bone.
  ASSERT_EQ(status.warnings.size(), 1u);
  EXPECT_NE(status.warnings[0].find("'r3'"), std::string::npos);
  // If the bones are treated as one curve, the curve has four vertices on each side.
  const Status whole =
    cut_along_bones(context, mesh.points, mesh.triangles, ring, { 0, 0, 0, 0 }, result);
  EXPECT_TRUE(whole.ok() && whole.warnings.empty());
  EXPECT_EQ(count(result, 1), 4);
  EXPECT_EQ(count(result, 2), 4);
}

TEST(BoneCut, ABoneOnTheBoundaryHasOneSide)
{
  const TriangleMesh mesh = square_of_cells();
  const Handles bones{ test::bone_handle("b", Vec3(0, 0, 0), Vec3(1, 0, 0)) };
  const BoneCut result = cut(mesh, bones);
  EXPECT_EQ(result.points.rows(), mesh.points.rows());
  EXPECT_EQ(count(result, 1), 9);
  EXPECT_EQ(count(result, 2), 0);
}

TEST(BoneCut, OtherHandlesAreNoCuts)
{
  const TriangleMesh mesh = square_of_cells();
  const Handles handles{ test::point_handle("p", Vec3(0.125, 0.125, 0)),
    test::bone_handle("b", Vec3(0.25, 0.5, 0), Vec3(0.75, 0.5, 0)) };
  const BoneCut result = cut(mesh, handles);
  EXPECT_EQ(count(result, 3), 3);
  EXPECT_EQ(count(result, 4), 3);
  EXPECT_EQ(count(result, 0), result.points.rows() - 6);
}

TEST(BoneCut, WhatCannotBeCutIsOneSentence)
{
  ExecutionContext context;
  BoneCut result;
  const TriangleMesh mesh = square_of_cells();
  const auto message = [&](const TriangleMesh& m, const Handles& handles)
  {
    const Status status = cut_along_bones(context, m.points, m.triangles, handles, {}, result);
    EXPECT_EQ(status.code, StatusCode::invalid_input);
    return status.message;
  };
  const auto bone = [](const Vec3& head, const Vec3& tail)
  { return Handles{ test::bone_handle("oblique", head, tail) }; };
  // These bones cross cells, pass through vertices that have no common edge, are outside of the
  // mesh, or are too short to open a slit.
  EXPECT_NE(
    message(mesh, bone(Vec3(0.1, 0.2, 0), Vec3(0.8, 0.7, 0))).find("'oblique'"), std::string::npos);
  EXPECT_NE(message(mesh, bone(Vec3(0, 1, 0), Vec3(0.5, 0, 0))).find("must consist of edges"),
    std::string::npos);
  EXPECT_NE(message(mesh, bone(Vec3(0.5, 0.5, 0), Vec3(1.5, 0.5, 0))).find("must consist of edges"),
    std::string::npos);
  EXPECT_NE(message(mesh, bone(Vec3(0.25, 0.5, 0), Vec3(0.375, 0.5, 0))).find("cannot be cut"),
    std::string::npos);
  EXPECT_NE(message(mesh, test::five_points()).find("no bone"), std::string::npos);
  EXPECT_NE(
    message(test::cube(), bone(Vec3(0, 0, 0), Vec3(1, 0, 0))).find("plane"), std::string::npos);
  context.request_cancel();
  EXPECT_EQ(cut_along_bones(
              context, mesh.points, mesh.triangles, bone(Vec3(0, 0, 0), Vec3(1, 0, 0)), {}, result)
              .code,
    StatusCode::canceled);
}
