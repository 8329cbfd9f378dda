// Connects the kernel bindpose::weighted_colors() to VTK.
#include "vtkWeightedColors.h"

#include "base/execution.h"
#include "weight_uses/weighted_colors.h"
#include "weights_input.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>

using namespace bindpose;

vtkStandardNewMacro(vtkWeightedColors);

namespace
{
/// Read the cells' colors, one row per handle. For unsigned chars, 255 becomes 1. If all three
/// components are NaN, the cell has no color, and its row is not changed.
Status to_colors(vtkDataArray* array, const WeightsInput& input, Colors& colors)
{
  const std::string name = std::string("the handles' array '") + array->GetName() + "'";
  if (array->GetNumberOfComponents() != 3)
  {
    return Status::invalid_input(name + " has " + std::to_string(array->GetNumberOfComponents()) +
      " components; expected 3 (RGB)");
  }
  const double unit = array->GetDataType() == VTK_UNSIGNED_CHAR ? 255.0 : 1.0;
  for (Index j = 0; j < colors.rows(); ++j)
  {
    const std::size_t handle = static_cast<std::size_t>(j);
    double handle_color[3];
    array->GetTuple(input.cells[handle], handle_color);
    if (std::isnan(handle_color[0]) && std::isnan(handle_color[1]) && std::isnan(handle_color[2]))
    {
      continue;
    }
    for (int k = 0; k < 3; ++k)
    {
      colors(j, k) = handle_color[k] / unit;
      if (!(colors(j, k) >= 0.0 && colors(j, k) <= 1.0))
      {
        return Status::invalid_input(name + " has a value outside the range 0 to 1 at handle '" +
          input.handles[handle].name + "'; colors from 0 to 255 must be stored as unsigned chars");
      }
    }
  }
  return {};
}

template <typename Array>
vtkSmartPointer<Array> make_array(const char* name, int components, Index tuples)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}
} // namespace

void vtkWeightedColors::SetArrayName(const std::string& name)
{
  if (this->ArrayName != name)
  {
    this->ArrayName = name;
    this->Modified();
  }
}

void vtkWeightedColors::SetColorArrayName(const std::string& name)
{
  if (this->ColorArrayName != name)
  {
    this->ColorArrayName = name;
    this->Modified();
  }
}

Status vtkWeightedColors::Execute(
  ExecutionContext& context, vtkInformationVector** input, vtkInformationVector* output)
{
  const Phase phase(context, "blend");
  vtkPointSet* mesh = vtkPointSet::GetData(input[0]);
  vtkPolyData* handles = vtkPolyData::GetData(input[1]);
  vtkPointSet* result = vtkPointSet::GetData(output);
  WeightsInput weights;
  Status status = to_weights_input(mesh, this->ArrayName, handles, weights);
  if (!status.ok())
  {
    return status;
  }
  const auto count = static_cast<Index>(weights.handles.size());
  Colors handle_colors = categorical_colors(count);
  vtkDataArray* color_array = handles->GetCellData()->GetArray(this->ColorArrayName.c_str());
  if (color_array)
  {
    status = to_colors(color_array, weights, handle_colors);
    if (!status.ok())
    {
      return status;
    }
  }
  WeightedColorsOptions options;
  options.linear_light = this->LinearLight;
  options.clamp = this->Clamp;
  WeightedColors blend;
  status = weighted_colors(context, weights.weights.view(), handle_colors, options, blend);
  if (!status.usable())
  {
    return status;
  }
  const Index rows = blend.colors.rows();
  const auto bytes = make_array<vtkUnsignedCharArray>("Color", 3, rows);
  const auto values = make_array<vtkDoubleArray>("ColorValues", 3, rows);
  const auto outside = make_array<vtkUnsignedCharArray>("OutOfGamut", 1, rows);
  std::copy(blend.colors.data(), blend.colors.data() + blend.colors.size(), values->GetPointer(0));
  std::copy(blend.out_of_gamut.begin(), blend.out_of_gamut.end(), outside->GetPointer(0));
  for (Index i = 0; i < blend.colors.size(); ++i)
  {
    const double shown = std::min(1.0, std::max(0.0, blend.colors.data()[i]));
    bytes->SetValue(i, static_cast<unsigned char>(std::lround(255.0 * shown)));
  }
  result->ShallowCopy(mesh);
  for (vtkDataArray* array : { static_cast<vtkDataArray*>(values.Get()),
         static_cast<vtkDataArray*>(outside.Get()), static_cast<vtkDataArray*>(bytes.Get()) })
  {
    result->GetPointData()->AddArray(array);
  }
  result->GetPointData()->SetActiveScalars("Color");
  status.report.set("counts.vertices", rows);
  status.report.set("counts.handles", count);
  status.report.set("colors", color_array ? this->ColorArrayName : std::string("categorical"));
  return status;
}

void vtkWeightedColors::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ArrayName: " << this->ArrayName << "\n";
  os << indent << "ColorArrayName: " << this->ColorArrayName << "\n";
  os << indent << "LinearLight: " << (this->LinearLight ? "on" : "off") << "\n";
  os << indent << "Clamp: " << (this->Clamp ? "on" : "off") << "\n";
}
