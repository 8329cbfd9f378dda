#ifndef bindpose_pose_crowd_h
#define bindpose_pose_crowd_h

#include "pose/reduced_solver.h"
#include "pose/reduced_space.h"

namespace bindpose
{

/// Many instances of one shape, each with a pose of its own, bent by reduced as-rigid-as-possible:
/// what ReducedArap makes at bind time is there once, an instance has the rotations of its last
/// pose. Jacobson et al. 2012, Fast automatic skinning transformations (its crowd).
///
///     Crowd crowd;
///     crowd.bind(context, points, triangles, weights, handles, options);
///     crowd.solve(context, poses);               // one an instance
///     crowd.deform(context, points, posed);      // all of them, in single precision
///
/// Cost: of a solve those of ReducedArap's, one after another; of an instance whose modes are other
/// than those of the one before a change of modes. deform() reads weights and points once for all
/// instances. Memory: 72 bytes a cluster for each instance. The same bits for any number of
/// threads, and for an instance those that ReducedArap has with the same poses one after another.
class Crowd
{
public:
  /// As ReducedArap::bind().
  Status bind(ExecutionContext& context, PointsView points, TrianglesView triangles,
    WeightsView weights, const Handles& handles, const ReducedArapOptions& options = {});
  Status bind(ExecutionContext& context, PointsView points, TetsView tets, WeightsView weights,
    const Handles& handles, const ReducedArapOptions& options = {});

  /// Finds the transforms of a pose for each instance; an instance that was there in the last solve
  /// begins with its rotations. not_converged where an instance is, all results are usable; else
  /// the first failure, which names the instance. Report: counts.instances, counts.not_converged,
  /// iterations (of all). Warnings are those of the first instance that has any.
  Status solve(ExecutionContext& context, const std::vector<Pose>& poses,
    const ReducedSolveOptions& options = {});

  /// The vertices of all instances in their last solved poses, #V x 3 each.
  /// @param placements where each instance stands: an affine map after its pose; empty: none.
  Status deform(ExecutionContext& context, PointsView rest, std::vector<FloatPoints>& posed,
    const std::vector<Affine>& placements = {}) const;
  /// The same into memory of the caller's, #V x 3 for each instance, row by row.
  Status deform(ExecutionContext& context, PointsView rest, const std::vector<float*>& posed,
    const std::vector<Affine>& placements = {}) const;
  /// And normals of unit length.
  Status deform_normals(ExecutionContext& context, PointsView rest_normals,
    std::vector<FloatPoints>& posed, const std::vector<Affine>& placements = {}) const;

  /// Of each instance, see ReducedArap::transforms().
  const std::vector<std::vector<Affine>>& transforms() const { return this->transforms_; }

private:
  template <typename Elements>
  Status bind_any(ExecutionContext& context, PointsView points, const Elements& elements,
    WeightsView weights, const Handles& handles, const ReducedArapOptions& options);

  ReducedSpace space_;
  ReducedSpace::Rows no_load_;
  ReducedSolver solver_;
  std::vector<std::vector<double>> rotations_; ///< of each instance, see ReducedSpace
  std::vector<std::vector<Affine>> transforms_;
};

} // namespace bindpose

#endif
