#ifndef bindpose_domain_loose_parts_h
#define bindpose_domain_loose_parts_h

#include "domain/embedded_surface.h"
#include "embedding/embedding_tets.h"
#include "handles/handles.h"
#include "surface/covered_openings.h"

namespace bindpose
{

/// The parts of an embedding lattice that have no handle, and links that connect them to other
/// parts.
struct LooseParts
{
  Index count = 0; ///< number of connected parts of the lattice that have no handle
  /// Links of the surface components that are in lattice parts without a handle. Empty if no
  /// component, every component, or more than 20,000 components are in such parts.
  std::vector<PartLink> links;
};

/// Link surface components at openings that other components cover (find_covered_openings). An
/// opening counts as covered only if no point of its boundary is farther than 1/500 of the diagonal
/// from the other components. There are no links if the surface has more than 20,000 components.
/// @param representative_of_vertex #V: for each point, the smallest id of all points with the same
/// position
Status link_covered_openings(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const std::vector<Index>& representative_of_vertex, CoveredOpenings& result);

/// Find parts of the lattice that no handle controls. Link every surface component in such a part
/// to the components that it touches (within 1/500 of the diagonal), or else to the nearest
/// component (link_parts). If there are links, the caller must embed the surface again with them.
/// @param surface the surface with the given points and triangles, embedded in `lattice`
/// @param representative_of_vertex #V: for each point, the smallest id of all points with the same
/// position
Status find_loose_parts(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const std::vector<Index>& representative_of_vertex, const EmbeddingTets& lattice,
  const EmbeddedSurface& surface, const Handles& handles, const HandleInsertionOptions& insertion,
  LooseParts& result);

} // namespace bindpose

#endif
