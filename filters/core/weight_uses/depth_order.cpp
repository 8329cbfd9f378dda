// Depth is measured relative to the first handle's layer (see depth_order.h). If all layers are
// equal, the relative depth is exactly zero, so all depths are exactly equal.
#include "weight_uses/depth_order.h"

#include "base/parallel.h"

#include <cmath>
#include <string>

namespace bindpose
{

namespace
{
constexpr Index samples_per_block = 4096;
}

Status depth_order(ExecutionContext& context, WeightsView weights, const Eigen::VectorXd& layers,
  const DepthOrderOptions& options, DepthOrder& result)
{
  const Index rows = weights.rows(), handles = weights.cols();
  if (handles != layers.size() || handles == 0)
  {
    return Status::invalid_input("the weights have " + std::to_string(handles) +
      " columns, but there are " + std::to_string(layers.size()) + " layers");
  }
  for (Index j = 0; j < handles; ++j)
  {
    if (!std::isfinite(layers[j]))
    {
      return Status::invalid_input(
        "the layer of handle " + std::to_string(j) + " is not a finite number");
    }
  }
  if (!(options.tie_offset >= 0.0) || !std::isfinite(options.tie_offset))
  {
    return Status::invalid_input("'tie', the offset that orders handles of equal layers, must be a "
                                 "finite number of at least 0");
  }
  const Eigen::VectorXd relative_layers = layers.array() - layers[0];
  const Eigen::VectorXd rank =
    Eigen::VectorXd::LinSpaced(handles, 0.0, handles > 1 ? options.tie_offset : 0.0);
  result.depth.setZero(rows);
  result.front.setZero(rows);
  const double not_finite_count = parallel_sum(context, rows, samples_per_block,
    [&](Index begin, Index end)
    {
      double not_finite = 0.0;
      for (Index v = begin; v < end; ++v)
      {
        const double sum = weights.row(v).sum();
        if (!std::isfinite(sum))
        {
          not_finite += 1.0;
        }
        else if (std::abs(sum) > 1e-12)
        {
          result.depth[v] = layers[0] + weights.row(v).dot(relative_layers) / sum;
          result.front[v] = result.depth[v] + weights.row(v).dot(rank) / sum;
        }
      }
      return not_finite;
    });
  if (context.canceled())
  {
    return Status::canceled();
  }
  if (not_finite_count > 0.0)
  {
    Index first = 0;
    while (std::isfinite(weights.row(first).sum()))
    {
      ++first;
    }
    return Status::invalid_input(
      "a weight of vertex " + std::to_string(first) + " is not a finite number");
  }
  Status status;
  status.report.set("least_depth", rows > 0 ? result.depth.minCoeff() : 0.0);
  status.report.set("largest_depth", rows > 0 ? result.depth.maxCoeff() : 0.0);
  return status;
}

} // namespace bindpose
