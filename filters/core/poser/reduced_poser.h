#ifndef bindpose_poser_reduced_poser_h
#define bindpose_poser_reduced_poser_h

#include "arap/reduced_arap.h"
#include "poser/poser.h"

#include <optional>

namespace bindpose
{

/// Poses by reduced as-rigid-as-possible (Jacobson et al. 2012), on the surface or in the tets. In
/// tets, the surface's points blend the same transforms by their own weights.
class ReducedPoser : public Poser
{
public:
  explicit ReducedPoser(std::shared_ptr<const PoseSource> source) : Poser(std::move(source)) {}
  bool is_bound(const PoseOptions& options) const override;
  const std::vector<Affine>* found() const override { return &this->arap_.transforms(); }
  const PoseRotations* rotations() override;

protected:
  Status bind_missing(ExecutionContext& context, const PoseOptions& options) override;
  Status pose(ExecutionContext& context, const Pose& pose, const PoseOptions& options,
    Index maximum_iterations, Points& posed) override;

private:
  std::optional<PoseOptions> bound_;
  ReducedArap arap_;
  PoseRotations rotations_; ///< cache for rotations()
  Skinning surface_skinning_; ///< blends the surface's points by all columns; used only with tets
};

/// Return the options of the reduced as-rigid-as-possible kernels.
ReducedArapOptions reduced_options(const PoseOptions& options);
/// Compute the surface's weights for all columns of a reduced space in the source's tets. The
/// columns of handles are the source's own weights; extra columns are interpolated from the tets'
/// vertices.
Status weights_on_surface(
  ExecutionContext& context, const PoseSource& source, const Weights& in_tets, Weights& weights);

} // namespace bindpose

#endif
