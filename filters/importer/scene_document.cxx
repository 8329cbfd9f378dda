#include "scene_document.h"

#include "base/status.h"
#include "gltf/gltf_images.h"
#include "gltf/gltf_model.h"
#include "gltf_edit/gltf_joints.h"
#include "gltf_edit/gltf_weights.h"
#include "helper/helper_start.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <system_error>
#include <vector>

namespace bindpose
{

namespace
{
using Json = GltfDocument::Json;
using Column = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Eigen::Affine3d to_affine(const aiMatrix4x4& m)
{
  Eigen::Affine3d map;
  map.matrix() << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, 0, 0, 0,
    1;
  return map.matrix().allFinite() ? map : Eigen::Affine3d(Eigen::Affine3d::Identity());
}

std::string to_text(const aiString& text)
{
  return sanitize_line(std::string(text.C_Str(), std::min<std::size_t>(text.length, MAXLEN - 1)));
}

double clamped(double value)
{
  return std::isfinite(value) ? std::clamp(value, 0.0, 1.0) : 0.0;
}

// ---- Materials ---------------------------------------------------------------------------------

class MaterialWriter
{
public:
  MaterialWriter(const aiScene& scene, const std::string& folder, GltfDocument& document)
    : scene_(scene), folder_(folder), document_(document)
  {
  }

  void append(const aiMaterial& from)
  {
    Json material{ { "name", to_text(from.GetName()) } };
    Json surface;
    const Json picture = this->texture(from, { aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE });
    surface["baseColorFactor"] = base_color(from, !picture.is_null());
    set(surface, "baseColorTexture", picture);
    ai_real metallic = 0, roughness = 0, shininess = 0;
    surface["metallicFactor"] =
      from.Get(AI_MATKEY_METALLIC_FACTOR, metallic) == aiReturn_SUCCESS ? clamped(metallic) : 0.0;
    if (from.Get(AI_MATKEY_ROUGHNESS_FACTOR, roughness) == aiReturn_SUCCESS)
    {
      surface["roughnessFactor"] = clamped(roughness);
    }
    else
    {
      // see append_mtl_materials()
      from.Get(AI_MATKEY_SHININESS, shininess);
      const double exponent = std::isfinite(shininess) ? std::max<double>(0.0, shininess) : 0.0;
      surface["roughnessFactor"] = std::pow(2.0 / (exponent + 2.0), 0.25);
    }
    const bool is_transparent = surface["baseColorFactor"][3] < 1.0;
    material["pbrMetallicRoughness"] = std::move(surface);
    set(material, "normalTexture", this->texture(from, { aiTextureType_NORMALS }));
    const Json light =
      this->texture(from, { aiTextureType_EMISSION_COLOR, aiTextureType_EMISSIVE });
    set(material, "emissiveTexture", light);
    aiColor3D emission(0, 0, 0);
    from.Get(AI_MATKEY_COLOR_EMISSIVE, emission);
    if (!emission.IsBlack() || !light.is_null())
    {
      const bool is_dark = emission.IsBlack();
      material["emissiveFactor"] = { is_dark ? 1.0 : clamped(emission.r),
        is_dark ? 1.0 : clamped(emission.g), is_dark ? 1.0 : clamped(emission.b) };
    }
    if (is_transparent || from.GetTextureCount(aiTextureType_OPACITY) > 0)
    {
      material["alphaMode"] = "BLEND";
    }
    // Most of these formats do not distinguish the sides of a face.
    material["doubleSided"] = true;
    this->document_.append("materials", std::move(material));
  }

private:
  static void set(Json& object, const char* property, const Json& value)
  {
    if (!value.is_null())
    {
      object[property] = value;
    }
  }

  static Json base_color(const aiMaterial& from, bool has_picture)
  {
    aiColor4D color(0.8F, 0.8F, 0.8F, 1.0F);
    if (from.Get(AI_MATKEY_BASE_COLOR, color) != aiReturn_SUCCESS)
    {
      from.Get(AI_MATKEY_COLOR_DIFFUSE, color);
    }
    ai_real opacity = 1;
    from.Get(AI_MATKEY_OPACITY, opacity);
    if (has_picture && color.r + color.g + color.b == 0) // a black color would hide the picture
    {
      color.r = color.g = color.b = 1;
    }
    // Exporters that mean "not transparent" by an opacity of 0 are common.
    const double alpha = opacity > 0 ? clamped(opacity) : 1.0;
    return Json::array({ clamped(color.r), clamped(color.g), clamped(color.b), alpha });
  }

  /// Return the texture of the first of the types that the material has, or null.
  Json texture(const aiMaterial& from, std::initializer_list<aiTextureType> types)
  {
    for (const aiTextureType type : types)
    {
      aiString path;
      if (from.GetTextureCount(type) > 0 && from.GetTexture(type, 0, &path) == aiReturn_SUCCESS)
      {
        const int id = this->texture(path);
        if (id >= 0)
        {
          return Json{ { "index", id } };
        }
      }
    }
    return nullptr;
  }

  int texture(const aiString& path)
  {
    const auto [entry, is_new] = this->textures_.insert({ path.C_Str(), -1 });
    if (is_new)
    {
      const aiTexture* embedded = this->scene_.GetEmbeddedTexture(path.C_Str());
      const int image = embedded ? this->append_embedded(*embedded) : this->append_file(path);
      entry->second = image < 0 ? -1 : this->document_.append("textures", { { "source", image } });
    }
    return entry->second;
  }

  /// Append a picture that is in the file.
  int append_embedded(const aiTexture& texture)
  {
    const bool is_file = texture.mHeight == 0; // otherwise raw pixels
    const std::string bytes = is_file
      ? std::string(reinterpret_cast<const char*>(texture.pcData), texture.mWidth)
      : tga_file(texture);
    // TGA files are recognized by the extension of their names.
    const std::string name = base_name(texture) + "." +
      (is_file ? std::string(texture.achFormatHint) : std::string("tga"));
    if (is_convertible(picture_format(bytes, name)))
    {
      // Bindpose converts the picture when it reads the document.
      return this->document_.append("images", { { "name", name }, { "uri", to_data_uri(bytes) } });
    }
    const int image = this->document_.append_image(bytes, name);
    if (image < 0)
    {
      leave_out(name);
    }
    return image;
  }

  /// Return the name of an embedded picture without folder and extension.
  std::string base_name(const aiTexture& texture) const
  {
    const std::string name =
      std::filesystem::path(with_slashes(to_text(texture.mFilename))).stem().string();
    const auto begin = this->scene_.mTextures;
    const auto number = std::find(begin, begin + this->scene_.mNumTextures, &texture) - begin;
    return name.empty() ? "picture " + std::to_string(number) : name;
  }

  static std::string with_slashes(std::string path)
  {
    std::replace(path.begin(), path.end(), '\\', '/');
    return path;
  }

  /// Append a reference to a picture file.
  int append_file(const aiString& path)
  {
    std::string name = with_slashes(path.C_Str());
    if (name.empty())
    {
      return -1;
    }
    std::string format = this->file_format(name);
    if (format.empty())
    {
      // Paths of the computer that wrote the file do not exist here.
      name = std::filesystem::path(name).filename().string();
      format = this->file_format(name);
    }
    if (format != "png" && format != "jpg" && !is_convertible(format))
    {
      leave_out(name);
      return -1;
    }
    return this->document_.append("images", { { "uri", encode_uri(name) } });
  }

  /// Return the format of a picture file; empty if it is not in the folder or has an unknown
  /// format.
  std::string file_format(const std::string& name) const
  {
    const std::string path = this->folder_ + "/" + name;
    std::string beginning;
    if (is_in_folder(path, this->folder_))
    {
      beginning.resize(longest_picture_signature);
      std::ifstream file(path, std::ios::binary);
      file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
      beginning.resize(static_cast<std::size_t>(file.gcount()));
    }
    return picture_format(beginning, name);
  }

  static void leave_out(const std::string& name)
  {
    helper_warn("the picture '" + sanitize_line(name) +
      "' is left out because it is missing, damaged, of an unknown format or outside of the folder "
      "of the file; expected PNG, JPEG, BMP, TIFF or TGA");
  }

  /// Return an uncompressed TGA file with the pixels of a texture.
  static std::string tga_file(const aiTexture& texture)
  {
    constexpr unsigned int largest_side = 65535;
    if (texture.mWidth > largest_side || texture.mHeight > largest_side)
    {
      return "";
    }
    std::string bytes(18, '\0');
    bytes[2] = 2; // colors, not compressed
    bytes[12] = static_cast<char>(texture.mWidth % 256);
    bytes[13] = static_cast<char>(texture.mWidth / 256);
    bytes[14] = static_cast<char>(texture.mHeight % 256);
    bytes[15] = static_cast<char>(texture.mHeight / 256);
    bytes[16] = 32; // bits per pixel: blue, green, red, alpha, like aiTexel
    bytes[17] = 0x28; // 8 bits of alpha; the first line is at the top
    bytes.append(reinterpret_cast<const char*>(texture.pcData),
      std::size_t(texture.mWidth) * texture.mHeight * sizeof(aiTexel));
    return bytes;
  }

  /// Replace the characters that a URI cannot contain by %XX.
  static std::string encode_uri(const std::string& path)
  {
    constexpr char digits[] = "0123456789ABCDEF";
    std::string uri;
    for (const char c : path)
    {
      const auto byte = static_cast<unsigned char>(c);
      if (std::isalnum(byte) != 0 || std::string_view("-_.~/").find(c) != std::string_view::npos)
      {
        uri += c;
      }
      else
      {
        uri += { '%', digits[byte / 16], digits[byte % 16] };
      }
    }
    return uri;
  }

  const aiScene& scene_;
  const std::string& folder_;
  GltfDocument& document_;
  std::map<std::string, int> textures_;
};

// ---- Meshes and nodes --------------------------------------------------------------------------

/// The joints of a node with meshes: bones by name.
struct Skin
{
  std::vector<int> nodes;
  std::vector<Eigen::Affine3d> inverse_binds;
  std::map<std::string, Index> ids;
};

class SceneWriter
{
public:
  SceneWriter(const aiScene& scene, GltfDocument& document) : scene_(scene), document_(document) {}

  void write()
  {
    for (unsigned int a = 0; a < this->scene_.mNumAnimations; ++a)
    {
      const aiAnimation& animation = *this->scene_.mAnimations[a];
      for (unsigned int c = 0; c < animation.mNumChannels; ++c)
      {
        this->animated_.insert(animation.mChannels[c]->mNodeName.C_Str());
      }
    }
    this->roots_ = { this->append_node(*this->scene_.mRootNode) };
    for (const auto& [id, node] : this->nodes_with_meshes_)
    {
      this->append_meshes(id, *node);
    }
    this->document_.json()["scene"] =
      this->document_.append("scenes", { { "nodes", this->roots_ } });
    for (unsigned int a = 0; a < this->scene_.mNumAnimations; ++a)
    {
      this->append_animation(*this->scene_.mAnimations[a]);
    }
  }

private:
  int append_node(const aiNode& node)
  {
    Json json{ { "name", to_text(node.mName) } };
    const Eigen::Affine3d map = to_affine(node.mTransformation);
    const Trs trs = nearest_trs(map);
    const bool has_shear = (trs.affine().matrix() - map.matrix()).cwiseAbs().maxCoeff() >
      1e-6 * std::max(1.0, map.matrix().cwiseAbs().maxCoeff());
    // An animated node cannot have a matrix.
    if (has_shear && this->animated_.count(node.mName.C_Str()) == 0)
    {
      json["matrix"] = std::vector<double>(map.data(), map.data() + 16);
    }
    else
    {
      set_transform(json, trs);
    }
    const int id = this->document_.append("nodes", std::move(json));
    this->node_of_name_.insert({ node.mName.C_Str(), id });
    if (node.mNumMeshes > 0)
    {
      this->nodes_with_meshes_.emplace_back(id, &node);
    }
    Json children = Json::array();
    for (unsigned int k = 0; k < node.mNumChildren; ++k)
    {
      children.push_back(this->append_node(*node.mChildren[k]));
    }
    if (!children.empty())
    {
      this->document_.list("nodes")[id]["children"] = std::move(children);
    }
    return id;
  }

  /// Add the meshes of a node. Meshes with and without bones need separate nodes, because a skin
  /// moves all primitives of its node.
  void append_meshes(int id, const aiNode& node)
  {
    std::vector<const aiMesh*> rigid, skinned;
    for (unsigned int k = 0; k < node.mNumMeshes; ++k)
    {
      const aiMesh* mesh = this->scene_.mMeshes[node.mMeshes[k]];
      const bool is_used = (mesh->mPrimitiveTypes & aiPrimitiveType_TRIANGLE) != 0;
      if (is_used)
      {
        (mesh->HasBones() ? skinned : rigid).push_back(mesh);
      }
    }
    const std::string name = to_text(node.mName);
    if (!rigid.empty())
    {
      const int mesh = this->append_mesh(name, rigid, nullptr);
      this->document_.list("nodes")[id]["mesh"] = mesh;
    }
    if (skinned.empty())
    {
      return;
    }
    Skin skin;
    for (const aiMesh* mesh : skinned)
    {
      this->add_joints(*mesh, skin);
    }
    int skinned_node = id;
    if (!skin.nodes.empty() || !rigid.empty())
    {
      skinned_node = this->document_.append("nodes", { { "name", name + " skinned" } });
    }
    if (!skin.nodes.empty())
    {
      // The transform of a node does not move a skinned mesh.
      this->roots_.push_back(skinned_node);
    }
    else if (!rigid.empty())
    {
      this->document_.list("nodes")[id]["children"].push_back(skinned_node);
    }
    const int mesh = this->append_mesh(name, skinned, skin.nodes.empty() ? nullptr : &skin);
    this->document_.list("nodes")[skinned_node]["mesh"] = mesh;
    if (!skin.nodes.empty())
    {
      const int skin_id = this->append_skin(skin);
      this->document_.list("nodes")[skinned_node]["skin"] = skin_id;
    }
  }

  void add_joints(const aiMesh& mesh, Skin& skin)
  {
    for (unsigned int b = 0; b < mesh.mNumBones; ++b)
    {
      const aiBone& bone = *mesh.mBones[b];
      const auto node = this->node_of_name_.find(bone.mName.C_Str());
      if (node != this->node_of_name_.end() &&
        skin.ids.insert({ bone.mName.C_Str(), static_cast<Index>(skin.nodes.size()) }).second)
      {
        skin.nodes.push_back(node->second);
        skin.inverse_binds.push_back(to_affine(bone.mOffsetMatrix));
      }
    }
  }

  int append_skin(const Skin& skin)
  {
    std::vector<float> matrices;
    for (const Eigen::Affine3d& map : skin.inverse_binds)
    {
      std::transform(map.data(), map.data() + 16, std::back_inserter(matrices),
        [](double x) { return static_cast<float>(x); });
    }
    const int binds = this->document_.append_accessor(matrices, 16, 0);
    return this->document_.append(
      "skins", { { "joints", skin.nodes }, { "inverseBindMatrices", binds } });
  }

  int append_mesh(
    const std::string& name, const std::vector<const aiMesh*>& meshes, const Skin* skin)
  {
    Json primitives = Json::array();
    for (const aiMesh* mesh : meshes)
    {
      primitives.push_back(this->append_primitive(*mesh, skin));
    }
    return this->document_.append(
      "meshes", { { "name", name }, { "primitives", std::move(primitives) } });
  }

  Json append_primitive(const aiMesh& mesh, const Skin* skin)
  {
    const auto count = static_cast<Index>(mesh.mNumVertices);
    Json attributes;
    attributes["POSITION"] = this->append_vectors(mesh.mVertices, count);
    if (mesh.HasNormals())
    {
      Points normals = to_points(mesh.mNormals, count);
      for (Index v = 0; v < count; ++v)
      {
        const Vec3 n = normals.row(v).transpose().stableNormalized();
        normals.row(v) = (n.squaredNorm() > 0.5 ? n : Vec3(Vec3::UnitZ())).transpose();
      }
      attributes["NORMAL"] = this->document_.append_rows(normals);
    }
    for (unsigned int k = 0; k < mesh.GetNumUVChannels(); ++k)
    {
      Column texture = to_points(mesh.mTextureCoords[k], count).leftCols(2);
      texture.col(1) = 1.0 - texture.col(1).array(); // glTF's origin is at the upper left
      attributes["TEXCOORD_" + std::to_string(k)] = this->document_.append_rows(texture);
    }
    if (mesh.GetNumUVChannels() == 0 && this->has_picture(mesh.mMaterialIndex))
    {
      // glTF requires coordinates for a material with a picture.
      attributes["TEXCOORD_0"] = this->document_.append_rows(Column::Zero(count, 2).eval());
    }
    if (mesh.HasVertexColors(0))
    {
      Column colors(count, 4);
      for (Index v = 0; v < count; ++v)
      {
        const aiColor4D& c = mesh.mColors[0][v];
        colors.row(v) << clamped(c.r), clamped(c.g), clamped(c.b), clamped(c.a);
      }
      attributes["COLOR_0"] = this->document_.append_rows(colors);
    }
    if (skin)
    {
      append_weights(this->document_, to_weights(mesh, *skin), 0, count, attributes);
    }
    std::vector<std::uint32_t> corners;
    for (unsigned int f = 0; f < mesh.mNumFaces; ++f)
    {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices == 3)
      {
        corners.insert(corners.end(), face.mIndices, face.mIndices + 3);
      }
    }
    const int indices =
      this->document_.append_accessor(corners, 1, GltfDocument::element_array_buffer);
    return { { "attributes", std::move(attributes) }, { "indices", indices },
      { "material", mesh.mMaterialIndex } };
  }

  bool has_picture(unsigned int material) const
  {
    const Json& json = this->document_.json()["materials"][material];
    return json.contains("normalTexture") || json.contains("emissiveTexture") ||
      json["pbrMetallicRoughness"].contains("baseColorTexture");
  }

  static Points to_points(const aiVector3D* vectors, Index count)
  {
    Points points(count, 3);
    for (Index v = 0; v < count; ++v)
    {
      points.row(v) << vectors[v].x, vectors[v].y, vectors[v].z;
      points.row(v) = points.row(v).allFinite() ? points.row(v) : Eigen::RowVector3d::Zero().eval();
    }
    return points;
  }

  int append_vectors(const aiVector3D* vectors, Index count)
  {
    return this->document_.append_rows(to_points(vectors, count));
  }

  /// Return the weights of a mesh. Rows sum to one; vertices without weights follow the first
  /// joint.
  static GltfWeights to_weights(const aiMesh& mesh, const Skin& skin)
  {
    std::vector<std::vector<GltfInfluence>> rows(mesh.mNumVertices);
    for (unsigned int b = 0; b < mesh.mNumBones; ++b)
    {
      const aiBone& bone = *mesh.mBones[b];
      const auto joint = skin.ids.find(bone.mName.C_Str());
      for (unsigned int w = 0; joint != skin.ids.end() && w < bone.mNumWeights; ++w)
      {
        const aiVertexWeight& weight = bone.mWeights[w];
        if (weight.mVertexId < mesh.mNumVertices && weight.mWeight > 0 &&
          std::isfinite(weight.mWeight))
        {
          rows[weight.mVertexId].push_back({ weight.mWeight, joint->second });
        }
      }
    }
    for (auto& row : rows)
    {
      if (row.empty())
      {
        row.push_back({ 1.0, 0 });
      }
      std::stable_sort(row.begin(), row.end(),
        [](const GltfInfluence& a, const GltfInfluence& b) { return a.weight > b.weight; });
      double sum = 0.0;
      for (const GltfInfluence& influence : row)
      {
        sum += influence.weight;
      }
      for (GltfInfluence& influence : row)
      {
        influence.weight /= sum;
      }
    }
    return pack_influences(rows, static_cast<Index>(skin.nodes.size()));
  }

  // ---- Animations ------------------------------------------------------------------------------

  void append_animation(const aiAnimation& from)
  {
    const double ticks = from.mTicksPerSecond > 0 ? from.mTicksPerSecond : 25.0;
    Json animation{ { "name", to_text(from.mName) }, { "channels", Json::array() },
      { "samplers", Json::array() } };
    for (unsigned int c = 0; c < from.mNumChannels; ++c)
    {
      const aiNodeAnim& channel = *from.mChannels[c];
      const auto node = this->node_of_name_.find(channel.mNodeName.C_Str());
      if (node == this->node_of_name_.end())
      {
        continue;
      }
      this->add_track(animation, node->second, "translation", channel.mPositionKeys,
        channel.mNumPositionKeys, ticks);
      this->add_track(animation, node->second, "rotation", channel.mRotationKeys,
        channel.mNumRotationKeys, ticks);
      this->add_track(
        animation, node->second, "scale", channel.mScalingKeys, channel.mNumScalingKeys, ticks);
    }
    if (!animation["channels"].empty())
    {
      this->document_.append("animations", std::move(animation));
    }
  }

  static Eigen::RowVectorXd row_of(const aiVector3D& value)
  {
    return Eigen::RowVector3d(value.x, value.y, value.z);
  }
  static Eigen::RowVectorXd row_of(const aiQuaternion& value)
  {
    return Eigen::RowVector4d(value.x, value.y, value.z, value.w).stableNormalized();
  }

  /// Add a track of a node. Keys at negative times, at times that do not increase, and with values
  /// that are not finite are left out, because glTF does not allow them.
  template <typename Key>
  void add_track(Json& animation, int node, const char* path, const Key* keys, unsigned int count,
    double ticks_per_second)
  {
    std::vector<float> times;
    std::vector<Eigen::RowVectorXd> rows;
    for (unsigned int k = 0; k < count; ++k)
    {
      const auto time = static_cast<float>(keys[k].mTime / ticks_per_second);
      const Eigen::RowVectorXd row = row_of(keys[k].mValue);
      if (std::isfinite(time) && time >= 0.0F && (times.empty() || time > times.back()) &&
        row.allFinite() && (row.cols() == 3 || row.squaredNorm() > 0.5))
      {
        times.push_back(time);
        rows.push_back(row);
      }
    }
    if (times.empty())
    {
      return;
    }
    Column time_column(static_cast<Index>(times.size()), 1);
    Column values(static_cast<Index>(rows.size()), rows.front().cols());
    for (std::size_t k = 0; k < rows.size(); ++k)
    {
      time_column(static_cast<Index>(k), 0) = times[k];
      values.row(static_cast<Index>(k)) = rows[k];
    }
    const int input = this->document_.append_rows(time_column, 0);
    const int output = this->document_.append_rows(values, 0);
    const std::size_t sampler = animation["samplers"].size();
    animation["samplers"].push_back({ { "input", input }, { "output", output } });
    animation["channels"].push_back(
      { { "sampler", sampler }, { "target", { { "node", node }, { "path", path } } } });
  }

  const aiScene& scene_;
  GltfDocument& document_;
  std::vector<int> roots_; ///< nodes of the scene
  std::map<std::string, int> node_of_name_;
  std::set<std::string> animated_; ///< names of animated nodes
  std::vector<std::pair<int, const aiNode*>> nodes_with_meshes_;
};
} // namespace

GltfDocument to_gltf_document(const aiScene& scene, const std::string& folder)
{
  GltfDocument document;
  MaterialWriter materials(scene, folder, document);
  for (unsigned int k = 0; k < scene.mNumMaterials; ++k)
  {
    materials.append(*scene.mMaterials[k]);
  }
  SceneWriter(scene, document).write();
  return document;
}

} // namespace bindpose
