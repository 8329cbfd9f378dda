#ifndef bindpose_geometry_simplex_locator_h
#define bindpose_geometry_simplex_locator_h

// Search for the element of a mesh that contains a point or is nearest to it.

#include "geometry/mesh.h"

#include <array>
#include <vector>

namespace bindpose
{

/// Location of a query point in a mesh: an element, and the barycentric coordinates of the point of
/// this element that is nearest to the query point.
struct SimplexLocation
{
  Index element = -1; ///< element id; -1: the mesh has no element or the point is not finite
  /// Barycentric coordinates; the fourth is 0 for a triangle.
  std::array<double, 4> barycentric{ 0.0, 0.0, 0.0, 0.0 };
  double distance = 0.0; ///< distance from the query point to the element, 0 inside
};

/// Return the point of a triangle or tet that is nearest to p, as barycentric coordinates and
/// distance. The nearest point of a degenerate element is found on its edges.
SimplexLocation nearest_in_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);
SimplexLocation nearest_in_tet(
  const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Finds the element that contains a point, or else the nearest element, by a tree of boxes.
/// Building costs O(n log n), a query near the mesh O(log n). If several elements are equally near,
/// the one with the lowest id is returned.
class SimplexLocator
{
public:
  /// Build the tree. The object stores views, so points and elements must outlive it.
  SimplexLocator(PointsView points, TetsView tets);
  SimplexLocator(PointsView points, TrianglesView triangles);

  SimplexLocation locate(const Vec3& p) const;

private:
  struct Node
  {
    Vec3 lower, upper;
    Index begin = 0, end = 0; // range of a leaf's elements in order_
    Index right = -1; // index of the right child, -1 for a leaf; the left child is the next node
  };
  void build();
  Index build(Index begin, Index end);
  SimplexLocation nearest_in_element(Index element, const Vec3& p) const;

  PointsView points_;
  const Index* elements_;
  Index count_;
  int corners_per_element_;
  std::vector<Vec3> lower_, upper_; // boxes of the elements
  std::vector<Index> order_;
  std::vector<Node> nodes_;
};

} // namespace bindpose

#endif
