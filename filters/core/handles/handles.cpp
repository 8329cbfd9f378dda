// Checks of handles and their names in messages (see handles.h).
#include "handles/handles.h"

#include "base/number_text.h"
#include "base/text_check.h"

#include <algorithm>
#include <set>

namespace bindpose
{

const char* to_string(HandleKind kind)
{
  switch (kind)
  {
    case HandleKind::cage_element:
      return "cage_element";
    case HandleKind::bone:
      return "bone";
    case HandleKind::cage_vertex:
      return "cage_vertex";
    case HandleKind::region:
      return "region";
    case HandleKind::point:
      break;
  }
  return "point";
}

namespace
{
Status check_parents(const Handles& handles)
{
  const auto count = static_cast<Index>(handles.size());
  for (const Handle& handle : handles)
  {
    Index steps = 0;
    for (Index ancestor = handle.parent; ancestor != -1; ancestor = handles[ancestor].parent)
    {
      if (ancestor < 0 || ancestor >= count)
      {
        return Status::invalid_input("handle '" + handle.name + "' has the parent " +
          std::to_string(ancestor) + ", but there are " + std::to_string(count) + " handles");
      }
      if (++steps > count)
      {
        return Status::invalid_input("handle '" + handle.name + "' is its own ancestor");
      }
    }
  }
  return {};
}

Status check_cages(const Handles& handles)
{
  const auto count = static_cast<Index>(handles.size());
  for (const Handle& handle : handles)
  {
    for (const CageElement& element : handle.cage)
    {
      const auto [a, b, c] = element;
      const auto is_corner = [&](Index i)
      { return i >= 0 && i < count && handles[i].kind == HandleKind::cage_vertex; };
      if (!is_corner(a) || !is_corner(b) || (c != -1 && !is_corner(c)) || a == b || a == c ||
        b == c || &handles[a] != &handle)
      {
        return Status::invalid_input("a cage edge or face at '" + handle.name +
          "' must have two or three different cage vertices");
      }
    }
  }
  return {};
}
} // namespace

bool has_bones(const Handles& handles)
{
  return std::any_of(handles.begin(), handles.end(),
    [](const Handle& handle) { return handle.kind == HandleKind::bone; });
}

std::string quoted_names(const Handles& handles, const std::vector<Index>& list)
{
  std::string names;
  for (const Index h : list)
  {
    names += (names.empty() ? "'" : ", '") + handles[static_cast<std::size_t>(h)].name + "'";
  }
  return names;
}

std::string abbreviated_names(const Handles& handles, const std::vector<Index>& list)
{
  constexpr std::size_t maximum = 3;
  if (list.size() <= maximum + 1)
  {
    return quoted_names(handles, list);
  }
  return quoted_names(handles, { list.begin(), list.begin() + maximum }) + " and " +
    std::to_string(list.size() - maximum) + " more";
}

Handles to_frame(const WorkingFrame& frame, Handles handles)
{
  for (Handle& handle : handles)
  {
    handle.head = frame.point_to_frame(handle.head);
    handle.tail = frame.point_to_frame(handle.tail);
  }
  return handles;
}

Handles from_frame(const WorkingFrame& frame, Handles handles)
{
  for (Handle& handle : handles)
  {
    handle.head = frame.point_from_frame(handle.head);
    handle.tail = frame.point_from_frame(handle.tail);
  }
  return handles;
}

Status check_handles(const Handles& handles)
{
  if (handles.empty())
  {
    return Status::invalid_input("the input has no handles");
  }
  std::set<std::string> names;
  Box box;
  for (const Handle& handle : handles)
  {
    if (handle.name.empty())
    {
      return Status::invalid_input("every handle must have a name");
    }
    const std::string error = find_text_error(handle.name);
    if (!error.empty())
    {
      return Status::invalid_input("the name of handle " + std::to_string(names.size()) +
        " contains " + error + "; names must be UTF-8 without control characters");
    }
    if (!names.insert(handle.name).second)
    {
      return Status::invalid_input("two handles are named '" + handle.name + "'");
    }
    if (!handle.head.allFinite() || !handle.tail.allFinite())
    {
      return Status::invalid_input(
        "handle '" + handle.name + "' has a coordinate that is not a finite number");
    }
    // All coordinates of shapes that WorkingFrame::choose() accepts are below this limit, and
    // squares of coordinates up to this limit are finite.
    constexpr double largest_coordinate = 1e120;
    const double largest =
      std::max(handle.head.cwiseAbs().maxCoeff(), handle.tail.cwiseAbs().maxCoeff());
    if (largest > largest_coordinate)
    {
      return Status::invalid_input("handle '" + handle.name + "' has the coordinate " +
        short_number(largest) + "; expected at most 1e120");
    }
    if (handle.kind == HandleKind::bone && handle.head == handle.tail)
    {
      return Status::invalid_input("bone '" + handle.name + "' has length zero");
    }
    box.add(handle.head);
    box.add(handle.tail);
  }
  const double coincidence_tolerance = 1e-9 * box.diagonal();
  for (std::size_t i = 0; i < handles.size(); ++i)
  {
    for (std::size_t j = i + 1; j < handles.size(); ++j)
    {
      const Handle& a = handles[i];
      const Handle& b = handles[j];
      // Handles of different kinds may have the same position, for example a point and a cage
      // vertex. Regions are identified by their labels, not by their positions.
      if (a.kind != b.kind || a.kind == HandleKind::region || a.kind == HandleKind::cage_element)
      {
        continue;
      }
      const bool same_direction = (a.head - b.head).norm() <= coincidence_tolerance &&
        (a.tail - b.tail).norm() <= coincidence_tolerance;
      const bool opposite_direction = (a.head - b.tail).norm() <= coincidence_tolerance &&
        (a.tail - b.head).norm() <= coincidence_tolerance;
      if (same_direction || opposite_direction)
      {
        return Status::invalid_input(
          "handles '" + a.name + "' and '" + b.name + "' have the same position");
      }
    }
  }
  const Status parents = check_parents(handles);
  return parents.ok() ? check_cages(handles) : parents;
}

Status check_regions(const Handles& handles, const std::vector<Index>& region_ids, Index vertices)
{
  if (!region_ids.empty() && static_cast<Index>(region_ids.size()) != vertices)
  {
    return Status::invalid_input("there are " + std::to_string(region_ids.size()) +
      " region labels, but " + std::to_string(vertices) + " vertices");
  }
  for (const Handle& handle : handles)
  {
    if (handle.kind != HandleKind::region)
    {
      continue;
    }
    if (handle.region_id <= 0)
    {
      return Status::invalid_input(
        "region '" + handle.name + "' has no label (its RegionId must be positive)");
    }
    if (region_ids.empty())
    {
      return Status::invalid_input("region '" + handle.name +
        "' needs a point array of labels on the mesh, but there is none");
    }
    if (std::find(region_ids.begin(), region_ids.end(), handle.region_id) == region_ids.end())
    {
      return Status::invalid_input("region '" + handle.name +
        "': no vertex of the mesh has the label " + std::to_string(handle.region_id));
    }
  }
  return {};
}

} // namespace bindpose
