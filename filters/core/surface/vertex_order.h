#ifndef bindpose_surface_vertex_order_h
#define bindpose_surface_vertex_order_h

#include "geometry/mesh.h"

#include <vector>

namespace bindpose
{

/// Report whether two vertices have the same coordinates.
bool are_coincident(const PointsView& points, Index a, Index b);

/// Return the used vertices sorted lexicographically by coordinates. Equal vertices are sorted by
/// id.
std::vector<Index> lexicographic_order(const PointsView& points, const std::vector<char>& used);

/// For every vertex, return the lowest id of the used vertices with the same coordinates. An unused
/// vertex gets its own id.
std::vector<Index> find_representatives(const PointsView& points, const std::vector<char>& used);

} // namespace bindpose

#endif
