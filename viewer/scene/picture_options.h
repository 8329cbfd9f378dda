#ifndef bindpose_scene_picture_options_h
#define bindpose_scene_picture_options_h

#include "geometry/mesh.h"
#include "scene/camera.h"

#include "vtkSmartPointer.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkDataSet;
class vtkPolyData;

namespace bindpose
{

struct FileLook;

/// One dataset of a picture. Its type determines how it is drawn:
/// - surface: smooth shading with sharp edges kept; arrays as colors; weights in bands with
///   isolines; without colors, the materials of its file if they are known;
/// - tets: cut open in the middle, without cutting single tets ("crinkle cut"). The exposed faces
///   have edges and another color. On request, the plane cuts through tets, or all tets are shrunk.
///   Arrays are shown as colors on all faces;
/// - defects (output of vtkSurfaceDefects): one color per type, with a legend;
/// - image volume: one slice through the middle, and for winding numbers also the isosurface of
///   level 0.5; on request isosurfaces or a volume rendering instead of the slice;
/// - handles (a polydata with HandleKind or HandleName): drawn over everything else;
/// - curves (lines of more than two points, or with the cell array Multiplicity): green tubes;
/// - other lines and points: as lines and points.
struct Tile
{
  vtkSmartPointer<vtkDataSet> data;
  vtkSmartPointer<vtkPolyData> handles; ///< drawn on top of `data`; may be null
  std::string label; ///< text below the tile; may be empty
  /// Additional datasets that are drawn uncolored: surfaces and tets translucent, curves as tubes.
  std::vector<vtkSmartPointer<vtkDataSet>> context{};
  /// Output of vtkSurfaceDefects, or null. The defects are drawn over the surface `data`, and this
  /// surface becomes translucent.
  vtkSmartPointer<vtkPolyData> defects{};
  /// Materials, textures and vertex colors of the surface `data`, or null. They are drawn if the
  /// picture has no colors and the tile has no defects. FileLook::surface.point_count must be the
  /// number of points of `data`.
  std::shared_ptr<const FileLook> look{};
};

/// The quantity that determines the colors.
enum class ColorBy
{
  array, ///< the array named by PictureOptions::array
  winding_number, ///< the array WindingNumber
  label, ///< tets only: inside or outside, from the cell array `Label`
  quality, ///< tets only: the smallest dihedral angle, in degrees
  method, ///< tets only: the meshing method, from the field data array `Method`
  handle, ///< cells of meshes: the name of the handle with the largest Weights at the cell
  row_sum, ///< the sum of each point's `RawWeights`
  rotation_cluster, ///< cells: the rotation cluster of most of their points (RotationCluster)
  rotation ///< the angle of each point's `Rotation`, in degrees
};

/// A plane in space.
struct Plane
{
  Vec3 origin = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ(); ///< normal vector of any length above 0
};

enum class Background
{
  white,
  gradient, ///< gradient of very light grays
  transparent
};

struct PictureOptions
{
  int width = 1200; ///< pixels, 16 to 8192
  int height = 900;
  /// Factor on the number of pixels in each direction, 1 to 8, for a sharper version of the same
  /// picture. Lines, points, text and legends are scaled by the same factor. See
  /// check_picture_size().
  int scale = 1;
  /// Point or cell array that is displayed as colors. Empty: an image volume shows the array
  /// WindingNumber or, if it has no such array, its first array; all other datasets have no colors.
  std::string array;
  /// The quantity that is displayed as colors. For all values except ColorBy::array, `array` must
  /// be empty.
  ColorBy color_by = ColorBy::array;
  /// Dataset whose values are subtracted from the displayed values, point by point or cell by cell.
  /// This dataset must have the same array and component and the same number of points or cells.
  /// Null: no subtraction.
  vtkSmartPointer<vtkDataSet> subtracted_data;
  /// Show local extrema of the displayed array as balls; see find_extrema(). On tets, only extrema
  /// on the drawn faces are visible.
  bool extrema = false;
  /// Name or index of the array's component. Empty: the first component of Weights, the length of a
  /// 3-vector, the first component of other arrays.
  std::string component;
  /// Values at the ends of the color map. If lower > upper, the range comes from the data of all
  /// tiles. The range of row sums is then symmetric about 1, and the range of differences symmetric
  /// about 0. Some ranges are fixed: weights 0 to 1 (wider if a weight is outside), winding numbers
  /// -1 to 2, quality 0 to 70.5 degrees (the dihedral angle of a regular tet).
  std::array<double, 2> range = { 0.0, -1.0 };
  View view;
  Background background = Background::white;
  /// Number of columns of tiles; 0: the number for which the shapes appear largest.
  int columns = 0;
  std::string title;
  bool legend = true;
  /// Show weights in bands of one color each, by default 0.1 wide; otherwise the colors change
  /// smoothly.
  bool bands = true;
  bool isolines = true; ///< draw isolines of weights at the borders between bands
  bool edges = false; ///< draw the triangle edges of surfaces
  bool handle_names = false; ///< draw the name next to each handle
  bool cut = true; ///< tets: expose the interior; otherwise only the outside is visible
  /// If true, the plane cuts through tets. If false, tets stay whole, and a tet is shown if its
  /// center is behind the plane.
  bool slice = false;
  /// Position of cuts and slices along the view's depth axis: 0 at its lower end, 1 at its upper
  /// end. The part toward the camera is removed.
  double section = 0.5;
  /// Plane of cuts and slices; replaces `section`.
  std::optional<Plane> section_plane;
  /// Size factor of each tet about its center, in (0, 1]. Below 1 there are gaps between tets.
  double shrink = 1.0;
  /// Levels of the isosurfaces that image volumes show instead of a slice, each in the map's color.
  /// The surface of the highest level is opaque. The surface of the lowest level is also opaque if
  /// this level is below 0. All other surfaces are translucent.
  std::vector<double> isosurfaces;
  /// Show image volumes of winding numbers by volume rendering instead of slices; see
  /// make_winding_volume().
  bool volume = false;
  /// Number of samples per pixel in each direction, 1 to 4; a pixel is their average. Above 1, the
  /// graphics driver also antialiases each sample, with 4 samples of its own. The value 1 disables
  /// all antialiasing.
  int supersampling = 2;
  /// Tiles that are not drawn but are included in the view and the range of the colors, for example
  /// the other frames of an animation.
  std::vector<Tile> undrawn_tiles;
};

} // namespace bindpose

#endif
