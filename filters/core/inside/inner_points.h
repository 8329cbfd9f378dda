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
  /// No point of the surface is nearer to p.
  bool is_clear(const Vec3& p, double distance) const;
  const Box& box() const { return this->box_; }
  /// About how many cells of these sizes are in the layer at the surface, up to a factor that
  /// changes little with the sizes: A / (2 growth size^2) over an area A. Cost: at most 2,047
  /// sizes.
  double layer(const SizingField& sizes) const;

private:
  Points points_;
  Triangles boundary_;
  std::unique_ptr<TriangleTree> tree_; ///< of these two
  WindingNumber winding_;
  Box box_;
};

/// Finds points inside, about as far from each other as the sizes ask for, and half as far from the
/// surface: corners and centers of the cells of an octree, whose Delaunay tets are well shaped. If
/// there were more than `most`, the sizes are made larger, with a scale and a faster growth, until
/// there are about so many. Cost: some microseconds for each cell, two or three times.
/// @return false when cancelled.
bool inner_points(const Interior& interior, SizingField& sizes, Index most,
  ExecutionContext& context, Points& inner);

} // namespace bindpose

#endif
