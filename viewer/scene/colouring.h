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

/// What is coloured, and how; the same for all tiles.
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
  std::string component; ///< as asked for
  std::string component_name; ///< as shown: name or number, empty for single numbers and lengths
  ColourMap map;
  std::vector<Category> categories; ///< of labels, rungs and handles
  std::vector<double> isolines; ///< of weights: the borders of the bands, tenths
  vtkSmartPointer<vtkDataSet> minus; ///< whose numbers are subtracted; may be null
  Report numbers; ///< of all tiles' values: of row sums and differences

  std::string legend_name() const;
};

/// Finds the array and component in the tiles and the range of their values.
Status choose_colouring(
  const std::vector<Tile>& tiles, const PictureOptions& options, Colouring& colouring);

/// The shown number as an array of its own, on the same points or cells; null when the data lacks
/// the array or its component, or what only tets have.
vtkSmartPointer<vtkDoubleArray> colour_values(
  vtkDataSet* data, const Colouring& colouring, bool& on_points);

/// Its name.
constexpr const char* colour_array_name = "bindpose.Colour";

/// Lines where a point array of that name has these values; none without it.
vtkSmartPointer<vtkPolyData> contour_lines(vtkPolyData* data, const std::vector<double>& values);

constexpr double isoline_width = 1.2; ///< of weights, pixels

} // namespace bindpose

#endif
