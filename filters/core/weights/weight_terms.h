#ifndef bindpose_weights_weight_terms_h
#define bindpose_weights_weight_terms_h

#include "weights/handle_constraints.h"

#include <utility>

namespace bindpose
{

/// What a problem can ask of bounded and monotone weights besides smoothness. All are off when
/// empty. Vertices are those of the mesh as it came; at a vertex that a handle's insertion adds,
/// numbers are interpolated (NaN where a corner is NaN) and a label holds where all corners agree.
struct WeightTerms
{
  /// Painted rigidity, #V, >= 0: adds 1/2 int rho |grad w|^2 to the energy 1/2 int (lap w)^2, so
  /// that weights are nearly constant where it is large. rho = 1e4 / diagonal^2 times what is
  /// painted (triharmonic energy: 1e8 / diagonal^4), mean of an element's corners: 1 stiffens
  /// everything longer than a hundredth of the mesh's diagonal, whatever unit or resolution it has.
  /// Gradients there fall with 1 / what is painted.
  Eigen::VectorXd rigidity;
  /// Labels, #V: each column is constant on all vertices of one label > 0, exactly: they are one
  /// unknown. A set with a vertex of a handle has that vertex's row. Parts of a mesh that a set
  /// joins count as connected.
  std::vector<Index> rigid_sets;
  /// Least and largest weight of each vertex and handle, #V x #handles; NaN: that of the handle.
  Eigen::MatrixXd lower;
  Eigen::MatrixXd upper;
  /// Least and largest weight of each handle, #handles x 2; empty: 0 and 1. Handles themselves
  /// have weights 0 and 1, so that these can only be wider than [0, 1].
  Eigen::MatrixXd handle_bounds;
  /// Weights that are given, #V x #handles; NaN: free.
  Eigen::MatrixXd pinned;
  /// Mirror vertex of each vertex, #V, or -1: a mirror's mirror is the vertex itself.
  std::vector<Index> mirror;
  /// Instead of mirror: the normal of a plane through mirror_origin; zero: none. Vertices within
  /// 1e-5 of the mesh's diagonal of each other's mirror images belong together.
  Vec3 mirror_normal = Vec3::Zero();
  Vec3 mirror_origin = Vec3::Zero();

  bool has_bounds() const;
  /// Least and largest weight of a handle, and at a vertex.
  std::pair<double, double> bounds_of(Index handle) const;
  std::pair<double, double> bounds_of(Index handle, Index vertex) const;
  bool has_mirror() const { return !this->mirror.empty() || !this->mirror_normal.isZero(); }
  /// Whether anything is on.
  bool any() const;
};

/// The factor of what is painted, see WeightTerms::rigidity, on a mesh of diagonal 1.
double rigidity_unit(int order);

/// invalid_input, naming the vertex or the handle, where lengths do not fit or numbers make no
/// sense: rigidity below 0, bounds that are no numbers or the wrong way round, a mirror that is no
/// vertex or not mutual, pins of a vertex that sum to more than 1.
Status check_terms(const WeightTerms& terms, Index vertex_count, const Handles& handles);

/// The terms with values for inserted vertices and, where a plane is given, with its mirror.
WeightTerms extend_terms(const WeightTerms& terms, const HandleInsertion& mesh);

/// Whether something is asked of single vertices that only they can keep: all but rigidity.
bool asks_of_vertices(const WeightTerms& terms);

/// What is asked of a surface's vertices for a mesh that has some of them. Rigidity is that of the
/// nearest place of the surface.
/// @param original of every vertex of the mesh: the surface's, -1: none.
/// @param lost vertices of the surface of which something is asked, but which the mesh has not.
Status carry_terms(const WeightTerms& terms, const Domain& surface, const Points& points,
  const std::vector<Index>& original, ExecutionContext& context, WeightTerms& carried, Index& lost);

/// Of each handle the one that is its mirror image: the vertices that the mirror makes of its own
/// are the other's. -1: there is none. A handle on the plane is its own image.
std::vector<Index> mirrored_handles(
  const WeightTerms& terms, const HandleConstraints& constraints, Index handle_count);

} // namespace bindpose

#endif
