#include "core/fuzz/hostile_surfaces.h"

#include "support/fuzz.h"

#include <algorithm>
#include <cmath>

namespace bindpose::test
{

namespace
{
/// Return 10^x with x uniformly distributed in [lower, upper].
double power_of_ten(Random& random, double lower, double upper)
{
  return std::pow(10.0, random.uniform(lower, upper));
}

Vec3 lattice_point(Random& random, Index size)
{
  const auto whole = [&] { return static_cast<double>(random.below(size)); };
  return Vec3(whole(), whole(), whole()) / static_cast<double>(size);
}

/// Return triangles between random vertices. Some triangles are repeated or reversed.
template <typename MakePoint>
TriangleMesh random_soup(
  Random& random, Index triangles, Index vertices, const MakePoint& random_point)
{
  TriangleMesh mesh{ Points(vertices, 3), Triangles(triangles, 3) };
  for (Index v = 0; v < vertices; ++v)
  {
    mesh.points.row(v) = random_point().transpose();
  }
  for (Index t = 0; t < triangles; ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      mesh.triangles(t, k) = random.below(vertices);
    }
    if (t > 0 && chance(random, 0.2))
    {
      mesh.triangles.row(t) = mesh.triangles.row(random.below(t)).eval();
      if (chance(random, 0.5))
      {
        std::swap(mesh.triangles(t, 0), mesh.triangles(t, 1));
      }
    }
  }
  return mesh;
}

/// Return separate triangles of sizes from 1 to 1e-6: needles, slivers and degenerate ones.
TriangleMesh random_needles(Random& random, Index triangles)
{
  TriangleMesh mesh{ Points(3 * triangles, 3), Triangles(triangles, 3) };
  for (Index t = 0; t < triangles; ++t)
  {
    const double size = chance(random, 0.5) ? 1.0 : power_of_ten(random, -6.0, 0.0);
    const double thin = chance(random, 0.3) ? 1.0 : power_of_ten(random, -16.0, -1.0);
    const Vec3 a = random.in_cube();
    const Vec3 along = random.in_cube(size);
    const Vec3 across = (chance(random, 0.2) ? 0.0 : thin) * random.in_cube(size);
    mesh.points.row(3 * t) = a.transpose();
    mesh.points.row(3 * t + 1) = (a + along).transpose();
    mesh.points.row(3 * t + 2) = (a + random.uniform(-0.2, 1.2) * along + across).transpose();
    mesh.triangles.row(t) << 3 * t, 3 * t + 1, 3 * t + 2;
  }
  return mesh;
}

/// Return sheets above each other, at distances from 1e-1 to 1e-15, axis-aligned or not.
TriangleMesh layers(Random& random, Index maximum_triangles)
{
  const int n = 1 + static_cast<int>(random.below(6));
  TriangleMesh mesh;
  const bool aligned = chance(random, 0.5);
  const Vec3 up = aligned ? Vec3(0.0, 0.0, 1.0) : random.in_cube();
  while (mesh.triangles.rows() + 2 * n * n <= std::max<Index>(maximum_triangles, 2 * n * n))
  {
    TriangleMesh sheet = translated(grid(n, n), power_of_ten(random, -15.0, -1.0) * up);
    mesh = join(mesh, chance(random, 0.4) ? flipped(sheet) : sheet);
  }
  if (!aligned)
  {
    const Vec3 x = random.in_cube(), y = random.in_cube();
    for (Index v = 0; v < mesh.points.rows(); ++v)
    {
      const Vec3 p = mesh.points.row(v);
      mesh.points.row(v) = (p.x() * x + p.y() * y + p.z() * up).transpose();
    }
  }
  return mesh;
}

/// Return many triangles around one vertex. If `closed` is true, a second vertex closes the fan
/// from the other side.
TriangleMesh random_fan(Random& random, Index triangles, bool closed)
{
  const Index around = std::max<Index>(3, closed ? triangles / 2 : triangles);
  TriangleMesh mesh{ Points(around + 2, 3), Triangles(closed ? 2 * around : around, 3) };
  const double height = chance(random, 0.3) ? power_of_ten(random, -12.0, 0.0) : 1.0;
  for (Index v = 0; v < around; ++v)
  {
    const double angle = 6.283185307179586 * static_cast<double>(v) / static_cast<double>(around);
    const double r = chance(random, 0.1) ? random.uniform(0.1, 2.0) : 1.0;
    mesh.points.row(v) << r * std::cos(angle), r * std::sin(angle), 0.0;
    const Index next = (v + 1) % around;
    mesh.triangles.row(v) << v, next, around;
    if (closed)
    {
      mesh.triangles.row(around + v) << next, v, around + 1;
    }
  }
  mesh.points.row(around) << 0.3, 0.1, height;
  mesh.points.row(around + 1) << -0.2, 0.1, -height;
  return mesh;
}

/// Return the surface of random cubes of a lattice, which touch at edges and vertices.
TriangleMesh random_cubes(Random& random, Index n)
{
  std::vector<char> filled(static_cast<std::size_t>((n + 2) * (n + 2) * (n + 2)), 0);
  const auto at = [n](Index x, Index y, Index z) { return (z * (n + 2) + y) * (n + 2) + x; };
  const double probability = random.uniform(0.1, 0.9);
  for (Index z = 1; z <= n; ++z)
  {
    for (Index y = 1; y <= n; ++y)
    {
      for (Index x = 1; x <= n; ++x)
      {
        filled[at(x, y, z)] = chance(random, probability);
      }
    }
  }
  std::vector<std::array<Index, 3>> triangles;
  for (Index z = 1; z <= n; ++z)
  {
    for (Index y = 1; y <= n; ++y)
    {
      for (Index x = 1; x <= n; ++x)
      {
        for (int side = 0; side < 6 && filled[at(x, y, z)]; ++side)
        {
          const int axis = side / 2;
          const Index up = side % 2;
          std::array<Index, 3> to{ x, y, z };
          to[axis] += up ? 1 : -1;
          if (filled[at(to[0], to[1], to[2])])
          {
            continue;
          }
          std::array<Index, 4> corner;
          for (Index k = 0; k < 4; ++k)
          {
            std::array<Index, 3> c{ x, y, z };
            c[axis] += up;
            c[(axis + 1) % 3] += k == 1 || k == 2;
            c[(axis + 2) % 3] += k >= 2;
            corner[k] = at(c[0], c[1], c[2]);
          }
          if (!up)
          {
            std::swap(corner[1], corner[3]);
          }
          triangles.push_back({ corner[0], corner[1], corner[2] });
          triangles.push_back({ corner[0], corner[2], corner[3] });
        }
      }
    }
  }
  TriangleMesh mesh{ Points(static_cast<Index>(filled.size()), 3),
    Triangles(static_cast<Index>(triangles.size()), 3) };
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    mesh.points.row(v) << static_cast<double>(v % (n + 2)),
      static_cast<double>(v / (n + 2) % (n + 2)), static_cast<double>(v / (n + 2) / (n + 2));
  }
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    mesh.triangles.row(static_cast<Index>(t)) << triangles[t][0], triangles[t][1], triangles[t][2];
  }
  return mesh;
}

/// Return facets of random tets between the given vertices, in either orientation.
template <typename MakePoint>
TriangleMesh tets(Random& random, Index count, Index vertices, const MakePoint& random_point)
{
  TriangleMesh mesh{ Points(vertices, 3), Triangles(4 * count, 3) };
  for (Index v = 0; v < vertices; ++v)
  {
    mesh.points.row(v) = random_point().transpose();
  }
  for (Index t = 0; t < count; ++t)
  {
    const Index a = random.below(vertices), b = random.below(vertices), c = random.below(vertices),
                d = random.below(vertices);
    mesh.triangles.row(4 * t) << a, b, c;
    mesh.triangles.row(4 * t + 1) << a, d, b;
    mesh.triangles.row(4 * t + 2) << b, d, c;
    mesh.triangles.row(4 * t + 3) << a, c, d;
  }
  return mesh;
}

/// Return a sphere or a torus. It may be flattened, have tiny bumps, or have bumps so large that it
/// crosses itself.
TriangleMesh deformed_surface(Random& random, Index maximum_triangles)
{
  int levels = 0;
  while (levels < 5 && 80 << (2 * levels) <= maximum_triangles)
  {
    ++levels;
  }
  const int around =
    std::max(3, static_cast<int>(std::sqrt(static_cast<double>(maximum_triangles))));
  TriangleMesh mesh = chance(random, 0.5)
    ? sphere(static_cast<int>(random.below(levels + 1)))
    : torus(around, std::max(3, around / 2), random.uniform(0.2, 1.0), random.uniform(0.05, 0.6));
  if (chance(random, 0.5))
  {
    const double bump = chance(random, 0.5) ? 0.8 : power_of_ten(random, -12.0, -1.0);
    for (Index v = 0; v < mesh.points.rows(); ++v)
    {
      mesh.points.row(v) += random.in_cube(bump).transpose();
    }
  }
  if (chance(random, 0.25))
  {
    mesh.points.col(random.below(3)) *= power_of_ten(random, -12.0, 0.0);
  }
  if (chance(random, 0.25)) // scale by 1 at x = 1, decreasing to 1e-5 at x = -1
  {
    for (Index v = 0; v < mesh.points.rows(); ++v)
    {
      const Vec3 p = mesh.points.row(v);
      mesh.points.row(v) *= std::pow(10.0, -2.5 + 2.5 * std::clamp(p.x(), -1.0, 1.0));
    }
  }
  return mesh;
}

/// Add typical defects to a surface: holes, reversed and repeated triangles, seams.
void add_defects(Random& random, TriangleMesh& mesh)
{
  const double probability = random.uniform(0.0, 0.3);
  std::vector<std::array<Index, 3>> kept;
  std::vector<Vec3> more;
  for (Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    std::array<Index, 3> ids{ mesh.triangles(t, 0), mesh.triangles(t, 1), mesh.triangles(t, 2) };
    const Index what = chance(random, probability) ? random.below(5) : 5;
    if (what == 0)
    {
      continue;
    }
    if (what == 1)
    {
      std::swap(ids[0], ids[1]);
    }
    if (what == 2)
    {
      kept.push_back(ids);
    }
    if (what == 3) // replace a corner by a separate vertex at or near its position
    {
      Vec3 corner = mesh.points.row(ids[0]);
      if (chance(random, 0.5))
      {
        corner += power_of_ten(random, -15.0, -3.0) * random.in_cube();
      }
      ids[0] = mesh.points.rows() + static_cast<Index>(more.size());
      more.push_back(corner);
    }
    kept.push_back(ids);
  }
  if (kept.empty())
  {
    return;
  }
  const Index before = mesh.points.rows();
  mesh.points.conservativeResize(before + static_cast<Index>(more.size()), 3);
  for (std::size_t i = 0; i < more.size(); ++i)
  {
    mesh.points.row(before + static_cast<Index>(i)) = more[i].transpose();
  }
  mesh.triangles.resize(static_cast<Index>(kept.size()), 3);
  for (std::size_t t = 0; t < kept.size(); ++t)
  {
    mesh.triangles.row(static_cast<Index>(t)) << kept[t][0], kept[t][1], kept[t][2];
  }
}
Vec3 any_point(Random& random, const TriangleMesh& mesh)
{
  const Box box = bounding_box(mesh.points, mesh.triangles);
  const double size = box.size().maxCoeff();
  const Index t = random.below(mesh.triangles.rows());
  const auto corner = [&](int k) { return Vec3(mesh.points.row(mesh.triangles(t, k))); };
  const auto any_vertex = [&]
  {
    return Vec3(
      mesh.points.row(mesh.triangles(random.below(mesh.triangles.rows()), int(random.below(3)))));
  };
  const Vec3 a = corner(0);
  const Vec3 u = corner(1) - a;
  const Vec3 v = corner(2) - a;
  const double s =
    chance(random, 0.5) ? 0.125 * static_cast<double>(random.below(9)) : random.uniform();
  const double r = s * (chance(random, 0.5) ? 0.5 : random.uniform());
  const Vec3 on_face = a + (s - r) * u + r * v;
  switch (random.below(14))
  {
    case 0:
      return a;
    case 1:
      return a + s * u;
    case 2:
      return on_face;
    case 3: // in the plane of the triangle, anywhere
      return a + random.uniform(-2.0, 3.0) * u + random.uniform(-2.0, 3.0) * v;
    case 4:
    case 5: // on an axis-parallel line through a vertex
    {
      Vec3 p = any_vertex();
      const Vec3 other = any_vertex();
      const Index axis = random.below(3);
      p[axis] =
        chance(random, 0.5) ? other[axis] : box.center()[axis] + size * random.uniform(-1.5, 1.5);
      return p;
    }
    case 6: // x, y and z from three vertices
      return Vec3(any_vertex().x(), any_vertex().y(), any_vertex().z());
    case 7:
    case 8: // near a face, edge or vertex
    {
      const Vec3 foot = chance(random, 0.4) ? on_face : chance(random, 0.5) ? Vec3(a + s * u) : a;
      return foot + size * power_of_ten(random, -16.5, -3.0) * random.in_cube();
    }
    case 9: // above a face, at about the tolerance for touching it
    {
      const Vec3 normal = u.cross(v).stableNormalized();
      const double largest =
        std::max(box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff());
      return on_face + std::ldexp(largest, -49) * random.uniform(-2.0, 2.0) * normal;
    }
    case 10: // on the line of an edge
      return a +
        (chance(random, 0.5) ? power_of_ten(random, 0.0, 12.0)
                             : -power_of_ten(random, -12.0, 3.0)) *
        u;
    case 11: // far away
      return box.center() +
        power_of_ten(random, 0.0, chance(random, 0.8) ? 4.0 : 30.0) * random.in_cube(size);
    default:
      return box.center() + random.in_cube(0.8 * size);
  }
}
} // namespace

TriangleMesh hostile_closed_surface(Random& random, Index maximum_triangles)
{
  switch (random.below(6))
  {
    case 0:
      return random_cubes(
        random, std::max<Index>(1, static_cast<Index>(std::cbrt(maximum_triangles / 4.0))));
    case 1:
    {
      const Index size = 2 + random.below(9);
      return tets(random, 1 + maximum_triangles / 4, 4 + random.below(maximum_triangles),
        [&] { return lattice_point(random, size); });
    }
    case 2:
    {
      const double size = chance(random, 0.5) ? 1.0 : power_of_ten(random, -6.0, 0.0);
      return tets(random, 1 + maximum_triangles / 4, 4 + random.below(maximum_triangles),
        [&] { return Vec3(random.in_cube(chance(random, 0.5) ? 1.0 : size)); });
    }
    case 3:
      return random_fan(random, maximum_triangles, true);
    default:
    {
      TriangleMesh mesh = deformed_surface(random, maximum_triangles);
      while (chance(random, 0.6) && mesh.triangles.rows() < maximum_triangles)
      {
        TriangleMesh part =
          deformed_surface(random, std::max<Index>(20, maximum_triangles - mesh.triangles.rows()));
        part.points *= chance(random, 0.5) ? 1.0 : power_of_ten(random, -5.0, 0.0);
        part = translated(part, random.in_cube(chance(random, 0.3) ? 0.0 : 1.0));
        mesh = join(mesh, chance(random, 0.3) ? flipped(part) : part);
      }
      return mesh;
    }
  }
}

TriangleMesh hostile_surface(Random& random, Index maximum_triangles)
{
  const Index few = 1 + random.below(chance(random, 0.5) ? 12 : maximum_triangles);
  switch (random.below(7))
  {
    case 0:
    {
      const Index size = 2 + random.below(7);
      return random_soup(
        random, few, 3 + random.below(few + 3), [&] { return lattice_point(random, size); });
    }
    case 1:
      return random_soup(random, few, 3 + random.below(few + 3), [&] { return random.in_cube(); });
    case 2:
      return random_needles(random, few);
    case 3:
      return layers(random, few);
    case 4:
      return random_fan(random, few, false);
    case 5:
      return random_soup(random, 1 + random.below(2), 3 + random.below(3),
        [&] { return chance(random, 0.5) ? lattice_point(random, 4) : random.in_cube(); });
    default:
    {
      TriangleMesh mesh = hostile_closed_surface(random, few);
      if (mesh.triangles.rows() == 0)
      {
        return cube();
      }
      add_defects(random, mesh);
      return mesh;
    }
  }
}

TriangleMesh randomly_transformed(Random& random, TriangleMesh mesh)
{
  const double size = bounding_box(mesh.points, mesh.triangles).diagonal();
  switch (random.below(10))
  {
    case 0:
      mesh.points *= std::ldexp(1.0, chance(random, 0.5) ? 60 : -60);
      break;
    case 1:
      mesh.points *= power_of_ten(random, -30.0, 30.0);
      break;
    case 2: // coordinates near the limits of the range of double
    {
      const int top = 1023 - std::ilogb(mesh.points.cwiseAbs().maxCoeff() + 1.0);
      mesh.points *= chance(random, 0.5)
        ? std::ldexp(1.0, top - static_cast<int>(random.below(9)))
        : std::ldexp(1.0, -1000 - static_cast<int>(random.below(70)));
      break;
    }
    case 3:
    case 4:
    {
      const double exponent = chance(random, 0.7) ? 6.0 : 14.0;
      Vec3 off = size * power_of_ten(random, 0.0, exponent) * random.in_cube();
      off = chance(random, 0.3) ? Vec3(off.x(), 0.0, 0.0) : off;
      mesh = translated(mesh, off);
      break;
    }
    default:
      break;
  }
  return mesh;
}

Vec3 hostile_point(Random& random, const TriangleMesh& mesh)
{
  for (;;)
  {
    const Vec3 p = any_point(random, mesh);
    if (p.allFinite()) // all points must be in the range of double
    {
      return p;
    }
  }
}

} // namespace bindpose::test
