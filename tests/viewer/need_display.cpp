// Test environment for tests that draw. Without a display these tests fail instead of being
// skipped, and VTK must not terminate the process.
#include "pictures/display.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

namespace
{
class DisplayEnvironment : public testing::Environment
{
public:
  void SetUp() override
  {
    if (!bindpose::can_render())
    {
      std::fprintf(stderr, "FAILED: %s\n", bindpose::no_display_message());
      std::exit(1);
    }
  }
};

const testing::Environment* const need_display =
  testing::AddGlobalTestEnvironment(new DisplayEnvironment);
} // namespace
