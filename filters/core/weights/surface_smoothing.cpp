#include "weights/surface_smoothing.h"

#include "base/laplacian.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
using Eigen::VectorXd;

/// The energy's matrix M + K M⁻¹ K on the points that are not fixed, in units of the length.
class SmoothingEnergy
{
public:
  SmoothingEnergy(
    PointsView points, TrianglesView triangles, const std::vector<Index>& fixed, double length)
    : free_(VectorXd::Ones(points.rows()))
  {
    const Points scaled = (points.rowwise() - points.row(0)) / length;
    this->stiffness_ = stiffness_matrix(scaled, triangles);
    this->limit_stiffness();
    this->mass_ = lumped_mass(scaled, triangles);
    // Points of needle triangles have almost no mass, which would only slow the iterations down.
    constexpr double least_mass = 1e-3;
    this->mass_ = this->mass_.cwiseMax(least_mass * this->mass_.mean());
    for (const Index v : fixed)
    {
      this->free_[v] = 0.0;
    }
    // (K M⁻¹ K)_ii = sum_j K_ij² / m_j.
    this->preconditioner_ = this->mass_;
    for (int j = 0; j < this->stiffness_.outerSize(); ++j)
    {
      for (SparseMatrix::InnerIterator k(this->stiffness_, j); k; ++k)
      {
        this->preconditioner_[k.row()] += k.value() * k.value() / this->mass_[j];
      }
    }
    this->preconditioner_ = this->free_.cwiseQuotient(this->preconditioner_);
  }

  /// K M⁻¹ K w; K is symmetric, and the product with its transpose is the faster one.
  VectorXd bend(const VectorXd& w) const
  {
    const VectorXd curvature = (this->stiffness_.transpose() * w).cwiseQuotient(this->mass_);
    return this->stiffness_.transpose() * curvature;
  }
  VectorXd multiply(const VectorXd& w) const
  {
    return (this->mass_.cwiseProduct(w) + this->bend(w)).cwiseProduct(this->free_);
  }

  void minimize(VectorXd& w, const ExecutionContext& context) const
  {
    constexpr double reduction = 1e-6;
    constexpr int most_iterations = 200;
    VectorXd r = -this->bend(w).cwiseProduct(this->free_);
    VectorXd z = this->preconditioner_.cwiseProduct(r);
    VectorXd p = z;
    double now = r.dot(z);
    const double enough = reduction * reduction * now;
    for (int i = 0; i < most_iterations && now > enough && !context.cancelled(); ++i)
    {
      const VectorXd ap = this->multiply(p);
      const double curvature = p.dot(ap);
      if (!(curvature > 0.0))
      {
        return; // round-off
      }
      const double step = now / curvature;
      w += step * p;
      r -= step * ap;
      z = this->preconditioner_.cwiseProduct(r);
      const double next = r.dot(z);
      p = z + (next / now) * p;
      now = next;
    }
  }

private:
  /// Triangles with almost no height couple their points with up to 1e16: round-off in the products
  /// would be larger than the values. The matrix stays symmetric, and constants stay in its kernel.
  void limit_stiffness()
  {
    constexpr double most = 30.0; // cotangent of 2 degrees
    VectorXd sums = VectorXd::Zero(this->stiffness_.cols());
    for (int j = 0; j < this->stiffness_.outerSize(); ++j)
    {
      for (SparseMatrix::InnerIterator k(this->stiffness_, j); k; ++k)
      {
        if (k.row() != k.col())
        {
          k.valueRef() = std::clamp(k.value(), -most, most);
          sums[k.col()] += k.value();
        }
      }
    }
    this->stiffness_.diagonal() = -sums;
  }

  SparseMatrix stiffness_;
  VectorXd mass_;
  VectorXd free_; // 0 for fixed points, 1 for all others
  VectorXd preconditioner_; // of the free points, 0 for the others
};
} // namespace

bool smooth_on_surface(PointsView points, TrianglesView triangles, const std::vector<Index>& fixed,
  double length, Eigen::MatrixXd& values, ExecutionContext& context)
{
  const SmoothingEnergy energy(points, triangles, fixed, length);
  return parallel_for(context, values.cols(), 1,
    [&](Index begin, Index end)
    {
      for (Index j = begin; j < end; ++j)
      {
        VectorXd w = values.col(j);
        energy.minimize(w, context);
        values.col(j) = w;
      }
    });
}

} // namespace bindpose
