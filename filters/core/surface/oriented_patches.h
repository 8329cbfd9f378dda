#ifndef bindpose_surface_oriented_patches_h
#define bindpose_surface_oriented_patches_h

#include "base/mesh.h"

#include <vector>

namespace bindpose
{

/// Triangles connected by edges that two of them use.
struct OrientedPatch
{
  std::vector<Index> triangles; ///< each except the first is a neighbor of an earlier one
  /// Per triangle: 1 if its orientation, carried across the edges, is opposite to the first
  /// triangle's.
  std::vector<signed char> turned;
  bool orientable = true; ///< false: one-sided, like a Moebius strip; `turned` is then not unique
};

/// Return the patches of a surface, ascending by their smallest triangle, which is their first.
/// Every triangle is in exactly one patch. O(n log n).
std::vector<OrientedPatch> oriented_patches(TrianglesView triangles);

} // namespace bindpose

#endif
