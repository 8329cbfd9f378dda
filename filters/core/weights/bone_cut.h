#ifndef bindpose_weights_bone_cut_h
#define bindpose_weights_bone_cut_h

#include "base/execution.h"
#include "weights/handles.h"

#include <vector>

namespace bindpose
{

/// A planar mesh cut open along bones.
struct BoneCut
{
  Points points; ///< the mesh's vertices with their numbers, then the doubled ones
  Triangles triangles; ///< the mesh's, in their order
  std::vector<Index> original; ///< of each point: the vertex that it was
  /// Of each point: 0, or on which side of which curve it lies: 2 b + 1 left of the curve whose
  /// first bone is handle b, 2 b + 2 right of it, as seen from +z along the bone.
  std::vector<Index> side;
};

/// Cuts a flat mesh (z = const) along every bone of the handles, which must be rows of its edges,
/// so that each side of a bone has vertices of its own: what is constrained left of it then ends
/// there, as diffusion curves want (Orzan et al., Diffusion Curves, 2008). A bone that ends inside
/// leaves its last vertex whole and on neither side. Where curves meet a vertex is on the side of
/// the first of them in the list.
/// Report: counts.doubled_vertices. A warning names a bone between others that has no vertex of its
/// own.
/// @param curves of each handle that is a bone: the first bone of its curve; empty: each bone is
/// one invalid_input, naming the bone, where it is not a row of edges, or one edge inside only,
/// which cannot open.
Status cut_along_bones(PointsView points, TrianglesView triangles, const Handles& handles,
  const std::vector<Index>& curves, ExecutionContext& context, BoneCut& result);

} // namespace bindpose

#endif
