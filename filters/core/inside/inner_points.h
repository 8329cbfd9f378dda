#ifndef bindpose_inside_inner_points_h
#define bindpose_inside_inner_points_h

// Points inside a closed surface, at graded distances from each other, as vertices of tets.

#include "base/execution.h"
#include "geometry/mesh.h"
#include "inside/sizing_field.h"
#include "surface/triangle_tree.h"
#include "winding/winding_number.h"

#include <memory>

namespace bindpose
{

/// The inside of a closed surface. Queries are thread-safe.
class Interior
{
public:
  Status build(ExecutionContext& context, Points points, Triangles boundary);
  bool contains(const Vec3& p) const;
  /// Report whether every point of the surface is farther than `distance` from p.
  bool has_clearance(const Vec3& p, double distance) const;
  const Box& box() const { return this->box_; }
  /// Return a number that is roughly proportional to the number of octree cells in the layer at the
  /// surface. A part of the surface with area A contributes A / (2 growth size^2), where size is
  /// the edge length there. Cost: at most 2,047 evaluations of the sizing field.
  double estimate_layer_cells(const SizingField& sizes) const;

private:
  Points points_;
  Triangles boundary_;
  std::unique_ptr<TriangleTree> tree_; ///< tree over points_ and boundary_
  WindingNumber winding_;
  Box box_;
};

/// Find points inside. The distance between neighboring points is about the local edge length of
/// `sizes`. The distance of the points from the surface is at least about half of this length. The
/// points are corners and centers of octree cells, because Delaunay tets of such points are well
/// shaped. If there are more than `maximum_count` points, the edge lengths are increased, by a
/// scale and by a higher growth rate, until there are about `maximum_count` points. Cost: some
/// microseconds per cell in each attempt; there are typically two or three attempts.
/// @return false if canceled.
bool inner_points(ExecutionContext& context, const Interior& interior, SizingField& sizes,
  Index maximum_count, Points& inner);

} // namespace bindpose

#endif
