#ifndef bindpose_tests_fuzz_shape_target_h
#define bindpose_tests_fuzz_shape_target_h

#include <string_view>

namespace bindpose::test
{

/// Read an OFF file of at most 64 triangles, place three point handles on the surface, compute
/// their weights in the embedding, and pose the surface by skinning. If all stages accept the
/// surface, expect weights from 0 to 1, an exact rest pose and finite posed points.
bool check_shape(std::string_view input);

} // namespace bindpose::test

#endif
