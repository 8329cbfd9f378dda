// Biharmonic weights from a factor of the Laplacian K (see preview_weights.h). M is the lumped mass
// matrix. Subscript f is for free vertices, b for fixed vertices. With D = M^-1 and Q = K D K:
//
//   Q_ff = K_ff D_f K_ff + U D_b U',  U = K_fb        Q_fb = K_ff D_f U + U D_b K_bb
//
// With P = (K_ff D_f K_ff)^-1 = K_ff^-1 M_f K_ff^-1 and G = P U, the minimizer -Q_ff^-1 Q_fb e for
// fixed values e is y - G (M_b + U' G)^-1 U' y, where y = -(K_ff^-1 U e + G D_b K_bb e).
#include "weights/preview_weights.h"

#include "base/parallel.h"
#include "qp/split_form.h"
#include "weights/column_groups.h"

#include <Eigen/Cholesky>

#include <limits>

namespace bindpose
{

namespace
{
class Preview
{
public:
  Preview(const WeightsProblem& problem, const SparseSolver::Options& options)
    : problem_(problem), form_(problem.stiffness, problem.fixed), solver_(options)
  {
  }

  Status factor(ExecutionContext& context)
  {
    const auto count = static_cast<Index>(this->form_.free_vertices.size());
    this->mass_.resize(count);
    for (Index i = 0; i < count; ++i)
    {
      this->mass_[i] = this->problem_.mass[this->form_.free_vertices[i]];
    }
    if (count == 0)
    {
      return {};
    }
    Status status = this->solver_.analyze(this->form_.lower);
    if (status.ok() && !context.canceled())
    {
      status = this->solver_.factor(this->form_.lower);
    }
    return context.canceled() ? Status::canceled() : status;
  }

  /// Return for each vertex 1 if it is free, else 0; #V.
  const std::vector<char>& is_free() const { return this->form_.is_free; }

  /// Return the harmonic weights, #V x m, including the rows of fixed vertices.
  Eigen::MatrixXd harmonic() const
  {
    const Eigen::MatrixXd& fixed_values = this->problem_.fixed_values;
    return this->form_.extend_to_all(
      -this->solve(this->form_.fixed_block * fixed_values), fixed_values);
  }

  /// Compute the biharmonic weights by the cheaper of the two methods.
  /// @return false if canceled.
  bool biharmonic(
    ExecutionContext& context, const Eigen::MatrixXd& harmonic, Eigen::MatrixXd& w) const
  {
    // Find the fixed vertices with a free neighbor.
    std::vector<int> active;
    for (int b = 0; b < this->form_.fixed_block.outerSize(); ++b)
    {
      if (SparseMatrix::InnerIterator(this->form_.fixed_block, b))
      {
        active.push_back(b);
      }
    }
    const auto rank = static_cast<Index>(active.size());
    const Index m = harmonic.cols();
    if (this->mass_.size() == 0)
    {
      w = harmonic;
      return true;
    }
    // `fixed_flux` contains the rows of D_b K_bb e at the fixed vertices with a free neighbor.
    Eigen::MatrixXd fixed_flux(rank, m);
    SparseMatrix u(this->form_.fixed_block.rows(), rank);
    Eigen::VectorXd mass(rank);
    {
      const Eigen::MatrixXd all = this->problem_.stiffness *
        this->form_.extend_to_all(
          Eigen::MatrixXd::Zero(this->mass_.size(), m), this->problem_.fixed_values);
      for (Index i = 0; i < rank; ++i)
      {
        const Index v = this->form_.fixed[active[i]];
        mass[i] = this->problem_.mass[v];
        fixed_flux.row(i) = all.row(v) / mass[i];
        u.col(static_cast<int>(i)) = this->form_.fixed_block.col(active[i]);
      }
    }
    // Typical number of solves per column that conjugate gradients need.
    constexpr Index solves_of_gradients = 16;
    const Eigen::MatrixXd start = this->form_.free_rows(harmonic);
    Eigen::MatrixXd x;
    const bool done = rank <= solves_of_gradients * m
      ? this->solve_by_woodbury(context, u, mass, fixed_flux, start, x)
      : this->solve_by_gradients(context, u, mass, fixed_flux, start, x);
    w = done ? this->form_.extend_to_all(x, this->problem_.fixed_values) : Eigen::MatrixXd();
    return done;
  }

private:
  Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) const
  {
    return rhs.rows() == 0 ? rhs : this->solver_.solve(rhs);
  }
  /// Return P r, where P is the matrix at the top of this file.
  Eigen::MatrixXd apply_inverse(const Eigen::MatrixXd& r) const
  {
    return this->solve(this->mass_.asDiagonal() * this->solve(r));
  }

  /// Solve by a low-rank update (Woodbury).
  /// @param start -K_ff^-1 U e, the harmonic weights.
  bool solve_by_woodbury(ExecutionContext& context, const SparseMatrix& u,
    const Eigen::VectorXd& mass, const Eigen::MatrixXd& fixed_flux, const Eigen::MatrixXd& start,
    Eigen::MatrixXd& x) const
  {
    const Index rank = u.cols();
    Eigen::MatrixXd g(u.rows(), rank);
    constexpr Index block = 32;
    for (Index begin = 0; begin < rank; begin += block)
    {
      const Index width = std::min(block, rank - begin);
      g.middleCols(begin, width) = this->apply_inverse(Eigen::MatrixXd(u.middleCols(begin, width)));
      context.progress(static_cast<double>(begin + width) / static_cast<double>(rank));
      if (context.canceled())
      {
        return false;
      }
    }
    Eigen::MatrixXd s = u.transpose() * g;
    s.diagonal() += mass;
    const Eigen::MatrixXd y = start - g * fixed_flux;
    x = y - g * s.ldlt().solve(Eigen::MatrixXd(u.transpose() * y));
    return true;
  }

  bool solve_by_gradients(ExecutionContext& context, const SparseMatrix& u,
    const Eigen::VectorXd& mass, const Eigen::MatrixXd& fixed_flux, const Eigen::MatrixXd& start,
    Eigen::MatrixXd& x) const
  {
    const SparseMatrix& k = this->form_.a;
    const Eigen::VectorXd inverse = this->mass_.cwiseInverse();
    const auto times = [&](const Eigen::MatrixXd& p) -> Eigen::MatrixXd
    {
      return k * (inverse.asDiagonal() * (k * p)) +
        u * (mass.cwiseInverse().asDiagonal() * (u.transpose() * p));
    };
    // Solve Q_ff x = -Q_fb e, beginning with x = start. With the formulas for Q_ff and Q_fb at the
    // top of this file, the residual is
    //   r = -Q_fb e - Q_ff x = -K_ff D_f (U e + K_ff x) - U D_b (K_bb e + U' x).
    // At x = start, the first term is zero, because K_ff start = -U e.
    x = start;
    Eigen::MatrixXd r =
      -(u * (mass.cwiseInverse().asDiagonal() * (u.transpose() * start))) - u * fixed_flux;
    Eigen::MatrixXd z = this->apply_inverse(r);
    Eigen::MatrixXd p = z;
    Eigen::VectorXd rz = r.cwiseProduct(z).colwise().sum().transpose();
    constexpr int most = 60;
    constexpr double small = 1e-3;
    for (int i = 0; i < most; ++i)
    {
      const Eigen::MatrixXd q = times(p);
      const Eigen::VectorXd pq = p.cwiseProduct(q).colwise().sum().transpose();
      const Eigen::VectorXd length = (pq.array() > 0.0).select(rz.array() / pq.array(), 0.0);
      const Eigen::MatrixXd step = p * length.asDiagonal();
      x += step;
      r -= q * length.asDiagonal();
      context.progress(static_cast<double>(i) / most);
      if (context.canceled())
      {
        return false;
      }
      if (step.cwiseAbs().maxCoeff() < small && i > 2)
      {
        break;
      }
      z = this->apply_inverse(r);
      const Eigen::VectorXd next = r.cwiseProduct(z).colwise().sum().transpose();
      const Eigen::VectorXd beta = (rz.array() > 0.0).select(next.array() / rz.array(), 0.0);
      p = z + p * beta.asDiagonal();
      rz = next;
    }
    return true;
  }

  const WeightsProblem& problem_;
  SplitForm form_;
  SparseSolver solver_;
  Eigen::VectorXd mass_; ///< lumped masses of the free vertices
};
} // namespace

Status preview_weights(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, WeightsResult& result)
{
  result = {};
  const Phase phase(context, "preview", 0.0, 1.0);
  Preview preview(problem, options.solver);
  Status status = preview.factor(context);
  if (!status.ok())
  {
    return status;
  }
  const Eigen::MatrixXd harmonic = preview.harmonic();
  Eigen::MatrixXd w;
  if (!preview.biharmonic(context, harmonic, w))
  {
    return Status::canceled();
  }
  w = w.cwiseMax(0.0).cwiseMin(1.0);

  const SparseMatrix q = harmonic_energy(problem.stiffness, problem.mass, 2);
  const std::vector<BoxQpColumn> columns = columns_without_terms(problem);
  std::vector<BoxQpSolution> solutions(columns.size());
  const bool completed = parallel_for(context, static_cast<Index>(columns.size()), 1,
    [&](Index begin, Index end)
    {
      for (Index j = begin; j < end; ++j)
      {
        BoxQpSolution& solution = solutions[j];
        solution.w = w.col(j);
        std::vector<char> is_column_free = preview.is_free();
        for (std::size_t i = 0; i < columns[j].pinned.size(); ++i)
        {
          is_column_free[columns[j].pinned[i]] = 0;
          solution.w[columns[j].pinned[i]] = columns[j].pinned_values[static_cast<Index>(i)];
        }
        solution.certificate = certify({ q, is_column_free }, solution.w);
      }
    });
  if (!completed)
  {
    return Status::canceled();
  }
  result.analyses = 1;
  status = finish_weights(context, problem, "bounded-biharmonic",
    std::numeric_limits<double>::infinity(), solutions, harmonic, result);
  status.report.set("stage", "preview");
  return status;
}

} // namespace bindpose
