// Pseudo-edges connect neighboring handles. The translations at both ends of an edge determine
// rotations of the handles. The tests use common motions, degenerate edges, and trees of edges
// along the shape.
#include "pose/pseudo_edges.h"

#include "base/constants.h"
#include "skinning/skinning.h"

#include "support/affines.h"
#include "support/differences.h"
#include "support/handles.h"
#include "support/meshes.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace bindpose;
using test::largest_difference;
using test::point_handles;
using test::rotation;

namespace
{
/// Return a pose that moves each pivot p to turn * p + translation. The handles do not rotate.
Pose translations(
  const Handles& handles, const Eigen::Matrix3d& turn, const Vec3& translation = Vec3::Zero())
{
  Pose pose(handles.size());
  for (std::size_t h = 0; h < handles.size(); ++h)
  {
    pose[h].mode = HandleMode::position;
    pose[h].transform.col(3) = turn * handles[h].head + translation - handles[h].head;
  }
  return pose;
}

Eigen::Matrix3d linear(const Pose& pose, std::size_t h)
{
  return pose[h].transform.leftCols<3>();
}

const Handles corner_handles =
  point_handles({ Vec3(0, 0, 0.5), Vec3(2, 0, 0.5), Vec3(2.5, 1, 0.5), Vec3(-0.3, 1.7, 0.5) });
const PseudoEdges edges_of_ring = { { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 0 } };
} // namespace

TEST(PseudoEdges, WhatStaysOrIsMovedAlongDoesNotTurn)
{
  Pose pose = translations(corner_handles, Eigen::Matrix3d::Identity(), Vec3(3, -1, 2));
  rotate_by_pseudo_edges(corner_handles, edges_of_ring, true, pose);
  for (std::size_t h = 0; h < corner_handles.size(); ++h)
  {
    EXPECT_LT(largest_difference(linear(pose, h), Eigen::Matrix3d::Identity()), 1e-15);
    EXPECT_LT((pose[h].transform.col(3) - Vec3(3, -1, 2)).norm(), 1e-15);
  }
  Pose rest(corner_handles.size());
  rotate_by_pseudo_edges(corner_handles, edges_of_ring, false, rest);
  for (const HandlePose& one : rest)
  {
    EXPECT_EQ(one.transform, identity_affine()) << "no bit moves at rest";
  }
}

TEST(PseudoEdges, ARigidMotionInThePlaneIsFoundExactly)
{
  for (const double degrees : { 1e-6, 30.0, 90.0, -135.0, 179.9, 180.0, -179.9 })
  {
    const Eigen::Matrix3d turn = rotation(degrees, Vec3(0, 0, 1));
    Pose pose = translations(corner_handles, turn, Vec3(0.2, 5, 0));
    rotate_by_pseudo_edges(corner_handles, edges_of_ring, false, pose);
    for (std::size_t h = 0; h < corner_handles.size(); ++h)
    {
      EXPECT_LT(largest_difference(linear(pose, h), turn), 1e-13) << degrees;
      EXPECT_LT((pose[h].transform.col(3) - Vec3(0.2, 5, 0)).norm(), 1e-12) << degrees;
      EXPECT_EQ(pose[h].mode, HandleMode::full);
    }
  }
}

TEST(PseudoEdges, SkinningByTheRotationsOfARigidMotionIsThatMotion)
{
  const TriangleMesh mesh = test::grid(6, 6, 3.0, 2.0);
  test::Random random(2);
  Weights weights(mesh.points.rows(), 4);
  for (Index v = 0; v < weights.rows(); ++v)
  {
    for (Index j = 0; j < 4; ++j)
    {
      weights(v, j) = random.uniform();
    }
    weights.row(v) /= weights.row(v).sum();
  }
  const Eigen::Matrix3d turn = rotation(110, Vec3(0, 0, 1));
  Pose pose = translations(corner_handles, turn);
  rotate_by_pseudo_edges(corner_handles, edges_of_ring, false, pose);
  ExecutionContext context;
  Skinning skinning;
  ASSERT_TRUE(skinning.bind(context, weights).ok());
  std::vector<Affine> transforms;
  ASSERT_TRUE(skinning_transforms(corner_handles, pose, transforms).warnings.empty());
  Points posed;
  ASSERT_TRUE(skinning.linear_blend(context, mesh.points, transforms, posed).ok());
  EXPECT_LT((posed - mesh.points * turn.transpose()).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(PseudoEdges, AnEdgeDoesNotSeeATurnAboutItself)
{
  const Handles pair = point_handles({ Vec3(0, 0, 0), Vec3(0, 0, 1) });
  Pose pose = translations(pair, rotation(70, Vec3(0, 0, 1)));
  rotate_by_pseudo_edges(pair, { { 0, 1 } }, false, pose);
  EXPECT_EQ(pose[0].transform, identity_affine());
  EXPECT_EQ(pose[1].transform, identity_affine());
}

TEST(PseudoEdges, EdgesOfAHandleCountAlike)
{
  // The two edges at the middle handle rotate by 0 and by 60 degrees. The handle rotates by the
  // mean, 30 degrees. Each neighbor has only one edge and rotates with it.
  const Handles row =
    point_handles({ Vec3(-1, 0, 0), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(5, 5, 5) });
  Pose pose(4);
  const Vec3 end = rotation(60, Vec3(0, 0, 1)) * Vec3(1, 0, 0);
  pose[2].transform.col(3) = end - Vec3(1, 0, 0);
  pose[3].transform.leftCols<3>() = rotation(33, Vec3(1, 2, 3));
  const Affine own = pose[3].transform;
  rotate_by_pseudo_edges(row, { { 0, 1 }, { 2, 1 } }, false, pose);
  EXPECT_EQ(linear(pose, 0), Eigen::Matrix3d::Identity());
  EXPECT_LT(largest_difference(linear(pose, 1), rotation(30, Vec3(0, 0, 1))), 1e-15);
  EXPECT_LT(largest_difference(linear(pose, 2), rotation(60, Vec3(0, 0, 1))), 1e-15);
  EXPECT_LT((pose[2].transform * Vec3(1, 0, 0).homogeneous() - end).norm(), 1e-15);
  EXPECT_EQ(pose[3].transform, own) << "no edge: its own";
}

TEST(PseudoEdges, TurnWhatTheUserTurnedAndScaleWhenAsked)
{
  const Handles pair = point_handles({ Vec3(1, 1, 0), Vec3(3, 1, 0) });
  const Eigen::Matrix3d turn = rotation(90, Vec3(0, 0, 1));
  Pose pose = translations(pair, turn);
  const Eigen::Matrix3d twist = rotation(25, Vec3(1, 0, 0));
  pose[0].mode = HandleMode::full;
  pose[0].transform.leftCols<3>() = twist;
  pose[0].transform.col(3) = turn * pair[0].head - twist * pair[0].head;
  // This makes the edge three times as long.
  pose[1].transform.col(3) += 2.0 * (turn * Vec3(2, 0, 0));
  const Vec3 before = pose[0].transform * pair[0].head.homogeneous();
  Pose scaled = pose;
  rotate_by_pseudo_edges(pair, { { 0, 1 } }, false, pose);
  EXPECT_LT(largest_difference(linear(pose, 0), turn * twist), 1e-15);
  EXPECT_LT((pose[0].transform * pair[0].head.homogeneous() - before).norm(), 1e-15);
  rotate_by_pseudo_edges(pair, { { 0, 1 } }, true, scaled);
  EXPECT_LT(largest_difference(linear(scaled, 1), 3.0 * turn), 1e-14);
}

TEST(PseudoEdges, FreeAndCollapsedEndsSayNothing)
{
  const Handles pair = point_handles({ Vec3(0, 0, 0), Vec3(1, 0, 0) });
  Pose pose(2);
  pose[0].mode = pose[1].mode = HandleMode::position;
  pose[1].transform.col(3) = Vec3(-1, 0, 0); // both handles are now at the same position
  rotate_by_pseudo_edges(pair, { { 0, 1 } }, true, pose);
  EXPECT_EQ(linear(pose, 0), Eigen::Matrix3d::Identity());
  EXPECT_EQ(pose[1].mode, HandleMode::position);
  pose[0].mode = HandleMode::free;
  pose[1].transform.col(3) = Vec3(-1, 1, 0);
  rotate_by_pseudo_edges(pair, { { 0, 1 } }, false, pose);
  EXPECT_EQ(pose[0].mode, HandleMode::free);
  EXPECT_LT(largest_difference(linear(pose, 1), rotation(90, Vec3(0, 0, 1))), 1e-15);
}

TEST(PseudoEdges, AutomaticOnesFollowTheShape)
{
  // The shape is a strip bent to a U. Its ends are close in space, but far from each other along
  // the strip.
  TriangleMesh strip = test::grid(60, 4, 6.0, 0.4);
  const auto bent = [](const Vec3& p)
  {
    const double angle = p[0] / 6.0 * 1.8 * pi, radius = 1.0 + p[1];
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), 0.0);
  };
  for (Index v = 0; v < strip.points.rows(); ++v)
  {
    strip.points.row(v) = bent(strip.points.row(v));
  }
  Handles handles = point_handles({ bent(Vec3(6, 0.2, 0)), bent(Vec3(3, 0.2, 0)),
    bent(Vec3(0, 0.2, 0)), bent(Vec3(4.5, 0.21, 0)) });
  ASSERT_LT((handles[0].head - handles[2].head).norm(), (handles[0].head - handles[3].head).norm());
  handles.insert(handles.begin(), test::bone_handle("bone", Vec3(1, 0, 0), Vec3(0, 1, 0)));
  const PseudoEdges expected = { { 1, 4 }, { 2, 4 }, { 2, 3 } };
  for (const int threads : { 1, 4 })
  {
    ExecutionContext context;
    context.set_threads(threads);
    PseudoEdges edges;
    const Status status =
      automatic_pseudo_edges(context, strip.points, TrianglesView(strip.triangles), handles, edges);
    EXPECT_TRUE(status.ok() && status.warnings.empty());
    std::sort(edges.begin(), edges.end());
    PseudoEdges sorted = expected;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(edges, sorted);
  }
}

TEST(PseudoEdges, AutomaticOnesAreAMinimumSpanningTreeOfShortestWays)
{
  const TetMesh box = test::tet_box(6, 5, 4);
  test::Random random(4);
  std::vector<Vec3> positions;
  for (int k = 0; k < 9; ++k)
  {
    positions.emplace_back(box.points.row(random.below(box.points.rows())));
  }
  positions.push_back(positions[3] + Vec3(0.01, 0, 0)); // two handles are at one vertex
  const Handles handles = point_handles(positions);
  ExecutionContext context;
  PseudoEdges edges;
  ASSERT_TRUE(automatic_pseudo_edges(context, box.points, TetsView(box.tets), handles, edges).ok());
  EXPECT_EQ(edges.size(), handles.size() - 1);
  // Compute a reference tree: the lengths of shortest paths by the Floyd-Warshall algorithm, then a
  // minimum spanning tree by Prim's algorithm. The pseudo-edges must have the same total length.
  const Index n = box.points.rows();
  Eigen::MatrixXd path_length = Eigen::MatrixXd::Constant(n, n, 1e300);
  for (Index t = 0; t < box.tets.rows(); ++t)
  {
    for (int a = 0; a < 4; ++a)
    {
      for (int b = 0; b < 4; ++b)
      {
        path_length(box.tets(t, a), box.tets(t, b)) =
          (box.points.row(box.tets(t, a)) - box.points.row(box.tets(t, b))).norm();
      }
    }
  }
  for (Index k = 0; k < n; ++k)
  {
    path_length =
      path_length.cwiseMin(path_length.col(k).replicate(1, n) + path_length.row(k).replicate(n, 1));
  }
  std::vector<Index> vertex;
  std::vector<double> offset;
  for (const Handle& handle : handles)
  {
    Index nearest = 0;
    offset.push_back(
      (box.points.rowwise() - handle.head.transpose()).rowwise().norm().minCoeff(&nearest));
    vertex.push_back(nearest);
  }
  const auto length = [&](std::size_t a, std::size_t b)
  { return offset[a] + offset[b] + (a == b ? 0.0 : path_length(vertex[a], vertex[b])); };
  double total = 0.0, tree_length = 0.0;
  for (const auto& [a, b] : edges)
  {
    total += length(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
  }
  std::vector<double> distance_to_tree(handles.size(), 1e300);
  std::vector<char> in_tree(handles.size(), 0);
  distance_to_tree[0] = 0.0;
  for (std::size_t step = 0; step < handles.size(); ++step)
  {
    std::size_t next = handles.size();
    for (std::size_t h = 0; h < handles.size(); ++h)
    {
      next = !in_tree[h] && (next == handles.size() || distance_to_tree[h] < distance_to_tree[next])
        ? h
        : next;
    }
    in_tree[next] = 1;
    tree_length += distance_to_tree[next];
    for (std::size_t h = 0; h < handles.size(); ++h)
    {
      distance_to_tree[h] = std::min(distance_to_tree[h], length(next, h));
    }
  }
  EXPECT_NEAR(total, tree_length, 1e-12);
}

TEST(PseudoEdges, PartsHaveTreesOfTheirOwnAndLonelyPointsAreToldOf)
{
  const TriangleMesh a = test::grid(3, 3);
  const TriangleMesh both = test::join(a, test::translated(a, Vec3(5, 0, 0)));
  ExecutionContext context;
  PseudoEdges edges;
  const auto run = [&](const std::vector<Vec3>& positions)
  {
    return automatic_pseudo_edges(
      context, both.points, TrianglesView(both.triangles), point_handles(positions), edges);
  };
  EXPECT_TRUE(run({ Vec3(0, 0, 0), Vec3(5, 0, 0), Vec3(1, 1, 0), Vec3(6, 1, 0) }).warnings.empty());
  std::sort(edges.begin(), edges.end());
  EXPECT_EQ(edges, (PseudoEdges{ { 0, 2 }, { 1, 3 } }));
  EXPECT_EQ(run({ Vec3(0, 0, 0), Vec3(5, 0, 0) }).warnings.size(), 1u);
  EXPECT_TRUE(edges.empty());
  EXPECT_EQ(run({ Vec3(0, 0, 0) }).warnings.size(), 1u);
  Points broken = both.points;
  broken(3, 1) = std::nan("");
  EXPECT_EQ(automatic_pseudo_edges(context, broken, TrianglesView(both.triangles),
              point_handles({ Vec3::Zero() }), edges)
              .code,
    StatusCode::invalid_input);
}

TEST(PseudoEdges, JoinTwoDifferentPoints)
{
  Handles list = point_handles({ Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0) });
  EXPECT_TRUE(check_pseudo_edges(list, { { 0, 1 }, { 2, 1 } }).ok());
  EXPECT_EQ(check_pseudo_edges(list, { { 0, 1 }, { 1, 1 } }).code, StatusCode::invalid_input);
  EXPECT_EQ(check_pseudo_edges(list, { { 0, 3 } }).code, StatusCode::invalid_input);
  EXPECT_EQ(check_pseudo_edges(list, { { -1, 0 } }).code, StatusCode::invalid_input);
  list[2].kind = HandleKind::region;
  EXPECT_EQ(check_pseudo_edges(list, { { 0, 1 }, { 2, 1 } }).message,
    "pseudo-edge 1 must connect two different point handles");
}
