#ifndef bindpose_qp_column_problem_h
#define bindpose_qp_column_problem_h

#include "qp/box_qp_column.h"
#include "qp/split_form.h"

#include <vector>

namespace bindpose
{

/// The quadratic program of one column: min 1/2 x'Ax + c'x subject to l <= x <= u. Fixed vertices
/// have given values in every column. All other vertices are called free, and x has one entry for
/// each of the n free vertices. Some free vertices can be pinned: they have a given value in this
/// column only.
struct ColumnProblem
{
  ColumnProblem(const SplitForm& matrices, const BoxQpColumn& column);

  Eigen::VectorXd c; ///< n
  Eigen::VectorXd lower, upper; ///< n: l and u
  std::vector<char> pinned; ///< n: 1 for pinned vertices
  Eigen::VectorXd given_values; ///< #V: values of fixed and pinned vertices, 0 elsewhere
  std::vector<char> is_column_free; ///< #V: 1 for vertices that are neither fixed nor pinned

  /// Restrict a vector to the free vertices and clamp it to the bounds. The entries of pinned
  /// vertices are set to their given values.
  /// @param all one entry per vertex, #V.
  /// @return one entry per free vertex, n.
  Eigen::VectorXd clamp_to_bounds(const SplitForm& matrices, const Eigen::VectorXd& all) const;
  /// Extend a vector from the free vertices to all vertices. The entries of x are clamped to the
  /// bounds.
  /// @param x one entry per free vertex, n.
  /// @return #V: the entries of x at free vertices that are not pinned, given values elsewhere.
  Eigen::VectorXd extend_to_all(const SplitForm& matrices, const Eigen::VectorXd& x) const;
};

} // namespace bindpose

#endif
