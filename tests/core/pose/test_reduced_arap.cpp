// Reduced as-rigid-as-possible: against a dense twin, against the full method, and what must hold
// whatever the weights.
#include "pose/reduced_arap.h"

#include "pose/pose_file.h"
#include "support/bars.h"
#include "support/meshes.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
Affine rigid(double degrees, const Vec3& axis, const Vec3& move)
{
  Affine t;
  t.leftCols<3>() =
    Eigen::AngleAxisd(degrees * EIGEN_PI / 180.0, axis.normalized()).toRotationMatrix();
  t.col(3) = move;
  return t;
}

Points moved(const Points& points, const Affine& t)
{
  Points result(points.rows(), 3);
  for (Index v = 0; v < points.rows(); ++v)
  {
    result.row(v) = (t * points.row(v).transpose().homogeneous()).transpose();
  }
  return result;
}

Pose posed(const Handles& handles, HandleMode mode, const Affine& t = identity_affine())
{
  Pose pose(handles.size());
  for (HandlePose& handle : pose)
  {
    handle.mode = mode;
    handle.transform = t;
  }
  return pose;
}

constexpr ReducedArap::SolveOptions iterations(Index count)
{
  return { 0.0, count, false };
}

/// Bends a bar: left end held, right end turned and moved, middle as told.
Pose bend(HandleMode middle)
{
  Pose pose(3);
  pose[1].mode = middle;
  pose[1].transform.col(3) << 0.0, 0.3, 0.0;
  pose[2].transform = affine_about(
    Vec3(4, 0.5, 0.5), rigid(70, Vec3(0, 0, 1), Vec3::Zero()).leftCols<3>(), Vec3(-1, 1.5, 0));
  return pose;
}

/// The best rotation for a matrix, by Eigen's SVD.
Eigen::Matrix3d svd_rotation(const Eigen::Matrix3d& s)
{
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(s, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d flip = Eigen::Matrix3d::Identity();
  flip(2, 2) = (svd.matrixV() * svd.matrixU().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  return svd.matrixV() * flip * svd.matrixU().transpose();
}

/// The whole of the method with plain dense matrices: M, L and K as they are written down,
/// constraints by one KKT system, rotations by SVD.
Points dense_twin(const test::Rig& rig, const RotationGroups& groups, const Pose& pose, Index count)
{
  const Index n = rig.mesh.points.rows(), m = rig.weights.cols(), r = groups.count;
  Eigen::MatrixXd basis(n, 4 * m);
  for (Index v = 0; v < n; ++v)
  {
    for (Index j = 0; j < m; ++j)
    {
      basis.block<1, 4>(v, 4 * j) =
        rig.weights(v, j) * rig.mesh.points.row(v).transpose().homogeneous().transpose();
    }
  }
  const Eigen::MatrixXd l = stiffness_matrix(rig.mesh.points, rig.mesh.tets);
  const Eigen::MatrixXd k = covariance_matrix(rig.mesh.points, rig.mesh.tets, groups);
  std::vector<Eigen::RowVectorXd> rows;
  std::vector<Eigen::RowVector3d> values;
  for (Index h = 0; h < m; ++h)
  {
    const HandlePose& handle = pose[static_cast<std::size_t>(h)];
    if (handle.mode == HandleMode::full)
    {
      for (Index a = 0; a < 4; ++a)
      {
        rows.emplace_back(Eigen::RowVectorXd::Unit(4 * m, 4 * h + a));
        values.emplace_back(handle.transform.col(a).transpose());
      }
    }
    else if (handle.mode == HandleMode::position)
    {
      const Vec3 pivot = rig.handles[static_cast<std::size_t>(h)].head;
      Index vertex = 0;
      (rig.mesh.points.rowwise() - pivot.transpose()).rowwise().squaredNorm().minCoeff(&vertex);
      rows.emplace_back(basis.row(vertex));
      values.emplace_back((handle.transform * pivot.homogeneous()).transpose());
    }
  }
  const auto c = static_cast<Index>(rows.size());
  Eigen::MatrixXd kkt = Eigen::MatrixXd::Zero(4 * m + c, 4 * m + c);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(4 * m + c, 3);
  kkt.topLeftCorner(4 * m, 4 * m) = basis.transpose() * l * basis;
  for (Index i = 0; i < c; ++i)
  {
    kkt.block(4 * m + i, 0, 1, 4 * m) = rows[static_cast<std::size_t>(i)];
    kkt.block(0, 4 * m + i, 4 * m, 1) = rows[static_cast<std::size_t>(i)].transpose();
    right.row(4 * m + i) = values[static_cast<std::size_t>(i)];
  }
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver(kkt);
  Eigen::MatrixXd rotations(3 * r, 3);
  for (Index g = 0; g < r; ++g)
  {
    for (Index i = 0; i < 3; ++i)
    {
      rotations.row(i * r + g) = Eigen::RowVector3d::Unit(i);
    }
  }
  Points result;
  for (Index i = 0; i <= count; ++i)
  {
    right.topRows(4 * m) = basis.transpose() * k.transpose() * rotations;
    result = basis * solver.solve(right).topRows(4 * m);
    const Eigen::MatrixXd s = k * result;
    for (Index g = 0; g < r; ++g)
    {
      Eigen::Matrix3d one;
      one << s.row(g), s.row(r + g), s.row(2 * r + g);
      const Eigen::Matrix3d rotation = svd_rotation(one);
      for (Index a = 0; a < 3; ++a)
      {
        rotations.row(a * r + g) = rotation.transpose().row(a);
      }
    }
  }
  return result;
}

/// Every vertex its own handle: the reduced space is the whole space.
test::Rig whole_space()
{
  test::Rig rig;
  rig.mesh = test::tet_box(2, 2, 2);
  test::Random random(3);
  for (Index v = 0; v < rig.mesh.points.rows(); ++v)
  {
    rig.mesh.points.row(v) += random.in_box(Vec3::Constant(-0.1), Vec3::Constant(0.1)).transpose();
    Handle handle;
    handle.name = "v" + std::to_string(v);
    handle.head = handle.tail = rig.mesh.points.row(v);
    rig.handles.push_back(handle);
  }
  rig.weights = Weights::Identity(rig.mesh.points.rows(), rig.mesh.points.rows());
  return rig;
}

/// Full as-rigid-as-possible with some vertices given: one sparse system, one rotation a group.
Points full_arap(const TetMesh& mesh, const RotationGroups& groups, const std::vector<Index>& fixed,
  const Points& targets, Index count)
{
  const Index n = mesh.points.rows(), r = groups.count;
  const Eigen::MatrixXd l = stiffness_matrix(mesh.points, mesh.tets);
  const Eigen::MatrixXd k = covariance_matrix(mesh.points, mesh.tets, groups);
  std::vector<Index> open;
  for (Index v = 0; v < n; ++v)
  {
    if (std::find(fixed.begin(), fixed.end(), v) == fixed.end())
    {
      open.push_back(v);
    }
  }
  const Eigen::MatrixXd inner = l(open, open), border = l(open, fixed);
  const Eigen::PartialPivLU<Eigen::MatrixXd> solver(inner);
  Eigen::MatrixXd rotations(3 * r, 3);
  for (Index g = 0; g < r; ++g)
  {
    for (Index i = 0; i < 3; ++i)
    {
      rotations.row(i * r + g) = Eigen::RowVector3d::Unit(i);
    }
  }
  Points result = targets;
  for (Index i = 0; i <= count; ++i)
  {
    const Eigen::MatrixXd force = k.transpose() * rotations;
    const Eigen::MatrixXd given = targets(fixed, Eigen::all);
    const Eigen::MatrixXd right = force(open, Eigen::all) - border * given;
    const Eigen::MatrixXd solution = solver.solve(right);
    result(open, Eigen::all) = solution;
    const Eigen::MatrixXd s = k * result;
    for (Index g = 0; g < r; ++g)
    {
      Eigen::Matrix3d one;
      one << s.row(g), s.row(r + g), s.row(2 * r + g);
      for (Index a = 0; a < 3; ++a)
      {
        rotations.row(a * r + g) = svd_rotation(one).transpose().row(a);
      }
    }
  }
  return result;
}
} // namespace

TEST(ReducedArap, EveryIterateIsThatOfTheDenseTwin)
{
  const test::Rig rig = test::bar();
  ExecutionContext context;
  for (const ArapEnergy energy : { ArapEnergy::elements, ArapEnergy::spokes_and_rims })
  {
    ReducedArap arap;
    ASSERT_TRUE(
      arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles, { energy, 7, 0 })
        .ok());
    for (const HandleMode middle : { HandleMode::position, HandleMode::free })
    {
      Pose pose = bend(middle);
      pose[0].mode = HandleMode::position; // full handles would turn the first guess
      pose[2].mode = HandleMode::position;
      for (const Index count : { 0, 1, 2, 10 })
      {
        ASSERT_TRUE(arap.solve(context, pose, iterations(count)).ok());
        Points result;
        ASSERT_TRUE(arap.deform(context, rig.mesh.points, result).ok());
        const Points twin = dense_twin(rig, arap.groups(), pose, count);
        EXPECT_LT((result - twin).cwiseAbs().maxCoeff(), 1e-9) << count;
      }
    }
  }
}

// SPEC D32
TEST(ReducedArap, TheWholeSpaceIsFullArapIterateByIterate)
{
  const test::Rig rig = whole_space();
  const Index n = rig.mesh.points.rows();
  ExecutionContext context;
  for (const ArapEnergy energy : { ArapEnergy::elements, ArapEnergy::spokes_and_rims })
  {
    ReducedArap arap;
    ASSERT_TRUE(arap
                  .bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles,
                    { energy, 4 * n, 0 })
                  .ok());
    EXPECT_EQ(arap.groups().count, energy == ArapEnergy::elements ? rig.mesh.tets.rows() : n);
    const std::vector<Index> fixed{ 0, 1, 2, 25, 26 };
    Pose pose = posed(rig.handles, HandleMode::free);
    Points targets = rig.mesh.points;
    for (const Index v : fixed)
    {
      const Affine t = v < 3 ? identity_affine() : rigid(50, Vec3(1, 1, 0), Vec3(0.4, 0, 0.3));
      pose[static_cast<std::size_t>(v)].mode = HandleMode::position;
      pose[static_cast<std::size_t>(v)].transform = t;
      targets.row(v) = (t * rig.mesh.points.row(v).transpose().homogeneous()).transpose();
    }
    for (const Index count : { 0, 1, 2, 5, 20 })
    {
      arap.solve(context, pose, iterations(count));
      Points result;
      ASSERT_TRUE(arap.deform(context, rig.mesh.points, result).ok());
      const Points full = full_arap(rig.mesh, arap.groups(), fixed, targets, count);
      EXPECT_LT((result - full).cwiseAbs().maxCoeff(), 1e-10) << count;
    }
  }
}

// SPEC D31
TEST(ReducedArap, NoHalfStepRaisesTheEnergyAndTheLastIsTheEdgeSum)
{
  const test::Rig rig = test::bar();
  ExecutionContext context;
  for (const ArapEnergy energy : { ArapEnergy::elements, ArapEnergy::spokes_and_rims })
  {
    for (const Index extra : { 0, 4 })
    {
      ReducedArap arap;
      ASSERT_TRUE(arap
                    .bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles,
                      { energy, 0, extra })
                    .ok());
      for (const HandleMode middle : { HandleMode::position, HandleMode::free, HandleMode::full })
      {
        ASSERT_TRUE(arap.solve(context, bend(middle), iterations(60)).ok());
        const std::vector<double>& e = arap.energies();
        ASSERT_EQ(e.size(), 121u);
        for (std::size_t i = 1; i < e.size(); ++i)
        {
          ASSERT_LE(e[i], e[i - 1] + 1e-12 * arap.rest_energy());
        }
        Points result;
        ASSERT_TRUE(arap.deform(context, rig.mesh.points, result).ok());
        const double sum =
          arap_energy(rig.mesh.points, rig.mesh.tets, arap.groups(), result, arap.rotations());
        EXPECT_NEAR(e.back(), sum, 1e-12 * arap.rest_energy());
      }
    }
  }
}

// SPEC D33
TEST(ReducedArap, RigidTargetsAreReached)
{
  const test::Rig rig = test::box();
  ExecutionContext context;
  ReducedArap arap;
  ASSERT_TRUE(arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).ok());
  for (const double degrees : { 10.0, 90.0, 170.0 })
  {
    const Affine t = rigid(degrees, Vec3(1, 2, 3), Vec3(5, -2, 1));
    ASSERT_TRUE(
      arap.solve(context, posed(rig.handles, HandleMode::position, t), iterations(2000)).ok());
    Points result;
    ASSERT_TRUE(arap.deform(context, rig.mesh.points, result).ok());
    EXPECT_LT((result - moved(rig.mesh.points, t)).cwiseAbs().maxCoeff(), 1e-10) << degrees;
    EXPECT_LT(
      arap_energy(rig.mesh.points, rig.mesh.tets, arap.groups(), result, arap.rotations()), 1e-20);
  }
  // One full handle says it all.
  const Affine t = rigid(180, Vec3(0, 1, 0), Vec3(0, 0, 7));
  Pose pose = posed(rig.handles, HandleMode::free);
  pose[2] = { HandleMode::full, t, 1.0, Eigen::Vector2d::Zero() };
  ASSERT_TRUE(arap.solve(context, pose, iterations(50)).ok());
  Points result;
  ASSERT_TRUE(arap.deform(context, rig.mesh.points, result).ok());
  EXPECT_LT((result - moved(rig.mesh.points, t)).cwiseAbs().maxCoeff(), 1e-10);
}

// SPEC D34
TEST(ReducedArap, OneClusterIsOneProcrustesRotation)
{
  const test::Rig rig = test::bar();
  ExecutionContext context;
  ReducedArap arap;
  ASSERT_TRUE(arap
                .bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles,
                  { ArapEnergy::spokes_and_rims, 1, 0 })
                .ok());
  ASSERT_EQ(arap.groups().count, 1);
  ASSERT_TRUE(arap.solve(context, bend(HandleMode::position), iterations(3000)).ok());
  Points result;
  ASSERT_TRUE(arap.deform(context, rig.mesh.points, result).ok());
  // With one rotation the covariance is V^T L V': no edge lists needed.
  const SparseMatrix l = stiffness_matrix(rig.mesh.points, rig.mesh.tets);
  const Eigen::Matrix3d s = rig.mesh.points.transpose() * (l * result);
  EXPECT_LT((svd_rotation(s) - arap.rotations()[0]).cwiseAbs().maxCoeff(), 1e-9);
}

// SPEC D34, 3.9: fewer rotations or fewer transforms cost energy.
TEST(ReducedArap, ReductionCostsEnergy)
{
  const test::Rig rig = test::bar();
  ExecutionContext context;
  const auto energy_of = [&](Index clusters)
  {
    ReducedArap arap;
    EXPECT_TRUE(arap
                  .bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles,
                    { ArapEnergy::spokes_and_rims, clusters, 0 })
                  .ok());
    EXPECT_TRUE(arap.solve(context, bend(HandleMode::position), iterations(500)).ok());
    return arap.energies().back();
  };
  const double own = energy_of(rig.mesh.points.rows());
  EXPECT_EQ(own, energy_of(10 * rig.mesh.points.rows()));
  EXPECT_LT(own, energy_of(6));
  EXPECT_LT(energy_of(6), energy_of(1));
  // Full: the handles' vertices where the reduced method put them, all others free.
  ReducedArap arap;
  ASSERT_TRUE(arap
                .bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles,
                  { ArapEnergy::spokes_and_rims, rig.mesh.points.rows(), 0 })
                .ok());
  ASSERT_TRUE(arap.solve(context, bend(HandleMode::full), iterations(500)).ok());
  Points reduced;
  ASSERT_TRUE(arap.deform(context, rig.mesh.points, reduced).ok());
  std::vector<Index> fixed;
  for (Index v = 0; v < rig.mesh.points.rows(); ++v)
  {
    if (rig.weights.row(v).maxCoeff() > 1.0 - 1e-12)
    {
      fixed.push_back(v);
    }
  }
  const Points full = full_arap(rig.mesh, arap.groups(), fixed, reduced, 500);
  std::vector<Eigen::Matrix3d> rotations;
  const Eigen::MatrixXd s = covariance_matrix(rig.mesh.points, rig.mesh.tets, arap.groups()) * full;
  for (Index g = 0; g < arap.groups().count; ++g)
  {
    Eigen::Matrix3d one;
    one << s.row(g), s.row(arap.groups().count + g), s.row(2 * arap.groups().count + g);
    rotations.push_back(svd_rotation(one));
  }
  EXPECT_LT(arap_energy(rig.mesh.points, rig.mesh.tets, arap.groups(), full, rotations),
    arap.energies().back());
}

// SPEC D35
TEST(ReducedArap, AllHandlesFullIsLinearBlendSkinningToTheBit)
{
  const test::Rig rig = test::box();
  ExecutionContext context;
  ReducedArap arap;
  ASSERT_TRUE(arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).ok());
  test::Random random(5);
  Pose pose = posed(rig.handles, HandleMode::full);
  std::vector<Affine> transforms;
  for (HandlePose& handle : pose)
  {
    handle.transform = rigid(random.uniform(-90, 90), random.in_box(-Vec3::Ones(), Vec3::Ones()),
      random.in_box(-Vec3::Ones(), Vec3::Ones()));
    handle.transform.col(1) *= 1.5;
    transforms.push_back(handle.transform);
  }
  ASSERT_TRUE(arap.solve(context, pose).usable());
  Skinning skinning;
  ASSERT_TRUE(skinning.bind(context, rig.weights).ok());
  Points reduced, blended;
  ASSERT_TRUE(arap.deform(context, rig.mesh.points, reduced).ok());
  ASSERT_TRUE(skinning.linear_blend(context, rig.mesh.points, transforms, blended).ok());
  EXPECT_EQ(reduced, blended);
}

// SPEC D36
TEST(ReducedArap, PositionsAreMetAfterEveryIteration)
{
  const test::Rig rig = test::box();
  ExecutionContext context;
  ReducedArap arap;
  ASSERT_TRUE(arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).ok());
  Pose pose = posed(rig.handles, HandleMode::position);
  test::Random random(9);
  for (HandlePose& handle : pose)
  {
    handle.transform.col(3) = random.in_box(-Vec3::Ones(), Vec3::Ones());
  }
  pose[4].mode = HandleMode::free;
  for (Index count = 0; count < 20; ++count)
  {
    const Status status = arap.solve(context, pose, iterations(count));
    ASSERT_TRUE(status.ok() && status.warnings.empty());
    ASSERT_LT(status.report.number("constraint_residual", 1.0), 1e-12);
    Points result;
    ASSERT_TRUE(arap.deform(context, rig.mesh.points, result).ok());
    for (std::size_t h = 0; h < 4; ++h)
    {
      const Vec3 target = rig.handles[h].head + pose[h].transform.col(3);
      ASSERT_LT((result.rowwise() - target.transpose()).rowwise().norm().minCoeff(), 1e-12);
    }
  }
}

TEST(ReducedArap, APivotInsideATetIsThatPointOfTheMesh)
{
  test::Rig rig = test::bar();
  const Vec3 inside(1.13, 0.31, 0.77);
  rig.handles[1].head = rig.handles[1].tail = inside;
  ExecutionContext context;
  ReducedArap arap;
  ASSERT_TRUE(arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).ok());
  ASSERT_TRUE(arap.solve(context, bend(HandleMode::position)).usable());
  Points result;
  ASSERT_TRUE(arap.deform(context, rig.mesh.points, result).ok());
  // Where the mesh takes the point: find it in its tet by hand.
  for (Index e = 0; e < rig.mesh.tets.rows(); ++e)
  {
    Eigen::Matrix4d corners;
    Eigen::Matrix<double, 3, 4> to;
    for (int k = 0; k < 4; ++k)
    {
      corners.col(k) = rig.mesh.points.row(rig.mesh.tets(e, k)).transpose().homogeneous();
      to.col(k) = result.row(rig.mesh.tets(e, k));
    }
    const Eigen::Vector4d lambda = corners.fullPivLu().solve(inside.homogeneous());
    if (lambda.minCoeff() > 0.0)
    {
      EXPECT_LT((to * lambda - (inside + Vec3(0, 0.3, 0))).norm(), 1e-12);
    }
  }
}

// SPEC D36, second half
TEST(ReducedArap, RedundantAndContradictingPositionsAreNamed)
{
  test::Rig rig = test::bar();
  Handle bone; // begins where the point handle "right" is
  bone.name = "tail bone";
  bone.kind = HandleKind::bone;
  bone.head = rig.handles[2].head;
  bone.tail = Vec3(5, 0.5, 0.5);
  rig.handles.push_back(bone);
  Weights weights(rig.weights.rows(), 4);
  weights << rig.weights, 0.5 * rig.weights.col(2);
  weights.col(2) *= 0.5;
  ExecutionContext context;
  ReducedArap arap;
  ASSERT_TRUE(arap.bind(context, rig.mesh.points, rig.mesh.tets, weights, rig.handles).ok());
  Pose pose = posed(rig.handles, HandleMode::position);
  pose[0].mode = HandleMode::full;
  pose[2].transform.col(3) << 0, 1, 0;
  pose[3].transform.col(3) << 0, 1, 0;
  Status status = arap.solve(context, pose);
  ASSERT_TRUE(status.usable());
  ASSERT_EQ(status.warnings.size(), 1u);
  EXPECT_THAT(status.warnings[0], HasSubstr("redundant"));
  EXPECT_LT(status.report.number("constraint_residual", 1.0), 1e-10);

  pose[3].transform.col(3) << 0, 2, 0;
  status = arap.solve(context, pose);
  ASSERT_TRUE(status.usable());
  ASSERT_EQ(status.warnings.size(), 2u);
  EXPECT_THAT(status.warnings[1], HasSubstr("contradict"));
  EXPECT_THAT(status.warnings[1], HasSubstr("'right', 'tail bone'"));
  Points result;
  ASSERT_TRUE(arap.deform(context, rig.mesh.points, result).ok());
  // Least squares: half way between the two wishes.
  EXPECT_LT((result.rowwise() - Eigen::RowVector3d(4, 2.0, 0.5)).rowwise().norm().minCoeff(), 1e-9);
}

// SPEC D37
TEST(ReducedArap, ExtraWeightsRestAtZeroAndLowerTheEnergy)
{
  const test::Rig rig = test::bar();
  ExecutionContext context;
  ReducedArap plain, wide;
  ReducedArapOptions options{ ArapEnergy::elements, rig.mesh.tets.rows(), 0 };
  ASSERT_TRUE(
    plain.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles, options).ok());
  options.extra_weights = 15;
  const Status bound =
    wide.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles, options);
  ASSERT_TRUE(bound.ok());
  EXPECT_TRUE(bound.warnings.empty());
  EXPECT_GT(bound.report.number("counts.extra_weights", 0), 3);
  Points result;
  ASSERT_TRUE(wide.solve(context, posed(rig.handles, HandleMode::full)).ok());
  ASSERT_TRUE(wide.deform(context, rig.mesh.points, result).ok());
  EXPECT_LT((result - rig.mesh.points).cwiseAbs().maxCoeff(), 1e-12);
  for (const HandleMode middle : { HandleMode::full, HandleMode::position, HandleMode::free })
  {
    ASSERT_TRUE(plain.solve(context, bend(middle), iterations(300)).ok());
    ASSERT_TRUE(wide.solve(context, bend(middle), iterations(300)).ok());
    EXPECT_LT(wide.energies().back(), plain.energies().back());
    // Extra weights vanish at the handles: the full ones stay what they are.
    ASSERT_TRUE(wide.deform(context, rig.mesh.points, result).ok());
    for (Index v = 0; v < rig.mesh.points.rows(); ++v)
    {
      if (rig.weights(v, 0) > 1.0 - 1e-13)
      {
        EXPECT_LT((result.row(v) - rig.mesh.points.row(v)).norm(), 1e-10);
      }
    }
  }
}

TEST(ReducedArap, RestStaysAtRestWhateverTheWeights)
{
  const test::Rig rig = test::box(3);
  const Index n = rig.mesh.points.rows();
  test::Random random(21);
  std::vector<Weights> cases;
  Weights dense(n, 5);
  for (Index v = 0; v < n; ++v)
  {
    for (Index j = 0; j < 5; ++j)
    {
      dense(v, j) = random.uniform(-1, 1);
    }
  }
  cases.push_back(dense);
  Weights ill = rig.weights; // two columns that differ by 1e-12
  ill.col(0) = 0.5 * (rig.weights.col(0) + rig.weights.col(1));
  ill.col(1) = ill.col(0) + 1e-12 * dense.col(0);
  cases.push_back(ill);
  Weights doubled = rig.weights;
  doubled.col(1) = doubled.col(0);
  cases.push_back(doubled);
  Weights empty = rig.weights;
  empty.col(3).setZero();
  cases.push_back(empty);
  cases.push_back(Weights::Zero(n, 5));
  for (const Weights& weights : cases)
  {
    ExecutionContext context;
    ReducedArap arap;
    ASSERT_TRUE(arap.bind(context, rig.mesh.points, rig.mesh.tets, weights, rig.handles).ok());
    for (const HandleMode mode : { HandleMode::full, HandleMode::position, HandleMode::free })
    {
      ASSERT_TRUE(arap.solve(context, posed(rig.handles, mode)).ok());
      Points result;
      ASSERT_TRUE(arap.deform(context, rig.mesh.points, result).ok());
      EXPECT_LT((result - rig.mesh.points).cwiseAbs().maxCoeff(), 1e-9);
    }
    // And a drag moves things by about as much as it moves the handle.
    Pose pose = posed(rig.handles, HandleMode::position);
    pose[1].transform.col(3) << 0.3, 0.2, 0.1;
    pose[2].mode = HandleMode::free;
    ASSERT_TRUE(arap.solve(context, pose).usable());
    Points result;
    ASSERT_TRUE(arap.deform(context, rig.mesh.points, result).ok());
    EXPECT_LT((result - rig.mesh.points).cwiseAbs().maxCoeff(), 3.0);
  }
}

TEST(ReducedArap, EmptyHandlesAreNamed)
{
  test::Rig rig = test::box(2);
  rig.weights.col(3).setZero();
  ExecutionContext context;
  ReducedArap arap;
  const Status status =
    arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles);
  ASSERT_TRUE(status.ok());
  ASSERT_EQ(status.warnings.size(), 2u);
  EXPECT_THAT(status.warnings[0], HasSubstr("do not sum to one"));
  EXPECT_THAT(status.warnings[1], HasSubstr("'z'"));
}

TEST(ReducedArap, FlatSurfacesBendOutOfTheirPlane)
{
  const TriangleMesh plane = test::grid(10, 4, 2.5, 1.0);
  Handles handles(2);
  handles[0].name = "left";
  handles[1].name = "right";
  handles[0].head = handles[0].tail = Vec3(0, 0.5, 0);
  handles[1].head = handles[1].tail = Vec3(2.5, 0.5, 0);
  Weights weights(plane.points.rows(), 2);
  for (Index v = 0; v < plane.points.rows(); ++v)
  {
    const double t = plane.points(v, 0) / 2.5;
    weights.row(v) << 1.0 - t * t * (3.0 - 2.0 * t), t * t * (3.0 - 2.0 * t);
  }
  ExecutionContext context;
  for (const ArapEnergy energy : { ArapEnergy::spokes_and_rims, ArapEnergy::elements })
  {
    ReducedArap arap;
    const Status bound =
      arap.bind(context, plane.points, plane.triangles, weights, handles, { energy, 0, 0 });
    ASSERT_TRUE(bound.ok());
    EXPECT_EQ(bound.report.text("method"),
      energy == ArapEnergy::elements ? "triangles" : "spokes_and_rims");
    Pose pose(2);
    pose[1].mode = HandleMode::position;
    pose[1].transform.col(3) << -0.3, 0, 0.8;
    ASSERT_TRUE(arap.solve(context, pose, iterations(200)).ok());
    Points result;
    ASSERT_TRUE(arap.deform(context, plane.points, result).ok());
    EXPECT_TRUE(result.allFinite());
    EXPECT_LT(
      (result.rowwise() - Eigen::RowVector3d(2.2, 0.5, 0.8)).rowwise().norm().minCoeff(), 1e-12);
    for (std::size_t i = 1; i < arap.energies().size(); ++i)
    {
      ASSERT_LE(arap.energies()[i], arap.energies()[i - 1] + 1e-12 * arap.rest_energy());
    }
  }
}

TEST(ReducedArap, MovesWithTheWorldAndScalesWithIt)
{
  const test::Rig rig = test::bar();
  ExecutionContext context;
  ReducedArap arap;
  ASSERT_TRUE(arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).ok());
  const Pose pose = bend(HandleMode::position);
  ASSERT_TRUE(arap.solve(context, pose, iterations(40)).ok());
  Points result;
  ASSERT_TRUE(arap.deform(context, rig.mesh.points, result).ok());

  Affine world = rigid(33, Vec3(1, -1, 2), Vec3(100, 20, -30));
  world.leftCols<3>() *= 50.0;
  Affine back;
  back.leftCols<3>() = world.leftCols<3>().inverse();
  back.col(3) = -back.leftCols<3>() * world.col(3);
  const auto compose = [](const Affine& a, const Affine& b)
  {
    Affine c;
    c.leftCols<3>() = a.leftCols<3>() * b.leftCols<3>();
    c.col(3) = a.leftCols<3>() * b.col(3) + a.col(3);
    return c;
  };
  test::Rig other = rig;
  other.mesh.points = moved(rig.mesh.points, world);
  Pose there = pose;
  for (std::size_t h = 0; h < 3; ++h)
  {
    other.handles[h].head = other.handles[h].tail = world * rig.handles[h].head.homogeneous();
    there[h].transform = compose(world, compose(pose[h].transform, back));
  }
  ReducedArap same;
  ASSERT_TRUE(
    same.bind(context, other.mesh.points, other.mesh.tets, other.weights, other.handles).ok());
  ASSERT_TRUE(same.solve(context, there, iterations(40)).ok());
  Points result_there;
  ASSERT_TRUE(same.deform(context, other.mesh.points, result_there).ok());
  EXPECT_LT((result_there - moved(result, world)).cwiseAbs().maxCoeff(), 1e-9 * 200);
  EXPECT_NEAR(same.energies().back(), 125000.0 * arap.energies().back(), 1e-6);
}

TEST(ReducedArap, TheOrderOfHandlesDoesNotMatter)
{
  const test::Rig rig = test::bar();
  const std::vector<std::size_t> order{ 2, 0, 1 };
  test::Rig other = rig;
  const Pose pose = bend(HandleMode::position);
  Pose permuted(3);
  for (std::size_t h = 0; h < 3; ++h)
  {
    other.handles[h] = rig.handles[order[h]];
    other.weights.col(static_cast<Index>(h)) = rig.weights.col(static_cast<Index>(order[h]));
    permuted[h] = pose[order[h]];
  }
  ExecutionContext context;
  ReducedArap a, b;
  const ReducedArapOptions options{ ArapEnergy::elements, rig.mesh.tets.rows(), 0 };
  ASSERT_TRUE(
    a.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles, options).ok());
  ASSERT_TRUE(
    b.bind(context, rig.mesh.points, rig.mesh.tets, other.weights, other.handles, options).ok());
  ASSERT_TRUE(a.solve(context, pose, iterations(30)).ok());
  ASSERT_TRUE(b.solve(context, permuted, iterations(30)).ok());
  Points first, second;
  ASSERT_TRUE(a.deform(context, rig.mesh.points, first).ok());
  ASSERT_TRUE(b.deform(context, rig.mesh.points, second).ok());
  EXPECT_LT((first - second).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(ReducedArap, AnyNumberOfThreadsGivesTheSameBits)
{
  const test::Rig rig = test::bar(40);
  Points results[2];
  double energies[2];
  for (int i = 0; i < 2; ++i)
  {
    ExecutionContext context;
    context.set_threads(i == 0 ? 1 : 4);
    ReducedArap arap;
    ASSERT_TRUE(arap
                  .bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles,
                    { ArapEnergy::automatic, 9, 6 })
                  .ok());
    ASSERT_TRUE(arap.solve(context, bend(HandleMode::position)).usable());
    ASSERT_TRUE(arap.deform(context, rig.mesh.points, results[i]).ok());
    energies[i] = arap.energies().back();
  }
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(energies[0], energies[1]);
}

TEST(ReducedArap, AWarmStartNeedsFewerIterations)
{
  const test::Rig rig = test::bar();
  ExecutionContext context;
  ReducedArap arap;
  ASSERT_TRUE(arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).ok());
  Pose pose = bend(HandleMode::position);
  ReducedArap::SolveOptions options;
  options.max_iterations = 1000;
  const Status cold = arap.solve(context, pose, options);
  ASSERT_TRUE(cold.ok()) << cold.message;
  pose[1].transform(0, 3) += 0.01;
  const Status warm = arap.solve(context, pose, options);
  ASSERT_TRUE(warm.ok());
  EXPECT_LT(warm.report.number("iterations", 1e9), cold.report.number("iterations", 0));
  // Forgetting gives what a fresh object gives.
  arap.forget();
  ASSERT_TRUE(arap.solve(context, pose, options).ok());
  ReducedArap fresh;
  ASSERT_TRUE(fresh.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).ok());
  ASSERT_TRUE(fresh.solve(context, pose, options).ok());
  EXPECT_EQ(fresh.energies(), arap.energies());
}

TEST(ReducedArap, TooFewIterationsSaySo)
{
  const test::Rig rig = test::bar();
  ExecutionContext context;
  ReducedArap arap;
  ASSERT_TRUE(arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).ok());
  const Status status = arap.solve(context, bend(HandleMode::position), { 1e-9, 2, true });
  EXPECT_EQ(status.code, StatusCode::not_converged);
  EXPECT_THAT(status.message, HasSubstr("last of 2 iterations"));
}

TEST(ReducedArap, BadInputIsNamed)
{
  const test::Rig rig = test::bar();
  ExecutionContext context;
  ReducedArap arap;
  const Weights short_rows = rig.weights.topRows(5);
  EXPECT_THAT(arap.bind(context, rig.mesh.points, rig.mesh.tets, short_rows, rig.handles).message,
    HasSubstr("5 rows"));
  const Weights two = rig.weights.leftCols(2);
  EXPECT_THAT(arap.bind(context, rig.mesh.points, rig.mesh.tets, two, rig.handles).message,
    HasSubstr("2 columns"));
  Weights broken = rig.weights;
  broken(7, 1) = std::nan("");
  EXPECT_THAT(arap.bind(context, rig.mesh.points, rig.mesh.tets, broken, rig.handles).message,
    HasSubstr("vertex 7"));
  EXPECT_THAT(arap.bind(context, rig.mesh.points, Tets(0, 4), rig.weights, rig.handles).message,
    HasSubstr("no elements"));
  ASSERT_TRUE(arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).ok());
  EXPECT_EQ(arap.solve(context, Pose(2)).code, StatusCode::invalid_input);
  Pose pose(3);
  pose[1].transform(2, 2) = std::nan("");
  EXPECT_THAT(arap.solve(context, pose).message, HasSubstr("'middle'"));
}

TEST(ReducedArap, CancelEndsTheBindAndTheSolve)
{
  const test::Rig rig = test::bar();
  ExecutionContext context;
  context.request_cancel();
  ReducedArap arap;
  EXPECT_EQ(arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).code,
    StatusCode::cancelled);
  ExecutionContext fine;
  ASSERT_TRUE(arap.bind(fine, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).ok());
  EXPECT_EQ(
    arap.solve(context, bend(HandleMode::free), iterations(1000)).code, StatusCode::cancelled);
}
