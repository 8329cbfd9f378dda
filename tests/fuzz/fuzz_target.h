#ifndef bindpose_tests_fuzz_fuzz_target_h
#define bindpose_tests_fuzz_fuzz_target_h

// Parsers and chains of stages that must accept any bytes. The tests FuzzCorpus and
// FuzzFilterCorpus run them on the files of the corpus. The tests FuzzReaders and FuzzFilters run
// them on damaged copies of these files. The program bindpose_fuzz runs them with libFuzzer.

#include "geometry/mesh.h"

#include <string>
#include <string_view>
#include <vector>

namespace bindpose::test
{

struct FuzzTarget
{
  const char* name; ///< name of the target, and of its folder in tests/fuzz/corpus
  /// Use the input, and check the result with GoogleTest's expectations. Return false if the input
  /// was refused with an error message.
  bool (*check)(std::string_view input);
  Index rounds; ///< number of damaged inputs in one run of the tests
};

/// Return the targets of the kernels.
const std::vector<FuzzTarget>& kernel_fuzz_targets();

/// A file of the corpus.
struct FuzzSeed
{
  std::string name;
  std::string content;
};

/// Return the files of a target's corpus, sorted by name. Files whose names begin with "valid" must
/// be accepted. The names of the other files say what is wrong with them.
std::vector<FuzzSeed> fuzz_corpus(const FuzzTarget& target);

} // namespace bindpose::test

#endif
