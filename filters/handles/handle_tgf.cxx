// Converts handles to graphs for .tgf files, and graphs to handles. Points are written before
// bones, so that weights computed with the file have the same order of columns as weights computed
// with the handles. When a graph is read, nodes without a bone become the first handles, and bones
// become the next ones. Shared nodes determine the parents of bones.
#include "handle_tgf.h"

#include "conversion.h"
#include "pseudo_edge_cells.h"

#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <map>

namespace bindpose
{

namespace
{
/// Return the parent that vtkHandleFileReader derives from shared nodes: the first bone whose tail
/// is the handle's head; -1 if there is none.
Index parent_by_joint(const Handles& handles, const Handle& handle)
{
  const auto found = std::find_if(handles.begin(), handles.end(),
    [&](const Handle& other)
    {
      return handle.kind == HandleKind::bone && other.kind == HandleKind::bone &&
        other.tail == handle.head;
    });
  return found == handles.end() ? -1 : found - handles.begin();
}

/// Convert handles and pseudo-edges to a graph.
Status graph_of_handles(const Handles& handles, const PseudoEdges& pseudo_edges, Tgf& graph)
{
  graph = Tgf();
  std::vector<Index> node_of(handles.size(), -1);
  const auto add_node = [&](const Vec3& position, const std::string& text)
  {
    Tgf::Node node;
    node.position = position;
    node.text = text;
    graph.nodes.push_back(node);
    return static_cast<Index>(graph.nodes.size()) - 1;
  };
  for (std::size_t i = 0; i < handles.size(); ++i)
  {
    if (handles[i].kind == HandleKind::region)
    {
      return Status::invalid_input(
        "a .tgf file cannot store the region handle '" + handles[i].name + "'; use a .vtp file");
    }
    if (handles[i].kind != HandleKind::bone)
    {
      node_of[i] = add_node(handles[i].head, handles[i].name);
    }
  }
  std::map<std::array<double, 3>, Index> joints;
  const auto joint = [&](const Vec3& position)
  {
    const auto [entry, fresh] = joints.emplace(
      std::array<double, 3>{ position.x(), position.y(), position.z() }, Index(graph.nodes.size()));
    return fresh ? add_node(position, "") : entry->second;
  };
  for (const Handle& handle : handles)
  {
    if (handle.kind == HandleKind::bone)
    {
      Tgf::Edge edge;
      edge.from = joint(handle.head);
      edge.to = joint(handle.tail);
      graph.edges.push_back(edge);
    }
    for (const CageElement& element : handle.cage)
    {
      if (element[2] >= 0)
      {
        return Status::invalid_input(
          "a .tgf file cannot store the cage faces at '" + handle.name + "'; use a .vtp file");
      }
      Tgf::Edge edge;
      edge.from = node_of[element[0]];
      edge.to = node_of[element[1]];
      edge.bone = false;
      edge.cage = true;
      graph.edges.push_back(edge);
    }
  }
  for (const PseudoEdge& ends : pseudo_edges)
  {
    Tgf::Edge edge;
    edge.from = node_of[static_cast<std::size_t>(ends[0])];
    edge.to = node_of[static_cast<std::size_t>(ends[1])];
    edge.bone = false;
    edge.pseudo = true;
    graph.edges.push_back(edge);
  }
  std::vector<Index> handles_without_stored_parent;
  for (std::size_t i = 0; i < handles.size(); ++i)
  {
    if (handles[i].parent != parent_by_joint(handles, handles[i]))
    {
      handles_without_stored_parent.push_back(static_cast<Index>(i));
    }
  }
  Status status;
  if (!handles_without_stored_parent.empty())
  {
    status.warnings.push_back("a .tgf file stores parents only as shared joints of bones; the "
                              "parents of " +
      quoted_names(handles, handles_without_stored_parent) + " are not stored (use a .vtp file)");
  }
  return status;
}

/// Return the handles of a graph: nodes without a bone first, then bones.
/// @param pseudo_edges  the pseudo-edges between nodes that are points
Handles handles_of_graph(const Tgf& graph, PseudoEdges& pseudo_edges)
{
  std::vector<char> in_bone(graph.nodes.size(), 0);
  std::vector<char> in_cage(graph.nodes.size(), 0);
  for (const auto& edge : graph.edges)
  {
    if (edge.bone)
    {
      in_bone[edge.from] = in_bone[edge.to] = 1;
    }
    else if (edge.cage)
    {
      in_cage[edge.from] = in_cage[edge.to] = 1;
    }
  }
  std::vector<Index> handle_of_node(graph.nodes.size(), -1);
  Handles handles;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i)
  {
    if (in_bone[i] && !in_cage[i])
    {
      continue;
    }
    Handle point;
    point.head = point.tail = graph.nodes[i].position;
    point.kind = in_cage[i] ? HandleKind::cage_vertex : HandleKind::point;
    handle_of_node[i] = static_cast<Index>(handles.size());
    point.name = graph.nodes[i].text;
    if (point.name.empty())
    {
      point.name = "p" + std::to_string(handles.size() + 1);
    }
    handles.push_back(point);
  }
  for (const auto& edge : graph.edges)
  {
    if (!edge.bone && edge.cage)
    {
      const Index from = handle_of_node[edge.from];
      handles[from].cage.push_back({ from, handle_of_node[edge.to], -1 });
    }
  }
  for (const auto& edge : graph.edges)
  {
    const PseudoEdge ends{ handle_of_node[edge.from], handle_of_node[edge.to] };
    if (edge.pseudo && !edge.bone && check_pseudo_edges(handles, { ends }).ok())
    {
      pseudo_edges.push_back(ends);
    }
  }
  const std::size_t points = handles.size();
  std::vector<const Tgf::Edge*> bones;
  for (const auto& edge : graph.edges)
  {
    if (edge.bone)
    {
      bones.push_back(&edge);
    }
  }
  for (const auto* edge : bones)
  {
    Handle bone;
    bone.kind = HandleKind::bone;
    bone.name = "b" + std::to_string(handles.size() - points + 1);
    bone.head = graph.nodes[edge->from].position;
    bone.tail = graph.nodes[edge->to].position;
    for (std::size_t other = 0; other < bones.size() && bone.parent < 0; ++other)
    {
      if (bones[other] != edge && bones[other]->to == edge->from)
      {
        bone.parent = static_cast<Index>(points + other);
      }
    }
    handles.push_back(bone);
  }
  return handles;
}
} // namespace

Status to_tgf(const Handles& handles, Tgf& graph)
{
  return graph_of_handles(handles, {}, graph);
}

Status to_tgf(vtkPolyData* data, std::string& text)
{
  text.clear();
  if (!data || data->GetNumberOfCells() == 0)
  {
    return {};
  }
  Handles handles;
  std::vector<Index> cells;
  PseudoEdges pseudo_edges;
  Status status = to_handles(data, handles, &cells);
  if (status.ok())
  {
    status = to_pseudo_edges(data, handles, cells, pseudo_edges);
  }
  Tgf graph;
  if (status.ok())
  {
    status = graph_of_handles(handles, pseudo_edges, graph);
  }
  if (status.ok())
  {
    text = format_tgf(graph);
  }
  return status;
}

Status from_tgf(const Tgf& graph, vtkPolyData* data)
{
  data->Initialize();
  PseudoEdges pseudo_edges;
  const Handles handles = handles_of_graph(graph, pseudo_edges);
  Status status = check_handles(handles);
  if (!status.ok())
  {
    return status;
  }
  data->ShallowCopy(to_polydata(handles));
  if (!pseudo_edges.empty())
  {
    Handles list;
    std::vector<Index> cells;
    to_handles(data, list, &cells);
    add_pseudo_edges(data, cells, pseudo_edges);
  }
  Index unused_edges = -static_cast<Index>(pseudo_edges.size());
  for (const Tgf::Edge& edge : graph.edges)
  {
    unused_edges += !edge.bone && !edge.cage;
  }
  if (unused_edges > 0)
  {
    status.warnings.push_back(std::to_string(unused_edges) +
      " edges are ignored because they are neither bones nor cage edges nor pseudo-edges between "
      "points");
  }
  return status;
}

Status from_tgf(const std::string& text, vtkPolyData* data)
{
  data->Initialize();
  if (text.find_first_not_of(" \t\r\n\v\f") == std::string::npos)
  {
    return {};
  }
  Tgf graph;
  const Status status = parse_tgf(text, graph);
  return status.ok() ? from_tgf(graph, data) : status;
}

} // namespace bindpose
