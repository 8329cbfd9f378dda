#ifndef bindpose_domain_domain_h
#define bindpose_domain_domain_h

#include "geometry/mesh.h"
#include "geometry/working_frame.h"

#include <vector>

namespace bindpose
{

/// The mesh on which weights are solved: tets or a triangle surface. A planar shape is a flat
/// surface.
struct Domain
{
  Points points;
  Tets tets;
  Triangles triangles; ///< triangles of a surface, used if there are no tets
  /// #T: fraction (> 0 and <= 1) of the tet's volume that is inside the surface. The energies of
  /// the tet are multiplied by this fraction. Given only for a lattice that contains a surface. If
  /// empty, all fractions are 1.
  Eigen::VectorXd inside_fractions;
  /// For a lattice that contains a surface: the points of the surface. The distance between a
  /// component and a handle is measured from these points. Without such points, the distance is
  /// measured from the vertices.
  Points embedded_points;
  /// #embedded_points: id of one vertex of the tet that contains the point; -1: no tet contains the
  /// point. The vertex determines the component to which the point belongs.
  std::vector<Index> embedded_point_corners;

  bool is_volume() const { return this->tets.rows() > 0; }
  int corners() const { return this->is_volume() ? 4 : 3; }
  Index element_count() const
  {
    return this->is_volume() ? this->tets.rows() : this->triangles.rows();
  }
  /// Return a pointer to the vertex ids of the element. Their number is corners().
  const Index* element(Index e) const
  {
    return this->is_volume() ? this->tets.data() + 4 * e : this->triangles.data() + 3 * e;
  }
};

/// Return the tets as a domain in which every tet is completely inside.
Domain tet_domain(const TetMesh& mesh);

/// Choose the working frame of a domain. Return the errors of check_mesh() and
/// WorkingFrame::choose().
Status choose_working_frame(const Domain& domain, const std::string& subject, WorkingFrame& frame);

/// Check a domain. Return invalid_input if the domain has no element, if ids are out of range, if
/// coordinates are not finite, if the volume of a tet is not positive (naming the first such tet
/// and the number of such tets), or if a surface has no area.
Status check_domain(const Domain& domain);

/// Return "tet" or "triangle", the type of the domain's elements.
const char* element_name(const Domain& domain);

/// Return for each element 1 if it has an area or a volume, else 0.
std::vector<char> measurable_elements(const Domain& domain);

/// Return the domain's triangles that have an area.
Triangles measurable_triangles(const Domain& domain);

/// Return the connected components of the elements that have an area or a volume.
Components connected_components(const Domain& domain);

/// Return the mean edge length of an element, which is used as the local mesh size.
double mean_edge_length(const Domain& domain, Index element);

/// Report whether all points are in one plane, within 1e-9 times the diagonal. Set `normal` to the
/// unit normal of the plane that fits the points best.
bool is_flat(PointsView points, double diagonal, Vec3& normal);

/// The neighbors of every vertex along edges, ascending, without duplicates.
struct VertexGraph
{
  std::vector<Index> begin; ///< #V + 1 offsets into neighbors
  std::vector<Index> neighbors;
};
VertexGraph vertex_graph(const Domain& domain);

} // namespace bindpose

#endif
