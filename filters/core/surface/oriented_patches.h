#ifndef bindpose_surface_oriented_patches_h
#define bindpose_surface_oriented_patches_h

#include "geometry/mesh.h"

#include <vector>

namespace bindpose
{

/// A maximal set of triangles that are connected by edges with exactly two triangles.
struct OrientedPatch
{
  /// Triangle ids. Each triangle except the first is a neighbor of a triangle earlier in the list.
  std::vector<Index> triangles;
  /// One flag per triangle: 1 if its orientation is opposite to that of the first triangle.
  /// Orientations are compared by going from neighbor to neighbor.
  std::vector<signed char> flipped;
  bool orientable = true; ///< false: one-sided, like a Moebius strip; `flipped` is then not unique
};

/// Return the patches of a surface. The patches are sorted by their smallest triangle id, which is
/// the first id in each patch. Every triangle is in exactly one patch. Cost: O(n log n).
std::vector<OrientedPatch> oriented_patches(TrianglesView triangles);

} // namespace bindpose

#endif
