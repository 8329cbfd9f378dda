#ifndef bindpose_pose_reduced_arap_h
#define bindpose_pose_reduced_arap_h

#include "pose/reduced_solver.h"
#include "pose/reduced_space.h"

namespace bindpose
{

/// As-rigid-as-possible deformation in the space of skinning transforms: the transforms that the
/// user left open are those that bend the mesh least. Jacobson et al. 2012, Fast automatic skinning
/// transformations.
///
///     ReducedArap arap;
///     arap.bind(context, points, tets, weights, handles, options);  // seconds, once
///     arap.solve(context, pose);                                    // microseconds an iteration
///     arap.deform(context, points, posed);                          // as linear blend skinning
///
/// The energy is 1/2 sum_k sum c |e' - R_k e|^2 over edges e, with rotations R_k shared by clusters
/// of vertices that have similar weights. A solve alternates between the best rotations (local
/// step) and the best transforms (global step: two products with a dense matrix that is made once
/// for each choice of modes); neither step can raise the energy. Between them Anderson acceleration
/// extrapolates from the last iterates; where that would raise the energy, the plain iterate is
/// taken. A handle in mode `full` has its transform, in mode `position` its pivot goes where the
/// transform takes it, in mode `free` nothing is asked of it. With every handle full the result is
/// linear blend skinning.
///
/// Unknowns are displacements from rest, so that rest is exact however ill-conditioned, doubled or
/// empty weight columns are; directions that neither energy nor constraints see stay at rest.
/// A pivot on a vertex or inside an element is constrained as that point of the mesh; one that is
/// not, and a region's, by its own handle's transform.
///
/// Cost: bind O(#V (4 m)^2), m = handles and extra weights; first solve O((4 m)^3), after a change
/// of modes O((4 m + 3 r) 4 m c) for c held positions and given unknowns, see reduced_basis.h; an
/// iteration 72 m r multiply-adds for r clusters and r rotation fits, whatever the mesh. The same
/// bits for any number of threads.
class ReducedArap
{
public:
  /// Lengths are measured against the diagonal of the used points. Report: counts.vertices,
  /// counts.triangles or counts.tets, counts.handles, counts.clusters, counts.extra_weights, method
  /// (the energy), row_sum_error. Warnings: rows that do not sum to one, handles without weight.
  /// invalid_input for sizes that do not fit or numbers that are not finite.
  Status bind(ExecutionContext& context, PointsView points, TrianglesView triangles,
    WeightsView weights, const Handles& handles, const ReducedArapOptions& options = {});
  Status bind(ExecutionContext& context, PointsView points, TetsView tets, WeightsView weights,
    const Handles& handles, const ReducedArapOptions& options = {});

  using Start = ReducedStart;
  using SolveOptions = ReducedSolveOptions;

  /// Finds the transforms of a pose, one entry a handle. not_converged when max_iterations or
  /// the time budget were not enough; the result is usable. Report: energy, iterations,
  /// single_precision_iterations (how many of them were), residual
  /// (share of the energy by which the last iteration lowered it), microseconds_per_iteration,
  /// constraint_residual (largest miss of a position, in diagonals). Warnings name position
  /// handles that are redundant and those that contradict each other (met in the least-squares
  /// sense).
  Status solve(ExecutionContext& context, const Pose& pose, const SolveOptions& options = {});

  /// The next solve starts from a guess.
  void forget() { this->solver_.forget(); }

  /// The vertices in the last solved pose: V' = V + M D.
  Status deform(ExecutionContext& context, PointsView rest, Points& posed) const;
  Status deform_normals(
    ExecutionContext& context, PointsView rest_normals, Points& posed_normals) const;
  /// The weights that deform() blends with, #V x (handles and extra weights): to carry them to
  /// other points of the shape, which then follow transforms() too.
  Status weights(ExecutionContext& context, Weights& weights) const;

  /// Transforms of the last solve: the handles', then those of the extra weights (whose rest is
  /// the identity, too).
  const std::vector<Affine>& transforms() const { return this->transforms_; }
  /// Rotations of the last solve, one a cluster.
  std::vector<Eigen::Matrix3d> rotations() const;
  const RotationGroups& groups() const { return this->space_.groups; }
  /// Energy after each half-step of the last solve: start, local, global, local, global, …
  const std::vector<double>& energies() const { return this->solver_.energies(); }
  /// 1/2 tr(V^T L V): the unit of round-off in an energy.
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
