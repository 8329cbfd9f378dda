#ifndef handle_picking_h
#define handle_picking_h

#include "handle_data.h"
#include "screen_view.h"

namespace bindpose
{

/// The part of a handle under the mouse. The values equal the interaction states of the
/// representation.
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
  double ball = 7.0; ///< radius of a ball, in pixels
  double bone_width = 0.08; ///< half of a bone's width, as a fraction of its length
  /// A part is hit if the mouse is at most this far from the drawn part, in pixels.
  double tolerance = 4.0;

  /// Return the radius of a bone's end.
  double end() const { return 0.6 * this->ball; }
  /// Return half the width of a bone of the given length. `pixel` is the size of a pixel in the
  /// unit of the length and of the result.
  double half_width(double length, double pixel) const;
};

struct HandlePick
{
  HandlePart part = HandlePart::none;
  vtkIdType handle = -1;
};

/// Return the part of a handle under the mouse. The order of priority is: balls of points, tails,
/// heads, bodies. Among parts of equal priority, the nearest to the mouse wins, then the nearest to
/// the camera. Parts behind the eye are ignored.
HandlePick pick_handle(const ScreenView& view, const std::vector<HandleRecord>& records,
  const Eigen::Vector2d& mouse, const HandleSizes& sizes);

} // namespace bindpose

#endif
