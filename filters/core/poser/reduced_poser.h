#ifndef bindpose_poser_reduced_poser_h
#define bindpose_poser_reduced_poser_h

#include "arap/reduced_arap.h"
#include "poser/poser.h"

namespace bindpose
{

/// Computes poses by reduced as-rigid-as-possible (Jacobson et al. 2012), on the surface or in the
/// tets. If the transforms are computed in the tets, the surface's points are moved by linear blend
/// skinning with these transforms and with the weights at the surface's points.
class ReducedPoser : public Poser
{
public:
  explicit ReducedPoser(std::shared_ptr<const PoseSource> source) : Poser(std::move(source)) {}
  const std::vector<Affine>* found() const override { return &this->arap_.transforms(); }
  const PoseRotations* rotations() override;

protected:
  Status bind_missing(ExecutionContext& context, const PoseOptions& options) override;
  Status pose(ExecutionContext& context, const Pose& pose, const PoseOptions& options,
    Index maximum_iterations, Points& posed) override;

private:
  ReducedArap arap_;
  PoseRotations rotations_; ///< cache for rotations()
  Skinning surface_skinning_; ///< moves the surface's points; used only with tets
};

/// Return the options of the reduced as-rigid-as-possible kernels.
ReducedArapOptions reduced_options(const PoseOptions& options);
/// Bind a kernel of reduced as-rigid-as-possible deformation to the source's surface, or to its
/// tets if the options require them.
template <typename Kernel>
Status bind_to_source(
  ExecutionContext& context, const PoseSource& source, const PoseOptions& options, Kernel& kernel)
{
  const ReducedArapOptions reduced = reduced_options(options);
  return options.use_tet_energy ? kernel.bind(context, source.tet_points, source.tets,
                                    source.tet_weights, source.handles, reduced)
                                : kernel.bind(context, source.points, source.triangles,
                                    source.weights, source.handles, reduced);
}
/// Bind linear blend skinning that moves the source's surface by the transforms of `arap`. The
/// skinning weights are the handle weights at the surface's points, followed by the extra weights,
/// which are interpolated from the tets' vertices to these points.
/// @param arap  bound to the tets of the source
Status bind_surface_skinning(
  ExecutionContext& context, const PoseSource& source, const ReducedArap& arap, Skinning& skinning);

} // namespace bindpose

#endif
