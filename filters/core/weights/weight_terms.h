#ifndef bindpose_weights_weight_terms_h
#define bindpose_weights_weight_terms_h

#include "weights/handle_constraints.h"

#include <utility>

namespace bindpose
{

/// Optional terms of bounded and monotone weights in addition to smoothness. An empty member is
/// off. Vertices are those of the original mesh. At a vertex that handle insertion adds, numbers
/// are interpolated (NaN if a corner is NaN), and a label applies if all corners have it.
struct WeightTerms
{
  /// Painted rigidity, #V, >= 0: adds 1/2 int rho |grad w|^2 to the energy 1/2 int (lap w)^2, so
  /// that weights are nearly constant where rho is large. rho = 1e4 / diagonal^2 times the painted
  /// value, averaged over the corners of an element (triharmonic energy: 1e8 / diagonal^4). The
  /// painted value 1 stiffens everything longer than a hundredth of the mesh's diagonal, for any
  /// unit and resolution. Gradients decrease in proportion to 1 / painted value.
  Eigen::VectorXd rigidity;
  /// Labels, #V: each column is exactly constant on all vertices of one label > 0, because they are
  /// one unknown. A set that contains a vertex of a handle has that vertex's row. Components that a
  /// set joins count as connected.
  std::vector<Index> rigid_sets;
  /// Smallest and largest weight per vertex and handle, #V x #handles; NaN: use the handle's bound.
  Eigen::MatrixXd lower;
  Eigen::MatrixXd upper;
  /// Smallest and largest weight per handle, #handles x 2; empty: 0 and 1. Weights on handles are 0
  /// and 1, so these bounds must contain [0, 1].
  Eigen::MatrixXd handle_bounds;
  /// Prescribed weights, #V x #handles; NaN: free.
  Eigen::MatrixXd pinned;
  /// Mirror vertex of each vertex, #V; -1: none. The relation is symmetric: mirror[mirror[v]] == v.
  std::vector<Index> mirror;
  /// Alternative to `mirror`: the normal of a plane through mirror_origin; zero: none. Two vertices
  /// are mirror vertices if each is within 1e-5 of the mesh's diagonal of the other's mirror image.
  Vec3 mirror_normal = Vec3::Zero();
  Vec3 mirror_origin = Vec3::Zero();

  bool has_bounds() const;
  /// Return the smallest and largest weight of a handle, in general or at a vertex.
  std::pair<double, double> bounds_of(Index handle) const;
  std::pair<double, double> bounds_of(Index handle, Index vertex) const;
  bool has_mirror() const { return !this->mirror.empty() || !this->mirror_normal.isZero(); }
  /// Report whether any term is on.
  bool any() const;
};

/// Return the factor of painted rigidity (see WeightTerms::rigidity) on a mesh of diagonal 1.
double rigidity_unit(int order);

/// Check the terms. Return invalid_input, naming the vertex or the handle, if
/// - an array has the wrong length;
/// - a rigidity is below 0;
/// - bounds are infinite or in the wrong order;
/// - a mirror entry is no vertex or not mutual;
/// - the pins of a vertex sum to more than 1.
Status check_terms(const WeightTerms& terms, Index vertex_count, const Handles& handles);

/// Return the terms with values for inserted vertices, and with the mirror vertices of a plane.
WeightTerms extend_terms(const WeightTerms& terms, const HandleInsertion& mesh);

/// Report whether a term applies to individual vertices, which the mesh must then contain.
bool asks_of_vertices(const WeightTerms& terms);

/// Transfer the terms from a surface to a mesh that contains some of its vertices. Rigidity is
/// taken from the nearest point of the surface.
/// @param original surface vertex of every vertex of the mesh; -1: none.
/// @param lost number of surface vertices that have terms but are not in the mesh.
Status carry_terms(const WeightTerms& terms, const Domain& surface, const Points& points,
  const std::vector<Index>& original, ExecutionContext& context, WeightTerms& carried, Index& lost);

/// Return for each handle its mirror image: the handle whose constrained vertices are the mirror
/// vertices of the first handle's. -1: none. A handle on the plane is its own image.
std::vector<Index> mirrored_handles(
  const WeightTerms& terms, const HandleConstraints& constraints, Index handle_count);

} // namespace bindpose

#endif
