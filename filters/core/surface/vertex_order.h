#ifndef bindpose_surface_vertex_order_h
#define bindpose_surface_vertex_order_h

#include "base/mesh.h"

#include <vector>

namespace bindpose
{

/// Whether two vertices have the same coordinates.
bool same_place(const PointsView& points, Index a, Index b);

/// The used vertices by their coordinates, x first; of equal ones the lower id first.
std::vector<Index> order_by_place(const PointsView& points, const std::vector<char>& used);

/// For every vertex the lowest used id with the same coordinates; unused vertices keep their own.
std::vector<Index> lowest_at_place(const PointsView& points, const std::vector<char>& used);

} // namespace bindpose

#endif
