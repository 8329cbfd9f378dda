// Closed surfaces of a given resolution around thin or open triangles. The winding number and a
// layer around thin parts define a region. Isosurface stuffing computes tets of this region. The
// result is the boundary of the tets.
#include "inside/thick_solid.h"

#include "base/parallel.h"
#include "inside/lattice_tets.h"
#include "surface/triangle_tree.h"
#include "tets/manifold_boundary.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
/// Return the number of lattice cubes along the longest side for which a surface of this area gives
/// about `triangles` triangles.
Index resolution_for(const Box& box, double area, Index triangles)
{
  // Number of triangles that isosurface stuffing creates per unit of surface area. The unit is the
  // area of a cube face. The value was measured on a sphere.
  constexpr double triangles_per_face = 3.8;
  constexpr double minimum_resolution = 16.0;
  constexpr double maximum_resolution = 400.0;
  constexpr double maximum_cubes = 2e6;
  const double longest = box.size().maxCoeff();
  const double spacing = std::sqrt(triangles_per_face * area / static_cast<double>(triangles));
  double resolution = std::clamp(
    spacing > 0.0 ? longest / spacing : maximum_resolution, minimum_resolution, maximum_resolution);
  // The margin of the lattice is two cubes on every side.
  constexpr double margin = 4.0;
  const auto cubes = [&] { return (box.size().array() / longest * resolution + margin).prod(); };
  while (resolution > minimum_resolution && cubes() > maximum_cubes)
  {
    resolution *= 0.9;
  }
  return static_cast<Index>(std::lround(std::max(resolution, minimum_resolution)));
}

/// Return the triangles that are too far from the lattice vertices flagged in `inside`. The test
/// points of a triangle are at most half a cube apart. A triangle is returned if, for one of its
/// test points, neither the center nor a corner of the cube around the point is flagged.
Triangles missed_triangles(PointsView points, TrianglesView triangles, const Lattice& lattice,
  const std::vector<char>& inside)
{
  const Index nx = lattice.cubes[0];
  const Index ny = lattice.cubes[1];
  const Index corners = (nx + 1) * (ny + 1) * (lattice.cubes[2] + 1);
  const auto reaches_lattice = [&](const Vec3& p)
  {
    std::array<Index, 3> at{};
    for (int axis = 0; axis < 3; ++axis)
    {
      const double cube = std::floor((p[axis] - lattice.origin[axis]) / lattice.spacing);
      at[axis] = std::clamp<Index>(static_cast<Index>(cube), 0, lattice.cubes[axis] - 1);
    }
    bool is_inside_cube = inside[corners + (at[2] * ny + at[1]) * nx + at[0]] != 0;
    for (int corner = 0; corner < 8 && !is_inside_cube; ++corner)
    {
      const Index x = at[0] + (corner & 1);
      const Index y = at[1] + (corner >> 1 & 1);
      const Index z = at[2] + (corner >> 2 & 1);
      is_inside_cube = inside[(z * (ny + 1) + y) * (nx + 1) + x] != 0;
    }
    return is_inside_cube;
  };
  std::vector<Index> unreached_triangles;
  for (Index f = 0; f < triangles.rows(); ++f)
  {
    const Vec3 a = points.row(triangles(f, 0));
    const Vec3 b = points.row(triangles(f, 1));
    const Vec3 c = points.row(triangles(f, 2));
    const double longest = std::max({ (b - a).norm(), (c - b).norm(), (a - c).norm() });
    const auto steps = static_cast<Index>(std::ceil(2.0 * longest / lattice.spacing)) + 1;
    bool all_reached = true;
    for (Index i = 0; i <= steps && all_reached; ++i)
    {
      for (Index j = 0; i + j <= steps && all_reached; ++j)
      {
        const double u = static_cast<double>(i) / static_cast<double>(steps);
        const double v = static_cast<double>(j) / static_cast<double>(steps);
        all_reached = reaches_lattice(a + u * (b - a) + v * (c - a));
      }
    }
    if (!all_reached)
    {
      unreached_triangles.push_back(f);
    }
  }
  Triangles result(static_cast<Index>(unreached_triangles.size()), 3);
  for (std::size_t i = 0; i < unreached_triangles.size(); ++i)
  {
    result.row(static_cast<Index>(i)) = triangles.row(unreached_triangles[i]);
  }
  return result;
}
} // namespace

Status thick_solid(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const WindingNumber& winding, const ThickSolidOptions& options, TriangleMesh& solid)
{
  solid = TriangleMesh();
  const Box box = bounding_box(points, triangles);
  const Index resolution = resolution_for(box, surface_area(points, triangles), options.triangles);
  const Lattice lattice = Lattice::around(box, resolution);
  const double threshold = options.winding_threshold;
  const Points vertices = lattice_points(lattice);
  LatticeRegion region;
  Status status;
  {
    const Phase phase(context, "sample", 0.0, 0.4);
    Eigen::VectorXd w;
    status = sample_lattice(context, winding, lattice, w);
    if (!status.ok())
    {
      return status;
    }
    region.inside.resize(static_cast<std::size_t>(w.size()));
    for (Index v = 0; v < w.size(); ++v)
    {
      region.inside[v] = w[v] >= threshold ? 1 : 0;
    }
  }
  // Every point is within 0.559 cubes of a lattice vertex. Therefore a layer of this thickness has
  // no gaps.
  constexpr double layer = 0.6;
  const double thickness = layer * lattice.spacing;
  const Triangles thickened = options.join_near_parts
    ? Triangles(triangles)
    : missed_triangles(points, triangles, lattice, region.inside);
  const TriangleTree tree(points, thickened);
  const auto is_in_layer = [&](const Vec3& p) { return tree.is_within(p, thickness); };
  {
    const Phase phase(context, "distance", 0.4, 0.6);
    constexpr Index block = 256;
    const bool completed = parallel_for(context, vertices.rows(), block,
      [&](Index begin, Index end)
      {
        for (Index v = begin; v < end; ++v)
        {
          region.inside[v] = region.inside[v] || is_in_layer(vertices.row(v)) ? 1 : 0;
        }
      });
    if (!completed)
    {
      return Status::canceled();
    }
  }
  region.contains = [&](Index v, Index u, double t)
  {
    const Vec3 start = vertices.row(v);
    const Vec3 end = vertices.row(u);
    const Vec3 p = start + t * (end - start);
    return is_in_layer(p) || winding.evaluate_at(p) >= threshold;
  };
  region.bisections = 4;
  const ProgressRange range(context, 0.6, 1.0);
  TetMesh tets;
  status = stuff_lattice(context, lattice, region, tets);
  if (!status.ok())
  {
    return status;
  }
  solid = manifold_boundary(tets);
  status.report.set("resolution", resolution);
  status.report.set("counts.thickened_triangles", thickened.rows());
  return status;
}

} // namespace bindpose
