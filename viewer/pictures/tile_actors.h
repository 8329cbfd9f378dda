#ifndef bindpose_pictures_tile_actors_h
#define bindpose_pictures_tile_actors_h

#include "scene/camera.h"
#include "scene/coloring.h"
#include "scene/picture_options.h"
#include "weights/extrema.h"

class vtkDataSet;
class vtkRenderer;

namespace bindpose
{

/// Report whether a dataset is a handle dataset.
bool is_handle_data(vtkDataSet* data);

/// Return the points that a tile (one dataset of a picture) shows: all points that cells use, the
/// posed handles, and the corners of an image. For an image these are the corners of its slice if
/// the frame is known. Otherwise they are the corners of the box that contains its isosurfaces and
/// its volume rendering.
Points shown_points(const Tile& tile, const PictureOptions& options, const Coloring& coloring,
  const Frame* frame = nullptr);

/// The number of drawn tets and the number of drawn extrema of a picture.
struct DrawnCounts
{
  Index tets = 0;
  Index extrema = 0;
};

/// Add a tile's actors to its renderer.
/// @param extrema  extrema of the tile's data
/// @param scale  window pixels per picture pixel, for line widths and handle sizes
/// @param drawn_counts  counts of all tiles so far; the counts of this tile are added
/// @return invalid_input if the section plane removes all tets of the tile, or if a slice crosses
/// no tet
Status add_tile(vtkRenderer* renderer, const Tile& tile, const PictureOptions& options,
  const Coloring& coloring, const std::vector<Extremum>& extrema, const Frame& frame, double scale,
  DrawnCounts& drawn_counts);

/// Add key, fill and back lights that move with the camera.
void add_lights(vtkRenderer* renderer);

} // namespace bindpose

#endif
