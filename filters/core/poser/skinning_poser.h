#ifndef bindpose_poser_skinning_poser_h
#define bindpose_poser_skinning_poser_h

#include "poser/poser.h"
#include "poser/skinning_bind.h"

namespace bindpose
{

/// Computes poses by one of four skinning methods: linear blend, dual quaternions, stretchable
/// bones and centers of rotation. Centers, endpoint weights and automatic pseudo-edges are computed
/// by the first bind that needs them.
class SkinningPoser : public Poser
{
public:
  explicit SkinningPoser(std::shared_ptr<const PoseSource> source) : Poser(std::move(source)) {}
  bool is_bound(const PoseOptions& options) const override;

protected:
  Status bind_missing(ExecutionContext& context, const PoseOptions& options) override;
  Status pose(ExecutionContext& context, const Pose& pose, const PoseOptions& options,
    Index maximum_iterations, Points& posed) override;

private:
  SkinnedShape shape() const;

  SkinningBind bind_;
};

} // namespace bindpose

#endif
