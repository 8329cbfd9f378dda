#ifndef bindpose_inside_handle_places_h
#define bindpose_inside_handle_places_h

#include "base/mesh.h"
#include "winding/curve_winding_number.h"

#include <functional>

namespace bindpose
{

/// Where handles are, for a mesher that makes them part of a volume.
struct HandlePlaces
{
  Points points; ///< #H x 3: point handles, ends of bones, vertices of cages
  Segments segments; ///< #S x 2: bones, edges of cages
  Triangles triangles; ///< #C x 3: faces of cages

  bool empty() const { return this->points.rows() == 0; }
};

/// invalid_input for coordinates that are not finite and ids out of range.
Status check_places(const HandlePlaces& places);

struct HandleSamples
{
  Points points; ///< each place once
  Index chosen = 0; ///< the first are the handles' own points
};

/// The points, then points between them: on segments (at least one on each) and triangles, as far
/// from each other as `length` says there (> 0), at most 1,000 along a line.
HandleSamples sample_places(
  const HandlePlaces& places, const std::function<double(const Vec3&)>& length);

} // namespace bindpose

#endif
