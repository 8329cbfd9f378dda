// Mixed finite elements for the equations Laplacian^k u = 0 with k = 1, 2 and 3. The solutions are
// compared with polynomials, with plates whose deflection is known, and with a solution of the
// complete mixed system by LU factorization.
#include "fairing/polyharmonic.h"

#include "support/meshes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/SparseLU>

#include <cmath>
#include <functional>

using namespace bindpose;
using namespace bindpose::test;
using testing::HasSubstr;

namespace
{
using Rows = Polyharmonic::Rows;
using Function = std::function<double(double, double)>;

/// A square of n x n cells. Values are given at all vertices that are less than `layers` cells from
/// the border.
struct Square
{
  TriangleMesh mesh;
  Components parts;
  std::vector<Index> prescribed;
  Rows values, flux, load, x; ///< `values` has one row per vertex in `prescribed`

  Square(int n, int layers, const Vec3& corner, const Function& u = {})
    : mesh(translated(grid(n, n), corner)),
      parts(connected_components(mesh.points.rows(), mesh.triangles))
  {
    for (Index v = 0; v < mesh.points.rows(); ++v)
    {
      const Vec3 p = (mesh.points.row(v).transpose() - corner) * static_cast<double>(n);
      const double border = std::min({ p[0], p[1], n - p[0], n - p[1] });
      if (std::lround(border) < layers)
      {
        prescribed.push_back(v);
      }
    }
    values = Rows::Zero(static_cast<Index>(prescribed.size()), 1);
    for (std::size_t i = 0; u && i < prescribed.size(); ++i)
    {
      values(static_cast<Index>(i), 0) = this->at(u, prescribed[i]);
    }
  }

  double at(const Function& u, Index v) const
  {
    return u(this->mesh.points(v, 0), this->mesh.points(v, 1));
  }

  Status solve(int order, PatchBoundary boundary)
  {
    ExecutionContext context;
    Polyharmonic system;
    system.bind(this->mesh.points, this->mesh.triangles, order, boundary);
    Status status = system.prepare(context, this->parts, this->prescribed, {});
    if (status.ok())
    {
      system.solve(this->values, Rows(0, 1), this->flux, this->load, this->x);
    }
    return status;
  }

  /// Return the largest difference between the solution and u, divided by the largest value of u.
  double error(const Function& u) const
  {
    double largest = 0.0, difference = 0.0;
    for (Index v = 0; v < this->mesh.points.rows(); ++v)
    {
      largest = std::max(largest, std::abs(this->at(u, v)));
      difference = std::max(difference, std::abs(this->at(u, v) - this->x(v, 0)));
    }
    return difference / largest;
  }
};

const Vec3 centered(-0.5, -0.5, 0.0);

struct Harmonic
{
  int order;
  Function u;
};
const Harmonic polynomials[] = { { 1, [](double x, double y) { return x * x - y * y; } },
  { 1, [](double x, double y) { return x * x * x - 3.0 * x * y * y; } },
  { 2, [](double x, double y) { return (x * x + y * y) * x; } },
  { 2, [](double x, double y) { return (x * x + y * y) * (x * x - y * y); } },
  { 3, [](double x, double y) { return (x * x + y * y) * (x * x + y * y) * x; } } };

/// Return the deflection at the center of a unit plate under a uniform load of 1.
double plate_deflection(int n, PatchBoundary boundary)
{
  Square square(n, 1, Vec3::Zero());
  square.load = Rows::Ones(square.mesh.points.rows(), 1);
  EXPECT_TRUE(square.solve(2, boundary).ok());
  return square.x((n / 2) * (n + 1) + n / 2, 0);
}

/// Solve the complete mixed system. Its unknowns on all vertices are u, the Laplacian v of u and,
/// for order 3, the Laplacian w of v. The values of u in a band are given. @return u
Eigen::VectorXd mixed_solution(const Square& square, int order)
{
  const SparseMatrix k = stiffness_matrix(square.mesh.points, square.mesh.triangles);
  const Eigen::VectorXd m = lumped_mass(square.mesh.points, square.mesh.triangles);
  const Index n = k.rows(), size = order * n;
  std::vector<char> prescribed(static_cast<std::size_t>(n), 0);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  std::vector<Eigen::Triplet<double, int>> entries;
  const auto add = [&](Index row, Index column, double value)
  { entries.emplace_back(static_cast<int>(row), static_cast<int>(column), value); };
  for (std::size_t i = 0; i < square.prescribed.size(); ++i)
  {
    prescribed[square.prescribed[i]] = 1;
    right[square.prescribed[i]] = square.values(static_cast<Index>(i), 0);
  }
  // Call the unknowns x_0 = u, x_1 = v and x_2 = w. The first block of rows fixes u at the given
  // vertices and contains K x_(order - 1) = 0 at the others. Row block q contains M x_q = K x_(q -
  // 1).
  for (Index column = 0; column < n; ++column)
  {
    for (SparseMatrix::InnerIterator it(k, column); it; ++it)
    {
      if (!prescribed[it.row()])
      {
        add(it.row(), (order - 1) * n + column, it.value());
      }
      for (int q = 1; q < order; ++q)
      {
        add(q * n + it.row(), (q - 1) * n + column, it.value());
      }
    }
    for (int q = 1; q < order; ++q)
    {
      add(q * n + column, q * n + column, -m[column]);
    }
    if (prescribed[column])
    {
      add(column, column, 1.0);
    }
  }
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<SparseMatrix> lu(matrix);
  return lu.solve(right).head(n);
}
} // namespace

// The method reproduces polynomials that solve the equation.
TEST(Polyharmonic, PolynomialsThatSolveItAreReproduced)
{
  for (const Harmonic& polynomial : polynomials)
  {
    for (const int n : { 8, 16, 32 })
    {
      Square square(n, polynomial.order, centered, polynomial.u);
      const Status status = square.solve(polynomial.order, PatchBoundary::region);
      ASSERT_TRUE(status.ok()) << status.message;
      EXPECT_LT(square.error(polynomial.u), 1e-12) << polynomial.order << " " << n;
      EXPECT_GT(status.report.number("condition", 0.0), 1.0);
    }
  }
}

TEST(Polyharmonic, AFundamentalSolutionIsApproached)
{
  const Function u = [](double x, double y)
  { return (x * x + y * y) * 0.5 * std::log(x * x + y * y); };
  double last = 1.0;
  for (const int n : { 8, 16, 32, 64 })
  {
    Square square(n, 2, Vec3(0.5, 0.5, 0.0), u);
    ASSERT_TRUE(square.solve(2, PatchBoundary::region).ok());
    EXPECT_LT(square.error(u), last / 2.0);
    last = square.error(u);
  }
  EXPECT_LT(last, 3e-6);
}

// The exact deflection at the center is 0.00126532 for a clamped plate and 0.00406235 for a
// supported plate (Timoshenko).
TEST(Polyharmonic, PlatesBendAsTheyShould)
{
  const int n[] = { 8, 16, 32, 48 };
  const double clamped[] = { 0.0014244, 0.0013073, 0.0012760, 0.0012701 };
  const double supported[] = { 0.0040548, 0.0040605, 0.0040619, 0.0040622 };
  for (int i = 0; i < 4; ++i)
  {
    EXPECT_NEAR(plate_deflection(n[i], PatchBoundary::tangent), clamped[i], 5.1e-8);
    EXPECT_NEAR(plate_deflection(n[i], PatchBoundary::region), clamped[i], 5.1e-8);
    EXPECT_NEAR(plate_deflection(n[i], PatchBoundary::curve), supported[i], 5.1e-8);
  }
}

TEST(Polyharmonic, DerivativesAcrossTheEdgeAreMet)
{
  // The function is u = r^2 x; its normal derivative du/dn is given on the sides of the square.
  const Function u = polynomials[2].u;
  double last = 1.0;
  for (const int n : { 8, 16, 32 })
  {
    Square square(n, 1, centered, u);
    ExecutionContext context;
    Polyharmonic system;
    system.bind(square.mesh.points, square.mesh.triangles, 2, PatchBoundary::tangent);
    ASSERT_TRUE(system.prepare(context, square.parts, square.prescribed, {}).ok());
    // At a corner of the square, the two sides have different normal derivatives, but g has only
    // one value per vertex. The flux of each side is therefore computed separately. The four fluxes
    // are then added.
    const Index size = square.mesh.points.rows();
    const auto side = [&](int axis, double sign)
    {
      Rows g = Rows::Zero(size, 1);
      for (Index v = 0; v < size; ++v)
      {
        const double x = square.mesh.points(v, 0), y = square.mesh.points(v, 1);
        if (std::abs(square.mesh.points(v, axis) - 0.5 * sign) < 1e-12)
        {
          g(v, 0) = sign * (axis == 0 ? 3.0 * x * x + y * y : 2.0 * x * y);
        }
      }
      Rows flux = system.flux_of_derivatives(g);
      // At a corner, flux_of_derivatives() adds the integrals along two sides. Subtract the
      // integral along the side that does not belong to `axis` and `sign`.
      const double h = 1.0 / n;
      for (Index v = 0; v < size; ++v)
      {
        const double other = square.mesh.points(v, 1 - axis);
        if (std::abs(square.mesh.points(v, axis) - 0.5 * sign) > 1e-12)
        {
          flux(v, 0) = 0.0;
        }
        else if (std::abs(std::abs(other) - 0.5) < 1e-12)
        {
          flux(v, 0) -= h / 3.0 * g(v, 0);
        }
      }
      return flux;
    };
    const Rows flux = side(0, 1) + side(0, -1) + side(1, 1) + side(1, -1);
    system.solve(square.values, Rows(0, 1), flux, Rows(), square.x);
    EXPECT_LT(square.error(u), last / 2.0);
    last = square.error(u);
  }
  EXPECT_LT(last, 1e-3);
}

TEST(Polyharmonic, TheMixedSystemItselfHasTheSameSolution)
{
  Random random(3);
  for (const int order : { 2, 3 })
  {
    Square square(24, order, centered);
    for (Index v = 0; v < square.mesh.points.rows(); ++v)
    {
      square.mesh.points.row(v) +=
        random.in_box(Vec3::Constant(-0.01), Vec3::Constant(0.01)).transpose();
    }
    for (Index i = 0; i < square.values.rows(); ++i)
    {
      square.values(i, 0) = random.uniform();
    }
    ASSERT_TRUE(square.solve(order, PatchBoundary::region).ok());
    const Eigen::VectorXd mixed = mixed_solution(square, order);
    EXPECT_LT((square.x - mixed).cwiseAbs().maxCoeff(), 1e-10 * mixed.cwiseAbs().maxCoeff());
  }
}
