#ifndef bindpose_surface_oriented_patches_h
#define bindpose_surface_oriented_patches_h

#include "base/mesh.h"

#include <vector>

namespace bindpose
{

/// Triangles joined by edges that two of them use.
struct OrientedPatch
{
  std::vector<Index> triangles; ///< each but the first is a neighbor of one before it
  /// Per triangle: 1 where it runs against the first one, when it is seen across the edges.
  std::vector<signed char> turned;
  bool orientable = true; ///< false: one-sided, like a Moebius strip; `turned` is then one of many
};

/// The patches of a surface, ascending by their smallest triangle, which is their first. Every
/// triangle is in one. O(n log n).
std::vector<OrientedPatch> oriented_patches(TrianglesView triangles);

} // namespace bindpose

#endif
