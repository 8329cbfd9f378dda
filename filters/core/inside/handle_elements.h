#ifndef bindpose_inside_handle_elements_h
#define bindpose_inside_handle_elements_h

#include "geometry/mesh.h"
#include "winding/curve_winding_number.h"

#include <functional>

namespace bindpose
{

/// Points, segments and triangles of handles, at which a mesher creates vertices.
struct HandleElements
{
  Points points; ///< #H x 3: point handles, ends of bones, vertices of cages
  Segments segments; ///< #S x 2: bones, edges of cages
  Triangles triangles; ///< #C x 3: faces of cages

  bool empty() const { return this->points.rows() == 0; }
};

/// Return invalid_input for coordinates that are not finite and for ids out of range.
Status check_handle_elements(const HandleElements& handle_elements);

/// Result of sample_handle_elements().
struct HandleSamples
{
  Points points; ///< the handles' points first, then the samples; no duplicates
  Index handle_point_count = 0; ///< number of the handles' points at the start of `points`
};

/// Return the handles' points, followed by sample points on the handles' segments (at least one per
/// segment, at most about 1,000) and triangles.
/// @param length  returns the target distance (> 0) between neighboring samples near a given point
HandleSamples sample_handle_elements(
  const HandleElements& handle_elements, const std::function<double(const Vec3&)>& length);

} // namespace bindpose

#endif
