#ifndef bindpose_weights_split_form_h
#define bindpose_weights_split_form_h

#include "base/laplacian.h"
#include "base/status.h"

#include <vector>

namespace bindpose
{

/// A quadratic form, split into the vertices that are solved for and those whose values are given.
struct SplitForm
{
  SplitForm() = default;
  /// @param q symmetric, #V x #V, both triangles.
  /// @param fixed ids of the fixed vertices, each once.
  SplitForm(const SparseMatrix& q, std::vector<Index> fixed);

  SparseMatrix q; ///< #V x #V, both triangles
  std::vector<Index> fixed;
  std::vector<char> is_free; ///< #V
  std::vector<Index> free_vertices;
  std::vector<Index> free_of_vertex; ///< #V, -1: not free
  SparseMatrix a; ///< free x free, both triangles
  SparseMatrix lower; ///< its lower triangle, every diagonal entry stored
  SparseMatrix to_fixed; ///< free x fixed
  std::vector<int> diagonal; ///< where in lower's values the diagonal is

  /// @param all #V x m.
  /// @return free x m.
  Eigen::MatrixXd free_rows(const Eigen::MatrixXd& all) const;
  /// @param free_rows free x m.
  /// @param fixed_values fixed x m.
  /// @return #V x m.
  Eigen::MatrixXd whole(
    const Eigen::MatrixXd& free_rows, const Eigen::MatrixXd& fixed_values) const;
  /// Sets the entries of a free x free matrix to 0 that join a held vertex with another.
  /// @param held free: 1 where it is.
  static void decouple(const std::vector<char>& held, SparseMatrix& matrix);
  /// Position of entry (i, j), i > j, in lower's values; -1 when there is none.
  int position(Index i, Index j) const;
};

/// What it means for a form that its block of free vertices is not positive definite: a
/// factorisation's invalid_input said so; any other status stays as it is.
Status without_minimum(Status of_factor);

} // namespace bindpose

#endif
