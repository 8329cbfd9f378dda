#ifndef bindpose_embedding_embedding_tets_h
#define bindpose_embedding_embedding_tets_h

#include "base/execution.h"
#include "embedding/embedding_result.h"
#include "geometry/mesh.h"
#include "surface/part_links.h"
#include "winding/winding_number.h"

#include <vector>

namespace bindpose
{

/// Options of embed_surface(), which makes a coarse tet lattice that contains a surface.
struct EmbeddingOptions
{
  /// Threshold, > 0: a point is inside if its winding number is at least this.
  double winding_threshold = 0.5;
  /// Number of lattice cubes along the longest side of the surface's bounding box, 1 … 1000. If 0,
  /// the number is chosen so that about `tets` lattice tets result (half to twice as many, except
  /// for surfaces that are thin threads).
  Index resolution = 0;
  Index tets = 30000; ///< target number of lattice tets, >= 1; used if `resolution` is 0
  /// Segments that are embedded together with the surface. Each connects the parts of the surface
  /// at its two ends.
  std::vector<PartLink> links;
};

/// Embed a surface and its inside in tets of a body-centered cubic lattice. The surface may be
/// open, intersect itself, be a triangle soup, have no thickness, or enclose nothing. Every point
/// of the surface is in a tet.
///
/// **Parts that are near but not connected share no vertex.** Consider the material (the surface
/// and its inside) in the tets around a lattice node. Each connected part of this material has a
/// separate copy of the node. A tet has several copies if the parts in the tet use different copies
/// of its nodes (virtual nodes: Molino, Bao, Fedkiw, A Virtual Node Algorithm for Changing Mesh
/// Topology During Simulation, 2004). Fingers are thus connected only through the palm, and two
/// solids are not connected at all, however narrow the gap. Parts are connected by triangles that
/// share a vertex (equal points are merged). They are also connected through the inside, along
/// lines that are a sixth of a cube apart. Triangles that only cross are not connected, unless
/// there is a link.
///
/// `winding` is the winding number of the surface (unchanged or repaired). Equal points, degenerate
/// and duplicate triangles are allowed. The result is the same for any number of threads. Scaling
/// the surface by a power of two only scales the tets.
///
/// Report: spacing, resolution, counts.lattice_tets, counts.duplicated_nodes,
/// counts.branching_facets, counts.tet_components.
///
/// Return invalid_input for coordinates that are not finite, a surface larger than 1e100, ids out
/// of range, no triangles, options (including links) out of range, or a resolution that needs too
/// much memory (above 4 million cubes).
/// Cost: about 2 us per triangle and 5 us per tet.
Status embed_surface(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const WindingNumber& winding, const EmbeddingOptions& options, EmbeddingTets& result);

} // namespace bindpose

#endif
