#ifndef bindpose_inside_graph_cut_h
#define bindpose_inside_graph_cut_h

#include "base/execution.h"
#include "base/mesh.h"

#include <vector>

namespace bindpose
{

/// A sum of costs over nodes that are each inside or outside:
/// E = sum of the costs of the labels + sum of edges[].cost over edges whose ends differ.
struct CutEnergy
{
  struct Edge
  {
    Index a, b; ///< nodes, a != b
    double cost; ///< when the two ends differ, >= 0
  };
  std::vector<double> inside_costs; ///< of node i when it is inside, >= 0
  std::vector<double> outside_costs; ///< of node i when it is outside, >= 0
  std::vector<Edge> edges; ///< several between two nodes add up

  /// E of given labels (1 inside, 0 outside).
  double of(const std::vector<char>& inside) const;
};

/// The labels of least energy, by maximum flow (Boykov, Kolmogorov, An Experimental Comparison of
/// Min-Cut/Max-Flow Algorithms for Energy Minimization in Vision, 2004). Exact for costs rounded to
/// 2^-40 of their sum; among equals the one with the fewest nodes inside. About 1 us a node and
/// edge where costs decide early, ten times that where they hardly differ.
/// @return invalid_input for costs that are negative or not finite and for nodes out of range;
/// cancelled.
Status minimize(const CutEnergy& energy, std::vector<char>& inside, ExecutionContext& context);

} // namespace bindpose

#endif
