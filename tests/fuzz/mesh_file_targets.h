#ifndef bindpose_tests_fuzz_mesh_file_targets_h
#define bindpose_tests_fuzz_mesh_file_targets_h

#include <string_view>

namespace bindpose::test
{

/// Read a mesh file. If it is accepted, expect that all ids are in range and all coordinates are
/// finite.
bool check_off(std::string_view input);
bool check_obj(std::string_view input);
bool check_ply(std::string_view input);
bool check_stl(std::string_view input);
bool check_medit(std::string_view input);

/// Read materials of an OBJ file, of which "red" and "wood" are used. Expect a document without
/// numbers that are not finite.
bool check_mtl(std::string_view input);

} // namespace bindpose::test

#endif
