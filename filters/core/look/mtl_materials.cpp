// tinyobjloader parses MTL files. It is a header-only library; this file compiles its
// implementation.
#include "look/mtl_materials.h"

#include "gltf/gltf_model.h"
#include "gltf/picture_size.h"
#include "io/text_scanner.h"

#define TINYOBJLOADER_IMPLEMENTATION
#define TINYOBJLOADER_USE_DOUBLE
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <system_error>

namespace bindpose
{

namespace
{
using Json = GltfDocument::Json;

double clamped(double value)
{
  return std::isfinite(value) ? std::clamp(value, 0.0, 1.0) : 0.0;
}

class MaterialWriter
{
public:
  MaterialWriter(
    const std::string& folder, GltfDocument& document, std::vector<std::string>& warnings)
    : folder_(folder), document_(document), warnings_(warnings)
  {
  }

  int append(const tinyobj::material_t& from)
  {
    Json material{ { "name", sanitize_line(from.name) } };
    Json surface;
    const int color_picture = this->texture(from.diffuse_texname);
    // A color of zero would make the picture black. Exporters that write it ignore the color.
    const bool is_black = from.diffuse[0] + from.diffuse[1] + from.diffuse[2] == 0.0;
    Json color = Json::array();
    for (const double value : from.diffuse)
    {
      color.push_back(color_picture >= 0 && is_black ? 1.0 : clamped(value));
    }
    const double opacity = clamped(from.dissolve);
    color.push_back(opacity);
    surface["baseColorFactor"] = std::move(color);
    if (color_picture >= 0)
    {
      surface["baseColorTexture"] = { { "index", color_picture } };
    }
    surface["metallicFactor"] = clamped(from.metallic);
    // The width of a Blinn-Phong highlight as a roughness; see Walter et al., "Microfacet Models
    // for Refraction through Rough Surfaces", 2007: exponent = 2 / alpha^2 - 2, alpha =
    // roughness^2.
    const double exponent = std::isfinite(from.shininess) ? std::max(0.0, from.shininess) : 0.0;
    surface["roughnessFactor"] =
      from.roughness > 0.0 ? clamped(from.roughness) : std::pow(2.0 / (exponent + 2.0), 0.25);
    material["pbrMetallicRoughness"] = std::move(surface);
    this->set_texture(material, "normalTexture",
      from.normal_texname.empty() ? from.bump_texname : from.normal_texname);
    const int light = this->texture(from.emissive_texname);
    if (light >= 0)
    {
      material["emissiveTexture"] = { { "index", light } };
    }
    const bool is_dark = from.emission[0] + from.emission[1] + from.emission[2] == 0.0;
    if (light >= 0 || !is_dark)
    {
      Json emission = Json::array();
      for (const double value : from.emission)
      {
        emission.push_back(is_dark ? 1.0 : clamped(value));
      }
      material["emissiveFactor"] = std::move(emission);
    }
    if (opacity < 1.0 || !from.alpha_texname.empty())
    {
      material["alphaMode"] = "BLEND";
    }
    material["doubleSided"] = true;
    return this->document_.append("materials", std::move(material));
  }

private:
  void set_texture(Json& material, const char* property, const std::string& name)
  {
    const int id = this->texture(name);
    if (id >= 0)
    {
      material[property] = { { "index", id } };
    }
  }

  /// Return the texture with a picture, or -1 without a picture.
  int texture(const std::string& name)
  {
    const int image = name.empty() ? -1 : this->image(name);
    if (image < 0)
    {
      return -1;
    }
    const auto [entry, is_new] = this->textures_.insert({ image, -1 });
    if (is_new)
    {
      entry->second = this->document_.append("textures", { { "source", image } });
    }
    return entry->second;
  }

  int image(std::string name)
  {
    std::replace(name.begin(), name.end(), '\\', '/');
    std::string path = this->folder_ + "/" + name;
    std::error_code error;
    if (!std::filesystem::exists(path, error))
    {
      // Paths of the computer that wrote the file do not exist here.
      path = this->folder_ + "/" + std::filesystem::path(name).filename().string();
    }
    const auto [entry, is_new] = this->images_.insert({ path, -1 });
    if (is_new)
    {
      entry->second = this->read_image(name, path);
    }
    return entry->second;
  }

  int read_image(const std::string& name, const std::string& path)
  {
    std::error_code error;
    if (std::filesystem::exists(path, error) && !is_in_folder(path, this->folder_))
    {
      throw GltfError(
        "the picture '" + sanitize_line(name) + "' is not in the folder of the materials");
    }
    std::string bytes;
    const Status status = read_file(path, bytes);
    check_picture_header(bytes, name);
    const int id = status.ok() ? this->document_.append_image(bytes, name) : -1;
    if (id < 0)
    {
      this->warnings_.push_back("the picture '" + sanitize_line(name) + "' is left out because " +
        (status.ok()
            ? "it is damaged or has an unknown format; expected PNG, JPEG, BMP, TIFF or TGA"
            : status.message));
    }
    return id;
  }

  const std::string& folder_;
  GltfDocument& document_;
  std::map<std::string, int> images_; ///< by path
  std::map<int, int> textures_; ///< texture of each image
  std::vector<std::string>& warnings_;
};
} // namespace

void append_mtl_materials(const std::string& text, const std::string& folder,
  const std::vector<std::string>& names, GltfDocument& document, std::map<std::string, int>& ids,
  std::vector<std::string>& warnings)
{
  std::istringstream stream(text);
  std::map<std::string, int> parsed_ids;
  std::vector<tinyobj::material_t> parsed;
  std::string parser_warnings, parser_errors;
  tinyobj::LoadMtl(&parsed_ids, &parsed, &stream, &parser_warnings, &parser_errors);
  MaterialWriter writer(folder, document, warnings);
  for (const std::string& name : names)
  {
    const auto entry = parsed_ids.find(name);
    if (entry != parsed_ids.end() && ids.count(name) == 0)
    {
      ids[name] = writer.append(parsed.at(static_cast<std::size_t>(entry->second)));
    }
  }
}

int append_picture_material(const std::string& name, const std::string& picture,
  const std::string& folder, GltfDocument& document, std::vector<std::string>& warnings)
{
  tinyobj::material_t material{};
  material.name = name;
  std::fill_n(material.diffuse, 3, 1.0);
  material.dissolve = 1.0;
  material.diffuse_texname = picture;
  return MaterialWriter(folder, document, warnings).append(material);
}

} // namespace bindpose
