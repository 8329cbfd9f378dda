#ifndef bindpose_surface_covered_openings_h
#define bindpose_surface_covered_openings_h

#include "base/execution.h"
#include "surface/part_links.h"

namespace bindpose
{

/// The openings of a surface that other parts of the surface cover.
///
/// Modelers omit faces that are not visible. For example, a knob that stands on a plate has no
/// bottom. The boundary of the opening then lies on the plate, and the two parts are meant to be
/// connected, although they have no vertex in common.
struct CoveredOpenings
{
  Index count = 0;
  /// Links between the boundaries of these openings and the parts that cover the openings.
  std::vector<PartLink> links;
};

/// Find the covered openings of a surface. An opening is a set of connected boundary edges, which
/// are edges with one triangle. It is covered if the distance of its boundary edges from the other
/// parts is nowhere above `touch_distance`, and nowhere above 1/50 of the diagonal of the opening's
/// bounding box. The second limit excludes parts that are smaller than the gaps between them, like
/// the leaves of a tree. Boundary edges are tested, and linked, at both ends and at samples that
/// are at most `spacing` apart.
///
/// The result is the same for any number of threads. Cost: O(n log n) for n triangles, and about
/// 5 us per sample.
/// @param triangles triangles of a welded surface: equal points have the same vertex id.
/// @param parts #F: part of each triangle. Triangles with a common vertex are in the same part.
/// @return invalid_input if the touch distance is negative or the spacing is not positive.
Status find_covered_openings(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const std::vector<Index>& parts, const PartLinkOptions& options, CoveredOpenings& result);

} // namespace bindpose

#endif
