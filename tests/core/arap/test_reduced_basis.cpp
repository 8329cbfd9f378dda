// Basis of the displacements that change no constrained value. A fast and a robust construction
// give bases of the same space. The fast construction fails if the rank of the constraints is
// uncertain.
#include "arap/reduced_basis.h"

#include "support/bars.h"
#include "support/meshes.h"

#include <Eigen/QR>
#include <gtest/gtest.h>

using namespace bindpose;

namespace
{
/// Return a box with scattered handles and weights that decrease with distance.
test::Rig many_handles()
{
  test::Rig rig;
  rig.mesh = test::tet_box(5, 5, 5);
  const Index n = rig.mesh.points.rows(), step = 9;
  rig.weights.resize(n, n / step);
  for (Index h = 0; h < rig.weights.cols(); ++h)
  {
    Handle handle;
    handle.name = "h" + std::to_string(h);
    handle.head = handle.tail = rig.mesh.points.row(step * h + h % 5);
    rig.handles.push_back(handle);
    rig.weights.col(h) = (rig.mesh.points.rowwise() - handle.head.transpose())
                           .rowwise()
                           .squaredNorm()
                           .unaryExpr([](double d2) { return 1.0 / (d2 * d2 + 1e-6); });
  }
  rig.weights =
    (rig.weights.array().colwise() / rig.weights.rowwise().sum().array()).matrix().eval();
  return rig;
}

/// The reduced space of a rig, with the constraints for one choice of modes.
struct BasisCase
{
  explicit BasisCase(const test::Rig& rig)
  {
    ReducedArapOptions options;
    options.mass = true;
    ExecutionContext context;
    EXPECT_TRUE(
      this->space
        .bind(context, rig.mesh.points, TetsView(rig.mesh.tets), rig.weights, rig.handles, options)
        .usable());
    this->choose({}, {});
  }

  /// Choose the handles of mode full, and the pivots and tails whose positions are constrained.
  /// `held_rows` contains the row indices of these pivots and tails in pivot_rows.
  void choose(const std::vector<Index>& full, const std::vector<Index>& held_rows)
  {
    this->given = Coordinates::Zero(4 * this->space.columns, 3);
    this->free_dofs.clear();
    for (Index j = 0; j < this->space.columns; ++j)
    {
      const bool is_full = std::find(full.begin(), full.end(), j) != full.end();
      for (Index i = 4 * j; i < 4 * j + 4; ++i)
      {
        if (is_full)
        {
          this->given.row(i) = this->random.in_box(-Vec3::Ones(), Vec3::Ones()).transpose();
        }
        else
        {
          this->free_dofs.push_back(i);
        }
      }
    }
    this->position_rows = this->space.pivot_rows(held_rows, Eigen::all);
    this->position_residual.resize(this->position_rows.rows(), 3);
    for (Index r = 0; r < this->position_rows.rows(); ++r)
    {
      this->position_residual.row(r) = this->random.in_box(-Vec3::Ones(), Vec3::Ones()).transpose();
    }
  }

  /// Modify the reduced space as if all points had the same z coordinate. The unknowns that
  /// multiply z then have no effect.
  void flatten()
  {
    for (Index i = 2; i < 4 * this->space.columns; i += 4)
    {
      this->space.basis_scale[i] = 0.0;
      this->space.stiffness.col(i).setZero();
      this->space.stiffness.row(i).setZero();
      this->space.mass.col(i).setZero();
      this->space.mass.row(i).setZero();
      this->space.covariance.col(i).setZero();
      this->space.pivot_rows.col(i).setZero();
    }
  }

  bool try_fast(const Eigen::MatrixXd& stiffness, ReducedBasis& basis) const
  {
    return basis.make_fast(this->space, stiffness, this->free_dofs, this->position_rows);
  }
  bool try_fast(ReducedBasis& basis) const { return this->try_fast(this->space.stiffness, basis); }

  /// Return the columns of the basis as a matrix. The particular solution is not included.
  Eigen::MatrixXd columns(const Eigen::MatrixXd& stiffness, const ReducedBasis& basis) const
  {
    const Coordinates nothing = Coordinates::Zero(4 * this->space.columns, 3);
    const ReducedBasis::UnrotatedMinimizer rest = basis.unrotated_minimizer(
      this->space, stiffness, nothing, nothing, Coordinates::Zero(this->position_rows.rows(), 3));
    Eigen::MatrixXd b(4 * this->space.columns, basis.coordinates());
    for (Index c = 0; c < b.cols(); ++c)
    {
      Coordinates unit = Coordinates::Zero(b.cols(), 3);
      unit(c, 0) = 1.0;
      b.col(c) = basis.displacement(rest, unit).col(0);
    }
    return b;
  }

  /// Check the defining properties of one basis. Return the covariance matrix times the basis.
  Eigen::MatrixXd check(const Eigen::MatrixXd& stiffness, ReducedBasis& basis) const
  {
    const Eigen::MatrixXd b = this->columns(stiffness, basis);
    const Index size = basis.coordinates();
    EXPECT_LT(
      (b.transpose() * stiffness * b - Eigen::MatrixXd::Identity(size, size)).cwiseAbs().maxCoeff(),
      1e-10);
    EXPECT_LT((this->position_rows * b).cwiseAbs().sum(), 1e-11 * b.cwiseAbs().maxCoeff());
    Eigen::MatrixXd c(this->space.covariance.rows(), size);
    basis.extract_covariance(c);
    EXPECT_LT((c - this->space.covariance * b).norm(), 1e-10 * c.norm());
    return c;
  }

  /// Compare the results of the fast and the robust construction.
  void compare(const Eigen::MatrixXd& stiffness, const Coordinates& load) const
  {
    ReducedBasis fast, robust;
    ASSERT_TRUE(this->try_fast(stiffness, fast));
    robust.make_robust(this->space, stiffness, this->free_dofs, this->position_rows);
    EXPECT_TRUE(fast.redundant().empty() && robust.redundant().empty());
    ASSERT_EQ(fast.coordinates(), robust.coordinates());
    const Eigen::MatrixXd a = this->check(stiffness, fast), b = this->check(stiffness, robust);
    // Two bases of the same space differ by an orthogonal matrix, which cancels in the product.
    EXPECT_LT((a * a.transpose() - b * b.transpose()).norm(), 1e-10 * (a * a.transpose()).norm());

    const auto still = [&](const ReducedBasis& basis)
    {
      return basis.unrotated_minimizer(
        this->space, stiffness, load, this->given, this->position_residual);
    };
    const ReducedBasis::UnrotatedMinimizer first = still(fast), second = still(robust);
    const Coordinates zero = Coordinates::Zero(fast.coordinates(), 3);
    const Coordinates d = fast.displacement(first, zero), e = robust.displacement(second, zero);
    EXPECT_LT((d - e).norm(), 1e-9 * e.norm());
    EXPECT_NEAR(first.energy, second.energy, 1e-10 * std::abs(second.energy) + 1e-12);
    const double direct =
      0.5 * (d.array() * (stiffness * d).array()).sum() - (d.array() * load.array()).sum();
    EXPECT_NEAR(first.energy, direct, 1e-10 * std::abs(direct) + 1e-12);
    EXPECT_LT(
      (first.covariance - second.covariance).norm(), 1e-9 * second.covariance.norm() + 1e-12);
    EXPECT_LT((this->position_rows * (d - this->given) - this->position_residual).norm(), 1e-11);
  }

  ReducedSpace space;
  test::Random random{ 5 };
  std::vector<Index> free_dofs;
  Eigen::MatrixXd position_rows;
  Coordinates given, position_residual;
};
} // namespace

TEST(ReducedBasis, BothWaysLeadToTheSame)
{
  for (const bool flat : { false, true })
  {
    BasisCase basis_case(many_handles());
    if (flat)
    {
      basis_case.flatten();
    }
    const Coordinates nothing = Coordinates::Zero(4 * basis_case.space.columns, 3);
    const Eigen::MatrixXd with_mass = basis_case.space.stiffness + 0.1 * basis_case.space.mass;
    Coordinates load = nothing;
    for (Index i = 0; i < load.rows(); ++i)
    {
      load.row(i) = basis_case.random.in_box(-Vec3::Ones(), Vec3::Ones()).transpose();
    }
    const std::vector<std::vector<Index>> full{ {}, {}, { 1 }, { 0, 2 }, { 0 } };
    const std::vector<std::vector<Index>> position_rows{ { 1 }, { 0, 1, 2, 7, 9 }, {}, { 1 },
      { 1, 2, 20 } };
    for (std::size_t i = 0; i < full.size(); ++i)
    {
      basis_case.choose(full[i], position_rows[i]);
      basis_case.compare(basis_case.space.stiffness, nothing);
      basis_case.compare(with_mass, load);
    }
    // Without constraints the stiffness matrix is singular. Adding the mass makes it nonsingular.
    basis_case.choose({}, {});
    basis_case.compare(with_mass, load);
    ReducedBasis basis;
    EXPECT_FALSE(basis_case.try_fast(basis));
  }
}

TEST(ReducedBasis, TheQuickWayDeclinesWhatIsInDoubt)
{
  const test::Rig rig = many_handles();
  ReducedBasis basis;
  BasisCase same(rig);
  same.choose({}, { 0, 1 });
  ASSERT_TRUE(same.try_fast(basis));
  const Eigen::RowVectorXd other = same.position_rows.row(1);
  for (const double distance : { 0.0, 1e-12, 1e-8, 1e-4 })
  {
    same.position_rows.row(1) = same.position_rows.row(0) + distance * other;
    EXPECT_FALSE(same.try_fast(basis)) << distance;
  }
  same.position_rows.row(1) *= 0.0;
  EXPECT_FALSE(same.try_fast(basis));
  same.position_rows(1, 3) = std::nan("");
  EXPECT_FALSE(same.try_fast(basis));

  // If the fast construction fails, make() uses the robust one, which finds the redundant
  // constraint.
  same.position_rows.row(1) = same.position_rows.row(0);
  basis.make(same.space, same.space.stiffness, same.free_dofs, same.position_rows);
  EXPECT_EQ(basis.redundant().size(), 1u);
  // A failure has no effect on later calls of the fast construction.
  same.choose({}, { 0, 1 });
  EXPECT_TRUE(same.try_fast(basis));
  EXPECT_TRUE(basis.redundant().empty());

  // The fast construction fails if there are too many constraints.
  BasisCase many(rig);
  many.choose({ 0, 1, 2, 3, 4 }, { 5, 6, 7, 8, 9 });
  ReducedBasis few;
  EXPECT_FALSE(many.try_fast(few));

  // The weights have two almost equal columns.
  test::Rig doubled = rig;
  for (const double distance : { 0.0, 1e-12, 1e-6 })
  {
    doubled.weights.col(0) = 0.5 * (rig.weights.col(0) + (1.0 - distance) * rig.weights.col(1));
    doubled.weights.col(1) = rig.weights.col(0) + rig.weights.col(1) - doubled.weights.col(0);
    BasisCase ill(doubled);
    ill.choose({}, { 0 });
    ReducedBasis none;
    EXPECT_FALSE(ill.try_fast(none)) << distance;
  }
}
