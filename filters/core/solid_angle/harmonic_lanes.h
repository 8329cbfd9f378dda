#ifndef bindpose_solid_angle_harmonic_lanes_h
#define bindpose_solid_angle_harmonic_lanes_h

#include "base/simd.h"

namespace bindpose
{

/// Number of expansions that are computed in parallel.
constexpr int harmonic_lanes = 8;

/// One double per lane.
struct alignas(64) HarmonicLanes
{
  double lane[harmonic_lanes];
};

/// HarmonicLanes as one vector, for arithmetic on all lanes.
using HarmonicPack __attribute__((vector_size(64), may_alias)) = double;

BINDPOSE_ALWAYS_INLINE const HarmonicPack& pack(const HarmonicLanes& lanes)
{
  return reinterpret_cast<const HarmonicPack&>(lanes);
}
BINDPOSE_ALWAYS_INLINE HarmonicPack& pack(HarmonicLanes& lanes)
{
  return reinterpret_cast<HarmonicPack&>(lanes);
}

} // namespace bindpose

#endif
