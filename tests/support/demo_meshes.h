#ifndef bindpose_tests_support_demo_meshes_h
#define bindpose_tests_support_demo_meshes_h

#include "geometry/mesh.h"

#include <string>

namespace bindpose::test
{

/// Load a surface of the Debian package libcgal-demo, such as "elephant-with-holes.off", and split
/// its polygons into triangle fans. The surfaces belong to other authors, so this repository does
/// not contain them. The first call unpacks them into the build folder. If the package is missing,
/// the test fails with a message that names the package, and the returned mesh is empty.
TriangleMesh demo_mesh(const std::string& name);

/// Return the path of the unpacked file, or an empty string if the package is missing.
std::string demo_mesh_path(const std::string& name);

} // namespace bindpose::test

#endif
