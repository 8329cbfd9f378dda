#include "gltf/gltf_compression.h"

#include "gltf/gltf_chunks.h"
#include "gltf/gltf_images.h"
#include "gltf/gltf_model.h"
#include "io/json_depth.h"

#include <algorithm>

namespace bindpose
{

using Json = nlohmann::ordered_json;

namespace
{
bool is_compression(const Json& name)
{
  return name == draco_extension || name == meshopt_extension;
}

/// Remove an extension from an object, and the list of extensions if it becomes empty.
void remove_extension(Json& object, const char* name)
{
  if (object.is_object() && object.contains("extensions") && object["extensions"].is_object())
  {
    object["extensions"].erase(name);
    if (object["extensions"].empty())
    {
      object.erase("extensions");
    }
  }
}
} // namespace

Json parse_gltf_text(std::string_view text)
{
  const Status depth = check_json_depth(text);
  Json json = depth.ok() ? Json::parse(text, nullptr, false) : Json();
  if (!json.is_object())
  {
    throw GltfError(depth.ok() ? "the JSON text is not valid" : depth.message);
  }
  return json;
}

std::string gltf_buffer_path(const Json& buffer, const std::string& folder)
{
  if (!buffer.is_object() || !buffer.contains("uri") || !buffer["uri"].is_string())
  {
    return "";
  }
  const auto uri = buffer["uri"].get<std::string>();
  return is_data_uri(uri) ? "" : folder + "/" + decode_uri(uri);
}

const Json* gltf_extension(const Json& object, const char* name)
{
  const bool exists = object.is_object() && object.contains("extensions") &&
    object["extensions"].is_object() && object["extensions"].contains(name);
  return exists ? &object["extensions"][name] : nullptr;
}

bool is_fallback_buffer(const Json& buffer)
{
  const Json* extension = gltf_extension(buffer, meshopt_extension);
  return extension && extension->is_object() && extension->value("fallback", Json()) == true;
}

GltfCompression find_compression(std::string_view content, const std::string& folder)
{
  try
  {
    const std::string_view text = split_gltf(content).text;
    // Most files do not contain the names, so they need not be parsed here.
    const auto occurs = [&](const char* name) { return text.find(name) != std::string_view::npos; };
    if (!occurs(draco_extension) && !occurs(meshopt_extension))
    {
      return {};
    }
    const Json json = parse_gltf_text(text);
    const Json required = json.value("extensionsRequired", Json::array());
    if (std::none_of(required.begin(), required.end(), &is_compression))
    {
      return {};
    }
    GltfCompression compression;
    compression.is_required = true;
    for (const Json& buffer : json.value("buffers", Json::array()))
    {
      const std::string path = gltf_buffer_path(buffer, folder);
      if (!path.empty() && !is_fallback_buffer(buffer))
      {
        compression.buffer_files.push_back(path);
      }
    }
    return compression;
  }
  catch (const GltfError&)
  {
    return {}; // parse_gltf() reports the error
  }
}

void remove_compression(Json& document)
{
  for (const char* list : { "extensionsUsed", "extensionsRequired" })
  {
    if (document.contains(list) && document[list].is_array())
    {
      Json& names = document[list];
      names.erase(std::remove_if(names.begin(), names.end(), &is_compression), names.end());
      if (names.empty())
      {
        document.erase(list);
      }
    }
  }
  for (const char* list : { "buffers", "bufferViews" })
  {
    if (document.contains(list))
    {
      for (Json& owner : document[list])
      {
        remove_extension(owner, meshopt_extension);
      }
    }
  }
  if (document.contains("meshes"))
  {
    for (Json& mesh : document["meshes"])
    {
      if (mesh.is_object() && mesh.contains("primitives"))
      {
        for (Json& primitive : mesh["primitives"])
        {
          remove_extension(primitive, draco_extension);
        }
      }
    }
  }
}

} // namespace bindpose
