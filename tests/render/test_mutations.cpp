// Tests of the picture comparison: equal pictures pass, and the smallest relevant changes of a
// picture fail.
#include "render/harness.h"
#include "render/shapes.h"

#include "vtkImageData.h"
#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <cstdio>

using namespace bindpose;
using namespace bindpose::test;

namespace
{
vtkSmartPointer<vtkImageData> picture_of_finger(const PictureOptions& options)
{
  vtkSmartPointer<vtkImageData> image;
  const Status status = render_to_image({ { finger(), nullptr, "" } }, options, image);
  EXPECT_TRUE(status.ok()) << status.message;
  return image;
}
} // namespace

TEST(Render, mutations)
{
  PictureOptions options = small_picture();
  options.array = "Weights";
  options.component = "right";
  options.range = { 0.0, 1.0 };
  const auto original = picture_of_finger(options);
  const Difference redrawn = compare(original, picture_of_finger(options));
  EXPECT_TRUE(passes(redrawn));
  EXPECT_EQ(redrawn.largest, 0) << "the same scene drawn twice";

  const auto expect_caught = [&](const char* what, const PictureOptions& mutated)
  {
    const Difference difference = compare(original, picture_of_finger(mutated));
    std::printf(
      "%s: %lld pixels differ, %lld allowed\n", what, difference.pixels, allowed_pixels());
    EXPECT_FALSE(passes(difference)) << what;
    // Each change must be detected even if the tolerance is ten times larger.
    EXPECT_GT(difference.pixels, 10 * allowed_pixels()) << what;
  };
  PictureOptions rotated_options = options;
  rotated_options.view.azimuth = 1.0;
  expect_caught("camera 1 degree to the right", rotated_options);
  PictureOptions raised_options = options;
  raised_options.view.elevation = 1.0;
  expect_caught("camera 1 degree up", raised_options);
  PictureOptions recolored_options = options;
  recolored_options.range = { 0.0, 1.02 };
  expect_caught("color range 2 % wider", recolored_options);
  PictureOptions options_without_isolines = options;
  options_without_isolines.isolines = false;
  expect_caught("no isolines", options_without_isolines);
  PictureOptions zoomed_options = options;
  zoomed_options.view.zoom = 1.01;
  expect_caught("1 % larger", zoomed_options);
  PictureOptions wider_options = options;
  wider_options.width = 401;
  EXPECT_FALSE(passes(compare(original, picture_of_finger(wider_options)))) << "another size";
}
