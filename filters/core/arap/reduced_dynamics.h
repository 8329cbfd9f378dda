#ifndef bindpose_arap_reduced_dynamics_h
#define bindpose_arap_reduced_dynamics_h

// Reduced as-rigid-as-possible deformation with mass and gravity (Jacobson et al. 2012, section on
// dynamics).

#include "arap/reduced_solver.h"
#include "arap/reduced_space.h"

namespace bindpose
{

/// Options of one time step. Lengths are in units of the mesh, times are in seconds, and energies
/// are in mass * length^2 / s^2.
struct ReducedDynamicsOptions
{
  double time_step = 1.0 / 24.0;
  Vec3 gravity = Vec3::Zero(); ///< acceleration, length / s^2
  double density = 1.0; ///< mass per volume (per area for surfaces); greater than 0
  /// Stiffness, greater than 0: a strain e has the energy 1/2 stiffness e^2 per volume (per area
  /// for surfaces). The speed of waves is sqrt(stiffness / density), in length units of the mesh
  /// per second.
  double stiffness = 1.0;
  /// Damping rate in 1 / s, 0 or more: the drag force is damping times mass times velocity.
  double damping = 0.0;
  /// Options of the minimization in each step.
  ReducedSolveOptions solve;
};

/// Return invalid_input with the option's name if an option is out of range.
Status check_options(const ReducedDynamicsOptions& options);

/// Reduced as-rigid-as-possible deformation of a body with mass. Unconstrained parts of the body
/// swing and fall, and they keep their velocity when the mode of a handle changes to free. Method:
/// Jacobson et al. 2012, Fast automatic skinning transformations; section on dynamics.
///
///     ReducedDynamics body;
///     body.bind(context, points, tets, weights, handles, options);
///     body.start(context, pose);             // posed without motion
///     body.step(context, pose, options);     // microseconds per step
///     body.deform(context, points, posed);
///
/// A step uses implicit Euler. The next displacement minimizes the energy, plus the inertia term
/// 1/2 |D - D_n - h V_n|^2 / h^2 in the norm of the reduced mass, plus drag, minus the work of
/// gravity. This is the problem of ReducedArap with a different quadratic form, so an iteration
/// takes the same time. The method is stable for any time step. It damps fast oscillations, more
/// strongly for longer steps. The modes of handles may change at any step.
///
/// The same state, poses and options give bit-identical results with any number of threads.
class ReducedDynamics
{
public:
  using Rows = ReducedSpace::Rows;

  /// Bind as ReducedArap::bind() does.
  Status bind(ExecutionContext& context, PointsView points, TrianglesView triangles,
    WeightsView weights, const Handles& handles, const ReducedArapOptions& options = {});
  Status bind(ExecutionContext& context, PointsView points, TetsView tets, WeightsView weights,
    const Handles& handles, const ReducedArapOptions& options = {});

  /// Set the body to the result of reduced as-rigid-as-possible for this pose, with velocity zero,
  /// at time zero. The state depends only on the pose.
  Status start(
    ExecutionContext& context, const Pose& pose, const ReducedSolveOptions& options = {});

  /// Advance by one time step. `pose` applies to the end of the step. If start() was not called,
  /// the first step begins at rest. Return not_converged if the minimum was not found; in this case
  /// the result is usable. The report contains energy (elastic), kinetic_energy, time, iterations,
  /// residual, microseconds_per_iteration and constraint_residual. Return invalid_input if an
  /// option is out of range.
  Status step(ExecutionContext& context, const Pose& pose, const ReducedDynamicsOptions& options);

  /// State of the body. The result of the next step depends only on this state and on the arguments
  /// of step().
  struct State
  {
    double time = 0.0;
    Index steps = 0;
    Rows displacement, velocity;
    std::vector<double> rotations;
    std::vector<Affine> transforms;
  };
  const State& state() const { return this->state_; }
  /// Continue from a state of this body.
  void set_state(const State& state) { this->state_ = state; }

  Status deform(ExecutionContext& context, PointsView rest, PointsOutput posed) const;
  Status deform_normals(
    ExecutionContext& context, PointsView rest_normals, PointsOutput posed_normals) const;
  /// Return the transforms of all columns of the weights, handles first.
  const std::vector<Affine>& transforms() const { return this->state_.transforms; }
  std::vector<Eigen::Matrix3d> rotations() const;

  /// Return the elastic energy for stiffness 1. The next two functions return the kinetic energy
  /// and the momentum for density 1. All three, and the energies of reports, are in the
  /// WorkingFrame of the mesh, which differs from the given coordinates only for extreme
  /// coordinates.
  double elastic_energy() const;
  double kinetic_energy() const;
  Vec3 momentum() const;
  double rest_energy() const { return this->space_.rest_energy; }
  const RotationGroups& groups() const { return this->space_.groups; }

private:
  template <typename Elements>
  Status bind_elements(ExecutionContext& context, PointsView points, const Elements& elements,
    WeightsView weights, const Handles& handles, ReducedArapOptions options);

  ReducedSpace space_;
  ReducedSolver solver_;
  Eigen::MatrixXd system_; ///< stiffness + inertia_ * mass
  double inertia_ = -1.0; ///< factor by which the mass is multiplied in system_
  State state_;
};

} // namespace bindpose

#endif
