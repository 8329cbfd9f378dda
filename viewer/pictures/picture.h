#ifndef bindpose_pictures_picture_h
#define bindpose_pictures_picture_h

#include "base/status.h"
#include "scene/picture_options.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkImageData;

namespace bindpose
{

/// The positions of the tiles in a finished picture. Tests use them to find the pixel of a point.
struct PictureGeometry
{
  struct TileView
  {
    /// Maps homogeneous world coordinates to homogeneous pixel coordinates. After division by w, x
    /// and y are pixels from the lower left corner of the picture, and z is the depth.
    Eigen::Matrix4d world_to_pixel;
    /// Area of the tile, in pixels. `x` and `y` are measured from the lower left corner of the
    /// picture.
    int x = 0, y = 0, width = 0, height = 0;
  };
  std::vector<TileView> tiles;

  /// Return the position of a world point of a tile, in pixels from the lower left corner of the
  /// picture.
  Eigen::Vector2d project(std::size_t tile, const Vec3& point) const;
};

/// Draw all tiles with one common camera and one common color map into an image of unsigned chars:
/// RGB, or RGBA (not premultiplied) for a transparent background. The same input gives the same
/// picture on the same machine and driver. A warning names isosurface levels that no value reaches.
///
/// Return unavailable if there is no display. Return invalid_input with one sentence for:
/// - no tile or an empty tile
/// - an array or component that no tile has (the sentence lists the existing names)
/// - options out of range
/// - isosurfaces or a volume rendering of data that check_volume() refuses
/// - a section that leaves no tet
/// - a color quantity of tets (label, quality, method) if there are no tets
/// - differences of datasets that do not match (see PictureOptions::subtracted_data)
/// - extrema of an array that is not a point array of a mesh
/// - a slice of tets that are shrunk or have no section
Status render_to_image(const std::vector<Tile>& tiles, const PictureOptions& options,
  vtkSmartPointer<vtkImageData>& image, PictureGeometry* geometry = nullptr);

/// Render into a PNG file. The file is written completely or not at all. In addition to the errors
/// of render_to_image(), return invalid_input if the file exists and must not be overwritten, or
/// cannot be written.
///
/// Report where applicable: picture.width, picture.height, picture.tiles, picture.array,
/// picture.component, picture.range, picture.isosurfaces, picture.tets (number of drawn tets),
/// picture.colors[].name and .count (of labels, meshing methods, or cells per handle),
/// picture.defects[].name and .count, picture.extrema[].maxima, .minima and .drawn (one entry per
/// tile), picture.difference.largest (absolute) and .rms, picture.row_sum.minimum and .maximum.
Status render_to_png(const std::vector<Tile>& tiles, const PictureOptions& options,
  const std::string& path, bool overwrite = false);

/// Write an image that render_to_image() returned to a PNG file.
Status write_png(vtkImageData* image, const std::string& path, bool overwrite);

} // namespace bindpose

#endif
