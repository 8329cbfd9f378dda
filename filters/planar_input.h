#ifndef planar_input_h
#define planar_input_h

#include "base/status.h"
#include "planar/image_outline.h"
#include "planar/planar_shape.h"

#include <string>
#include <vector>

class vtkImageData;
class vtkPolyData;

namespace bindpose
{
class ExecutionContext;

/// What vtkPlanarShape triangulates, in the coordinates of its input.
struct PlanarInput
{
  PlanePoints points;
  Segments segments;
  double z = 0.0;
  Vec2 lower = Vec2::Zero(); ///< the box that texture coordinates 0 to 1 cover
  Vec2 upper = Vec2::Zero();
  Report report; ///< what was found: domain, counts
};

/// The outline of an image: of its alpha, or all around it when it has none or when `rectangle`.
Status to_planar_input(vtkImageData* image, bool rectangle, const ImageOutlineOptions& options,
  PlanarInput& input, ExecutionContext& context);

/// The lines and the sides of the polygons of a polydata in a plane z = const.
Status to_planar_input(vtkPolyData* curves, PlanarInput& input);

} // namespace bindpose

#endif
