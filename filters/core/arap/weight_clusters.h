#ifndef bindpose_arap_weight_clusters_h
#define bindpose_arap_weight_clusters_h

// Clusters of vertices with similar weights, and extra weights for reduced as-rigid-as-possible
// deformation (Jacobson et al. 2012).

#include "base/execution.h"
#include "geometry/mesh.h"

#include <vector>

namespace bindpose
{

// The following functions measure distances in weight space, in which the coordinates of a vertex
// are its row of weights.

/// Append up to `count` row indices to the seeds by farthest-point sampling. Each new seed is the
/// row farthest from all seeds so far (the lowest index if several are equally far). If there are
/// no seeds, the first one is the row of the largest norm. The sampling ends early if every row
/// equals a seed. Cost: #rows x #columns per seed.
void farthest_rows(
  ExecutionContext& context, WeightsView rows, Index count, std::vector<Index>& seeds);

/// Return for each handle the index of the vertex at which its weight is largest (the lowest index
/// if several weights are equal).
std::vector<Index> largest_weight_rows(WeightsView weights);

struct Clusters
{
  Index count = 0;
  std::vector<Index> cluster_of_row; ///< #rows: cluster of each row, from 0; no cluster is empty
};

/// Cluster rows by k-means: farthest-point seeds, then Lloyd's iteration (at most 100 rounds; the
/// iteration ends if fewer than one row in a thousand changes its cluster). For large inputs, the
/// means are computed from a sample of max(5000, 25 count) rows, and then all rows are assigned to
/// the nearest mean. The result has fewer clusters if there are fewer different rows. Return false
/// if the context is canceled.
bool cluster_rows(ExecutionContext& context, WeightsView rows, Index count, Clusters& clusters);

/// Return #rows x count extra weights that extend the space of deformations. Each column is a cubic
/// B-spline function ("bump") of the distance in weight space from a center. The centers are found
/// by farthest-point sampling, with the rows of the handles as first seeds. The radius of a bump is
/// twice the distance to the nearest other seed, but at most the distance to the nearest handle
/// row. Therefore all bumps are zero at the handles. The result has fewer columns if there are
/// fewer different rows. Method: Jacobson et al. 2012, Fast automatic skinning transformations.
Weights spline_bumps(ExecutionContext& context, WeightsView weights, Index count);

} // namespace bindpose

#endif
