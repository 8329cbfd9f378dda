// Smoothing of transferred weights along a surface (see surface_smoothing.h).
#include "domain/surface_smoothing.h"

#include "base/flush_denormals.h"
#include "base/parallel.h"
#include "geometry/laplacian.h"
#include "linear/float_cholesky.h"
#include "linear/sparse_solver.h"

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
/// Number of columns that are smoothed together, so that the matrix is read once for all of them.
constexpr int lanes = 4;
/// Progress at the end of the factorization, as a fraction of the total time.
constexpr double factored = 0.4;
/// Progress before the first iteration, as a fraction of the total time.
constexpr double preparation_end = 0.5;
using Lanes = Eigen::Array<double, 1, lanes>;
/// Values of one block of columns, #V x lanes.
using Columns = Eigen::Array<double, Eigen::Dynamic, lanes, Eigen::RowMajor>;
/// One column per fixed point: the vector (M + K)⁻¹ M (M + K)⁻¹ u in single precision, one row per
/// point. The energy term of the fixed point is u uᵀ (see SmoothingEnergy).
using Responses = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The matrix M + K M⁻¹ K of the energy at the points that are not fixed, with lengths in units of
/// `length`. K is the cotangent stiffness and M the lumped mass.
class SmoothingEnergy
{
public:
  SmoothingEnergy(ExecutionContext& context, PointsView points, TrianglesView triangles,
    const std::vector<Index>& fixed, double length)
    : free_(VectorXd::Ones(points.rows()))
  {
    const Points scaled = (points.rowwise() - points.row(0)) / length;
    this->stiffness_ = stiffness_matrix(scaled, triangles, triangle_factors(scaled, triangles));
    this->mass_ = lumped_mass(scaled, triangles);
    // Raise tiny masses, because points of needle triangles would otherwise increase the number of
    // iterations.
    constexpr double least_mass = 1e-3;
    this->mass_ = this->mass_.cwiseMax(least_mass * this->mass_.mean());
    for (const Index v : fixed)
    {
      this->free_[v] = 0.0;
    }
    if (this->factor(context))
    {
      this->prepare_correction(context, fixed);
    }
    else
    {
      this->use_diagonal();
    }
  }

  /// Minimize the energy by conjugate gradients; each column has its own step lengths. After each
  /// iteration, `advance` is called with the estimated fraction of the work that is done.
  void minimize(const ExecutionContext& context, Columns& w,
    const std::function<void(double fraction)>& advance) const
  {
    constexpr double reduction = 1e-6;
    constexpr int most_iterations = 200;
    const Index count = w.rows();
    Columns curvature(count, lanes), r(count, lanes), z(count, lanes), p(count, lanes),
      ap(count, lanes);
    Work work;
    this->find_curvature(w, curvature);
    for (Index v = 0; v < count; ++v)
    {
      r.row(v) = -this->free_[v] * this->times_stiffness(curvature, v);
    }
    Lanes rz = this->precondition(r, z, work);
    p = z;
    const Lanes first = rz;
    const Lanes target_rz = reduction * reduction * first;
    // A column no longer changes after it has converged, or after round-off prevents an
    // improvement.
    Eigen::Array<bool, 1, lanes> is_active = rz > target_rz;
    for (int i = 0; i < most_iterations && is_active.any() && !context.canceled(); ++i)
    {
      this->find_curvature(p, curvature);
      Lanes p_ap = Lanes::Zero();
      for (Index v = 0; v < count; ++v)
      {
        const Lanes p_v = p.row(v);
        const Lanes ap_v =
          this->free_[v] * (this->mass_[v] * p_v + this->times_stiffness(curvature, v));
        ap.row(v) = ap_v;
        p_ap += p_v * ap_v;
      }
      is_active = is_active && p_ap > 0.0;
      const Lanes step = is_active.select(rz / p_ap, 0.0);
      for (Index v = 0; v < count; ++v)
      {
        w.row(v) += step * p.row(v);
        r.row(v) -= step * ap.row(v);
      }
      const Lanes next = this->precondition(r, z, work);
      const Lanes beta = is_active.select(next / rz, 0.0);
      for (Index v = 0; v < count; ++v)
      {
        p.row(v) = z.row(v) + beta * p.row(v);
      }
      rz = next;
      is_active = is_active && rz > target_rz;
      const Lanes done_fraction =
        is_active.select((rz / first).log() / std::log(reduction * reduction), 1.0);
      advance(done_fraction.minCoeff());
    }
  }

private:
  /// Work memory, reused for each block of columns.
  struct Work
  {
    Eigen::MatrixXd first_solution, second_solution;
  };

  /// Return one factor per triangle, by which the matrix entries of the triangle are multiplied. In
  /// triangles with almost no height, entries are up to 1e16, and their round-off would exceed the
  /// smoothed values. The factors reduce the entries of such triangles to those of a triangle with
  /// an angle of 2 degrees. The matrix stays positive semi-definite.
  static VectorXd triangle_factors(const Points& points, TrianglesView triangles)
  {
    // Limit of the matrix entries: half of the cotangent of 2 degrees, rounded up.
    constexpr double most = 15.0;
    const auto weights = cotangent_weights(points, triangles);
    VectorXd factors(triangles.rows());
    for (Index t = 0; t < triangles.rows(); ++t)
    {
      factors[t] = most / std::max(most, weights.row(t).cwiseAbs().maxCoeff());
    }
    return factors;
  }

  /// Return row v of K w. K is symmetric; the code reads column v of K, which is stored
  /// contiguously.
  Lanes times_stiffness(const Columns& w, Index v) const
  {
    Lanes sum = Lanes::Zero();
    for (SparseMatrix::InnerIterator k(this->stiffness_, v); k; ++k)
    {
      sum += k.value() * w.row(k.row());
    }
    return sum;
  }

  /// Compute M⁻¹ K w.
  void find_curvature(const Columns& w, Columns& curvature) const
  {
    for (Index v = 0; v < w.rows(); ++v)
    {
      curvature.row(v) = this->times_stiffness(w, v) / this->mass_[v];
    }
  }

  /// Factor M + K.
  /// @return false if FloatCholesky is unavailable (a build without CHOLMOD), fails or is canceled.
  bool factor(ExecutionContext& context)
  {
    const ProgressRange range(context, 0.0, factored);
    SparseMatrix a = this->stiffness_;
    for (int j = 0; j < a.outerSize(); ++j)
    {
      for (SparseMatrix::InnerIterator k(a, j); k; ++k)
      {
        k.valueRef() *= k.row() == k.col() ? 1.0 : this->free_[k.row()] * this->free_[j];
      }
    }
    a += SparseMatrix(this->mass_.asDiagonal());
    // Progress after the assembly and after the symbolic analysis of M + K, as fractions of the
    // time of this function.
    constexpr double assembly_end = 0.15;
    constexpr double analysis_end = 0.6;
    context.progress(assembly_end);
    // METIS would take more time than its better ordering saves.
    SparseSolver::Options options;
    options.ordering = SparseSolver::Ordering::amd;
    SparseSolver analysis(options);
    if (!analysis.analyze(a).ok() || !this->factor_.analyze(analysis, a).ok())
    {
      return false;
    }
    context.progress(analysis_end);
    return this->factor_.factor(context, a, 0.0).ok();
  }

  /// Correct the preconditioner for fixed points: add the term u uᵀ of each fixed point, which is
  /// the energy of the curvature at this point.
  void prepare_correction(ExecutionContext& context, const std::vector<Index>& fixed)
  {
    const ProgressRange range(context, factored, preparation_end);
    constexpr Index maximum_entries = 40'000'000; // 160 MB of responses
    const Index n = this->mass_.size();
    const Index most = std::min(static_cast<Index>(fixed.size()), maximum_entries / n);
    this->corrected_points_.assign(fixed.begin(), fixed.begin() + most);
    this->responses_.resize(n, most);
    const bool completed = parallel_for(context, most, lanes,
      [&](Index begin, Index end)
      {
        Columns terms = Columns::Zero(n, lanes), found(n, lanes);
        Work work;
        for (Index c = begin; c < end; ++c)
        {
          this->for_each_of_term(c, [&](Index v, double value) { terms(v, c - begin) = value; });
        }
        this->solve_with_factor(terms, found, work);
        this->responses_.middleCols(begin, end - begin) =
          found.leftCols(end - begin).matrix().cast<float>();
      });
    if (!completed)
    {
      this->corrected_points_.clear(); // after a cancel, some columns of responses_ are missing
      return;
    }
    Eigen::MatrixXd correction_matrix = Eigen::MatrixXd::Identity(most, most);
    for (Index c = 0; c < most; ++c)
    {
      this->for_each_of_term(c,
        [&](Index v, double value)
        { correction_matrix.row(c) += value * this->responses_.row(v).cast<double>(); });
    }
    this->correction_factor_.compute(0.5 * (correction_matrix + correction_matrix.transpose()));
    if (this->correction_factor_.info() != Eigen::Success)
    {
      // Single precision is not accurate enough for the corrections, so they are omitted. The
      // solver then needs more iterations.
      this->corrected_points_.clear();
    }
  }

  /// Call visit(v, value) for the nonzero entries of the vector u of one fixed point. The free
  /// points contribute (u · w) / sqrt(m) to the curvature at the fixed point, where m is the mass
  /// of the fixed point.
  template <typename Visit>
  void for_each_of_term(Index c, const Visit& visit) const
  {
    const Index point = this->corrected_points_[c];
    for (SparseMatrix::InnerIterator k(this->stiffness_, point); k; ++k)
    {
      if (this->free_[k.row()] != 0.0)
      {
        visit(k.row(), k.value() / std::sqrt(this->mass_[point]));
      }
    }
  }

  /// Use the inverse diagonal as preconditioner if there is no factor:
  /// (K M⁻¹ K)_ii = sum_j K_ij² / m_j.
  void use_diagonal()
  {
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

  /// Compute z = (M + K)⁻¹ M (M + K)⁻¹ r at the free points; z = 0 at the fixed points.
  void solve_with_factor(const Columns& r, Columns& z, Work& work) const
  {
    work.second_solution = r;
    this->factor_.solve(work.second_solution, work.first_solution);
    work.first_solution.array().colwise() *= this->mass_.array();
    this->factor_.solve(work.first_solution, work.second_solution);
    z = work.second_solution.array().colwise() * this->free_.array();
  }

  /// Subtract from z the correction for the fixed points (Woodbury).
  void correct(Columns& z) const
  {
    if (this->corrected_points_.empty())
    {
      return;
    }
    Eigen::MatrixXd at_fixed = Eigen::MatrixXd::Zero(this->responses_.cols(), lanes);
    for (Index c = 0; c < at_fixed.rows(); ++c)
    {
      this->for_each_of_term(
        c, [&](Index v, double value) { at_fixed.row(c) += value * z.row(v).matrix(); });
    }
    const FlushDenormals flush; // entries of responses_ far from a fixed point are denormal
    const Responses factors = this->correction_factor_.solve(at_fixed).cast<float>();
    // A general matrix product would spend most of its time on rearranging `responses_`.
    for (Index v = 0; v < z.rows(); ++v)
    {
      const float* response = this->responses_.data() + v * factors.rows();
      Eigen::Array<float, 1, lanes> sum = Eigen::Array<float, 1, lanes>::Zero();
      for (Index c = 0; c < factors.rows(); ++c)
      {
        sum += response[c] * factors.row(c).array();
      }
      z.row(v) -= sum.cast<double>();
    }
  }

  /// Apply the preconditioner P: compute z = P⁻¹ r at the free points; z = 0 at the fixed points.
  /// @return r · z for each column.
  Lanes precondition(const Columns& r, Columns& z, Work& work) const
  {
    if (this->factor_.is_analyzed())
    {
      this->solve_with_factor(r, z, work);
      this->correct(z);
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
  // The preconditioner. Let P = (M + K) M⁻¹ (M + K). Without fixed points, the matrix M + K M⁻¹ K
  // is between P / 2 and P, so few iterations are needed. Each fixed point adds a term u uᵀ to the
  // energy. Without these terms in the preconditioner, several more iterations would be needed per
  // fixed point. The terms are included by the Sherman-Morrison-Woodbury formula.
  FloatCholesky factor_; // factor of M + K, if available
  std::vector<Index> corrected_points_; // fixed points whose terms u uᵀ are in the preconditioner
  // #V x #corrected_points: (M + K)⁻¹ M (M + K)⁻¹ u for each corrected point
  Responses responses_;
  // Cholesky factorization of I + Uᵀ (M + K)⁻¹ M (M + K)⁻¹ U. The columns of U are the vectors u of
  // all corrected points.
  Eigen::LLT<Eigen::MatrixXd> correction_factor_;
  // The preconditioner if there is no factor: the inverse of the diagonal of the energy's matrix; 0
  // for fixed points.
  VectorXd inverse_diagonal_;
};
} // namespace

bool smooth_on_surface(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const std::vector<Index>& fixed, double length, Eigen::MatrixXd& values)
{
  if (points.rows() == 0 || values.cols() == 0)
  {
    return !context.canceled();
  }
  const SmoothingEnergy energy(context, points, triangles, fixed, length);
  const ProgressRange range(context, preparation_end, 1.0);
  const Index blocks = (values.cols() + lanes - 1) / lanes;
  std::vector<std::atomic<double>> done_fraction(static_cast<std::size_t>(blocks));
  const bool completed = parallel_for(context, values.cols(), lanes,
    [&](Index begin, Index end)
    {
      Columns w = Columns::Zero(values.rows(), lanes);
      w.leftCols(end - begin) = values.middleCols(begin, end - begin);
      energy.minimize(context, w,
        [&](double fraction)
        {
          done_fraction[begin / lanes] = fraction;
          const double sum = std::accumulate(done_fraction.begin(), done_fraction.end(), 0.0);
          context.progress(sum / static_cast<double>(blocks));
        });
      values.middleCols(begin, end - begin) = w.leftCols(end - begin);
    });
  return completed && !context.canceled();
}

} // namespace bindpose
