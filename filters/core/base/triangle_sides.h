#ifndef bindpose_base_triangle_sides_h
#define bindpose_base_triangle_sides_h

#include "base/mesh.h"

#include <vector>

namespace bindpose
{

/// A side of a triangle, as one of its edge's.
struct TriangleSide
{
  Index a, b; ///< the edge, a <= b
  Index triangle;
  int corner; ///< the side runs from this corner of the triangle to the next
  bool forward; ///< it runs a -> b

  bool same_edge(const TriangleSide& other) const
  {
    return this->a == other.a && this->b == other.b;
  }
};

/// #F * 3 sides, those of an edge next to each other: sorted by (a, b, triangle, corner).
std::vector<TriangleSide> sides_by_edge(TrianglesView triangles);
/// Behind the last side of the edge that sides[begin] is of.
std::size_t end_of_edge(const std::vector<TriangleSide>& sides, std::size_t begin);

} // namespace bindpose

#endif
