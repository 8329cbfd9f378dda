#ifndef bindpose_scene_colouring_h
#define bindpose_scene_colouring_h

#include "scene/categories.h"
#include "scene/colours.h"
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
struct Colouring
{
  enum class Kind
  {
    none,
    weights,
    winding,
    other
  };
  Kind kind = Kind::none;
  ColourBy by = ColourBy::array;
  std::string array;
  std::string component; ///< as requested
  std::string component_name; ///< as shown: name or number; empty for arrays of one component and
                              ///< for lengths
  ColourMap map;
  std::vector<Category> categories; ///< of labels, rungs and handles
  std::vector<double> isolines; ///< of weights: the borders of the bands, multiples of 0.1
  vtkSmartPointer<vtkDataSet> minus; ///< the dataset whose numbers are subtracted; may be null
  Report numbers; ///< statistics over all tiles, of row sums and differences

  std::string legend_name() const;
};

/// Find the array and the component in the tiles, and the range of their values.
Status choose_colouring(
  const std::vector<Tile>& tiles, const PictureOptions& options, Colouring& colouring);

/// Return the shown number as a separate array on the same points or cells. Return null if the data
/// lacks the array or its component, or is not tets where only tets have the number.
vtkSmartPointer<vtkDoubleArray> colour_values(
  vtkDataSet* data, const Colouring& colouring, bool& on_points);

/// Name of the array of colour_values().
constexpr const char* colour_array_name = "bindpose.Colour";

/// Return the lines where the array colour_array_name of the points has these values; no lines if
/// the array is missing.
vtkSmartPointer<vtkPolyData> contour_lines(vtkPolyData* data, const std::vector<double>& values);

constexpr double isoline_width = 1.2; ///< of weights, in pixels

} // namespace bindpose

#endif
