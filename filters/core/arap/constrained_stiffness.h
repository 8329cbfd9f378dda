#ifndef bindpose_arap_constrained_stiffness_h
#define bindpose_arap_constrained_stiffness_h

// Solver for a sparse stiffness system in which some vertices are prescribed and some other points
// of the mesh are constrained.

#include "geometry/laplacian.h"
#include "linear/sparse_solver.h"

#include <utility>
#include <vector>

namespace bindpose
{

/// A point of a mesh, as vertex ids with barycentric weights that sum to one.
using MeshPoint = std::vector<std::pair<Index, double>>;

/// Minimizes 1/2 <x, L x> - <force, x> for a stiffness matrix L. x is prescribed at some vertices
/// ("prescribed vertices") and at some other points of the mesh ("constrained points"). The system
/// is factored once for a choice of these vertices and points. Then it can be solved for any values
/// of x at them.
///
/// L may be singular, because a connected part without a prescribed vertex can translate freely.
/// Constrained points in such a part determine its translation. If the part has no constrained
/// point, the mean of x over the part is zero. Constrained points that depend linearly on other
/// constrained points are detected and left out. Contradictory values are satisfied in the
/// least-squares sense.
class ConstrainedStiffness
{
public:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// @param part_of_vertex #V: for each vertex its connected part of the mesh; -1: x is 0 at this
  /// vertex.
  /// @param prescribed ids of the prescribed vertices, ascending, without duplicates.
  /// @return invalid_input if L cannot be factored: elements are too distorted for double
  /// precision.
  Status prepare(const SparseMatrix& stiffness, const std::vector<Index>& part_of_vertex,
    Index part_count, std::vector<Index> prescribed, std::vector<MeshPoint> constrained);

  /// Compute x, #V x k.
  /// @param force #V x k.
  /// @param prescribed #prescribed x k: values of x at the prescribed vertices, in id order.
  /// @param constrained #constrained x k: values of x at the constrained points.
  void solve(const Rows& force, const Rows& prescribed, const Rows& constrained, Rows& x) const;

  /// Return the indices of constrained points that depend linearly on other constrained points.
  const std::vector<Index>& redundant() const { return this->redundant_; }

private:
  void choose_independent(const std::vector<char>& is_prescribed);
  void factor_constraints(double unit);

  std::vector<Index> prescribed_;
  std::vector<MeshPoint> constrained_;
  std::vector<Index> unknowns_; ///< ids of the vertices in the factored matrix
  std::vector<Index> unknown_index_; ///< #V: index in unknowns_ or -1
  /// #unknowns x #prescribed: block of the stiffness between unknowns and prescribed vertices.
  SparseMatrix border_;
  SparseSolver solver_;

  /// Per row of the constraint matrix A: the factor that scales the row to unit length. A has one
  /// row per constrained point, with its barycentric weights at the vertices that are not
  /// prescribed.
  std::vector<double> scale_;
  std::vector<Index> independent_; ///< indices of linearly independent constrained points
  std::vector<Index> redundant_;
  /// #independent x #constrained: maps the targets of all constrained points to targets of the
  /// independent points.
  Eigen::MatrixXd least_squares_;
  Eigen::MatrixXd response_; ///< #unknowns x #independent: L^-1 A^T
  /// A L^-1 A^T, bordered by one row and one column per shift (shift_index_).
  Eigen::MatrixXd constraint_system_;
  Eigen::MatrixXd multipliers_; ///< inverse of constraint_system_

  /// #V: index of the vertex's part in shift_index_ and floating_part_sizes_; -1 for vertices in
  /// other parts. These two arrays have one entry per part without a prescribed vertex.
  std::vector<Index> floating_part_;
  /// Per part without a prescribed vertex: index of its shift (an unknown translation of the part)
  /// among the shifts in constraint_system_; -1 if no constrained point is in the part.
  std::vector<Index> shift_index_;
  /// Per part without a prescribed vertex: number of vertices.
  std::vector<double> floating_part_sizes_;
};

} // namespace bindpose

#endif
