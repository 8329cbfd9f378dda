#ifndef bindpose_domain_bone_cut_h
#define bindpose_domain_bone_cut_h

#include "base/execution.h"
#include "handles/handles.h"

#include <vector>

namespace bindpose
{

/// A planar mesh that was cut open along bones (see cut_along_bones).
struct BoneCut
{
  Points points; ///< the mesh's vertices with their ids, then the duplicates
  Triangles triangles; ///< the mesh's triangles, in the same order
  std::vector<Index> original; ///< #points: original vertex of each point
  /// #points: the side of a curve on which the point is, or 0 if it is on no side. 2 b + 1 is the
  /// left side of the curve whose first bone is handle b, and 2 b + 2 is its right side, as seen
  /// from +z, looking from head to tail.
  std::vector<Index> side;
};

/// Cut a flat mesh (z = const) along every bone of the handles. Every bone must coincide with a
/// chain of mesh edges. Each side of a bone gets its own vertices, so that constraints on its left
/// side end at the bone, as diffusion curves require (Orzan et al., Diffusion Curves, 2008). At a
/// tip inside the mesh the last vertex is not duplicated and is on neither side. A vertex on
/// several curves is on the side of the first of these curves in the list.
///
/// Report: counts.doubled_vertices. A warning names each bone whose only vertices are those that it
/// shares with its neighbors in the curve; the bone uses the sides of these neighbors.
/// @param curves #handles: for each bone the first bone of its curve; empty: each bone is a curve.
/// @return invalid_input, naming the bone, if the bone is not a chain of edges, or if it is a
/// single edge in the interior, which cannot be opened.
Status cut_along_bones(PointsView points, TrianglesView triangles, const Handles& handles,
  const std::vector<Index>& curves, ExecutionContext& context, BoneCut& result);

} // namespace bindpose

#endif
