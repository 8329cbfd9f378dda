#ifndef bindpose_weights_column_problem_h
#define bindpose_weights_column_problem_h

#include "weights/box_qp.h"
#include "weights/split_form.h"

#include <vector>

namespace bindpose
{

/// The problem of one column over the free vertices: min 1/2 x'Ax + c'x, l <= x <= u, with x given
/// at pinned vertices.
struct ColumnProblem
{
  ColumnProblem(const SplitForm& matrices, const BoxQpColumn& column);

  Eigen::VectorXd c; ///< free
  Eigen::VectorXd lower, upper; ///< free: l and u
  std::vector<char> pinned; ///< free
  Eigen::VectorXd given; ///< #V: fixed and pinned values, 0 elsewhere
  std::vector<char> free_here; ///< #V: 1 for vertices that this column solves for

  /// Return the nearest x within the bounds; pinned entries have their given values.
  /// @param all #V.
  /// @return free.
  Eigen::VectorXd nearest(const SplitForm& matrices, const Eigen::VectorXd& all) const;
  /// @param x free.
  /// @return #V: x within the bounds, and the given values.
  Eigen::VectorXd whole(const SplitForm& matrices, const Eigen::VectorXd& x) const;
};

} // namespace bindpose

#endif
