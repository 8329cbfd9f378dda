// Assign vertices and boundary values to handles (see handle_constraints.h).
#include "domain/handle_constraints.h"

#include "base/disjoint_sets.h"
#include "base/number_text.h"
#include "base/sort_unique.h"
#include "geometry/laplacian.h"
#include "geometry/simplex_locator.h"

#include <algorithm>
#include <map>

namespace bindpose
{

namespace
{
/// Return the distance from p to a handle: to the segment from head to tail of a bone, or to the
/// position of a handle that is not a bone.
double handle_distance(const Handle& handle, const Vec3& p)
{
  return nearest_in_triangle(p, handle.head, handle.tail, handle.tail).distance;
}

bool do_handles_touch(const Handle& a, const Handle& b, double tolerance)
{
  return handle_distance(a, b.head) <= tolerance || handle_distance(a, b.tail) <= tolerance ||
    handle_distance(b, a.head) <= tolerance || handle_distance(b, a.tail) <= tolerance;
}

void find_components(const Domain& domain, HandleConstraints& result)
{
  const std::vector<char> has_measure = measurable_elements(domain);
  const Index vertex_count = domain.points.rows();
  result.roles.assign(static_cast<std::size_t>(vertex_count), VertexRole::unreferenced);
  result.components = connected_components(domain);
  for (Index v = 0; v < vertex_count; ++v)
  {
    if (result.components.component_of_vertex[v] >= 0)
    {
      result.roles[v] = VertexRole::solved;
    }
  }
  // A follower is a vertex that is only in elements without area. A follower copies the weights of
  // a neighbor. If the neighbor is also a follower, both copy the weights of the same vertex.
  result.leader.assign(static_cast<std::size_t>(vertex_count), -1);
  for (bool changed = true; changed;)
  {
    changed = false;
    for (Index e = 0; e < domain.element_count(); ++e)
    {
      const Index* ids = domain.element(e);
      for (int i = 0; i < domain.corners() && !has_measure[e]; ++i)
      {
        for (int j = 0; j < domain.corners(); ++j)
        {
          if (result.roles[ids[i]] == VertexRole::unreferenced &&
            result.roles[ids[j]] != VertexRole::unreferenced)
          {
            result.roles[ids[i]] = VertexRole::follower;
            result.leader[ids[i]] = result.leader[ids[j]] >= 0 ? result.leader[ids[j]] : ids[j];
            changed = true;
          }
        }
      }
    }
  }
}

/// Merge all components that contain vertices of the same label > 0.
void join_components(const std::vector<Index>& labels, Components& components)
{
  DisjointSets<Index> parts(static_cast<std::size_t>(components.count));
  std::map<Index, Index> part_of_label;
  for (std::size_t v = 0; v < labels.size(); ++v)
  {
    const Index c = components.component_of_vertex[v];
    if (labels[v] > 0 && c >= 0)
    {
      parts.unite(c, part_of_label.insert({ labels[v], c }).first->second);
    }
  }
  std::vector<Index> renumbered(static_cast<std::size_t>(components.count), -1);
  Index count = 0;
  for (Index c = 0; c < components.count; ++c)
  {
    const Index root = parts.find(c);
    renumbered[c] = root == c ? count++ : renumbered[root];
  }
  for (Index& c : components.component_of_vertex)
  {
    c = c < 0 ? c : renumbered[c];
  }
  components.count = count;
}

void assign_nearest_handles(const Domain& domain, const Handles& handles,
  const std::vector<std::vector<Index>>& vertices_of_handle, HandleConstraints& result)
{
  const Index count = result.components.count;
  result.nearest_handle.assign(static_cast<std::size_t>(count), -1);
  std::vector<char> has_handle(static_cast<std::size_t>(count), 0);
  for (const Index v : result.vertices)
  {
    has_handle[result.components.component_of_vertex[v]] = 1;
  }
  for (Index v = 0; v < domain.points.rows(); ++v)
  {
    const Index c = result.components.component_of_vertex[v];
    if (c >= 0 && !has_handle[c])
    {
      result.roles[v] = VertexRole::without_handle;
    }
  }
  const bool has_embedded_points = !domain.embedded_point_corners.empty();
  const PointsView measured_points = has_embedded_points ? domain.embedded_points : domain.points;
  std::vector<double> nearest(static_cast<std::size_t>(count), 1e300);
  for (Index v = 0; v < measured_points.rows(); ++v)
  {
    const Index corner = has_embedded_points ? domain.embedded_point_corners[v] : v;
    const Index c = corner < 0 ? -1 : result.components.component_of_vertex[corner];
    if (c < 0 || has_handle[c])
    {
      continue;
    }
    const Vec3 p = measured_points.row(v);
    for (std::size_t i = 0; i < handles.size(); ++i)
    {
      double distance = 1e300;
      if (result.counts[i] == 0)
      {
        continue; // the handle constrains no vertex, so all its weights are zero
      }
      if (handles[i].kind == HandleKind::region)
      {
        for (const Index u : vertices_of_handle[i])
        {
          distance = std::min(distance, (domain.points.row(u).transpose() - p).norm());
        }
      }
      else
      {
        distance = handle_distance(handles[i], p);
      }
      if (distance < nearest[c])
      {
        nearest[c] = distance;
        result.nearest_handle[c] = static_cast<Index>(i);
      }
    }
  }
  // If a lattice component contains no point of the surface, its weights do not affect the result.
  // Such a component copies the weights of the first handle that has vertices.
  const auto first = std::find_if(
    result.counts.begin(), result.counts.end(), [](Index owned_count) { return owned_count > 0; });
  for (Index c = 0; c < count; ++c)
  {
    if (result.nearest_handle[c] < 0 && !has_handle[c])
    {
      result.nearest_handle[c] = first - result.counts.begin();
    }
  }
  std::map<Index, Index> parts; // handle -> number of components that copy its weights
  for (const Index handle : result.nearest_handle)
  {
    if (handle >= 0)
    {
      parts[handle] += 1;
    }
  }
  if (parts.empty())
  {
    return;
  }
  Index all = 0;
  std::vector<Index> followed;
  for (const auto& [handle, number] : parts)
  {
    all += number;
    followed.push_back(handle);
  }
  result.warnings.push_back(std::to_string(all) +
    (all == 1 ? " connected part without a handle follows the nearest handle "
              : " connected parts without a handle follow the nearest ") +
    (all == 1               ? ""
        : parts.size() == 1 ? "handle "
                            : "handles ") +
    abbreviated_names(handles, followed));
}

/// Return advice to the user about a handle that has no vertex of its own.
std::string advice_about(const Handle& handle, const Box& box)
{
  const auto distance = [&](const Vec3& p)
  { return (p - p.cwiseMax(box.lower).cwiseMin(box.upper)).norm() / box.diagonal(); };
  const double distance_outside = std::min(distance(handle.head), distance(handle.tail));
  constexpr double far_distance = 0.05;
  return distance_outside > far_distance ? "it is " + short_number(distance_outside) +
      " bounding-box diagonals outside the mesh, so check the units and the position of the "
      "handles"
                                         : "move it, or refine the mesh there";
}

/// Ensure that every handle has its own vertex, which is a vertex on no other handle. A handle
/// whose vertices are all shared, such as a point handle on a bone, would not have the weight one
/// anywhere. Such a handle takes over one of its shared vertices, but only if every other handle at
/// this vertex has its own vertex elsewhere. If several vertices qualify, the lowest id is used. If
/// no vertex qualifies, an optional handle is removed from all its vertices, and a required handle
/// is an error.
Status assign_own_vertices(const Handles& handles, const Box& box,
  std::map<Index, std::vector<Index>>& owners, HandleConstraints& result)
{
  std::vector<Index> own_vertex_count(handles.size(), 0);
  for (const auto& [v, list] : owners)
  {
    own_vertex_count[list[0]] += list.size() == 1;
  }
  const auto set_row = [&](Index vertex, const std::vector<Index>& list)
  {
    const auto row = std::lower_bound(result.vertices.begin(), result.vertices.end(), vertex) -
      result.vertices.begin();
    result.values.row(row).setZero();
    for (const Index owner : list)
    {
      result.values(row, owner) = 1.0 / static_cast<double>(list.size());
    }
  };
  std::vector<Index> skipped;
  for (std::size_t j = 0; j < handles.size(); ++j)
  {
    const auto at = static_cast<Index>(j);
    for (auto vertex = owners.begin(); vertex != owners.end() && own_vertex_count[j] == 0; ++vertex)
    {
      auto& list = vertex->second;
      if (std::find(list.begin(), list.end(), at) != list.end() &&
        std::all_of(
          list.begin(), list.end(), [&](Index i) { return i == at || own_vertex_count[i] > 0; }))
      {
        for (const Index other : list)
        {
          result.counts[other] -= other == at ? 0 : 1;
        }
        list = { at };
        set_row(vertex->first, list);
        own_vertex_count[j] = 1;
      }
    }
    if (own_vertex_count[j] > 0)
    {
      continue;
    }
    if (handles[j].ownership == Ownership::required)
    {
      return Status::invalid_input("handle '" + handles[j].name +
        "' has no vertex of its own because other handles constrain the same vertices; " +
        advice_about(handles[j], box));
    }
    skipped.push_back(at);
    result.counts[j] = 0;
    for (auto& [v, list] : owners)
    {
      const auto list_entry = std::find(list.begin(), list.end(), at);
      if (list_entry != list.end())
      {
        list.erase(list_entry);
        own_vertex_count[list[0]] += list.size() == 1;
        set_row(v, list);
      }
    }
  }
  if (skipped.size() == handles.size())
  {
    const bool all_without_influence = std::all_of(handles.begin(), handles.end(),
      [](const Handle& handle) { return handle.ownership == Ownership::none; });
    return Status::invalid_input(
      std::string("no handle constrains a vertex because all handles are ") +
      (all_without_influence ? "joints that move no vertices" : "on elements without area"));
  }
  if (!skipped.empty())
  {
    result.warnings.push_back(skipped.size() == 1 ? "joint " + abbreviated_names(handles, skipped) +
          " has no vertex of its own and was skipped: its weights are zero"
                                                  : std::to_string(skipped.size()) +
          " joints have no vertex of their own and were skipped; their weights are zero: " +
          abbreviated_names(handles, skipped));
  }
  return {};
}

/// Add one warning for all handles that share vertices although they do not touch.
void warn_of_shared_vertices(const Handles& handles,
  const std::map<std::pair<Index, Index>, Index>& shared, double tolerance,
  HandleConstraints& result)
{
  constexpr Index maximum = 3; // largest number of pairs that the warning names
  std::string first;
  std::string list;
  Index pairs = 0;
  for (const auto& [pair, count] : shared)
  {
    const Handle& a = handles[pair.first];
    const Handle& b = handles[pair.second];
    const bool skipped = result.counts[pair.first] == 0 || result.counts[pair.second] == 0;
    if (skipped ||
      (a.kind != HandleKind::region && b.kind != HandleKind::region &&
        do_handles_touch(a, b, tolerance)))
    {
      continue;
    }
    const std::string names = "'" + a.name + "' and '" + b.name + "'";
    if (pairs == 0)
    {
      first = "handles " + names + " share " + std::to_string(count) +
        (count == 1 ? " vertex" : " vertices");
    }
    if (pairs < maximum)
    {
      list += (pairs > 0 ? "; " : "") + names;
    }
    pairs += 1;
  }
  if (pairs > 0)
  {
    result.warnings.push_back(
      (pairs == 1 ? first
                  : std::to_string(pairs) + " pairs of handles share vertices but do not touch (" +
            list + (pairs > maximum ? "; …)" : ")")) +
      "; their weights are split evenly there");
  }
}
} // namespace

Status constrain_handles(const HandleInsertion& mesh, const Handles& handles,
  const std::vector<Index>& region_ids, HandleConstraints& result,
  const std::vector<Index>& part_labels)
{
  result = {};
  const Domain& domain = mesh.domain;
  find_components(domain, result);
  if (!part_labels.empty())
  {
    join_components(part_labels, result.components);
  }

  const Status valid = check_regions(
    handles, region_ids, domain.points.rows() - static_cast<Index>(mesh.inserted.size()));
  if (!valid.ok())
  {
    return valid;
  }
  const std::vector<Index> labels = extend_labels(mesh, region_ids);
  std::vector<std::vector<Index>> vertices_of_handle(handles.size());
  result.counts.assign(handles.size(), 0);
  std::map<Index, std::vector<Index>> handles_of_vertex;
  for (std::size_t i = 0; i < handles.size(); ++i)
  {
    const Handle& handle = handles[i];
    if (handle.kind != HandleKind::region)
    {
      vertices_of_handle[i] = mesh.handles[i].vertices;
    }
    else
    {
      for (Index v = 0; v < domain.points.rows(); ++v)
      {
        if (labels[v] == handle.region_id)
        {
          vertices_of_handle[i].push_back(v);
        }
      }
    }
    for (const Index v : vertices_of_handle[i])
    {
      if (result.components.component_of_vertex[v] >= 0)
      {
        handles_of_vertex[v].push_back(static_cast<Index>(i));
        result.counts[i] += 1;
      }
    }
    if (result.counts[i] == 0 && handle.ownership == Ownership::required)
    {
      return Status::invalid_input(
        "handle '" + handle.name + "' constrains no vertex because it is on elements without area");
    }
  }

  const auto m = static_cast<Index>(handles.size());
  for (const auto& entry : handles_of_vertex)
  {
    result.vertices.push_back(entry.first);
  }
  for (const CageVertex& on_cage : mesh.cage)
  {
    if (result.components.component_of_vertex[on_cage.vertex] >= 0)
    {
      result.vertices.push_back(on_cage.vertex);
    }
  }
  sort_unique(result.vertices);
  result.values = Weights::Zero(static_cast<Index>(result.vertices.size()), m);
  const auto row_of = [&](Index v)
  {
    return std::lower_bound(result.vertices.begin(), result.vertices.end(), v) -
      result.vertices.begin();
  };
  for (const CageVertex& on_cage : mesh.cage)
  {
    // Handles take precedence over edges and faces of cages. Cage elements that meet at a vertex
    // give it the same weights.
    if (result.components.component_of_vertex[on_cage.vertex] >= 0 &&
      handles_of_vertex.count(on_cage.vertex) == 0)
    {
      for (int k = 0; k < 3; ++k)
      {
        if (on_cage.element[k] >= 0)
        {
          result.values(row_of(on_cage.vertex), on_cage.element[k]) += on_cage.barycentric[k];
        }
      }
    }
  }
  for (std::size_t i = 0; i < result.vertices.size(); ++i)
  {
    const auto row = static_cast<Index>(i);
    result.roles[result.vertices[i]] = VertexRole::handle;
    const double sum = result.values.row(row).sum();
    if (sum > 0.0)
    {
      result.values.row(row) /= sum;
    }
  }
  std::map<std::pair<Index, Index>, Index> shared;
  for (const auto& [v, owners] : handles_of_vertex)
  {
    const auto row = row_of(v);
    for (const Index owner : owners)
    {
      result.values(row, owner) = 1.0 / static_cast<double>(owners.size());
      for (const Index other : owners)
      {
        if (owner < other)
        {
          shared[{ owner, other }] += 1;
        }
      }
    }
  }
  const Box box = bounding_box(domain.points);
  const Status assign_status = assign_own_vertices(handles, box, handles_of_vertex, result);
  if (!assign_status.ok())
  {
    return assign_status;
  }
  warn_of_shared_vertices(handles, shared, 1e-9 * box.diagonal(), result);
  assign_nearest_handles(domain, handles, vertices_of_handle, result);
  return {};
}

} // namespace bindpose
