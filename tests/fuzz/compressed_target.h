#ifndef bindpose_tests_fuzz_compressed_target_h
#define bindpose_tests_fuzz_compressed_target_h

#include <string_view>

namespace bindpose::test
{

/// Decompress the meshes of a glTF file in this process. If they are decompressed, read the result.
bool check_compressed(std::string_view input);

} // namespace bindpose::test

#endif
