#ifndef bindpose_planar_image_outline_h
#define bindpose_planar_image_outline_h

#include "base/execution.h"
#include "winding/curve_winding_number.h"

#include <functional>

namespace bindpose
{

/// Callback that writes one row of an image's alpha to `values`, #columns values in [0, 1]. Row 0
/// is at y = 0. The callback is called once per row, in ascending order. A value that is not finite
/// counts as 0.
using AlphaRow = std::function<void(Index row, float* values)>;

/// Options of image_outline().
struct ImageOutlineOptions
{
  double threshold = 0.5; ///< in (0, 1]; a pixel is inside if its alpha is at least this
  /// Maximum distance between the simplified outline and the contour, 0 … 1 pixels. 0 keeps every
  /// contour point.
  double simplify = 0.5;
};

/// The result of image_outline(): closed curves, counter-clockwise around the inside and clockwise
/// around holes.
struct ImageOutline
{
  /// #V x 2, in pixels: the center of pixel (column, row) has the coordinates (column, row).
  PlanePoints points;
  /// #V x 2: edges of the curves; each vertex is the start of one edge and the end of another.
  Segments segments;
};

/// Compute the outline of an image from its alpha: a contour by marching squares, then simplified.
///
/// - **Contour**: vertices are between the centers of neighboring pixels, where the interpolated
///   alpha crosses the threshold. Alpha is 0 outside of the image, so the outline of an opaque
///   image is half a pixel outside of its outer pixel centers. If two inside pixels touch only at a
///   corner, the saddle point of the bilinear interpolation decides whether they are connected.
/// - **Simplification**: a vertex is removed under two conditions. All contour points between its
///   two neighbors must be within the tolerance of the line between the neighbors. The triangle of
///   the vertex and its neighbors must contain no other vertex. Loops therefore never cross or
///   touch themselves or each other, and no loop is removed.
///
/// Report: counts.pixels, counts.inside_pixels, counts.contour_points, counts.outline_points,
/// counts.loops. Return invalid_input if there are no pixels or no inside pixels, if the threshold
/// or the tolerance is out of range, or if the outline has more than 2^25 contour points.
/// Cost: 5 ns per pixel and 1 us per contour point.
Status image_outline(ExecutionContext& context, Index columns, Index rows, const AlphaRow& alpha,
  const ImageOutlineOptions& options, ImageOutline& outline);

} // namespace bindpose

#endif
