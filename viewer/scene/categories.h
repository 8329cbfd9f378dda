#ifndef bindpose_scene_categories_h
#define bindpose_scene_categories_h

#include "base/mesh.h"
#include "base/status.h"
#include "scene/colors.h"

#include <string>
#include <vector>

class vtkDataSet;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace bindpose
{

/// One entry of a legend: the number in the data, the name, the color and the number of
/// occurrences.
struct Category
{
  int value = 0;
  std::string name;
  Rgb color{};
  Index count = 0;
};

/// The four values of the cell array `Label` of vtkTetrahedralizeSurface, each with its color.
/// Decisions against the winding number are darker.
const std::vector<Category>& label_categories();
/// The methods that make tets: cdt, remesh, embed, wrap, ftetwild. Any other name is "other".
const std::vector<Category>& rung_categories();
/// The types of defects, in the order of vtkSurfaceDefects.
const std::vector<Category>& defect_categories();

/// Local extrema, minima before maxima: sky blue and vermilion, which color-blind viewers can
/// distinguish.
const std::vector<Category>& extremum_categories();
/// Number of distinct handle colors: those that vtkWeightedColors gives to handles without a color,
/// their lighter variants and their darker variants.
constexpr std::size_t handle_colors = 24;
/// Return the color of the handle of a column. After the last color, the first is used again.
Rgb handle_color(std::size_t column);
/// Return one category per handle name, in the order of the columns.
std::vector<Category> handle_categories(const std::vector<std::string>& names);

/// Count the cells of each label. Return invalid_input if the cell array `Label` is missing or has
/// a value that is not a label.
Status count_labels(vtkDataSet* tets, std::vector<Category>& categories);
/// Count all tets as one rung (method), the one in the field data `Method`. Return invalid_input if
/// `Method` is missing.
Status count_rung(vtkDataSet* tets, std::vector<Category>& categories);

/// Report whether a dataset is an output of vtkSurfaceDefects.
bool is_defect_data(vtkDataSet* data);
/// Count the defects of each type as `bindpose info` does: cells, but components for inward
/// components.
void count_defects(vtkPolyData* defects, std::vector<Category>& categories);

/// Return a legend and a lookup table of the categories that occur, in their order from the bottom.
/// The i-th of them has the value i + 0.5. Tick texts are name and count.
ColorMap category_map(const std::vector<Category>& categories);
/// Shorten the legend to at most `most` lines. The last line states how many more categories there
/// are.
ColorMap shortened(const ColorMap& map, int most);
/// Return the table's value for each category that occurs, -1 for the other categories.
std::vector<double> category_values(const std::vector<Category>& categories);

} // namespace bindpose

#endif
