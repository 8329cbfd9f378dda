#ifndef bindpose_tests_support_fuzz_h
#define bindpose_tests_support_fuzz_h

// Support for fuzz tests, which try many random cases. The case of a round depends only on its
// seed, so that a failure can be repeated alone. Environment variables control the rounds:
// BINDPOSE_FUZZ_FACTOR=8   runs 8 times as many rounds (nightly)
// BINDPOSE_FUZZ_NIGHT=3    skips the seeds of nights 0 to 2 (nightly.sh passes the day number)
// BINDPOSE_FUZZ_SEED=7     runs only the round with this seed
// BINDPOSE_FUZZ_TRACE=1    prints each seed before its round, because a crash prints no seed

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

/// Return the value of an environment variable if it is a positive integer, otherwise `fallback`.
inline Index read_integer(const char* variable, Index fallback)
{
  const char* text = std::getenv(variable);
  const Index value = text ? std::strtoll(text, nullptr, 10) : 0;
  return value >= 1 ? value : fallback;
}

/// Return the number of rounds: base times BINDPOSE_FUZZ_FACTOR.
inline Index fuzz_rounds(Index base)
{
  return base * read_integer("BINDPOSE_FUZZ_FACTOR", 1);
}

/// Run the requested number of rounds, but end after the first round that fails. Print the number
/// of rounds. Each round calls body(random) with a new seed. A round fails if one of its assertions
/// fails, if an exception escapes, or if it takes more than 120 s (400 s with sanitizers).
template <typename Body>
void fuzz(const char* what, Index base, const Body& body)
{
  const Index single_seed = read_integer("BINDPOSE_FUZZ_SEED", 0);
  const Index rounds = single_seed > 0 ? 1 : fuzz_rounds(base);
  const Index night_number = read_integer("BINDPOSE_FUZZ_NIGHT", 0);
  const Index first = single_seed > 0 ? single_seed : night_number * rounds + 1;
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
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    EXPECT_LT(elapsed.count(), longest);
  }
  std::cout << "[ fuzz ] " << seed - first << " " << what << "\n";
}

/// Return true with probability `probability`.
inline bool chance(Random& random, double probability)
{
  return random.uniform() < probability;
}

/// Expect that a text fits into one line of a log or a window: UTF-8, not empty, and without
/// control characters.
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

/// Expect that the message of a failed status and each warning are one line of text.
inline void expect_valid_messages(const Status& status)
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

/// Limits the additional memory of this process during the lifetime of the object. An allocation
/// above the limit, which no small input needs, throws bad_alloc. The class has no effect with
/// sanitizers, because they reserve terabytes of address space.
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
