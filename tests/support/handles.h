#ifndef bindpose_tests_support_handles_h
#define bindpose_tests_support_handles_h

// Handles for tests, one function per handle type.

#include "handles/handles.h"

#include <string>
#include <vector>

namespace bindpose::test
{

inline Handle point_handle(const std::string& name, const Vec3& at)
{
  Handle handle;
  handle.name = name;
  handle.head = handle.tail = at;
  return handle;
}

/// Return point handles with the names p1, p2, …
inline Handles point_handles(const std::vector<Vec3>& positions)
{
  Handles handles;
  for (const Vec3& position : positions)
  {
    handles.push_back(point_handle("p" + std::to_string(handles.size() + 1), position));
  }
  return handles;
}

inline Handle bone_handle(
  const std::string& name, const Vec3& head, const Vec3& tail, Index parent = -1)
{
  Handle handle;
  handle.name = name;
  handle.kind = HandleKind::bone;
  handle.head = head;
  handle.tail = tail;
  handle.parent = parent;
  return handle;
}

inline Handle cage_vertex_handle(const std::string& name, const Vec3& at)
{
  Handle handle = point_handle(name, at);
  handle.kind = HandleKind::cage_vertex;
  return handle;
}

inline Handle region_handle(const std::string& name, Index label, const Vec3& pivot = Vec3::Zero())
{
  Handle handle = point_handle(name, pivot);
  handle.kind = HandleKind::region;
  handle.region_id = label;
  return handle;
}

} // namespace bindpose::test

#endif
