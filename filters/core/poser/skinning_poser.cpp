#include "poser/skinning_poser.h"

namespace bindpose
{

namespace
{
SkinningMethodOptions to_method_options(const PoseOptions& options)
{
  SkinningMethodOptions result;
  result.method = to_skinning(options.method);
  result.weights.single_precision = options.single_precision;
  result.pseudo_edges = options.pseudo_edges;
  result.pseudo_edge_stretch = options.pseudo_edge_stretch;
  result.endpoints = options.endpoints;
  return result;
}
} // namespace

SkinnedShape SkinningPoser::shape() const
{
  const PoseSource& source = this->source();
  return { source.points, source.weights, source.handles, source.endpoints };
}

bool SkinningPoser::is_bound(const PoseOptions& options) const
{
  return this->methods_.is_bound(this->shape(), to_method_options(options));
}

Status SkinningPoser::bind_missing(ExecutionContext& context, const PoseOptions& options)
{
  return this->methods_.bind(
    context, this->shape(), Tets(), this->source().triangles, to_method_options(options));
}

Status SkinningPoser::pose(ExecutionContext& context, const Pose& pose, const PoseOptions& options,
  Index /*most_iterations*/, Points& posed)
{
  const PoseSource& source = this->source();
  if (options.pseudo_edges == PseudoEdgeChoice::given && !source.of_pseudo_edges.ok())
  {
    return source.of_pseudo_edges;
  }
  Phase phase(context, "skin");
  Status status = this->methods_.pose(
    context, this->shape(), pose, source.pseudo_edges, to_method_options(options), posed);
  if (status.usable())
  {
    status.report.set("seconds.skin", phase.seconds());
  }
  return status;
}

} // namespace bindpose
