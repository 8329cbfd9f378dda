// Split a quadratic form into free and fixed vertices (see split_form.h).
#include "qp/split_form.h"

#include <algorithm>

namespace bindpose
{

SplitForm::SplitForm(const SparseMatrix& form, std::vector<Index> given)
  : q(form), fixed(std::move(given))
{
  this->q.makeCompressed();
  this->is_free.assign(static_cast<std::size_t>(form.rows()), 1);
  std::vector<Index> fixed_index(static_cast<std::size_t>(form.rows()), -1);
  for (std::size_t i = 0; i < this->fixed.size(); ++i)
  {
    this->is_free[this->fixed[i]] = 0;
    fixed_index[this->fixed[i]] = static_cast<Index>(i);
  }
  this->free_index.assign(static_cast<std::size_t>(form.rows()), -1);
  for (Index v = 0; v < form.rows(); ++v)
  {
    if (this->is_free[v])
    {
      this->free_index[v] = static_cast<Index>(this->free_vertices.size());
      this->free_vertices.push_back(v);
    }
  }
  const auto n = static_cast<int>(this->free_vertices.size());
  std::vector<Eigen::Triplet<double, int>> inner;
  std::vector<Eigen::Triplet<double, int>> outer;
  for (Index v = 0; v < form.cols(); ++v)
  {
    for (SparseMatrix::InnerIterator entry(this->q, static_cast<int>(v)); entry; ++entry)
    {
      const auto i = static_cast<int>(this->free_index[entry.row()]);
      const auto j = static_cast<int>(this->free_index[v]);
      if (i >= 0 && j >= 0)
      {
        inner.emplace_back(i, j, entry.value());
      }
      else if (i >= 0)
      {
        outer.emplace_back(i, static_cast<int>(fixed_index[v]), entry.value());
      }
    }
  }
  for (int i = 0; i < n; ++i)
  {
    inner.emplace_back(i, i, 0.0); // store every diagonal entry
  }
  this->a.resize(n, n);
  this->a.setFromTriplets(inner.begin(), inner.end());
  this->fixed_block.resize(n, static_cast<int>(this->fixed.size()));
  this->fixed_block.setFromTriplets(outer.begin(), outer.end());
  this->lower = this->a.triangularView<Eigen::Lower>();
  this->lower.makeCompressed();
  for (int i = 0; i < n; ++i)
  {
    this->diagonal.push_back(this->lower.outerIndexPtr()[i]);
  }
}

Eigen::MatrixXd SplitForm::free_rows(const Eigen::MatrixXd& all) const
{
  return all(this->free_vertices, Eigen::all);
}

Eigen::MatrixXd SplitForm::extend_to_all(
  const Eigen::MatrixXd& free_rows, const Eigen::MatrixXd& fixed_values) const
{
  Eigen::MatrixXd all(this->q.rows(), fixed_values.cols());
  all(this->free_vertices, Eigen::all) = free_rows;
  all(this->fixed, Eigen::all) = fixed_values;
  return all;
}

void SplitForm::decouple(const std::vector<char>& at_bound, SparseMatrix& matrix)
{
  for (Index j = 0; j < matrix.cols(); ++j)
  {
    for (int k = matrix.outerIndexPtr()[j]; k < matrix.outerIndexPtr()[j + 1]; ++k)
    {
      const Index i = matrix.innerIndexPtr()[k];
      if (i != j && (at_bound[i] || at_bound[j]))
      {
        matrix.valuePtr()[k] = 0.0;
      }
    }
  }
}

int SplitForm::position(Index i, Index j) const
{
  const int* begin = this->lower.innerIndexPtr() + this->lower.outerIndexPtr()[j];
  const int* end = this->lower.innerIndexPtr() + this->lower.outerIndexPtr()[j + 1];
  const int* at = std::lower_bound(begin, end, static_cast<int>(i));
  return at != end && *at == i ? static_cast<int>(at - this->lower.innerIndexPtr()) : -1;
}

Status explain_no_minimum(Status factor_status)
{
  if (factor_status.code == StatusCode::invalid_input)
  {
    factor_status.message = "the energy of the mesh has no unique minimum in double precision (" +
      factor_status.message + "), perhaps because some elements are almost flat";
  }
  return factor_status;
}

} // namespace bindpose
