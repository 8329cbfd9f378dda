#ifndef bindpose_arap_crowd_h
#define bindpose_arap_crowd_h

#include "arap/reduced_solver.h"
#include "arap/reduced_space.h"

namespace bindpose
{

/// Many instances of one shape, each with its own pose, deformed by reduced as-rigid-as-possible.
/// The bind-time data of ReducedArap is stored once; each instance stores the rotations of its last
/// pose. Jacobson et al. 2012, Fast automatic skinning transformations, describe this application.
///
///     Crowd crowd;
///     crowd.bind(context, points, triangles, weights, handles, options);
///     crowd.solve(context, poses);               // one pose per instance
///     crowd.deform(context, points, posed);      // all instances, in single precision
///
/// Cost: solve() processes the instances one after another; each takes as long as one ReducedArap
/// solve. An instance takes longer if its handle modes differ from those of the previous instance.
/// deform() reads weights and points once for all instances. Memory: 72 bytes per cluster and
/// instance. The result has the same bits for any number of threads. For the same sequence of
/// poses, the result of an instance is bit-identical to that of ReducedArap.
class Crowd
{
public:
  /// Bind as ReducedArap::bind() does.
  Status bind(ExecutionContext& context, PointsView points, TrianglesView triangles,
    WeightsView weights, const Handles& handles, const ReducedArapOptions& options = {});
  Status bind(ExecutionContext& context, PointsView points, TetsView tets, WeightsView weights,
    const Handles& handles, const ReducedArapOptions& options = {});

  /// Compute the transforms of each instance for its own pose, poses[instance]. The solve of an
  /// instance starts with the rotations of its previous pose, if it has one. Return not_converged
  /// if any instance did not converge; in this case all results are usable. If an instance fails,
  /// return its status at once, with the index of the instance in the message. The report contains
  /// counts.instances, counts.not_converged, and iterations and single_precision_iterations (sums
  /// over all instances). The warnings are those of the first instance with warnings.
  Status solve(ExecutionContext& context, const std::vector<Pose>& poses,
    const ReducedSolveOptions& options = {});

  /// Compute the vertices of all instances in their last solved poses, #V x 3 each.
  /// @param placements one affine map per instance, applied after its pose; empty: none.
  Status deform(ExecutionContext& context, PointsView rest, std::vector<FloatPoints>& posed,
    const std::vector<Affine>& placements = {}) const;
  /// Write the vertices to arrays that the caller allocates, #V x 3 for each instance, row by row.
  Status deform(ExecutionContext& context, PointsView rest, const std::vector<float*>& posed,
    const std::vector<Affine>& placements = {}) const;
  /// Compute the normals of all instances, scaled to unit length.
  Status deform_normals(ExecutionContext& context, PointsView rest_normals,
    std::vector<FloatPoints>& posed, const std::vector<Affine>& placements = {}) const;

  /// Transforms of each instance, see ReducedArap::transforms().
  const std::vector<std::vector<Affine>>& transforms() const { return this->transforms_; }

private:
  template <typename Elements>
  Status bind_elements(ExecutionContext& context, PointsView points, const Elements& elements,
    WeightsView weights, const Handles& handles, const ReducedArapOptions& options);

  ReducedSpace space_;
  ReducedSpace::Rows zero_load_;
  ReducedSolver solver_;
  /// Last rotations of each instance, stored in planes as in ReducedSpace.
  std::vector<std::vector<double>> rotations_;
  std::vector<std::vector<Affine>> transforms_;
};

} // namespace bindpose

#endif
