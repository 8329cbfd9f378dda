#ifndef bindpose_tests_render_harness_h
#define bindpose_tests_render_harness_h

// Strict comparison of pictures with baselines. The comparison counts differing pixels, without
// shifting or averaging pictures. The defaults of vtkImageDifference are too tolerant: they accept
// a camera that is rotated by 15 degrees.

#include "vtkSmartPointer.h"

#include <string>

class vtkImageData;

namespace bindpose::test
{

/// Two pixels differ if a channel differs by more than this many of the 255 levels. Rounding on
/// other processors and driver versions differs by one or two levels.
constexpr int channel_tolerance = 8;

struct Difference
{
  bool same_size = false; ///< width, height and channels are equal
  long long pixels = 0; ///< number of pixels that differ by more than channel_tolerance
  int largest = 0; ///< largest difference of any channel
};
Difference compare(vtkImageData* a, vtkImageData* b);

/// Return the number of pixels that may differ in the running test (DIFFERING_PIXELS of
/// add_render_test).
long long allowed_pixels();

/// Report whether the difference is within the tolerance of the running test.
bool passes(const Difference& difference);

/// Compare a picture with baselines/NAME.png, where NAME is the running test. On failure, write
/// NAME.actual.png, NAME.baseline.png and NAME.difference.png into the build folder and print their
/// path. With --bless (see tests/README.md), write the picture as the new baseline, unless an
/// earlier assertion has failed.
void expect_baseline(vtkImageData* actual);

/// A color with channels from 0 to 255.
struct Pixel
{
  int r = 0, g = 0, b = 0, a = 255;
};
/// Return the color at a position in pixels from the lower left corner. For a position outside of
/// the image, return the color of the nearest pixel.
Pixel pixel_at(vtkImageData* image, double x, double y);

} // namespace bindpose::test

#endif
