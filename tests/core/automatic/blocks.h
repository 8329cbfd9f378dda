#ifndef bindpose_tests_core_automatic_blocks_h
#define bindpose_tests_core_automatic_blocks_h

// Shapes with known limbs: the outer boundary of a union of unit cubes, as a clean surface.

#include "geometry/mesh.h"

#include <array>
#include <map>
#include <set>
#include <vector>

namespace bindpose::test
{

using Block = std::array<int, 3>;

/// Return the boundary of the cubes [i, i+1] x [j, j+1] x [k, k+1], oriented outwards, with two
/// triangles per face of a cube. The surface is clean if any two cubes that share only an edge have
/// a common neighbor.
inline TriangleMesh blocks(const std::set<Block>& cubes)
{
  std::map<Block, Index> ids;
  std::vector<std::array<Index, 3>> triangles;
  const auto vertex = [&](const Block& p)
  { return ids.emplace(p, static_cast<Index>(ids.size())).first->second; };
  for (const Block& cube : cubes)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      for (const int side : { 0, 1 })
      {
        Block other = cube;
        other[axis] += side == 1 ? 1 : -1;
        if (cubes.count(other) > 0)
        {
          continue;
        }
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        Block corner = cube;
        corner[axis] += side;
        std::array<Index, 4> square{};
        for (int k = 0; k < 4; ++k)
        {
          Block p = corner;
          p[u] += k == 1 || k == 2 ? 1 : 0;
          p[v] += k >= 2 ? 1 : 0;
          square[side == 1 ? k : 3 - k] = vertex(p);
        }
        triangles.push_back({ square[0], square[1], square[2] });
        triangles.push_back({ square[0], square[2], square[3] });
      }
    }
  }
  TriangleMesh mesh;
  mesh.points.resize(static_cast<Index>(ids.size()), 3);
  mesh.triangles.resize(static_cast<Index>(triangles.size()), 3);
  for (const auto& [p, id] : ids)
  {
    mesh.points.row(id) << p[0], p[1], p[2];
  }
  for (std::size_t f = 0; f < triangles.size(); ++f)
  {
    mesh.triangles.row(static_cast<Index>(f)) << triangles[f][0], triangles[f][1], triangles[f][2];
  }
  return mesh;
}

/// Return a cube at the origin with one straight arm of `length` cubes in each of the given
/// directions.
inline TriangleMesh star(const std::vector<Block>& directions, int length)
{
  std::set<Block> cubes{ { 0, 0, 0 } };
  for (const Block& d : directions)
  {
    for (int i = 1; i <= length; ++i)
    {
      cubes.insert({ i * d[0], i * d[1], i * d[2] });
    }
  }
  return blocks(cubes);
}

} // namespace bindpose::test

#endif
