#ifndef bindpose_inside_tet_quality_h
#define bindpose_inside_tet_quality_h

#include "base/execution.h"
#include "base/mesh.h"
#include "base/tet_facets.h"

#include <array>
#include <vector>

namespace bindpose
{

/// Volume of a regular tet with edges of length 1.
constexpr double regular_tet_volume = 0.11785113019775793;
/// Tets with a smaller dihedral angle are counted as bad, degrees.
constexpr double sliver_angle = 5.0;

/// Smallest of a tet's six dihedral angles, degrees; 0 for a tet without volume.
double min_dihedral_angle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Of tet t.
double longest_edge(const Points& points, const Tets& tets, Index t);

/// How many tets have their smallest dihedral angle in [5 k, 5 (k + 1)) degrees. No tet's is above
/// a regular one's 70.53.
struct DihedralHistogram
{
  static constexpr double bin = 5.0;
  std::array<Index, 15> tets{};
};

struct TetQuality
{
  double volume = 0.0; ///< sum over all tets
  double min_volume = 0.0;
  double min_dihedral_angle = 0.0; ///< degrees, of the worst tet
  Index below_5_degrees = 0; ///< tets whose smallest dihedral angle is below 5 degrees
  DihedralHistogram histogram;
};

TetQuality measure_tets(PointsView points, TetsView tets);

/// How many tets have their smallest dihedral angle (angles: #T, degrees) below `angle` and an edge
/// that the boundary forces to be bad: one of a boundary triangle with a corner of less than
/// `angle`, or with another triangle of the boundary so close in front of it that every tet on it
/// has an angle below `angle`; or one at which two boundary triangles meet at less than `angle`,
/// measured inside.
/// Cancelled, it counts fewer.
Index count_forced_tets(PointsView points, TetsView tets, const Eigen::VectorXd& angles,
  double angle, ExecutionContext& context);

/// internal_error naming the first tet that is flat, turned over, there twice, or that shares a
/// facet with two others or with one on the same side (else the boundary is closed); with
/// may_branch a facet may have any number of tets. Ids must be in range.
Status check_tets(PointsView points, TetsView tets, bool may_branch = false);
/// The same with the tet_facets of the tets, which cost most of it.
Status check_tets(
  PointsView points, TetsView tets, const std::vector<TetFacet>& facets, bool may_branch = false);

/// Removes groups of tets, joined by facets, that hold less than 1e-8 of the volume: crumbs of
/// rounding; and tets that no facet joins to another with less than `lone` of it.
/// `facets`: tet_facets of the tets, before and after. @return how many tets went.
Index drop_crumbs(
  const Points& points, Tets& tets, std::vector<TetFacet>& facets, double lone = 1e-8);

/// Removes tets at the boundary that are flatter than `height` (smallest height of a tet), again
/// and again until none is left there. The boundary moves by less than that. `facets`: tet_facets
/// of the tets, before and after. @return how many went.
Index peel_slivers(const Points& points, Tets& tets, std::vector<TetFacet>& facets, double height);

/// #T x 3 mean of the four vertices.
Points centers_of(const Points& points, const Tets& tets);

} // namespace bindpose

#endif
