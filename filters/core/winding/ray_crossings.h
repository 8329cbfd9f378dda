#ifndef bindpose_winding_ray_crossings_h
#define bindpose_winding_ray_crossings_h

#include "base/execution.h"
#include "base/mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace bindpose
{

/// Winding numbers of a closed surface at many points at once: integers, exact.
///
/// The winding number of a point is the sum of the signed crossings of a ray that starts there.
/// Rays run along a coordinate axis, so that a triangle meets the rays of those points whose
/// projections lie in its own. Points are sorted into a grid in the projection plane, and one pass
/// over the triangles finds all crossings. Nothing is built beforehand: this is faster than
/// WindingCells for fewer points than a few times the number of triangles, and for grids.
///
/// Rays through edges and vertices are resolved exactly, as if each point were moved by an
/// infinitesimal amount. `resolved` is 0 for points that touch a triangle or a cap (within the
/// tolerance); the caller must use another method for them.
class RayCrossings
{
public:
  /// Triangles and the caps that close them (boundary_caps.h), centered and scaled (ExactFrame),
  /// fewer than 2^31 in total. All three are referenced, not copied.
  RayCrossings(
    const Points& points, const Triangles& triangles, const Triangles& caps, double tolerance);

  /// Expected time of count() for so many points spread over the bounding box, in nanoseconds on
  /// one thread.
  double predicted_nanoseconds(Index number) const;
  /// Writes the winding numbers of `number` finite points, fewer than 2^31, and resolved flags.
  /// O(#F + number + overlaps of their projections).
  /// @return false when cancelled.
  bool count(const Vec3* points, Index number, ExecutionContext& context, int* counts,
    unsigned char* resolved) const;

  /// Coordinates of a grid's samples along each axis, ascending.
  struct Grid
  {
    std::array<std::vector<double>, 3> at;
  };
  /// The triangles of a grid's layers (samples of equal z), so that layers are evaluated
  /// independently of each other.
  struct Layers
  {
    Index per_slab = 1; ///< layers
    std::vector<Index> begin; ///< of each slab in `faces`, and the end
    std::vector<std::int32_t> faces;
    double nanoseconds = 0.0; ///< expected for all slabs on one thread, without writing
                              ///< values; infinite: too large for rays, and `faces` is empty
  };
  Layers layers_of(const Grid& grid) const;
  /// Writes the winding numbers of a slab's samples, x fastest, from its first layer on. Appends
  /// the positions (in `values`) of unresolved samples to `unresolved`, in no order, some twice.
  /// Thread-safe.
  void count_slab(const Grid& grid, const Layers& layers, Index slab, double* values,
    std::vector<Index>& unresolved) const;

private:
  struct Facet;
  class RowHits;

  std::array<Vec3, 3> corners(Index face) const;
  Facet facet(Index face, int axis) const;
  /// +1, -1: the ray crosses the triangle outwards, inwards; 0: it does not. `touches` is set if
  /// the point touches the triangle.
  int crossing_of(const Facet& facet, const Vec3& point, bool& touches) const;

  const Points* points_;
  const Triangles* triangles_;
  const Triangles* caps_;
  double tolerance_;
  Index faces_;
  Box box_;
  int axis_ = 0; ///< of the rays of count()
  double overlaps_ = 0.0; ///< mean number of triangles whose projected boxes hold a point
};

} // namespace bindpose

#endif
