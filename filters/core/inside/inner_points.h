#ifndef bindpose_inside_inner_points_h
#define bindpose_inside_inner_points_h

#include "base/execution.h"
#include "base/mesh.h"
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
  Status build(Points points, Triangles boundary, ExecutionContext& context);
  bool contains(const Vec3& p) const;
  /// Report whether every point of the surface is at least `distance` away from p.
  bool is_clear(const Vec3& p, double distance) const;
  const Box& box() const { return this->box_; }
  /// Estimate the number of cells of these sizes in the layer at the surface: A / (2 growth size^2)
  /// over an area A. The estimate is correct up to a factor that changes little with the sizes.
  /// Cost: at most 2,047 evaluations of the sizes.
  double layer(const SizingField& sizes) const;

private:
  Points points_;
  Triangles boundary_;
  std::unique_ptr<TriangleTree> tree_; ///< tree over points_ and boundary_
  WindingNumber winding_;
  Box box_;
};

/// Find points inside. Their distances are about the sizes, and their distances from the surface
/// about half of that. The points are corners and centers of the cells of an octree, whose Delaunay
/// tets are well shaped. If that gives more than `most` points, the sizes are enlarged, by a scale
/// and by faster growth, until there are about `most`. Cost: some microseconds per cell, for two or
/// three attempts.
/// @return false when canceled.
bool inner_points(const Interior& interior, SizingField& sizes, Index most,
  ExecutionContext& context, Points& inner);

} // namespace bindpose

#endif
