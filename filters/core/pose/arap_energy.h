#ifndef bindpose_pose_arap_energy_h
#define bindpose_pose_arap_energy_h

#include "base/laplacian.h"
#include "base/mesh.h"

#include <string>
#include <vector>

namespace bindpose
{

/// Which edges share a rotation. All are normalised so that an affine map x -> J x with the same
/// rotation R everywhere costs 1/2 volume |J - R|^2 (area on surfaces). Spokes and rims and
/// elements find that R themselves; spokes do for x -> s R x with s >= 0, and may cost less for a J
/// that stretches, because a vertex' own edges need not point evenly in all directions.
///
/// An edge's weight is the sum of its elements' cotangent weights. Spokes leave out edges where
/// that is negative (obtuse angles opposite to it): alone they would gain by turning away from
/// rest. The other energies need not, because a whole element's weights make a positive form. What
/// is said of costs above holds for spokes where no edge was left out.
enum class ArapEnergy : int
{
  automatic = 0, ///< elements on tets, spokes and rims on surfaces
  spokes_and_rims = 1, ///< a rotation a vertex, for all edges of its elements (Chao et al. 2010)
  elements = 2, ///< a rotation a triangle (Liu et al. 2008) or tet (Chao et al. 2010)
  spokes = 3 ///< a rotation a vertex, for the edges that end at it (Sorkine and Alexa 2007)
};

/// "spokes_and_rims", "triangles", "tetrahedra" or "spokes"; automatic is resolved first.
const char* to_string(ArapEnergy energy, bool tets);

/// The energy that automatic stands for; others as they are.
ArapEnergy resolved(ArapEnergy energy, bool tets);

/// The matrix L of 1/2 tr(V'^T L V'), the energy's quadratic part, whatever the groups: the
/// stiffness matrix, for spokes without its edges of negative weight.
/// @param left_out is told how many edges those are.
SparseMatrix arap_stiffness(
  PointsView rest, TrianglesView triangles, ArapEnergy energy, Index* left_out = nullptr);
SparseMatrix arap_stiffness(
  PointsView rest, TetsView tets, ArapEnergy energy, Index* left_out = nullptr);

/// One sentence for whoever chose spokes on a mesh that has such edges; empty when there are none.
std::string left_out_warning(Index left_out);

/// Which rotation each vertex (spokes, spokes and rims) or element (elements) follows.
struct RotationGroups
{
  ArapEnergy energy = ArapEnergy::spokes_and_rims;
  Index count = 0;
  /// #V: whose rotation a vertex follows; of elements, that of most of its elements (the lowest of
  /// equals), -1 where it has none.
  std::vector<Index> of_vertex;
  std::vector<Index> of_element; ///< #elements; empty for the energies of vertices
};

/// Groups from labels of the vertices; an element takes the label that most of its vertices have
/// (the lowest of equals), labels that no element has disappear.
RotationGroups rotation_groups(
  ArapEnergy energy, TrianglesView triangles, Index count, std::vector<Index> vertex_labels);
RotationGroups rotation_groups(
  ArapEnergy energy, TetsView tets, Index count, std::vector<Index> vertex_labels);

/// The matrix that sums S_k = sum c e e'^T of all groups out of posed vertices, 3 #groups x #V:
/// row i * #groups + k of (matrix * V') is row i of S_k, with e = v_i - v_j at rest, e' posed.
SparseMatrix covariance_matrix(
  PointsView rest, TrianglesView triangles, const RotationGroups& groups);
SparseMatrix covariance_matrix(PointsView rest, TetsView tets, const RotationGroups& groups);

/// 1/2 sum_k sum c |e' - R_k e|^2, edge by edge: exact near zero, where sums of large terms are
/// not. Cost: #elements x #edges.
double arap_energy(PointsView rest, TrianglesView triangles, const RotationGroups& groups,
  PointsView posed, const std::vector<Eigen::Matrix3d>& rotations);
double arap_energy(PointsView rest, TetsView tets, const RotationGroups& groups, PointsView posed,
  const std::vector<Eigen::Matrix3d>& rotations);

} // namespace bindpose

#endif
