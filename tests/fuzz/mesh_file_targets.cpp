#include "fuzz/mesh_file_targets.h"

#include "gltf_edit/gltf_asset.h"
#include "io/medit.h"
#include "io/obj.h"
#include "io/off.h"
#include "io/ply.h"
#include "io/stl.h"
#include "look/look_document.h"
#include "look/mtl_materials.h"

#include "fuzz/memory_file.h"
#include "fuzz/status_checks.h"

#include <algorithm>
#include <array>

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

void expect_look_in_range(const PolygonMesh& mesh, const MeshLook& look)
{
  const auto expect_ids = [](const std::vector<Index>& ids, std::size_t count, Index rows)
  {
    EXPECT_EQ(ids.size(), count);
    EXPECT_TRUE(
      std::all_of(ids.begin(), ids.end(), [rows](Index id) { return id >= -1 && id < rows; }));
  };
  const auto faces = static_cast<std::size_t>(mesh.polygon_count());
  expect_ids(look.texture_ids, mesh.corners.size(), look.texture.rows());
  expect_ids(look.normal_ids, mesh.corners.size(), look.normals.rows());
  expect_ids(look.materials, faces, static_cast<Index>(look.material_names.size()));
  expect_ids(look.parts, faces, static_cast<Index>(look.part_names.size()));
  EXPECT_TRUE(look.colors.rows() == 0 || look.colors.rows() == mesh.points.rows());
  LookTriangles fans;
  std::vector<std::array<Index, 3>> corners;
  for (Index f = 0; f < mesh.polygon_count(); ++f)
  {
    for (Index c = mesh.offsets[f] + 1; c + 1 < mesh.offsets[f + 1]; ++c)
    {
      corners.push_back({ mesh.offsets[f], c, c + 1 });
      fans.faces.push_back(f);
    }
  }
  if (corners.empty() || !check_float_range(mesh.points).ok())
  {
    return;
  }
  fans.corners = to_matrix(corners);
  GltfDocument document;
  append_look_scene(mesh, look, fans, {}, document);
  std::string bytes;
  ASSERT_TRUE(document.to_bytes(true, bytes).ok());
  GltfAsset asset;
  const Status status = asset.read_bytes("m.obj", bytes);
  EXPECT_TRUE(status.ok()) << status.message;
}

void check_look(std::string_view input, Status (*read)(const std::string&, PolygonMesh&, MeshLook&))
{
  const MemoryFile file(input);
  PolygonMesh mesh;
  MeshLook look;
  const Status status = read(file.path(), mesh, look);
  if (!status.ok())
  {
    expect_refused(status);
    return;
  }
  expect_valid_messages(status);
  expect_look_in_range(mesh, look);
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
  const bool accepted = check_polygons(input, read_obj);
  check_look(input, read_obj);
  return accepted;
}

bool check_mtl(std::string_view input)
{
  GltfDocument document;
  std::map<std::string, int> ids;
  std::vector<std::string> warnings;
  try
  {
    append_mtl_materials(
      std::string(input), "/nonexistent", { "red", "wood" }, document, ids, warnings);
  }
  catch (const GltfError&)
  {
    return false;
  }
  for (const std::string& warning : warnings)
  {
    EXPECT_EQ(warning, sanitize_line(warning));
  }
  std::string bytes;
  EXPECT_TRUE(document.to_bytes(false, bytes).ok()); // no number is NaN, all texts are UTF-8
  EXPECT_EQ(bytes.find("null"), std::string::npos);
  return !ids.empty();
}

bool check_ply(std::string_view input)
{
  const bool accepted = check_polygons(input, read_ply);
  check_look(input, read_ply);
  return accepted;
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
