#include "poser/pose_options.h"

#include <tuple>

namespace bindpose
{

namespace
{
constexpr const char* method_words[] = { "lbs", "dqs", "reduced-arap", "stbs", "cor", "full-arap",
  "variational" };

auto as_tuple(const PoseOptions& o)
{
  return std::tie(o.method, o.single_precision, o.pseudo_edges, o.pseudo_edge_stretch, o.endpoints,
    o.energy, o.use_tet_energy, o.extra_weights, o.extra_kind, o.iterations, o.budget_microseconds,
    o.order, o.boundary);
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

SkinningMethod to_skinning(PoseMethod method)
{
  switch (method)
  {
    case PoseMethod::dual_quaternion:
      return SkinningMethod::dual_quaternion;
    case PoseMethod::stretchable_bones:
      return SkinningMethod::stretchable_bones;
    case PoseMethod::rotation_centers:
      return SkinningMethod::rotation_centers;
    default:
      return SkinningMethod::linear_blend;
  }
}

bool finds_rotations(PoseMethod method)
{
  return method == PoseMethod::reduced_arap || method == PoseMethod::full_arap;
}

StretchUse stretch_use(PoseMethod method)
{
  return method == PoseMethod::stretchable_bones ? StretchUse::all
    : is_skinning(method)                        ? StretchUse::tails
                                                 : StretchUse::ends;
}

bool is_slow(PoseMethod method)
{
  return method == PoseMethod::full_arap || method == PoseMethod::variational;
}

bool same_bind(const PoseOptions& a, const PoseOptions& b)
{
  if (a.method != b.method)
  {
    return false;
  }
  switch (a.method)
  {
    case PoseMethod::reduced_arap:
      return std::tie(a.energy, a.use_tet_energy, a.extra_weights, a.extra_kind) ==
        std::tie(b.energy, b.use_tet_energy, b.extra_weights, b.extra_kind);
    case PoseMethod::full_arap:
      return std::tie(a.energy, a.use_tet_energy) == std::tie(b.energy, b.use_tet_energy);
    default:
      return std::tie(a.order, a.boundary) == std::tie(b.order, b.boundary);
  }
}

bool operator==(const PoseOptions& a, const PoseOptions& b)
{
  return as_tuple(a) == as_tuple(b);
}

} // namespace bindpose
