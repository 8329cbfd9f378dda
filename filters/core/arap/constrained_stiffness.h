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
/// ("given") and at some other points of the mesh ("held"). The system is factored once for a
/// choice of given vertices and held points. Then it can be solved for any prescribed values.
///
/// L may be singular, because a connected part without a given vertex can translate freely. Held
/// points in such a part determine its translation. If the part has no held point, the mean of x
/// over the part is zero. Held points that depend linearly on other held points are detected and
/// left out. Contradictory held points are satisfied in the least-squares sense.
class ConstrainedStiffness
{
public:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// @param part_of_vertex #V: for each vertex its connected part of the mesh; -1: x is 0 at this
  /// vertex.
  /// @param prescribed ids of the given vertices, ascending, without duplicates.
  /// @return invalid_input if L cannot be factored: elements are too distorted for double
  /// precision.
  Status prepare(const SparseMatrix& stiffness, const std::vector<Index>& part_of_vertex,
    Index part_count, std::vector<Index> prescribed, std::vector<MeshPoint> constrained);

  /// Compute x (#V x k) from a force (#V x k), the values at the given vertices (#given x k, in the
  /// order of their ids) and the values at the held points (#held x k).
  void solve(const Rows& force, const Rows& prescribed, const Rows& constrained, Rows& x) const;

  /// Return the indices of held points that depend linearly on other held points.
  const std::vector<Index>& redundant() const { return this->redundant_; }

private:
  void choose_independent(const std::vector<char>& is_prescribed);
  void factor_constraints(double unit);

  std::vector<Index> prescribed_;
  std::vector<MeshPoint> constrained_;
  std::vector<Index> unknowns_; ///< ids of the vertices in the factored matrix
  std::vector<Index> unknown_index_; ///< #V: index in unknowns_ or -1
  /// #unknowns x #given: block of the stiffness between unknowns and given vertices.
  SparseMatrix border_;
  SparseSolver solver_;

  // A is the matrix of the held points' constraints. The row of a held point contains its
  // barycentric weights at the vertices that are not given. Per held point: the factor that scales
  // its row to unit length.
  // row to unit length.
  std::vector<double> scale_;
  std::vector<Index> independent_; ///< indices of linearly independent held points
  std::vector<Index> redundant_;
  /// #selected x #held: maps the targets of all held points to the targets of the selected points.
  Eigen::MatrixXd least_squares_;
  Eigen::MatrixXd response_; ///< #unknowns x #selected: L^-1 A^T
  Eigen::MatrixXd constraint_system_; ///< A L^-1 A^T, bordered by one column per shift (below)
  Eigen::MatrixXd multipliers_; ///< inverse of constraint_system_

  /// #V: index of the vertex's part among the parts without a given vertex, or -1.
  std::vector<Index> floating_part_;
  /// Per part without a given vertex: index of its shift (an unknown translation of the part) among
  /// the shifts in constraint_system_; -1 if no held point is in the part.
  std::vector<Index> shift_index_;
  std::vector<double> floating_part_sizes_; ///< per part without a given vertex: number of vertices
};

} // namespace bindpose

#endif
