#include "posing/pose_options.h"

#include "posing/json_fields.h"

#include <tuple>

namespace bindpose
{

namespace
{
constexpr const char* method_words[] = { "lbs", "dqs", "reduced-arap", "stbs", "cor", "full-arap",
  "variational" };
constexpr const char* edge_words[] = { "none", "given", "auto" };
constexpr const char* endpoint_words[] = { "projection", "joints", "bounded" };
constexpr const char* energy_words[] = { "auto", "spokes-and-rims", "elements", "spokes" };
constexpr const char* extra_words[] = { "bumps", "eigenmodes" };
constexpr const char* boundary_words[] = { "region", "curve", "tangent" };

auto tied(const PoseOptions& o)
{
  return std::tie(o.method, o.single_precision, o.pseudo_edges, o.pseudo_edge_stretch, o.endpoints,
    o.energy, o.in_tets, o.drag_only, o.extra_weights, o.extra_kind, o.iterations,
    o.budget_microseconds, o.order, o.boundary);
}
} // namespace

const char* to_string(PoseMethod method)
{
  return method_words[static_cast<int>(method)];
}

bool needs_weights(PoseMethod method)
{
  return !is_slow(method);
}

bool is_skinning(PoseMethod method)
{
  return needs_weights(method) && method != PoseMethod::reduced_arap;
}

bool is_slow(PoseMethod method)
{
  return method == PoseMethod::full_arap || method == PoseMethod::variational;
}

bool same_bind(const PoseOptions& a, const PoseOptions& b)
{
  if (is_skinning(a.method) && is_skinning(b.method))
  {
    // One bind serves all four; centres and endpoint weights are added to it.
    const auto extra = [](const PoseOptions& o)
    {
      return std::make_tuple(o.method == PoseMethod::rotation_centres,
        o.method == PoseMethod::stretchable_bones ? static_cast<int>(o.endpoints) : -1);
    };
    return a.single_precision == b.single_precision && extra(a) == extra(b) &&
      (a.pseudo_edges == PseudoEdgeChoice::automatic) ==
      (b.pseudo_edges == PseudoEdgeChoice::automatic);
  }
  if (a.method != b.method)
  {
    return false;
  }
  switch (a.method)
  {
    case PoseMethod::reduced_arap:
      return std::tie(a.energy, a.in_tets, a.extra_weights, a.extra_kind) ==
        std::tie(b.energy, b.in_tets, b.extra_weights, b.extra_kind);
    case PoseMethod::full_arap:
      return std::tie(a.energy, a.in_tets) == std::tie(b.energy, b.in_tets);
    default:
      return std::tie(a.order, a.boundary) == std::tie(b.order, b.boundary);
  }
}

bool operator==(const PoseOptions& a, const PoseOptions& b)
{
  return tied(a) == tied(b);
}

Json to_json(const PoseOptions& options)
{
  return { { "method", to_string(options.method) },
    { "single_precision", options.single_precision },
    { "pseudo_edges", edge_words[static_cast<int>(options.pseudo_edges)] },
    { "pseudo_edge_stretch", options.pseudo_edge_stretch },
    { "endpoints", endpoint_words[static_cast<int>(options.endpoints)] },
    { "energy", energy_words[static_cast<int>(options.energy)] }, { "in_tets", options.in_tets },
    { "drag_only", options.drag_only }, { "extra_weights", options.extra_weights },
    { "extra_kind", extra_words[static_cast<int>(options.extra_kind)] },
    { "iterations", options.iterations }, { "budget_us", options.budget_microseconds },
    { "order", options.order },
    { "boundary", boundary_words[static_cast<int>(options.boundary)] } };
}

Status from_json(const Json& json, PoseOptions& options)
{
  PoseOptions read = options;
  JsonFields fields(json, "the pose options");
  fields.read("method", read.method, method_words);
  fields.read("single_precision", read.single_precision);
  fields.read("pseudo_edges", read.pseudo_edges, edge_words);
  fields.read("pseudo_edge_stretch", read.pseudo_edge_stretch);
  fields.read("endpoints", read.endpoints, endpoint_words);
  fields.read("energy", read.energy, energy_words);
  fields.read("in_tets", read.in_tets);
  fields.read("drag_only", read.drag_only);
  fields.read("extra_weights", read.extra_weights, 0.0, 30.0);
  fields.read("extra_kind", read.extra_kind, extra_words);
  fields.read("iterations", read.iterations, 1.0, 1000.0);
  fields.read("budget_us", read.budget_microseconds, 0.0, 1e6);
  fields.read("order", read.order, 1.0, 3.0);
  fields.read("boundary", read.boundary, boundary_words);
  if (fields.status().ok())
  {
    options = read;
  }
  return fields.status();
}

} // namespace bindpose
