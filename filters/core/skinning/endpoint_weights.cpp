// Endpoint weights of bones. This file solves no optimization problem itself. The methods `joints`
// and `bounded` use bounded biharmonic weights of auxiliary handles: the ends of all bones as
// points, or the two ends of one bone joined by a cage edge.
#include "skinning/endpoint_weights.h"

#include "handles/bone_projection.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>

namespace bindpose
{

namespace
{
/// Weight of the projection relative to the weights of the joints (method `joints`).
constexpr double projection_weight = 1e-4;

Handle make_endpoint_handle(const std::string& name, HandleKind kind, const Vec3& position)
{
  Handle handle;
  handle.name = name;
  handle.kind = kind;
  handle.head = handle.tail = position;
  return handle;
}

/// Merge the status of one solve into the total status: add new warnings, and copy the code and
/// message if all previous solves were ok.
void append_messages(const Status& step, Status& status)
{
  if (status.ok())
  {
    status.code = step.code;
    status.message = step.message;
  }
  for (const std::string& warning : step.warnings)
  {
    if (std::find(status.warnings.begin(), status.warnings.end(), warning) == status.warnings.end())
    {
      status.warnings.push_back(warning);
    }
  }
}

/// Point handles at the ends of all bones. Ends at the same position share one handle.
struct Joints
{
  Handles handles;
  std::map<std::array<double, 3>, Index> handle_at_position;

  Index add(const Vec3& position)
  {
    const auto [entry, fresh] = this->handle_at_position.emplace(
      std::array<double, 3>{ position[0], position[1], position[2] },
      static_cast<Index>(this->handles.size()));
    if (fresh)
    {
      this->handles.push_back(make_endpoint_handle(
        "joint " + std::to_string(entry->second), HandleKind::point, position));
    }
    return entry->second;
  }
};
} // namespace

const char* to_string(EndpointMethod method)
{
  constexpr const char* names[] = { "projection", "joints", "bounded" };
  return names[static_cast<int>(method)];
}

Status check_endpoint_weights(
  WeightsView endpoints, const Handles& handles, const std::string& array)
{
  for (Index v = 0; v < endpoints.rows(); ++v)
  {
    for (Index j = 0; j < endpoints.cols(); ++j)
    {
      const double e = endpoints(v, j);
      if (e < 0.0 || e > 1.0)
      {
        return Status::invalid_input("the array '" + array + "' has " + std::to_string(e) +
          " for handle '" + handles[static_cast<std::size_t>(j)].name + "' at point " +
          std::to_string(v) + "; expected a value from 0 (the bone's head) to 1 (its tail)");
      }
    }
  }
  return {};
}

Status endpoint_weights(ExecutionContext& context, PointsView points, const Handles& handles,
  EndpointMethod method, const BoundedSolve& solve, Weights& endpoints)
{
  endpoints = Weights::Constant(
    points.rows(), static_cast<Index>(handles.size()), std::numeric_limits<double>::quiet_NaN());
  std::vector<Index> bones;
  for (std::size_t j = 0; j < handles.size(); ++j)
  {
    if (handles[j].kind == HandleKind::bone)
    {
      bones.push_back(static_cast<Index>(j));
      for (Index v = 0; v < points.rows(); ++v)
      {
        endpoints(v, static_cast<Index>(j)) =
          fraction_along_bone(points.row(v), handles[j].head, handles[j].tail - handles[j].head);
      }
    }
  }
  if (bones.empty())
  {
    return Status::invalid_input("the handles contain no bone");
  }
  Status status;
  Index problems = 0;
  if (method == EndpointMethod::joints)
  {
    Joints joints;
    std::vector<std::array<Index, 2>> ends;
    for (const Index j : bones)
    {
      const Handle& bone = handles[static_cast<std::size_t>(j)];
      ends.push_back({ joints.add(bone.head), joints.add(bone.tail) });
    }
    Weights w;
    const Status solved = solve(context, joints.handles, w);
    if (!solved.usable())
    {
      return solved;
    }
    problems = 1;
    append_messages(solved, status);
    for (std::size_t i = 0; i < bones.size(); ++i)
    {
      const auto head = w.col(ends[i][0]).array().max(0.0);
      const auto tail = w.col(ends[i][1]).array().max(0.0);
      endpoints.col(bones[i]) = (tail + projection_weight * endpoints.col(bones[i]).array()) /
        (head + tail + projection_weight);
    }
  }
  else if (method == EndpointMethod::bounded)
  {
    for (std::size_t i = 0; i < bones.size(); ++i)
    {
      const Handle& bone = handles[static_cast<std::size_t>(bones[i])];
      Handles ends = { make_endpoint_handle(
                         "head of " + bone.name, HandleKind::cage_vertex, bone.head),
        make_endpoint_handle("tail of " + bone.name, HandleKind::cage_vertex, bone.tail) };
      ends[0].cage.push_back({ 0, 1, -1 });
      const double step = 1.0 / static_cast<double>(bones.size());
      const ProgressRange range(
        context, static_cast<double>(i) * step, static_cast<double>(i + 1) * step);
      Weights w;
      const Status solved = solve(context, ends, w);
      if (!solved.usable())
      {
        return solved;
      }
      ++problems;
      append_messages(solved, status);
      endpoints.col(bones[i]) = w.col(1).array().max(0.0).min(1.0);
    }
  }
  status.report.set("method", to_string(method));
  status.report.set("counts.bones", static_cast<Index>(bones.size()));
  status.report.set("counts.problems", problems);
  return status;
}

} // namespace bindpose
