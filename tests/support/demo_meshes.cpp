#include "support/demo_meshes.h"

#include "io/off.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include <unistd.h>

namespace bindpose::test
{

namespace
{
constexpr const char* archive = "/usr/share/doc/libcgal-dev/data.tar.gz";

/// Unpack into a folder named after this process, then rename the folder. Tests run in parallel, so
/// another process may unpack at the same time.
bool unpack(const std::filesystem::path& folder)
{
  namespace fs = std::filesystem;
  if (fs::exists(folder))
  {
    return true;
  }
  if (!fs::exists(archive))
  {
    return false;
  }
  const fs::path scratch = folder.string() + "." + std::to_string(::getpid());
  fs::create_directories(scratch);
  const std::string command =
    "tar xzf " + std::string(archive) + " -C '" + scratch.string() + "' data/meshes";
  const bool unpacked = std::system(command.c_str()) == 0;
  std::error_code ignored; // the rename fails if another process has finished first
  if (unpacked)
  {
    fs::rename(scratch, folder, ignored);
  }
  fs::remove_all(scratch, ignored);
  return fs::exists(folder);
}
} // namespace

std::string demo_mesh_path(const std::string& name)
{
  const std::filesystem::path folder = BINDPOSE_DEMO_MESH_FOLDER;
  return unpack(folder) ? (folder / "data/meshes" / name).string() : std::string();
}

TriangleMesh demo_mesh(const std::string& name)
{
  const std::string path = demo_mesh_path(name);
  if (path.empty())
  {
    ADD_FAILURE() << archive << " is missing: install the package libcgal-demo";
    return {};
  }
  PolygonMesh polygons;
  const Status status = read_off(path, polygons);
  EXPECT_TRUE(status.ok()) << status.message;
  return { polygons.points, fan_triangles(polygons) };
}

} // namespace bindpose::test
