#ifndef bindpose_segmentation_graph_cut_h
#define bindpose_segmentation_graph_cut_h

// Minimization of a binary energy by maximum flow, for the segmentation of tets.

#include "base/execution.h"
#include "geometry/mesh.h"

#include <vector>

namespace bindpose
{

/// An energy of nodes that are labeled inside or outside:
///   E = sum of the costs of the labels
///     + sum of edges[].cost over all edges between nodes with different labels.
struct CutEnergy
{
  struct Edge
  {
    Index a, b; ///< nodes, a != b
    double cost; ///< cost (>= 0) that is added if a and b have different labels
  };
  std::vector<double> inside_costs; ///< cost (>= 0) of node i if its label is inside
  std::vector<double> outside_costs; ///< cost (>= 0) of node i if its label is outside
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
/// @return ok; canceled; or invalid_input if the numbers of inside and outside costs differ, if a
/// cost is negative or not finite, or if an edge does not connect two different nodes in range.
Status minimize(ExecutionContext& context, const CutEnergy& energy, std::vector<char>& inside);

} // namespace bindpose

#endif
