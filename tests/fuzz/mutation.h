#ifndef bindpose_tests_fuzz_mutation_h
#define bindpose_tests_fuzz_mutation_h

#include "support/meshes.h"

#include <string>

namespace bindpose::test
{

/// Apply one to four random changes to a file. Bits and bytes are changed, lines are moved,
/// numbers in text or binary form are replaced by other, often extreme ones, and ends are cut off.
std::string damaged_file(Random& random, std::string text);

} // namespace bindpose::test

#endif
