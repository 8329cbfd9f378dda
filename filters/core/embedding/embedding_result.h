#ifndef bindpose_embedding_embedding_result_h
#define bindpose_embedding_embedding_result_h

#include "geometry/mesh.h"

#include <vector>

namespace bindpose
{

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
  /// #T: fraction of the tet's volume that is inside the surface, 0 … 1. If the tet has several
  /// copies, each copy contains one part of the surface, and the fraction of a copy includes only
  /// the inside of this part. The fractions are measured on lines a sixth of a cube apart. The
  /// total volume (sum of the fractions times the volume of a tet) is accurate to 1 % if there are
  /// 16 cubes along the longest side. The fraction of a single tet at the surface is accurate to
  /// about 0.1.
  Eigen::VectorXd inside_fractions;
  PointBinding binding; ///< for each input point, its tet and barycentric coordinates
  double spacing = 0.0; ///< edge length of a lattice cube = longest edge of a tet
  Index resolution = 0; ///< number of cubes along the longest side
  Index lattice_tets = 0; ///< number of lattice tets in use; copies of one tet count once
  Index duplicated_nodes = 0; ///< number of vertices minus number of lattice nodes in use
  /// Number of facets with three tets or more. Where parts join (at the web between two fingers),
  /// several copies of one tet, one per part, share a facet with the tet in which the parts are
  /// connected.
  Index branching_facets = 0;
  Index components = 0; ///< number of connected components; tets with a common vertex are connected
};

} // namespace bindpose

#endif
