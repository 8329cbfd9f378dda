#ifndef handle_drawing_h
#define handle_drawing_h

#include "handle_data.h"
#include "handle_picking.h"
#include "handle_shapes.h"
#include "screen_view.h"

#include <vector>

namespace bindpose
{

/// The appearance of handles: body colors by mode, outline colors and outline width.
struct HandleAppearance
{
  Color modes[3];
  Color outline;
  /// Outline color of selected handles. A second outline in the color `outline` surrounds this
  /// outline.
  Color selected;
  double pixel_scale = 1.0; ///< factor on the width of outlines
};

/// The handles to highlight.
struct HandleMarks
{
  vtkIdType hovered = -1;
  vtkIdType active = -1; ///< the dragged handle
  std::vector<vtkIdType> selected;
};

/// Return a color mixed with white.
Color lighter(const Color& color);

/// Add all handles and bars to the shapes: the bodies to `solid`, and slightly larger copies to
/// `outline`.
void draw_handles(const ScreenView& view, const std::vector<HandleRecord>& records,
  const std::vector<HandleData::Bar>& bars, const HandleSizes& sizes,
  const HandleAppearance& appearance, const HandleMarks& marks, HandleShapes& solid,
  HandleShapes& outline);

/// Return the display position of a handle's name. The name of a ball is to the right of the ball.
/// The name of a bone is next to the middle of the bone, on the right side of the bone on the
/// screen, so that the name does not cover the bone.
/// @param ball  radius of a ball in pixels
Eigen::Vector2d label_anchor(const ScreenView& view, const HandleRecord& record, double ball);

} // namespace bindpose

#endif
