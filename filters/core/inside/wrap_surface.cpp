// Alpha wrap of a surface by the helper executable (mesher/wrap_job.cpp). The helper works in a
// normalized frame: the center is the origin and the size is about 1. This file transforms the
// surface to this frame and transforms the wrap back. It checks that the wrap is closed and has a
// volume.
#include "inside/wrap_surface.h"

#include "base/number_text.h"
#include "helper/child_process.h"
#include "helper/mesher_process.h"
#include "surface/unit_frame.h"

namespace bindpose
{

namespace
{
Status check_options(const WrapOptions& options)
{
  constexpr double least_alpha = 1e-4;
  constexpr double least_offset = 1e-6;
  if (!(options.alpha >= least_alpha && options.alpha <= 1.0))
  {
    return Status::invalid_input(
      "wrap_alpha must be from 0.0001 to 1, not " + short_number(options.alpha));
  }
  if (!(options.offset >= least_offset && options.offset <= 1.0))
  {
    return Status::invalid_input(
      "wrap_offset must be from 0.000001 to 1, not " + short_number(options.offset));
  }
  return check_limits(options.time_limit, options.memory_limit);
}
} // namespace

Status wrap_surface(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const WrapOptions& options, Points& wrap_points, Triangles& wrap_triangles)
{
  wrap_points.resize(0, 3);
  wrap_triangles.resize(0, 3);
  Status status = check_options(options);
  if (status.ok())
  {
    status = check_frame(points, triangles);
  }
  if (!status.ok())
  {
    return status;
  }
  const Box box = bounding_box(points, triangles);
  const UnitFrame frame(box);
  const double diagonal = frame.length_in_frame(box.diagonal());
  MesherRequest request;
  request.arguments = { "wrap", "--alpha", exact_number(options.alpha * diagonal), "--offset",
    exact_number(options.offset * diagonal) };
  request.time_limit = options.time_limit;
  request.memory_limit = options.memory_limit;
  MesherData input;
  input.points = frame.to_frame(points);
  input.triangles = triangles;
  MesherResult answer;
  status = run_mesher(context, request, input, answer);
  if (!status.ok())
  {
    return status;
  }
  const MesherData& wrap = answer.data;
  if (wrap.triangles.rows() == 0 || !count_edges(wrap.triangles).closed ||
    !(signed_volume(wrap.points, wrap.triangles) > 0.0))
  {
    return Status::failure(StatusCode::internal_error, "the wrap is not closed");
  }
  wrap_points = frame.from_frame(wrap.points);
  wrap_triangles = wrap.triangles;
  return {};
}

} // namespace bindpose
