#ifndef bindpose_weights_interior_point_h
#define bindpose_weights_interior_point_h

#include "weights/box_qp.h"

namespace bindpose
{

/// The quadratic form of a BoxQp, split into free and fixed vertices.
struct BoxQpMatrices
{
  SparseMatrix q; ///< #V x #V, both triangles
  std::vector<Index> fixed;
  std::vector<char> is_free; ///< #V
  std::vector<Index> free_vertices;
  std::vector<Index> free_of_vertex; ///< #V, -1: not free
  SparseMatrix a; ///< free x free, both triangles
  SparseMatrix lower; ///< its lower triangle, every diagonal entry stored
  SparseMatrix to_fixed; ///< free x fixed
  std::vector<int> diagonal; ///< where in lower's values the diagonal is

  /// Position of entry (i, j), i > j, in lower's values; -1 when there is none.
  int position(Index i, Index j) const;
};

/// What one column's solve needs and the next can use again.
struct BoxQpWorkspace
{
  SparseSolver solver; ///< has analysed the pattern of lower
  SparseMatrix matrix; ///< of that pattern
};

/// Solves for one column (see BoxQp).
/// @param unconstrained #V, the minimiser without bounds.
/// @param inverse r -> A^-1 r over all vertices (see certify), asked for seldom.
BoxQpSolution interior_point(const BoxQpMatrices& matrices, const BoxQpOptions& options,
  const BoxQpColumn& column, const Eigen::VectorXd& unconstrained,
  const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& inverse, BoxQpWorkspace& workspace,
  ExecutionContext& context);

} // namespace bindpose

#endif
