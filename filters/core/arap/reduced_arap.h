#ifndef bindpose_arap_reduced_arap_h
#define bindpose_arap_reduced_arap_h

#include "arap/reduced_solver.h"
#include "arap/reduced_space.h"

namespace bindpose
{

/// As-rigid-as-possible deformation in the space of skinning transforms. The transforms that the
/// user does not constrain are computed by minimizing the deformation energy. Method: Jacobson et
/// al. 2012, Fast automatic skinning transformations.
///
///     ReducedArap arap;
///     arap.bind(context, points, tets, weights, handles, options);  // seconds, once
///     arap.solve(context, pose);                                    // microseconds per iteration
///     arap.deform(context, points, posed);                          // linear blend skinning
///
/// The energy is 1/2 sum_k sum c |e' - R_k e|^2 over edges e, with rotations R_k shared by clusters
/// of vertices that have similar weights. A solve alternates between the best rotations (local
/// step) and the best transforms (global step). The global step is two products with a dense matrix
/// that is computed once for each choice of modes. Neither step can raise the energy. Between the
/// steps, Anderson acceleration extrapolates from the last iterates. If the extrapolated iterate
/// would raise the energy, the plain iterate is used. In mode `full` the transform of a handle is
/// constrained. In mode `position` its pivot is constrained to its transformed position. In mode
/// `free` there is no constraint. If every handle is in mode `full`, the result is linear blend
/// skinning.
///
/// The unknowns are displacements from rest, so the rest pose is reproduced exactly, even for
/// ill-conditioned, duplicate or empty weight columns. Displacements that affect neither the energy
/// nor a constraint remain zero. If a pivot is on a vertex or inside an element, that point of the
/// mesh is constrained. A pivot off the mesh, and the pivot of a region, is treated as a point that
/// moves with the handle's own transform.
///
/// Cost, with m handles and extra weights and r clusters: bind O(#V (4 m)^2). The first solve is
/// O((4 m)^3). A solve after a change of modes is O((4 m + 3 r) 4 m c) for c constraints (positions
/// and prescribed unknowns), see reduced_basis.h. An iteration takes 72 m r multiply-adds and r
/// rotation fits, for a mesh of any size. The result has the same bits for any number of threads.
class ReducedArap
{
public:
  /// Bind a mesh, its weights and its handles. Tolerances are relative to the bounding-box diagonal
  /// of the used points. The report contains counts.vertices, counts.triangles or counts.tets,
  /// counts.handles, counts.clusters, counts.extra_weights, method (the energy) and row_sum_error.
  /// Warnings report rows that do not sum to one and handles without weight. Return invalid_input
  /// if sizes are inconsistent or a value is not finite.
  Status bind(ExecutionContext& context, PointsView points, TrianglesView triangles,
    WeightsView weights, const Handles& handles, const ReducedArapOptions& options = {});
  Status bind(ExecutionContext& context, PointsView points, TetsView tets, WeightsView weights,
    const Handles& handles, const ReducedArapOptions& options = {});

  using Start = ReducedStart;
  using SolveOptions = ReducedSolveOptions;

  /// Compute the transforms for a pose, which has one entry per handle. Return not_converged if
  /// max_iterations or the time budget were not enough; in this case the transforms are usable. The
  /// report contains energy, iterations, single_precision_iterations (number of iterations in
  /// single precision), residual (relative decrease of the energy in the last iteration),
  /// microseconds_per_iteration and constraint_residual (largest violation of a position, in
  /// bounding-box diagonals). Warnings name the redundant position handles and the handles whose
  /// positions are contradictory or unreachable. Such positions are satisfied in the least-squares
  /// sense.
  Status solve(ExecutionContext& context, const Pose& pose, const SolveOptions& options = {});

  /// Discard the last rotations, so that the next solve starts with `guess`.
  void discard_rotations() { this->solver_.discard_rotations(); }

  /// Compute the vertices in the last solved pose, V' = V + M D (see ReducedSpace).
  Status deform(ExecutionContext& context, PointsView rest, PointsOutput posed) const;
  Status deform_normals(
    ExecutionContext& context, PointsView rest_normals, PointsOutput posed_normals) const;
  /// Return the weights that deform() uses, #V x (handles and extra weights). They can be
  /// transferred to other points of the shape, which then also move with transforms().
  Status weights(ExecutionContext& context, Weights& weights) const;

  /// Return the transforms of the last solve: first those of the handles, then those of the extra
  /// weights. At rest all are the identity.
  const std::vector<Affine>& transforms() const { return this->transforms_; }
  /// Rotations of the last solve, one per cluster.
  std::vector<Eigen::Matrix3d> rotations() const;
  const RotationGroups& groups() const { return this->space_.groups; }
  /// Energy after each local and global step of the last solve: start, local, global, local,
  /// global, … For a mesh with extreme coordinates, energies are computed in the coordinates of its
  /// WorkingFrame.
  const std::vector<double>& energies() const { return this->solver_.energies(); }
  /// Quadratic form 1/2 tr(V^T L V) of the rest positions V. The round-off of energies is
  /// proportional to this value.
  double rest_energy() const { return this->space_.rest_energy; }

private:
  template <typename Elements>
  Status bind_elements(ExecutionContext& context, PointsView points, const Elements& elements,
    WeightsView weights, const Handles& handles, const ReducedArapOptions& options);

  ReducedSpace space_;
  ReducedSpace::Rows zero_load_;
  ReducedSolver solver_;
  std::vector<Affine> transforms_;
};

} // namespace bindpose

#endif
