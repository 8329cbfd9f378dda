#ifndef bindpose_scene_picture_h
#define bindpose_scene_picture_h

#include "base/mesh.h"
#include "base/status.h"
#include "scene/camera.h"

#include "vtkSmartPointer.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

class vtkDataSet;
class vtkImageData;
class vtkPolyData;

namespace bindpose
{

/// One dataset of a picture. How it is drawn follows from what it is:
/// - surface: smooth shaded, sharp edges kept; arrays as colours; weights in bands with isolines;
/// - tets: cut open along the middle, whole tets kept ("crinkle cut"), the laid-open sides in
///   another colour with edges, or cut through by the plane, or all tets shrunk; arrays as colours
///   on all sides;
/// - defects (what vtkSurfaceDefects gives): each kind in its colour, with a legend;
/// - image volume: one slice through the middle; a winding number also shows where it is 0.5; or,
///   asked for, isosurfaces or the volume as a cloud instead of the slice;
/// - handles (a polydata with HandleKind or HandleName): drawn over everything else;
/// - curves (lines of more than two points, or with the cell array Multiplicity): green tubes;
/// - other lines and points: as such.
struct Tile
{
  vtkSmartPointer<vtkDataSet> data;
  vtkSmartPointer<vtkPolyData> handles; ///< drawn on top; may be null
  std::string label; ///< below the tile; may be empty
  /// Drawn along, uncoloured: surfaces and skins see-through, curves as tubes.
  std::vector<vtkSmartPointer<vtkDataSet>> context{};
  /// Of vtkSurfaceDefects, drawn over a surface, which is then see-through; may be null.
  vtkSmartPointer<vtkPolyData> defects{};
};

/// What gives the colours.
enum class ColourBy
{
  array, ///< the array of that name
  winding_number, ///< the array WindingNumber
  label, ///< tets: the decision in the cell array Label
  quality, ///< tets: the smallest dihedral angle, degrees
  rung, ///< tets: the method that made them, by the field data Method
  handle, ///< cells of meshes: the handle whose Weights are the greatest there, by name
  row_sum, ///< the sum of each point's RawWeights
  rotation_cluster, ///< cells: the rotation that most of their points follow (RotationCluster)
  rotation ///< the angle of each point's Rotation
};

/// A plane in space.
struct Plane
{
  Vec3 origin = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ(); ///< any length above 0
};

enum class Background
{
  white,
  gradient, ///< very light grey
  transparent
};

struct PictureOptions
{
  int width = 1200; ///< pixels, 16 to 8192
  int height = 900;
  /// The same picture in so many times as many pixels each way, 1 to 8: lines, points, text and
  /// legends grow along. See check_picture_size().
  int scale = 1;
  /// Point or cell array that gives the colours. Empty: none, but for an image volume
  /// WindingNumber or else its first array.
  std::string array;
  ColourBy colour_by = ColourBy::array; ///< others than array want `array` to be empty
  /// Subtracted from the shown number, point by point (cell by cell): a dataset with the same array
  /// and component and as many points. Null: nothing.
  vtkSmartPointer<vtkDataSet> minus;
  /// Local extrema of the shown number as balls; see find_extrema(). On tets, of all that there
  /// are, those on the drawn sides are seen.
  bool extrema = false;
  /// Name or number of the array's component. Empty: the first of Weights, the length of a
  /// 3-vector, the first of others.
  std::string component;
  /// Values at the ends of the colours; lower > upper: from the data of all tiles (row sums and
  /// differences as far to both sides of 1 and 0; weights 0 to 1,
  /// winding numbers -1 to 2, quality 0 to a regular tet's 70.5 whatever the data).
  std::array<double, 2> range = { 0.0, -1.0 };
  View view;
  Background background = Background::white;
  int columns = 0; ///< of tiles; 0: as square as the picture allows
  std::string title;
  bool legend = true;
  bool bands = true; ///< of weights, a tenth each; else their colours change smoothly
  bool isolines = true; ///< of weights, at the borders of the bands (steps of 0.1)
  bool edges = false; ///< triangle edges of surfaces
  bool handle_names = false; ///< beside each handle
  bool cut = true; ///< tets: lay the inside open; else only the outside is seen
  /// Tets are cut through by the plane, instead of staying whole where their centre lies behind it.
  bool slice = false;
  /// Where cuts and slices lie along the view's depth axis: 0 at its lower end, 1 at its upper.
  /// What lies towards the camera is taken away.
  double section = 0.5;
  /// Cuts and slices by this plane instead.
  std::optional<Plane> section_plane;
  double shrink = 1.0; ///< size of each tet, of its own, in (0, 1]; below 1 they stand apart
  /// Levels whose isosurfaces image volumes show instead of a slice, each in the map's colour.
  /// Those with no other inside (the highest; the lowest when below 0) are solid, the others
  /// see-through.
  std::vector<double> isosurfaces;
  /// Image volumes of winding numbers as a cloud instead of a slice; see make_winding_volume().
  bool volume = false;
  /// Pixels are averages of this many samples in each direction, 1 to 4, each antialiased by the
  /// graphics driver (4 samples). 1 switches all antialiasing off.
  int supersampling = 2;
  /// Not drawn, but the view and the colours' range are theirs, too: the other frames of a moving
  /// picture.
  std::vector<Tile> around;
};

/// What a finished picture shows where, so that numbers can be checked against it.
struct PictureGeometry
{
  struct TileView
  {
    Eigen::Matrix4d world_to_pixel; ///< homogeneous, rows x y depth w
    int x = 0, y = 0, width = 0, height = 0; ///< the tile, pixels, from the lower left corner
  };
  std::vector<TileView> tiles;

  /// Pixel coordinates, from the lower left corner of the picture.
  Eigen::Vector2d project(std::size_t tile, const Vec3& point) const;
};

/// Draws all tiles, seen by one common camera and in one common colour map, into an image of
/// unsigned char RGB, or RGBA for a transparent background (not premultiplied).
/// invalid_input, one sentence, for: no tile or an empty one, an array or component that no tile
/// has (naming those there are), options out of range, isosurfaces or a cloud of what
/// check_volume() refuses, a section that leaves no tet, colours of tets where there are none,
/// differences of unequal datasets, extrema of what is no point array of a mesh, a slice of tets
/// that are shrunk or have no section. Warns of levels that are not reached. unavailable when there
/// is no display. The same input gives the same picture on the same machine and driver.
Status render_to_image(const std::vector<Tile>& tiles, const PictureOptions& options,
  vtkSmartPointer<vtkImageData>& image, PictureGeometry* geometry = nullptr);

/// The same into a PNG file, whole or not at all. invalid_input also when the file is there and
/// may not be overwritten, or cannot be written. Report: picture.width, picture.height,
/// picture.tiles, picture.array, picture.component, picture.range, picture.isosurfaces,
/// picture.tets (drawn), picture.colours[].name and .count (labels, rungs, cells of handles),
/// picture.defects[].name and .count, picture.extrema[].maxima, .minima and .drawn (a tile each),
/// picture.difference.largest (absolute) and .rms, picture.row_sum.minimum and .maximum where they
/// apply.
Status render_to_png(const std::vector<Tile>& tiles, const PictureOptions& options,
  const std::string& path, bool overwrite = false);

/// Writes an image of render_to_image.
Status write_png(vtkImageData* image, const std::string& path, bool overwrite);

} // namespace bindpose

#endif
