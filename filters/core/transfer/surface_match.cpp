// Match the points of one surface to the nearest points of another (see surface_match.h).
#include "transfer/surface_match.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
/// Return the triangles of a domain: its own triangles, or the boundary of its tets.
Triangles surface_of(const Domain& domain)
{
  return domain.is_volume() ? boundary_triangles(domain.tets) : domain.triangles;
}

/// Return the vertex normals of a domain, computed in a frame in which squares of lengths neither
/// overflow nor underflow.
Status normals_of(
  const Domain& domain, const std::string& subject, const Triangles& triangles, Points& normals)
{
  WorkingFrame frame;
  const Status status = choose_working_frame(domain, subject, frame);
  if (status.ok())
  {
    normals = vertex_normals(frame.to_frame(domain.points), triangles);
  }
  return status;
}
} // namespace

Eigen::RowVectorXd SurfaceMatch::row(WeightsView values, Index point) const
{
  const SimplexLocation& at = this->nearest[point];
  Eigen::RowVectorXd result = Eigen::RowVectorXd::Zero(values.cols());
  for (int k = 0; k < 3 && at.element >= 0; ++k)
  {
    if (at.barycentric[k] != 0.0)
    {
      result += at.barycentric[k] * values.row(this->triangles(at.element, k));
    }
  }
  return result;
}

Points vertex_normals(PointsView points, TrianglesView triangles)
{
  Points normals = Points::Zero(points.rows(), 3);
  for (Index f = 0; f < triangles.rows(); ++f)
  {
    Vec3 corners[3];
    for (int k = 0; k < 3; ++k)
    {
      corners[k] = points.row(triangles(f, k));
    }
    const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double length = normal.norm();
    if (!(length > 0.0))
    {
      continue;
    }
    for (int k = 0; k < 3; ++k)
    {
      const Vec3 a = corners[(k + 1) % 3] - corners[k];
      const Vec3 b = corners[(k + 2) % 3] - corners[k];
      const double angle = std::atan2(length, a.dot(b));
      normals.row(triangles(f, k)) += (angle / length * normal).transpose();
    }
  }
  for (Index v = 0; v < normals.rows(); ++v)
  {
    const double length = normals.row(v).norm();
    // Opposite triangles cancel each other up to rounding.
    constexpr double smallest_sum = 1e-9;
    normals.row(v) /= length > smallest_sum ? length : 1.0;
    if (length <= smallest_sum)
    {
      normals.row(v).setZero();
    }
  }
  return normals;
}

Status match_surface(ExecutionContext& context, const Domain& source, const Domain& target,
  const SurfaceMatchOptions& options, SurfaceMatch& match)
{
  match = {};
  if (!(options.maximum_distance >= 0.0 && std::isfinite(options.maximum_distance)))
  {
    return Status::invalid_input("the maximum distance must be a number of at least 0 (got " +
      std::to_string(options.maximum_distance) + ")");
  }
  if (!(options.maximum_angle >= 0.0 && options.maximum_angle <= 180.0))
  {
    return Status::invalid_input("the maximum angle must be from 0 to 180 degrees (got " +
      std::to_string(options.maximum_angle) + ")");
  }
  if (source.element_count() == 0)
  {
    return Status::invalid_input("the source mesh has neither tets nor triangles");
  }
  match.triangles = surface_of(source);
  if (match.triangles.rows() == 0)
  {
    return Status::invalid_input("the tets of the source mesh have no surface");
  }
  Points source_normals;
  Points target_normals;
  Status status = normals_of(source, "the source mesh", match.triangles, source_normals);
  status = status.ok() ? normals_of(target, "the target mesh", surface_of(target), target_normals)
                       : status;
  if (!status.ok())
  {
    return status;
  }
  const Weights normals_as_rows = source_normals; // the type that SurfaceMatch::row() interpolates
  const SimplexLocator locator(source.points, match.triangles);
  match.diagonal = bounding_box(source.points, match.triangles).diagonal();
  const double largest_distance = options.maximum_distance * match.diagonal;
  const bool ignore_normals = options.maximum_angle == 180.0;
  const double least_cosine = std::cos(options.maximum_angle * EIGEN_PI / 180.0);
  match.nearest.resize(static_cast<std::size_t>(target.points.rows()));
  match.matched.assign(match.nearest.size(), 0);
  const bool completed = parallel_for(context, target.points.rows(), 512,
    [&](Index begin, Index end)
    {
      for (Index i = begin; i < end; ++i)
      {
        const SimplexLocation at = locator.locate(target.points.row(i));
        match.nearest[i] = at;
        if (at.element < 0 || at.distance > largest_distance)
        {
          continue;
        }
        const Vec3 here = target_normals.row(i);
        const Vec3 there = match.row(normals_as_rows, i);
        match.matched[i] = ignore_normals ||
          (!here.isZero() && !there.isZero() && here.dot(there.normalized()) >= least_cosine);
      }
    });
  return completed ? status : Status::canceled();
}

} // namespace bindpose
