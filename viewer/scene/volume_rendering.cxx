#include "scene/volume_rendering.h"

#include "scene/colors.h"

#include "vtkColorTransferFunction.h"
#include "vtkDataArray.h"
#include "vtkFixedPointVolumeRayCastMapper.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bindpose
{
namespace
{
// The range of winding_map(). Values outside get the color of the nearest end.
constexpr double lowest = -1.0;
constexpr double highest = 2.0;
} // namespace

double winding_opacity(double winding_number, double step)
{
  const auto step_opacity = [step](double opacity) { return 1.0 - std::pow(1.0 - opacity, step); };
  const std::array<std::array<double, 2>, 12> control_points = { { { -1.0, step_opacity(0.24) },
    { -0.5, step_opacity(0.1) }, { -0.1, step_opacity(0.008) }, { -0.02, 0.0 }, { 0.02, 0.0 },
    { 0.25, 0.004 }, { 0.42, 0.6 }, { 0.58, 0.6 }, { 0.75, step_opacity(0.03) },
    { 1.02, step_opacity(0.03) }, { 1.1, step_opacity(0.04) }, { 2.0, step_opacity(0.24) } } };
  const double w = std::clamp(winding_number, lowest, highest);
  std::size_t next = 1;
  while (next + 1 < control_points.size() && w > control_points[next][0])
  {
    ++next;
  }
  const auto& from = control_points[next - 1];
  const auto& to = control_points[next];
  return from[1] + (w - from[0]) / (to[0] - from[0]) * (to[1] - from[1]);
}

vtkSmartPointer<vtkVolume> make_winding_volume(
  vtkImageData* image, const std::string& array, double pixels)
{
  // Clamp the values, because the mapper spreads its color table over the range of the values.
  vtkDataArray* values = image->GetPointData()->GetArray(array.c_str());
  vtkNew<vtkFloatArray> clamped;
  clamped->SetName(array.c_str());
  clamped->SetNumberOfValues(values->GetNumberOfTuples());
  for (vtkIdType i = 0; i < clamped->GetNumberOfValues(); ++i)
  {
    clamped->SetValue(
      i, static_cast<float>(std::clamp(values->GetComponent(i, 0), lowest, highest)));
  }
  vtkNew<vtkImageData> clamped_image;
  clamped_image->CopyStructure(image);
  clamped_image->GetPointData()->SetScalars(clamped);

  double spacing[3];
  image->GetSpacing(spacing);
  const double step = *std::min_element(spacing, spacing + 3);
  vtkNew<vtkColorTransferFunction> colors;
  vtkNew<vtkPiecewiseFunction> opacities;
  // number of table entries; each is 0.005 wide, so that the jumps of the map at -0.02 and 1.02
  // stay sharp
  constexpr int count = 600;
  for (int i = 0; i <= count; ++i)
  {
    const double w = lowest + (highest - lowest) * i / count;
    const Rgb c = winding_color(w);
    colors->AddRGBPoint(w, c[0], c[1], c[2]);
    opacities->AddPoint(w, winding_opacity(w, step / (0.01 * image->GetLength())));
  }
  vtkNew<vtkVolumeProperty> property;
  property->SetColor(colors);
  property->SetScalarOpacity(opacities);
  property->SetScalarOpacityUnitDistance(step);
  property->SetInterpolationTypeToLinear();
  property->ShadeOn();
  property->SetAmbient(0.58);
  property->SetDiffuse(0.46);
  property->SetSpecular(0.0);

  vtkNew<vtkFixedPointVolumeRayCastMapper> mapper;
  mapper->SetInputData(clamped_image);
  mapper->SetSampleDistance(static_cast<float>(0.25 * step));
  mapper->SetInteractiveSampleDistance(static_cast<float>(0.5 * step));
  mapper->SetAutoAdjustSampleDistances(pixels <= 0.0);
  if (pixels > 0.0)
  {
    mapper->SetImageSampleDistance(static_cast<float>(pixels));
  }
  auto volume = vtkSmartPointer<vtkVolume>::New();
  volume->SetMapper(mapper);
  volume->SetProperty(property);
  return volume;
}

} // namespace bindpose
