#ifndef bindpose_tests_support_sanitized_h
#define bindpose_tests_support_sanitized_h

namespace bindpose::test
{

/// True in a build with sanitizers, which slow everything down several times.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

} // namespace bindpose::test

#endif
