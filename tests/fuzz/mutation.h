#ifndef bindpose_tests_fuzz_mutation_h
#define bindpose_tests_fuzz_mutation_h

#include "support/meshes.h"

#include <string>

namespace bindpose::test
{

/// Apply one to four random changes to a file. Possible changes: bits and bytes are changed,
/// inserted or erased; lines are erased, copied or swapped; numbers in text or binary form are
/// replaced by other numbers, which are often extreme; the end of the file is cut off.
std::string damaged_file(Random& random, std::string text);

} // namespace bindpose::test

#endif
