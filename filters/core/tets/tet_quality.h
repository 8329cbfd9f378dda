#ifndef bindpose_tets_tet_quality_h
#define bindpose_tets_tet_quality_h

// Dihedral angles, validity checks and cleanup of tet meshes.

#include "base/execution.h"
#include "geometry/mesh.h"
#include "geometry/tet_facets.h"

#include <array>
#include <vector>

namespace bindpose
{

/// Volume of a regular tet with edges of length 1.
constexpr double regular_tet_volume = 0.11785113019775793;
/// Limit in degrees: a tet is counted as a sliver if its smallest dihedral angle is below this
/// limit.
constexpr double sliver_angle = 5.0;

/// Return the smallest of the six dihedral angles of a tet, degrees; 0 for a tet without volume.
double min_dihedral_angle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Return the length of the longest edge of tet t.
double longest_edge(const Points& points, const Tets& tets, Index t);

/// Entry k of `tets` is the number of tets with a smallest dihedral angle in [5 k, 5 (k + 1))
/// degrees. The largest possible smallest angle is 70.53 degrees, in a regular tet.
struct DihedralHistogram
{
  static constexpr double bin_width = 5.0;
  std::array<Index, 15> tets{};
};

/// Volume and smallest dihedral angles of a tet mesh.
struct TetQuality
{
  double volume = 0.0; ///< sum of the volumes of all tets
  double min_volume = 0.0;
  double min_dihedral_angle = 0.0; ///< smallest dihedral angle of all tets, degrees
  Index below_5_degrees = 0; ///< number of tets whose smallest dihedral angle is below 5 degrees
  DihedralHistogram histogram;
};

TetQuality measure_tets(PointsView points, TetsView tets);

/// Count the tets whose smallest dihedral angle (angles: #T, degrees) is below `angle` and that
/// have at least one forced edge. At a forced edge, the boundary does not allow larger angles.
/// Forced edges are
/// - the edges of a boundary triangle that has a corner of less than `angle`,
/// - the edges of a boundary triangle t, if another boundary triangle is so near to the inner side
///   of t that every tet at t has an angle below `angle`, and
/// - edges at which two boundary triangles form an angle of less than `angle`, measured inside the
///   tets.
/// If canceled, the count is too small.
Index count_forced_tets(ExecutionContext& context, PointsView points, TetsView tets,
  const Eigen::VectorXd& angles, double angle);

/// Check that tets are valid. Return internal_error with the id of the first tet that is flat,
/// inverted or duplicated, or that shares a facet with two other tets or with a tet on the same
/// side. A valid mesh has a closed boundary. With may_branch a facet may have any number of tets.
/// Ids must be in range.
Status check_tets(PointsView points, TetsView tets, bool may_branch = false);
/// Check tets like the other check_tets() function, but use precomputed facets, the result of
/// tet_facets(). Computing the facets takes most of the time of the checks.
Status check_tets(
  PointsView points, TetsView tets, const std::vector<TetFacet>& facets, bool may_branch = false);

/// Remove groups of tets, connected by facets, whose volume is less than 1e-8 of the total. Such
/// groups result from rounding. Also remove tets without a neighbor that have less than
/// `isolated_fraction` of the volume. `facets` contains the tet_facets() of the tets and is
/// updated. @return the number of removed tets.
Index remove_small_components(
  const Points& points, Tets& tets, std::vector<TetFacet>& facets, double isolated_fraction = 1e-8);

/// Remove tets at the boundary whose smallest height is below `height`. Repeat this until the
/// boundary has no such tets. The boundary moves by less than `height`. `facets` contains the
/// tet_facets() of the tets and is updated. @return the number of removed tets.
Index peel_slivers(const Points& points, Tets& tets, std::vector<TetFacet>& facets, double height);

/// Return the #T x 3 centroids of the tets.
Points tet_centers(const Points& points, const Tets& tets);

} // namespace bindpose

#endif
