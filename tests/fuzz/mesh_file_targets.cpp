#include "fuzz/mesh_file_targets.h"

#include "io/medit.h"
#include "io/obj.h"
#include "io/off.h"
#include "io/ply.h"
#include "io/stl.h"

#include "fuzz/memory_file.h"
#include "fuzz/status_checks.h"

namespace bindpose::test
{

namespace
{
void expect_consistent(const PolygonMesh& mesh)
{
  EXPECT_TRUE(mesh.points.allFinite());
  ASSERT_FALSE(mesh.offsets.empty());
  EXPECT_EQ(mesh.offsets.front(), 0);
  EXPECT_EQ(mesh.offsets.back(), static_cast<Index>(mesh.corners.size()));
  for (std::size_t f = 1; f < mesh.offsets.size(); ++f)
  {
    ASSERT_GE(mesh.offsets[f], mesh.offsets[f - 1] + 3);
  }
  for (const Index corner : mesh.corners)
  {
    ASSERT_TRUE(corner >= 0 && corner < mesh.points.rows()) << corner;
  }
  EXPECT_TRUE(check_mesh(mesh.points, fan_triangles(mesh)).ok());
}

bool check_polygons(std::string_view input, Status (*read)(const std::string&, PolygonMesh&))
{
  const MemoryFile file(input);
  PolygonMesh mesh;
  const Status status = read(file.path(), mesh);
  if (status.ok())
  {
    expect_consistent(mesh);
    return true;
  }
  expect_refused(status);
  EXPECT_EQ(mesh.points.rows(), 0);
  EXPECT_EQ(mesh.polygon_count(), 0);
  return false;
}
} // namespace

bool check_off(std::string_view input)
{
  return check_polygons(input, read_off);
}

bool check_obj(std::string_view input)
{
  return check_polygons(input, read_obj);
}

bool check_ply(std::string_view input)
{
  return check_polygons(input, read_ply);
}

bool check_stl(std::string_view input)
{
  return check_polygons(input, read_stl);
}

bool check_medit(std::string_view input)
{
  const MemoryFile file(input);
  MeditMesh mesh;
  const Status status = read_medit(file.path(), mesh);
  if (!status.ok())
  {
    expect_refused(status);
    EXPECT_EQ(mesh.points.rows() + mesh.triangles.rows() + mesh.tets.rows(), 0);
    return false;
  }
  EXPECT_TRUE(mesh.points.allFinite());
  EXPECT_TRUE(check_mesh(mesh.points, mesh.triangles).ok());
  EXPECT_TRUE(check_mesh(mesh.points, mesh.tets).ok());
  return true;
}

} // namespace bindpose::test
