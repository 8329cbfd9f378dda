#ifndef bindpose_winding_triangle_block_h
#define bindpose_winding_triangle_block_h

#include "base/mesh.h"

#include <cstdint>

namespace bindpose
{

constexpr int triangle_lanes = 8;

/// Eight triangles side by side, relative to a centre and in units of about their own size.
template <typename Real>
struct TriangleBlock
{
  double center[3];
  double inverse_size;
  Real corner[9][triangle_lanes]; ///< x y z of a, of b, of c
  Real weight[triangle_lanes]; ///< multiplicity; 0: nobody's lane
  bool single; ///< whether no multiplicity is above 1 or below -1
};

/// Blocks first … first + count - 1.
struct BlockRun
{
  std::int32_t first, count;
};

/// Who sums the triangles of a block that are too near the point for the fast way: those whose
/// `lanes` are not 0.
class CarefulSum
{
public:
  virtual void add(Index block, const int* lanes) = 0;

protected:
  ~CarefulSum() = default;
};

/// Winding number of the triangles of the runs, but for those handed to `careful`, among them all
/// that are within touch_tolerance of the point. About 1.5 ns a triangle in float, to 1e-5 of a
/// turn a triangle; 4 ns in double, to 1e-9. The same bits whatever instructions the machine has.
double sum_blocks(const TriangleBlock<float>* blocks, const BlockRun* runs, Index count,
  const Vec3& point, double touch_tolerance, CarefulSum& careful);
double sum_blocks(const TriangleBlock<double>* blocks, const BlockRun* runs, Index count,
  const Vec3& point, double touch_tolerance, CarefulSum& careful);

} // namespace bindpose

#endif
