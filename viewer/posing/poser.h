#ifndef bindpose_posing_poser_h
#define bindpose_posing_poser_h

#include "base/execution.h"
#include "posing/pose_options.h"
#include "posing/pose_rotations.h"
#include "posing/pose_source.h"

#include <memory>

namespace bindpose
{

/// One method at work on one source, by the kernels: binds once, poses many times, and gives what
/// the filter of that method gives, to the bit. Either call may be made on any thread, one at a
/// time.
///
/// All points of a pose's report are those of the kernels; besides, seconds.solve (finding
/// transforms or points) and seconds.skin (moving the surface by them).
class Poser
{
public:
  virtual ~Poser() = default;

  /// Whether solve() has all that these options need.
  virtual bool is_bound(const PoseOptions& options) const = 0;
  /// Makes what is missing; what is there stays. Warnings are those of the bind.
  Status bind(ExecutionContext& context, const PoseOptions& options);
  /// The surface in a pose, one entry a handle. not_converged comes with points, too.
  /// @param most_iterations  fewer than the options', for a slice of a long solve; 0: theirs
  Status solve(ExecutionContext& context, const Pose& pose, const PoseOptions& options,
    Index most_iterations, Points& posed);
  /// After a solve: the transforms that were found, one a handle or more; null where none are.
  virtual const std::vector<Affine>* found() const { return nullptr; }
  /// After a solve: the rotations that its energy was measured against; null where it fits none.
  virtual const PoseRotations* rotations() { return nullptr; }
  /// How often something was bound.
  Index binds() const { return this->binds_; }

protected:
  explicit Poser(std::shared_ptr<const PoseSource> source) : source_(std::move(source)) {}
  const PoseSource& source() const { return *this->source_; }
  virtual Status bind_missing(ExecutionContext& context, const PoseOptions& options) = 0;
  virtual Status pose(ExecutionContext& context, const Pose& pose, const PoseOptions& options,
    Index most_iterations, Points& posed) = 0;

private:
  std::shared_ptr<const PoseSource> source_;
  Index binds_ = 0;
};

/// The poser of a method; the four skinning methods have one in common.
std::unique_ptr<Poser> make_poser(PoseMethod method, std::shared_ptr<const PoseSource> source);
/// Whether make_poser() gives the same for both.
bool same_poser(PoseMethod a, PoseMethod b);

/// The elements that an as-rigid-as-possible energy is of: those of the source's tets, if the
/// options want them.
Status check_tets(const PoseSource& source, const PoseOptions& options);

} // namespace bindpose

#endif
