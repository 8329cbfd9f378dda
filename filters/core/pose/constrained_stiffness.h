#ifndef bindpose_pose_constrained_stiffness_h
#define bindpose_pose_constrained_stiffness_h

#include "base/laplacian.h"
#include "base/sparse_solver.h"

#include <utility>
#include <vector>

namespace bindpose
{

/// A point of a mesh: vertices and their shares of it, which sum to one.
using MeshPoint = std::vector<std::pair<Index, double>>;

/// Minimises 1/2 <x, L x> - <force, x> for a stiffness matrix L, with some vertices given and some
/// points of the mesh held; factored once for a choice of these, solved for any values.
///
/// L may be singular: a connected part without a given vertex is free to move as one. Points held
/// in it say where it is; without any its mean is zero. Points that others determine are found and
/// left out; those that contradict each other are met in the least-squares sense.
class ConstrainedStiffness
{
public:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// @param part_of_vertex connected part of L's graph of each vertex; -1: x stays 0 there.
  /// @param given vertices, ascending, each once.
  /// invalid_input when L has no factor: elements too distorted for double precision.
  Status prepare(const SparseMatrix& stiffness, const std::vector<Index>& part_of_vertex,
    Index part_count, std::vector<Index> given, std::vector<MeshPoint> held);

  /// x (#V x k) for a force (#V x k), values at given vertices (#given x k, in their order) and at
  /// held points (#held x k).
  void solve(const Rows& force, const Rows& given, const Rows& held, Rows& x) const;

  /// Which of the held points others determine.
  const std::vector<Index>& redundant() const { return this->redundant_; }

private:
  void choose_independent(const std::vector<char>& is_given);
  void factor_held(double unit);

  std::vector<Index> given_;
  std::vector<MeshPoint> held_;
  std::vector<Index> unknowns_; ///< vertices of the factored matrix
  std::vector<Index> row_of_; ///< #V: place in unknowns_ or -1
  SparseMatrix border_; ///< #unknowns x #given
  SparseSolver solver_;

  // Held points, by the terms that are not given, scaled to unit size.
  std::vector<double> scale_;
  std::vector<Index> kept_; ///< independent ones
  std::vector<Index> redundant_;
  Eigen::MatrixXd least_squares_; ///< #kept x #held: targets of the kept ones
  Eigen::MatrixXd response_; ///< #unknowns x #kept: L^-1 A^T
  Eigen::MatrixXd held_system_; ///< A L^-1 A^T and the shifts of parts
  Eigen::MatrixXd multipliers_; ///< its inverse

  std::vector<Index> floating_; ///< #V: place among the parts without a given vertex, or -1
  std::vector<Index> shift_; ///< of each floating part: its column in multipliers_; -1: not held
  std::vector<double> size_; ///< of each floating part: its vertices
};

} // namespace bindpose

#endif
