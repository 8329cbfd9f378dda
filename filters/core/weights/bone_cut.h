#ifndef bindpose_weights_bone_cut_h
#define bindpose_weights_bone_cut_h

#include "base/execution.h"
#include "weights/handles.h"

#include <vector>

namespace bindpose
{

/// A planar mesh that was cut open along bones.
struct BoneCut
{
  Points points; ///< the mesh's vertices with their ids, then the duplicates
  Triangles triangles; ///< the mesh's triangles, in their order
  std::vector<Index> original; ///< #points: original vertex of each point
  /// #points: 0, or the side of a curve that contains the point. 2 b + 1 is the left side of the
  /// curve whose first bone is handle b, 2 b + 2 the right side, as seen from +z along the bone.
  std::vector<Index> side;
};

/// Cut a flat mesh (z = const) along every bone of the handles. Every bone must be a row of mesh
/// edges. Each side of a bone gets its own vertices, so that constraints on its left side end at
/// the bone, as diffusion curves require (Orzan et al., Diffusion Curves, 2008). At a tip inside
/// the mesh the last vertex is not duplicated and is on neither side. A vertex where curves meet is
/// on the side of the first of these curves in the list.
///
/// Report: counts.doubled_vertices. A warning names a bone between others that has no vertex of its
/// own.
/// @param curves #handles: for each bone the first bone of its curve; empty: each bone is a curve.
/// @return invalid_input, naming the bone, if it is not a row of edges, or if it is a single edge
/// in the interior, which cannot open.
Status cut_along_bones(PointsView points, TrianglesView triangles, const Handles& handles,
  const std::vector<Index>& curves, ExecutionContext& context, BoneCut& result);

} // namespace bindpose

#endif
