#ifndef bindpose_weights_loose_parts_h
#define bindpose_weights_loose_parts_h

#include "embedding/embedding_tets.h"
#include "surface/part_links.h"
#include "weights/embedded_surface.h"
#include "weights/handles.h"

namespace bindpose
{

/// The parts of a surface that have no handle, and their links.
struct LooseParts
{
  Index count = 0; ///< connected parts of the lattice without a handle
  std::vector<PartLink> links; ///< empty if no component is loose or more than 20,000 are
};

/// Link every surface component in a lattice part without a handle to the components that it
/// touches (nearer than 1/500 of the diagonal), or to the nearest one (link_parts). The surface
/// must then be embedded again with these links.
/// @param surface the surface of the points and triangles, embedded in `lattice`
/// @param lowest_equal #V: the lowest id among the points that are equal to each point
Status find_loose_parts(PointsView points, TrianglesView triangles,
  const std::vector<Index>& lowest_equal, const EmbeddingTets& lattice,
  const EmbeddedSurface& surface, const Handles& handles, const HandleInsertionOptions& insertion,
  LooseParts& result, ExecutionContext& context);

} // namespace bindpose

#endif
