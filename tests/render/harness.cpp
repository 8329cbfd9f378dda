// The program that runs all render tests.
// usage: bindpose_render_tests NAME [--differing-pixels N] [--bless]
// It runs the test Render.NAME. The environment variable BINDPOSE_BLESS=NAME has the effect of
// --bless: the picture becomes the new baseline.
#include "render/harness.h"

#include "pictures/display.h"
#include "pictures/picture.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPNGReader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>

namespace bindpose::test
{
namespace
{
std::string test_name;
long long allowed_differing_pixels = 0;
bool update_baselines = false;

const unsigned char* pixel_pointer(vtkImageData* image, int x, int y)
{
  return static_cast<const unsigned char*>(image->GetScalarPointer(x, y, 0));
}

// Return a picture of the differences: equal pixels are gray, tolerated differences pink, and other
// differences red.
vtkSmartPointer<vtkImageData> difference_image(vtkImageData* a, vtkImageData* b)
{
  int size[3];
  a->GetDimensions(size);
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(size);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int y = 0; y < size[1]; ++y)
  {
    for (int x = 0; x < size[0]; ++x)
    {
      const unsigned char* p = pixel_pointer(a, x, y);
      const unsigned char* q = pixel_pointer(b, x, y);
      int largest = 0;
      for (int k = 0; k < a->GetNumberOfScalarComponents(); ++k)
      {
        largest = std::max(largest, std::abs(p[k] - q[k]));
      }
      auto* to = static_cast<unsigned char*>(image->GetScalarPointer(x, y, 0));
      const auto pale = static_cast<unsigned char>(200 + p[1] / 5);
      to[0] = largest > 0 ? 255 : pale;
      to[1] = to[2] = largest > channel_tolerance ? 0 : largest > 0 ? 200 : pale;
    }
  }
  return image;
}

bool exists(const std::string& path)
{
  return std::ifstream(path).good();
}
} // namespace

Difference compare(vtkImageData* a, vtkImageData* b)
{
  Difference difference;
  int size_a[3];
  int size_b[3];
  a->GetDimensions(size_a);
  b->GetDimensions(size_b);
  const int channels = a->GetNumberOfScalarComponents();
  difference.same_size =
    std::equal(size_a, size_a + 3, size_b) && channels == b->GetNumberOfScalarComponents();
  if (!difference.same_size)
  {
    return difference;
  }
  for (int y = 0; y < size_a[1]; ++y)
  {
    for (int x = 0; x < size_a[0]; ++x)
    {
      const unsigned char* p = pixel_pointer(a, x, y);
      const unsigned char* q = pixel_pointer(b, x, y);
      int largest = 0;
      for (int k = 0; k < channels; ++k)
      {
        largest = std::max(largest, std::abs(p[k] - q[k]));
      }
      difference.pixels += largest > channel_tolerance;
      difference.largest = std::max(difference.largest, largest);
    }
  }
  return difference;
}

long long allowed_pixels()
{
  return allowed_differing_pixels;
}

bool passes(const Difference& difference)
{
  return difference.same_size && difference.pixels <= allowed_differing_pixels;
}

void expect_baseline(vtkImageData* actual)
{
  ASSERT_NE(actual, nullptr);
  const std::string baseline_path = std::string(BINDPOSE_BASELINES) + "/" + test_name + ".png";
  const std::string output = std::string(BINDPOSE_RENDER_OUTPUT) + "/" + test_name;
  if (update_baselines)
  {
    ASSERT_FALSE(testing::Test::HasFailure()) << "a picture with wrong numbers is not blessed";
    const Status status = write_png(actual, baseline_path, true);
    ASSERT_TRUE(status.ok()) << status.message;
    std::printf("blessed %s\n", baseline_path.c_str());
    return;
  }
  for (const char* kind : { ".actual.png", ".baseline.png", ".difference.png" })
  {
    std::remove((output + kind).c_str());
  }
  if (!exists(baseline_path))
  {
    write_png(actual, output + ".actual.png", true);
    FAIL() << "there is no baseline; look at " << output << ".actual.png, then run\n"
           << "tests/run.sh --bless " << test_name;
  }
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(baseline_path.c_str());
  reader->Update();
  vtkImageData* baseline = reader->GetOutput();
  const Difference difference = compare(baseline, actual);
  std::printf("%s: %lld pixels differ by more than %d levels (%lld allowed), the most by %d\n",
    test_name.c_str(), difference.pixels, channel_tolerance, allowed_differing_pixels,
    difference.largest);
  if (!passes(difference))
  {
    write_png(actual, output + ".actual.png", true);
    write_png(baseline, output + ".baseline.png", true);
    if (difference.same_size)
    {
      write_png(difference_image(baseline, actual), output + ".difference.png", true);
    }
    FAIL() << (difference.same_size ? "the picture has changed" : "the picture's size has changed")
           << "; compare " << output << ".{baseline,actual,difference}.png";
  }
}

Pixel pixel_at(vtkImageData* image, double x, double y)
{
  int size[3];
  image->GetDimensions(size);
  const int column = std::clamp(static_cast<int>(std::floor(x)), 0, size[0] - 1);
  const int row = std::clamp(static_cast<int>(std::floor(y)), 0, size[1] - 1);
  const unsigned char* p = pixel_pointer(image, column, row);
  Pixel pixel{ p[0], p[1], p[2] };
  if (image->GetNumberOfScalarComponents() == 4)
  {
    pixel.a = p[3];
  }
  return pixel;
}

} // namespace bindpose::test

int main(int argc, char** argv)
{
  using namespace bindpose::test;
  testing::InitGoogleTest(&argc, argv);
  for (int i = 1; i < argc; ++i)
  {
    if (std::strcmp(argv[i], "--bless") == 0)
    {
      update_baselines = true;
    }
    else if (std::strcmp(argv[i], "--differing-pixels") == 0 && i + 1 < argc)
    {
      allowed_differing_pixels = std::atoll(argv[++i]);
    }
    else
    {
      test_name = argv[i];
    }
  }
  const char* blessed = std::getenv("BINDPOSE_BLESS");
  update_baselines = update_baselines || (blessed && test_name == blessed);
  if (!bindpose::can_render())
  {
    std::fprintf(stderr, "FAILED: %s\n", bindpose::no_display_message());
    return 1;
  }
  testing::GTEST_FLAG(filter) = "Render." + test_name;
  const int result = RUN_ALL_TESTS();
  if (testing::UnitTest::GetInstance()->test_to_run_count() != 1)
  {
    std::fprintf(stderr, "FAILED: there is no render test '%s'\n", test_name.c_str());
    return 1;
  }
  return result;
}
