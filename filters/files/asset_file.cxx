#include "asset_file.h"

#include "file_kind.h"
#include "gltf/gltf_model.h"
#include "helper/guarded_import.h"
#include "io/obj.h"
#include "io/ply.h"
#include "io/text_scanner.h"
#include "look/look_document.h"
#include "look/mtl_materials.h"
#include "picture_bytes.h"
#include "polygon_triangles.h"

#include <array>
#include <filesystem>
#include <sstream>

namespace bindpose
{

namespace
{
LookTriangles triangulate(const PolygonMesh& mesh)
{
  std::vector<std::array<Index, 3>> triangles, corners;
  std::vector<Vec3> polygon;
  LookTriangles result;
  for (Index face = 0; face < mesh.polygon_count(); ++face)
  {
    const Index begin = mesh.offsets[face];
    polygon.clear();
    for (Index c = begin; c < mesh.offsets[face + 1]; ++c)
    {
      polygon.emplace_back(mesh.points.row(mesh.corners[c]).transpose());
    }
    triangulate_polygon(polygon, corners);
    for (const auto& [a, b, c] : corners)
    {
      triangles.push_back({ begin + a, begin + b, begin + c });
      result.faces.push_back(face);
    }
  }
  result.corners = to_matrix(triangles);
  return result;
}

/// Return the names of the files in a line mtllib. A name may contain blanks, so the whole text is
/// a name if it is a file.
std::vector<std::string> library_files(const std::string& folder, const std::string& text)
{
  if (is_in_folder(folder + "/" + text, folder))
  {
    return { text };
  }
  std::istringstream stream(text);
  std::vector<std::string> names;
  for (std::string name; stream >> name;)
  {
    names.push_back(name);
  }
  return names;
}

/// Append the materials of a look, and return their ids by name.
std::map<std::string, int> append_materials(const std::string& folder, const MeshLook& look,
  GltfDocument& document, std::vector<std::string>& warnings)
{
  std::map<std::string, int> ids;
  if (!look.picture.empty())
  {
    const std::string& name = look.material_names.front();
    ids[name] = append_picture_material(name, look.picture, folder, document, warnings);
  }
  for (const std::string& library : look.libraries)
  {
    for (const std::string& name : library_files(folder, library))
    {
      const std::string path = folder + "/" + name;
      std::error_code error;
      if (std::filesystem::exists(path, error) && !is_in_folder(path, folder))
      {
        throw GltfError(
          "the file of materials '" + sanitize_line(name) + "' is not in the folder of the file");
      }
      std::string text;
      const Status status = read_file(path, text);
      if (!status.ok())
      {
        warnings.push_back(
          "the materials of '" + sanitize_line(name) + "' are left out because " + status.message);
        continue;
      }
      append_mtl_materials(text, std::filesystem::path(path).parent_path().string(),
        look.material_names, document, ids, warnings);
    }
  }
  return ids;
}

/// Convert an OBJ or PLY file.
Status read_polygon_file(ExecutionContext& context, const std::string& path, AssetBytes& asset)
{
  PolygonMesh mesh;
  MeshLook look;
  Status status =
    file_extension(path) == "obj" ? read_obj(path, mesh, look) : read_ply(path, mesh, look);
  std::vector<std::string> warnings = status.warnings;
  if (status.ok())
  {
    status = check_float_range(mesh.points);
  }
  if (!status.ok())
  {
    return status;
  }
  try
  {
    GltfDocument document(png_converter(context));
    const std::string folder = std::filesystem::path(path).parent_path().string();
    const std::map<std::string, int> materials =
      append_materials(folder.empty() ? "." : folder, look, document, warnings);
    asset.points = append_look_scene(mesh, look, triangulate(mesh), materials, document);
    asset.point_count = mesh.points.rows();
    status = document.to_bytes(true, asset.bytes);
  }
  catch (const GltfError& failure)
  {
    status = Status::invalid_input(path + ": " + failure.sentence);
  }
  status.warnings.insert(status.warnings.begin(), warnings.begin(), warnings.end());
  return status;
}
} // namespace

Status read_asset_bytes(ExecutionContext& context, const std::string& path, AssetBytes& asset)
{
  return is_listed(file_extension(path), "obj ply") ? read_polygon_file(context, path, asset)
                                                    : import_guarded(context, path, asset.bytes);
}

Status read_asset_file(ExecutionContext& context, const std::string& path, GltfAsset& asset)
{
  Status status = check_extension(path, asset_extensions());
  if (!status.ok())
  {
    return status;
  }
  if (is_listed(file_extension(path), "glb gltf"))
  {
    return asset.read(context, path, png_converter(context));
  }
  AssetBytes converted;
  const Status conversion = read_asset_bytes(context, path, converted);
  if (!conversion.ok())
  {
    return conversion;
  }
  status = asset.read_bytes(path, std::move(converted.bytes), png_converter(context));
  status.warnings.insert(
    status.warnings.begin(), conversion.warnings.begin(), conversion.warnings.end());
  return status;
}

} // namespace bindpose
