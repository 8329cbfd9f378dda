#include "shapes/surroundings.h"

#include "base/constants.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkOpenGLRenderer.h"
#include "vtkPBRLUTTexture.h"
#include "vtkPBRPrefilterTexture.h"
#include "vtkPointData.h"
#include "vtkTexture.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
/// Return a panorama of the sky: its columns are directions around the vertical axis, its rows
/// angles above the horizon, from the bottom.
vtkSmartPointer<vtkImageData> make_sky()
{
  constexpr int rows = 32, columns = 2 * rows;
  // Radiance at the horizon, and difference to the zenith. With the lights of add_lights(), a dull
  // white surface is nearly white, but not overexposed.
  constexpr double horizon = 0.44, gradient = 0.36;
  vtkNew<vtkFloatArray> colors;
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(rows * columns);
  for (int k = 0; k < rows * columns; ++k)
  {
    const double angle = ((k / columns + 0.5) / rows - 0.5) * pi;
    const double value = horizon + gradient * std::sin(angle);
    colors->SetTuple3(k, value, value, value);
  }
  auto sky = vtkSmartPointer<vtkImageData>::New();
  sky->SetDimensions(columns, rows, 1);
  sky->GetPointData()->SetScalars(colors);
  return sky;
}
} // namespace

void add_surroundings(vtkRenderer* renderer, const Vec3& up)
{
  vtkNew<vtkTexture> sky;
  sky->SetInputData(make_sky());
  sky->SetColorModeToDirectScalars();
  sky->InterpolateOn();
  sky->MipmapOn();
  renderer->UseImageBasedLightingOn();
  renderer->SetEnvironmentTexture(sky);
  const Vec3 direction = up.normalized();
  const Vec3 right = direction.unitOrthogonal();
  renderer->SetEnvironmentUp(direction[0], direction[1], direction[2]);
  renderer->SetEnvironmentRight(right[0], right[1], right[2]);
  if (auto* opengl = vtkOpenGLRenderer::SafeDownCast(renderer))
  {
    // VTK's defaults are for detailed panoramas, and take several seconds without a graphics card.
    opengl->GetEnvMapPrefiltered()->SetPrefilterMaxSamples(32);
    opengl->GetEnvMapPrefiltered()->SetPrefilterLevels(4);
    opengl->GetEnvMapLookupTable()->SetLUTSize(64);
    opengl->GetEnvMapLookupTable()->SetLUTSamples(64);
  }
}

} // namespace bindpose
