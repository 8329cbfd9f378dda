#ifndef bindpose_tests_fuzz_rig_file_targets_h
#define bindpose_tests_fuzz_rig_file_targets_h

#include <string_view>

namespace bindpose::test
{

/// Read a skeleton (.tgf), a matrix (.dmat), a rig (.gltf or .glb) or a pose file. If it is
/// accepted, expect that all values are finite and in range. Skeletons and poses must also be the
/// same after they are written and read again, and the meshes of a rig can get a new skin.
bool check_tgf(std::string_view input);
bool check_dmat(std::string_view input);
bool check_gltf(std::string_view input);
bool check_pose_file(std::string_view input);

/// Evaluate an expression of a pose file.
bool check_expression(std::string_view input);

/// Use the lines of the input as the names of three handles. If the names are accepted, expect that
/// a pose file with them can be parsed and that a skeleton has the same names.
bool check_names(std::string_view input);

} // namespace bindpose::test

#endif
