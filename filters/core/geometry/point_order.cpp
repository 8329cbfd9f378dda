// Spatial sort of points. The bounding box of a sample of the points is divided into 16 or 32 cells
// along each axis. The cells are numbered in Morton order. A counting sort distributes the points
// to the cells.
#include "geometry/point_order.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bindpose
{

std::vector<std::int32_t> spatial_sort(const std::vector<Vec3>& points)
{
  // The cells divide the bounding box of every 16th point. Points outside of this box are assigned
  // to the nearest cells.
  Box box;
  constexpr std::size_t sample_stride = 16;
  for (std::size_t i = 0; i < points.size(); i += sample_stride)
  {
    if (points[i].allFinite())
    {
      box.add(points[i]);
    }
  }
  constexpr std::size_t fine_grid_points = 16384;
  const int bits = points.size() < fine_grid_points ? 4 : 5;
  const double cells = std::ldexp(1.0, bits);
  std::array<std::uint32_t, 32> spread_bits{}; // spread_bits[n] is n with bit i moved to bit 3 i
  for (std::uint32_t i = 0; i < spread_bits.size(); ++i)
  {
    for (int bit = 0; bit < 5; ++bit)
    {
      spread_bits[i] |= (i >> bit & 1U) << (3 * bit);
    }
  }
  Vec3 cells_per_length = Vec3::Zero();
  for (int k = 0; k < 3 && !box.empty(); ++k)
  {
    const double size = box.size()[k];
    cells_per_length[k] = size > 0.0 && std::isfinite(cells / size) ? cells / size : 0.0;
  }
  std::vector<std::uint32_t> keys(points.size());
  std::vector<std::int32_t> begin((std::size_t(1) << (3 * bits)) + 1, 0);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    std::uint32_t key = 0;
    for (int k = 0; k < 3; ++k)
    {
      const double at = (points[i][k] - box.lower[k]) * cells_per_length[k];
      const auto cell = static_cast<std::uint32_t>(at > 0.0 ? std::min(at, cells - 1.0) : 0.0);
      key |= spread_bits[cell] << k;
    }
    keys[i] = key;
    begin[key + 1] += 1;
  }
  for (std::size_t c = 1; c < begin.size(); ++c)
  {
    begin[c] += begin[c - 1];
  }
  std::vector<std::int32_t> order(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    order[begin[keys[i]]++] = static_cast<std::int32_t>(i);
  }
  return order;
}

} // namespace bindpose
