#ifndef bindpose_pose_reduced_dynamics_h
#define bindpose_pose_reduced_dynamics_h

#include "pose/reduced_solver.h"
#include "pose/reduced_space.h"

namespace bindpose
{

/// What a step in time needs to know. Lengths are the mesh's, times in seconds; energies count as
/// mass length^2 / s^2.
struct ReducedDynamicsOptions
{
  double time_step = 1.0 / 24.0;
  Vec3 gravity = Vec3::Zero(); ///< acceleration, length / s^2
  double density = 1.0; ///< mass per volume, of surfaces per area; greater than 0
  /// Energy per volume (area) of a strain of one; greater than 0. Waves run at
  /// sqrt(stiffness / density) lengths a second.
  double stiffness = 1.0;
  double damping = 0.0; ///< 1 / s: drag of this times mass times velocity; 0 or more
  /// For the minimum that a step finds.
  ReducedSolveOptions solve;
};

/// invalid_input, with the option's name, for one that is out of range.
Status check_options(const ReducedDynamicsOptions& options);

/// Reduced as-rigid-as-possible that moves as a body with mass: what handles leave open swings,
/// falls, and keeps its velocity when a handle lets go. Jacobson et al. 2012, Fast automatic
/// skinning transformations; section on dynamics.
///
///     ReducedDynamics body;
///     body.bind(context, points, tets, weights, handles, options);
///     body.start(context, pose);             // posed without motion
///     body.step(context, pose, options);     // microseconds a step
///     body.deform(context, points, posed);
///
/// A step is implicit Euler: the next displacement minimises the energy, plus the inertia
/// 1/2 |D - D_n - h V_n|^2 / h^2 in the reduced mass, plus drag, less what gravity does. That is
/// ReducedArap's problem with another quadratic form, so an iteration costs the same. It is stable
/// for any time step and damps fast swings, the more the longer the step. Modes of handles may
/// change at any step.
///
/// The same bits for any number of threads, and for the same state, poses and options.
class ReducedDynamics
{
public:
  using Rows = ReducedSpace::Rows;

  /// As ReducedArap::bind().
  Status bind(ExecutionContext& context, PointsView points, TrianglesView triangles,
    WeightsView weights, const Handles& handles, const ReducedArapOptions& options = {});
  Status bind(ExecutionContext& context, PointsView points, TetsView tets, WeightsView weights,
    const Handles& handles, const ReducedArapOptions& options = {});

  /// Puts the body where reduced as-rigid-as-possible does for this pose, without velocity, at time
  /// zero. Depends on the pose only.
  Status start(
    ExecutionContext& context, const Pose& pose, const ReducedSolveOptions& options = {});

  /// One time step on, with the handles then in this pose. Before start(): from rest. not_converged
  /// when the minimum was not found; the result is usable. Report: energy (what the body is bent
  /// by), kinetic_energy, time, iterations, residual, microseconds_per_iteration,
  /// constraint_residual. invalid_input for options out of range.
  Status step(ExecutionContext& context, const Pose& pose, const ReducedDynamicsOptions& options);

  /// All that the next step depends on besides its arguments.
  struct State
  {
    double time = 0.0;
    Index steps = 0;
    Rows displacement, velocity;
    std::vector<double> rotations;
    std::vector<Affine> transforms;
  };
  const State& state() const { return this->state_; }
  /// Goes on from a state of this body.
  void set_state(const State& state) { this->state_ = state; }

  Status deform(ExecutionContext& context, PointsView rest, Points& posed) const;
  Status deform_normals(
    ExecutionContext& context, PointsView rest_normals, Points& posed_normals) const;
  /// Transforms of all columns, handles first.
  const std::vector<Affine>& transforms() const { return this->state_.transforms; }
  std::vector<Eigen::Matrix3d> rotations() const;

  /// Of density 1 and stiffness 1.
  double elastic_energy() const;
  double kinetic_energy() const;
  Vec3 momentum() const;
  double rest_energy() const { return this->space_.rest_energy; }
  const RotationGroups& groups() const { return this->space_.groups; }

private:
  template <typename Elements>
  Status bind_any(ExecutionContext& context, PointsView points, const Elements& elements,
    WeightsView weights, const Handles& handles, ReducedArapOptions options);

  ReducedSpace space_;
  ReducedSolver solver_;
  Eigen::MatrixXd system_; ///< stiffness and inertia, for
  double inertia_ = -1.0; ///< this share of the mass
  State state_;
};

} // namespace bindpose

#endif
