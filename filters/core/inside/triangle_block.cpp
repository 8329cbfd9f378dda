// The formula of solid_angle.cpp, eight triangles at a time, with an arc tangent of its own (a
// polynomial fitted at Chebyshev nodes) instead of products of complex numbers. Where digits would
// be lost (next to an edge or a vertex), or the side of the triangle cannot be told from its plane,
// the lane adds nothing and is handed on.
#include "inside/triangle_block.h"

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
  static constexpr float lost = 1e-2f; ///< relative size of the complex number
  static constexpr float flat = 1e-4f; ///< relative distance from the plane
  static constexpr float reach = 1e-4f; ///< squared distance of a vertex, in sizes of the block
  static constexpr float apart = 2.5f; ///< squared distance of a block's centre, in its sizes
  static BINDPOSE_ALWAYS_INLINE float arc_tangent(float t)
  {
    const float u = t * t;
    float r = 0.007825482945579717f;
    r = r * u - 0.03689862924644866f;
    r = r * u + 0.08374155654525908f;
    r = r * u - 0.1348040560755243f;
    r = r * u + 0.19879872155711403f;
    r = r * u - 0.33326374521881785f;
    r = r * u + 0.9999993278352406f;
    return r * t;
  }
};

template <>
struct Precision<double>
{
  using Flag = std::int64_t;
  static constexpr double lost = 1e-6;
  static constexpr double flat = 1e-6;
  static constexpr double reach = 1e-12;
  static constexpr double apart = 2.5;
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

template <typename Real>
BINDPOSE_ALWAYS_INLINE double sum(const TriangleBlock<Real>* blocks, const BlockRun* runs,
  Index count, const Vec3& point, double touch_tolerance, CarefulSum& careful)
{
  using P = Precision<Real>;
  constexpr Real half_turn = static_cast<Real>(3.14159265358979323846);
  Real sums[triangle_lanes] = {};
  const double at[3] = { point[0], point[1], point[2] };
  for (Index r = 0; r < count; ++r)
  {
    for (Index b = runs[r].first; b < runs[r].first + runs[r].count; ++b)
    {
      const TriangleBlock<Real>& block = blocks[b];
      const Real x = static_cast<Real>((at[0] - block.center[0]) * block.inverse_size);
      const Real y = static_cast<Real>((at[1] - block.center[1]) * block.inverse_size);
      const Real z = static_cast<Real>((at[2] - block.center[2]) * block.inverse_size);
      const Real touching = static_cast<Real>(touch_tolerance * block.inverse_size);
      const Real reach = std::max(P::reach, 20 * touching * touching);
      if (x * x + y * y + z * z > P::apart)
      {
        // From here a sphere of the block's size takes less than an eighth of the view: half a
        // triangle's angle is below 45 degrees, and nothing is near.
        for (int i = 0; i < triangle_lanes; ++i)
        {
          const Real ax = block.corner[0][i] - x;
          const Real ay = block.corner[1][i] - y;
          const Real az = block.corner[2][i] - z;
          const Real bx = block.corner[3][i] - x;
          const Real by = block.corner[4][i] - y;
          const Real bz = block.corner[5][i] - z;
          const Real cx = block.corner[6][i] - x;
          const Real cy = block.corner[7][i] - y;
          const Real cz = block.corner[8][i] - z;
          const Real la = std::sqrt(ax * ax + ay * ay + az * az);
          const Real lb = std::sqrt(bx * bx + by * by + bz * bz);
          const Real lc = std::sqrt(cx * cx + cy * cy + cz * cz);
          const Real re = la * lb * lc + (ax * bx + ay * by + az * bz) * lc +
            (bx * cx + by * cy + bz * cz) * la + (cx * ax + cy * ay + cz * az) * lb;
          const Real im =
            ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
          sums[i] += block.weight[i] * P::arc_tangent(im / re);
        }
        continue;
      }
      typename P::Flag flags[triangle_lanes];
      typename P::Flag any = 0;
      for (int i = 0; i < triangle_lanes; ++i)
      {
        const Real ax = block.corner[0][i] - x;
        const Real ay = block.corner[1][i] - y;
        const Real az = block.corner[2][i] - z;
        const Real bx = block.corner[3][i] - x;
        const Real by = block.corner[4][i] - y;
        const Real bz = block.corner[5][i] - z;
        const Real cx = block.corner[6][i] - x;
        const Real cy = block.corner[7][i] - y;
        const Real cz = block.corner[8][i] - z;
        const Real aa = ax * ax + ay * ay + az * az;
        const Real bb = bx * bx + by * by + bz * bz;
        const Real cc = cx * cx + cy * cy + cz * cz;
        const Real la = std::sqrt(aa), lb = std::sqrt(bb), lc = std::sqrt(cc);
        const Real lengths = la * lb * lc;
        const Real re = lengths + (ax * bx + ay * by + az * bz) * lc +
          (bx * cx + by * cy + bz * cz) * la + (cx * ax + cy * ay + cz * az) * lb;
        const Real im =
          ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
        const Real re_size = std::abs(re), im_size = std::abs(im);
        const Real larger = re_size > im_size ? re_size : im_size;
        const Real smaller = re_size > im_size ? im_size : re_size;
        const Real angle = P::arc_tangent(smaller / larger);
        const Real quarter = re_size > im_size ? angle : Real(0.5) * half_turn - angle;
        const Real half = re < Real(0) ? half_turn - quarter : quarter;
        const Real least = aa < bb ? aa : bb;
        const Real nearest = least < cc ? least : cc;
        const bool far_off = re > Real(0.7) * lengths;
        // The volume with a touching triangle is at most that of a slab of its tolerance.
        const Real slab = 2 * touching * (la * lb + lb * lc + lc * la);
        const bool off_plane = im_size > P::flat * lengths + slab;
        const bool kept =
          (re_size + im_size > P::lost * lengths) & (nearest > reach) & (far_off | off_plane);
        const Real turned = block.weight[i] * (im < Real(0) ? -half : half);
        sums[i] += kept ? turned : Real(0);
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
        careful.add(b, lanes);
      }
    }
  }
  constexpr double two_pi = 6.283185307179586477;
  double total = 0.0;
  for (int i = 0; i < triangle_lanes; ++i)
  {
    total += static_cast<double>(sums[i]);
  }
  return total / two_pi;
}
} // namespace

BINDPOSE_SIMD_CLONES double sum_blocks(const TriangleBlock<float>* blocks, const BlockRun* runs,
  Index count, const Vec3& point, double touch_tolerance, CarefulSum& careful)
{
  return sum(blocks, runs, count, point, touch_tolerance, careful);
}

BINDPOSE_SIMD_CLONES double sum_blocks(const TriangleBlock<double>* blocks, const BlockRun* runs,
  Index count, const Vec3& point, double touch_tolerance, CarefulSum& careful)
{
  return sum(blocks, runs, count, point, touch_tolerance, careful);
}

} // namespace bindpose
