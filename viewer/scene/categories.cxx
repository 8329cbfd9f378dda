// Legends for integer values: names, colors and counts of categories. Color-blind viewers can
// distinguish the colors, because neighboring colors differ in lightness (after the palettes of
// Paul Tol).
#include "scene/categories.h"

#include "base/number_text.h"
#include "surface/surface_defects.h"
#include "weight_uses/weighted_colors.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkLookupTable.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <set>

namespace bindpose
{

const std::vector<Category>& label_categories()
{
  static const std::vector<Category> table{
    { -1, "outside, w above", { 0.12, 0.25, 0.52 } },
    { 0, "outside", { 0.64, 0.79, 0.90 } },
    { 1, "inside", { 0.93, 0.68, 0.45 } },
    { 2, "inside, w below", { 0.60, 0.10, 0.16 } },
  };
  return table;
}

const std::vector<Category>& method_categories()
{
  static const std::vector<Category> table{
    { 0, "cdt", { 0.27, 0.47, 0.67 } },
    { 1, "remesh", { 0.80, 0.73, 0.27 } },
    { 2, "embed", { 0.67, 0.20, 0.47 } },
    { 3, "wrap", { 0.40, 0.80, 0.93 } },
    { 4, "ftetwild", { 0.13, 0.53, 0.20 } },
    { 5, "other", { 0.62, 0.62, 0.62 } },
  };
  return table;
}

const std::vector<Category>& defect_categories()
{
  static const std::vector<Category> table = []
  {
    constexpr Rgb colors[defect_kinds] = { { 0.20, 0.13, 0.53 }, { 0.55, 0.55, 0.13 },
      { 0.05, 0.46, 0.32 }, { 0.80, 0.20, 0.07 }, { 0.95, 0.60, 0.15 }, { 0.30, 0.30, 0.30 },
      { 0.00, 0.40, 0.75 }, { 0.87, 0.15, 0.52 }, { 0.20, 0.70, 0.90 } };
    std::vector<Category> categories;
    for (int kind = 0; kind < defect_kinds; ++kind)
    {
      categories.push_back({ kind, to_string(static_cast<Defect>(kind)), colors[kind] });
    }
    return categories;
  }();
  return table;
}

const std::vector<Category>& extremum_categories()
{
  static const std::vector<Category> table{
    { -1, "minima", { 0.34, 0.71, 0.91 } },
    { 1, "maxima", { 0.84, 0.37, 0.00 } },
  };
  return table;
}

Rgb handle_color(std::size_t column)
{
  static const Colors colors = categorical_colors(16);
  const auto at = static_cast<Index>(column % handle_color_count);
  const double shade = at < 16 ? 1.0 : 0.55;
  const auto color_row = colors.row(at < 16 ? at : at - 16);
  return { shade * color_row[0], shade * color_row[1], shade * color_row[2] };
}

std::vector<Category> handle_categories(const std::vector<std::string>& names)
{
  std::vector<Category> categories;
  for (std::size_t j = 0; j < names.size(); ++j)
  {
    categories.push_back({ static_cast<int>(j), names[j], handle_color(j) });
  }
  return categories;
}

namespace
{
/// Count how often each category occurs in an array. Return the index of the first tuple whose
/// value belongs to no category, or -1.
Index count_values(vtkDataArray* array, std::vector<Category>& categories)
{
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    const double value = array->GetComponent(i, 0);
    const auto found = std::find_if(categories.begin(), categories.end(),
      [&](const Category& category) { return value == category.value; });
    if (found == categories.end())
    {
      return i;
    }
    ++found->count;
  }
  return -1;
}
} // namespace

Status count_labels(vtkDataSet* tets, std::vector<Category>& categories)
{
  vtkDataArray* labels = tets->GetCellData()->GetArray("Label");
  if (!labels)
  {
    return Status::invalid_input(
      "the tets have no cell array 'Label'; bindpose tetrahedralize writes it (.vtu)");
  }
  const Index bad = count_values(labels, categories);
  return bad < 0 ? Status()
                 : Status::invalid_input("'Label' of cell " + std::to_string(bad) + " is " +
                     short_number(labels->GetComponent(bad, 0)) + "; expected -1, 0, 1 or 2");
}

Status count_method(vtkDataSet* tets, std::vector<Category>& categories)
{
  auto* array = vtkStringArray::SafeDownCast(tets->GetFieldData()->GetAbstractArray("Method"));
  if (!array || array->GetNumberOfValues() == 0)
  {
    return Status::invalid_input(
      "the tets have no field data array 'Method'; bindpose tetrahedralize writes it (.vtu)");
  }
  const std::string method = array->GetValue(0);
  auto found = std::find_if(categories.begin(), categories.end(),
    [&](const Category& category) { return category.name == method; });
  found = found == categories.end() ? categories.end() - 1 : found;
  found->count += tets->GetNumberOfCells();
  return {};
}

bool is_defect_data(vtkDataSet* data)
{
  auto* polydata = vtkPolyData::SafeDownCast(data);
  return polydata && polydata->GetCellData()->GetArray("Defect") &&
    polydata->GetCellData()->HasArray("DefectName");
}

void count_defects(vtkPolyData* defects, std::vector<Category>& categories)
{
  count_values(defects->GetCellData()->GetArray("Defect"), categories);
  vtkDataArray* inward = defects->GetCellData()->GetArray("InwardComponent");
  std::set<double> components;
  for (vtkIdType cell = 0; inward && cell < inward->GetNumberOfTuples(); ++cell)
  {
    if (inward->GetComponent(cell, 0) >= 0.0)
    {
      components.insert(inward->GetComponent(cell, 0));
    }
  }
  constexpr int inward_kind = static_cast<int>(Defect::inward_component);
  for (Category& category : categories)
  {
    if (inward && category.value == inward_kind)
    {
      category.count = static_cast<Index>(components.size());
    }
  }
}

namespace
{
/// Format a count with separators: "12,345".
std::string format_count(Index count)
{
  std::string digits = std::to_string(count);
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3)
  {
    digits.insert(static_cast<std::size_t>(at), ",");
  }
  return digits;
}
} // namespace

ColorMap category_map(const std::vector<Category>& categories)
{
  ColorMap map;
  std::vector<Category> used;
  std::copy_if(categories.begin(), categories.end(), std::back_inserter(used),
    [](const Category& category) { return category.count > 0; });
  const int count = static_cast<int>(used.size());
  map.upper = std::max(1, count);
  map.table = vtkSmartPointer<vtkLookupTable>::New();
  map.table->SetNumberOfTableValues(std::max(1, count));
  map.table->SetTableRange(map.lower, map.upper);
  map.table->SetNanColor(palette::missing[0], palette::missing[1], palette::missing[2], 1.0);
  for (int i = 0; i < count; ++i)
  {
    const Rgb& c = used[i].color;
    map.table->SetTableValue(i, c[0], c[1], c[2], 1.0);
    map.ticks.push_back(i + 0.5);
    map.texts.push_back(used[i].name + ": " + format_count(used[i].count));
  }
  return map;
}

ColorMap shorten_legend(const ColorMap& map, int maximum_lines)
{
  const int count = static_cast<int>(map.texts.size());
  if (count <= maximum_lines || maximum_lines < 2)
  {
    return map;
  }
  ColorMap result = map;
  result.upper = maximum_lines;
  result.table = vtkSmartPointer<vtkLookupTable>::New();
  result.table->SetNumberOfTableValues(maximum_lines);
  result.table->SetTableRange(0.0, maximum_lines);
  double rgba[4];
  for (int i = 0; i + 1 < maximum_lines; ++i)
  {
    map.table->GetTableValue(i, rgba);
    result.table->SetTableValue(i, rgba);
  }
  result.table->SetTableValue(
    maximum_lines - 1, palette::white[0], palette::white[1], palette::white[2], 1);
  result.ticks.resize(static_cast<std::size_t>(maximum_lines));
  result.texts.resize(static_cast<std::size_t>(maximum_lines));
  result.texts.back() = "and " + format_count(count - maximum_lines + 1) + " more";
  return result;
}

std::vector<double> category_values(const std::vector<Category>& categories)
{
  std::vector<double> values;
  double next = 0.5;
  for (const Category& category : categories)
  {
    values.push_back(category.count > 0 ? next : -1.0);
    next += category.count > 0 ? 1.0 : 0.0;
  }
  return values;
}

} // namespace bindpose
