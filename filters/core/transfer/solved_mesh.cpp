// Make the mesh on which weights are inpainted (see solved_mesh.h).
#include "transfer/solved_mesh.h"

#include "surface/triangle_predicates.h"
#include "surface/vertex_order.h"

#include <algorithm>
#include <numeric>

namespace bindpose
{

namespace
{
/// Merge the points of a surface that have the same position, and leave out triangles whose corners
/// are collinear.
void merge_surface(const Domain& target, SolvedMesh& mesh)
{
  const Index n = target.points.rows();
  std::vector<char> used(static_cast<std::size_t>(n), 0);
  std::vector<Index> kept;
  for (Index f = 0; f < target.triangles.rows(); ++f)
  {
    const auto corner = [&](int k) -> Vec3 { return target.points.row(target.triangles(f, k)); };
    if (!collinear(corner(0), corner(1), corner(2)))
    {
      kept.push_back(f);
      for (int k = 0; k < 3; ++k)
      {
        used[target.triangles(f, k)] = 1;
      }
    }
  }
  const std::vector<Index> representative = find_representatives(target.points, used);
  std::vector<Index> vertices; // their representatives
  for (Index i = 0; i < n; ++i)
  {
    if (used[i] && representative[i] == i)
    {
      mesh.vertex_of_point[i] = static_cast<Index>(vertices.size());
      vertices.push_back(i);
    }
  }
  mesh.domain.points.resize(static_cast<Index>(vertices.size()), 3);
  for (std::size_t v = 0; v < vertices.size(); ++v)
  {
    mesh.domain.points.row(static_cast<Index>(v)) = target.points.row(vertices[v]);
  }
  for (Index i = 0; i < n; ++i)
  {
    mesh.vertex_of_point[i] = used[i] ? mesh.vertex_of_point[representative[i]] : -1;
  }
  mesh.domain.triangles.resize(static_cast<Index>(kept.size()), 3);
  for (Index f = 0; f < mesh.domain.triangles.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      mesh.domain.triangles(f, k) = mesh.vertex_of_point[target.triangles(kept[f], k)];
    }
  }
}

/// Scale the mesh. Only vertices of parts are in the bounding box.
ScaledMesh scale_parts(const SolvedMesh& mesh)
{
  std::vector<char> used(mesh.parts.component_of_vertex.size());
  for (std::size_t v = 0; v < used.size(); ++v)
  {
    used[v] = mesh.parts.component_of_vertex[v] >= 0;
  }
  return scale_mesh(mesh.domain, used);
}

/// Clear `matched` in groups that are smaller than `smallest_group` times the largest group in
/// their part.
void clear_small_groups(double smallest_group, SolvedMesh& mesh)
{
  struct Group
  {
    std::vector<Index> vertices;
    double size = 0.0;
    Index part = 0;
  };
  std::vector<char> waiting(mesh.matched.size());
  for (std::size_t v = 0; v < waiting.size(); ++v)
  {
    waiting[v] = mesh.matched[v] && mesh.parts.component_of_vertex[v] >= 0;
  }
  const Eigen::VectorXd& sizes = mesh.scaled.mass;
  const VertexGraph graph = vertex_graph(mesh.domain);
  std::vector<Group> groups;
  std::vector<double> largest(static_cast<std::size_t>(mesh.parts.count), 0.0); // of each part
  for (std::size_t first = 0; first < waiting.size(); ++first)
  {
    if (!waiting[first])
    {
      continue;
    }
    Group group;
    group.part = mesh.parts.component_of_vertex[first];
    group.vertices.push_back(static_cast<Index>(first));
    waiting[first] = 0;
    for (std::size_t i = 0; i < group.vertices.size(); ++i)
    {
      const Index v = group.vertices[i];
      group.size += sizes[v];
      for (Index k = graph.begin[v]; k < graph.begin[v + 1]; ++k)
      {
        const Index other = graph.neighbors[k];
        if (waiting[other])
        {
          waiting[other] = 0;
          group.vertices.push_back(other);
        }
      }
    }
    largest[group.part] = std::max(largest[group.part], group.size);
    groups.push_back(std::move(group));
  }
  for (const Group& group : groups)
  {
    if (group.size >= smallest_group * largest[group.part])
    {
      continue;
    }
    ++mesh.small_group_count;
    for (const Index v : group.vertices)
    {
      mesh.matched[v] = 0;
    }
  }
}
} // namespace

Status make_solved_mesh(
  const Domain& target, const SurfaceMatch& match, double smallest_group, SolvedMesh& mesh)
{
  const Index n = target.points.rows();
  mesh.vertex_of_point.assign(static_cast<std::size_t>(n), -1);
  if (target.is_volume())
  {
    const Status status = check_domain(target);
    if (!status.ok())
    {
      return status;
    }
    mesh.domain = target;
    std::iota(mesh.vertex_of_point.begin(), mesh.vertex_of_point.end(), Index(0));
  }
  else
  {
    merge_surface(target, mesh);
  }
  mesh.parts = connected_components(mesh.domain);
  mesh.matched.assign(static_cast<std::size_t>(mesh.domain.points.rows()), 0);
  mesh.point_of_vertex.assign(mesh.matched.size(), -1);
  for (Index i = 0; i < n; ++i)
  {
    const Index v = mesh.vertex_of_point[i];
    if (v >= 0 && (mesh.point_of_vertex[v] < 0 || (match.matched[i] && !mesh.matched[v])))
    {
      mesh.point_of_vertex[v] = i;
      mesh.matched[v] = match.matched[i];
    }
  }
  if (mesh.parts.count > 0)
  {
    mesh.scaled = scale_parts(mesh);
    clear_small_groups(smallest_group, mesh);
  }
  return {};
}

} // namespace bindpose
