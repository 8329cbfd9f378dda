#ifndef bindpose_pose_weight_clusters_h
#define bindpose_pose_weight_clusters_h

#include "base/execution.h"
#include "base/mesh.h"

#include <vector>

namespace bindpose
{

// Weight space: a vertex is the point whose coordinates are its row of weights.

/// Farthest-point sampling: appends `count` rows to the seeds, each the one farthest from all seeds
/// so far (the lowest of equals); without seeds the first is the row of the largest norm. Ends
/// early when every row equals a seed. Cost: #rows x #columns a seed.
void farthest_rows(
  ExecutionContext& context, WeightsView rows, Index count, std::vector<Index>& seeds);

/// For each handle the vertex of its largest weight (the lowest of equals).
std::vector<Index> handle_rows(WeightsView weights);

struct Clusters
{
  Index count = 0;
  std::vector<Index> of_row; ///< #rows labels from 0, none empty
};

/// k-means: farthest-point seeds, then Lloyd's iteration (at most 100 rounds, ends when fewer than
/// one row in a thousand moves). Large inputs are clustered on max(5000, 50 count) of their rows,
/// and all rows then go to the nearest mean. Fewer clusters come back when there are fewer
/// different rows. False when cancelled.
bool cluster_rows(ExecutionContext& context, WeightsView rows, Index count, Clusters& clusters);

/// #rows x count extra weights that widen the space of deformations: cubic B-spline bumps of the
/// distance in weight space around farthest points, seeded by the handles' own rows. A bump's
/// radius is twice the distance to the nearest other seed, but no more than to the nearest handle
/// row: at the handles all bumps vanish. Fewer columns when there are fewer different rows.
/// Jacobson et al. 2012, Fast automatic skinning transformations.
Weights spline_bumps(ExecutionContext& context, WeightsView weights, Index count);

} // namespace bindpose

#endif
