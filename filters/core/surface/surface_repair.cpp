// Diagnosis and repair of a surface (see surface_repair.h): weld vertices, remove degenerate
// triangles, count defects, orient.
//
// Orientation is repaired in two stages. The first stage works on patches, which are sets of
// triangles connected by edges with exactly two triangles. A traversal of these edges divides the
// triangles of a patch into two classes of opposite orientation, and the class with the smaller
// area is flipped. The second stage works on whole shells: components, or patches that are closed
// by themselves (solids that touch in an edge or a vertex). A closed shell with negative volume
// that is in no other closed shell is inside out. Such a shell is flipped together with all closed
// shells inside it. A cavity (an inner shell whose orientation is opposite to that of the outer
// shell) therefore remains a cavity.
#include "surface/surface_repair.h"

#include "base/constants.h"
#include "base/disjoint_sets.h"
#include "geometry/triangle_sides.h"
#include "surface/oriented_patches.h"
#include "surface/triangle_predicates.h"
#include "surface/triangle_tree.h"
#include "surface/vertex_order.h"
#include "winding/winding_number.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bindpose
{

namespace
{
using Key = std::array<Index, 3>;

Key sorted_key(TrianglesView triangles, Index t)
{
  Key key{ triangles(t, 0), triangles(t, 1), triangles(t, 2) };
  std::sort(key.begin(), key.end());
  return key;
}

void snap_points(Points& points, const std::vector<char>& used, double fraction)
{
  Box box;
  for (Index v = 0; v < points.rows(); ++v)
  {
    if (used[v])
    {
      box.add(points.row(v));
    }
  }
  if (box.diagonal() <= 0.0)
  {
    return;
  }
  const double step = std::exp2(std::round(std::log2(fraction * box.diagonal())));
  for (Index v = 0; v < points.rows(); ++v)
  {
    for (int k = 0; k < 3; ++k)
    {
      points(v, k) = std::round(points(v, k) / step) * step;
    }
  }
}

bool is_flat(const Points& points, const Triangles& triangles)
{
  if (triangles.rows() == 0)
  {
    return true;
  }
  const Vec3 a = points.row(triangles(0, 0));
  const Vec3 b = points.row(triangles(0, 1));
  const Vec3 c = points.row(triangles(0, 2));
  for (Index v = 0; v < points.rows(); ++v)
  {
    if (orientation_3d(a, b, c, points.row(v)) != 0)
    {
      return false;
    }
  }
  return true;
}

double area(const Points& points, const Triangles& triangles, Index t)
{
  const Vec3 a = points.row(triangles(t, 0));
  const Vec3 b = points.row(triangles(t, 1));
  const Vec3 c = points.row(triangles(t, 2));
  return 0.5 * (b - a).cross(c - a).norm();
}

/// In every patch with inconsistent orientations, flip the triangles of the orientation with the
/// smaller area.
/// @return the number of flipped triangles.
Index orient_patches(const Points& points, Triangles& triangles)
{
  Index flipped = 0;
  for (const OrientedPatch& patch : oriented_patches(triangles))
  {
    if (!patch.orientable)
    {
      continue; // no consistent orientation exists
    }
    double areas[2] = { 0.0, 0.0 };
    for (std::size_t i = 0; i < patch.triangles.size(); ++i)
    {
      areas[patch.flipped[i]] += area(points, triangles, patch.triangles[i]);
    }
    const int minority = areas[1] <= areas[0] ? 1 : 0;
    for (std::size_t i = 0; i < patch.triangles.size(); ++i)
    {
      if (patch.flipped[i] == minority)
      {
        std::swap(triangles(patch.triangles[i], 1), triangles(patch.triangles[i], 2));
        ++flipped;
      }
    }
  }
  return flipped;
}

struct Shell
{
  std::vector<Index> triangles;
  Box box;
  double volume = 0.0;
  bool closed = true;
};

/// Return the patch of each triangle, #F. The id of a patch is one of its triangle ids.
std::vector<Index> patches_of(const std::vector<TriangleSide>& sides, Index triangle_count)
{
  DisjointSets<Index> sets(static_cast<std::size_t>(triangle_count));
  for (std::size_t i = 0, j = 0; i < sides.size(); i = j)
  {
    j = end_of_edge(sides, i);
    if (j == i + 2)
    {
      sets.unite(sides[i].triangle, sides[i + 1].triangle);
    }
  }
  std::vector<Index> patch(static_cast<std::size_t>(triangle_count));
  for (Index t = 0; t < triangle_count; ++t)
  {
    patch[t] = sets.find(t);
  }
  return patch;
}

/// Divide the triangles into shells. Each closed patch is a shell of its own, so that solids that
/// touch in edges or vertices are separate shells. The other triangles of each component form one
/// shell, which may be empty. The shells of the components come first in the result.
/// @param shell_of set to the index of each triangle's shell, #F.
/// @return the shells.
std::vector<Shell> find_shells(
  const Triangles& triangles, const Components& components, std::vector<Index>& shell_of)
{
  const std::vector<TriangleSide> sides = sides_by_edge(triangles);
  const std::vector<Index> patch = patches_of(sides, triangles.rows());
  // Test whether each group (a patch or shell) is closed. A group is closed if, at every edge, as
  // many triangles of the group use the edge in one direction as in the other.
  const auto close = [&](const auto& group_of, std::vector<char>& closed)
  {
    std::vector<std::pair<Index, int>> directions;
    for (std::size_t i = 0, j = 0; i < sides.size(); i = j)
    {
      j = end_of_edge(sides, i);
      directions.clear();
      for (std::size_t k = i; k < j; ++k)
      {
        directions.emplace_back(group_of(sides[k].triangle), sides[k].forward ? 1 : -1);
      }
      std::sort(directions.begin(), directions.end());
      for (std::size_t k = 0, l = 0; k < directions.size(); k = l)
      {
        int sum = 0;
        for (l = k; l < directions.size() && directions[l].first == directions[k].first; ++l)
        {
          sum += directions[l].second;
        }
        closed[directions[k].first] = closed[directions[k].first] && sum == 0;
      }
    }
  };
  std::vector<char> closed_patch(patch.size(), 1);
  close([&](Index t) { return patch[t]; }, closed_patch);
  std::vector<Shell> shells(static_cast<std::size_t>(components.count));
  std::vector<Index> shell_of_patch(patch.size(), -1);
  shell_of.resize(patch.size());
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    Index& shell = shell_of_patch[patch[t]];
    if (!closed_patch[patch[t]])
    {
      shell = components.component_of_vertex[triangles(t, 0)];
    }
    else if (shell < 0)
    {
      shell = static_cast<Index>(shells.size());
      shells.emplace_back();
    }
    shell_of[t] = shell;
  }
  std::vector<char> closed(shells.size(), 1);
  close([&](Index t) { return shell_of[t]; }, closed);
  for (std::size_t s = 0; s < shells.size(); ++s)
  {
    shells[s].closed = closed[s];
  }
  return shells;
}

std::vector<Shell> shells_of(
  const Points& points, const Triangles& triangles, const Components& components)
{
  std::vector<Index> shell_of;
  std::vector<Shell> shells = find_shells(triangles, components, shell_of);
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    Shell& shell = shells[shell_of[t]];
    shell.triangles.push_back(t);
    for (int k = 0; k < 3; ++k)
    {
      shell.box.add(points.row(triangles(t, k)));
    }
  }
  for (Shell& shell : shells)
  {
    const Vec3 c = shell.box.center();
    for (const Index t : shell.triangles)
    {
      shell.volume += tet_volume(
        c, points.row(triangles(t, 0)), points.row(triangles(t, 1)), points.row(triangles(t, 2)));
    }
  }
  return shells;
}

/// Return the winding number of one closed shell at a point, as a direct sum of solid angles.
double winding_of_shell(
  const Points& points, const Triangles& triangles, const Shell& shell, const Vec3& p)
{
  double half_angles = 0.0;
  for (const Index t : shell.triangles)
  {
    const Vec3 a = points.row(triangles(t, 0)).transpose() - p;
    const Vec3 b = points.row(triangles(t, 1)).transpose() - p;
    const Vec3 c = points.row(triangles(t, 2)).transpose() - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    half_angles +=
      std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return half_angles / two_pi;
}

/// Return test points of a shell: the centers of some of its triangles. The shell counts as inside
/// another shell if most of these points are inside the other shell. Several points are needed
/// because winding numbers are not integers where shells touch.
std::vector<Vec3> test_points_of(
  const Points& points, const Triangles& triangles, const Shell& shell)
{
  constexpr std::size_t test_points = 5;
  const std::size_t step = (shell.triangles.size() + test_points - 1) / test_points;
  std::vector<Vec3> centers;
  for (std::size_t i = 0; i < shell.triangles.size(); i += step)
  {
    const auto t = triangles.row(shell.triangles[i]);
    centers.emplace_back((points.row(t[0]) + points.row(t[1]) + points.row(t[2])) / 3.0);
  }
  return centers;
}

/// Compute the winding numbers of one closed shell at some points: by direct sums if the number of
/// points times the number of triangles is small, else by counting crossings. Return false if
/// canceled.
bool winding_numbers(ExecutionContext& context, const Points& points, const Triangles& triangles,
  const Shell& shell, const std::vector<Vec3>& query_points, Eigen::VectorXd& windings)
{
  constexpr std::size_t maximum_direct_angles = 100000;
  windings.resize(static_cast<Index>(query_points.size()));
  if (query_points.size() * shell.triangles.size() <= maximum_direct_angles)
  {
    for (std::size_t i = 0; i < query_points.size(); ++i)
    {
      windings[static_cast<Index>(i)] = winding_of_shell(points, triangles, shell, query_points[i]);
    }
    return !context.canceled();
  }
  // Copy only the shell's triangles and their vertices, because the surface may have many more.
  std::vector<Index> vertices;
  for (const Index t : shell.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      vertices.push_back(triangles(t, k));
    }
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  Points own_points(static_cast<Index>(vertices.size()), 3);
  for (std::size_t v = 0; v < vertices.size(); ++v)
  {
    own_points.row(static_cast<Index>(v)) = points.row(vertices[v]);
  }
  Triangles shell_triangles(static_cast<Index>(shell.triangles.size()), 3);
  for (Index t = 0; t < shell_triangles.rows(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      shell_triangles(t, k) =
        std::lower_bound(vertices.begin(), vertices.end(), triangles(shell.triangles[t], k)) -
        vertices.begin();
    }
  }
  Points queries(windings.size(), 3);
  for (Index i = 0; i < queries.rows(); ++i)
  {
    queries.row(i) = query_points[i].transpose();
  }
  ExecutionContext silent_context({}, [&context] { return context.canceled(); });
  silent_context.set_threads(context.threads());
  WindingNumber::Options options;
  options.method = WindingMethod::exact;
  options.expected_queries = queries.rows();
  WindingNumber winding;
  Status status = winding.build(silent_context, own_points, shell_triangles, options);
  status = status.ok() ? winding.evaluate(silent_context, queries, windings.data()) : status;
  return status.ok();
}

/// Finds the shells whose boxes are inside a given box. The boxes are stored in a k-d tree of their
/// lower corners.
class BoxFinder
{
public:
  /// The argument `boxes` must outlive this object; `shell_ids` contains the indices of the shells
  /// to search.
  BoxFinder(const std::vector<Shell>& boxes, std::vector<Index> shell_ids)
    : boxes_(boxes), ids_(std::move(shell_ids))
  {
    this->sort(0, this->ids_.size(), 0);
  }
  /// Call found(id) for each shell whose box is inside the given box, in no particular order.
  template <typename Visit>
  void find(const Box& box, const Visit& found) const
  {
    this->find(box, found, 0, this->ids_.size(), 0);
  }

private:
  const Box& box(std::size_t i) const { return this->boxes_[this->ids_[i]].box; }

  void sort(std::size_t begin, std::size_t end, int axis)
  {
    if (end - begin < 2)
    {
      return;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    const auto first = this->ids_.begin();
    std::nth_element(first + static_cast<std::ptrdiff_t>(begin),
      first + static_cast<std::ptrdiff_t>(middle), first + static_cast<std::ptrdiff_t>(end),
      [&](Index s, Index t)
      { return this->boxes_[s].box.lower[axis] < this->boxes_[t].box.lower[axis]; });
    this->sort(begin, middle, (axis + 1) % 3);
    this->sort(middle + 1, end, (axis + 1) % 3);
  }

  template <typename Visit>
  void find(
    const Box& outer, const Visit& found, std::size_t begin, std::size_t end, int axis) const
  {
    if (begin >= end)
    {
      return;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    const Box& inner = this->box(middle);
    if ((outer.lower.array() <= inner.lower.array()).all() &&
      (inner.upper.array() <= outer.upper.array()).all())
    {
      found(this->ids_[middle]);
    }
    const double at = inner.lower[axis];
    if (outer.lower[axis] <= at)
    {
      this->find(outer, found, begin, middle, (axis + 1) % 3);
    }
    if (at <= outer.upper[axis])
    {
      this->find(outer, found, middle + 1, end, (axis + 1) % 3);
    }
  }

  const std::vector<Shell>& boxes_;
  std::vector<Index> ids_;
};

/// Shells that are inside out, and the shells that a repair flips. A closed shell with negative
/// volume is inside out if it is in no other closed shell. It is flipped together with the closed
/// shells inside it, whatever the signs of their volumes. Shells with almost no volume are ignored.
struct InwardShells
{
  std::vector<Index> roots; ///< only the shells that are inside out
  std::vector<Index> shells_to_flip; ///< the shells in `roots` and all closed shells inside them
};

/// Find the shells that are inside out, and the shells to flip. Return false if canceled.
bool inward_shells(ExecutionContext& context, const Points& points, const Triangles& triangles,
  const std::vector<Shell>& shells, InwardShells& result)
{
  std::vector<Index> order;
  for (std::size_t s = 0; s < shells.size(); ++s)
  {
    // Shells with almost no volume (for example a sheet and its flipped copy) are not inside out.
    constexpr double rounding = 1e-12;
    const double size = shells[s].box.diagonal();
    if (shells[s].closed && std::abs(shells[s].volume) > rounding * size * size * size)
    {
      order.push_back(static_cast<Index>(s));
    }
  }
  std::sort(order.begin(), order.end(),
    [&](Index s, Index t)
    {
      const double x = std::abs(shells[s].volume);
      const double y = std::abs(shells[t].volume);
      return x != y ? x > y : s < t;
    });
  std::vector<Index> rank(shells.size(), -1);
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    rank[order[i]] = static_cast<Index>(i);
  }
  const BoxFinder finder(shells, order);
  // Process shells by descending volume. For each shell that is in no other shell, find all smaller
  // shells inside it.
  std::vector<Index> container(shells.size(), -1);
  std::vector<char> flipped(shells.size(), 0);
  for (const Index s : order)
  {
    if (container[s] >= 0)
    {
      flipped[s] = flipped[container[s]];
    }
    else
    {
      flipped[s] = shells[s].volume < 0.0;
      if (flipped[s])
      {
        result.roots.push_back(s);
      }
      std::vector<Index> inner;
      finder.find(shells[s].box,
        [&](Index t)
        {
          if (rank[t] > rank[s] && container[t] < 0)
          {
            inner.push_back(t);
          }
        });
      std::vector<Vec3> query_points;
      std::vector<std::size_t> begin{ 0 };
      for (const Index t : inner)
      {
        const std::vector<Vec3> test_points = test_points_of(points, triangles, shells[t]);
        query_points.insert(query_points.end(), test_points.begin(), test_points.end());
        begin.push_back(query_points.size());
      }
      Eigen::VectorXd windings;
      if (!query_points.empty() &&
        !winding_numbers(context, points, triangles, shells[s], query_points, windings))
      {
        return false;
      }
      for (std::size_t i = 0; i < inner.size(); ++i)
      {
        constexpr double inside = 0.75;
        const auto shell_windings = windings.segment(
          static_cast<Index>(begin[i]), static_cast<Index>(begin[i + 1] - begin[i]));
        const Index inside_count = (shell_windings.array().abs() > inside).count();
        container[inner[i]] = 2 * inside_count > shell_windings.size() ? s : -1;
      }
    }
    if (flipped[s])
    {
      result.shells_to_flip.push_back(s);
    }
  }
  return true;
}

void weld_and_remove_flat(PointsView points, TrianglesView triangles, const RepairOptions& options,
  RepairedSurface& repaired)
{
  SurfaceDiagnosis& found = repaired.found;
  std::vector<char> used(static_cast<std::size_t>(points.rows()), 0);
  for (Index k = 0; k < triangles.size(); ++k)
  {
    used[triangles.data()[k]] = 1;
  }
  Points snapped = points;
  if (options.snap > 0.0)
  {
    snap_points(snapped, used, options.snap);
  }
  const std::vector<Index> weld = find_representatives(snapped, used);
  for (Index v = 0; v < points.rows(); ++v)
  {
    found.unreferenced_vertices += !used[v];
    found.duplicate_vertices += weld[v] != v;
  }
  std::vector<char> is_used(static_cast<std::size_t>(points.rows()), 0);
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    const Key key{ weld[triangles(t, 0)], weld[triangles(t, 1)], weld[triangles(t, 2)] };
    if (collinear(snapped.row(key[0]), snapped.row(key[1]), snapped.row(key[2])))
    {
      found.degenerate_triangles += 1;
      continue;
    }
    repaired.original_triangles.push_back(t);
    is_used[key[0]] = is_used[key[1]] = is_used[key[2]] = 1;
  }
  std::vector<Index> id(is_used.size(), -1);
  for (Index v = 0; v < points.rows(); ++v)
  {
    if (is_used[v])
    {
      id[v] = static_cast<Index>(repaired.original_vertices.size());
      repaired.original_vertices.push_back(v);
    }
  }
  repaired.points.resize(static_cast<Index>(repaired.original_vertices.size()), 3);
  for (Index v = 0; v < repaired.points.rows(); ++v)
  {
    repaired.points.row(v) = snapped.row(repaired.original_vertices[v]);
  }
  repaired.triangles.resize(static_cast<Index>(repaired.original_triangles.size()), 3);
  for (Index t = 0; t < repaired.triangles.rows(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      repaired.triangles(t, k) = id[weld[triangles(repaired.original_triangles[t], k)]];
    }
  }
  repaired.representative_of_vertex = weld;
}

Index count_duplicates(const Triangles& triangles)
{
  std::vector<Key> keys;
  keys.reserve(static_cast<std::size_t>(triangles.rows()));
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    keys.push_back(sorted_key(triangles, t));
  }
  std::sort(keys.begin(), keys.end());
  Index duplicates = 0;
  for (std::size_t i = 1; i < keys.size(); ++i)
  {
    duplicates += keys[i] == keys[i - 1];
  }
  return duplicates;
}
} // namespace

void add_to_report(const SurfaceDiagnosis& d, Report& report)
{
  const auto set = [&](const char* key, Index value) { report.set(key, Report::Value(value)); };
  set("counts.vertices", d.vertices);
  set("counts.triangles", d.triangles);
  set("counts.duplicate_vertices", d.duplicate_vertices);
  set("counts.unreferenced_vertices", d.unreferenced_vertices);
  set("counts.degenerate_triangles", d.degenerate_triangles);
  set("counts.duplicate_triangles", d.duplicate_triangles);
  set("counts.boundary_edges", d.boundary_edges);
  set("counts.nonmanifold_edges", d.nonmanifold_edges);
  set("counts.misoriented_edges", d.misoriented_edges);
  set("counts.components", d.components);
  set("counts.inward_components", d.inward_components);
  set("counts.self_intersections", d.self_intersections);
  set("counts.crossing_triangles", d.crossing_triangles);
}

Status repair_surface(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const RepairOptions& options, RepairedSurface& repaired)
{
  repaired = RepairedSurface();
  Status status = check_mesh(points, triangles);
  if (!status.ok())
  {
    return status;
  }
  SurfaceDiagnosis& found = repaired.found;
  found.vertices = points.rows();
  found.triangles = triangles.rows();
  weld_and_remove_flat(points, triangles, options, repaired);
  found.flat = is_flat(repaired.points, repaired.triangles);
  found.duplicate_triangles = count_duplicates(repaired.triangles);
  const EdgeCounts edges = count_edges(repaired.triangles);
  found.boundary_edges = edges.boundary;
  found.nonmanifold_edges = edges.nonmanifold;
  found.misoriented_edges = edges.misoriented;
  found.closed = edges.closed && repaired.triangles.rows() > 0;
  if (context.canceled())
  {
    return Status::canceled();
  }
  if (options.orient && found.misoriented_edges > 0)
  {
    repaired.flipped_triangles = orient_patches(repaired.points, repaired.triangles);
  }
  const Components components = connected_components(repaired.points.rows(), repaired.triangles);
  const std::vector<Shell> shells = shells_of(repaired.points, repaired.triangles, components);
  InwardShells inward;
  if (!inward_shells(context, repaired.points, repaired.triangles, shells, inward))
  {
    return Status::canceled();
  }
  found.components = components.count;
  found.inward_components = static_cast<Index>(inward.roots.size());
  for (std::size_t k = 0; k < inward.roots.size(); ++k)
  {
    for (const Index t : shells[inward.roots[k]].triangles)
    {
      repaired.inward_triangles.emplace_back(t, static_cast<Index>(k));
    }
  }
  std::sort(repaired.inward_triangles.begin(), repaired.inward_triangles.end());
  if (options.orient)
  {
    repaired.flipped_components = found.inward_components;
    for (const Index s : inward.shells_to_flip)
    {
      for (const Index t : shells[s].triangles)
      {
        std::swap(repaired.triangles(t, 1), repaired.triangles(t, 2));
      }
    }
  }
  repaired.closed =
    repaired.flipped_triangles == 0 ? found.closed : count_edges(repaired.triangles).closed;
  if (options.count_self_intersections)
  {
    return find_self_intersections(context, repaired);
  }
  return context.canceled() ? Status::canceled() : Status();
}

Status find_self_intersections(ExecutionContext& context, RepairedSurface& repaired)
{
  if (!crossing_pairs(context, repaired.points, repaired.triangles, repaired.crossings))
  {
    return Status::canceled();
  }
  repaired.found.self_intersections = static_cast<Index>(repaired.crossings.size());
  std::vector<char> crosses(static_cast<std::size_t>(repaired.triangles.rows()), 0);
  for (const auto& [s, t] : repaired.crossings)
  {
    crosses[s] = crosses[t] = 1;
  }
  repaired.found.crossing_triangles = std::count(crosses.begin(), crosses.end(), 1);
  return {};
}

} // namespace bindpose
