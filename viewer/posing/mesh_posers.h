#ifndef bindpose_posing_mesh_posers_h
#define bindpose_posing_mesh_posers_h

#include "pose/full_arap.h"
#include "pose/variational_surface.h"
#include "posing/poser.h"
#include "posing/tet_anchors.h"

#include <optional>

namespace bindpose
{

/// Full as-rigid-as-possible: every vertex on its own, of the surface or of the tets with the
/// surface carried along. A solve goes on from where the last one was.
class FullPoser : public Poser
{
public:
  explicit FullPoser(std::shared_ptr<const PoseSource> source) : Poser(std::move(source)) {}
  bool is_bound(const PoseOptions& options) const override;
  const PoseRotations* rotations() override;

protected:
  Status bind_missing(ExecutionContext& context, const PoseOptions& options) override;
  Status pose(ExecutionContext& context, const Pose& pose, const PoseOptions& options,
    Index most_iterations, Points& posed) override;

private:
  std::optional<PoseOptions> bound_;
  FullArap arap_;
  PoseRotations rotations_; ///< as they were last asked for
  TetAnchors anchors_;
};

/// The smooth surface through what handles hold.
class VariationalPoser : public Poser
{
public:
  explicit VariationalPoser(std::shared_ptr<const PoseSource> source) : Poser(std::move(source)) {}
  bool is_bound(const PoseOptions& options) const override;

protected:
  Status bind_missing(ExecutionContext& context, const PoseOptions& options) override;
  Status pose(ExecutionContext& context, const Pose& pose, const PoseOptions& options,
    Index most_iterations, Points& posed) override;

private:
  std::optional<PoseOptions> bound_;
  VariationalSurface surface_;
};

} // namespace bindpose

#endif
