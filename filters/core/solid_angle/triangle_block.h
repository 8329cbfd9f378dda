#ifndef bindpose_solid_angle_triangle_block_h
#define bindpose_solid_angle_triangle_block_h

// Fast sums of solid angles over blocks of eight triangles, for near triangles in DipoleField.

#include "geometry/mesh.h"

#include <cstdint>

namespace bindpose
{

constexpr int triangle_lanes = 8;

/// Eight triangles, one per lane. Corner coordinates are relative to `center` and multiplied by
/// `inverse_size`, so that all corners are within the unit sphere.
template <typename Real>
struct TriangleBlock
{
  double center[3];
  double inverse_size;
  Real corner[9][triangle_lanes]; ///< coordinates x, y, z of corner a, then of b, then of c
  Real weight[triangle_lanes]; ///< multiplicity; 0 in an unused lane
  bool unit_weights; ///< whether every multiplicity is -1, 0 or 1
};

/// The consecutive blocks first … first + count - 1.
struct BlockRun
{
  std::int32_t first, count;
};

/// Interface that sums the triangles of a block that are too near the point for the fast formula. A
/// triangle is selected if its entry in `lanes` is not 0.
class FallbackSum
{
public:
  virtual void add(Index block, const int* lanes) = 0;

protected:
  ~FallbackSum() = default;
};

/// Return the winding number of the triangles of the runs, except the triangles that are passed to
/// `fallback`. All triangles within touch_tolerance of the point are passed to `fallback`. A
/// triangle takes about 1.5 ns in float, with an error of 1e-5 of a turn, and 4 ns in double, with
/// an error of 1e-9 of a turn. The result has the same bits on every instruction set.
double sum_blocks(const TriangleBlock<float>* blocks, const BlockRun* runs, Index count,
  const Vec3& point, double touch_tolerance, FallbackSum& fallback);
double sum_blocks(const TriangleBlock<double>* blocks, const BlockRun* runs, Index count,
  const Vec3& point, double touch_tolerance, FallbackSum& fallback);

} // namespace bindpose

#endif
