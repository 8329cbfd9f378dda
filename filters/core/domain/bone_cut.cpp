// Duplication of the vertices along bones (see bone_cut.h). The triangles around a vertex on a bone
// form groups. Two triangles are in one group if they share an edge that ends at the vertex and is
// on no bone. The first group keeps the vertex; every other group gets a copy of the vertex. If all
// triangles of a group are on one side of the curve, the group's vertex belongs to this side. If a
// group has triangles on both sides of one curve, the group surrounds a tip of the curve, and the
// group's vertex belongs to no side.
#include "domain/bone_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace bindpose
{

namespace
{
/// Points nearer to a bone than this fraction of the mesh's diagonal are on the bone.
constexpr double bone_tolerance = 1e-6;

using EdgeKey = std::pair<Index, Index>;

EdgeKey edge_key(Index a, Index b)
{
  return { std::min(a, b), std::max(a, b) };
}

/// Map from each mesh edge to the bone along the edge (the lowest index if there are several); -1:
/// no bone.
using BoneEdges = std::map<EdgeKey, Index>;

/// Return the mesh's vertices on the bone, from head to tail. Return an empty list unless both ends
/// of the bone are at vertices.
std::vector<Index> vertices_along(PointsView points, const Handle& bone, double tolerance)
{
  const Eigen::Vector2d head = bone.head.head<2>();
  const Eigen::Vector2d bone_vector = (bone.tail - bone.head).head<2>();
  const double length = bone_vector.norm();
  std::vector<std::pair<double, Index>> found;
  for (Index v = 0; v < points.rows(); ++v)
  {
    const Eigen::Vector2d offset = points.row(v).head<2>().transpose() - head;
    const double at = offset.dot(bone_vector) / length;
    const double line_distance = (bone_vector[0] * offset[1] - bone_vector[1] * offset[0]) / length;
    if (std::abs(line_distance) <= tolerance && at >= -tolerance && at <= length + tolerance)
    {
      found.emplace_back(at, v);
    }
  }
  std::sort(found.begin(), found.end());
  std::vector<Index> vertices;
  if (!found.empty() && found.front().first <= tolerance &&
    found.back().first >= length - tolerance)
  {
    for (const auto& [at, v] : found)
    {
      vertices.push_back(v);
    }
  }
  return vertices;
}

/// Return twice the signed area of the triangle (head, tail, p), positive if p is left of the bone.
double twice_signed_area(const Handle& bone, const Eigen::RowVector3d& p)
{
  const Vec3 bone_vector = bone.tail - bone.head;
  return bone_vector[0] * (p[1] - bone.head[1]) - bone_vector[1] * (p[0] - bone.head[0]);
}

/// Return the triangles at a vertex, in groups that are separated by bones.
std::vector<std::vector<Index>> groups_around(Index vertex,
  const std::vector<Index>& adjacent_triangles, TrianglesView triangles, const BoneEdges& bones)
{
  std::vector<std::size_t> group(adjacent_triangles.size());
  // Key: other end of an edge at `vertex`. Value: the first triangle at this edge, as an index in
  // `adjacent_triangles`.
  std::map<Index, std::size_t> first_at;
  for (std::size_t i = 0; i < adjacent_triangles.size(); ++i)
  {
    group[i] = i;
    for (int k = 0; k < 3; ++k)
    {
      const Index other = triangles(adjacent_triangles[i], k);
      if (other == vertex || bones.count(edge_key(vertex, other)))
      {
        continue;
      }
      const auto [entry, is_new] = first_at.emplace(other, i);
      const std::size_t from = group[i];
      const std::size_t to = group[entry->second];
      if (!is_new && from != to)
      {
        std::replace(group.begin(), group.begin() + static_cast<std::ptrdiff_t>(i) + 1,
          std::max(from, to), std::min(from, to));
      }
    }
  }
  std::vector<std::vector<Index>> groups;
  for (std::size_t g = 0; g < adjacent_triangles.size(); ++g)
  {
    std::vector<Index> members;
    for (std::size_t i = 0; i < adjacent_triangles.size(); ++i)
    {
      if (group[i] == g)
      {
        members.push_back(adjacent_triangles[i]);
      }
    }
    if (!members.empty())
    {
      groups.push_back(std::move(members));
    }
  }
  return groups;
}

/// Return on which side of a bone (see BoneCut::side) a group of triangles around a vertex is.
Index side_of(Index vertex, const std::vector<Index>& group, PointsView points,
  TrianglesView triangles, const Handles& handles, const std::vector<Index>& curves,
  const BoneEdges& bones)
{
  std::vector<Index> sides;
  for (const Index t : group)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Index other = triangles(t, k);
      const auto bone = other == vertex ? bones.end() : bones.find(edge_key(vertex, other));
      if (bone != bones.end())
      {
        const Index third = triangles.row(t).sum() - vertex - other;
        const bool left = twice_signed_area(handles[static_cast<std::size_t>(bone->second)],
                            points.row(third)) > 0.0;
        sides.push_back(2 * curves[static_cast<std::size_t>(bone->second)] + (left ? 1 : 2));
      }
    }
  }
  std::sort(sides.begin(), sides.end());
  for (std::size_t i = 1; i < sides.size(); ++i)
  {
    if (sides[i] != sides[i - 1] && (sides[i] - 1) / 2 == (sides[i - 1] - 1) / 2)
    {
      return 0; // the group surrounds the tip of a curve
    }
  }
  return sides.empty() ? 0 : sides.front();
}
} // namespace

Status cut_along_bones(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const Handles& handles, const std::vector<Index>& curves, BoneCut& result)
{
  Status status = check_mesh(points, triangles);
  if (!status.ok())
  {
    return status;
  }
  const Box box = bounding_box(points);
  const double tolerance = bone_tolerance * box.diagonal();
  if (triangles.rows() == 0 || box.size()[2] > tolerance)
  {
    return Status::invalid_input("a mesh must be in a plane z = const to be cut along bones");
  }
  BoneEdges edges;
  for (const Edge& edge : mesh_edges(triangles))
  {
    edges.emplace(edge_key(edge.a, edge.b), -1);
  }
  std::vector<Index> curve_of = curves;
  for (std::size_t b = curve_of.size(); b < handles.size(); ++b)
  {
    curve_of.push_back(static_cast<Index>(b));
  }
  Index bones = 0;
  BoneEdges cut;
  for (std::size_t b = 0; b < handles.size(); ++b)
  {
    if (context.canceled())
    {
      return Status::canceled();
    }
    if (handles[b].kind != HandleKind::bone)
    {
      continue;
    }
    bones += 1;
    const std::vector<Index> bone_vertices = vertices_along(points, handles[b], tolerance);
    bool is_edge_chain = bone_vertices.size() > 1;
    for (std::size_t i = 1; i < bone_vertices.size(); ++i)
    {
      is_edge_chain =
        is_edge_chain && edges.count(edge_key(bone_vertices[i - 1], bone_vertices[i])) > 0;
      cut.emplace(edge_key(bone_vertices[i - 1], bone_vertices[i]), static_cast<Index>(b));
    }
    if (!is_edge_chain)
    {
      return Status::invalid_input("bone '" + handles[b].name +
        "' must consist of edges of the mesh; create the mesh with these handles");
    }
  }
  if (bones == 0)
  {
    return Status::invalid_input("the handles contain no bone to cut along");
  }

  std::map<Index, std::vector<Index>>
    adjacent_triangles; // triangles around each vertex on a bone, ascending
  for (const auto& [edge, bone] : cut)
  {
    adjacent_triangles[edge.first];
    adjacent_triangles[edge.second];
  }
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      const auto entry = adjacent_triangles.find(triangles(t, k));
      if (entry != adjacent_triangles.end())
      {
        entry->second.push_back(t);
      }
    }
  }
  result.triangles = triangles;
  result.original.resize(static_cast<std::size_t>(points.rows()));
  for (Index v = 0; v < points.rows(); ++v)
  {
    result.original[static_cast<std::size_t>(v)] = v;
  }
  result.side.assign(static_cast<std::size_t>(points.rows()), 0);
  std::vector<bool> opened(handles.size(), false);
  for (const auto& [vertex, triangles_around] : adjacent_triangles)
  {
    const auto groups = groups_around(vertex, triangles_around, triangles, cut);
    for (std::size_t g = 0; g < groups.size(); ++g)
    {
      for (const Index t : groups.size() > 1 ? groups[g] : std::vector<Index>())
      {
        for (int k = 0; k < 3; ++k)
        {
          const auto bone = cut.find(edge_key(vertex, triangles(t, k)));
          if (bone != cut.end())
          {
            opened[static_cast<std::size_t>(bone->second)] = true;
          }
        }
      }
      const Index side = side_of(vertex, groups[g], points, triangles, handles, curve_of, cut);
      if (g == 0)
      {
        result.side[static_cast<std::size_t>(vertex)] = side;
        continue;
      }
      const auto copy = static_cast<Index>(result.original.size());
      result.original.push_back(vertex);
      result.side.push_back(side);
      for (const Index t : groups[g])
      {
        for (int k = 0; k < 3; ++k)
        {
          if (triangles(t, k) == vertex)
          {
            result.triangles(t, k) = copy;
          }
        }
      }
    }
  }
  for (std::size_t b = 0; b < handles.size(); ++b)
  {
    const Index left = 2 * curve_of[b] + 1;
    const auto has = [&result](Index side)
    { return std::find(result.side.begin(), result.side.end(), side) != result.side.end(); };
    if (handles[b].kind != HandleKind::bone || has(left) || has(left + 1))
    {
      continue;
    }
    if (!opened[b])
    {
      return Status::invalid_input("bone '" + handles[b].name +
        "' cannot be cut because it has no vertex between its ends; use a finer mesh");
    }
    status.warnings.push_back("bone '" + handles[b].name +
      "' has no vertex besides its ends and uses the sides of neighboring bones; use a finer mesh");
  }
  result.points.resize(static_cast<Index>(result.original.size()), 3);
  for (Index v = 0; v < result.points.rows(); ++v)
  {
    result.points.row(v) = points.row(result.original[static_cast<std::size_t>(v)]);
  }
  status.report.set("counts.doubled_vertices", result.points.rows() - points.rows());
  return status;
}

} // namespace bindpose
