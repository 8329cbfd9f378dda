#ifndef bindpose_poser_poser_h
#define bindpose_poser_poser_h

#include "base/execution.h"
#include "poser/pose_options.h"
#include "poser/pose_rotations.h"
#include "poser/pose_source.h"

#include <memory>
#include <optional>

namespace bindpose
{

/// Base class of the pose methods. A poser calls the kernels of one method on the surface of one
/// PoseSource: it binds once and poses many times. The result equals that of the method's filter,
/// bit for bit. bind() and solve() can be called on any thread, one call at a time.
///
/// The report of a pose has the entries of the kernel. In addition it has seconds.solve (computing
/// transforms or points) and seconds.skin (moving the surface by transforms).
class Poser
{
public:
  virtual ~Poser() = default;

  /// Report whether the bind contains everything that solve() needs for these options. The default
  /// implementation requires that the last bind succeeded, and that same_bind() is true for the
  /// options of that bind and `options`.
  virtual bool is_bound(const PoseOptions& options) const;
  /// Compute the missing data of the bind, and keep the existing data. Return the warnings of the
  /// bind.
  Status bind(ExecutionContext& context, const PoseOptions& options);
  /// Compute the points of the surface in a pose, which has one entry per handle. The points are
  /// also valid if the status is not_converged.
  /// @param maximum_iterations  maximum number of iterations, for computing a long solve in several
  /// calls; 0: the default limit
  Status solve(ExecutionContext& context, const Pose& pose, const PoseOptions& options,
    Index maximum_iterations, Points& posed);
  /// Return the transforms that the last solve computed, at least one per handle; null if the
  /// method computes none.
  virtual const std::vector<Affine>* found() const { return nullptr; }
  /// Return the rotations with which the last solve measured its energy; null if the method fits no
  /// rotations.
  virtual const PoseRotations* rotations() { return nullptr; }
  /// Return the number of binds so far.
  Index binds() const { return this->binds_; }

protected:
  explicit Poser(std::shared_ptr<const PoseSource> source) : source_(std::move(source)) {}
  const PoseSource& source() const { return *this->source_; }
  /// Return the options of the last bind; empty if it failed or there was none.
  const std::optional<PoseOptions>& bound() const { return this->bound_; }
  virtual Status bind_missing(ExecutionContext& context, const PoseOptions& options) = 0;
  virtual Status pose(ExecutionContext& context, const Pose& pose, const PoseOptions& options,
    Index maximum_iterations, Points& posed) = 0;

private:
  std::shared_ptr<const PoseSource> source_;
  std::optional<PoseOptions> bound_;
  Index binds_ = 0;
};

/// Return invalid_input if the options require the energy of tets and the source has no tets with
/// weights.
Status check_tets(const PoseSource& source, const PoseOptions& options);

} // namespace bindpose

#endif
