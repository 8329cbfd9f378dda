#ifndef bindpose_geometry_triangle_sides_h
#define bindpose_geometry_triangle_sides_h

#include "base/mesh_types.h"

#include <vector>

namespace bindpose
{

/// A side of one triangle. An edge consists of the sides of all triangles that share its two
/// vertices.
struct TriangleSide
{
  Index a, b; ///< end vertices of the edge, a <= b
  Index triangle;
  int corner; ///< the side goes from this corner of the triangle to the next corner
  bool forward; ///< whether the side goes from a to b

  bool same_edge(const TriangleSide& other) const
  {
    return this->a == other.a && this->b == other.b;
  }
};

/// Return the 3 #F sides, sorted by (a, b, triangle, corner), so that the sides of an edge are
/// adjacent.
std::vector<TriangleSide> sides_by_edge(TrianglesView triangles);
/// Return the index after the last side of the edge to which sides[begin] belongs.
std::size_t end_of_edge(const std::vector<TriangleSide>& sides, std::size_t begin);

} // namespace bindpose

#endif
