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
  Points points; ///< the mesh's vertices (ids do not change), then the duplicates
  Triangles triangles; ///< the mesh's triangles, in the same order
  std::vector<Index> original; ///< #points: original vertex of each point
  /// #points: the side of a curve to which the point belongs; 0: no side. A curve consists of one
  /// or more bones (see `curves` of cut_along_bones). Let handle b be the first bone of a curve.
  /// Then 2 b + 1 is the left side of the curve and 2 b + 2 is its right side. Left and right are
  /// as seen from +z, looking from head to tail.
  std::vector<Index> side;
};

/// Cut a flat mesh (z = const) along every bone of the handles. Every bone must coincide with a
/// chain of mesh edges. Each side of a bone gets its own vertices, so that values given on one side
/// do not affect the other side. Diffusion curves require this separation (Orzan et al., Diffusion
/// Curves, 2008). A curve consists of one or more bones (see `curves`). If a curve ends inside the
/// mesh, its last vertex is not duplicated and belongs to neither side. A vertex on several curves
/// belongs to a side of the curve with the lowest index.
///
/// Report: counts.doubled_vertices. If all duplicated vertices of a curve are also on curves with
/// lower indices, the curve has no side of its own. Its bones then use the sides of those curves,
/// and a warning names each of these bones.
/// @param curves #handles: for each bone, the index of the first bone of its curve; empty: each
/// bone is a curve of its own.
/// @return invalid_input, naming the bone, if a bone is not a chain of edges. Also invalid_input if
/// a bone is a single edge inside the mesh and has no end on another bone, because no vertex could
/// be duplicated.
Status cut_along_bones(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const Handles& handles, const std::vector<Index>& curves, BoneCut& result);

} // namespace bindpose

#endif
