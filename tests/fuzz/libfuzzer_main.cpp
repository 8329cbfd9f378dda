// bindpose_fuzz: runs libFuzzer on one target.
// usage: BINDPOSE_FUZZ_TARGET=NAME bindpose_fuzz [option of libFuzzer…] [folder of inputs…]
// The name is an environment variable, because libFuzzer starts this program again with its own
// options for some of its modes.
#include "fuzz/filter_targets.h"
#include "fuzz/fuzz_target.h"
#include "fuzz/mutation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iostream>

using namespace bindpose::test;

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t maximum);

namespace
{
const FuzzTarget* chosen_target = nullptr;

std::vector<FuzzTarget> all_targets()
{
  std::vector<FuzzTarget> targets = kernel_fuzz_targets();
  const std::vector<FuzzTarget>& others = filter_fuzz_targets();
  targets.insert(targets.end(), others.begin(), others.end());
  return targets;
}
} // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv)
{
  static const std::vector<FuzzTarget> targets = all_targets();
  const char* chosen = std::getenv("BINDPOSE_FUZZ_TARGET");
  std::string names;
  for (const FuzzTarget& target : targets)
  {
    names += std::string(" ") + target.name;
    if (chosen && std::strcmp(chosen, target.name) == 0)
    {
      chosen_target = &target;
    }
  }
  if (!chosen_target)
  {
    std::cerr << "BINDPOSE_FUZZ_TARGET must be one of:" << names << "\n";
    std::exit(2);
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  chosen_target->check({ reinterpret_cast<const char*>(data), size });
  // If an expectation has failed, end the process, so that libFuzzer writes the input to a file.
  // GoogleTest's flag break_on_failure cannot be used instead, because libFuzzer does not handle
  // the signal of this flag.
  if (testing::UnitTest::GetInstance()->ad_hoc_test_result().Failed())
  {
    std::abort();
  }
  return 0;
}

/// Half of the mutations are those of damaged_file(), which also changes whole lines and numbers.
/// The other half are libFuzzer's own mutations.
extern "C" std::size_t LLVMFuzzerCustomMutator(
  std::uint8_t* data, std::size_t size, std::size_t maximum, unsigned int seed)
{
  if (seed % 2 == 0)
  {
    return LLVMFuzzerMutate(data, size, maximum);
  }
  Random random(seed);
  std::string text = damaged_file(random, { reinterpret_cast<const char*>(data), size });
  text.resize(std::min(text.size(), maximum));
  std::memcpy(data, text.data(), text.size());
  return text.size();
}
