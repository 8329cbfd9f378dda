#ifndef bindpose_scene_categories_h
#define bindpose_scene_categories_h

#include "base/status.h"
#include "geometry/mesh.h"
#include "scene/colors.h"

#include <string>
#include <vector>

class vtkDataSet;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace bindpose
{

// Categories of integer values (labels, meshing methods, types of defects, handles): their names,
// colors and counts, and the legends that show them.

/// One entry of a legend: the value in the data, its name, its color and the number of occurrences.
struct Category
{
  int value = 0;
  std::string name;
  Rgb color{};
  Index count = 0;
};

/// Return the four values of the cell array `Label` of vtkTetrahedralizeSurface, each with its
/// color. The colors of labels that contradict the winding number are darker.
const std::vector<Category>& label_categories();
/// Return one category per meshing method of vtkTetrahedralizeSurface: cdt, remesh, embed, wrap,
/// ftetwild. Any other name is "other".
const std::vector<Category>& method_categories();
/// Return one category per type of defect, in the order of vtkSurfaceDefects.
const std::vector<Category>& defect_categories();

/// Return the categories minimum (sky blue) and maximum (vermilion), in this order. Color-blind
/// viewers can distinguish the colors.
const std::vector<Category>& extremum_categories();
/// Number of distinct handle colors: the colors that vtkWeightedColors gives to handles without a
/// color, and their lighter and darker variants.
constexpr std::size_t handle_color_count = 24;
/// Return the color of the handle with this column of the weights. After the last color, the first
/// is used again.
Rgb handle_color(std::size_t column);
/// Return one category per handle name, in the order of the columns.
std::vector<Category> handle_categories(const std::vector<std::string>& names);

/// Count the cells of each label. Return invalid_input if the cell array `Label` is missing or has
/// a value that is not a label.
Status count_labels(vtkDataSet* tets, std::vector<Category>& categories);
/// Count all tets in the category of their meshing method, which the field data `Method` contains.
/// Return invalid_input if `Method` is missing.
Status count_method(vtkDataSet* tets, std::vector<Category>& categories);

/// Report whether a dataset is an output of vtkSurfaceDefects.
bool is_defect_data(vtkDataSet* data);
/// Count the defects of each type as `bindpose info` does: one per cell, except that inward
/// components are counted per component.
void count_defects(vtkPolyData* defects, std::vector<Category>& categories);

/// Return a legend and a lookup table of the categories that occur, the first at the bottom. The
/// category with index i in this legend has the value i + 0.5 in the table. Each tick text contains
/// the name and the count of a category.
ColorMap category_map(const std::vector<Category>& categories);
/// Shorten the legend to a maximum of `maximum_lines` lines. The last line states how many
/// categories are omitted.
ColorMap shorten_legend(const ColorMap& map, int maximum_lines);
/// Return the value of each category in the table of category_map(); -1 for categories that do not
/// occur.
std::vector<double> category_values(const std::vector<Category>& categories);

} // namespace bindpose

#endif
