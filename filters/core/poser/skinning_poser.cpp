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
  return this->bind_.is_bound(this->shape(), to_method_options(options));
}

Status SkinningPoser::bind_missing(ExecutionContext& context, const PoseOptions& options)
{
  Phase phase(context, "bind");
  return this->bind_.bind(
    context, this->shape(), Tets(), this->source().triangles, to_method_options(options));
}

Status SkinningPoser::pose(ExecutionContext& context, const Pose& pose, const PoseOptions& options,
  Index /*most_iterations*/, Points& posed)
{
  const PoseSource& source = this->source();
  if (options.pseudo_edges == PseudoEdgeChoice::given && !source.pseudo_edges_status.ok())
  {
    return source.pseudo_edges_status;
  }
  Phase phase(context, "skin");
  Status status = this->bind_.pose(
    context, this->shape(), pose, source.pseudo_edges, to_method_options(options), posed);
  if (status.usable())
  {
    status.report.set("seconds.skin", phase.seconds());
    if (options.method == PoseMethod::stretchable_bones && !has_bones(source.handles))
    {
      status.warnings.emplace_back("no handle is a bone that can stretch or twist, so the result "
                                   "equals linear blend skinning");
    }
  }
  return status;
}

} // namespace bindpose
