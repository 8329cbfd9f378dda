#ifndef bindpose_inside_handle_places_h
#define bindpose_inside_handle_places_h

#include "base/mesh.h"
#include "winding/curve_winding_number.h"

#include <functional>

namespace bindpose
{

/// The geometry of handles, for a mesher that makes them part of a volume.
struct HandlePlaces
{
  Points points; ///< #H x 3: point handles, ends of bones, vertices of cages
  Segments segments; ///< #S x 2: bones, edges of cages
  Triangles triangles; ///< #C x 3: faces of cages

  bool empty() const { return this->points.rows() == 0; }
};

/// Return invalid_input for coordinates that are not finite and for ids out of range.
Status check_places(const HandlePlaces& places);

struct HandleSamples
{
  Points points; ///< each position once
  Index chosen = 0; ///< number of the handles' own points, which come first
};

/// Return the handles' points, followed by points on segments (at least one per segment) and
/// triangles. `length` returns the distance of neighboring samples at a point (> 0). A line gets at
/// most 1,000 samples.
HandleSamples sample_places(
  const HandlePlaces& places, const std::function<double(const Vec3&)>& length);

} // namespace bindpose

#endif
