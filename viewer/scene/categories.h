#ifndef bindpose_scene_categories_h
#define bindpose_scene_categories_h

#include "base/mesh.h"
#include "base/status.h"
#include "scene/colours.h"

#include <string>
#include <vector>

class vtkDataSet;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace bindpose
{

/// A class of things that a legend names: its number in the data, colour, and how many there are.
struct Category
{
  int value = 0;
  std::string name;
  Rgb colour{};
  Index count = 0;
};

/// The four values of the cell array `Label` of vtkTetrahedralizeSurface, each with its colour:
/// decisions against the winding number are the darker.
const std::vector<Category>& label_categories();
/// The ways to make tets: cdt, remesh, embed, wrap, ftetwild; what is named else is "other".
const std::vector<Category>& rung_categories();
/// The kinds of defects, in the order of vtkSurfaceDefects.
const std::vector<Category>& defect_categories();

/// Local extrema, minima before maxima: sky blue and vermilion, which every eye tells apart.
const std::vector<Category>& extremum_categories();
/// Colours of handles that differ: those that vtkWeightedColors gives to handles without one, their
/// lighter ones, their darker ones.
constexpr std::size_t handle_colours = 24;
/// The colour of the handle of a column; after the last comes the first again.
Rgb handle_colour(std::size_t column);
/// Handles by their names, in the order of their columns.
std::vector<Category> handle_categories(const std::vector<std::string>& names);

/// How many cells have each label. invalid_input when there is no such cell array or a value is
/// none of the labels.
Status count_labels(vtkDataSet* tets, std::vector<Category>& categories);
/// All tets as one rung, by the field data `Method`. invalid_input when there is none.
Status count_rung(vtkDataSet* tets, std::vector<Category>& categories);

/// Whether a dataset shows defects, as vtkSurfaceDefects gives them.
bool is_defect_data(vtkDataSet* data);
/// How many there are of each kind, as `bindpose info` counts them: cells, and of inward components
/// the components.
void count_defects(vtkPolyData* defects, std::vector<Category>& categories);

/// A legend and table of the categories that occur, from below in their order: the i-th of them has
/// the value i + 0.5. Texts are name and count.
ColourMap category_map(const std::vector<Category>& categories);
/// The same for a legend of at most `most` lines, the last of which says how many more there are.
ColourMap shortened(const ColourMap& map, int most);
/// The table's value for each category that occurs, -1 for others.
std::vector<double> category_values(const std::vector<Category>& categories);

} // namespace bindpose

#endif
