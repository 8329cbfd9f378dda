// Converts handles to a graph for a .tgf file, the inverse of vtkHandleFileReader. Points are
// written first, then bones, so that weight columns computed with the file match those of the
// handles.
#include "handle_tgf.h"

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
} // namespace

Status to_tgf(const Handles& handles, Tgf& graph)
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

} // namespace bindpose
