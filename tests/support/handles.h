#ifndef bindpose_tests_support_handles_h
#define bindpose_tests_support_handles_h

// Handles for tests, one function per handle type.

#include "weights/handles.h"

namespace bindpose::test
{

inline Handle point_handle(const std::string& name, const Vec3& at)
{
  Handle handle;
  handle.name = name;
  handle.head = handle.tail = at;
  return handle;
}

inline Handle bone_handle(const std::string& name, const Vec3& head, const Vec3& tail)
{
  Handle handle;
  handle.name = name;
  handle.kind = HandleKind::bone;
  handle.head = head;
  handle.tail = tail;
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
