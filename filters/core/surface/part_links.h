#ifndef bindpose_surface_part_links_h
#define bindpose_surface_part_links_h

#include "base/execution.h"
#include "geometry/mesh.h"

#include <array>
#include <vector>

namespace bindpose
{

/// A link: a straight line that connects points on two triangles of a surface.
struct PartLink
{
  std::array<Index, 2> triangles{ -1, -1 };
  /// The points on the two triangles; they may be equal.
  std::array<Vec3, 2> positions{ Vec3::Zero(), Vec3::Zero() };
};

/// Options of link_parts() and find_covered_openings().
struct PartLinkOptions
{
  double touch_distance = 0.0; ///< maximum distance (>= 0) of two parts that touch
  /// Approximate distance (> 0) between neighboring links where two parts touch.
  double spacing = 0.0;
};

/// Return invalid_input if an option is out of range.
Status check_options(const PartLinkOptions& options);

/// Compute links that connect every loose part of a surface to a held part, directly or through
/// other parts. In this file, a part is held if the caller marks it (for example because it has a
/// handle); all other parts are loose.
///
/// Each loose part is linked to the nearest other part, at the nearest points of the two parts.
/// Linked parts form a group. The group is linked in the same way until it contains a held part (a
/// minimum spanning forest by the rounds of O. Borůvka, 1926). A loose part is also linked to every
/// part that it touches, held or loose: a seat, for example, is linked to each of the legs below
/// it.
///
/// The links are the same for any number of threads. Cost: O(log #parts) rounds; each round takes
/// about 5 us per triangle of a loose part.
/// @param parts #F: part of each triangle, 0 … #parts - 1; triangles with -1 are ignored
/// @param constrained #parts: nonzero for held parts. Return invalid_input if no part is held.
Status link_parts(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const std::vector<Index>& parts, const std::vector<char>& constrained,
  const PartLinkOptions& options, std::vector<PartLink>& links);

/// Return the distance of two triangles, 0 if they intersect.
/// @param positions set to the nearest points, the first one on triangle a
double nearest_points(
  const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, std::array<Vec3, 2>& positions);

} // namespace bindpose

#endif
