// Skinning eigenmodes by a shift-and-invert Lanczos method (Spectra).
//
// The equation L w = lambda M w is restricted to free vertices. With S = M^(1/2) and a small shift
// s, it is equivalent to
//
//     S (L + s M)^-1 S x = x / (lambda + s),   x = S w.
//
// The operator on the left is symmetric, its largest eigenvalues correspond to the smallest lambda,
// and each product needs one solve with a sparse factor. L is singular if a connected part has no
// vertex at which modes are prescribed to be zero. Even then, the shift makes L + s M positive
// definite. The shift is far below any eigenvalue of a nonconstant mode. The Lanczos method always
// starts with the same vector, so the result is reproducible.
#include "arap/skinning_eigenmodes.h"

#include "arap/weight_clusters.h"
#include "linear/sparse_solver.h"

#include <Eigen/Eigenvalues>
#include <Spectra/SymEigsSolver.h>

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
/// Shift s, as a fraction of the mean eigenvalue.
constexpr double shift_fraction = 1e-9;
/// Rows of weights are equal if their distance is at most this.
constexpr double equal_row_tolerance = 1e-9;
/// Maximum number of free vertices for which a dense eigenvalue solver is used.
constexpr Index dense_size = 100;
constexpr double eigenvalue_tolerance = 1e-10;
constexpr Index maximum_restarts = 300;

struct CancelException
{
};

/// The operator x -> S (L + s M)^-1 S x with the interface that Spectra requires.
class Operator
{
public:
  using Scalar = double;

  Operator(ExecutionContext& context, const SparseSolver& solver, const Eigen::VectorXd& root)
    : context_(context), solver_(solver), root_(root)
  {
  }
  Eigen::Index rows() const { return this->root_.size(); }
  Eigen::Index cols() const { return this->root_.size(); }
  void perform_op(const double* x, double* y) const
  {
    if (this->context_.canceled())
    {
      throw CancelException();
    }
    const Eigen::Map<const Eigen::VectorXd> from(x, this->root_.size());
    Eigen::Map<Eigen::VectorXd> to(y, this->root_.size());
    const Eigen::VectorXd right = this->root_.cwiseProduct(from);
    Eigen::VectorXd solution;
    this->solver_.solve(right, solution);
    to = this->root_.cwiseProduct(solution);
  }

private:
  ExecutionContext& context_;
  const SparseSolver& solver_;
  const Eigen::VectorXd& root_;
};
} // namespace

std::vector<Index> handle_vertices(WeightsView weights)
{
  const std::vector<Index> rows = largest_weight_rows(weights);
  std::vector<Index> result;
  for (Index v = 0; v < weights.rows(); ++v)
  {
    if (std::any_of(rows.begin(), rows.end(),
          [&](Index row)
          { return (weights.row(v) - weights.row(row)).norm() <= equal_row_tolerance; }))
    {
      result.push_back(v);
    }
  }
  return result;
}

Status skinning_eigenmodes(ExecutionContext& context, const SparseMatrix& stiffness,
  const Eigen::VectorXd& mass, const std::vector<Index>& fixed_vertices, Index count,
  Eigenmodes& result)
{
  result = Eigenmodes();
  const Index n = stiffness.rows();
  std::vector<Index> row_of_vertex(static_cast<std::size_t>(n), 0);
  for (const Index v : fixed_vertices)
  {
    row_of_vertex[static_cast<std::size_t>(v)] = -1;
  }
  std::vector<Index> free;
  for (Index v = 0; v < n; ++v)
  {
    Index& row_index = row_of_vertex[static_cast<std::size_t>(v)];
    row_index = row_index == 0 && mass[v] > 0.0 ? static_cast<Index>(free.size()) : -1;
    if (row_index >= 0)
    {
      free.push_back(v);
    }
  }
  const auto size = static_cast<Index>(free.size());
  count = std::min(count, size);
  result.modes = Weights::Zero(n, count);
  result.eigenvalues = Eigen::VectorXd::Zero(count);
  if (count <= 0)
  {
    return {};
  }
  Eigen::VectorXd root(size);
  double trace = 0.0;
  std::vector<Eigen::Triplet<double, int>> entries;
  for (Index c = 0; c < size; ++c)
  {
    const Index v = free[static_cast<std::size_t>(c)];
    root[c] = std::sqrt(mass[v]);
    for (SparseMatrix::InnerIterator it(stiffness, v); it; ++it)
    {
      const Index r = row_of_vertex[static_cast<std::size_t>(it.row())];
      if (r >= 0)
      {
        entries.emplace_back(static_cast<int>(r), static_cast<int>(c), it.value());
        trace += r == c ? it.value() : 0.0;
      }
    }
  }
  const double shift = shift_fraction * trace / root.squaredNorm();
  for (Index c = 0; c < size; ++c)
  {
    entries.emplace_back(static_cast<int>(c), static_cast<int>(c), shift * root[c] * root[c]);
  }
  SparseMatrix shifted(size, size);
  shifted.setFromTriplets(entries.begin(), entries.end());

  Status status;
  Eigen::MatrixXd vectors;
  if (size <= std::max(dense_size, 3 * count))
  {
    const Eigen::VectorXd inverse = root.cwiseInverse();
    const Eigen::MatrixXd dense =
      inverse.asDiagonal() * Eigen::MatrixXd(shifted) * inverse.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(dense);
    vectors = eigen.eigenvectors().leftCols(count);
    result.eigenvalues = eigen.eigenvalues().head(count).array() - shift;
  }
  else
  {
    SparseSolver solver;
    status = solver.analyze(shifted);
    status = status.ok() ? solver.factor(shifted) : status;
    if (!status.ok())
    {
      return status;
    }
    Operator map(context, solver, root);
    Spectra::SymEigsSolver<Operator> eigen(
      map, count, std::min(size, std::max<Index>(2 * count + 1, 20)));
    try
    {
      eigen.init();
      eigen.compute(Spectra::SortRule::LargestAlge, maximum_restarts, eigenvalue_tolerance);
    }
    catch (const CancelException&)
    {
      return Status::canceled();
    }
    vectors = eigen.eigenvectors();
    result.eigenvalues = eigen.eigenvalues().cwiseInverse().array() - shift;
    result.modes = Weights::Zero(n, vectors.cols());
    if (eigen.info() != Spectra::CompInfo::Successful)
    {
      status.code = StatusCode::not_converged;
      status.message = "only " + std::to_string(vectors.cols()) + " of " + std::to_string(count) +
        " eigenmodes converged";
    }
  }
  for (Index e = 0; e < vectors.cols(); ++e)
  {
    const Eigen::VectorXd mode = vectors.col(e).cwiseQuotient(root);
    Index largest = 0;
    mode.cwiseAbs().maxCoeff(&largest);
    for (Index c = 0; c < size; ++c)
    {
      result.modes(free[static_cast<std::size_t>(c)], e) = mode[c] / mode[largest];
    }
  }
  return status;
}

} // namespace bindpose
