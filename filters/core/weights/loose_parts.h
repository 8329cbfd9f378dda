#ifndef bindpose_weights_loose_parts_h
#define bindpose_weights_loose_parts_h

#include "embedding/embedding_tets.h"
#include "surface/part_links.h"
#include "weights/embedded_surface.h"
#include "weights/handles.h"

namespace bindpose
{

/// The parts of a surface that have no handle, and the links that hold them.
struct LooseParts
{
  Index count = 0; ///< connected parts of the lattice without a handle
  std::vector<PartLink> links; ///< empty: none is loose, or more than 20,000 components are
};

/// Links every component of the surface in a part of the lattice without a handle to what it
/// touches (what is nearer than 1/500 of the diagonal), or to what is nearest to it (link_parts).
/// With these links the surface is embedded again.
/// @param surface of the points and triangles in `lattice`
/// @param lowest_equal #V: the lowest id among the points that are equal to each
Status find_loose_parts(PointsView points, TrianglesView triangles,
  const std::vector<Index>& lowest_equal, const EmbeddingTets& lattice,
  const EmbeddedSurface& surface, const Handles& handles, const HandleInsertionOptions& insertion,
  LooseParts& result, ExecutionContext& context);

} // namespace bindpose

#endif
