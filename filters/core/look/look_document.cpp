#include "look/look_document.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace bindpose
{

namespace
{
using Json = GltfDocument::Json;
using Texture = decltype(MeshLook::texture);

/// Convert a value of sRGB to a linear value (IEC 61966-2-1).
double to_linear(double value)
{
  const double x = std::isfinite(value) ? std::clamp(value, 0.0, 1.0) : 0.0;
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

/// Return the common translation of the nodes: zero, or the center of a mesh that is far from the
/// origin.
Vec3 translation_of(const Points& points)
{
  const Box box = bounding_box(points);
  const Vec3 center = 0.5 * (box.lower + box.upper);
  constexpr double far = 10.0; // in diagonals: floats then lose more than three bits
  return center.norm() > far * box.diagonal() ? center : Vec3(Vec3::Zero());
}

/// Append a material without color, for polygons that have none.
int append_default_material(GltfDocument& document)
{
  return document.append("materials",
    { { "name", "default" },
      { "pbrMetallicRoughness", { { "metallicFactor", 0.0 }, { "roughnessFactor", 0.9 } } },
      { "doubleSided", true } });
}

bool has_picture(const Json& material)
{
  return material.contains("normalTexture") || material.contains("emissiveTexture") ||
    material.at("pbrMetallicRoughness").contains("baseColorTexture");
}

/// Collects the vertices and triangles of one part.
class PartWriter
{
public:
  PartWriter(const PolygonMesh& mesh, const MeshLook& look) : mesh_(mesh), look_(look) {}

  void add(const Triangles& corners, Index triangle, Index material)
  {
    std::vector<std::uint32_t>& indices = this->indices_[material];
    for (int k = 0; k < 3; ++k)
    {
      const Index corner = corners(triangle, k);
      const std::array<Index, 3> key{ this->mesh_.corners[corner], this->look_.texture_ids[corner],
        this->look_.normal_ids[corner] };
      const auto [entry, is_new] =
        this->ids_.insert({ key, static_cast<std::uint32_t>(this->vertices_.size()) });
      if (is_new)
      {
        this->vertices_.push_back(key);
      }
      indices.push_back(entry->second);
    }
  }

  /// Append the mesh and return its id.
  /// @param materials ids by material of the look; the last one is that of polygons without
  /// material
  int append(const std::string& name, const Vec3& translation, const std::vector<int>& materials,
    GltfDocument& document) const
  {
    const bool has_pictures = std::any_of(this->indices_.begin(), this->indices_.end(),
      [&](const auto& entry)
      {
        const int id = entry.first < 0 ? materials.back() : materials[entry.first];
        return has_picture(document.list("materials")[id]);
      });
    const Json attributes = this->append_attributes(translation, has_pictures, document);
    Json primitives = Json::array();
    for (const auto& [material, indices] : this->indices_)
    {
      Json primitive{ { "attributes", attributes },
        { "indices", document.append_accessor(indices, 1, GltfDocument::element_array_buffer) } };
      primitive["material"] = material < 0 ? materials.back() : materials[material];
      primitives.push_back(std::move(primitive));
    }
    return document.append("meshes", { { "name", name }, { "primitives", std::move(primitives) } });
  }

  /// Append the point of the mesh for each vertex.
  void list_points(std::vector<Index>& points) const
  {
    for (const auto& vertex : this->vertices_)
    {
      points.push_back(vertex[0]);
    }
  }

private:
  /// @param has_pictures whether a material of the part has a picture, which needs coordinates
  Json append_attributes(const Vec3& translation, bool has_pictures, GltfDocument& document) const
  {
    const auto count = static_cast<Index>(this->vertices_.size());
    const bool has_colors = this->look_.colors.rows() > 0;
    Points points(count, 3), normals(count, 3), colors(has_colors ? count : 0, 3);
    Texture texture(count, 2);
    bool has_normals = true, has_texture = has_pictures;
    for (Index v = 0; v < count; ++v)
    {
      const auto [point, texture_id, normal_id] = this->vertices_[v];
      points.row(v) = this->mesh_.points.row(point) - translation.transpose();
      texture.row(v).setZero();
      if (texture_id >= 0)
      {
        has_texture = true;
        // glTF's origin is at the upper left
        texture.row(v) << this->look_.texture(texture_id, 0),
          1.0 - this->look_.texture(texture_id, 1);
      }
      if (!fits_in_float(texture.row(v)))
      {
        texture.row(v).setZero();
      }
      const Vec3 normal = normal_id < 0
        ? Vec3(Vec3::Zero())
        : Vec3(this->look_.normals.row(normal_id).transpose().stableNormalized());
      has_normals = has_normals && normal.squaredNorm() > 0.5;
      normals.row(v) = normal.transpose();
      if (has_colors)
      {
        colors.row(v) = this->look_.colors.row(point).unaryExpr(&to_linear);
      }
    }
    Json attributes{ { "POSITION", document.append_rows(points) } };
    if (has_normals)
    {
      attributes["NORMAL"] = document.append_rows(normals);
    }
    if (has_texture)
    {
      attributes["TEXCOORD_0"] = document.append_rows(texture);
    }
    if (has_colors)
    {
      attributes["COLOR_0"] = document.append_rows(colors);
    }
    return attributes;
  }

  const PolygonMesh& mesh_;
  const MeshLook& look_;
  /// Vertex, texture coordinates and normal of each vertex.
  std::vector<std::array<Index, 3>> vertices_;
  std::map<std::array<Index, 3>, std::uint32_t> ids_;
  std::map<Index, std::vector<std::uint32_t>> indices_; ///< by material
};
} // namespace

std::vector<Index> append_look_scene(const PolygonMesh& mesh, const MeshLook& look,
  const LookTriangles& triangles, const std::map<std::string, int>& materials,
  GltfDocument& document)
{
  std::vector<int> material_ids; // by material of the look, then that of polygons without one
  for (const std::string& name : look.material_names)
  {
    const auto entry = materials.find(name);
    material_ids.push_back(entry == materials.end() ? -1 : entry->second);
  }
  material_ids.push_back(-1);
  const bool needs_default = std::any_of(triangles.faces.begin(), triangles.faces.end(),
    [&](Index face)
    {
      const Index material = look.materials[face];
      return (material < 0 ? material_ids.back() : material_ids[material]) < 0;
    });
  const int default_material = needs_default ? append_default_material(document) : -1;
  std::replace(material_ids.begin(), material_ids.end(), -1, default_material);
  std::vector<PartWriter> parts(look.part_names.size(), PartWriter(mesh, look));
  for (Index t = 0; t < triangles.corners.rows(); ++t)
  {
    const Index face = triangles.faces[t];
    parts[look.parts[face]].add(triangles.corners, t, look.materials[face]);
  }
  const Vec3 translation = translation_of(mesh.points);
  Json roots = Json::array();
  std::vector<Index> points;
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    parts[k].list_points(points);
    const std::string name = sanitize_line(look.part_names[k]);
    Json node{ { "name", name } };
    node["mesh"] = parts[k].append(name, translation, material_ids, document);
    if (!translation.isZero())
    {
      node["translation"] = to_gltf_json(translation);
    }
    roots.push_back(document.append("nodes", std::move(node)));
  }
  document.json()["scene"] = document.append("scenes", { { "nodes", std::move(roots) } });
  return points;
}

} // namespace bindpose
