#ifndef bindpose_tests_render_harness_h
#define bindpose_tests_render_harness_h

// Compares pictures with baselines, strictly: no shift, no averaging, a count of pixels. (The
// defaults of vtkImageDifference call pictures equal that differ by 15 degrees of camera.)

#include "vtkSmartPointer.h"

#include <string>

class vtkImageData;

namespace bindpose::test
{

/// Two pixels differ when one of their channels differs by more than this many of 255 levels.
/// Other processors and driver versions round differently by one or two.
constexpr int pixel_level = 8;

struct Difference
{
  bool same_size = false; ///< width, height and channels
  long long pixels = 0; ///< that differ by more than pixel_level
  int largest = 0; ///< difference of any channel
};
Difference compare(vtkImageData* a, vtkImageData* b);

/// Pixels that may differ in the running test: the option DIFFERING_PIXELS of add_render_test.
long long allowed_pixels();

/// Whether the harness would let the second picture pass for the first.
bool passes(const Difference& difference);

/// Compares with baselines/NAME.png, NAME being the running test's. On failure writes
/// NAME.actual.png, NAME.baseline.png and NAME.difference.png into the build folder and says
/// where. Blessed (see tests/README.md), it makes the picture the baseline, unless an assertion
/// before it has failed.
void expect_baseline(vtkImageData* actual);

/// Red, green, blue (0 to 255) at a place in pixels from the lower left corner.
struct Pixel
{
  int r = 0, g = 0, b = 0, a = 255;
};
Pixel pixel_at(vtkImageData* image, double x, double y);

} // namespace bindpose::test

#endif
