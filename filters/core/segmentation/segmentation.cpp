// Labels of tets from their winding numbers, by a threshold or by a graph cut (Jacobson, Kavan,
// Sorkine-Hornung 2013; graph_cut.h).
#include "segmentation/segmentation.h"

#include "base/range_check.h"
#include "geometry/tet_facets.h"
#include "segmentation/graph_cut.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
double area(PointsView points, const TetFacet& facet)
{
  const Vec3 a = points.row(facet.vertices[0]);
  const Vec3 b = points.row(facet.vertices[1]);
  const Vec3 c = points.row(facet.vertices[2]);
  return 0.5 * (b - a).cross(c - a).norm();
}

CutEnergy build_energy(
  PointsView points, TetsView tets, const Eigen::VectorXd& w, const SegmentationOptions& options)
{
  CutEnergy energy;
  for (Index t = 0; t < tets.rows(); ++t)
  {
    const double shifted = w[t] - options.winding_threshold + 0.5;
    energy.outside_costs.push_back(std::max(shifted, 0.0));
    energy.inside_costs.push_back(std::max(1.0 - shifted, 0.0));
  }
  const std::vector<TetFacet> facets = tet_facets(tets);
  double sum = 0.0;
  for (std::size_t f = 1; f < facets.size(); ++f)
  {
    if (facets[f].vertices == facets[f - 1].vertices)
    {
      const Index i = facets[f - 1].tet;
      const Index j = facets[f].tet;
      const double size = area(points, facets[f]);
      const double jump = (w[i] - w[j]) / options.cut_sigma;
      sum += size;
      energy.edges.push_back(
        { i, j, options.cut_smoothness * size * std::exp(-0.5 * jump * jump) });
    }
  }
  const double mean = sum / static_cast<double>(std::max<std::size_t>(1, energy.edges.size()));
  for (CutEnergy::Edge& edge : energy.edges)
  {
    edge.cost = mean > 0.0 ? edge.cost / mean : 0.0;
  }
  return energy;
}
} // namespace

const char* to_string(SegmentationMethod method)
{
  return method == SegmentationMethod::graph_cut ? "graph-cut" : "threshold";
}

Status check_options(const SegmentationOptions& options)
{
  for (const Status& status : { check_positive("winding_threshold", options.winding_threshold),
         check_not_negative("cut_smoothness", options.cut_smoothness),
         check_positive("cut_sigma", options.cut_sigma) })
  {
    if (!status.ok())
    {
      return status;
    }
  }
  return {};
}

Status segment_tets(ExecutionContext& context, PointsView points, TetsView tets,
  const Eigen::VectorXd& winding_numbers, const SegmentationOptions& options, Segmentation& result)
{
  result = Segmentation();
  const Status valid = check_options(options);
  if (!valid.ok())
  {
    return valid;
  }
  std::vector<char> threshold_labels(static_cast<std::size_t>(tets.rows()));
  for (Index t = 0; t < tets.rows(); ++t)
  {
    threshold_labels[t] = winding_numbers[t] >= options.winding_threshold;
  }
  result.inside = threshold_labels;
  if (options.method == SegmentationMethod::threshold)
  {
    return {};
  }
  const CutEnergy energy = build_energy(points, tets, winding_numbers, options);
  Status status = minimize(context, energy, result.inside);
  if (!status.ok())
  {
    return status;
  }
  result.threshold_energy = energy.evaluate(threshold_labels);
  result.energy = energy.evaluate(result.inside);
  if (result.energy >= result.threshold_energy)
  {
    // If the graph cut does not lower the energy, use the labels of method threshold, because they
    // follow directly from the winding numbers.
    result.inside = threshold_labels;
    result.energy = result.threshold_energy;
  }
  for (Index t = 0; t < tets.rows(); ++t)
  {
    result.changed += result.inside[t] != threshold_labels[t];
  }
  return {};
}

} // namespace bindpose
