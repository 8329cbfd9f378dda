#ifndef bindpose_pose_reduced_arap_h
#define bindpose_pose_reduced_arap_h

#include "pose/reduced_solver.h"
#include "pose/reduced_space.h"

namespace bindpose
{

/// As-rigid-as-possible deformation in the space of skinning transforms. The transforms that the
/// user does not constrain are those of least deformation energy. Jacobson et al. 2012, Fast
/// automatic skinning transformations.
///
///     ReducedArap arap;
///     arap.bind(context, points, tets, weights, handles, options);  // seconds, once
///     arap.solve(context, pose);                                    // microseconds per iteration
///     arap.deform(context, points, posed);                          // as linear blend skinning
///
/// The energy is 1/2 sum_k sum c |e' - R_k e|^2 over edges e, with rotations R_k shared by clusters
/// of vertices that have similar weights. A solve alternates between the best rotations (local
/// step) and the best transforms (global step). The global step is two products with a dense matrix
/// that is computed once for each choice of modes. Neither step can raise the energy. Between the
/// steps, Anderson acceleration extrapolates from the last iterates. If the extrapolated iterate
/// would raise the energy, the plain iterate is used.
/// A handle in mode `full` gets its transform. In mode `position` its pivot moves to its
/// transformed position. In mode `free` it has no constraint. If every handle is full, the result
/// is linear blend skinning.
///
/// The unknowns are displacements from rest, so the rest pose is exact for ill-conditioned,
/// duplicate or empty weight columns, too. Directions that affect neither the energy nor a
/// constraint stay at rest. A pivot on a vertex or inside an element is constrained as that point
/// of the mesh. Any other pivot, and the pivot of a region, is constrained by the transform of its
/// own handle.
///
/// Cost: bind O(#V (4 m)^2), m = handles and extra weights. The first solve is O((4 m)^3). A solve
/// after a change of modes is O((4 m + 3 r) 4 m c) for c constrained positions and given unknowns,
/// see reduced_basis.h. An iteration is 72 m r multiply-adds for r clusters, and r rotation fits,
/// for a mesh of any size. The result has the same bits for any number of threads.
class ReducedArap
{
public:
  /// Lengths are relative to the diagonal of the used points. Report: counts.vertices,
  /// counts.triangles or counts.tets, counts.handles, counts.clusters, counts.extra_weights, method
  /// (the energy), row_sum_error. Warnings: rows that do not sum to one, handles without weight.
  /// invalid_input for inconsistent sizes or numbers that are not finite.
  Status bind(ExecutionContext& context, PointsView points, TrianglesView triangles,
    WeightsView weights, const Handles& handles, const ReducedArapOptions& options = {});
  Status bind(ExecutionContext& context, PointsView points, TetsView tets, WeightsView weights,
    const Handles& handles, const ReducedArapOptions& options = {});

  using Start = ReducedStart;
  using SolveOptions = ReducedSolveOptions;

  /// Find the transforms of a pose, which has one entry per handle. Return not_converged if
  /// max_iterations or the time budget were not enough; the result is usable. Report: energy,
  /// iterations, single_precision_iterations (number of iterations in single precision), residual
  /// (fraction of the energy by which the last iteration lowered it), microseconds_per_iteration,
  /// constraint_residual (largest violation of a position, in bounding-box diagonals). Warnings
  /// name redundant position handles and contradictory ones, which are met in the least-squares
  /// sense.
  Status solve(ExecutionContext& context, const Pose& pose, const SolveOptions& options = {});

  /// Make the next solve start from a guess.
  void forget() { this->solver_.forget(); }

  /// Compute the vertices in the last solved pose: V' = V + M D.
  Status deform(ExecutionContext& context, PointsView rest, Points& posed) const;
  Status deform_normals(
    ExecutionContext& context, PointsView rest_normals, Points& posed_normals) const;
  /// Return the weights that deform() blends with, #V x (handles and extra weights). Use them to
  /// transfer the weights to other points of the shape, which then follow transforms(), too.
  Status weights(ExecutionContext& context, Weights& weights) const;

  /// Transforms of the last solve: those of the handles, then those of the extra weights. All are
  /// the identity at rest.
  const std::vector<Affine>& transforms() const { return this->transforms_; }
  /// Rotations of the last solve, one per cluster.
  std::vector<Eigen::Matrix3d> rotations() const;
  const RotationGroups& groups() const { return this->space_.groups; }
  /// Energy after each half-step of the last solve: start, local, global, local, global, …
  const std::vector<double>& energies() const { return this->solver_.energies(); }
  /// 1/2 tr(V^T L V): the scale of round-off in an energy.
  double rest_energy() const { return this->space_.rest_energy; }

private:
  template <typename Elements>
  Status bind_any(ExecutionContext& context, PointsView points, const Elements& elements,
    WeightsView weights, const Handles& handles, const ReducedArapOptions& options);

  ReducedSpace space_;
  ReducedSpace::Rows no_load_;
  ReducedSolver solver_;
  std::vector<Affine> transforms_;
};

} // namespace bindpose

#endif
