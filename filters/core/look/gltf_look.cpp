#include "look/gltf_look.h"

#include "gltf/gltf_images.h"
#include "gltf/picture_size.h"
#include "io/text_scanner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>

namespace bindpose
{

namespace
{
using Coordinates = decltype(SurfaceLook::coordinates);
using Colors = decltype(SurfaceLook::colors);

/// Read a member of an extension. Do nothing if it is not an array of two numbers.
void read_pair(const tinygltf::Value& object, const char* name, Eigen::Vector2d& to)
{
  if (!object.IsObject() || !object.Has(name))
  {
    return;
  }
  const tinygltf::Value& array = object.Get(name);
  if (!array.IsArray() || array.ArrayLen() != 2)
  {
    return;
  }
  Eigen::Vector2d values;
  for (int k = 0; k < 2; ++k)
  {
    const tinygltf::Value& number = array.Get(k);
    values[k] =
      number.IsNumber() ? number.GetNumberAsDouble() : std::numeric_limits<double>::quiet_NaN();
  }
  to = values.allFinite() ? values : to;
}

/// The choice and the transform of texture coordinates.
struct CoordinateSource
{
  int set = 0; ///< n of the attribute TEXCOORD_n
  Eigen::Affine2d transform = Eigen::Affine2d::Identity();
};

/// Read the texture coordinates that a texture uses; see KHR_texture_transform.
CoordinateSource coordinate_source(int set, const tinygltf::ExtensionMap& extensions)
{
  CoordinateSource source{ set, Eigen::Affine2d::Identity() };
  const auto found = extensions.find("KHR_texture_transform");
  if (found == extensions.end() || !found->second.IsObject())
  {
    return source;
  }
  const tinygltf::Value& values = found->second;
  Eigen::Vector2d offset = Eigen::Vector2d::Zero(), scale = Eigen::Vector2d::Ones();
  read_pair(values, "offset", offset);
  read_pair(values, "scale", scale);
  const bool is_rotated = values.Has("rotation") && values.Get("rotation").IsNumber() &&
    std::isfinite(values.Get("rotation").GetNumberAsDouble());
  // Positive angles are counterclockwise in the picture. The y axis of the coordinates points down,
  // so the angle changes its sign.
  const double angle = is_rotated ? -values.Get("rotation").GetNumberAsDouble() : 0.0;
  source.transform = Eigen::Translation2d(offset) * Eigen::Rotation2Dd(angle) *
    Eigen::Affine2d(Eigen::Scaling(scale));
  if (values.Has("texCoord") && values.Get("texCoord").IsInt())
  {
    source.set = values.Get("texCoord").GetNumberAsInt();
  }
  return source;
}

double within(double value, double lower, double upper, double fallback)
{
  return std::isfinite(value) ? std::clamp(value, lower, upper) : fallback;
}

class LookReader
{
public:
  LookReader(const GltfContent& content, std::vector<std::string>& warnings)
    : content_(content), model_(content.model), accessors_(content.model, content.bytes.size()),
      node_to_scene_(read_gltf_nodes(content.model).scene_transforms()), warnings_(warnings)
  {
    for (const tinygltf::Material& material : this->model_.materials)
    {
      this->add_material(material);
    }
    this->look_.images.resize(this->model_.images.size());
  }

  SurfaceLook read(const std::vector<GltfPart>& parts, Index point_count)
  {
    this->look_.point_count = point_count;
    for (const GltfPart& part : parts)
    {
      if (part.count > point_count - part.first)
      {
        throw GltfError("the meshes have more vertices than the surface has points");
      }
      this->add_part(part);
    }
    const auto count = static_cast<Index>(this->look_.points.size());
    this->look_.triangles = to_matrix(this->triangles_);
    this->look_.coordinates = Eigen::Map<const Coordinates>(this->coordinates_.data(), count, 2);
    if (this->has_colors_)
    {
      this->look_.colors = Eigen::Map<const Colors>(this->colors_.data(), count, 4);
    }
    this->read_images();
    return std::move(this->look_);
  }

private:
  void add_material(const tinygltf::Material& from)
  {
    LookMaterial material;
    const tinygltf::PbrMetallicRoughness& surface = from.pbrMetallicRoughness;
    std::vector<CoordinateSource> sources;
    const auto texture = [&](const auto& info)
    {
      const LookTexture result = this->texture(info.index);
      if (result.image >= 0)
      {
        sources.push_back(coordinate_source(info.texCoord, info.extensions));
      }
      return result;
    };
    material.name = sanitize_line(from.name);
    for (std::size_t k = 0; k < 4 && surface.baseColorFactor.size() == 4; ++k)
    {
      material.base_color[static_cast<Index>(k)] =
        within(surface.baseColorFactor[k], 0.0, 1.0, 1.0);
    }
    material.base_color_texture = texture(surface.baseColorTexture);
    material.normal_texture = texture(from.normalTexture);
    material.normal_scale = within(from.normalTexture.scale, -10.0, 10.0, 1.0);
    material.metallic = within(surface.metallicFactor, 0.0, 1.0, 1.0);
    material.roughness = within(surface.roughnessFactor, 0.0, 1.0, 1.0);
    material.metallic_roughness_texture = texture(surface.metallicRoughnessTexture);
    for (std::size_t k = 0; k < 3 && from.emissiveFactor.size() == 3; ++k)
    {
      material.emission[static_cast<Index>(k)] = within(from.emissiveFactor[k], 0.0, 1.0, 0.0);
    }
    material.emission_texture = texture(from.emissiveTexture);
    material.occlusion_texture = texture(from.occlusionTexture);
    material.occlusion_strength = within(from.occlusionTexture.strength, 0.0, 1.0, 1.0);
    material.alpha = from.alphaMode == "MASK" ? LookMaterial::Alpha::mask
      : from.alphaMode == "BLEND"             ? LookMaterial::Alpha::blend
                                              : LookMaterial::Alpha::opaque;
    material.alpha_cutoff = within(from.alphaCutoff, 0.0, 1.0, 0.5);
    material.is_double_sided = from.doubleSided;
    material.is_unlit = from.extensions.count("KHR_materials_unlit") > 0;
    this->look_.materials.push_back(material);
    this->sources_.push_back(sources.empty() ? CoordinateSource() : sources.front());
  }

  LookTexture texture(int id)
  {
    LookTexture result;
    if (id < 0)
    {
      return result;
    }
    const tinygltf::Texture& from = gltf_element(this->model_.textures, id, "texture");
    if (from.source < 0)
    {
      this->warnings_.push_back("texture " + std::to_string(id) +
        " is not drawn because its picture has a format that only an extension allows");
      return result;
    }
    gltf_element(this->model_.images, from.source, "image");
    result.image = from.source;
    if (from.sampler >= 0)
    {
      const tinygltf::Sampler& sampler =
        gltf_element(this->model_.samplers, from.sampler, "sampler");
      result.wrap = sampler.wrapS == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE ? LookTexture::Wrap::clamp
        : sampler.wrapS == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT         ? LookTexture::Wrap::mirror
                                                                 : LookTexture::Wrap::repeat;
      result.interpolates = sampler.magFilter != TINYGLTF_TEXTURE_FILTER_NEAREST;
    }
    return result;
  }

  /// Return an attribute of a primitive. Primitives with different materials often share accessors,
  /// so each accessor is read once.
  const GltfNumbers& attribute(
    const tinygltf::Primitive& primitive, const std::string& name, int type, Index vertices)
  {
    const auto found = primitive.attributes.find(name);
    const int accessor = found == primitive.attributes.end() ? -1 : found->second;
    const auto [entry, is_new] = this->attributes_.insert({ { accessor, type }, GltfNumbers() });
    if (is_new)
    {
      entry->second =
        read_gltf_attribute(this->accessors_, primitive, name.c_str(), type, vertices);
    }
    if (entry->second.rows() > 0 && entry->second.rows() != vertices)
    {
      throw GltfError("the attribute " + name + " has " + std::to_string(entry->second.rows()) +
        " values for " + std::to_string(vertices) + " vertices");
    }
    return entry->second;
  }

  void add_part(const GltfPart& part)
  {
    const tinygltf::Node& node = gltf_element(this->model_.nodes, part.node, "node");
    const tinygltf::Mesh& mesh = gltf_element(this->model_.meshes, node.mesh, "mesh");
    const tinygltf::Primitive& primitive =
      gltf_element(mesh.primitives, part.primitive, "primitive");
    if (!has_triangles(primitive))
    {
      return;
    }
    const int material = primitive.material;
    if (material >= 0)
    {
      gltf_element(this->model_.materials, material, "material");
    }
    const CoordinateSource source = material >= 0 ? this->sources_[material] : CoordinateSource();
    const GltfNumbers& coordinates = this->attribute(
      primitive, "TEXCOORD_" + std::to_string(source.set), TINYGLTF_TYPE_VEC2, part.count);
    const GltfNumbers& colors =
      this->attribute(primitive, "COLOR_0", gltf_color_type(this->model_, primitive), part.count);
    this->has_colors_ = this->has_colors_ || colors.rows() > 0;
    // A node that mirrors its mesh turns the triangles inside out; glTF draws their other side.
    const bool is_mirrored =
      node.skin < 0 && this->node_to_scene_[part.node].linear().determinant() < 0.0;
    std::unordered_map<Index, Index> ids; // vertex of the look by vertex of the primitive
    for (const auto& triangle : read_gltf_triangles(this->accessors_, primitive, part.count))
    {
      std::array<Index, 3> corners;
      for (std::size_t k = 0; k < 3; ++k)
      {
        const Index v = triangle[k];
        const auto [entry, is_new] =
          ids.insert({ v, static_cast<Index>(this->look_.points.size()) });
        corners[k] = entry->second;
        if (is_new)
        {
          this->look_.points.push_back(part.first + v);
          this->add_vertex(coordinates, colors, v, source.transform);
        }
      }
      if (is_mirrored)
      {
        std::swap(corners[1], corners[2]);
      }
      this->triangles_.push_back(corners);
      this->look_.triangle_materials.push_back(material);
    }
  }

  void add_vertex(const GltfNumbers& coordinates, const GltfNumbers& colors, Index v,
    const Eigen::Affine2d& transform)
  {
    Eigen::Vector2d uv = Eigen::Vector2d::Zero();
    if (coordinates.rows() > 0)
    {
      uv = transform * Eigen::Vector2d(coordinates.row(v).transpose());
      uv[1] = 1.0 - uv[1]; // glTF's origin is at the upper left
    }
    for (Index k = 0; k < 2; ++k)
    {
      this->coordinates_.push_back(std::isfinite(uv[k]) ? uv[k] : 0.0);
    }
    for (Index k = 0; k < 4; ++k)
    {
      this->colors_.push_back(
        colors.rows() > 0 && k < colors.cols() ? within(colors(v, k), 0.0, 1.0, 1.0) : 1.0);
    }
  }

  /// Read the images that materials of the triangles use.
  void read_images()
  {
    std::vector<char> used(this->look_.images.size(), 0);
    for (const Index material : this->look_.triangle_materials)
    {
      if (material < 0)
      {
        continue;
      }
      const LookMaterial& each = this->look_.materials[material];
      for (const LookTexture* texture : { &each.base_color_texture, &each.normal_texture,
             &each.metallic_roughness_texture, &each.emission_texture, &each.occlusion_texture })
      {
        if (texture->image >= 0)
        {
          used[texture->image] = 1;
        }
      }
    }
    for (std::size_t k = 0; k < used.size(); ++k)
    {
      if (!used[k])
      {
        continue;
      }
      const tinygltf::Image& image = this->model_.images[k];
      const std::string& name = image.uri.empty() ? image.name : image.uri;
      auto& [bytes, format] = this->look_.images[k];
      const Status status =
        read_gltf_image(this->model_, static_cast<int>(k), this->content_.files.folder, bytes);
      check_picture_header(bytes, name);
      format = picture_format(bytes, name);
      if (!status.ok() || (format != "png" && format != "jpg" && !is_convertible(format)))
      {
        this->warnings_.push_back("the picture " +
          (name.empty() || is_data_uri(name) ? std::to_string(k)
                                             : "'" + sanitize_line(name) + "'") +
          " is not drawn because " +
          (status.ok() ? "it is not PNG, JPEG, BMP, TIFF or TGA" : status.message));
        bytes.clear();
      }
    }
  }

  const GltfContent& content_;
  const tinygltf::Model& model_;
  const GltfAccessors accessors_;
  const std::vector<Eigen::Affine3d> node_to_scene_; ///< per node
  std::vector<std::string>& warnings_;
  SurfaceLook look_;
  std::vector<CoordinateSource> sources_; ///< per material
  std::map<std::pair<int, int>, GltfNumbers> attributes_; ///< by accessor and type
  std::vector<std::array<Index, 3>> triangles_;
  std::vector<double> coordinates_; ///< two per vertex
  std::vector<double> colors_; ///< four per vertex
  bool has_colors_ = false;
};
} // namespace

SurfaceLook read_gltf_look(const GltfContent& content, const std::vector<GltfPart>& parts,
  Index point_count, std::vector<std::string>& warnings)
{
  return LookReader(content, warnings).read(parts, point_count);
}

} // namespace bindpose
