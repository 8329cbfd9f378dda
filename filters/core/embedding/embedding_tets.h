#ifndef bindpose_embedding_embedding_tets_h
#define bindpose_embedding_embedding_tets_h

#include "base/execution.h"
#include "base/mesh.h"
#include "surface/part_links.h"
#include "winding/winding_number.h"

#include <vector>

namespace bindpose
{

struct EmbeddingOptions
{
  /// Inside is where the winding number is at least this, > 0.
  double winding_threshold = 0.5;
  /// Lattice cubes along the longest side of the surface's box, 1 … 1000; 0: as many as give about
  /// `tets` lattice tets (half to twice as many unless the surface is a thread).
  Index resolution = 0;
  Index tets = 30000; ///< wanted number of lattice tets, >= 1; of resolution 0 only
  /// Lines that count as parts of the surface: what is at their ends is connected.
  std::vector<PartLink> links;
};

/// Where points lie in tets.
struct PointBinding
{
  /// #V tet ids; -1 for a point that no triangle uses and no tet holds.
  std::vector<Index> tets;
  /// #V x 4 barycentric coordinates, >= 0, for the tet's vertices in their order; 0 for no tet.
  Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor> coordinates;
};

/// A coarse volume that a surface is embedded in.
struct EmbeddingTets
{
  TetMesh mesh; ///< dihedral angles 60 and 90 degrees, positive, no stray vertices
  /// #T: share of the tet's volume that is inside and of its own part, 0 … 1. From lines a sixth of
  /// a cube apart: their sum times the volume is good to 1 % at 16 cubes along the longest side, a
  /// single one that the surface goes through to about 0.1.
  Eigen::VectorXd inside_fractions;
  PointBinding binding; ///< of all points that were given
  double spacing = 0.0; ///< side of a lattice cube = longest edge of a tet
  Index resolution = 0; ///< cubes along the longest side
  Index lattice_tets = 0; ///< tets of the lattice that are used; copies count once
  Index duplicated_nodes = 0; ///< vertices beyond one for each node of the lattice
  /// Facets of three tets or more. Where parts come together (the web of two fingers), copies of
  /// one tet, one for each part, lie at one facet of the tet in which they are connected.
  Index branching_facets = 0;
  Index components = 0; ///< connected by vertices
};

/// Tets of a body-centred cubic lattice that hold a surface and its inside, whatever the surface:
/// open, crossing, a soup, of no thickness, enclosing nothing. Every point of the surface lies in a
/// tet.
///
/// **Parts that are near but not connected share no vertex**: each lattice node is there once for
/// every connected part of the surface and its inside in the tets around the node, and each tet
/// once for every part in it with vertices of its own (virtual nodes: Molino, Bao, Fedkiw, A
/// Virtual Node Algorithm for Changing Mesh Topology During Simulation, 2004). Fingers are thus
/// connected through the palm only, two solids not at all, however narrow the gap. What is
/// connected is what triangles connect that share a vertex (equal points are one), and what can be
/// reached through the inside along lines a sixth of a cube apart; triangles that merely cross do
/// not connect, unless there is a link.
///
/// `winding` is that of the surface (as is, or repaired); equal points, degenerate and duplicate
/// triangles do no harm. The same tets for any number of threads and, but for the scale, any power
/// of two of it.
///
/// Report: spacing, resolution, counts.lattice_tets, counts.duplicated_nodes,
/// counts.branching_facets, counts.tet_components.
///
/// invalid_input: not finite, larger than 1e100, ids out of range, no triangles, options out of
/// range (those of links, too), or a resolution that needs more memory than is sensible (above 4
/// million cubes). Cost: about 2 us a triangle and 5 us a tet.
Status embed_surface(PointsView points, TrianglesView triangles, const WindingNumber& winding,
  const EmbeddingOptions& options, EmbeddingTets& result, ExecutionContext& context);

} // namespace bindpose

#endif
