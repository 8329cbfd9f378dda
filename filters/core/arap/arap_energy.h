#ifndef bindpose_arap_arap_energy_h
#define bindpose_arap_arap_energy_h

// As-rigid-as-possible energies (Sorkine and Alexa 2007; Liu et al. 2008; Chao et al. 2010): groups
// of edges that share a rotation, and the matrices of the energy.

#include "geometry/laplacian.h"
#include "geometry/mesh.h"

#include <string>
#include <vector>

namespace bindpose
{

/// Type of the as-rigid-as-possible energy, which determines the sets of edges that share one
/// rotation. All energies are normalized: an affine map x -> J x with the same rotation R
/// everywhere costs 1/2 volume |J - R|^2 (on surfaces, area instead of volume). For
/// `spokes_and_rims` and `elements`, the energy of the map is the minimum of this cost over all R.
/// For `spokes`, the energy equals this minimum if J is a rotation times a nonnegative scale. For
/// any other J, the energy `spokes` may be lower, because the edges of one vertex need not be
/// distributed evenly over all directions.
///
/// The weight of an edge is the sum of its elements' cotangent weights. The energy `spokes` omits
/// edges with negative weights (obtuse angles opposite to the edge), because the term of such an
/// edge is negative whenever the edge does not follow the rotation, so the rest pose would not
/// always be the minimum. If an edge is omitted, the costs above do not hold for `spokes`. The
/// other energies keep all edges, because the weights of a whole element define a positive
/// semi-definite form.
enum class ArapEnergy : int
{
  automatic = 0, ///< `elements` on tets, `spokes_and_rims` on surfaces
  /// One rotation per vertex, for all edges of its elements (Chao et al. 2010).
  spokes_and_rims = 1,
  elements = 2, ///< one rotation per triangle (Liu et al. 2008) or tet (Chao et al. 2010)
  spokes = 3 ///< one rotation per vertex, for the edges at the vertex (Sorkine and Alexa 2007)
};

/// Lower bound for the energy in the convergence test, as a fraction of 1/2 tr(V^T L V) for the
/// rest positions V and the stiffness L. Smaller energies are replaced by this bound.
constexpr double negligible_energy = 1e-6;

/// Return "spokes_and_rims", "triangles", "tetrahedra" or "spokes". `automatic` is first replaced
/// by the energy that it selects.
const char* to_string(ArapEnergy energy, bool tets);

/// Return the energy that `automatic` selects; return any other energy unchanged.
ArapEnergy resolve_energy(ArapEnergy energy, bool tets);

/// Return the matrix L (#V x #V) of the quadratic part 1/2 tr(V'^T L V') of the energy. L does not
/// depend on the groups. L is the stiffness matrix of the mesh; for `spokes`, edges with negative
/// weights are excluded.
/// @param ignored_edges receives the number of excluded edges.
SparseMatrix arap_stiffness(
  PointsView rest, TrianglesView triangles, ArapEnergy energy, Index* ignored_edges = nullptr);
SparseMatrix arap_stiffness(
  PointsView rest, TetsView tets, ArapEnergy energy, Index* ignored_edges = nullptr);

/// Return a one-sentence warning about the edges that the energy `spokes` omits; empty if no edge
/// is omitted.
std::string ignored_edges_warning(Index ignored_edges);

/// Assignment of vertices or elements to groups that share a rotation. The energy `elements`
/// assigns elements, the other energies assign vertices.
struct RotationGroups
{
  ArapEnergy energy = ArapEnergy::spokes_and_rims;
  Index count = 0;
  /// #V: group of each vertex. For the energy `elements`: the most frequent group among the
  /// vertex's elements (the lowest of equally frequent groups), -1 if no element uses the vertex.
  /// Empty if each element is a group of its own (FullArap).
  std::vector<Index> group_of_vertex;
  /// #elements: the group of each element; empty for the per-vertex energies.
  std::vector<Index> group_of_element;
};

/// Convert labels of the vertices to groups. With the energy `elements`, the group of an element is
/// the most frequent label among its vertices (the lowest of equally frequent labels), and unused
/// labels are removed.
RotationGroups rotation_groups(
  ArapEnergy energy, TrianglesView triangles, Index count, std::vector<Index> vertex_labels);
RotationGroups rotation_groups(
  ArapEnergy energy, TetsView tets, Index count, std::vector<Index> vertex_labels);

/// Return the matrix (3 #groups x #V) that computes the covariances S_k = sum c e e'^T of all
/// groups from posed vertices. Row i * #groups + k of (matrix * V') is row i of S_k. An edge is e =
/// v_i - v_j in the rest pose and e' in the posed shape; c is its weight in the group.
SparseMatrix covariance_matrix(
  PointsView rest, TrianglesView triangles, const RotationGroups& groups);
SparseMatrix covariance_matrix(PointsView rest, TetsView tets, const RotationGroups& groups);

/// Return the energy 1/2 sum_k sum c |e' - R_k e|^2 (notation of covariance_matrix()), summed edge
/// by edge. The sum is accurate even if the energy is near zero, because no large numbers are
/// subtracted. Cost: each element has one term for each combination of an edge and a group.
double arap_energy(PointsView rest, TrianglesView triangles, const RotationGroups& groups,
  PointsView posed, const std::vector<Eigen::Matrix3d>& rotations);
double arap_energy(PointsView rest, TetsView tets, const RotationGroups& groups, PointsView posed,
  const std::vector<Eigen::Matrix3d>& rotations);

} // namespace bindpose

#endif
