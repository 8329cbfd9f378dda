// Ordered pairs as rows of a constraint matrix (see pair_rows.h).
#include "qp/pair_rows.h"

#include "qp/ordered_pairs.h"

#include <algorithm>
#include <limits>

namespace bindpose
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

PairRows::PairRows(
  const SplitForm& matrices, const ColumnProblem& problem, const BoxQpColumn& column)
  : matrices_(matrices), problem_(problem), column_(column)
{
}

Status PairRows::prepare()
{
  const SplitForm& matrices = this->matrices_;
  const ColumnProblem& problem = this->problem_;
  std::vector<double> constants;
  for (std::size_t k = 0; k < this->column_.pairs.size(); ++k)
  {
    const OrderedPair& pair = this->column_.pairs[k];
    Row row;
    row.pair = static_cast<Index>(k);
    row.low = problem.is_column_free[pair.low] ? matrices.free_index[pair.low] : -1;
    row.high = problem.is_column_free[pair.high] ? matrices.free_index[pair.high] : -1;
    if (row.low < 0 && row.high < 0)
    {
      continue;
    }
    if (row.low >= 0 && row.high >= 0)
    {
      row.position = matrices.position(std::max(row.low, row.high), std::min(row.low, row.high));
      if (row.position < 0)
      {
        return Status::failure(
          StatusCode::internal_error, "a pair of ordered vertices has no entry in the matrix Q");
      }
    }
    this->rows_.push_back(row);
    constants.push_back((row.high < 0 ? problem.given_values[pair.high] : 0.0) -
      (row.low < 0 ? problem.given_values[pair.low] : 0.0) - pair.minimum_difference);
  }
  this->constants_ = Eigen::Map<VectorXd>(constants.data(), this->count());
  if (!this->rows_.empty())
  {
    const std::vector<Index> order = topological_order(this->column_.pairs, matrices.q.rows());
    if (static_cast<Index>(order.size()) != matrices.q.rows())
    {
      return Status::failure(StatusCode::internal_error, "the ordered pairs contain a cycle");
    }
    this->sorted_pairs_ = sort_pairs_by_order(this->column_.pairs, order);
  }
  return {};
}

VectorXd PairRows::apply(const VectorXd& x) const
{
  VectorXd y(this->count());
  for (Index r = 0; r < y.size(); ++r)
  {
    const Row& row = this->rows_[r];
    y[r] = (row.high >= 0 ? x[row.high] : 0.0) - (row.low >= 0 ? x[row.low] : 0.0);
  }
  return y;
}

void PairRows::add_transposed(const Eigen::Ref<const VectorXd>& y, VectorXd& x) const
{
  for (Index r = 0; r < y.size(); ++r)
  {
    const Row& row = this->rows_[r];
    if (row.high >= 0)
    {
      x[row.high] += y[r];
    }
    if (row.low >= 0)
    {
      x[row.low] -= y[r];
    }
  }
}

void PairRows::add_product(
  const VectorXd& weights, const Eigen::Ref<const MatrixXd>& p, Eigen::Ref<MatrixXd> y) const
{
  for (Index r = 0; r < weights.size(); ++r)
  {
    const Row& row = this->rows_[r];
    for (Index j = 0; j < p.cols() && weights[r] != 0.0; ++j)
    {
      const double weighted_difference = weights[r] *
        ((row.high >= 0 ? p(row.high, j) : 0.0) - (row.low >= 0 ? p(row.low, j) : 0.0));
      if (row.high >= 0)
      {
        y(row.high, j) += weighted_difference;
      }
      if (row.low >= 0)
      {
        y(row.low, j) -= weighted_difference;
      }
    }
  }
}

void PairRows::add_to_matrix(const Eigen::Ref<const VectorXd>& weights, SparseMatrix& matrix) const
{
  double* values = matrix.valuePtr();
  for (Index r = 0; r < weights.size(); ++r)
  {
    const Row& row = this->rows_[r];
    if (row.high >= 0)
    {
      values[this->matrices_.diagonal[row.high]] += weights[r];
    }
    if (row.low >= 0)
    {
      values[this->matrices_.diagonal[row.low]] += weights[r];
    }
    if (row.position >= 0)
    {
      values[row.position] -= weights[r];
    }
  }
}

void PairRows::add_diagonal(const VectorXd& weights, VectorXd& diagonal) const
{
  for (Index r = 0; r < weights.size(); ++r)
  {
    for (const Index i : { this->rows_[r].low, this->rows_[r].high })
    {
      if (i >= 0)
      {
        diagonal[i] += weights[r];
      }
    }
  }
}

VectorXd PairRows::smallest_diagonals() const
{
  const auto diagonal = [this](Index i)
  {
    return i < 0 ? std::numeric_limits<double>::infinity()
                 : this->matrices_.lower.valuePtr()[this->matrices_.diagonal[i]];
  };
  VectorXd smallest(this->count());
  for (Index r = 0; r < smallest.size(); ++r)
  {
    const Row& row = this->rows_[r];
    smallest[r] = std::min(diagonal(row.low), diagonal(row.high));
  }
  return smallest;
}

VectorXd PairRows::extend_to_all_pairs(const Eigen::Ref<const VectorXd>& multipliers) const
{
  VectorXd all = VectorXd::Zero(static_cast<Index>(this->column_.pairs.size()));
  for (Index r = 0; r < multipliers.size(); ++r)
  {
    all[this->rows_[r].pair] = multipliers[r];
  }
  return all;
}

void PairRows::enforce(VectorXd& values) const
{
  if (this->sorted_pairs_.empty())
  {
    return;
  }
  VectorXd highest(values.size());
  for (Index v = 0; v < values.size(); ++v)
  {
    highest[v] = this->column_.bounds.high(v);
  }
  enforce_order(this->sorted_pairs_, this->problem_.is_column_free, highest, values);
}

} // namespace bindpose
