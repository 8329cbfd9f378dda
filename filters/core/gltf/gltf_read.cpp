// Reader of skinned meshes in glTF files (see gltf_skin.h): meshes, joints and weights.
#include "gltf/gltf_skin.h"

#include "base/memory.h"
#include "gltf/gltf_file.h"
#include "gltf/gltf_frames.h"
#include "gltf/gltf_skin_parts.h"
#include "gltf/gltf_skin_reader.h"
#include "io/text_scanner.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace bindpose
{

namespace
{
// ---- Meshes ------------------------------------------------------------------------------------

/// Mesh data collected from all primitives. The first four members contain one matrix for each part
/// that does not share the vertices of an earlier part.
struct Parts
{
  std::vector<GltfNumbers> points;
  std::vector<GltfNumbers> normals;
  std::vector<GltfNumbers> textures;
  std::vector<GltfNumbers> colors;
  std::vector<std::array<Index, 3>> triangles;
  Index vertices = 0;
  Index sets = 0;
  Index morph_targets = 0;
  bool more_attributes = false; ///< whether a primitive has TEXCOORD_1 or COLOR_1 (not read)
  Index unweighted = 0;
  GltfInfluences influences;
};

GltfNumbers read_colors(const tinygltf::Model& model, const GltfAccessors& accessors,
  const tinygltf::Primitive& primitive, Index vertices)
{
  const int type = gltf_color_type(model, primitive);
  GltfNumbers colors = read_gltf_attribute(accessors, primitive, "COLOR_0", type, vertices);
  if (type == TINYGLTF_TYPE_VEC3)
  {
    colors.conservativeResize(Eigen::NoChange, 4);
    colors.col(3).setOnes();
  }
  return colors;
}

/// @param part the primitive; its vertices were read before if they precede parts.vertices
void read_primitive(const tinygltf::Model& model, const GltfAccessors& accessors,
  const GltfPart& part, const Eigen::Affine3d& mesh_to_scene, std::size_t joints, Parts& parts)
{
  const tinygltf::Primitive& primitive =
    model.meshes[model.nodes[part.node].mesh].primitives[part.primitive];
  parts.morph_targets = std::max(parts.morph_targets, static_cast<Index>(primitive.targets.size()));
  parts.more_attributes = parts.more_attributes || primitive.attributes.count("TEXCOORD_1") > 0 ||
    primitive.attributes.count("COLOR_1") > 0;
  const Index vertices = part.count;
  if (part.first == parts.vertices)
  {
    GltfNumbers points =
      read_gltf_attribute(accessors, primitive, "POSITION", TINYGLTF_TYPE_VEC3, vertices);
    for (Index v = 0; v < vertices; ++v)
    {
      points.row(v) = (mesh_to_scene * Vec3(points.row(v).transpose())).transpose();
    }
    GltfNumbers normals =
      read_gltf_attribute(accessors, primitive, "NORMAL", TINYGLTF_TYPE_VEC3, vertices);
    const Eigen::Matrix3d normal_matrix = mesh_to_scene.linear().inverse().transpose();
    for (Index v = 0; v < normals.rows() && normal_matrix.allFinite(); ++v)
    {
      normals.row(v) = (normal_matrix * normals.row(v).transpose()).stableNormalized().transpose();
    }
    parts.points.push_back(points);
    parts.normals.push_back(normals);
    parts.textures.push_back(
      read_gltf_attribute(accessors, primitive, "TEXCOORD_0", TINYGLTF_TYPE_VEC2, vertices));
    parts.colors.push_back(read_colors(model, accessors, primitive, vertices));
    if (joints > 0)
    {
      const Index sets =
        read_gltf_weights(accessors, primitive, vertices, joints, parts.influences);
      parts.sets = std::max(parts.sets, sets);
    }
    parts.vertices += vertices;
  }
  for (const auto& t : read_gltf_triangles(accessors, primitive, vertices))
  {
    parts.triangles.push_back({ part.first + t[0], part.first + t[1], part.first + t[2] });
  }
}

/// Concatenate the matrices of an attribute. Do nothing if some vertices lack the attribute.
template <typename Matrix>
void join(const std::vector<GltfNumbers>& parts, Index rows, double unit, Matrix& all)
{
  Index sum = 0;
  for (const GltfNumbers& part : parts)
  {
    sum += part.rows();
  }
  if (sum != rows)
  {
    return;
  }
  all.resize(rows, all.cols());
  Index next = 0;
  for (const GltfNumbers& part : parts)
  {
    if constexpr (std::is_integral_v<typename Matrix::Scalar>)
    {
      all.middleRows(next, part.rows()) = (part.array().max(0.0).min(1.0) * unit)
                                            .round()
                                            .template cast<typename Matrix::Scalar>()
                                            .matrix();
    }
    else
    {
      all.middleRows(next, part.rows()) = unit * part;
    }
    next += part.rows();
  }
}

/// Set the weights, with rows that sum to one. Then remove the joint "rest", which
/// write_gltf_skin() adds.
void set_weights(Parts& parts, std::vector<int>& joint_nodes, GltfSkin& skin)
{
  const auto joints = static_cast<Index>(skin.joints.size());
  const std::size_t needed =
    static_cast<std::size_t>(parts.vertices) * static_cast<std::size_t>(joints) * sizeof(double);
  if (static_cast<double>(needed) > available_memory())
  {
    throw GltfError("the weights of " + std::to_string(parts.vertices) + " vertices and " +
      std::to_string(joints) + " joints need more memory than is available");
  }
  skin.weights.setZero(parts.vertices, joints);
  for (Index v = 0; v < parts.vertices; ++v)
  {
    double sum = 0.0;
    for (const auto& [joint, weight] : parts.influences[v])
    {
      skin.weights(v, joint) += weight;
      sum += weight;
    }
    parts.unweighted += !(sum > 0.0);
    if (sum > 0.0)
    {
      skin.weights.row(v) /= sum;
    }
  }
  const auto& handle_extras = skin.joints.back().handle_extras;
  if (joints > 1 && handle_extras && handle_extras->kind == "rest")
  {
    skin.joints.pop_back();
    joint_nodes.pop_back();
    skin.weights.conservativeResize(Eigen::NoChange, joints - 1);
    // Another program may have added children to the joint "rest"; they become roots.
    for (GltfJoint& joint : skin.joints)
    {
      joint.parent = joint.parent < joints - 1 ? joint.parent : -1;
    }
  }
}

// ---- Content that is not read ------------------------------------------------------------------

std::string count_phrase(std::size_t count, const char* singular, const char* plural)
{
  return std::to_string(count) + " " + (count == 1 ? singular : plural);
}

/// Return one phrase for each type of content that is in the file but not in `skin`.
std::vector<std::string> find_unsupported(const tinygltf::Model& model, const Parts& parts,
  const GltfSkin& skin, const GltfSkinParts& found, const std::optional<std::string>& animation)
{
  std::vector<std::string> unsupported;
  const auto add = [&unsupported](std::size_t count, const char* singular, const char* plural)
  {
    if (count > 0)
    {
      unsupported.push_back(count_phrase(count, singular, plural));
    }
  };
  const std::size_t animations = model.animations.size();
  if (animation && animations > 1)
  {
    unsupported.push_back(std::to_string(animations - 1) + " of " + std::to_string(animations) +
      " animations (" + (animation->empty() ? "the first" : "'" + *animation + "'") + " is kept)");
  }
  else if (!animation)
  {
    add(animations, "animation", "animations");
  }
  add(model.materials.size(), "material", "materials");
  add(std::max(model.textures.size(), model.images.size()), "texture", "textures");
  add(static_cast<std::size_t>(parts.morph_targets), "morph target", "morph targets");
  add(model.cameras.size(), "camera", "cameras");
  add(model.lights.size(), "light", "lights");
  add(static_cast<std::size_t>(found.omitted_meshes), "mesh that does not use the first skin",
    "meshes that do not use the first skin");
  add(static_cast<std::size_t>(found.skipped), "primitive of points or lines",
    "primitives of points or lines");
  if (found.meshes > 1)
  {
    unsupported.push_back("the division into " + std::to_string(found.meshes) + " meshes");
  }
  const auto add_partial =
    [&unsupported](const std::vector<GltfNumbers>& rows, Index kept, const char* item_name)
  {
    const bool any = std::any_of(
      rows.begin(), rows.end(), [](const GltfNumbers& part) { return part.rows() > 0; });
    if (any && kept == 0)
    {
      unsupported.push_back(std::string(item_name) + ", which only some meshes have");
    }
  };
  add_partial(parts.normals, skin.normals.rows(), "normals");
  add_partial(parts.textures, skin.texture.rows(), "texture coordinates");
  add_partial(parts.colors, skin.colors.rows(), "vertex colors");
  if (parts.more_attributes)
  {
    unsupported.emplace_back("further sets of texture coordinates or vertex colors");
  }
  return unsupported;
}

/// Return "a, b and c".
std::string join_phrases(const std::vector<std::string>& phrases)
{
  std::string text;
  for (std::size_t k = 0; k < phrases.size(); ++k)
  {
    text += (k == 0 ? "" : k + 1 == phrases.size() ? " and " : ", ") + phrases[k];
  }
  return text;
}

// ---- The whole file ----------------------------------------------------------------------------

void read_model(const std::string& path, const tinygltf::Model& model, std::size_t file_size,
  GltfSkin& skin, Status& status)
{
  const GltfAccessors accessors(model, file_size);
  const GltfNodes nodes = read_gltf_nodes(model);
  const GltfSkinParts found = find_skin_parts(model, accessors);
  const int skin_id = found.skin;
  std::vector<int> joint_nodes;
  if (skin_id >= 0)
  {
    const tinygltf::Skin& from = gltf_element(model.skins, skin_id, "skin");
    if (from.joints.empty())
    {
      throw GltfError("the skin has no joints");
    }
    std::vector<Eigen::Affine3d> rests = read_inverse_binds(accessors, from);
    std::transform(rests.begin(), rests.end(), rests.begin(),
      [](const Eigen::Affine3d& inverse_bind) { return inverse_bind.inverse(); });
    GltfSkinJoints joints = read_gltf_joints(model, nodes, from.joints, rests);
    skin.joints = std::move(joints.joints);
    joint_nodes = std::move(joints.nodes);
  }
  const std::vector<Eigen::Affine3d> global = nodes.scene_transforms();
  Parts parts;
  for (const GltfPart& part : found.parts)
  {
    const tinygltf::Node& node = model.nodes[part.node];
    const Eigen::Affine3d& node_to_scene = global[part.node];
    if (!node_to_scene.matrix().allFinite())
    {
      throw GltfError("the transform of a node is not finite");
    }
    read_primitive(model, accessors, part,
      skin_id >= 0 ? Eigen::Affine3d::Identity() : node_to_scene, skin.joints.size(), parts);
    const std::string name = sanitize_line(model.meshes[node.mesh].name);
    skin.name = name.empty() ? skin.name : name;
  }
  if (parts.triangles.empty())
  {
    throw GltfError("the file contains no triangles");
  }
  join(parts.points, parts.vertices, 1.0, skin.points);
  join(parts.normals, parts.vertices, 1.0, skin.normals);
  join(parts.textures, parts.vertices, 1.0, skin.texture);
  join(parts.colors, parts.vertices, 255.0, skin.colors);
  if (!skin.points.allFinite())
  {
    throw GltfError("a vertex has a coordinate that is not finite");
  }
  if (skin.texture.rows() > 0)
  {
    skin.texture.col(1) = 1.0 - skin.texture.col(1).array();
  }
  skin.triangles = to_matrix(parts.triangles);
  std::optional<std::string> animation;
  if (skin_id >= 0)
  {
    set_weights(parts, joint_nodes, skin);
    animation =
      read_gltf_frames(model, accessors, nodes, joint_nodes, skin.frames, skin.frames_per_second);
  }
  const std::vector<std::string> unsupported =
    find_unsupported(model, parts, skin, found, animation);
  if (!unsupported.empty())
  {
    status.warnings.push_back(path + ": " + not_kept_phrase + " " + join_phrases(unsupported));
    status.report.set("not_kept[]", unsupported);
  }
  Report& report = status.report;
  report.set("counts.vertices", skin.points.rows());
  report.set("counts.triangles", skin.triangles.rows());
  report.set("counts.joints", skin.joints.size());
  report.set("counts.skins", model.skins.size());
  report.set("counts.frames", skin.frames.size());
  report.set("counts.animations", model.animations.size());
  report.set("counts.materials", model.materials.size());
  report.set("counts.skipped_primitives", found.skipped);
  report.set("counts.morph_targets", parts.morph_targets);
  if (skin_id >= 0)
  {
    report.set("counts.unweighted_vertices", parts.unweighted);
    report.set("sets", parts.sets);
  }
}
} // namespace

Status read_gltf_skin(ExecutionContext& context, const std::string& path, GltfSkin& skin)
{
  skin = GltfSkin();
  const Status status = read_gltf_file(context, path,
    [&](const GltfContent& content, Status& found)
    {
      read_model(path, content.model, content.bytes.size(), skin, found);
      skin.buffer_files = content.files.paths;
    });
  if (!status.ok())
  {
    skin = GltfSkin();
  }
  return status;
}

} // namespace bindpose
