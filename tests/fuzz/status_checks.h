#ifndef bindpose_tests_fuzz_status_checks_h
#define bindpose_tests_fuzz_status_checks_h

#include "support/fuzz.h"

namespace bindpose::test
{

/// Expect that an input was refused with a message of one line.
inline void expect_refused(const Status& status)
{
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  expect_valid_messages(status);
}

} // namespace bindpose::test

#endif
