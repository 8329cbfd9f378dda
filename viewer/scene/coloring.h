#ifndef bindpose_scene_coloring_h
#define bindpose_scene_coloring_h

#include "scene/categories.h"
#include "scene/colors.h"
#include "scene/picture_options.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkDataArray;
class vtkDataSet;
class vtkDoubleArray;

namespace bindpose
{

// Chooses the array, the component and the color map of a picture, and computes the displayed
// values.

/// The displayed quantity and its color map, which all tiles of a picture share. A tile is one
/// dataset of the picture.
struct Coloring
{
  enum class Kind
  {
    none,
    weights,
    winding,
    other
  };
  Kind kind = Kind::none;
  ColorBy by = ColorBy::array;
  std::string array;
  std::string component; ///< component as requested: name or index
  /// Component as displayed: name or index. Empty for arrays of one component and for vector
  /// lengths.
  std::string component_name;
  ColorMap map;
  std::vector<Category> categories; ///< categories of labels, meshing methods or handles
  /// Values of the isolines of weights: the borders of the bands, usually multiples of 0.1.
  std::vector<double> isolines;
  vtkSmartPointer<vtkDataSet>
    subtracted_data; ///< the dataset whose values are subtracted; may be null
  Report numbers; ///< statistics of row sums and of differences over all tiles

  std::string legend_name() const;
};

/// Find the array and the component in the tiles, and choose the color map and the range of values.
Status choose_coloring(
  const std::vector<Tile>& tiles, const PictureOptions& options, Coloring& coloring);

/// Return the displayed values as a separate array on the same points or cells. Return null if the
/// data lacks the array or its component, or if the data are not tets and the quantity is defined
/// only for tets.
vtkSmartPointer<vtkDoubleArray> color_values(
  vtkDataSet* data, const Coloring& coloring, bool& on_points);

/// Name of the array of color_values().
constexpr const char* color_array_name = "bindpose.Color";

/// Return the isolines at these values of the point array color_array_name. Return no lines if the
/// array is missing.
vtkSmartPointer<vtkPolyData> contour_lines(vtkPolyData* data, const std::vector<double>& values);

constexpr double isoline_width = 1.2; ///< width of the isolines of weights, in pixels

} // namespace bindpose

#endif
