#ifndef bindpose_surface_part_links_h
#define bindpose_surface_part_links_h

#include "base/execution.h"
#include "base/mesh.h"

#include <array>
#include <vector>

namespace bindpose
{

/// A straight line that connects two points of a surface.
struct PartLink
{
  std::array<Index, 2> triangles{ -1, -1 };
  /// Points on the triangles; may be equal.
  std::array<Vec3, 2> places{ Vec3::Zero(), Vec3::Zero() };
};

struct PartLinkOptions
{
  double touching = 0.0; ///< parts at most this far apart touch, >= 0
  double spacing = 0.0; ///< approximate distance between neighboring links where parts touch, > 0
};

/// Compute links that connect every loose part of a surface, directly or through other parts, to a
/// held part.
///
/// A loose part is linked to the nearest part, at the nearest points of the two. Linked parts
/// continue as one group until the group is held (the minimum spanning forest, by the rounds of O.
/// Borůvka, 1926). A loose part is also linked to every part that it touches, held or not: a seat,
/// for example, is linked to each of the legs below it.
///
/// The links are the same for any number of threads. Cost: O(log #parts) rounds, each with a search
/// of about 5 us per triangle of a loose part.
/// @param parts #F: part of each triangle, 0 … #parts - 1; triangles with -1 are ignored
/// @param held #parts: not 0 for held parts. invalid_input if no part is held.
Status link_parts(PointsView points, TrianglesView triangles, const std::vector<Index>& parts,
  const std::vector<char>& held, const PartLinkOptions& options, std::vector<PartLink>& links,
  ExecutionContext& context);

/// Return the distance of two triangles, 0 if they intersect.
/// @param places the nearest points, the first on a
double nearest_places(
  const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, std::array<Vec3, 2>& places);

} // namespace bindpose

#endif
