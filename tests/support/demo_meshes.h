#ifndef bindpose_tests_support_demo_meshes_h
#define bindpose_tests_support_demo_meshes_h

#include "base/mesh.h"

#include <string>

namespace bindpose::test
{

/// A real surface of the Debian package libcgal-demo (data of others: installed, never committed),
/// such as "elephant-with-holes.off"; polygons are fanned. Unpacked into the build folder on first
/// use. Without the package the test that asks fails with a message that names it, and the mesh is
/// empty.
TriangleMesh demo_mesh(const std::string& name);

/// Path of the unpacked file, empty when the package is missing.
std::string demo_mesh_path(const std::string& name);

} // namespace bindpose::test

#endif
