// Solid angles of eight triangles in parallel, by the formula of solid_angle.cpp. The half angle of
// a triangle is the angle of a complex number. For blocks far from the point, the complex numbers
// of four blocks are multiplied lane by lane before the angle is computed. For near blocks the
// angle of each triangle is computed, by a polynomial arc tangent (fitted at Chebyshev nodes). The
// angle of a triangle loses digits if the point is next to an edge or a vertex. The sign of the
// angle is uncertain if the point is almost in the plane of the triangle. The lanes of such
// triangles contribute 0 and are passed to the FallbackSum.
#include "solid_angle/triangle_block.h"

#include "base/constants.h"
#include "base/simd.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
template <typename Real>
struct Precision;

template <>
struct Precision<float>
{
  using Flag = std::int32_t;
  /// Smallest accepted magnitude, relative to |a||b||c|, of the complex number whose angle is half
  /// the solid angle.
  static constexpr float smallest_magnitude = 1e-2f;
  /// Smallest accepted volume() relative to |a||b||c|. This ratio measures the distance of the
  /// point from the plane of the triangle.
  static constexpr float smallest_volume = 1e-4f;
  /// Smallest accepted squared distance of a vertex from the point, relative to the squared block
  /// size.
  static constexpr float smallest_distance2 = 1e-4f;
  /// A block is far if the squared distance of its center from the point, relative to the squared
  /// block size, is larger than this number.
  static constexpr float distant = 2.5f;
  /// Beyond this squared distance, relative to the squared block size, products of four complex
  /// numbers would overflow.
  static constexpr float largest_distance2 = 1e4f;
  static BINDPOSE_ALWAYS_INLINE float arc_tangent(float t)
  {
    // The terms are summed in pairs, because a chain of twelve dependent operations would be
    // slower.
    const float u = t * t, u2 = u * u;
    const float low = (0.9999993278352406f + u * -0.33326374521881785f) +
      u2 * (0.19879872155711403f + u * -0.1348040560755243f);
    const float high =
      (0.08374155654525908f + u * -0.03689862924644866f) + u2 * 0.007825482945579717f;
    const float r = low + (u2 * u2) * high;
    return r * t;
  }
};

template <>
struct Precision<double>
{
  using Flag = std::int64_t;
  static constexpr double smallest_magnitude = 1e-6;
  static constexpr double smallest_volume = 1e-6;
  static constexpr double smallest_distance2 = 1e-12;
  static constexpr double distant = 2.5;
  static constexpr double largest_distance2 = 1e4;
  static BINDPOSE_ALWAYS_INLINE double arc_tangent(double t)
  {
    const double u = t * t;
    double r = 0.0004301647622606446;
    r = r * u - 0.003261485876596564;
    r = r * u + 0.011602322914837579;
    r = r * u - 0.026271573985506315;
    r = r * u + 0.04390286823048639;
    r = r * u - 0.060385484321734295;
    r = r * u + 0.07502231366141544;
    r = r * u - 0.09051137253813205;
    r = r * u + 0.1110565619077186;
    r = r * u - 0.14285262492712622;
    r = r * u + 0.19999980353708205;
    r = r * u - 0.33333332995051745;
    r = r * u + 0.9999999999902917;
    return r * t;
  }
};

/// A block, and the position of the point relative to the center of the block, in block sizes.
template <typename Real>
struct RelativeBlock
{
  Index block;
  Real at[3];
};

/// Corners of a triangle, relative to the point.
template <typename Real>
struct RelativeTriangle
{
  Real ax, ay, az, bx, by, bz, cx, cy, cz;

  BINDPOSE_ALWAYS_INLINE RelativeTriangle(
    const TriangleBlock<Real>& block, int i, Real x, Real y, Real z)
    : ax(block.corner[0][i] - x), ay(block.corner[1][i] - y), az(block.corner[2][i] - z),
      bx(block.corner[3][i] - x), by(block.corner[4][i] - y), bz(block.corner[5][i] - z),
      cx(block.corner[6][i] - x), cy(block.corner[7][i] - y), cz(block.corner[8][i] - z)
  {
  }
  /// Return six times the volume of the tetrahedron of the triangle and the point.
  BINDPOSE_ALWAYS_INLINE Real volume() const
  {
    return this->ax * (this->by * this->cz - this->bz * this->cy) +
      this->ay * (this->bz * this->cx - this->bx * this->cz) +
      this->az * (this->bx * this->cy - this->by * this->cx);
  }
  /// Return the real part of the complex number whose angle is half the solid angle.
  BINDPOSE_ALWAYS_INLINE Real real(Real la, Real lb, Real lc) const
  {
    return la * lb * lc + (this->ax * this->bx + this->ay * this->by + this->az * this->bz) * lc +
      (this->bx * this->cx + this->by * this->cy + this->bz * this->cz) * la +
      (this->cx * this->ax + this->cy * this->ay + this->cz * this->az) * lb;
  }
};

/// Return the angle of a complex number, in (-pi, pi].
template <typename Real>
BINDPOSE_ALWAYS_INLINE Real angle_of(Real re, Real im)
{
  constexpr Real half_turn = static_cast<Real>(3.14159265358979323846);
  const Real re_size = std::abs(re), im_size = std::abs(im);
  const Real larger = re_size > im_size ? re_size : im_size;
  const Real smaller = re_size > im_size ? im_size : re_size;
  const Real angle = Precision<Real>::arc_tangent(smaller / larger);
  const Real quarter = re_size > im_size ? angle : Real(0.5) * half_turn - angle;
  const Real half = re < Real(0) ? half_turn - quarter : quarter;
  return im < Real(0) ? -half : half;
}

/// Add blocks far from the point. Seen from the point, a sphere of the block's size covers less
/// than an eighth of all directions. Therefore half the solid angle of a triangle is below 41
/// degrees, and the sum of four such angles is below half a turn. No triangle touches the point.
template <typename Real>
BINDPOSE_ALWAYS_INLINE void add_distant_blocks(const TriangleBlock<Real>* blocks,
  const RelativeBlock<Real>* relative, const int* order, int count, Real (&sums)[triangle_lanes])
{
  for (int first = 0; first < count; first += 4)
  {
    Real re[triangle_lanes], im[triangle_lanes];
    for (int i = 0; i < triangle_lanes; ++i)
    {
      re[i] = 1;
      im[i] = 0;
    }
    const int end = std::min(count, first + 4);
    for (int s = first; s < end; ++s)
    {
      const RelativeBlock<Real>& from = relative[order[s]];
      const TriangleBlock<Real>& block = blocks[from.block];
      const Real x = from.at[0], y = from.at[1], z = from.at[2];
      for (int i = 0; i < triangle_lanes; ++i)
      {
        const RelativeTriangle<Real> t(block, i, x, y, z);
        const Real la = std::sqrt(t.ax * t.ax + t.ay * t.ay + t.az * t.az);
        const Real lb = std::sqrt(t.bx * t.bx + t.by * t.by + t.bz * t.bz);
        const Real lc = std::sqrt(t.cx * t.cx + t.cy * t.cy + t.cz * t.cz);
        const Real real = t.real(la, lb, lc);
        const Real imaginary = block.weight[i] * t.volume();
        const Real next = re[i] * real - im[i] * imaginary;
        im[i] = re[i] * imaginary + im[i] * real;
        re[i] = next;
      }
    }
    for (int i = 0; i < triangle_lanes; ++i)
    {
      sums[i] += angle_of(re[i], im[i]);
    }
  }
}

/// Add a block at any distance and with any multiplicities.
template <typename Real>
BINDPOSE_ALWAYS_INLINE void add_block(const TriangleBlock<Real>* blocks,
  const RelativeBlock<Real>& relative, double touch_tolerance, Real (&sums)[triangle_lanes],
  FallbackSum& fallback)
{
  using P = Precision<Real>;
  const TriangleBlock<Real>& block = blocks[relative.block];
  const Real x = relative.at[0], y = relative.at[1], z = relative.at[2];
  const Real scaled_tolerance = static_cast<Real>(touch_tolerance * block.inverse_size);
  const Real smallest_distance2 =
    std::max(P::smallest_distance2, 20 * scaled_tolerance * scaled_tolerance);
  typename P::Flag flags[triangle_lanes];
  typename P::Flag any = 0;
  for (int i = 0; i < triangle_lanes; ++i)
  {
    const RelativeTriangle<Real> t(block, i, x, y, z);
    const Real aa = t.ax * t.ax + t.ay * t.ay + t.az * t.az;
    const Real bb = t.bx * t.bx + t.by * t.by + t.bz * t.bz;
    const Real cc = t.cx * t.cx + t.cy * t.cy + t.cz * t.cz;
    const Real la = std::sqrt(aa), lb = std::sqrt(bb), lc = std::sqrt(cc);
    const Real lengths = la * lb * lc;
    const Real re = t.real(la, lb, lc);
    const Real im = t.volume();
    const Real re_size = std::abs(re), im_size = std::abs(im);
    const Real minimum = aa < bb ? aa : bb;
    const Real nearest = minimum < cc ? minimum : cc;
    const bool is_far = re > Real(0.7) * lengths;
    // Upper bound for the volume if the point touches the triangle: the volume of a slab whose
    // thickness is the tolerance.
    const Real slab = 2 * scaled_tolerance * (la * lb + lb * lc + lc * la);
    const bool off_plane = im_size > P::smallest_volume * lengths + slab;
    const bool kept = (re_size + im_size > P::smallest_magnitude * lengths) &
      (nearest > smallest_distance2) & (is_far | off_plane);
    const Real solid_angle = block.weight[i] * angle_of(re, im);
    sums[i] += kept ? solid_angle : Real(0);
    flags[i] = kept ? 0 : 1;
    any |= flags[i];
  }
  if (any)
  {
    int lanes[triangle_lanes];
    for (int i = 0; i < triangle_lanes; ++i)
    {
      lanes[i] = flags[i] && block.weight[i] != Real(0);
    }
    fallback.add(relative.block, lanes);
  }
}

template <typename Real>
BINDPOSE_ALWAYS_INLINE double sum(const TriangleBlock<Real>* blocks, const BlockRun* runs,
  Index count, const Vec3& point, double touch_tolerance, FallbackSum& fallback)
{
  using P = Precision<Real>;
  constexpr int capacity = 32;
  RelativeBlock<Real> relative[capacity];
  int distant[capacity], near_blocks[capacity];
  int relative_count = 0, distant_count = 0, near_count = 0;
  Real sums[triangle_lanes] = {};
  const auto add_all = [&]() __attribute__((always_inline))
  {
    add_distant_blocks(blocks, relative, distant, distant_count, sums);
    for (int i = 0; i < near_count; ++i)
    {
      add_block(blocks, relative[near_blocks[i]], touch_tolerance, sums, fallback);
    }
    relative_count = distant_count = near_count = 0;
  };
  const double at[3] = { point[0], point[1], point[2] };
  for (Index r = 0; r < count; ++r)
  {
    for (Index b = runs[r].first; b < runs[r].first + runs[r].count; ++b)
    {
      if (relative_count == capacity)
      {
        add_all();
      }
      const TriangleBlock<Real>& block = blocks[b];
      RelativeBlock<Real>& next = relative[relative_count];
      next.block = b;
      Real distance2 = 0;
      for (int k = 0; k < 3; ++k)
      {
        const Real offset = static_cast<Real>((at[k] - block.center[k]) * block.inverse_size);
        next.at[k] = offset;
        distance2 += offset * offset;
      }
      // Bitwise operators avoid a branch, whose outcome would be unpredictable.
      const bool is_distant =
        (distance2 > P::distant) & (distance2 < P::largest_distance2) & block.unit_weights;
      distant[distant_count] = relative_count;
      near_blocks[near_count] = relative_count;
      distant_count += is_distant;
      near_count += !is_distant;
      ++relative_count;
    }
  }
  add_all();
  double total = 0.0;
  for (int i = 0; i < triangle_lanes; ++i)
  {
    total += static_cast<double>(sums[i]);
  }
  return total / two_pi;
}
} // namespace

BINDPOSE_SIMD_CLONES double sum_blocks(const TriangleBlock<float>* blocks, const BlockRun* runs,
  Index count, const Vec3& point, double touch_tolerance, FallbackSum& fallback)
{
  return sum(blocks, runs, count, point, touch_tolerance, fallback);
}

BINDPOSE_SIMD_CLONES double sum_blocks(const TriangleBlock<double>* blocks, const BlockRun* runs,
  Index count, const Vec3& point, double touch_tolerance, FallbackSum& fallback)
{
  return sum(blocks, runs, count, point, touch_tolerance, fallback);
}

} // namespace bindpose
