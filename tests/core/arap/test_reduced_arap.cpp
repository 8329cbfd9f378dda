// Reduced as-rigid-as-possible deformation: comparisons with a dense implementation and with the
// full method, and properties of the energy.
#include "arap/reduced_arap.h"

#include "core/arap/arap_cases.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <gtest/gtest.h>

using namespace bindpose;
using namespace bindpose::test;

namespace
{
/// Return the optimal rotation for a matrix, computed by Eigen's SVD.
Eigen::Matrix3d svd_rotation(const Eigen::Matrix3d& s)
{
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(s, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d flip = Eigen::Matrix3d::Identity();
  flip(2, 2) = (svd.matrixV() * svd.matrixU().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  return svd.matrixV() * flip * svd.matrixU().transpose();
}

/// Compute reduced ARAP with dense matrices, straight from the definitions of the basis, the
/// stiffness matrix and the covariance matrix. A KKT system satisfies the constraints, and
/// rotations are computed by SVD.
Points dense_reference(
  const test::Rig& rig, const RotationGroups& groups, const Pose& pose, Index count)
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
    if (constrains_transform(handle.mode))
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
      Eigen::Matrix3d covariance;
      covariance << s.row(g), s.row(r + g), s.row(2 * r + g);
      const Eigen::Matrix3d rotation = svd_rotation(covariance);
      for (Index a = 0; a < 3; ++a)
      {
        rotations.row(a * r + g) = rotation.transpose().row(a);
      }
    }
  }
  return result;
}

/// Return a rig with one handle per vertex, so that the reduced space is the full space.
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

/// Compute full as-rigid-as-possible with fixed vertices. An iteration solves one linear system and
/// fits one rotation per group.
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
      Eigen::Matrix3d covariance;
      covariance << s.row(g), s.row(r + g), s.row(2 * r + g);
      for (Index a = 0; a < 3; ++a)
      {
        rotations.row(a * r + g) = svd_rotation(covariance).transpose().row(a);
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
  for (const ArapEnergy energy :
    { ArapEnergy::elements, ArapEnergy::spokes_and_rims, ArapEnergy::spokes })
  {
    ReducedArap arap;
    ASSERT_TRUE(
      arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles, { energy, 7, 0 })
        .ok());
    for (const HandleMode middle : { HandleMode::position, HandleMode::free })
    {
      Pose pose = bend(middle);
      for (const Index count : { 0, 1, 2, 10 })
      {
        ASSERT_TRUE(arap.solve(context, pose, iterations_from_rest(count)).ok());
        Points result;
        ASSERT_TRUE(arap.deform(context, rig.mesh.points, result).ok());
        const Points reference = dense_reference(rig, arap.groups(), pose, count);
        EXPECT_LT((result - reference).cwiseAbs().maxCoeff(), 1e-9) << count;
      }
    }
  }
}

// If every vertex has its own handle, the reduced method has the same iterates as the full method.
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
      arap.solve(context, pose, iterations_from_rest(count));
      Points result;
      ASSERT_TRUE(arap.deform(context, rig.mesh.points, result).ok());
      const Points full = full_arap(rig.mesh, arap.groups(), fixed, targets, count);
      EXPECT_LT((result - full).cwiseAbs().maxCoeff(), 1e-10) << count;
    }
  }
}

// Neither a local nor a global step raises the energy. The last reported energy equals the energy
// that is computed as a sum over the edges.
TEST(ReducedArap, NoHalfStepRaisesTheEnergyAndTheLastIsTheEdgeSum)
{
  const test::Rig rig = test::bar();
  ExecutionContext context;
  for (const ArapEnergy energy :
    { ArapEnergy::elements, ArapEnergy::spokes_and_rims, ArapEnergy::spokes })
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
        for (const Index window : { 0, 5, 30 })
        {
          ReducedArap::SolveOptions solve = iterations(60);
          solve.anderson_window = window;
          ASSERT_TRUE(arap.solve(context, bend(middle), solve).ok());
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
}

// Acceleration finds the same minimum as plain iterations, with fewer iterations.
TEST(ReducedArap, AccelerationReachesTheSameMinimumInFewerIterations)
{
  const test::Rig rig = test::bar();
  ExecutionContext context;
  ReducedArap arap;
  ASSERT_TRUE(arap.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles).ok());
  for (const HandleMode middle : { HandleMode::position, HandleMode::free })
  {
    ReducedArap::SolveOptions solve = iterations(20000);
    solve.anderson_window = 0;
    ASSERT_TRUE(arap.solve(context, bend(middle), solve).ok());
    const double least = arap.energies().back();
    Points plain, accelerated;
    ASSERT_TRUE(arap.deform(context, rig.mesh.points, plain).ok());
    const auto until_least = [&](Index window)
    {
      solve.anderson_window = window;
      EXPECT_TRUE(arap.solve(context, bend(middle), solve).ok());
      Index count = 0;
      while (arap.energies()[static_cast<std::size_t>(2 * count)] > least * (1.0 + 1e-6))
      {
        ++count;
      }
      return count;
    };
    const Index slow = until_least(0), fast = until_least(5);
    EXPECT_LT(3 * fast, slow);
    ASSERT_TRUE(arap.deform(context, rig.mesh.points, accelerated).ok());
    EXPECT_LT((accelerated - plain).cwiseAbs().maxCoeff(), 1e-5);
  }
}

// If all targets belong to one rigid motion, the mesh moves rigidly to the targets.
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
  // A single handle of mode full determines the rigid motion.
  const Affine t = rigid(180, Vec3(0, 1, 0), Vec3(0, 0, 7));
  Pose pose = posed(rig.handles, HandleMode::free);
  pose[2] = { HandleMode::full, t, 1.0, Eigen::Vector2d::Zero() };
  ASSERT_TRUE(arap.solve(context, pose, iterations(50)).ok());
  Points result;
  ASSERT_TRUE(arap.deform(context, rig.mesh.points, result).ok());
  EXPECT_LT((result - moved(rig.mesh.points, t)).cwiseAbs().maxCoeff(), 1e-10);
}

// With one cluster, its rotation solves the orthogonal Procrustes problem.
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
  // With a single rotation, the covariance is P^T L Q, where P are the rest points, Q the posed
  // points and L is the stiffness matrix. No sum over edges is needed.
  const SparseMatrix l = stiffness_matrix(rig.mesh.points, rig.mesh.tets);
  const Eigen::Matrix3d s = rig.mesh.points.transpose() * (l * result);
  EXPECT_LT((svd_rotation(s) - arap.rotations()[0]).cwiseAbs().maxCoeff(), 1e-9);
}

// Fewer rotations or fewer degrees of freedom raise the energy.
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
  // Compare with the full method. The full method fixes the vertices of the handles at the
  // positions that the reduced method computed. All other vertices are free.
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
    Eigen::Matrix3d covariance;
    covariance << s.row(g), s.row(arap.groups().count + g), s.row(2 * arap.groups().count + g);
    rotations.push_back(svd_rotation(covariance));
  }
  EXPECT_LT(arap_energy(rig.mesh.points, rig.mesh.tets, arap.groups(), full, rotations),
    arap.energies().back());
}

// If all handles have mode full, the result equals linear blend skinning bit for bit.
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
