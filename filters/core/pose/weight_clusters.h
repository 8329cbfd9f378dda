#ifndef bindpose_pose_weight_clusters_h
#define bindpose_pose_weight_clusters_h

#include "base/execution.h"
#include "base/mesh.h"

#include <vector>

namespace bindpose
{

// Weight space: the coordinates of a vertex are its row of weights.

/// Append `count` rows to the seeds by farthest-point sampling. Each is the row farthest from all
/// seeds so far (the lowest of equal ones). Without seeds, the first is the row of the largest
/// norm. The sampling ends early if every row equals a seed. Cost: #rows x #columns per seed.
void farthest_rows(
  ExecutionContext& context, WeightsView rows, Index count, std::vector<Index>& seeds);

/// Return for each handle the vertex of its largest weight (the lowest of equal ones).
std::vector<Index> handle_rows(WeightsView weights);

struct Clusters
{
  Index count = 0;
  std::vector<Index> of_row; ///< #rows labels from 0, none empty
};

/// Cluster rows by k-means: farthest-point seeds, then Lloyd's iteration (at most 100 rounds; it
/// ends if fewer than one row in a thousand changes its cluster). Large inputs are clustered on
/// max(5000, 25 count) of their rows, and then all rows are assigned to the nearest mean. The
/// result has fewer clusters if there are fewer different rows. Return false if the context is
/// canceled.
bool cluster_rows(ExecutionContext& context, WeightsView rows, Index count, Clusters& clusters);

/// Return #rows x count extra weights that extend the space of deformations. They are cubic
/// B-spline bumps of the distance in weight space around farthest points, seeded by the handles'
/// own rows. A bump's radius is twice the distance to the nearest other seed, but at most the
/// distance to the nearest handle row. All bumps therefore vanish at the handles. The result has
/// fewer columns if there are fewer different rows. Jacobson et al. 2012, Fast automatic skinning
/// transformations.
Weights spline_bumps(ExecutionContext& context, WeightsView weights, Index count);

} // namespace bindpose

#endif
