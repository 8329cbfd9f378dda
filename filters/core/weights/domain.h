#ifndef bindpose_weights_domain_h
#define bindpose_weights_domain_h

#include "base/mesh.h"

#include <vector>

namespace bindpose
{

/// What weights live on: a tet mesh or a triangle surface (planar shapes are flat surfaces).
struct Domain
{
  Points points;
  Tets tets;
  Triangles triangles; ///< used when there are no tets
  /// #T: how much of each tet is material (of a lattice that holds a surface), > 0; empty: all 1.
  /// Energies are those of the material.
  Eigen::VectorXd shares;
  /// Of a lattice: the surface's points that lie in it, and of each a corner of its tet. Distances
  /// of parts are measured from them; empty: from the vertices.
  Points held_points;
  std::vector<Index> held_corners;

  bool is_volume() const { return this->tets.rows() > 0; }
  int corners() const { return this->is_volume() ? 4 : 3; }
  Index element_count() const
  {
    return this->is_volume() ? this->tets.rows() : this->triangles.rows();
  }
  /// The element's vertex ids, corners() of them.
  const Index* element(Index e) const
  {
    return this->is_volume() ? this->tets.data() + 4 * e : this->triangles.data() + 3 * e;
  }
};

/// The tets as a domain, each of them all material.
Domain volume_of(const TetMesh& mesh);

/// invalid_input for: no element, ids out of range, coordinates that are not finite, a tet whose
/// volume is not positive (naming the first and how many), a surface without area.
Status check_domain(const Domain& domain);

/// "tet" or "triangle".
const char* element_name(const Domain& domain);

/// #elements: 1 for those that have an area or a volume.
std::vector<char> measurable_elements(const Domain& domain);

/// The domain's triangles that have an area.
Triangles measurable_triangles(const Domain& domain);

/// Of the elements that have an area or a volume.
Components connected_components(const Domain& domain);

/// Mean length of an element's edges, the local edge length.
double mean_edge_length(const Domain& domain, Index element);

/// True when all points lie in a plane, within 1e-9 of the diagonal, whose normal is then given.
bool is_flat(PointsView points, double diagonal, Vec3& normal);

/// Neighbours of every vertex along edges, ascending, without doubles.
struct VertexGraph
{
  std::vector<Index> begin; ///< #V + 1 offsets into neighbours
  std::vector<Index> neighbours;
};
VertexGraph vertex_graph(const Domain& domain);

} // namespace bindpose

#endif
