// Chooses the array, the range and the color map of a picture. The array is found by name in all
// tiles (datasets drawn side by side), the component by name or index. One range covers all tiles,
// so that equal colors mean equal values in the whole picture.
#include "scene/coloring.h"

#include "conversion.h"
#include "scene/rotation_colors.h"
#include "tets/tet_quality.h"

#include "vtkCellData.h"
#include "vtkContourFilter.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bindpose
{
namespace
{
struct AssociatedArray
{
  vtkDataArray* array = nullptr;
  bool on_points = true;
};

AssociatedArray find_array(vtkDataSet* data, const std::string& name)
{
  AssociatedArray found;
  if (data && !name.empty())
  {
    found.array = data->GetPointData()->GetArray(name.c_str());
    if (!found.array)
    {
      found.array = data->GetCellData()->GetArray(name.c_str());
      found.on_points = false;
    }
  }
  return found;
}

std::string comma_separated(const std::vector<std::string>& words)
{
  std::string text;
  for (const std::string& word : words)
  {
    text += (text.empty() ? "" : ", ") + word;
  }
  return text;
}

std::vector<std::string> array_names(const std::vector<Tile>& tiles)
{
  std::vector<std::string> names;
  for (const Tile& tile : tiles)
  {
    if (!tile.data)
    {
      continue;
    }
    for (vtkDataSetAttributes* attributes :
      { static_cast<vtkDataSetAttributes*>(tile.data->GetPointData()),
        static_cast<vtkDataSetAttributes*>(tile.data->GetCellData()) })
    {
      for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
      {
        vtkDataArray* array = attributes->GetArray(i);
        if (array && array->GetName() &&
          std::find(names.begin(), names.end(), array->GetName()) == names.end())
        {
          names.emplace_back(array->GetName());
        }
      }
    }
  }
  return names;
}

bool is_weights_array(const std::string& name)
{
  return name == "Weights" || name == "RawWeights";
}

// Special values for the index of a component.
constexpr int tuple_length = -1;
constexpr int no_component = -2;
constexpr int tuple_sum = -3;

// Return the index of the requested component, or one of the special values.
int find_component(vtkDataArray* array, const std::string& component)
{
  const int count = array->GetNumberOfComponents();
  if (component.empty())
  {
    const std::string name = array->GetName();
    return count == 3 && !is_weights_array(name) ? tuple_length : 0;
  }
  for (int c = 0; c < count; ++c)
  {
    const char* name = array->GetComponentName(c);
    if (name && component == name)
    {
      return c;
    }
  }
  if (component.size() <= 9 && component.find_first_not_of("0123456789") == std::string::npos)
  {
    const int c = std::stoi(component);
    return c < count ? c : no_component;
  }
  return no_component;
}

int find_component(vtkDataArray* array, const Coloring& coloring)
{
  return coloring.by == ColorBy::row_sum ? tuple_sum : find_component(array, coloring.component);
}

double value_of(vtkDataArray* array, vtkIdType tuple, int component)
{
  if (component >= 0)
  {
    return array->GetComponent(tuple, component);
  }
  double sum = 0.0;
  for (int c = 0; c < array->GetNumberOfComponents(); ++c)
  {
    const double value = array->GetComponent(tuple, c);
    sum += component == tuple_sum ? value : value * value;
  }
  return component == tuple_sum ? sum : std::sqrt(sum);
}

std::string component_words(vtkDataArray* array)
{
  std::vector<std::string> words;
  for (int c = 0; c < array->GetNumberOfComponents(); ++c)
  {
    const char* name = array->GetComponentName(c);
    words.push_back(name && *name ? name : std::to_string(c));
  }
  return comma_separated(words);
}

} // namespace

namespace
{
// The dihedral angle of the regular tet, in degrees. No tet has a larger smallest dihedral angle.
constexpr double regular_angle = 70.52877936550931;

bool is_tet_quantity(ColorBy by)
{
  return by == ColorBy::label || by == ColorBy::quality || by == ColorBy::method;
}

std::string quantity_name(ColorBy by)
{
  return by == ColorBy::label ? "label" : by == ColorBy::quality ? "quality" : "rung";
}

// Return one value per tet: the quality, or the lookup-table value of the label or the meshing
// method. Return null if the data are not tets or have no valid labels or method.
vtkSmartPointer<vtkDoubleArray> tet_values(vtkDataSet* data, const Coloring& coloring)
{
  TetInput tets;
  if (!data || !to_tets(data, tets).ok())
  {
    return nullptr;
  }
  const PointsView points = tets.points.view();
  const Index count = tets.tets.view().rows();
  auto values = vtkSmartPointer<vtkDoubleArray>::New();
  values->SetName(color_array_name);
  values->SetNumberOfValues(count);
  if (coloring.by == ColorBy::quality)
  {
    for (Index t = 0; t < count; ++t)
    {
      const auto tet = tets.tets.view().row(t);
      values->SetValue(t,
        min_dihedral_angle(
          points.row(tet[0]), points.row(tet[1]), points.row(tet[2]), points.row(tet[3])));
    }
    return values;
  }
  const std::vector<double> table_values = category_values(coloring.categories);
  std::vector<Category> own = coloring.categories;
  for (Category& category : own)
  {
    category.count = 0;
  }
  if (coloring.by == ColorBy::method)
  {
    if (!count_method(data, own).ok())
    {
      return nullptr;
    }
    const auto found_category = std::find_if(
      own.begin(), own.end(), [](const Category& category) { return category.count > 0; });
    values->Fill(table_values[static_cast<std::size_t>(found_category - own.begin())]);
    return values;
  }
  if (!count_labels(data, own).ok())
  {
    return nullptr;
  }
  vtkDataArray* labels = data->GetCellData()->GetArray("Label");
  for (Index t = 0; t < count; ++t)
  {
    const auto found_category = std::find_if(own.begin(), own.end(),
      [&](const Category& category) { return category.value == labels->GetComponent(t, 0); });
    values->SetValue(t, table_values[static_cast<std::size_t>(found_category - own.begin())]);
  }
  return values;
}

std::vector<std::string> handle_names(vtkDataArray* weights)
{
  std::vector<std::string> names;
  for (int c = 0; c < weights->GetNumberOfComponents(); ++c)
  {
    const char* name = weights->GetComponentName(c);
    names.emplace_back(name && *name ? name : "handle " + std::to_string(c));
  }
  return names;
}

// Return for each cell the column (handle) with the largest sum of weights over the cell's points,
// or -1 if no weight is above 0. Return null if there are no weights.
vtkSmartPointer<vtkDoubleArray> strongest_columns(vtkDataSet* data)
{
  const AssociatedArray found = find_array(data, "Weights");
  if (!found.array || !found.on_points || vtkImageData::SafeDownCast(data))
  {
    return nullptr;
  }
  const auto weights = to_matrix(found.array);
  auto strongest = vtkSmartPointer<vtkDoubleArray>::New();
  strongest->SetName(color_array_name);
  strongest->SetNumberOfValues(data->GetNumberOfCells());
  vtkNew<vtkIdList> ids;
  Eigen::RowVectorXd sums(weights.view().cols());
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    data->GetCellPoints(cell, ids);
    sums.setZero();
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
    {
      sums += weights.view().row(ids->GetId(k));
    }
    Index column = -1;
    const double largest = sums.size() > 0 ? sums.maxCoeff(&column) : 0.0;
    strongest->SetValue(cell, largest > 0.0 ? static_cast<double>(column) : -1.0);
  }
  return strongest;
}

/// Replace each category index by the value of this category in the lookup table. Negative indices
/// become NaN, which is drawn without color.
void look_up(vtkDoubleArray* numbers, const std::vector<double>& table)
{
  for (vtkIdType i = 0; i < numbers->GetNumberOfValues(); ++i)
  {
    const double number = numbers->GetValue(i);
    numbers->SetValue(i,
      number < 0.0 ? std::numeric_limits<double>::quiet_NaN()
                   : table[static_cast<std::size_t>(number)]);
  }
}

// Return for each cell the lookup-table value of its strongest column, i.e. of the handle with the
// largest weights.
vtkSmartPointer<vtkDoubleArray> handle_values(vtkDataSet* data, const Coloring& coloring)
{
  const auto columns = strongest_columns(data);
  if (!columns)
  {
    return nullptr;
  }
  // Tiles may have weights of different handles. Handles are therefore matched by name, not by
  // column.
  const std::vector<std::string> names = handle_names(find_array(data, "Weights").array);
  const std::vector<double> table_values = category_values(coloring.categories);
  std::vector<double> values;
  for (const std::string& name : names)
  {
    const auto found_category = std::find_if(coloring.categories.begin(), coloring.categories.end(),
      [&](const Category& category) { return category.name == name; });
    values.push_back(
      table_values[static_cast<std::size_t>(found_category - coloring.categories.begin())]);
  }
  look_up(columns, values);
  return columns;
}

Status choose_handle_coloring(
  const std::vector<Tile>& tiles, const PictureOptions& options, Coloring& coloring)
{
  if (options.range[0] <= options.range[1])
  {
    return Status::invalid_input("colors by handle cannot have a range");
  }
  std::vector<std::string> names;
  for (const Tile& tile : tiles)
  {
    const AssociatedArray found = find_array(tile.data, "Weights");
    for (const std::string& name :
      found.array ? handle_names(found.array) : std::vector<std::string>())
    {
      if (std::find(names.begin(), names.end(), name) == names.end())
      {
        names.push_back(name);
      }
    }
  }
  coloring.categories = handle_categories(names);
  bool any = false;
  for (const Tile& tile : tiles)
  {
    const auto columns = strongest_columns(tile.data);
    if (!columns)
    {
      continue;
    }
    any = true;
    const std::vector<std::string> tile_handle_names =
      handle_names(find_array(tile.data, "Weights").array);
    for (vtkIdType cell = 0; cell < columns->GetNumberOfValues(); ++cell)
    {
      if (columns->GetValue(cell) >= 0.0)
      {
        const std::string& name =
          tile_handle_names[static_cast<std::size_t>(columns->GetValue(cell))];
        ++std::find_if(coloring.categories.begin(), coloring.categories.end(),
          [&](const Category& category) {
            return category.name == name;
          })->count;
      }
    }
  }
  if (!any)
  {
    return Status::invalid_input("colors by handle need a mesh with the point array 'Weights'; "
                                 "bindpose weights writes it");
  }
  coloring.kind = Coloring::Kind::other;
  coloring.map = category_map(coloring.categories);
  coloring.map.first_at_top = true;
  return {};
}

// Return for each cell the lookup-table value of its rotation cluster.
vtkSmartPointer<vtkDoubleArray> cluster_values(vtkDataSet* data, const Coloring& coloring)
{
  const auto values = clusters_of_cells(data);
  if (!values)
  {
    return nullptr;
  }
  values->SetName(color_array_name);
  look_up(values, category_values(coloring.categories));
  return values;
}

Status choose_cluster_coloring(
  const std::vector<Tile>& tiles, const PictureOptions& options, Coloring& coloring)
{
  if (options.range[0] <= options.range[1])
  {
    return Status::invalid_input("colors by rotation cluster cannot have a range");
  }
  std::vector<vtkDataSet*> datasets;
  for (const Tile& tile : tiles)
  {
    datasets.push_back(tile.data);
  }
  const Status status = check_clusters(datasets);
  if (!status.ok())
  {
    return status;
  }
  coloring.categories = cluster_categories(datasets);
  coloring.kind = Coloring::Kind::other;
  coloring.map = category_map(coloring.categories);
  coloring.map.ticks.clear(); // no ticks, because clusters have no names
  coloring.map.texts.clear();
  return {};
}

// Choose the color map of weights, with or without bands of 0.1, and the isolines at the borders of
// the bands.
void choose_weight_map(
  const PictureOptions& options, double lower, double upper, Coloring& coloring)
{
  double from = 0.0;
  double to = 1.0;
  double bands = 10.0;
  if (options.range[0] <= options.range[1])
  {
    from = options.range[0];
    to = options.range[1];
  }
  else if (lower < -1e-6 || upper > 1.0 + 1e-6)
  {
    // Unconstrained weights can be outside of [0, 1]. Bands of 0.1 are used as long as they can be
    // distinguished, up to 40 bands.
    from = std::floor(10.0 * lower) / 10.0;
    to = std::ceil(10.0 * upper) / 10.0;
    bands = std::min(std::round(10.0 * (to - from)), 40.0);
  }
  coloring.map = !options.bands ? sequential_map(from, to, 0)
    : from == 0.0 && to == 1.0  ? weight_map()
                                : sequential_map(from, to, static_cast<int>(bands));
  // Add isolines between the bands, but not at the ends of the scale.
  for (int i = 1; i < static_cast<int>(bands); ++i)
  {
    coloring.isolines.push_back(from + (to - from) * i / bands);
  }
}

// Check that the dataset to subtract has an array that fits the array of the tile.
Status check_minus(const AssociatedArray& found, const Coloring& coloring)
{
  const AssociatedArray other = find_array(coloring.subtracted_data, coloring.array);
  if (!other.array || other.on_points != found.on_points)
  {
    return Status::invalid_input("the subtracted dataset has no " +
      std::string(found.on_points ? "point" : "cell") + " array '" + coloring.array + "'");
  }
  if (other.array->GetNumberOfTuples() != found.array->GetNumberOfTuples())
  {
    const std::string tuple_kind = found.on_points ? " points" : " cells";
    return Status::invalid_input("the subtracted dataset has " +
      std::to_string(other.array->GetNumberOfTuples()) + tuple_kind + "; expected " +
      std::to_string(found.array->GetNumberOfTuples()) + ", as in the dataset");
  }
  if (find_component(other.array, coloring) == no_component)
  {
    return Status::invalid_input("the array '" + coloring.array +
      "' of the subtracted dataset has no component '" + coloring.component +
      "'; available: " + component_words(other.array));
  }
  return {};
}

// Choose the color map of quantities that only tets have, from all tiles that contain tets.
Status choose_tet_coloring(
  const std::vector<Tile>& tiles, const PictureOptions& options, Coloring& coloring)
{
  const bool has_range = options.range[0] <= options.range[1];
  if (has_range && coloring.by != ColorBy::quality)
  {
    return Status::invalid_input(
      "colors by " + quantity_name(coloring.by) + " cannot have a range");
  }
  if (coloring.by != ColorBy::quality)
  {
    coloring.categories = coloring.by == ColorBy::label ? label_categories() : method_categories();
  }
  bool any = false;
  for (const Tile& tile : tiles)
  {
    TetInput tets;
    if (!vtkPointSet::SafeDownCast(tile.data) || !to_tets(tile.data, tets).ok())
    {
      continue;
    }
    any = true;
    const Status status = coloring.by == ColorBy::label
      ? count_labels(tile.data, coloring.categories)
      : coloring.by == ColorBy::method ? count_method(tile.data, coloring.categories)
                                       : Status();
    if (!status.ok())
    {
      return status;
    }
  }
  if (!any)
  {
    return Status::invalid_input(
      "colors by " + quantity_name(coloring.by) + " need tets, but the picture has none");
  }
  coloring.kind = Coloring::Kind::other;
  if (coloring.by == ColorBy::quality)
  {
    coloring.map = sequential_map(
      has_range ? options.range[0] : 0.0, has_range ? options.range[1] : regular_angle, 0);
  }
  else
  {
    coloring.map = category_map(coloring.categories);
  }
  return {};
}
} // namespace

std::string Coloring::legend_name() const
{
  switch (this->by)
  {
    case ColorBy::label:
      return "Label";
    case ColorBy::quality:
      return "Min. angle (°)";
    case ColorBy::method:
      return "Method";
    case ColorBy::handle:
      return "Handle";
    case ColorBy::row_sum:
      return "Row sum";
    case ColorBy::rotation_cluster:
      return std::to_string(std::count_if(this->categories.begin(), this->categories.end(),
               [](const Category& category) { return category.count > 0; })) +
        " rotation clusters";
    case ColorBy::rotation:
      return "Rotation (°)";
    case ColorBy::array:
    case ColorBy::winding_number:
      break;
  }
  if (this->subtracted_data)
  {
    return (this->component_name.empty() ? this->array : this->component_name) + ", difference";
  }
  return this->component_name.empty() ? this->array : this->array + " " + this->component_name;
}

vtkSmartPointer<vtkDoubleArray> color_values(
  vtkDataSet* data, const Coloring& coloring, bool& on_points)
{
  if (is_tet_quantity(coloring.by))
  {
    on_points = false;
    return tet_values(data, coloring);
  }
  if (coloring.by == ColorBy::handle)
  {
    on_points = false;
    return handle_values(data, coloring);
  }
  if (coloring.by == ColorBy::rotation_cluster)
  {
    on_points = false;
    return cluster_values(data, coloring);
  }
  const AssociatedArray found = find_array(data, coloring.array);
  const int component = found.array ? find_component(found.array, coloring) : no_component;
  if (coloring.kind == Coloring::Kind::none || component == no_component)
  {
    return nullptr;
  }
  on_points = found.on_points;
  auto values = vtkSmartPointer<vtkDoubleArray>::New();
  values->SetName(color_array_name);
  values->SetNumberOfValues(found.array->GetNumberOfTuples());
  for (vtkIdType i = 0; i < values->GetNumberOfValues(); ++i)
  {
    values->SetValue(i, value_of(found.array, i, component));
  }
  if (coloring.subtracted_data)
  {
    vtkDataArray* other = find_array(coloring.subtracted_data, coloring.array).array;
    const int other_component = find_component(other, coloring);
    for (vtkIdType i = 0; i < values->GetNumberOfValues(); ++i)
    {
      values->SetValue(i, values->GetValue(i) - value_of(other, i, other_component));
    }
  }
  return values;
}

Status choose_coloring(
  const std::vector<Tile>& tiles, const PictureOptions& options, Coloring& coloring)
{
  coloring = Coloring();
  coloring.by = options.color_by;
  coloring.array = options.array;
  coloring.component = options.component;
  coloring.subtracted_data = options.subtracted_data;
  if (coloring.subtracted_data && coloring.by != ColorBy::array &&
    coloring.by != ColorBy::winding_number)
  {
    return Status::invalid_input(
      "a difference can only be shown when coloring by an array or by winding number");
  }
  if (coloring.by != ColorBy::array)
  {
    if (!coloring.array.empty() || !coloring.component.empty())
    {
      return Status::invalid_input(
        "an array name or a component can only be given when coloring by array");
    }
    if (is_tet_quantity(coloring.by))
    {
      return choose_tet_coloring(tiles, options, coloring);
    }
    if (coloring.by == ColorBy::handle)
    {
      return choose_handle_coloring(tiles, options, coloring);
    }
    if (coloring.by == ColorBy::rotation_cluster)
    {
      return choose_cluster_coloring(tiles, options, coloring);
    }
    coloring.array = coloring.by == ColorBy::row_sum ? "RawWeights"
      : coloring.by == ColorBy::rotation             ? "Rotation"
                                                     : "WindingNumber";
  }
  for (const Tile& tile : tiles)
  {
    auto* image = vtkImageData::SafeDownCast(tile.data);
    if (coloring.array.empty() && image && !array_names({ tile }).empty())
    {
      coloring.array =
        find_array(image, "WindingNumber").array ? "WindingNumber" : array_names({ tile }).front();
    }
  }
  if (coloring.array.empty())
  {
    return coloring.subtracted_data
      ? Status::invalid_input("a difference needs the name of an array")
      : options.component.empty()
      ? Status()
      : Status::invalid_input("a component needs the name of its array");
  }
  double lower = 1e300;
  double upper = -1e300;
  vtkDataArray* sample = nullptr;
  bool has_component = false;
  double squares = 0.0;
  Index count = 0;
  coloring.kind = Coloring::Kind::other;
  for (const Tile& tile : tiles)
  {
    const AssociatedArray found = find_array(tile.data, coloring.array);
    if (!found.array)
    {
      continue;
    }
    sample = found.array;
    const int component = find_component(found.array, coloring);
    if (component == no_component)
    {
      continue;
    }
    has_component = true;
    const Status match_status = coloring.subtracted_data ? check_minus(found, coloring) : Status();
    if (!match_status.ok())
    {
      return match_status;
    }
    if (found.array->GetNumberOfComponents() > 1 && component >= 0)
    {
      const char* name = found.array->GetComponentName(component);
      coloring.component_name = name && *name ? name : std::to_string(component);
    }
    bool on_points = true;
    const auto values = color_values(tile.data, coloring, on_points);
    for (vtkIdType i = 0; i < values->GetNumberOfValues(); ++i)
    {
      const double value = values->GetValue(i);
      if (std::isfinite(value))
      {
        lower = std::min(lower, value);
        upper = std::max(upper, value);
        squares += value * value;
        ++count;
      }
    }
  }
  if (!sample && coloring.by == ColorBy::row_sum)
  {
    return Status::invalid_input(
      "there is no array 'RawWeights'; bindpose weights --keep-raw writes it");
  }
  if (!sample && coloring.by == ColorBy::rotation)
  {
    return Status::invalid_input(
      "there is no array 'Rotation'; bindpose deform --rotation-arrays writes it");
  }
  if (!sample)
  {
    const std::string available = comma_separated(array_names(tiles));
    return Status::invalid_input("there is no array '" + coloring.array + "'" +
      (available.empty() ? std::string("; the data has no arrays") : "; available: " + available));
  }
  if (!has_component)
  {
    return Status::invalid_input("the array '" + coloring.array + "' has no component '" +
      coloring.component + "'; available: " + component_words(sample));
  }
  if (lower > upper)
  {
    return Status::invalid_input("the array '" + coloring.array + "' has no finite value");
  }
  const bool has_range = options.range[0] <= options.range[1];
  if (coloring.subtracted_data || coloring.by == ColorBy::row_sum)
  {
    const double center = coloring.subtracted_data ? 0.0 : 1.0;
    const double half_range = std::max(std::abs(lower - center), std::abs(upper - center));
    if (has_range && !(options.range[0] <= center && center <= options.range[1]))
    {
      return Status::invalid_input(coloring.subtracted_data
          ? "the range of a difference must contain 0"
          : "the range of row sums must contain 1");
    }
    coloring.map = diverging_map(has_range ? options.range[0] : center - half_range,
      has_range ? options.range[1] : center + half_range, center);
    if (coloring.subtracted_data)
    {
      coloring.numbers.set("picture.difference.largest", half_range);
      coloring.numbers.set(
        "picture.difference.rms", std::sqrt(squares / static_cast<double>(count)));
    }
    else
    {
      coloring.numbers.set("picture.row_sum.minimum", lower);
      coloring.numbers.set("picture.row_sum.maximum", upper);
    }
  }
  else if (coloring.array == "WindingNumber" && !has_range)
  {
    coloring.kind = Coloring::Kind::winding;
    coloring.map = winding_map();
  }
  else if (is_weights_array(coloring.array))
  {
    coloring.kind = Coloring::Kind::weights;
    choose_weight_map(options, lower, upper, coloring);
  }
  else
  {
    const bool angles = coloring.by == ColorBy::rotation;
    const double from = angles ? 0.0 : lower;
    const double to = angles ? angle_scale(upper) : upper;
    coloring.map =
      sequential_map(has_range ? options.range[0] : from, has_range ? options.range[1] : to, 0);
  }
  return Status();
}

vtkSmartPointer<vtkPolyData> contour_lines(vtkPolyData* data, const std::vector<double>& values)
{
  if (values.empty() || !data->GetPointData()->HasArray(color_array_name))
  {
    return vtkSmartPointer<vtkPolyData>::New();
  }
  vtkNew<vtkContourFilter> contours;
  contours->SetInputData(data);
  contours->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, color_array_name);
  contours->ComputeScalarsOff();
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    contours->SetValue(static_cast<int>(i), values[i]);
  }
  contours->Update();
  return contours->GetOutput();
}

} // namespace bindpose
