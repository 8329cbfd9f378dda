#include "surfaces.h"

#include <cmath>
#include <map>

namespace bindpose::benchmarks
{

namespace
{
/// Return a bumpy sphere. Its vertices are the two poles and the points of a grid of latitudes and
/// longitudes.
TriangleMesh rings(Index triangles)
{
  const Index across = std::max<Index>(4, std::llround(std::sqrt(0.25 * triangles)));
  const Index around = 2 * across;
  constexpr double pi = 3.14159265358979323846;
  TriangleMesh mesh;
  mesh.points.resize(around * (across - 1) + 2, 3);
  const Index south = around * (across - 1);
  mesh.points.row(south) << 0, 0, -1;
  mesh.points.row(south + 1) << 0, 0, 1;
  mesh.triangles.resize(2 * around * (across - 1), 3);
  Index count = 0;
  for (Index i = 0; i < across - 1; ++i)
  {
    const double latitude = pi * (static_cast<double>(i + 1) / static_cast<double>(across) - 0.5);
    for (Index j = 0; j < around; ++j)
    {
      const double longitude = 2.0 * pi * static_cast<double>(j) / static_cast<double>(around);
      const double bump = 1.0 + 0.1 * std::sin(9.0 * longitude) * std::pow(std::cos(latitude), 2.0);
      mesh.points.row(i * around + j) << bump * std::cos(latitude) * std::cos(longitude),
        bump * std::cos(latitude) * std::sin(longitude), std::sin(latitude);
      const Index next = (j + 1) % around;
      if (i == 0)
      {
        mesh.triangles.row(count++) << south, next, j;
      }
      else
      {
        const Index below = (i - 1) * around;
        const Index here = i * around;
        mesh.triangles.row(count++) << below + j, below + next, here + next;
        mesh.triangles.row(count++) << below + j, here + next, here + j;
      }
      if (i == across - 2)
      {
        mesh.triangles.row(count++) << south + 1, i * around + j, i * around + next;
      }
    }
  }
  return mesh;
}
} // namespace

TriangleMesh bumpy_sphere(Index triangles)
{
  return rings(triangles);
}

TriangleMesh open_bumpy_sphere(Index triangles)
{
  TriangleMesh mesh = rings(triangles);
  Index kept = 0;
  for (Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    if (mesh.points(mesh.triangles(t, 0), 2) < 0.8)
    {
      mesh.triangles.row(kept++) = mesh.triangles.row(t).eval();
    }
  }
  mesh.triangles.conservativeResize(kept, 3);
  return mesh;
}

TriangleMesh patches(Index triangles)
{
  const TriangleMesh whole = rings(triangles);
  // Number of consecutive triangles per patch. Triangles share corners only within a patch.
  constexpr Index patch = 64;
  TriangleMesh mesh;
  std::map<std::pair<Index, Index>, Index> ids;
  std::vector<Vec3> points;
  mesh.triangles.resize(whole.triangles.rows(), 3);
  for (Index t = 0; t < whole.triangles.rows(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Index v = whole.triangles(t, k);
      const auto [entry, fresh] =
        ids.insert({ { t / patch, v }, static_cast<Index>(points.size()) });
      if (fresh)
      {
        points.emplace_back(
          whole.points.row(v) * (1.0 + 1e-4 * static_cast<double>(t / patch % 7)));
      }
      mesh.triangles(t, k) = entry->second;
    }
  }
  mesh.points.resize(static_cast<Index>(points.size()), 3);
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    mesh.points.row(v) = points[v].transpose();
  }
  return mesh;
}

double Random::uniform(double lower, double upper)
{
  this->state_ += 0x9e3779b97f4a7c15ull;
  std::uint64_t z = this->state_;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  z ^= z >> 31;
  return lower + (upper - lower) * (static_cast<double>(z >> 11) * 0x1.0p-53);
}

Points scattered_points(Index count)
{
  Points points(count, 3);
  Random random;
  for (Index i = 0; i < points.size(); ++i)
  {
    points.data()[i] = random.uniform(-1.2, 1.2);
  }
  return points;
}

} // namespace bindpose::benchmarks
