// Full as-rigid-as-possible deformation: constraints, unconstrained parts of the mesh, degenerate
// meshes, and independence of position, scale and threads.
#include "arap/full_arap.h"

#include "core/arap/arap_cases.h"
#include "core/arap/full_arap_cases.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

using namespace bindpose;
using namespace bindpose::test;
using testing::HasSubstr;

namespace
{
/// A square with handles at its four corners.
struct Cloth
{
  TriangleMesh mesh = test::grid(6, 6);
  Handles handles{ point_handle("a", Vec3(0, 0, 0)), point_handle("b", Vec3(1, 0, 0)),
    point_handle("c", Vec3(0, 1, 0)), point_handle("d", Vec3(1, 1, 0)) };
};
} // namespace

// If the pivot of a handle is inside an element, the handle constrains the point of the mesh at
// the rest position of the pivot.
TEST(FullArapRobustness, APivotInsideAnElementIsThatPointOfTheMesh)
{
  LabeledBar bar = labeled_bar(8);
  const Index tet = bar.mesh.tets.rows() / 2, other = tet + 40;
  const auto inside = [&](const Points& points, Index t) -> Vec3
  {
    return 0.4 * points.row(bar.mesh.tets(t, 0)) + 0.3 * points.row(bar.mesh.tets(t, 1)) +
      0.2 * points.row(bar.mesh.tets(t, 2)) + 0.1 * points.row(bar.mesh.tets(t, 3));
  };
  bar.handles[1] = point_handle("middle", inside(bar.mesh.points, tet));
  bar.handles.push_back(point_handle("other", inside(bar.mesh.points, other)));
  ExecutionContext context;
  for (const ArapEnergy energy : every_energy)
  {
    FullArap arap;
    ASSERT_TRUE(bind(arap, bar, energy).usable());
    // In the last round of the loop the ends of the bar are free. Then only the two point handles
    // determine the pose of the bar.
    for (const HandleMode ends : { HandleMode::full, HandleMode::position, HandleMode::free })
    {
      for (const HandleMode mode : { HandleMode::full, HandleMode::position })
      {
        Pose pose = bend(mode);
        pose[0].mode = pose[2].mode = ends;
        pose.push_back(pose[1]);
        pose[3].transform.col(3) << 0.0, 0.1, -0.4;
        for (const Index count : { 0, 1, 7, 60 })
        {
          FullArap::SolveOptions options = plain(count, FullArap::Start::guess);
          options.anderson_window = 5;
          const Status status = arap.solve(context, pose, options);
          ASSERT_TRUE(status.ok());
          EXPECT_TRUE(status.warnings.empty());
          EXPECT_LT(status.report.number("constraint_residual", 1.0), 1e-11);
          EXPECT_LT(
            (inside(arap.posed(), tet) - (bar.handles[1].head + Vec3(0, 0.3, 0))).norm(), 1e-10);
          EXPECT_LT(
            (inside(arap.posed(), other) - (bar.handles[3].head + Vec3(0, 0.1, -0.4))).norm(),
            1e-10);
        }
      }
    }
  }
}

TEST(FullArapRobustness, ThreePointsInsideElementsMoveTheMeshRigidly)
{
  Cloth cloth;
  cloth.handles = { point_handle("a", Vec3(0.31, 0.12, 0)), point_handle("b", Vec3(0.83, 0.27, 0)),
    point_handle("c", Vec3(0.44, 0.77, 0)) };
  ExecutionContext context;
  for (const ArapEnergy energy : every_energy)
  {
    FullArap arap;
    ASSERT_TRUE(
      arap.bind(context, cloth.mesh.points, cloth.mesh.triangles, cloth.handles, { energy, {} })
        .ok());
    const Affine t = rigid(75, Vec3(1, 2, 3), Vec3(5, -2, 1));
    ASSERT_TRUE(arap.solve(context, posed(cloth.handles, HandleMode::position, t)).ok());
    EXPECT_LT((arap.posed() - moved(cloth.mesh.points, t)).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(FullArapRobustness, PointsThatNearlyMeetAndArePulledApartNeverRaiseTheEnergy)
{
  ExecutionContext context;
  Index rise_warnings = 0;
  test::Random random(5);
  for (Index k = 0; k < 40; ++k)
  {
    Cloth cloth;
    const double distance = std::pow(10.0, -2.0 - 0.15 * static_cast<double>(k));
    for (const Vec3& at : { Vec3(0.31, 0.12, 0), Vec3(0.31 + distance, 0.12 + 0.3 * distance, 0),
           Vec3(0.31 + 0.1 * distance, 0.12 + distance, 0), Vec3(0.63, 0.57, 0),
           Vec3(0.63 + distance, 0.57, 0) })
    {
      cloth.handles.push_back(point_handle("n" + std::to_string(cloth.handles.size()), at));
    }
    Pose pose = posed(cloth.handles, HandleMode::position);
    for (HandlePose& handle : pose)
    {
      handle.transform.col(3) = random.in_box(Vec3::Constant(-1000), Vec3::Constant(1000));
    }
    for (const ArapEnergy energy : every_energy)
    {
      FullArap arap;
      ASSERT_TRUE(
        arap.bind(context, cloth.mesh.points, cloth.mesh.triangles, cloth.handles, { energy, {} })
          .ok());
      const Status status = arap.solve(context, pose, { 0.0, 60, FullArap::Start::guess, 5 });
      ASSERT_TRUE(status.ok());
      const std::vector<double>& energies = arap.energies();
      for (std::size_t i = 1; i < energies.size(); ++i)
      {
        ASSERT_LE(energies[i], energies[i - 1] * (1.0 + 1e-9)) << distance << " " << i;
      }
      // The last energy must be that of the final points.
      EXPECT_NEAR(arap_energy(cloth.mesh.points, cloth.mesh.triangles, arap.groups(), arap.posed(),
                    arap.rotations()),
        energies.back(), 1e-6 * energies.back());
      for (const std::string& warning : status.warnings)
      {
        rise_warnings += warning.find("increased the energy") != std::string::npos;
      }
    }
  }
  EXPECT_GT(rise_warnings, 0) << "no case was hard enough";
}

TEST(FullArapRobustness, TheMiddleOfARegionGoesWhereItsPositionIs)
{
  const LabeledBar bar = labeled_bar(8);
  ExecutionContext context;
  FullArap arap;
  ASSERT_TRUE(arap
                .bind(context, bar.mesh.points, bar.mesh.tets, bar.handles,
                  { ArapEnergy::automatic, bar.labels })
                .ok());
  const Status status = arap.solve(context, bend(HandleMode::position));
  ASSERT_TRUE(status.usable());
  EXPECT_LT(status.report.number("constraint_residual", 1.0), 1e-11);
  Vec3 middle = Vec3::Zero();
  double count = 0.0;
  for (Index v = 0; v < bar.mesh.points.rows(); ++v)
  {
    if (bar.labels[v] == 2)
    {
      middle += arap.posed().row(v).transpose();
      count += 1.0;
    }
    else if (bar.labels[v] == 1) // this region has mode full and is at rest
    {
      EXPECT_EQ(arap.posed().row(v), bar.mesh.points.row(v));
    }
  }
  EXPECT_LT((middle / count - Vec3(2, 0.8, 0.5)).norm(), 1e-10);
}

TEST(FullArapRobustness, ABoneTakesTheVerticesAlongIt)
{
  TetMesh mesh = tet_box(8, 2, 2, Vec3::Zero(), Vec3(4, 1, 1));
  Handles handles{ bone_handle("first", Vec3(0, 0.5, 0.5), Vec3(2, 0.5, 0.5)),
    bone_handle("second", Vec3(2, 0.5, 0.5), Vec3(4, 0.5, 0.5)) };
  ExecutionContext context;
  FullArap arap;
  ASSERT_TRUE(arap.bind(context, mesh.points, mesh.tets, handles).ok());
  Pose pose = posed(handles, HandleMode::full);
  pose[1].transform = affine_about(
    handles[1].head, rigid(60, Vec3(0, 0, 1), Vec3::Zero()).leftCols<3>(), Vec3::Zero());
  Status status = arap.solve(context, pose);
  ASSERT_TRUE(status.usable());
  EXPECT_TRUE(status.warnings.empty());
  EXPECT_EQ(status.report.number("counts.constrained", 0), 9);
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    const Vec3 p = mesh.points.row(v);
    if (p.y() == 0.5 && p.z() == 0.5)
    {
      const Vec3 target = p.x() <= 2.0 ? p : Vec3(pose[1].transform * p.homogeneous());
      EXPECT_LT((arap.posed().row(v).transpose() - target).norm(), 1e-14);
    }
  }
  // The bone passes between the vertices, so points along the bone are constrained inside of
  // elements.
  handles[0].head += Vec3(0.03, 0.11, 0.07);
  handles[0].tail += Vec3(-0.03, 0.12, 0.09);
  handles.resize(1);
  ASSERT_TRUE(arap.bind(context, mesh.points, mesh.tets, handles).ok());
  const Affine t = rigid(30, Vec3(1, 2, 0), Vec3(1, 2, 3));
  status = arap.solve(context, posed(handles, HandleMode::full, t));
  ASSERT_TRUE(status.ok());
  EXPECT_TRUE(status.warnings.empty());
  EXPECT_LT((arap.posed() - moved(mesh.points, t)).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(FullArapRobustness, RedundantAndContradictingHandlesAreNamed)
{
  Cloth cloth;
  // The points e, f and g are in one triangle, which has a corner at the handle at (0, 0). The
  // triangle therefore has four constrained positions. Only three of them are independent.
  cloth.handles.push_back(point_handle("e", Vec3(0.06, 0.01, 0)));
  cloth.handles.push_back(point_handle("f", Vec3(0.10, 0.02, 0)));
  cloth.handles.push_back(point_handle("g", Vec3(0.12, 0.01, 0)));
  ExecutionContext context;
  FullArap arap;
  ASSERT_TRUE(arap.bind(context, cloth.mesh.points, cloth.mesh.triangles, cloth.handles).ok());
  const Affine t = rigid(20, Vec3(0, 1, 0), Vec3(0, 0, 1));
  Pose pose = posed(cloth.handles, HandleMode::position, t);
  Status status = arap.solve(context, pose);
  ASSERT_TRUE(status.usable());
  ASSERT_EQ(status.warnings.size(), 1u);
  EXPECT_THAT(status.warnings[0], HasSubstr("redundant"));
  EXPECT_LT(status.report.number("constraint_residual", 1.0), 1e-11);
  pose[5].transform.col(3) += Vec3(0, 0, 0.1);
  status = arap.solve(context, pose);
  ASSERT_TRUE(status.usable());
  ASSERT_EQ(status.warnings.size(), 2u);
  EXPECT_THAT(status.warnings[1], HasSubstr("contradict"));
  EXPECT_THAT(status.warnings[1], HasSubstr("'f'"));
  EXPECT_TRUE(arap.posed().allFinite());
  // Two handles of mode full constrain the same vertex. The result is the mean of their targets.
  LabeledBar bar = labeled_bar(4);
  Handle corner = point_handle("corner", Vec3(0, 0, 0));
  bar.handles.push_back(corner);
  ASSERT_TRUE(arap
                .bind(context, bar.mesh.points, bar.mesh.tets, bar.handles,
                  { ArapEnergy::automatic, bar.labels })
                .ok());
  pose = posed(bar.handles, HandleMode::full);
  pose[3].transform.col(3) << 0, 0, 1;
  status = arap.solve(context, pose);
  ASSERT_TRUE(status.usable());
  ASSERT_EQ(status.warnings.size(), 1u);
  EXPECT_THAT(status.warnings[0], HasSubstr("'left', 'corner'"));
  EXPECT_LT(
    (arap.posed().rowwise() - Eigen::RowVector3d(0, 0, 0.5)).rowwise().norm().minCoeff(), 1e-12);
}

TEST(FullArapRobustness, WhatNothingHoldsStays)
{
  // The mesh has two squares and an unused point. Only the first square has handles.
  TriangleMesh two =
    test::join(test::grid(3, 3), test::translated(test::grid(3, 3), Vec3(5, 0, 0)));
  two.points.conservativeResize(two.points.rows() + 1, Eigen::NoChange);
  two.points.row(two.points.rows() - 1) << 7, 7, 7;
  const Index first = 16;
  ExecutionContext context;
  for (const ArapEnergy energy : every_energy)
  {
    FullArap arap;
    const Handles handles{ point_handle("a", Vec3(0, 0, 0)), point_handle("b", Vec3(1, 0, 0)) };
    ASSERT_TRUE(arap.bind(context, two.points, two.triangles, handles, { energy, {} }).ok());
    // If all handles are free, nothing constrains the mesh.
    ASSERT_TRUE(arap.solve(context, posed(handles, HandleMode::free)).ok());
    EXPECT_LT((arap.posed() - two.points).cwiseAbs().maxCoeff(), 1e-12);
    // Pose the handles, then return them to rest. Two points do not determine the rotation around
    // the line between them. The initial guess takes this rotation from the transforms of the
    // handles.
    arap.discard_rotations();
    Pose pose = posed(handles, HandleMode::full, rigid(90, Vec3(0, 0, 1), Vec3(1, 1, 1)));
    ASSERT_TRUE(arap.solve(context, pose).ok());
    EXPECT_LT(
      (arap.posed().bottomRows(17) - two.points.bottomRows(17)).cwiseAbs().maxCoeff(), 1e-12);
    const Points wanted = moved(two.points, pose[0].transform);
    EXPECT_LT((arap.posed().topRows(first) - wanted.topRows(first)).cwiseAbs().maxCoeff(), 1e-9);
    FullArap::SolveOptions options;
    options.start = FullArap::Start::guess;
    ASSERT_TRUE(arap.solve(context, posed(handles, HandleMode::full), options).ok());
    EXPECT_LT((arap.posed() - two.points).cwiseAbs().maxCoeff(), 1e-9);
    // A single constrained position translates the square.
    pose = posed(handles, HandleMode::free);
    pose[0].mode = HandleMode::position;
    pose[0].transform.col(3) << 0, 0, 2;
    ASSERT_TRUE(arap.solve(context, pose, options).ok());
    EXPECT_LT((arap.posed().topRows(first) - moved(two.points, pose[0].transform).topRows(first))
                .cwiseAbs()
                .maxCoeff(),
      1e-9);
  }
}

TEST(FullArapRobustness, FlatAndNeedleTrianglesDoNoHarm)
{
  Cloth cloth;
  TriangleMesh& mesh = cloth.mesh;
  const Index n = mesh.points.rows(), f = mesh.triangles.rows();
  // Add a triangle without area at a new vertex, a needle, and a triangle with a repeated corner.
  mesh.points.conservativeResize(n + 2, Eigen::NoChange);
  mesh.points.row(n) << 2, 0, 0;
  mesh.points.row(n + 1) << 1.0 + 1e-13, 0.5, 0;
  mesh.triangles.conservativeResize(f + 3, Eigen::NoChange);
  mesh.triangles.row(f) << 5, 6, n;
  mesh.triangles.row(f + 1) << 6, 48, n + 1;
  mesh.triangles.row(f + 2) << 3, 3, 4;
  ExecutionContext context;
  for (const ArapEnergy energy : every_energy)
  {
    FullArap arap;
    const Status bound =
      arap.bind(context, mesh.points, mesh.triangles, cloth.handles, { energy, {} });
    ASSERT_TRUE(bound.ok());
    ASSERT_FALSE(bound.warnings.empty());
    EXPECT_THAT(bound.warnings[0], HasSubstr("3 of 75 triangles are too flat"));
    Pose pose = posed(cloth.handles, HandleMode::position);
    pose[3].transform.col(3) << 0, 0, 0.5;
    const Status status = arap.solve(context, pose);
    ASSERT_TRUE(status.usable());
    EXPECT_TRUE(arap.posed().allFinite());
    EXPECT_LT(arap.posed().cwiseAbs().maxCoeff(), 3.0);
    // The vertex that only the degenerate triangle uses moves like a vertex next to it.
    EXPECT_LT(
      ((arap.posed().row(n) - mesh.points.row(n)) - (arap.posed().row(5) - mesh.points.row(5)))
        .norm(),
      1e-15);
  }
}

TEST(FullArapRobustness, TheSameBitsForAnyNumberOfThreadsAndOneFactorizationForAllPoses)
{
  const LabeledBar bar = labeled_bar(16);
  Points first;
  for (const int threads : { 1, 2, 5 })
  {
    ExecutionContext context;
    context.set_threads(threads);
    FullArap arap;
    ASSERT_TRUE(arap
                  .bind(context, bar.mesh.points, bar.mesh.tets, bar.handles,
                    { ArapEnergy::automatic, bar.labels })
                  .ok());
    EXPECT_EQ(arap.factorizations(), 0);
    for (int i = 0; i < 3; ++i)
    {
      Pose pose = bend(HandleMode::position);
      pose[1].transform.col(3) *= i;
      ASSERT_TRUE(arap.solve(context, pose).usable());
    }
    EXPECT_EQ(arap.factorizations(), 1);
    if (threads == 1)
    {
      first = arap.posed();
    }
    EXPECT_EQ(arap.posed(), first);
    ASSERT_TRUE(arap.solve(context, bend(HandleMode::free)).usable());
    EXPECT_EQ(arap.factorizations(), 2);
  }
}

// Results do not depend on the unit of length, the position or the direction of the mesh.
TEST(FullArapRobustness, ScaleAndPlaceOfTheWorldDoNotMatter)
{
  const LabeledBar bar = labeled_bar(6);
  ExecutionContext context;
  FullArap arap;
  ASSERT_TRUE(arap
                .bind(context, bar.mesh.points, bar.mesh.tets, bar.handles,
                  { ArapEnergy::automatic, bar.labels })
                .ok());
  FullArap::SolveOptions options = plain(30, FullArap::Start::guess);
  ASSERT_TRUE(arap.solve(context, bend(HandleMode::position), options).ok());
  const Points small = arap.posed();
  for (const double scale : { 1e-3, 1e3 })
  {
    const Eigen::Matrix3d turn = rigid(130, Vec3(3, -1, 2), Vec3::Zero()).leftCols<3>();
    const Vec3 move = scale * Vec3(10, -20, 5);
    const auto carry = [&](const Vec3& p) -> Vec3 { return scale * (turn * p) + move; };
    LabeledBar large = bar;
    Pose pose = bend(HandleMode::position);
    for (Index v = 0; v < bar.mesh.points.rows(); ++v)
    {
      large.mesh.points.row(v) = carry(bar.mesh.points.row(v)).transpose();
    }
    for (std::size_t h = 0; h < pose.size(); ++h)
    {
      large.handles[h].head = large.handles[h].tail = carry(bar.handles[h].head);
      const Eigen::Matrix3d linear = pose[h].transform.leftCols<3>();
      const Vec3 shift = pose[h].transform.col(3);
      pose[h].transform.leftCols<3>() = turn * linear * turn.transpose();
      pose[h].transform.col(3) =
        scale * (turn * shift) + move - pose[h].transform.leftCols<3>() * move;
    }
    FullArap other;
    ASSERT_TRUE(other
                  .bind(context, large.mesh.points, large.mesh.tets, large.handles,
                    { ArapEnergy::automatic, bar.labels })
                  .ok());
    ASSERT_TRUE(other.solve(context, pose, options).ok());
    for (Index v = 0; v < small.rows(); ++v)
    {
      ASSERT_LT((other.posed().row(v).transpose() - carry(small.row(v))).norm(), 1e-9 * scale);
    }
  }
}

TEST(FullArapRobustness, BadInputIsNamed)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Cloth cloth;
  ExecutionContext context;
  FullArap arap;
  const auto message = [&](const Points& points, const Triangles& triangles, const Handles& handles,
                         const std::vector<Index>& labels = {})
  {
    const Status status =
      arap.bind(context, points, triangles, handles, { ArapEnergy::automatic, labels });
    EXPECT_EQ(status.code, StatusCode::invalid_input);
    return status.message;
  };
  Points broken = cloth.mesh.points;
  broken(7, 1) = nan;
  EXPECT_THAT(message(broken, cloth.mesh.triangles, cloth.handles), HasSubstr("7"));
  EXPECT_THAT(message(cloth.mesh.points, Triangles(0, 3), cloth.handles), HasSubstr("no elements"));
  EXPECT_THAT(message(Points::Zero(49, 3), cloth.mesh.triangles, cloth.handles),
    HasSubstr("no triangle has an area"));
  EXPECT_FALSE(message(cloth.mesh.points, cloth.mesh.triangles, {}).empty());
  Handles regions{ region_handle("r", 3, Vec3::Zero()) };
  EXPECT_THAT(message(cloth.mesh.points, cloth.mesh.triangles, regions),
    HasSubstr("region 'r' needs a point array of labels"));
  EXPECT_THAT(message(cloth.mesh.points, cloth.mesh.triangles, regions, std::vector<Index>(49, 1)),
    HasSubstr("no vertex of the mesh has the label 3"));
  EXPECT_THAT(message(cloth.mesh.points, cloth.mesh.triangles, regions, { 1, 2 }),
    HasSubstr("2 region labels"));
  regions[0].region_id = 0;
  EXPECT_THAT(message(cloth.mesh.points, cloth.mesh.triangles, regions, std::vector<Index>(49, 1)),
    HasSubstr("region 'r' has no label"));
  Handles far{ point_handle("far", Vec3(0, 0, 3)), point_handle("b", Vec3(1, 0, 0)) };
  const Status bind_status = arap.bind(context, cloth.mesh.points, cloth.mesh.triangles, far);
  ASSERT_TRUE(bind_status.ok());
  ASSERT_EQ(bind_status.warnings.size(), 1u);
  EXPECT_THAT(bind_status.warnings[0], HasSubstr("'far'"));
  EXPECT_THAT(bind_status.warnings[0], HasSubstr("2.121 bounding-box diagonals"));

  ASSERT_TRUE(arap.bind(context, cloth.mesh.points, cloth.mesh.triangles, cloth.handles).ok());
  EXPECT_THAT(arap.solve(context, Pose(3)).message, HasSubstr("the pose has 3 handles"));
  Pose pose(4);
  pose[2].transform(0, 0) = nan;
  EXPECT_THAT(arap.solve(context, pose).message, HasSubstr("handle 'c'"));
  pose = posed(cloth.handles, HandleMode::position);
  pose[3].transform.col(3) << 0, 0, 0.9;
  FullArap::SolveOptions options;
  options.max_iterations = 2;
  const Status status = arap.solve(context, pose, options);
  EXPECT_EQ(status.code, StatusCode::not_converged);
  EXPECT_THAT(status.message, HasSubstr("the last of 2 iterations"));
}

TEST(FullArapRobustness, CancelEndsASolveAndTheNextIsWhole)
{
  const LabeledBar bar = labeled_bar(12);
  FullArap arap, reference;
  ExecutionContext context;
  ASSERT_TRUE(arap
                .bind(context, bar.mesh.points, bar.mesh.tets, bar.handles,
                  { ArapEnergy::automatic, bar.labels })
                .ok());
  ASSERT_TRUE(reference
                .bind(context, bar.mesh.points, bar.mesh.tets, bar.handles,
                  { ArapEnergy::automatic, bar.labels })
                .ok());
  int cancel_checks = 0;
  ExecutionContext stopping({}, [&cancel_checks] { return ++cancel_checks > 200; });
  stopping.set_threads(1);
  EXPECT_EQ(arap.solve(stopping, bend(HandleMode::free), plain(1000, FullArap::Start::last)).code,
    StatusCode::canceled);
  ASSERT_TRUE(arap.solve(context, bend(HandleMode::free)).usable());
  ASSERT_TRUE(reference.solve(context, bend(HandleMode::free)).usable());
  EXPECT_EQ(arap.posed(), reference.posed());
  ExecutionContext before;
  before.request_cancel();
  EXPECT_EQ(arap
              .bind(before, bar.mesh.points, bar.mesh.tets, bar.handles,
                { ArapEnergy::automatic, bar.labels })
              .code,
    StatusCode::canceled);
}
