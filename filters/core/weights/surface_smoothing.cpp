#include "weights/surface_smoothing.h"

#include "base/float_cholesky.h"
#include "base/laplacian.h"
#include "base/parallel.h"
#include "base/sparse_solver.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <numeric>

namespace bindpose
{

namespace
{
using Eigen::VectorXd;
/// So many columns are smoothed together: the matrix is read once for all of them.
constexpr int lanes = 4;
/// Share of the seconds until the energy's matrix has been factored.
constexpr double prepared = 0.4;
using Lanes = Eigen::Array<double, 1, lanes>;
/// #V x lanes.
using Columns = Eigen::Array<double, Eigen::Dynamic, lanes, Eigen::RowMajor>;

/// The energy's matrix M + K M⁻¹ K on the points that are not fixed, in units of the length.
class SmoothingEnergy
{
public:
  SmoothingEnergy(PointsView points, TrianglesView triangles, const std::vector<Index>& fixed,
    double length, ExecutionContext& context)
    : free_(VectorXd::Ones(points.rows()))
  {
    const Points scaled = (points.rowwise() - points.row(0)) / length;
    this->stiffness_ = stiffness_matrix(scaled, triangles, shares_of(scaled, triangles));
    this->mass_ = lumped_mass(scaled, triangles);
    // Points of needle triangles have almost no mass, which would only slow the iterations down.
    constexpr double least_mass = 1e-3;
    this->mass_ = this->mass_.cwiseMax(least_mass * this->mass_.mean());
    for (const Index v : fixed)
    {
      this->free_[v] = 0.0;
    }
    this->prepare(context);
  }

  /// By conjugate gradients, each column with its own steps. Calls `advance` after each
  /// step with the share of the way to the minimum that has been gone.
  void minimize(Columns& w, const ExecutionContext& context,
    const std::function<void(double share)>& advance) const
  {
    constexpr double reduction = 1e-6;
    constexpr int most_iterations = 200;
    const Index count = w.rows();
    Columns curvature(count, lanes), r(count, lanes), z(count, lanes), p(count, lanes),
      ap(count, lanes);
    this->find_curvature(w, curvature);
    for (Index v = 0; v < count; ++v)
    {
      r.row(v) = -this->free_[v] * this->times_stiffness(curvature, v);
    }
    Lanes now = this->precondition(r, z);
    p = z;
    const Lanes first = now;
    const Lanes enough = reduction * reduction * first;
    // Columns that are done, or that round-off has stopped, have no more steps.
    Eigen::Array<bool, 1, lanes> goes_on = now > enough;
    for (int i = 0; i < most_iterations && goes_on.any() && !context.cancelled(); ++i)
    {
      this->find_curvature(p, curvature);
      Lanes along = Lanes::Zero();
      for (Index v = 0; v < count; ++v)
      {
        const Lanes p_v = p.row(v);
        const Lanes ap_v =
          this->free_[v] * (this->mass_[v] * p_v + this->times_stiffness(curvature, v));
        ap.row(v) = ap_v;
        along += p_v * ap_v;
      }
      goes_on = goes_on && along > 0.0;
      const Lanes step = goes_on.select(now / along, 0.0);
      for (Index v = 0; v < count; ++v)
      {
        w.row(v) += step * p.row(v);
        r.row(v) -= step * ap.row(v);
      }
      const Lanes next = this->precondition(r, z);
      const Lanes again = goes_on.select(next / now, 0.0);
      for (Index v = 0; v < count; ++v)
      {
        p.row(v) = z.row(v) + again * p.row(v);
      }
      now = next;
      goes_on = goes_on && now > enough;
      const Lanes gone = goes_on.select((now / first).log() / std::log(reduction * reduction), 1.0);
      advance(gone.minCoeff());
    }
  }

private:
  /// Triangles with almost no height couple their points with up to 1e16: round-off in the products
  /// would be larger than the values. Less of them counts, so that nothing couples more than at an
  /// angle of 2 degrees; the matrix stays positive semi-definite.
  static VectorXd shares_of(const Points& points, TrianglesView triangles)
  {
    constexpr double most = 15.0; // half of the cotangent of 2 degrees
    const auto weights = cotangent_weights(points, triangles);
    VectorXd shares(triangles.rows());
    for (Index t = 0; t < triangles.rows(); ++t)
    {
      shares[t] = most / std::max(most, weights.row(t).cwiseAbs().maxCoeff());
    }
    return shares;
  }

  /// Row v of K w: K is symmetric.
  Lanes times_stiffness(const Columns& w, Index v) const
  {
    Lanes sum = Lanes::Zero();
    for (SparseMatrix::InnerIterator k(this->stiffness_, v); k; ++k)
    {
      sum += k.value() * w.row(k.row());
    }
    return sum;
  }

  /// M⁻¹ K w.
  void find_curvature(const Columns& w, Columns& curvature) const
  {
    for (Index v = 0; v < w.rows(); ++v)
    {
      curvature.row(v) = this->times_stiffness(w, v) / this->mass_[v];
    }
  }

  /// Factors M + K, or takes the diagonal where that cannot be had.
  void prepare(ExecutionContext& context)
  {
    const ProgressRange range(context, 0.0, prepared);
    SparseMatrix a = this->stiffness_;
    for (int j = 0; j < a.outerSize(); ++j)
    {
      for (SparseMatrix::InnerIterator k(a, j); k; ++k)
      {
        k.valueRef() *= k.row() == k.col() ? 1.0 : this->free_[k.row()] * this->free_[j];
      }
    }
    a += SparseMatrix(this->mass_.asDiagonal());
    constexpr double assembled = 0.15; // shares of the seconds
    constexpr double analysed = 0.6;
    context.progress(assembled);
    // METIS would take longer for its order than that order saves.
    SparseSolver::Options options;
    options.ordering = SparseSolver::Ordering::amd;
    SparseSolver analysis(options);
    if (analysis.analyse(a).ok() && this->factor_.analyse(analysis, a).ok())
    {
      context.progress(analysed);
      if (this->factor_.factor(a, 0.0, context).ok())
      {
        return;
      }
    }
    // Without such a factorization: by the diagonal, (K M⁻¹ K)_ii = sum_j K_ij² / m_j.
    this->factor_ = FloatCholesky();
    VectorXd diagonal = this->mass_;
    for (int j = 0; j < this->stiffness_.outerSize(); ++j)
    {
      for (SparseMatrix::InnerIterator k(this->stiffness_, j); k; ++k)
      {
        diagonal[k.row()] += k.value() * k.value() / this->mass_[j];
      }
    }
    this->inverse_diagonal_ = this->free_.cwiseQuotient(diagonal);
  }

  /// z = P⁻¹ r of the free points, 0 of the others. @return r · z.
  Lanes precondition(const Columns& r, Columns& z) const
  {
    if (this->factor_.analysed())
    {
      Eigen::MatrixXd once, twice;
      this->factor_.solve(Eigen::MatrixXd(r), once);
      once.array().colwise() *= this->mass_.array();
      this->factor_.solve(once, twice);
      z = twice.array().colwise() * this->free_.array();
    }
    else
    {
      z = r.colwise() * this->inverse_diagonal_.array();
    }
    Lanes sum = Lanes::Zero();
    for (Index v = 0; v < r.rows(); ++v)
    {
      sum += r.row(v) * z.row(v);
    }
    return sum;
  }

  SparseMatrix stiffness_;
  VectorXd mass_;
  VectorXd free_; // 0 for fixed points, 1 for all others
  // Without fixed points, M + K M⁻¹ K is at most (M + K) M⁻¹ (M + K) and at least half of it, so
  // that this preconditioner needs few iterations. Fixed points add a term at their neighbors only.
  FloatCholesky factor_; // of M + K, where it could be factored
  VectorXd inverse_diagonal_; // else: of the free points, 0 for the others
};
} // namespace

bool smooth_on_surface(PointsView points, TrianglesView triangles, const std::vector<Index>& fixed,
  double length, Eigen::MatrixXd& values, ExecutionContext& context)
{
  if (points.rows() == 0 || values.cols() == 0)
  {
    return !context.cancelled();
  }
  const SmoothingEnergy energy(points, triangles, fixed, length, context);
  const ProgressRange range(context, prepared, 1.0);
  const Index blocks = (values.cols() + lanes - 1) / lanes;
  std::vector<std::atomic<double>> gone(static_cast<std::size_t>(blocks));
  const bool whole = parallel_for(context, values.cols(), lanes,
    [&](Index begin, Index end)
    {
      Columns w = Columns::Zero(values.rows(), lanes);
      w.leftCols(end - begin) = values.middleCols(begin, end - begin);
      energy.minimize(w, context,
        [&](double share)
        {
          gone[begin / lanes] = share;
          const double sum = std::accumulate(gone.begin(), gone.end(), 0.0);
          context.progress(sum / static_cast<double>(blocks));
        });
      values.middleCols(begin, end - begin) = w.leftCols(end - begin);
    });
  return whole && !context.cancelled();
}

} // namespace bindpose
