// The way back from vtkHandleFileReader: points first, then bones, so that the columns of the file
// are those of the handles.
#include "handle_tgf.h"

#include <array>
#include <map>

namespace bindpose
{

Status to_tgf(const Handles& handles, Tgf& graph)
{
  graph = Tgf();
  std::vector<Index> node_of(handles.size(), -1);
  const auto add_node = [&](const Vec3& place, const std::string& text)
  {
    Tgf::Node node;
    node.position = place;
    node.text = text;
    graph.nodes.push_back(node);
    return static_cast<Index>(graph.nodes.size()) - 1;
  };
  for (std::size_t i = 0; i < handles.size(); ++i)
  {
    if (handles[i].kind == HandleKind::region)
    {
      return Status::invalid_input(
        "a .tgf file holds no regions, but '" + handles[i].name + "' is one");
    }
    if (handles[i].kind != HandleKind::bone)
    {
      node_of[i] = add_node(handles[i].head, handles[i].name);
    }
  }
  std::map<std::array<double, 3>, Index> joints;
  const auto joint = [&](const Vec3& place)
  {
    const auto [entry, fresh] = joints.emplace(
      std::array<double, 3>{ place.x(), place.y(), place.z() }, Index(graph.nodes.size()));
    return fresh ? add_node(place, "") : entry->second;
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
          "a .tgf file holds no faces of cages, but '" + handle.name + "' has one");
      }
      Tgf::Edge edge;
      edge.from = node_of[element[0]];
      edge.to = node_of[element[1]];
      edge.bone = false;
      edge.cage = true;
      graph.edges.push_back(edge);
    }
  }
  return {};
}

} // namespace bindpose
