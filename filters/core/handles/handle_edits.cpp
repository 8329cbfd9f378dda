// Edits of a handle list (see handle_edits.h). Every edit copies the list, changes the copy and
// checks it. A failed edit has no effect.
#include "handles/handle_edits.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <map>
#include <utility>

namespace bindpose
{
namespace
{
EditedHandles copy_unedited(const Handles& handles)
{
  EditedHandles edited;
  edited.handles = handles;
  for (std::size_t i = 0; i < handles.size(); ++i)
  {
    edited.source.push_back(static_cast<Index>(i));
  }
  edited.copied_from = edited.source;
  return edited;
}

/// Return the edited handles if they are valid, else the handles before the edit.
Status finish(const Handles& before, EditedHandles edited, EditedHandles& after)
{
  Status status = edited.handles.empty() ? Status() : check_handles(edited.handles);
  after = status.ok() ? std::move(edited) : copy_unedited(before);
  return status;
}

Status refuse(const Handles& before, EditedHandles& after, const std::string& reason)
{
  after = copy_unedited(before);
  return Status::invalid_input(reason);
}

bool is_valid_index(const Handles& handles, Index handle_index)
{
  return handle_index >= 0 && handle_index < static_cast<Index>(handles.size());
}

std::string missing_handle_message(Index handle_index)
{
  return "handle " + std::to_string(handle_index) + " does not exist";
}

bool has_name(const Handles& handles, const std::string& name)
{
  return std::any_of(
    handles.begin(), handles.end(), [&](const Handle& handle) { return handle.name == name; });
}

std::vector<Index> selected_or_all(const Handles& handles, const std::vector<Index>& handle_indices)
{
  return handle_indices.empty() ? copy_unedited(handles).source : handle_indices;
}

double extent(const Handles& handles)
{
  Box box;
  for (const Handle& handle : handles)
  {
    box.add(handle.head);
    box.add(handle.tail);
  }
  return box.diagonal();
}

Vec3& end_of(Handles& handles, const HandleEnd& end)
{
  Handle& handle = handles[static_cast<std::size_t>(end.handle)];
  return end.tail ? handle.tail : handle.head;
}

bool same_corners(const CageElement& a, CageElement b)
{
  CageElement sorted = a;
  std::sort(sorted.begin(), sorted.end());
  std::sort(b.begin(), b.end());
  return sorted == b;
}

bool has_element(const Handles& handles, const CageElement& element)
{
  return std::any_of(handles.begin(), handles.end(),
    [&](const Handle& handle)
    {
      return std::any_of(handle.cage.begin(), handle.cage.end(),
        [&](const CageElement& other) { return same_corners(element, other); });
    });
}
} // namespace

// ---- Names -------------------------------------------------------------------------------------

std::string unique_name(const Handles& handles, const std::string& requested_name, HandleKind kind)
{
  if (!requested_name.empty() && !has_name(handles, requested_name))
  {
    return requested_name;
  }
  const std::string name_prefix = kind == HandleKind::bone ? "b"
    : kind == HandleKind::cage_vertex                      ? "c"
    : kind == HandleKind::region                           ? "r"
                                                           : "p";
  for (int number = 1;; ++number)
  {
    char digits[16];
    std::snprintf(digits, sizeof(digits), ".%03d", number);
    std::string name =
      requested_name.empty() ? name_prefix + std::to_string(number) : requested_name + digits;
    if (!has_name(handles, name))
    {
      return name;
    }
  }
}

namespace
{
bool is_separator(char c)
{
  return c == '.' || c == '_' || c == '-' || c == ' ';
}

/// Return the opposite side's letter: R for L, r for l and vice versa; 0 for any other character.
char other_side(char c)
{
  return c == 'L' ? 'R' : c == 'R' ? 'L' : c == 'l' ? 'r' : c == 'r' ? 'l' : '\0';
}
} // namespace

std::string mirrored_name(const std::string& name)
{
  std::string stem = name;
  std::string number;
  const std::size_t dot = name.rfind('.');
  const auto digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  if (dot != std::string::npos && dot + 1 < name.size() &&
    std::all_of(name.begin() + static_cast<long>(dot) + 1, name.end(), digit))
  {
    stem = name.substr(0, dot);
    number = name.substr(dot);
  }
  const std::size_t size = stem.size();
  if (size >= 2 && is_separator(stem[size - 2]) && other_side(stem[size - 1]))
  {
    stem[size - 1] = other_side(stem[size - 1]);
    return stem + number;
  }
  if (size >= 2 && is_separator(stem[1]) && other_side(stem[0]))
  {
    stem[0] = other_side(stem[0]);
    return stem + number;
  }
  const std::pair<const char*, const char*> words[3] = { { "left", "right" }, { "Left", "Right" },
    { "LEFT", "RIGHT" } };
  for (const auto& [left, right] : words)
  {
    for (const auto& [from, to] : { std::pair<std::string, std::string>{ left, right },
           std::pair<std::string, std::string>{ right, left } })
    {
      if (size >= from.size() && stem.compare(size - from.size(), from.size(), from) == 0)
      {
        return stem.replace(size - from.size(), from.size(), to) + number;
      }
      if (stem.compare(0, from.size(), from) == 0)
      {
        return stem.replace(0, from.size(), to) + number;
      }
    }
  }
  return name;
}

Status rename_handle(
  const Handles& before, Index handle_index, const std::string& name, EditedHandles& after)
{
  if (!is_valid_index(before, handle_index))
  {
    return refuse(before, after, missing_handle_message(handle_index));
  }
  EditedHandles edited = copy_unedited(before);
  Handle& handle = edited.handles[static_cast<std::size_t>(handle_index)];
  if (name.empty())
  {
    return refuse(before, after, "handle '" + handle.name + "' must have a name");
  }
  if (name != handle.name && has_name(before, name))
  {
    return refuse(before, after, "another handle is named '" + name + "' already");
  }
  handle.name = name;
  return finish(before, std::move(edited), after);
}

// ---- Add, remove and link ----------------------------------------------------------------------

Status add_handle(const Handles& before, Handle handle, EditedHandles& after)
{
  EditedHandles edited = copy_unedited(before);
  handle.name = unique_name(before, handle.name, handle.kind);
  if (handle.kind != HandleKind::bone)
  {
    handle.tail = handle.head;
  }
  edited.handles.push_back(std::move(handle));
  edited.source.push_back(-1);
  edited.copied_from.push_back(-1);
  return finish(before, std::move(edited), after);
}

Status remove_handles(
  const Handles& before, const std::vector<Index>& handle_indices, EditedHandles& after)
{
  std::vector<bool> is_removed(before.size(), false);
  for (const Index h : handle_indices)
  {
    if (!is_valid_index(before, h))
    {
      return refuse(before, after, missing_handle_message(h));
    }
    is_removed[static_cast<std::size_t>(h)] = true;
  }
  std::vector<Index> number(before.size(), -1); // index after the edit; -1: removed
  EditedHandles edited;
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    if (!is_removed[i])
    {
      number[i] = static_cast<Index>(edited.handles.size());
      edited.handles.push_back(before[i]);
      edited.source.push_back(static_cast<Index>(i));
    }
  }
  for (Handle& handle : edited.handles)
  {
    while (handle.parent >= 0 && is_removed[static_cast<std::size_t>(handle.parent)])
    {
      handle.parent = before[static_cast<std::size_t>(handle.parent)].parent;
    }
    handle.parent = handle.parent < 0 ? -1 : number[static_cast<std::size_t>(handle.parent)];
    std::vector<CageElement> kept;
    for (CageElement element : handle.cage)
    {
      bool is_complete = true;
      for (Index& corner : element)
      {
        const Index new_corner = corner < 0 ? -1 : number[static_cast<std::size_t>(corner)];
        is_complete = is_complete && (corner < 0 || new_corner >= 0);
        corner = new_corner;
      }
      if (is_complete)
      {
        kept.push_back(element);
      }
    }
    handle.cage = kept;
  }
  edited.copied_from = edited.source;
  return finish(before, std::move(edited), after);
}

Status set_parent(const Handles& before, Index handle_index, Index parent, EditedHandles& after)
{
  if (!is_valid_index(before, handle_index) || (parent != -1 && !is_valid_index(before, parent)))
  {
    return refuse(before, after,
      missing_handle_message(is_valid_index(before, handle_index) ? parent : handle_index));
  }
  EditedHandles edited = copy_unedited(before);
  edited.handles[static_cast<std::size_t>(handle_index)].parent = parent;
  return finish(before, std::move(edited), after);
}

Status toggle_cage_edge(const Handles& before, Index a, Index b, EditedHandles& after)
{
  if (!is_valid_index(before, a) || !is_valid_index(before, b))
  {
    return refuse(before, after, missing_handle_message(is_valid_index(before, a) ? b : a));
  }
  EditedHandles edited = copy_unedited(before);
  const CageElement edge{ a, b, -1 };
  if (has_element(before, edge))
  {
    for (Handle& handle : edited.handles)
    {
      handle.cage.erase(std::remove_if(handle.cage.begin(), handle.cage.end(),
                          [&](const CageElement& other) { return same_corners(edge, other); }),
        handle.cage.end());
    }
  }
  else
  {
    edited.handles[static_cast<std::size_t>(a)].cage.push_back(edge);
  }
  return finish(before, std::move(edited), after);
}

// ---- Positions ---------------------------------------------------------------------------------

std::vector<HandleEnd> ends_at_joint(const Handles& handles, const HandleEnd& end)
{
  std::vector<HandleEnd> joint{ end };
  if (!is_valid_index(handles, end.handle) ||
    handles[static_cast<std::size_t>(end.handle)].kind != HandleKind::bone)
  {
    return joint;
  }
  const Handle& end_handle = handles[static_cast<std::size_t>(end.handle)];
  const Vec3& position = end.tail ? end_handle.tail : end_handle.head;
  const double same_tolerance = 1e-9 * extent(handles);
  for (std::size_t i = 0; i < handles.size(); ++i)
  {
    for (const bool tail : { false, true })
    {
      const auto number = static_cast<Index>(i);
      const Vec3& other = tail ? handles[i].tail : handles[i].head;
      if (handles[i].kind == HandleKind::bone && (other - position).norm() <= same_tolerance &&
        (number != end.handle || tail != end.tail))
      {
        joint.push_back({ number, tail });
      }
    }
  }
  return joint;
}

Status move_ends(const Handles& before, const std::vector<HandleEnd>& ends,
  const std::vector<Vec3>& positions, EditedHandles& after)
{
  EditedHandles edited = copy_unedited(before);
  for (std::size_t i = 0; i < ends.size() && i < positions.size(); ++i)
  {
    if (!is_valid_index(before, ends[i].handle))
    {
      return refuse(before, after, missing_handle_message(ends[i].handle));
    }
    for (const HandleEnd& end : ends_at_joint(before, ends[i]))
    {
      end_of(edited.handles, end) = positions[i];
      Handle& handle = edited.handles[static_cast<std::size_t>(end.handle)];
      if (handle.kind != HandleKind::bone)
      {
        handle.head = handle.tail = positions[i];
      }
    }
  }
  return finish(before, std::move(edited), after);
}

Status snap_to_surface(const Handles& before, const std::vector<Index>& handle_indices,
  const SurfaceProbe& surface, EditedHandles& after)
{
  std::vector<HandleEnd> ends;
  std::vector<Vec3> positions;
  for (const Index h : selected_or_all(before, handle_indices))
  {
    if (!is_valid_index(before, h))
    {
      return refuse(before, after, missing_handle_message(h));
    }
    const Handle& handle = before[static_cast<std::size_t>(h)];
    for (const bool tail : { false, true })
    {
      if (handle.kind == HandleKind::region || (tail && handle.kind != HandleKind::bone))
      {
        continue;
      }
      Vec3 position;
      if (!surface.nearest(tail ? handle.tail : handle.head, position))
      {
        return refuse(before, after, "the surface has no triangles to snap to");
      }
      ends.push_back({ h, tail });
      positions.push_back(position);
    }
  }
  return move_ends(before, ends, positions, after);
}

Status mirror_handles(const Handles& before, const std::vector<Index>& handle_indices,
  const Vec3& position, const Vec3& normal, EditedHandles& after)
{
  const double length = normal.norm();
  if (!(length > 0.0) || !normal.allFinite() || !position.allFinite())
  {
    return refuse(before, after, "the mirror plane must have a normal");
  }
  const Vec3 n = normal / length;
  const auto mirrored = [&](const Vec3& p) { return Vec3(p - 2.0 * n * n.dot(p - position)); };
  const double same_tolerance = 1e-9 * std::max(extent(before), 1e-300);
  const auto are_near = [&](const Vec3& a, const Vec3& b)
  { return (a - b).norm() <= same_tolerance; };
  const auto is_in_plane = [&](const Vec3& p)
  { return std::abs(n.dot(p - position)) <= same_tolerance; };

  std::map<std::string, Index> by_name;
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    by_name[before[i].name] = static_cast<Index>(i);
  }
  const std::vector<Index> list = selected_or_all(before, handle_indices);
  EditedHandles edited = copy_unedited(before);
  std::vector<Index> image(before.size(), -1); // index of each handle's mirror image; -1: none
  for (const Index h : list)
  {
    if (!is_valid_index(before, h))
    {
      return refuse(before, after, missing_handle_message(h));
    }
    const Handle& handle = before[static_cast<std::size_t>(h)];
    const bool crosses_plane =
      are_near(mirrored(handle.head), handle.tail) && are_near(mirrored(handle.tail), handle.head);
    if ((is_in_plane(handle.head) && is_in_plane(handle.tail)) || crosses_plane)
    {
      image[static_cast<std::size_t>(h)] = h;
      continue;
    }
    if (handle.kind == HandleKind::region || image[static_cast<std::size_t>(h)] >= 0)
    {
      continue;
    }
    const std::string name = mirrored_name(handle.name);
    const auto partner = by_name.find(name);
    if (name != handle.name && partner != by_name.end() &&
      before[static_cast<std::size_t>(partner->second)].kind == handle.kind)
    {
      image[static_cast<std::size_t>(h)] = partner->second;
      if (std::find(list.begin(), list.end(), partner->second) == list.end())
      {
        Handle& other = edited.handles[static_cast<std::size_t>(partner->second)];
        other.head = mirrored(handle.head);
        other.tail = mirrored(handle.tail);
      }
      continue;
    }
    // If a handle of the same kind is already at the mirrored position, that handle is used as the
    // mirror image, whatever its name.
    const auto existing_image = std::find_if(before.begin(), before.end(),
      [&](const Handle& other)
      {
        return other.kind == handle.kind && are_near(other.head, mirrored(handle.head)) &&
          are_near(other.tail, mirrored(handle.tail));
      });
    if (existing_image != before.end())
    {
      image[static_cast<std::size_t>(h)] = existing_image - before.begin();
      continue;
    }
    Handle copy = handle;
    copy.name = unique_name(edited.handles, name, handle.kind);
    copy.head = mirrored(handle.head);
    copy.tail = mirrored(handle.tail);
    copy.cage.clear();
    image[static_cast<std::size_t>(h)] = static_cast<Index>(edited.handles.size());
    edited.handles.push_back(copy);
    edited.source.push_back(-1);
    edited.copied_from.push_back(h);
  }
  for (std::size_t i = before.size(); i < edited.handles.size(); ++i)
  {
    Index& parent = edited.handles[i].parent;
    const Index other = parent < 0 ? -1 : image[static_cast<std::size_t>(parent)];
    parent = other >= 0 ? other : parent;
  }
  for (const Handle& handle : before)
  {
    for (const CageElement& element : handle.cage)
    {
      CageElement copy = element;
      bool has_all_corners = true;
      for (Index& corner : copy)
      {
        const Index other = corner < 0 ? -1 : image[static_cast<std::size_t>(corner)];
        has_all_corners = has_all_corners && (corner < 0 || other >= 0);
        corner = other;
      }
      if (has_all_corners && copy[2] >= 0)
      {
        std::swap(copy[1], copy[2]);
      }
      if (has_all_corners && !has_element(edited.handles, copy))
      {
        edited.handles[static_cast<std::size_t>(copy[0])].cage.push_back(copy);
      }
    }
  }
  return finish(before, std::move(edited), after);
}

} // namespace bindpose
