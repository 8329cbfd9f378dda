// Escaping of names for VTK's XML writers (see xml_names.h).
#include "xml_names.h"

#include "base/text_check.h"

#include "vtkAbstractArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"

#include <array>
#include <string>
#include <vector>

namespace bindpose
{

namespace
{
std::string escaped_text(const std::string& text)
{
  std::string escaped;
  for (const char c : text)
  {
    escaped += c == '&' ? "&amp;"
      : c == '<'        ? "&lt;"
      : c == '>'        ? "&gt;"
      : c == '"'        ? "&quot;"
                        : std::string(1, c);
  }
  return escaped;
}

std::string name_of(vtkAbstractArray* array)
{
  return array->GetName() ? array->GetName() : "";
}

std::string component_name(vtkAbstractArray* array, int component)
{
  const char* name = array->GetComponentName(component);
  return name ? name : "";
}

bool must_escape(vtkAbstractArray* array)
{
  bool found = escaped_text(name_of(array)) != name_of(array);
  for (int c = 0; !found && array->HasAComponentName() && c < array->GetNumberOfComponents(); ++c)
  {
    found = escaped_text(component_name(array, c)) != component_name(array, c);
  }
  return found;
}

Status check_names(vtkAbstractArray* array)
{
  const std::string error = find_text_error(name_of(array));
  if (!error.empty())
  {
    return Status::invalid_input(
      "the name of an array contains " + error + ", which XML files cannot store");
  }
  for (int c = 0; array->HasAComponentName() && c < array->GetNumberOfComponents(); ++c)
  {
    const std::string component_error = find_text_error(component_name(array, c));
    if (!component_error.empty())
    {
      return Status::invalid_input("the name of component " + std::to_string(c) + " of array '" +
        name_of(array) + "' contains " + component_error + ", which XML files cannot store");
    }
  }
  return {};
}

/// Return a copy of an array with escaped names. Numeric arrays share their values.
vtkSmartPointer<vtkAbstractArray> with_escaped_names(vtkAbstractArray* array)
{
  auto copy = vtk::TakeSmartPointer(array->NewInstance());
  if (auto* numbers = vtkDataArray::SafeDownCast(array))
  {
    vtkDataArray::SafeDownCast(copy)->ShallowCopy(numbers);
  }
  else
  {
    copy->DeepCopy(array);
  }
  copy->SetName(escaped_text(name_of(array)).c_str());
  for (int c = 0; array->HasAComponentName() && c < array->GetNumberOfComponents(); ++c)
  {
    copy->SetComponentName(c, escaped_text(component_name(array, c)).c_str());
  }
  return copy;
}

/// Replace each array whose names must be escaped by a copy with escaped names. Keep the order of
/// the arrays and the active attributes.
void escape_arrays(vtkFieldData* data)
{
  auto* attributes = vtkDataSetAttributes::SafeDownCast(data);
  std::array<int, vtkDataSetAttributes::NUM_ATTRIBUTES> active{};
  if (attributes)
  {
    attributes->GetAttributeIndices(active.data());
  }
  std::vector<vtkSmartPointer<vtkAbstractArray>> arrays;
  for (int k = 0; k < data->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* array = data->GetAbstractArray(k);
    arrays.emplace_back(array);
    if (must_escape(array))
    {
      arrays.back() = with_escaped_names(array);
    }
  }
  data->Initialize();
  for (const auto& array : arrays)
  {
    data->AddArray(array);
  }
  for (int a = 0; attributes && a < vtkDataSetAttributes::NUM_ATTRIBUTES; ++a)
  {
    if (active[a] >= 0)
    {
      attributes->SetActiveAttribute(active[a], a);
    }
  }
}
} // namespace

Status escape_names(vtkDataSet* data, vtkSmartPointer<vtkDataSet>& escaped)
{
  escaped = data;
  bool found = false;
  const std::array<vtkFieldData*, 3> all{ data->GetPointData(), data->GetCellData(),
    data->GetFieldData() };
  for (vtkFieldData* fields : all)
  {
    for (int k = 0; k < fields->GetNumberOfArrays(); ++k)
    {
      Status status = check_names(fields->GetAbstractArray(k));
      if (!status.ok())
      {
        return status;
      }
      found = found || must_escape(fields->GetAbstractArray(k));
    }
  }
  if (found)
  {
    escaped = vtk::TakeSmartPointer(data->NewInstance());
    escaped->ShallowCopy(data);
    escape_arrays(escaped->GetPointData());
    escape_arrays(escaped->GetCellData());
    escape_arrays(escaped->GetFieldData());
  }
  return {};
}

} // namespace bindpose
