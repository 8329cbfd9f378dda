#ifndef bindpose_scene_tile_actors_h
#define bindpose_scene_tile_actors_h

#include "scene/camera.h"
#include "scene/colouring.h"
#include "scene/picture.h"
#include "weights/extrema.h"

class vtkDataSet;
class vtkRenderer;

namespace bindpose
{

/// Whether a dataset is a handle dataset.
bool is_handle_data(vtkDataSet* data);

/// The places that a tile shows: of all points that cells use, of handles as posed, of an image's
/// corners, of its slice's when the frame is known, or of the box that holds its isosurfaces and
/// its cloud.
Points shown_points(const Tile& tile, const PictureOptions& options, const Colouring& colouring,
  const Frame* frame = nullptr);

/// How much of the data a picture shows.
struct Drawn
{
  Index tets = 0;
  Index extrema = 0;
};

/// Adds a tile's props to its renderer.
/// @param extrema  of the tile's data
/// @param scale  window pixels per picture pixel, for line widths and handle sizes
/// @param shown  grows by what is drawn
/// @return invalid_input when the section leaves none of a tile's tets
Status add_tile(vtkRenderer* renderer, const Tile& tile, const PictureOptions& options,
  const Colouring& colouring, const std::vector<Extremum>& extrema, const Frame& frame,
  double scale, Drawn& shown);

/// Key, fill and back light that stay with the camera.
void add_lights(vtkRenderer* renderer);

} // namespace bindpose

#endif
