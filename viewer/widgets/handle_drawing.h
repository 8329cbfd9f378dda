#ifndef handle_drawing_h
#define handle_drawing_h

#include "handle_data.h"
#include "handle_picking.h"
#include "handle_shapes.h"
#include "screen_view.h"

#include <vector>

namespace bindpose
{

/// How handles look; colours by mode.
struct HandleLook
{
  Colour modes[3];
  Colour outline;
  Colour selected; ///< the outline of selected handles, with the other around it
  double pixel_scale = 1.0; ///< on the width of outlines
};

/// Which handles are not like the others.
struct HandleMarks
{
  vtkIdType hovered = -1;
  vtkIdType active = -1; ///< the one that is dragged
  std::vector<vtkIdType> selected;
};

/// A colour halfway to white.
Colour lighter(const Colour& colour);

/// Adds all handles and bars to the shapes: the bodies, and the same a little larger for the
/// outline hull.
void draw_handles(const ScreenView& view, const std::vector<HandlePlace>& places,
  const std::vector<HandleData::Bar>& bars, const HandleSizes& sizes, const HandleLook& look,
  const HandleMarks& marks, HandleShapes& solid, HandleShapes& outline);

/// Where a handle's name stands: right of a ball; of a bone on the side that faces right, so as not
/// to cover it.
/// @param ball  radius in pixels
Eigen::Vector2d label_place(const ScreenView& view, const HandlePlace& place, double ball);

} // namespace bindpose

#endif
