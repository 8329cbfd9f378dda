// Skinning eigenmodes as extra weights: analytic eigenvalues of a bar, orthogonality, and
// determinism.
#include "arap/skinning_eigenmodes.h"

#include "core/arap/arap_cases.h"

#include <gtest/gtest.h>

using namespace bindpose;
using namespace bindpose::test;

namespace
{
/// The eigenproblem of a box of tets that is fixed at x = 0.
struct FixedBox
{
  TetMesh mesh;
  SparseMatrix stiffness;
  Eigen::VectorXd mass;
  std::vector<Index> fixed_vertices;

  explicit FixedBox(TetMesh box)
    : mesh(std::move(box)), stiffness(stiffness_matrix(this->mesh.points, this->mesh.tets)),
      mass(lumped_mass(this->mesh.points, this->mesh.tets))
  {
    for (Index v = 0; v < this->mesh.points.rows(); ++v)
    {
      if (this->mesh.points(v, 0) == 0.0)
      {
        this->fixed_vertices.push_back(v);
      }
    }
  }
};
} // namespace

// The thin bar of length l is fixed at x = 0. Its mode k = 1, 2, ... is sin(q x) with the wave
// number q = (k - 1/2) pi / l. The eigenvalue of the mode is q^2.
TEST(SkinningEigenmodes, OfABarHeldAtOneEndAreSines)
{
  const FixedBox bar(tet_box(48, 2, 2, Vec3::Zero(), Vec3(6.0, 0.25, 0.25)));
  ExecutionContext context;
  Eigenmodes found;
  ASSERT_TRUE(
    skinning_eigenmodes(context, bar.stiffness, bar.mass, bar.fixed_vertices, 6, found).ok());
  ASSERT_EQ(found.modes.cols(), 6);
  for (Index k = 0; k < 6; ++k)
  {
    const double wave = (static_cast<double>(k) + 0.5) * EIGEN_PI / 6.0;
    // The error is of second order in the mesh size, which is 1/8 along the bar.
    EXPECT_NEAR(found.eigenvalues[k], wave * wave, 0.02 * wave * wave);
    Eigen::VectorXd sine = (wave * bar.mesh.points.col(0)).array().sin();
    const double agreement = std::abs(sine.dot(bar.mass.asDiagonal() * found.modes.col(k))) /
      std::sqrt(sine.dot(bar.mass.asDiagonal() * sine) *
        found.modes.col(k).dot(bar.mass.asDiagonal() * found.modes.col(k)));
    EXPECT_GT(agreement, 0.999);
  }
}

TEST(SkinningEigenmodes, SolveTheProblemAndAreOrthogonal)
{
  // The box is as wide as high, so its eigenvalues occur in pairs.
  const FixedBox box(tet_box(6, 5, 5));
  ExecutionContext context;
  Eigenmodes found;
  ASSERT_TRUE(
    skinning_eigenmodes(context, box.stiffness, box.mass, box.fixed_vertices, 15, found).ok());
  ASSERT_EQ(found.modes.cols(), 15);
  for (const Index v : box.fixed_vertices)
  {
    EXPECT_EQ(found.modes.row(v).cwiseAbs().maxCoeff(), 0.0);
  }
  Eigen::MatrixXd unit = found.modes;
  for (Index k = 0; k < 15; ++k)
  {
    EXPECT_EQ(found.modes.col(k).maxCoeff(), 1.0);
    EXPECT_GT(found.eigenvalues[k], 0.0);
    EXPECT_TRUE(k == 0 || found.eigenvalues[k] >= found.eigenvalues[k - 1]);
    unit.col(k) /= std::sqrt(unit.col(k).dot(box.mass.asDiagonal() * unit.col(k)));
    Eigen::VectorXd residual = box.stiffness * unit.col(k) -
      found.eigenvalues[k] * (box.mass.asDiagonal() * unit.col(k)).eval();
    for (const Index v : box.fixed_vertices)
    {
      residual[v] = 0.0; // ignore the reaction force at a fixed vertex
    }
    EXPECT_LT(residual.norm(), 1e-8 * found.eigenvalues[k]) << k;
  }
  const Eigen::MatrixXd gram = unit.transpose() * box.mass.asDiagonal() * unit;
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(15, 15)).cwiseAbs().maxCoeff(), 1e-8);
  // If many modes are requested, skinning_eigenmodes() uses a dense solver. This solver must find
  // the same first 15 eigenvalues as the solver for few modes.
  Eigenmodes dense;
  ASSERT_TRUE(skinning_eigenmodes(
    context, box.stiffness, box.mass, box.fixed_vertices, box.mesh.points.rows() / 2, dense)
                .ok());
  EXPECT_LT((dense.eigenvalues.head(15) - found.eigenvalues).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(SkinningEigenmodes, SameBitsAgainAndOnManyThreads)
{
  const FixedBox box(tet_box(6, 5, 5));
  Eigenmodes found[2];
  for (int i = 0; i < 2; ++i)
  {
    ExecutionContext context;
    context.set_threads(i == 0 ? 1 : 4);
    ASSERT_TRUE(
      skinning_eigenmodes(context, box.stiffness, box.mass, box.fixed_vertices, 8, found[i]).ok());
  }
  EXPECT_EQ(found[0].modes, found[1].modes);
  EXPECT_EQ(found[0].eigenvalues, found[1].eigenvalues);
}

TEST(SkinningEigenmodes, APartThatNothingHoldsMayMoveAsAWhole)
{
  TetMesh two = tet_box(4, 4, 4);
  const TetMesh one = two;
  const Index n = one.points.rows();
  two.points.conservativeResize(2 * n, 3);
  two.points.bottomRows(n) = one.points.rowwise() + Eigen::RowVector3d(5, 0, 0);
  two.tets.conservativeResize(2 * one.tets.rows(), 4);
  two.tets.bottomRows(one.tets.rows()) = one.tets.array() + static_cast<int>(n);
  const FixedBox fixed_box(two);
  ExecutionContext context;
  Eigenmodes found;
  ASSERT_TRUE(skinning_eigenmodes(
    context, fixed_box.stiffness, fixed_box.mass, fixed_box.fixed_vertices, 4, found)
                .ok());
  EXPECT_NEAR(found.eigenvalues[0], 0.0, 1e-6);
  EXPECT_GT(found.eigenvalues[1], 0.1);
  EXPECT_LT((found.modes.col(0).tail(n).array() - 1.0).abs().maxCoeff(), 1e-6);
  EXPECT_LT(found.modes.col(0).head(n).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(SkinningEigenmodes, NothingFreeGivesNoModesAndCancelEnds)
{
  const FixedBox box(tet_box(6, 5, 5));
  std::vector<Index> all;
  for (Index v = 0; v < box.mesh.points.rows(); ++v)
  {
    all.push_back(v);
  }
  ExecutionContext context;
  Eigenmodes found;
  ASSERT_TRUE(skinning_eigenmodes(context, box.stiffness, box.mass, all, 5, found).ok());
  EXPECT_EQ(found.modes.cols(), 0);
  context.request_cancel();
  EXPECT_EQ(
    skinning_eigenmodes(context, box.stiffness, box.mass, box.fixed_vertices, 5, found).code,
    StatusCode::canceled);
}

// Extra weights that are eigenmodes keep the rest shape and lower the energy. The same is true
// for spline bumps.
TEST(SkinningEigenmodes, AsExtraWeightsTheyRestAtZeroAndLowerTheEnergy)
{
  const Status bound = expect_that_extra_weights_help(ExtraWeights::eigenmodes);
  EXPECT_EQ(bound.report.number("counts.extra_weights", 0), 15);
}
