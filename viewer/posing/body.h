#ifndef bindpose_posing_body_h
#define bindpose_posing_body_h

#include "pose/reduced_dynamics.h"
#include "posing/poser.h"

#include <functional>
#include <memory>
#include <optional>

namespace bindpose
{

/// How the shape moves by itself, in units of the shape, so that the same numbers suit any file:
/// a length is its diagonal.
struct BodyOptions
{
  double gravity = 0.5; ///< diagonals / s^2, 0 to 20
  int down = 1; ///< the axis along which things fall, towards its lower end: 0 x, 1 y, 2 z
  /// Waves cross the diagonal sqrt(stiffness) times a second; 1 to 1e5.
  double stiffness = 100.0;
  double damping = 0.5; ///< 1 / s, 0 to 20
  double steps_per_second = 60.0; ///< 1 to 1000
};
bool operator==(const BodyOptions& a, const BodyOptions& b);

/// A run as it was done: the pose that it began with, and pose and options of every step. Played
/// again it gives the same bits.
struct BodyRun
{
  struct Step
  {
    std::shared_ptr<const Pose> pose; ///< shared by steps in a row that have the same
    std::shared_ptr<const BodyOptions> options;
  };
  std::shared_ptr<const Pose> start;
  std::vector<Step> steps;
};

/// The shape as a body with mass (ReducedDynamics), on the surface or in its tets, with a record of
/// what it did. A free handle that is held follows whoever holds it, and keeps its velocity when
/// it is let go.
class Body
{
public:
  /// Longest run that is recorded, ten minutes at 60 steps a second; the body moves on after it.
  static constexpr std::size_t longest_run = 36000;

  explicit Body(std::shared_ptr<const PoseSource> source) : source_(std::move(source)) {}

  bool is_bound(const PoseOptions& options) const;
  /// @param options  of reduced as-rigid-as-possible: energy, tets, extra weights
  Status bind(ExecutionContext& context, const PoseOptions& options);
  Index binds() const { return this->binds_; }

  /// To time zero, at rest in this pose; a new run begins.
  Status restart(ExecutionContext& context, const Pose& pose, Points& posed);
  /// One step of 1 / steps_per_second. Report: vtkReducedDynamics'.
  Status step(
    ExecutionContext& context, const Pose& pose, const BodyOptions& options, Points& posed);
  bool has_started() const { return this->run_.start != nullptr; }
  double time() const { return this->body_.state().time; }
  const BodyRun& run() const { return this->run_; }
  /// Steps beyond longest_run that the run does not hold.
  bool run_is_whole() const { return this->whole_; }
  /// One a handle: where the body has taken those that are not full.
  const std::vector<Affine>& transforms() const { return this->body_.transforms(); }
  /// What it is turned by; null before it has started.
  const PoseRotations* rotations();

  /// Plays a run from its start; each of its poses in turn, the first without motion.
  /// @param seen  false from it ends the play
  Status play(ExecutionContext& context, const BodyRun& run,
    const std::function<bool(std::size_t step, const Points& posed)>& seen);

private:
  Status move_surface(ExecutionContext& context, Points& posed) const;

  std::shared_ptr<const PoseSource> source_;
  std::optional<PoseOptions> bound_;
  ReducedDynamics body_;
  PoseRotations rotations_; ///< as they were last asked for
  Skinning on_surface_; ///< in tets only
  BodyRun run_;
  bool whole_ = true;
  double diagonal_ = 0.0;
  Index binds_ = 0;
};

} // namespace bindpose

#endif
