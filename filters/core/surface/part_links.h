#ifndef bindpose_surface_part_links_h
#define bindpose_surface_part_links_h

#include "base/execution.h"
#include "base/mesh.h"

#include <array>
#include <vector>

namespace bindpose
{

/// A straight line between two places of a surface that holds them together.
struct PartLink
{
  std::array<Index, 2> triangles{ -1, -1 };
  std::array<Vec3, 2> places{ Vec3::Zero(), Vec3::Zero() }; ///< on the triangles; may be equal
};

struct PartLinkOptions
{
  double touching = 0.0; ///< parts that are at most this far apart touch, >= 0
  double spacing = 0.0; ///< where parts touch, about this far from one link to the next, > 0
};

/// Links that lead from every loose part of a surface to a part that is held.
///
/// A loose part is linked to the part nearest to it, at the nearest places of the two; parts that
/// are linked go on as one, until they are held (the minimum spanning forest, by the rounds of
/// O. Borůvka, 1926). It is also linked to whatever it touches, held or not, so that a seat is
/// linked to each of the legs below it.
///
/// The same links for any number of threads. Cost: O(log #parts) rounds, in each of them a search
/// of about 5 us for every triangle of a loose part.
/// @param parts #F: part of each triangle, 0 … #parts - 1; -1: of none, left out
/// @param held #parts: not 0 for parts that are held. None is: invalid_input.
Status link_parts(PointsView points, TrianglesView triangles, const std::vector<Index>& parts,
  const std::vector<char>& held, const PartLinkOptions& options, std::vector<PartLink>& links,
  ExecutionContext& context);

/// Distance of two triangles, 0 when they meet.
/// @param places the nearest places, the first on a
double nearest_places(
  const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, std::array<Vec3, 2>& places);

} // namespace bindpose

#endif
