#ifndef bindpose_weights_weight_terms_h
#define bindpose_weights_weight_terms_h

#include "domain/handle_constraints.h"

#include <utility>

namespace bindpose
{

/// Optional terms of bounded and monotone weights: painted rigidity, rigid sets, bounds, prescribed
/// weights and symmetry. If a member is empty, its term is not used. Vertices are those of the
/// original mesh. Handle insertion adds vertices in elements. Values at such a vertex are
/// interpolated from the corners of the element (NaN if a corner is NaN). The vertex gets a label
/// if all these corners have the same label.
struct WeightTerms
{
  /// Painted rigidity, #V. The values must be from 0 to 1e12. The term 1/2 int rho |grad w|^2 is
  /// added to the energy, so that weights are nearly constant where rho is large. On an element,
  /// rho is the mean rigidity of the corners, times 1e4 / diagonal^2 for the biharmonic energy
  /// 1/2 int (lap w)^2 or 1e8 / diagonal^4 for the triharmonic energy. A rigidity of 1 makes
  /// weights nearly constant over lengths above a hundredth of the mesh's diagonal, independent of
  /// unit and resolution. Gradients are proportional to 1 / rigidity.
  Eigen::VectorXd rigidity;
  /// Labels of rigid sets, #V. All vertices with the same label > 0 form a set. They are one
  /// unknown of the solver, so each column is exactly constant on the set. If a set contains a
  /// vertex on a handle, the whole set gets the weights of that vertex. Components that contain
  /// vertices of the same set count as connected.
  std::vector<Index> rigid_sets;
  /// Smallest and largest weight per vertex and handle, #V x #handles; NaN: use the handle's bound.
  Eigen::MatrixXd lower;
  Eigen::MatrixXd upper;
  /// Smallest and largest weight per handle, #handles x 2; empty: 0 and 1. Vertices on handles have
  /// the weights 0 and 1, so these bounds must contain [0, 1].
  Eigen::MatrixXd handle_bounds;
  /// Prescribed weights, #V x #handles; NaN: the weight is solved for.
  Eigen::MatrixXd pinned;
  /// Mirror vertex of each vertex, #V; -1: none. The relation is symmetric: mirror[mirror[v]] == v.
  std::vector<Index> mirror;
  /// Alternative to `mirror`: the normal of a symmetry plane through mirror_origin; zero: no plane.
  /// Two vertices are mirror vertices if each is the vertex nearest to the mirror image of the
  /// other, at a distance below 1e-5 of the mesh's diagonal.
  Vec3 mirror_normal = Vec3::Zero();
  Vec3 mirror_origin = Vec3::Zero();

  bool has_bounds() const;
  /// Return the bounds of a handle's weight: the bounds for all vertices (first function), or the
  /// bounds at one vertex (second function).
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
/// - a rigidity is not in 0 … 1e12;
/// - a bound or a prescribed weight is infinite;
/// - the lower bound of a handle is above its upper bound;
/// - mirror[v] is neither -1 nor the id of a vertex;
/// - mirror[v] is a vertex w, but mirror[w] is not v;
/// - the normal or the origin of the mirror plane is not finite;
/// - the prescribed weights of a vertex are all at least 0 and sum to more than 1;
/// - the weights of all handles are prescribed at a vertex and do not sum to 1.
Status check_terms(const WeightTerms& terms, Index vertex_count, const Handles& handles);

/// Extend the terms to inserted vertices. A mirror plane is replaced by mirror vertices.
WeightTerms extend_terms(const WeightTerms& terms, const HandleInsertion& mesh);

/// Report whether a term applies to individual vertices. If so, the mesh must contain these
/// vertices.
bool has_vertex_terms(const WeightTerms& terms);

/// Transfer the terms from a surface to a mesh that contains some of its vertices. The rigidity of
/// a mesh vertex is the rigidity at the nearest point of the surface.
/// @param original for every vertex of the mesh, the surface vertex at its position; -1: none.
/// @param dropped_count set to the number of surface vertices that have terms for individual
/// vertices but are not in the mesh.
Status transfer_terms(ExecutionContext& context, const WeightTerms& terms, const Domain& surface,
  const Points& points, const std::vector<Index>& original, WeightTerms& transferred,
  Index& dropped_count);

/// Return the mirror image of each handle; -1: none. Handle b is the mirror image of handle a if
/// the vertices on b are the mirror vertices of the vertices on a. A handle on the mirror plane is
/// its own image.
std::vector<Index> mirrored_handles(
  const WeightTerms& terms, const HandleConstraints& constraints, Index handle_count);

} // namespace bindpose

#endif
