#ifndef bindpose_scene_coloring_h
#define bindpose_scene_coloring_h

#include "scene/categories.h"
#include "scene/colors.h"
#include "scene/picture.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkDataArray;
class vtkDataSet;
class vtkDoubleArray;

namespace bindpose
{

/// The colored quantity and its color map, common to all tiles.
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
  std::string component; ///< as requested
  std::string component_name; ///< as shown: name or number; empty for arrays of one component and
                              ///< for lengths
  ColorMap map;
  std::vector<Category> categories; ///< of labels, rungs and handles
  std::vector<double> isolines; ///< of weights: the borders of the bands, multiples of 0.1
  vtkSmartPointer<vtkDataSet> minus; ///< the dataset whose numbers are subtracted; may be null
  Report numbers; ///< statistics over all tiles, of row sums and differences

  std::string legend_name() const;
};

/// Find the array and the component in the tiles, and the range of their values.
Status choose_coloring(
  const std::vector<Tile>& tiles, const PictureOptions& options, Coloring& coloring);

/// Return the shown number as a separate array on the same points or cells. Return null if the data
/// lacks the array or its component, or is not tets where only tets have the number.
vtkSmartPointer<vtkDoubleArray> color_values(
  vtkDataSet* data, const Coloring& coloring, bool& on_points);

/// Name of the array of color_values().
constexpr const char* color_array_name = "bindpose.Color";

/// Return the lines where the array color_array_name of the points has these values; no lines if
/// the array is missing.
vtkSmartPointer<vtkPolyData> contour_lines(vtkPolyData* data, const std::vector<double>& values);

constexpr double isoline_width = 1.2; ///< of weights, in pixels

} // namespace bindpose

#endif
