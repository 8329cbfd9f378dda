#ifndef handle_picking_h
#define handle_picking_h

#include "handle_data.h"
#include "screen_view.h"

namespace bindpose
{

/// What of a handle the mouse is on. The numbers are those of the representation's states.
enum class HandlePart
{
  none = 0,
  point = 1,
  head = 2,
  tail = 3,
  body = 4
};

struct HandleSizes
{
  double ball = 7.0; ///< radius of a ball, pixels
  double bone_width = 0.08; ///< half width over length
  double tolerance = 4.0; ///< pixels beyond what is drawn

  /// Of a bone's end.
  double end() const { return 0.6 * this->ball; }
  /// Half the width of a bone of a length, both in the same unit, `pixel` of which is a pixel.
  double half_width(double length, double pixel) const;
};

struct HandlePick
{
  HandlePart part = HandlePart::none;
  vtkIdType handle = -1;
};

/// The part of a handle under the mouse: balls of points win over tails, tails over heads, ends
/// over bodies; among equals the nearest to the mouse, then the one nearest to the camera. What
/// lies behind the eye does not count.
HandlePick pick_handle(const ScreenView& view, const std::vector<HandlePlace>& places,
  const Eigen::Vector2d& mouse, const HandleSizes& sizes);

} // namespace bindpose

#endif
