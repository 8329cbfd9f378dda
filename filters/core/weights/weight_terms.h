#ifndef bindpose_weights_weight_terms_h
#define bindpose_weights_weight_terms_h

#include "domain/handle_constraints.h"

#include <utility>

namespace bindpose
{

/// Optional terms of bounded and monotone weights: painted rigidity, rigid sets, bounds, prescribed
/// weights and symmetry. An empty member is off. Vertices are those of the original mesh. At a
/// vertex that handle insertion adds, values are interpolated (NaN if a corner is NaN), and a label
/// applies if all corners have it.
struct WeightTerms
{
  /// Painted rigidity, #V, >= 0. It adds 1/2 int rho |grad w|^2 to the energy 1/2 int (lap w)^2, so
  /// that weights are nearly constant where rho is large. rho is 1e4 / diagonal^2 times the painted
  /// value, averaged over the corners of an element (triharmonic energy: 1e8 / diagonal^4). The
  /// painted value 1 makes weights nearly constant over lengths above a hundredth of the mesh's
  /// diagonal, for any unit and resolution. Gradients decrease in proportion to 1 / painted value.
  Eigen::VectorXd rigidity;
  /// Labels of rigid sets, #V. Each column is exactly constant on all vertices with the same label
  /// > 0, because they are one unknown. A set that contains a vertex of a handle has the row of
  /// that vertex. Components that contain vertices of one set count as connected.
  std::vector<Index> rigid_sets;
  /// Smallest and largest weight per vertex and handle, #V x #handles; NaN: use the handle's bound.
  Eigen::MatrixXd lower;
  Eigen::MatrixXd upper;
  /// Smallest and largest weight per handle, #handles x 2; empty: 0 and 1. Vertices on handles have
  /// the weights 0 and 1, so these bounds must contain [0, 1].
  Eigen::MatrixXd handle_bounds;
  /// Prescribed weights, #V x #handles; NaN: solved for.
  Eigen::MatrixXd pinned;
  /// Mirror vertex of each vertex, #V; -1: none. The relation is symmetric: mirror[mirror[v]] == v.
  std::vector<Index> mirror;
  /// Alternative to `mirror`: the normal of a symmetry plane through mirror_origin; zero: no plane.
  /// Two vertices are mirror vertices if the distance of each vertex from the mirror image of the
  /// other one is at most 1e-5 of the mesh's diagonal.
  Vec3 mirror_normal = Vec3::Zero();
  Vec3 mirror_origin = Vec3::Zero();

  bool has_bounds() const;
  /// Return the smallest and largest weight of a handle, in general or at one vertex.
  std::pair<double, double> bounds_of(Index handle) const;
  std::pair<double, double> bounds_of(Index handle, Index vertex) const;
  bool has_mirror() const { return !this->mirror.empty() || !this->mirror_normal.isZero(); }
  /// Report whether any term is in use.
  bool any() const;
};

/// Return the factor that converts a painted rigidity of 1 to rho (see WeightTerms::rigidity) on a
/// mesh of diagonal 1.
double rigidity_unit(int order);

/// Check the terms. Return invalid_input, naming the vertex or the handle, if
/// - an array has the wrong length;
/// - a rigidity is below 0;
/// - bounds are infinite or in the wrong order;
/// - a mirror entry is no vertex, or its own entry does not refer back;
/// - the prescribed weights of a vertex sum to more than 1.
Status check_terms(const WeightTerms& terms, Index vertex_count, const Handles& handles);

/// Extend the terms to inserted vertices. A mirror plane is replaced by mirror vertices.
WeightTerms extend_terms(const WeightTerms& terms, const HandleInsertion& mesh);

/// Report whether a term applies to individual vertices, which the mesh must then contain.
bool asks_of_vertices(const WeightTerms& terms);

/// Transfer the terms from a surface to a mesh that contains some of its vertices. The rigidity of
/// a mesh vertex is the rigidity at the nearest point of the surface.
/// @param original surface vertex of every vertex of the mesh; -1: no surface vertex.
/// @param lost number of surface vertices that have terms but are not in the mesh.
Status carry_terms(const WeightTerms& terms, const Domain& surface, const Points& points,
  const std::vector<Index>& original, ExecutionContext& context, WeightTerms& carried, Index& lost);

/// For each handle, return its mirror image: the handle whose constrained vertices are the mirror
/// vertices of this handle's constrained vertices; -1: no such handle. A handle on the plane is its
/// own image.
std::vector<Index> mirrored_handles(
  const WeightTerms& terms, const HandleConstraints& constraints, Index handle_count);

} // namespace bindpose

#endif
