#ifndef bindpose_winding_ray_crossings_h
#define bindpose_winding_ray_crossings_h

#include "base/execution.h"
#include "geometry/mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace bindpose
{

/// Winding numbers of a closed surface at many points in one call. They are exact integers.
///
/// The winding number of a point is the sum of the signed crossings of a ray that starts there.
/// Rays run along a coordinate axis, so that only the rays of points in a triangle's projection can
/// cross the triangle. Points are sorted into a grid in the projection plane, and one pass over the
/// triangles finds all crossings. No data structure is built beforehand. Rays are faster than
/// WindingCells for grids. They are also faster for scattered points if the number of points is
/// less than a few times the number of triangles.
///
/// Rays through edges and vertices are resolved exactly, as if each point were moved by an
/// infinitesimal amount. `resolved` is 0 for points that touch a triangle or a cap (within the
/// tolerance); the caller must use another method for them.
class RayCrossings
{
public:
  /// Prepare to count crossings of triangles and the caps that close them (boundary_caps.h). Points
  /// must be centered and scaled (ExactFrame); triangles and caps must be fewer than 2^31 in total.
  /// All three arguments are referenced, not copied.
  RayCrossings(
    const Points& points, const Triangles& triangles, const Triangles& caps, double tolerance);

  /// Return the expected time in nanoseconds, on one thread, of count() for `number` points spread
  /// over the bounding box.
  double predicted_nanoseconds(Index number) const;
  /// Compute the winding numbers and the resolved flags of `number` finite points, fewer than 2^31.
  /// Cost: O(#F + number + #(point, triangle) pairs with overlapping projections).
  /// @return false if canceled.
  bool count(ExecutionContext& context, const Vec3* points, Index number, int* counts,
    unsigned char* resolved) const;

  /// Coordinates of a grid's samples along each axis, ascending.
  struct Grid
  {
    std::array<std::vector<double>, 3> at;
  };
  /// The triangles that overlap each slab of a grid. A slab consists of layers (samples of equal
  /// z). Slabs can be evaluated independently.
  struct Layers
  {
    Index layers_per_slab = 1;
    /// Index of each slab's first triangle in `faces`; the last entry is the size of `faces`.
    std::vector<Index> begin;
    std::vector<std::int32_t> faces;
    /// Expected time of all slabs on one thread, without the time to write values. Infinite if the
    /// surface is too large for rays; `faces` is then empty.
    double nanoseconds = 0.0;
  };
  Layers find_layers(const Grid& grid) const;
  /// Write the winding numbers of the samples of a slab to `values`. x varies fastest, and the
  /// first value belongs to the first layer of the slab. Append the indices (in `values`) of
  /// unresolved samples to `unresolved`; they are not sorted and may occur twice. Thread-safe.
  void count_slab(const Grid& grid, const Layers& layers, Index slab, double* values,
    std::vector<Index>& unresolved) const;

private:
  struct Facet;
  class RowHits;

  std::array<Vec3, 3> corners(Index face) const;
  Facet facet(Index face, int axis) const;
  /// Return +1 if the ray crosses the triangle outwards, -1 if inwards, and 0 if it does not cross.
  /// Set `touches` if the point touches the triangle.
  int signed_crossing(const Facet& facet, const Vec3& point, bool& touches) const;

  const Points* points_;
  const Triangles* triangles_;
  const Triangles* caps_;
  double tolerance_;
  Index faces_;
  Box box_;
  int axis_ = 0; ///< direction of the rays of count()
  double overlaps_ = 0.0; ///< mean number of triangles whose projected boxes contain a given point
};

} // namespace bindpose

#endif
