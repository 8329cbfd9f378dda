#ifndef bindpose_segmentation_graph_cut_h
#define bindpose_segmentation_graph_cut_h

// Minimization of a binary energy by maximum flow, for the segmentation of tets.

#include "base/execution.h"
#include "geometry/mesh.h"

#include <vector>

namespace bindpose
{

/// A sum of costs over nodes that are each inside or outside: E = sum of the costs of the labels +
/// sum of edges[].cost over edges whose two ends have different labels.
struct CutEnergy
{
  struct Edge
  {
    Index a, b; ///< nodes, a != b
    double cost; ///< cost that is added if the labels of the two ends differ, >= 0
  };
  std::vector<double> inside_costs; ///< cost of node i if it is inside, >= 0
  std::vector<double> outside_costs; ///< cost of node i if it is outside, >= 0
  std::vector<Edge> edges; ///< if there are several edges between two nodes, their costs add up

  /// Return the energy E of these labels (1 inside, 0 outside).
  double evaluate(const std::vector<char>& inside) const;
};

/// Compute the labels with minimum energy by maximum flow (Boykov, Kolmogorov, An Experimental
/// Comparison of Min-Cut/Max-Flow Algorithms for Energy Minimization in Vision, 2004). The result
/// is exact for costs rounded to 2^-40 of their sum. If several labelings have the minimum energy,
/// the one with the fewest nodes inside is returned. Cost: about 1 us per node and edge if the two
/// costs of most nodes differ by more than the costs of their edges; ten times that if the two
/// costs are almost equal.
/// @return invalid_input for costs that are negative or not finite and for nodes out of range;
/// canceled.
Status minimize(ExecutionContext& context, const CutEnergy& energy, std::vector<char>& inside);

} // namespace bindpose

#endif
