#ifndef bindpose_poser_mesh_posers_h
#define bindpose_poser_mesh_posers_h

#include "arap/full_arap.h"
#include "fairing/variational_surface.h"
#include "poser/poser.h"
#include "poser/tet_anchors.h"

namespace bindpose
{

/// Computes poses by full as-rigid-as-possible (Sorkine and Alexa 2007). Every vertex of the
/// surface, or of the tets, is an unknown. With tets, the surface moves with the tets. A solve
/// starts from the result of the last solve.
class FullPoser : public Poser
{
public:
  explicit FullPoser(std::shared_ptr<const PoseSource> source) : Poser(std::move(source)) {}
  const PoseRotations* rotations() override;

protected:
  Status bind_missing(ExecutionContext& context, const PoseOptions& options) override;
  Status pose(ExecutionContext& context, const Pose& pose, const PoseOptions& options,
    Index maximum_iterations, Points& posed) override;

private:
  FullArap arap_;
  PoseRotations rotations_; ///< cache for rotations()
  TetAnchors anchors_;
};

/// Computes poses by variational surfaces (Jacobson et al. 2010). A posed shape is the smooth
/// surface that satisfies the constraints of the handles.
class VariationalPoser : public Poser
{
public:
  explicit VariationalPoser(std::shared_ptr<const PoseSource> source) : Poser(std::move(source)) {}

protected:
  Status bind_missing(ExecutionContext& context, const PoseOptions& options) override;
  Status pose(ExecutionContext& context, const Pose& pose, const PoseOptions& options,
    Index maximum_iterations, Points& posed) override;

private:
  VariationalSurface surface_;
};

} // namespace bindpose

#endif
