#include "document/dataset_json.h"

#include "vtkAbstractArray.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

using nlohmann::json;

namespace
{
constexpr int maximum_components = 1000000;

/// Names of array types in the file. Arrays of other types are written as doubles.
const struct
{
  int type;
  const char* name;
} types[] = { { VTK_DOUBLE, "double" }, { VTK_FLOAT, "float" }, { VTK_INT, "int32" },
  { VTK_ID_TYPE, "id" }, { VTK_LONG_LONG, "int64" }, { VTK_UNSIGNED_CHAR, "uint8" },
  { VTK_SIGNED_CHAR, "int8" }, { VTK_CHAR, "char" } };

bool is_real(int type)
{
  return type == VTK_DOUBLE || type == VTK_FLOAT;
}

json array_to_json(vtkAbstractArray* array)
{
  json result = { { "name", array->GetName() }, { "components", array->GetNumberOfComponents() } };
  json& values = result["values"] = json::array();
  if (auto* texts = vtkStringArray::SafeDownCast(array))
  {
    result["type"] = "text";
    for (vtkIdType i = 0; i < texts->GetNumberOfValues(); ++i)
    {
      values.push_back(std::string(texts->GetValue(i)));
    }
    return result;
  }
  auto* numbers = vtkDataArray::SafeDownCast(array);
  int type = VTK_DOUBLE;
  result["type"] = "double";
  for (const auto& known : types)
  {
    if (known.type == numbers->GetDataType())
    {
      type = known.type;
      result["type"] = known.name;
    }
  }
  for (vtkIdType i = 0; i < numbers->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < numbers->GetNumberOfComponents(); ++c)
    {
      const double value = numbers->GetComponent(i, c);
      if (is_real(type))
      {
        values.push_back(value); // a value that is not finite is written as null
      }
      else
      {
        values.push_back(static_cast<std::int64_t>(value));
      }
    }
  }
  return result;
}

vtkSmartPointer<vtkAbstractArray> array_from_json(const json& value, vtkIdType tuples)
{
  const std::string name = json_text(json_at(value, "name"), "the name of a handle array");
  const std::string type = json_text(json_at(value, "type"), "the type of a handle array");
  const int components = json_integer(json_at(value, "components"),
    "the number of components of a handle array", 1, maximum_components);
  const json& values = json_at(value, "values");
  if (!values.is_array() || values.size() != static_cast<std::size_t>(tuples) * components)
  {
    throw SessionError("the handle array '" + name + "' must have " +
      std::to_string(tuples * components) + " values");
  }
  if (type == "text")
  {
    auto texts = vtkSmartPointer<vtkStringArray>::New();
    texts->SetName(name.c_str());
    texts->SetNumberOfComponents(components);
    for (const json& text : values)
    {
      texts->InsertNextValue(json_text(text, "a value of a text array of the handles"));
    }
    return texts;
  }
  for (const auto& known : types)
  {
    if (type != known.name)
    {
      continue;
    }
    auto numbers = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(known.type));
    numbers->SetName(name.c_str());
    numbers->SetNumberOfComponents(components);
    numbers->SetNumberOfTuples(tuples);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      const bool is_nan = values[i].is_null() && is_real(known.type);
      const double number = is_nan ? std::numeric_limits<double>::quiet_NaN()
                                   : json_number(values[i], "a value of a handle array");
      if (number < numbers->GetDataTypeMin() || number > numbers->GetDataTypeMax())
      {
        throw SessionError("a value of the handle array '" + name + "' is out of range");
      }
      numbers->SetComponent(
        static_cast<vtkIdType>(i / components), static_cast<int>(i % components), number);
    }
    return numbers;
  }
  throw SessionError("the handle array '" + name + "' has the unknown type '" + type + "'");
}

json cells_to_json(vtkCellArray* cells)
{
  json result = json::array();
  const auto each = vtk::TakeSmartPointer(cells->NewIterator());
  for (each->GoToFirstCell(); !each->IsDoneWithTraversal(); each->GoToNextCell())
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    each->GetCurrentCell(size, ids);
    result.push_back(std::vector<vtkIdType>(ids, ids + size));
  }
  return result;
}

vtkSmartPointer<vtkCellArray> cells_from_json(const json& list, vtkIdType points)
{
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  if (!list.is_array())
  {
    throw SessionError("the handle cells must be a list");
  }
  for (const json& cell : list)
  {
    if (!cell.is_array() || cell.empty())
    {
      throw SessionError("a handle cell must be a nonempty list of point ids");
    }
    cells->InsertNextCell(static_cast<int>(cell.size()));
    for (const json& id : cell)
    {
      cells->InsertCellPoint(
        json_integer(id, "a point id of a handle cell", 0, static_cast<int>(points) - 1));
    }
  }
  return cells;
}

const char* const cell_kinds[] = { "vertices", "lines", "polygons" };
} // namespace

const json& json_at(const json& object, const char* key)
{
  if (!object.is_object())
  {
    throw SessionError(std::string("expected an object with the key '") + key + "'");
  }
  const auto found = object.find(key);
  if (found == object.end())
  {
    throw SessionError(std::string("the key '") + key + "' is missing");
  }
  return *found;
}

double json_number(const json& value, const char* value_name)
{
  if (!value.is_number() || !std::isfinite(value.get<double>()))
  {
    throw SessionError(std::string(value_name) + " must be a finite number");
  }
  return value.get<double>();
}

int json_integer(const json& value, const char* value_name, int lowest, int highest)
{
  const double number = json_number(value, value_name);
  if (number != std::floor(number) || number < lowest || number > highest)
  {
    throw SessionError(std::string(value_name) + " must be an integer from " +
      std::to_string(lowest) + " to " + std::to_string(highest));
  }
  return static_cast<int>(number);
}

std::string json_text(const json& value, const char* value_name)
{
  if (!value.is_string())
  {
    throw SessionError(std::string(value_name) + " must be a string");
  }
  return value.get<std::string>();
}

// ---- Handles -----------------------------------------------------------------------------------

json handles_to_json(vtkPolyData* handles)
{
  json result;
  vtkPoints* points = handles->GetPoints();
  result["points_type"] = points && points->GetDataType() == VTK_FLOAT ? "float" : "double";
  json& point_list = result["points"] = json::array();
  for (vtkIdType v = 0; v < handles->GetNumberOfPoints(); ++v)
  {
    double p[3];
    handles->GetPoint(v, p);
    point_list.push_back({ p[0], p[1], p[2] });
  }
  result["vertices"] = cells_to_json(handles->GetVerts());
  result["lines"] = cells_to_json(handles->GetLines());
  result["polygons"] = cells_to_json(handles->GetPolys());
  json& arrays = result["cell_arrays"] = json::array();
  for (int a = 0; a < handles->GetCellData()->GetNumberOfArrays(); ++a)
  {
    vtkAbstractArray* array = handles->GetCellData()->GetAbstractArray(a);
    const bool known = vtkStringArray::SafeDownCast(array) || vtkDataArray::SafeDownCast(array);
    if (known && array->GetName())
    {
      arrays.push_back(array_to_json(array));
    }
  }
  return result;
}

vtkSmartPointer<vtkPolyData> handles_from_json(const json& value)
{
  auto handles = vtkSmartPointer<vtkPolyData>::New();
  const std::string type =
    json_text(json_at(value, "points_type"), "the type of the handle points");
  const json& point_list = json_at(value, "points");
  if (!point_list.is_array() || (type != "float" && type != "double"))
  {
    throw SessionError("the handle points must be a list with points_type 'float' or 'double'");
  }
  vtkNew<vtkPoints> points;
  points->SetDataType(type == "float" ? VTK_FLOAT : VTK_DOUBLE);
  for (const json& coordinates : point_list)
  {
    if (!coordinates.is_array() || coordinates.size() != 3)
    {
      throw SessionError("a handle point must have three coordinates");
    }
    double p[3];
    for (int k = 0; k < 3; ++k)
    {
      p[k] = json_number(coordinates[k], "a coordinate of a handle point");
    }
    points->InsertNextPoint(p);
  }
  handles->SetPoints(points);
  vtkSmartPointer<vtkCellArray> cells[3];
  for (int kind = 0; kind < 3; ++kind)
  {
    cells[kind] = cells_from_json(json_at(value, cell_kinds[kind]), points->GetNumberOfPoints());
  }
  handles->SetVerts(cells[0]);
  handles->SetLines(cells[1]);
  handles->SetPolys(cells[2]);
  const json& arrays = json_at(value, "cell_arrays");
  if (!arrays.is_array())
  {
    throw SessionError("the handle arrays must be a list");
  }
  for (const json& array : arrays)
  {
    handles->GetCellData()->AddArray(array_from_json(array, handles->GetNumberOfCells()));
  }
  return handles;
}

// ---- Poses -------------------------------------------------------------------------------------

json pose_to_json(const bindpose::HandlePose& pose)
{
  return { { "mode", bindpose::to_string(pose.mode) },
    { "transform", std::vector<double>(pose.transform.data(), pose.transform.data() + 12) },
    { "stretch", pose.stretch }, { "twist", { pose.twist[0], pose.twist[1] } } };
}

bindpose::HandlePose pose_from_json(const json& value)
{
  bindpose::HandlePose pose;
  const std::string mode = json_text(json_at(value, "mode"), "the mode of a pose");
  const auto& words = bindpose::handle_mode_words;
  const auto* const word = std::find(std::begin(words), std::end(words), mode);
  const bool known = word != std::end(words);
  pose.mode = static_cast<bindpose::HandleMode>(known ? word - std::begin(words) : 0);
  const json& transform = json_at(value, "transform");
  const json& twist = json_at(value, "twist");
  if (!known || !transform.is_array() || transform.size() != 12 || !twist.is_array() ||
    twist.size() != 2)
  {
    throw SessionError("the pose of a handle must have a known mode, a transform of 12 numbers and "
                       "a twist of 2 numbers");
  }
  for (int k = 0; k < 12; ++k)
  {
    pose.transform.data()[k] = json_number(transform[k], "a number of a pose transform");
  }
  for (int k = 0; k < 2; ++k)
  {
    pose.twist[k] = json_number(twist[k], "the twist of a pose");
  }
  pose.stretch = json_number(json_at(value, "stretch"), "the stretch of a pose");
  return pose;
}

json stored_poses_to_json(const bindpose::StoredPoses& poses)
{
  return json(bindpose::to_json(poses));
}

bindpose::StoredPoses stored_poses_from_json(const json& value)
{
  bindpose::StoredPoses result;
  const bindpose::Status status = bindpose::from_json(nlohmann::ordered_json(value), result);
  if (!status.ok())
  {
    throw SessionError(status.message);
  }
  return result;
}

// ---- Options -----------------------------------------------------------------------------------

json options_to_json(const Options& options)
{
  json result = json::object();
  for (auto option = options.begin(); option != options.end(); ++option)
  {
    json& value = result[option.key().toStdString()];
    switch (option.value().type())
    {
      case QVariant::Bool:
        value = option.value().toBool();
        break;
      case QVariant::Int:
      {
        const OptionInfo* info = find_option(option.key());
        const int number = option.value().toInt();
        if (info && number >= 0 && number < static_cast<int>(info->choices.size()))
        {
          value = info->choices[static_cast<std::size_t>(number)].word;
        }
        else
        {
          value = number;
        }
        break;
      }
      case QVariant::List:
        for (const QVariant& number : option.value().toList())
        {
          value.push_back(number.toDouble());
        }
        break;
      default:
        value = option.value().toDouble();
        break;
    }
  }
  return result;
}

namespace
{
/// Convert a JSON value to the value of an option. Return an invalid variant for JSON types that no
/// option has.
QVariant value_from_json(const json& value)
{
  if (value.is_string())
  {
    return QString::fromStdString(value.get<std::string>());
  }
  if (value.is_boolean())
  {
    return value.get<bool>();
  }
  if (value.is_array())
  {
    QVariantList list;
    for (const json& item : value)
    {
      list << value_from_json(item);
    }
    return list;
  }
  return value.is_number() ? QVariant(value.get<double>()) : QVariant();
}
} // namespace

Options options_from_json(const json& value)
{
  Options result = initial_options();
  if (!value.is_object())
  {
    throw SessionError("the options must be an object");
  }
  for (const auto& [key, item] : value.items())
  {
    const OptionInfo* option = find_option(QString::fromStdString(key));
    if (!option)
    {
      continue; // ignore an option of another version of the program
    }
    const QVariant checked = checked_option(*option, value_from_json(item));
    if (!checked.isValid())
    {
      throw SessionError("the option '" + key + "' has an invalid value");
    }
    result[option->key] = checked;
  }
  return result;
}
