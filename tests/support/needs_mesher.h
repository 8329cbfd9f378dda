#ifndef bindpose_tests_support_needs_mesher_h
#define bindpose_tests_support_needs_mesher_h

#include "helper/mesher_process.h"

#include <gtest/gtest.h>

namespace bindpose::test
{

/// Fixture of tests that run the helper program bindpose-mesher. If the program was not built, the
/// tests are skipped.
class MesherTest : public testing::Test
{
protected:
  void SetUp() override
  {
    if (find_mesher().empty())
    {
      GTEST_SKIP() << "bindpose-mesher is not built: libcgal-dev, libtet1.5-dev";
    }
  }
};

} // namespace bindpose::test

#endif
