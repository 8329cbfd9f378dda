#ifndef bindpose_tests_fuzz_fuzz_rounds_h
#define bindpose_tests_fuzz_fuzz_rounds_h

#include "fuzz/fuzz_target.h"
#include "fuzz/mutation.h"
#include "support/fuzz.h"

#include <cstring>
#include <iostream>

namespace bindpose::test
{

/// Run a target on damaged copies of the files of its corpus.
inline void fuzz_target(const FuzzTarget& target)
{
  constexpr Index memory_limit = 256; // in MiB; a file has only a few KiB
  const std::vector<FuzzSeed> corpus = fuzz_corpus(target);
  ASSERT_FALSE(corpus.empty());
  const MemoryLimit limit(memory_limit);
  fuzz(target.name, target.rounds,
    [&](Random& random)
    {
      const auto chosen = static_cast<std::size_t>(random.below(static_cast<Index>(corpus.size())));
      const std::string input = damaged_file(random, corpus[chosen].content);
      target.check(input);
      if (testing::Test::HasFailure())
      {
        std::cout << "The input, from " << corpus[chosen].name << ":\n" << input << "\n";
      }
    });
}

/// Expect that each file of a corpus whose name begins with "valid" is accepted, and that no other
/// file violates an expectation of its target.
inline void replay_corpus(const std::vector<FuzzTarget>& targets)
{
  for (const FuzzTarget& target : targets)
  {
    for (const FuzzSeed& seed : fuzz_corpus(target))
    {
      SCOPED_TRACE(std::string(target.name) + "/" + seed.name);
      const bool is_accepted = target.check(seed.content);
      EXPECT_TRUE(is_accepted || seed.name.rfind("valid", 0) != 0);
    }
  }
}

} // namespace bindpose::test

#endif
