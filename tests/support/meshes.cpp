#include "support/meshes.h"

#include "base/constants.h"
#include "geometry/tet_facets.h"

#include <cmath>
#include <map>

namespace bindpose::test
{

namespace
{
Triangles rows(const std::vector<std::array<Index, 3>>& list)
{
  Triangles triangles(static_cast<Index>(list.size()), 3);
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    triangles.row(t) << list[t][0], list[t][1], list[t][2];
  }
  return triangles;
}
} // namespace

TriangleMesh cube(double lower, double upper)
{
  TriangleMesh mesh;
  mesh.points.resize(8, 3);
  for (int v = 0; v < 8; ++v)
  {
    mesh.points.row(v) << (v & 1 ? upper : lower), (v & 2 ? upper : lower), (v & 4 ? upper : lower);
  }
  mesh.triangles = rows({ { 0, 4, 6 }, { 0, 6, 2 }, { 1, 3, 7 }, { 1, 7, 5 }, { 0, 1, 5 },
    { 0, 5, 4 }, { 2, 6, 7 }, { 2, 7, 3 }, { 0, 2, 3 }, { 0, 3, 1 }, { 4, 5, 7 }, { 4, 7, 6 } });
  return mesh;
}

TriangleMesh box(const Vec3& lower, const Vec3& upper)
{
  TriangleMesh mesh = cube(0.0, 1.0);
  for (Index i = 0; i < mesh.points.rows(); ++i)
  {
    const Vec3 p = mesh.points.row(i);
    mesh.points.row(i) = lower + p.cwiseProduct(upper - lower);
  }
  return mesh;
}

TriangleMesh open_cube(double lower, double upper)
{
  TriangleMesh mesh = cube(lower, upper);
  mesh.triangles.conservativeResize(10, 3);
  return mesh;
}

TriangleMesh sphere(int levels, double radius, const Vec3& center)
{
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<Vec3> points{ { -1, g, 0 }, { 1, g, 0 }, { -1, -g, 0 }, { 1, -g, 0 }, { 0, -1, g },
    { 0, 1, g }, { 0, -1, -g }, { 0, 1, -g }, { g, 0, -1 }, { g, 0, 1 }, { -g, 0, -1 },
    { -g, 0, 1 } };
  std::vector<std::array<Index, 3>> list{ { 0, 11, 5 }, { 0, 5, 1 }, { 0, 1, 7 }, { 0, 7, 10 },
    { 0, 10, 11 }, { 1, 5, 9 }, { 5, 11, 4 }, { 11, 10, 2 }, { 10, 7, 6 }, { 7, 1, 8 }, { 3, 9, 4 },
    { 3, 4, 2 }, { 3, 2, 6 }, { 3, 6, 8 }, { 3, 8, 9 }, { 4, 9, 5 }, { 2, 4, 11 }, { 6, 2, 10 },
    { 8, 6, 7 }, { 9, 8, 1 } };
  for (int level = 0; level < levels; ++level)
  {
    std::map<std::pair<Index, Index>, Index> middles;
    const auto middle = [&](Index a, Index b)
    {
      const auto [entry, fresh] =
        middles.insert({ { std::min(a, b), std::max(a, b) }, static_cast<Index>(points.size()) });
      if (fresh)
      {
        points.push_back(0.5 * (points[a] + points[b]));
      }
      return entry->second;
    };
    std::vector<std::array<Index, 3>> finer;
    for (const auto& t : list)
    {
      const Index a = middle(t[0], t[1]);
      const Index b = middle(t[1], t[2]);
      const Index c = middle(t[2], t[0]);
      finer.insert(finer.end(), { { t[0], a, c }, { t[1], b, a }, { t[2], c, b }, { a, b, c } });
    }
    list = std::move(finer);
    for (Vec3& p : points)
    {
      p.normalize();
    }
  }
  TriangleMesh mesh;
  mesh.points.resize(static_cast<Index>(points.size()), 3);
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    mesh.points.row(v) = (center + radius * points[v].normalized()).transpose();
  }
  mesh.triangles = rows(list);
  return mesh;
}

TriangleMesh torus(int major_segments, int minor_segments, double radius, double tube)
{
  TriangleMesh mesh;
  mesh.points.resize(Index(major_segments) * minor_segments, 3);
  std::vector<std::array<Index, 3>> list;
  for (int i = 0; i < major_segments; ++i)
  {
    for (int j = 0; j < minor_segments; ++j)
    {
      const double u = 2.0 * pi * i / major_segments;
      const double v = 2.0 * pi * j / minor_segments;
      const double r = radius + tube * std::cos(v);
      mesh.points.row(Index(i) * minor_segments + j) << r * std::cos(u), r * std::sin(u),
        tube * std::sin(v);
      const Index a = Index(i) * minor_segments + j;
      const Index b = Index((i + 1) % major_segments) * minor_segments + j;
      const Index c = Index((i + 1) % major_segments) * minor_segments + (j + 1) % minor_segments;
      const Index d = Index(i) * minor_segments + (j + 1) % minor_segments;
      list.push_back({ a, b, c });
      list.push_back({ a, c, d });
    }
  }
  mesh.triangles = rows(list);
  return mesh;
}

TriangleMesh grid(int nx, int ny, double sx, double sy)
{
  TriangleMesh mesh;
  mesh.points.resize(Index(nx + 1) * (ny + 1), 3);
  std::vector<std::array<Index, 3>> list;
  const auto id = [&](int i, int j) { return Index(j) * (nx + 1) + i; };
  for (int j = 0; j <= ny; ++j)
  {
    for (int i = 0; i <= nx; ++i)
    {
      mesh.points.row(id(i, j)) << sx * i / nx, sy * j / ny, 0.0;
      if (i < nx && j < ny)
      {
        list.push_back({ id(i, j), id(i + 1, j), id(i + 1, j + 1) });
        list.push_back({ id(i, j), id(i + 1, j + 1), id(i, j + 1) });
      }
    }
  }
  mesh.triangles = rows(list);
  return mesh;
}

TriangleMesh join(const TriangleMesh& a, const TriangleMesh& b)
{
  TriangleMesh mesh;
  mesh.points.resize(a.points.rows() + b.points.rows(), 3);
  mesh.points << a.points, b.points;
  mesh.triangles.resize(a.triangles.rows() + b.triangles.rows(), 3);
  mesh.triangles << a.triangles, (b.triangles.array() + a.points.rows()).matrix();
  return mesh;
}

TriangleMesh translated(TriangleMesh mesh, const Vec3& translation)
{
  mesh.points.rowwise() += translation.transpose();
  return mesh;
}

TriangleMesh flipped(TriangleMesh mesh)
{
  mesh.triangles.col(1).swap(mesh.triangles.col(2));
  return mesh;
}

TriangleMesh unwelded(const TriangleMesh& mesh)
{
  TriangleMesh soup;
  soup.points.resize(mesh.triangles.size(), 3);
  soup.triangles.resize(mesh.triangles.rows(), 3);
  for (Index k = 0; k < mesh.triangles.size(); ++k)
  {
    soup.points.row(k) = mesh.points.row(mesh.triangles.data()[k]);
    soup.triangles.data()[k] = k;
  }
  return soup;
}

TetMesh tet_box(int nx, int ny, int nz, const Vec3& lower, const Vec3& upper)
{
  TetMesh mesh;
  const auto id = [&](int i, int j, int k) { return (Index(k) * (ny + 1) + j) * (nx + 1) + i; };
  mesh.points.resize(Index(nx + 1) * (ny + 1) * (nz + 1), 3);
  std::vector<std::array<Index, 4>> list;
  for (int k = 0; k <= nz; ++k)
  {
    for (int j = 0; j <= ny; ++j)
    {
      for (int i = 0; i <= nx; ++i)
      {
        const Vec3 t(double(i) / nx, double(j) / ny, double(k) / nz);
        mesh.points.row(id(i, j, k)) =
          (lower.array() + t.array() * (upper - lower).array()).matrix();
        if (i == nx || j == ny || k == nz)
        {
          continue;
        }
        // Kuhn's subdivision: a path along the axes leads from one corner of the cell to the
        // opposite corner. Each of the six orders of the axes gives one tet.
        constexpr int orders[6][3] = { { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 }, { 0, 2, 1 },
          { 2, 1, 0 }, { 1, 0, 2 } };
        for (int o = 0; o < 6; ++o)
        {
          int at[3] = { i, j, k };
          std::array<Index, 4> tet{ id(i, j, k), 0, 0, 0 };
          for (int s = 0; s < 3; ++s)
          {
            at[orders[o][s]] += 1;
            tet[s + 1] = id(at[0], at[1], at[2]);
          }
          if (o >= 3)
          {
            std::swap(tet[1], tet[2]);
          }
          list.push_back(tet);
        }
      }
    }
  }
  mesh.tets.resize(static_cast<Index>(list.size()), 4);
  for (Index t = 0; t < mesh.tets.rows(); ++t)
  {
    mesh.tets.row(t) << list[t][0], list[t][1], list[t][2], list[t][3];
  }
  return mesh;
}

double Random::uniform()
{
  // This is the generator splitmix64.
  this->state_ += 0x9e3779b97f4a7c15ull;
  std::uint64_t z = this->state_;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1.0p-53;
}

Vec3 Random::in_box(const Vec3& lower, const Vec3& upper)
{
  const double x = this->uniform(lower.x(), upper.x());
  const double y = this->uniform(lower.y(), upper.y());
  const double z = this->uniform(lower.z(), upper.z());
  return { x, y, z };
}

Points random_points(Index count, double reach, std::uint64_t seed)
{
  Random random(seed);
  Points points(count, 3);
  for (Index i = 0; i < count; ++i)
  {
    points.row(i) = random.in_cube(reach).transpose();
  }
  return points;
}

Index euler_characteristic(const TetMesh& mesh)
{
  const std::vector<TetFacet> facets = tet_facets(mesh.tets);
  Triangles distinct(static_cast<Index>(facets.size()), 3);
  Index count = 0;
  for (std::size_t i = 0; i < facets.size(); ++i)
  {
    if (i == 0 || facets[i].vertices != facets[i - 1].vertices)
    {
      const auto& v = facets[i].vertices;
      distinct.row(count++) << v[0], v[1], v[2];
    }
  }
  distinct.conservativeResize(count, 3);
  const auto edges = static_cast<Index>(mesh_edges(distinct).size());
  return mesh.points.rows() - edges + count - mesh.tets.rows();
}

Index euler_characteristic(const TriangleMesh& mesh)
{
  return mesh.points.rows() - count_edges(mesh.triangles).edges + mesh.triangles.rows();
}

} // namespace bindpose::test
