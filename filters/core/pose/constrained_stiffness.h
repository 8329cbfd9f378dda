#ifndef bindpose_pose_constrained_stiffness_h
#define bindpose_pose_constrained_stiffness_h

#include "base/laplacian.h"
#include "base/sparse_solver.h"

#include <utility>
#include <vector>

namespace bindpose
{

/// A point of a mesh: vertices and their barycentric weights, which sum to one.
using MeshPoint = std::vector<std::pair<Index, double>>;

/// Minimizes 1/2 <x, L x> - <force, x> for a stiffness matrix L. The values of some vertices are
/// given, and some points of the mesh are held at target values. The system is factored once for a
/// choice of vertices and points and solved for any values.
///
/// L may be singular, because a connected part without a given vertex can translate freely. Held
/// points in such a part determine its translation; without held points its mean is zero. Held
/// points that depend linearly on other held points are detected and left out. Contradictory held
/// points are satisfied in the least-squares sense.
class ConstrainedStiffness
{
public:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// @param part_of_vertex connected part of L's graph of each vertex, #V; -1: x is 0 at this
  /// vertex.
  /// @param given vertices in ascending order, each once.
  /// @return invalid_input if L cannot be factored: elements are too distorted for double
  /// precision.
  Status prepare(const SparseMatrix& stiffness, const std::vector<Index>& part_of_vertex,
    Index part_count, std::vector<Index> given, std::vector<MeshPoint> held);

  /// Compute x (#V x k) for a force (#V x k), values at the given vertices (#given x k, in their
  /// order) and values at the held points (#held x k).
  void solve(const Rows& force, const Rows& given, const Rows& held, Rows& x) const;

  /// Held points that depend linearly on other held points.
  const std::vector<Index>& redundant() const { return this->redundant_; }

private:
  void choose_independent(const std::vector<char>& is_given);
  void factor_held(double unit);

  std::vector<Index> given_;
  std::vector<MeshPoint> held_;
  std::vector<Index> unknowns_; ///< vertices of the factored matrix
  std::vector<Index> row_of_; ///< #V: index in unknowns_ or -1
  SparseMatrix border_; ///< #unknowns x #given
  SparseSolver solver_;

  // Held points: the weights of the vertices that are not given, scaled to unit length.
  std::vector<double> scale_;
  std::vector<Index> kept_; ///< independent held points
  std::vector<Index> redundant_;
  /// #kept x #held: targets of the kept points from those of all held points.
  Eigen::MatrixXd least_squares_;
  Eigen::MatrixXd response_; ///< #unknowns x #kept: L^-1 A^T
  Eigen::MatrixXd held_system_; ///< A L^-1 A^T, bordered by the shifts of the parts
  Eigen::MatrixXd multipliers_; ///< inverse of held_system_

  std::vector<Index> floating_; ///< #V: index among the parts without a given vertex, or -1
  std::vector<Index> shift_; ///< per floating part: its column in multipliers_; -1: no held point
  std::vector<double> size_; ///< per floating part: its number of vertices
};

} // namespace bindpose

#endif
