#ifndef bindpose_poser_body_h
#define bindpose_poser_body_h

#include "arap/reduced_dynamics.h"
#include "poser/poser.h"

#include <functional>
#include <memory>
#include <optional>

namespace bindpose
{

/// Physical parameters of a simulated body. Lengths are in bounding-box diagonals of the shape, so
/// that the same values suit shapes of any size.
struct BodyOptions
{
  double gravity = 0.5; ///< in bounding-box diagonals per second squared, 0 … 20
  int down_axis = 1; ///< gravity acts in the negative direction of this axis: 0 x, 1 y, 2 z
  /// Stiffness in 1/s^2, range 1 … 1e5. Elastic waves cross the bounding-box diagonal
  /// sqrt(stiffness) times per second.
  double stiffness = 100.0;
  double damping = 0.5; ///< in 1/s, range 0 … 20
  double steps_per_second = 60.0; ///< range 1 … 1000
};
bool operator==(const BodyOptions& a, const BodyOptions& b);

/// A recorded run of a simulation: the pose at its start, and the pose and the options of every
/// step. Replaying a run gives the same bits.
struct BodyRun
{
  struct Step
  {
    std::shared_ptr<const Pose> pose; ///< shared by consecutive steps with equal poses
    std::shared_ptr<const BodyOptions> options;
  };
  std::shared_ptr<const Pose> start;
  std::vector<Step> steps;
};

/// Simulates the shape as a body with mass by reduced as-rigid-as-possible dynamics
/// (ReducedDynamics; Jacobson et al. 2012), on the surface or in its tets, and records the run. The
/// caller can constrain a handle for some steps, for example while the user drags it. When the
/// handle is free again, it keeps its velocity.
class Body
{
public:
  /// Maximum number of recorded steps: ten minutes at 60 steps per second. Later steps move the
  /// body but are not recorded.
  static constexpr std::size_t longest_run = 36000;

  explicit Body(std::shared_ptr<const PoseSource> source) : source_(std::move(source)) {}

  bool is_bound(const PoseOptions& options) const;
  /// @param options  only the options of reduced as-rigid-as-possible are used: energy, tets and
  /// extra weights
  Status bind(ExecutionContext& context, const PoseOptions& options);
  Index binds() const { return this->binds_; }

  /// Put the body at rest in this pose at time zero, and begin a new run.
  Status restart(ExecutionContext& context, const Pose& pose, Points& posed);
  /// Advance by one time step of 1 / steps_per_second. The report is that of vtkReducedDynamics.
  Status step(
    ExecutionContext& context, const Pose& pose, const BodyOptions& options, Points& posed);
  bool has_started() const { return this->run_.start != nullptr; }
  double time() const { return this->body_.state().time; }
  const BodyRun& run() const { return this->run_; }
  /// Report whether the run contains all steps. The result is false after more than longest_run
  /// steps.
  bool run_is_complete() const { return this->is_complete_; }
  /// Return one transform per handle. For handles whose mode is not full, it is the transform that
  /// the simulation computed.
  const std::vector<Affine>& transforms() const { return this->body_.transforms(); }
  /// Return the fitted rotations; null before the body has started.
  const PoseRotations* rotations();

  /// Replay a run from its start, and call `on_step` with every shape: first the shape at the
  /// start, then the shape after each step.
  /// @param on_step  returns false to stop the replay
  Status play(ExecutionContext& context, const BodyRun& run,
    const std::function<bool(std::size_t step, const Points& posed)>& on_step);

private:
  Status move_surface(ExecutionContext& context, Points& posed) const;

  std::shared_ptr<const PoseSource> source_;
  std::optional<PoseOptions> bound_;
  ReducedDynamics body_;
  PoseRotations rotations_; ///< cache for rotations()
  Skinning
    surface_skinning_; ///< moves the surface's points; used only if the body is simulated in tets
  BodyRun run_;
  bool is_complete_ = true;
  double diagonal_ = 0.0;
  Index binds_ = 0;
};

} // namespace bindpose

#endif
