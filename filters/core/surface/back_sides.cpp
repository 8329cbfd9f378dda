// Search for doubled triangles (see back_sides.h).
#include "surface/back_sides.h"

#include "surface/oriented_patches.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace bindpose
{

namespace
{
/// Largest norm of the sum of the area vectors of a closed patch, relative to the patch's area.
constexpr double maximum_opening = 0.25;

/// All triangles of the surface with the same three corners a < b < c. They are called the copies
/// of one triangle. Half of them have the orientation a, b, c, the others a, c, b.
struct Copies
{
  Index forward = -1; ///< id of the first copy with the orientation a, b, c
  Index backward = -1; ///< id of the first copy with the orientation a, c, b
  std::vector<Index> all; ///< ids of all copies
};

/// The triangles whose copies cancel (see back_sides()), sorted by corners. There is one entry per
/// triangle, not one per copy.
struct CancelingTriangles
{
  std::vector<Copies> copies;
  Triangles triangles; ///< corners a, b, c of each triangle, ascending
};

CancelingTriangles find_canceling(TrianglesView triangles)
{
  struct Item
  {
    std::array<Index, 3> key; ///< corners a, b, c, ascending
    Index triangle;
    bool forward; ///< whether the orientation of the triangle is a, b, c (not a, c, b)
  };
  std::vector<Item> items;
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    std::array<Index, 3> corners{ triangles(t, 0), triangles(t, 1), triangles(t, 2) };
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    const bool forward = corners[1] < corners[2];
    if (!forward)
    {
      std::swap(corners[1], corners[2]);
    }
    items.push_back({ corners, t, forward });
  }
  std::sort(items.begin(), items.end(),
    [](const Item& a, const Item& b)
    { return a.key != b.key ? a.key < b.key : a.triangle < b.triangle; });
  CancelingTriangles result;
  std::vector<std::array<Index, 3>> keys;
  for (std::size_t i = 0, j = 0; i < items.size(); i = j)
  {
    Copies copies;
    int sum = 0;
    for (j = i; j < items.size() && items[j].key == items[i].key; ++j)
    {
      Index& first = items[j].forward ? copies.forward : copies.backward;
      first = first < 0 ? items[j].triangle : first;
      copies.all.push_back(items[j].triangle);
      sum += items[j].forward ? 1 : -1;
    }
    if (sum == 0)
    {
      result.copies.push_back(std::move(copies));
      keys.push_back(items[i].key);
    }
  }
  result.triangles.resize(static_cast<Index>(keys.size()), 3);
  for (std::size_t i = 0; i < keys.size(); ++i)
  {
    result.triangles.row(static_cast<Index>(i)) << keys[i][0], keys[i][1], keys[i][2];
  }
  return result;
}
} // namespace

std::vector<Index> back_sides(PointsView points, TrianglesView triangles)
{
  const CancelingTriangles canceling = find_canceling(triangles);
  std::vector<Index> backs;
  for (const OrientedPatch& patch : oriented_patches(canceling.triangles))
  {
    double area = 0.0, volume = 0.0;
    Vec3 sum = Vec3::Zero();
    const Vec3 origin = points.row(canceling.triangles(patch.triangles[0], 0));
    for (std::size_t i = 0; i < patch.triangles.size(); ++i)
    {
      const auto corner = [&](int k) -> Vec3
      { return points.row(canceling.triangles(patch.triangles[i], k)).transpose() - origin; };
      const double orientation_sign = patch.flipped[i] ? -1.0 : 1.0;
      const Vec3 normal = 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0));
      area += normal.norm();
      sum += orientation_sign * normal;
      volume += orientation_sign * corner(0).dot(normal) / 3.0;
    }
    if (!patch.orientable || sum.norm() > maximum_opening * area)
    {
      continue;
    }
    for (std::size_t i = 0; i < patch.triangles.size(); ++i)
    {
      const Copies& copies = canceling.copies[patch.triangles[i]];
      const bool forward = (patch.flipped[i] == 0) == (volume >= 0.0);
      const Index kept = forward ? copies.forward : copies.backward;
      std::copy_if(copies.all.begin(), copies.all.end(), std::back_inserter(backs),
        [&](Index copy) { return copy != kept; });
    }
  }
  std::sort(backs.begin(), backs.end());
  return backs;
}

} // namespace bindpose
