#ifndef bindpose_tests_support_sanitized_h
#define bindpose_tests_support_sanitized_h

namespace bindpose::test
{

/// True in a build with sanitizers. They make everything several times slower.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

} // namespace bindpose::test

#endif
