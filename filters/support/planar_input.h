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

/// The input of the triangulation of vtkPlanarShape, in the coordinates of the filter's input.
struct PlanarInput
{
  PlanePoints points;
  Segments segments;
  double z = 0.0;
  Vec2 lower = Vec2::Zero(); ///< lower corner of the box whose texture coordinates are 0 to 1
  Vec2 upper = Vec2::Zero();
  Report report; ///< entries for the report of the filter: `domain` and counts
};

/// Return the outline of an image. This is the contour of its alpha, or the border of the image if
/// it has no alpha or if `rectangle` is true.
Status to_planar_input(ExecutionContext& context, vtkImageData* image, bool rectangle,
  const ImageOutlineOptions& options, PlanarInput& input);

/// Return the segments of a polydata that lies in a plane z = const. These are the segments of its
/// lines and the edges of its polygons.
Status to_planar_input(vtkPolyData* curves, PlanarInput& input);

} // namespace bindpose

#endif
