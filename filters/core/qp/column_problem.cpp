// Extract the problem of one column from the quadratic form (see column_problem.h).
#include "qp/column_problem.h"

#include <algorithm>

namespace bindpose
{

using Eigen::VectorXd;

ColumnProblem::ColumnProblem(const SplitForm& matrices, const BoxQpColumn& column)
  : c(matrices.fixed_block * column.fixed_values), given_values(VectorXd::Zero(matrices.q.rows())),
    is_column_free(matrices.is_free)
{
  const auto free_count = static_cast<Index>(matrices.free_vertices.size());
  for (std::size_t i = 0; i < matrices.fixed.size(); ++i)
  {
    this->given_values[matrices.fixed[i]] = column.fixed_values[static_cast<Index>(i)];
  }
  this->pinned.assign(static_cast<std::size_t>(free_count), 0);
  for (std::size_t i = 0; i < column.pinned.size(); ++i)
  {
    const Index v = column.pinned[i];
    if (matrices.is_free[v])
    {
      this->pinned[matrices.free_index[v]] = 1;
      this->is_column_free[v] = 0;
      this->given_values[v] = column.pinned_values[static_cast<Index>(i)];
    }
  }
  this->lower.resize(free_count);
  this->upper.resize(free_count);
  for (Index i = 0; i < free_count; ++i)
  {
    this->lower[i] = column.bounds.low(matrices.free_vertices[i]);
    this->upper[i] = column.bounds.high(matrices.free_vertices[i]);
  }
}

VectorXd ColumnProblem::clamp_to_bounds(const SplitForm& matrices, const VectorXd& all) const
{
  VectorXd x(this->c.size());
  for (Index i = 0; i < x.size(); ++i)
  {
    const Index v = matrices.free_vertices[i];
    x[i] =
      this->pinned[i] ? this->given_values[v] : std::clamp(all[v], this->lower[i], this->upper[i]);
  }
  return x;
}

VectorXd ColumnProblem::extend_to_all(const SplitForm& matrices, const VectorXd& x) const
{
  VectorXd all = this->given_values;
  for (Index i = 0; i < x.size(); ++i)
  {
    if (!this->pinned[i])
    {
      all[matrices.free_vertices[i]] = std::clamp(x[i], this->lower[i], this->upper[i]);
    }
  }
  return all;
}

} // namespace bindpose
