#ifndef bindpose_pose_reduced_dynamics_h
#define bindpose_pose_reduced_dynamics_h

#include "pose/reduced_solver.h"
#include "pose/reduced_space.h"

namespace bindpose
{

/// Options of one time step. Lengths are in units of the mesh, times in seconds, energies in mass
/// length^2 / s^2.
struct ReducedDynamicsOptions
{
  double time_step = 1.0 / 24.0;
  Vec3 gravity = Vec3::Zero(); ///< acceleration, length / s^2
  double density = 1.0; ///< mass per volume (per area for surfaces); greater than 0
  /// Energy per volume (area) of a strain of one; greater than 0. The speed of waves is
  /// sqrt(stiffness / density) in lengths per second.
  double stiffness = 1.0;
  double damping = 0.0; ///< 1 / s: the drag is damping times mass times velocity; 0 or more
  /// Options of the minimization in each step.
  ReducedSolveOptions solve;
};

/// Return invalid_input, with the option's name, if an option is out of range.
Status check_options(const ReducedDynamicsOptions& options);

/// Reduced as-rigid-as-possible deformation of a body with mass. The parts that handles do not
/// constrain swing and fall, and they keep their velocity when a handle becomes free. Jacobson et
/// al. 2012, Fast automatic skinning transformations; section on dynamics.
///
///     ReducedDynamics body;
///     body.bind(context, points, tets, weights, handles, options);
///     body.start(context, pose);             // posed without motion
///     body.step(context, pose, options);     // microseconds per step
///     body.deform(context, points, posed);
///
/// A step is implicit Euler. The next displacement minimizes the energy, plus the inertia
/// 1/2 |D - D_n - h V_n|^2 / h^2 in the reduced mass, plus drag, minus the work of gravity. This is
/// ReducedArap's problem with another quadratic form, so an iteration costs the same. It is stable
/// for any time step. It damps fast oscillations, and damps them more for longer steps. Modes of
/// handles may change at any step.
///
/// The result has the same bits for any number of threads, and for the same state, poses and
/// options.
class ReducedDynamics
{
public:
  using Rows = ReducedSpace::Rows;

  /// Bind as ReducedArap::bind() does.
  Status bind(ExecutionContext& context, PointsView points, TrianglesView triangles,
    WeightsView weights, const Handles& handles, const ReducedArapOptions& options = {});
  Status bind(ExecutionContext& context, PointsView points, TetsView tets, WeightsView weights,
    const Handles& handles, const ReducedArapOptions& options = {});

  /// Set the body to the result of reduced as-rigid-as-possible for this pose, without velocity, at
  /// time zero. The state depends on the pose only.
  Status start(
    ExecutionContext& context, const Pose& pose, const ReducedSolveOptions& options = {});

  /// Advance by one time step, with the handles in this pose at its end. Without start(), the first
  /// step begins at rest. Return not_converged if the minimum was not found; the result is usable.
  /// Report: energy (elastic), kinetic_energy, time, iterations, residual,
  /// microseconds_per_iteration, constraint_residual. invalid_input for options out of range.
  Status step(ExecutionContext& context, const Pose& pose, const ReducedDynamicsOptions& options);

  /// All data that the next step depends on in addition to its arguments.
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

  Status deform(ExecutionContext& context, PointsView rest, Points& posed) const;
  Status deform_normals(
    ExecutionContext& context, PointsView rest_normals, Points& posed_normals) const;
  /// Transforms of all columns, handles first.
  const std::vector<Affine>& transforms() const { return this->state_.transforms; }
  std::vector<Eigen::Matrix3d> rotations() const;

  /// Energies and momentum for density 1 and stiffness 1.
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
  Eigen::MatrixXd system_; ///< stiffness + inertia_ * mass
  double inertia_ = -1.0; ///< factor of the mass in system_
  State state_;
};

} // namespace bindpose

#endif
