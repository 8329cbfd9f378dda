#ifndef bindpose_posing_skinning_poser_h
#define bindpose_posing_skinning_poser_h

#include "posing/poser.h"
#include "skinning/skinning.h"

#include <optional>

namespace bindpose
{

/// Poses by one of four skinning methods. Linear blend, dual quaternions, stretchable bones and
/// centers of rotation share one set of sparse weights. Centers, endpoint weights and automatic
/// pseudo-edges are computed by the first bind that needs them.
class SkinningPoser : public Poser
{
public:
  explicit SkinningPoser(std::shared_ptr<const PoseSource> source) : Poser(std::move(source)) {}
  bool is_bound(const PoseOptions& options) const override;

protected:
  Status bind_missing(ExecutionContext& context, const PoseOptions& options) override;
  Status pose(ExecutionContext& context, const Pose& pose, const PoseOptions& options,
    Index most_iterations, Points& posed) override;

private:
  bool has_endpoints(const PoseOptions& options) const;
  Status make_endpoints(ExecutionContext& context, EndpointMethod method);

  /// True: the bound weights are in single precision; empty before a bind.
  std::optional<bool> single_;
  Skinning skinning_;
  Points pivots_;
  Points centers_;
  std::optional<EndpointMethod> endpoint_method_;
  Weights endpoints_;
  std::optional<PseudoEdges> automatic_edges_;
  std::vector<Affine> transforms_;
};

} // namespace bindpose

#endif
