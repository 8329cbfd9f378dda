// Interpolate rows of weights at arbitrary points (see transfer.h).
#include "transfer/transfer.h"

#include "base/parallel.h"
#include "geometry/simplex_locator.h"

#include <memory>

namespace bindpose
{

Status transfer(ExecutionContext& context, const Domain& mesh, WeightsView values,
  PointsView points, const TransferOptions& options, Weights& result, TransferCounts& counts)
{
  counts = {};
  if (mesh.element_count() == 0)
  {
    return Status::invalid_input("the mesh with weights has neither tets nor triangles");
  }
  const Status valid =
    mesh.is_volume() ? check_mesh(mesh.points, mesh.tets) : check_mesh(mesh.points, mesh.triangles);
  if (!valid.ok())
  {
    return valid;
  }
  if (values.rows() != mesh.points.rows())
  {
    return Status::invalid_input("the weights have " + std::to_string(values.rows()) +
      " rows, but there are " + std::to_string(mesh.points.rows()) + " vertices");
  }
  const SimplexLocator locator = mesh.is_volume() ? SimplexLocator(mesh.points, mesh.tets)
                                                  : SimplexLocator(mesh.points, mesh.triangles);
  Box box;
  for (Index e = 0; e < mesh.element_count(); ++e)
  {
    for (int k = 0; k < mesh.corners(); ++k)
    {
      box.add(mesh.points.row(mesh.element(e)[k]));
    }
  }
  const double coincident = options.coincident * box.diagonal();
  const double reach = options.reach * box.diagonal();
  enum PointClass : char
  {
    exact,
    inside,
    outside,
    beyond
  };
  std::vector<char> point_class(static_cast<std::size_t>(points.rows()), beyond);
  std::vector<double> distances(static_cast<std::size_t>(points.rows()), 0.0);
  result = Weights::Zero(points.rows(), values.cols());
  const bool completed = parallel_for(context, points.rows(), 512,
    [&](Index begin, Index end)
    {
      for (Index i = begin; i < end; ++i)
      {
        const Vec3 p = points.row(i);
        const SimplexLocation at = locator.locate(p);
        if (at.element < 0)
        {
          continue;
        }
        const Index* ids = mesh.element(at.element);
        distances[i] = at.distance;
        point_class[i] = at.distance > reach ? beyond : at.distance > coincident ? outside : inside;
        for (int k = 0; k < mesh.corners(); ++k)
        {
          if (point_class[i] == inside &&
            (mesh.points.row(ids[k]).transpose() - p).norm() <= coincident)
          {
            point_class[i] = exact;
            result.row(i) = values.row(ids[k]);
          }
        }
        for (int k = 0; k < mesh.corners() && point_class[i] != exact; ++k)
        {
          result.row(i) += at.barycentric[k] * values.row(ids[k]);
        }
      }
    });
  if (!completed)
  {
    return Status::canceled();
  }
  for (Index i = 0; i < points.rows(); ++i)
  {
    counts.exact += point_class[i] == exact;
    counts.barycentric += point_class[i] == inside;
    counts.nearest += point_class[i] == outside;
    counts.misses += point_class[i] == beyond;
    counts.largest_distance = std::max(counts.largest_distance, distances[i]);
  }
  Status status;
  Report& report = status.report;
  report.set("transfer", transfer_word(counts));
  report.set("counts.transferred_exact", Report::Value(counts.exact));
  report.set("counts.transferred_barycentric", Report::Value(counts.barycentric));
  report.set("counts.transferred_nearest", Report::Value(counts.nearest));
  report.set("counts.transfer_misses", Report::Value(counts.misses));
  report.set("transfer_largest_distance", Report::Value(counts.largest_distance));
  if (counts.misses > 0)
  {
    status.warnings.push_back(std::to_string(counts.misses) + " of " +
      std::to_string(points.rows()) +
      " points are far from the mesh with weights and get the weights of its nearest point");
  }
  return status;
}

const char* transfer_word(const TransferCounts& counts)
{
  const bool has_inexact = counts.barycentric + counts.nearest + counts.misses > 0;
  return counts.exact == 0 ? "barycentric" : has_inexact ? "mixed" : "exact";
}

} // namespace bindpose
