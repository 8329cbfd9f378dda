#ifndef bindpose_qp_split_form_h
#define bindpose_qp_split_form_h

#include "base/status.h"
#include "geometry/laplacian.h"

#include <vector>

namespace bindpose
{

/// A quadratic form, split into blocks. Free vertices are solved for; fixed vertices have given
/// values.
struct SplitForm
{
  SplitForm() = default;
  /// @param q symmetric, #V x #V, both triangular halves stored.
  /// @param fixed ids of the fixed vertices, each once.
  SplitForm(const SparseMatrix& q, std::vector<Index> fixed);

  SparseMatrix q; ///< the whole form, #V x #V, both triangular halves stored
  std::vector<Index> fixed;
  std::vector<char> is_free; ///< #V: 1 for free vertices
  std::vector<Index> free_vertices;
  std::vector<Index> free_index; ///< #V: index in free_vertices; -1: fixed
  SparseMatrix a; ///< block of the free vertices, both triangular halves stored
  SparseMatrix lower; ///< lower triangle of a; every diagonal entry is stored
  SparseMatrix fixed_block; ///< free x fixed
  std::vector<int> diagonal; ///< indices of the diagonal entries in the values of `lower`

  /// Return the rows of the free vertices.
  /// @param all #V x m.
  /// @return free x m.
  Eigen::MatrixXd free_rows(const Eigen::MatrixXd& all) const;
  /// Combine the rows of free and fixed vertices.
  /// @param free_rows free x m.
  /// @param fixed_values fixed x m.
  /// @return #V x m.
  Eigen::MatrixXd extend_to_all(
    const Eigen::MatrixXd& free_rows, const Eigen::MatrixXd& fixed_values) const;
  /// Set the off-diagonal entries of a free x free matrix to 0 in the rows and columns of
  /// the given vertices.
  /// @param at_bound one entry per free vertex: 1 for vertices at a bound.
  static void decouple(const std::vector<char>& at_bound, SparseMatrix& matrix);
  /// Return the index of entry (i, j), i > j, in the values of `lower`; -1 if there is no such
  /// entry.
  int position(Index i, Index j) const;
};

/// Change the message if a factorization failed with invalid_input. In this case the block of free
/// vertices is not positive definite, so the form has no unique minimum. Return any other status
/// unchanged.
Status explain_no_minimum(Status factor_status);

} // namespace bindpose

#endif
