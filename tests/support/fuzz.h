#ifndef bindpose_tests_support_fuzz_h
#define bindpose_tests_support_fuzz_h

// Tests that try many random cases. A round's case depends on its seed alone, so that a failure can
// be repeated by itself:
//   BINDPOSE_FUZZ_FACTOR=8   makes 8 times as many rounds (nightly);
//   BINDPOSE_FUZZ_NIGHT=3    takes other seeds, those after three such runs (nightly: by the date);
//   BINDPOSE_FUZZ_SEED=7     runs the round of this seed alone;
//   BINDPOSE_FUZZ_TRACE=1    prints each seed before its round, for a crash takes the trace with
//   it.

#include "base/status.h"
#include "support/meshes.h"
#include "support/sanitized.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>

#include <sys/resource.h>
#include <unistd.h>

namespace bindpose::test
{

/// The whole number from 1 that an environment variable holds, else the fallback.
inline Index whole_number_of(const char* variable, Index fallback)
{
  const char* text = std::getenv(variable);
  const Index value = text ? std::strtoll(text, nullptr, 10) : 0;
  return value >= 1 ? value : fallback;
}

/// base times BINDPOSE_FUZZ_FACTOR.
inline Index fuzz_rounds(Index base)
{
  return base * whole_number_of("BINDPOSE_FUZZ_FACTOR", 1);
}

/// Calls body(random) for as many seeds as asked, until one fails, and prints how many it were.
/// An exception that escapes is a failure; so is a round of a minute, of some more with sanitizers:
/// what hangs is named.
template <typename Body>
void fuzz(const char* what, Index base, const Body& body)
{
  const Index only = whole_number_of("BINDPOSE_FUZZ_SEED", 0);
  const Index rounds = only > 0 ? 1 : fuzz_rounds(base);
  const Index night = whole_number_of("BINDPOSE_FUZZ_NIGHT", 0);
  const Index first = only > 0 ? only : night * rounds + 1;
  const Index last = first + rounds - 1;
  const bool trace = std::getenv("BINDPOSE_FUZZ_TRACE") != nullptr;
  constexpr double longest = sanitized ? 400.0 : 120.0;
  Index seed = first;
  for (; seed <= last && !testing::Test::HasFailure(); ++seed)
  {
    if (trace)
    {
      std::cerr << "seed " << seed << std::endl;
    }
    SCOPED_TRACE("BINDPOSE_FUZZ_SEED=" + std::to_string(seed));
    const auto start = std::chrono::steady_clock::now();
    try
    {
      Random random(static_cast<std::uint64_t>(seed));
      body(random);
    }
    catch (const std::exception& error)
    {
      ADD_FAILURE() << "an exception escaped: " << error.what();
    }
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    EXPECT_LT(taken.count(), longest);
  }
  std::cout << "[ fuzz ] " << seed - first << " " << what << "\n";
}

/// True in `share` of all cases.
inline bool chance(Random& random, double share)
{
  return random.uniform() < share;
}

/// Text that can stand in one line of a log or a window: something, no control characters, UTF-8.
inline void expect_sentence(const std::string& text)
{
  EXPECT_FALSE(text.empty());
  for (std::size_t i = 0; i < text.size();)
  {
    const auto c = static_cast<unsigned char>(text[i]);
    const std::size_t length = c < 0x80 ? 1 : c < 0xc2 ? 0 : c < 0xe0 ? 2 : c < 0xf0 ? 3 : 4;
    bool good = c >= 0x20 && c != 0x7f && c < 0xf5 && length > 0 && i + length <= text.size();
    for (std::size_t k = 1; k < length && good; ++k)
    {
      good = (static_cast<unsigned char>(text[i + k]) & 0xc0) == 0x80;
    }
    if (!good)
    {
      ADD_FAILURE() << "byte " << int(c) << " at " << i << " of: " << text;
      return;
    }
    i += length;
  }
}

/// A failure is one sentence of a documented code; whatever was found, warnings are sentences.
inline void expect_spoken(const Status& status)
{
  if (status.code != StatusCode::ok)
  {
    expect_sentence(status.message);
  }
  for (const std::string& warning : status.warnings)
  {
    expect_sentence(warning);
  }
}

/// While it lives, memory that a small input cannot need is refused: what asks for it throws
/// bad_alloc. Sanitizers reserve terabytes of address space, so there it does nothing.
class MemoryLimit
{
public:
  explicit MemoryLimit(Index mebibytes)
  {
    getrlimit(RLIMIT_AS, &this->before_);
#if !defined(__SANITIZE_ADDRESS__)
    long pages = 0;
    if (std::FILE* file = std::fopen("/proc/self/statm", "r"))
    {
      pages = std::fscanf(file, "%ld", &pages) == 1 ? pages : 0;
      std::fclose(file);
    }
    if (pages > 0)
    {
      rlimit limit = this->before_;
      limit.rlim_cur = static_cast<rlim_t>(pages) * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) +
        (static_cast<rlim_t>(mebibytes) << 20);
      setrlimit(RLIMIT_AS, &limit);
    }
#else
    static_cast<void>(mebibytes);
#endif
  }
  ~MemoryLimit()
  {
    setrlimit(RLIMIT_AS, &this->before_);
  }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

private:
  rlimit before_ = {};
};

} // namespace bindpose::test

#endif
