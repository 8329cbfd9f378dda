#ifndef bindpose_embedding_embedding_tets_h
#define bindpose_embedding_embedding_tets_h

#include "base/execution.h"
#include "base/mesh.h"
#include "surface/part_links.h"
#include "winding/winding_number.h"

#include <vector>

namespace bindpose
{

/// Options of embed_surface(), which makes a coarse tet lattice that contains a surface.
struct EmbeddingOptions
{
  /// Points with at least this winding number are inside, > 0.
  double winding_threshold = 0.5;
  /// Number of lattice cubes along the longest side of the surface's bounding box, 1 … 1000. 0:
  /// chosen to give about `tets` lattice tets (half to twice as many, except for surfaces that are
  /// thin threads).
  Index resolution = 0;
  Index tets = 30000; ///< target number of lattice tets, >= 1; used if `resolution` is 0
  /// Segments that count as parts of the surface: they connect the parts at their ends.
  std::vector<PartLink> links;
};

/// The positions of points in the tets that contain them.
struct PointBinding
{
  /// #V: the tet of each point; -1 for a point that no triangle uses and no tet contains.
  std::vector<Index> tets;
  /// #V x 4: barycentric coordinates, >= 0, in the order of the tet's vertices; 0 if there is no
  /// tet.
  Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor> coordinates;
};

/// A coarse volume mesh in which a surface is embedded.
struct EmbeddingTets
{
  /// Tets with dihedral angles of 60 and 90 degrees and positive volumes; no unused vertices.
  TetMesh mesh;
  /// #T: fraction of the tet's volume that is inside and belongs to the part of the surface that
  /// this copy of the tet contains, 0 … 1. The fractions are measured on lines a sixth of a cube
  /// apart. Their sum times the volume of a tet is accurate to 1 % at 16 cubes along the longest
  /// side. The fraction of a single tet that the surface passes through is accurate to about 0.1.
  Eigen::VectorXd inside_fractions;
  PointBinding binding; ///< tets and coordinates of all input points
  double spacing = 0.0; ///< edge length of a lattice cube = longest edge of a tet
  Index resolution = 0; ///< number of cubes along the longest side
  Index lattice_tets = 0; ///< number of lattice tets in use; copies of one tet count once
  Index duplicated_nodes = 0; ///< number of vertices minus number of lattice nodes in use
  /// Number of facets with three tets or more. Where parts join (at the web between two fingers),
  /// several copies of one tet, one per part, share a facet with the tet in which the parts are
  /// connected.
  Index branching_facets = 0;
  Index components = 0; ///< number of components that are connected by vertices
};

/// Embed a surface and its inside in tets of a body-centered cubic lattice. The surface may be
/// open, intersect itself, be a triangle soup, have no thickness, or enclose nothing. Every point
/// of the surface is in a tet.
///
/// **Parts that are near but not connected share no vertex.** Consider the connected parts of the
/// surface and its inside in the tets around a lattice node: the node has one copy per such part.
/// Each tet has one copy per part with separate vertices (virtual nodes: Molino, Bao, Fedkiw, A
/// Virtual Node Algorithm for Changing Mesh Topology During Simulation, 2004). Fingers are thus
/// connected only through the palm, and two solids are not connected at all, however narrow the
/// gap. Parts are connected by triangles that share a vertex (equal points are merged), and through
/// the inside along lines a sixth of a cube apart. Triangles that only cross are not connected,
/// unless there is a link.
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
Status embed_surface(PointsView points, TrianglesView triangles, const WindingNumber& winding,
  const EmbeddingOptions& options, EmbeddingTets& result, ExecutionContext& context);

} // namespace bindpose

#endif
