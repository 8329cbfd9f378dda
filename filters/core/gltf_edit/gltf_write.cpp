// Writer of skinned meshes as glTF files (see gltf_skin.h): the mesh, its joints, and the frames as
// an animation.
#include "gltf/gltf_skin.h"

#include "gltf_edit/gltf_animation.h"
#include "gltf_edit/gltf_document.h"
#include "gltf_edit/gltf_joints.h"
#include "gltf_edit/gltf_pose_error.h"
#include "gltf_edit/gltf_weights.h"

#include <algorithm>

namespace bindpose
{

namespace
{
using Json = GltfDocument::Json;

/// The mesh is node 0 and mesh 0.
constexpr int mesh_node = 0;

void add_mesh(GltfDocument& document, const GltfSkin& skin, const GltfWeights& packed)
{
  Json attributes;
  attributes["POSITION"] = document.append_rows(skin.points);
  if (skin.normals.rows() > 0)
  {
    Points normals = skin.normals;
    for (Index v = 0; v < normals.rows(); ++v) // glTF requires unit normals
    {
      const Vec3 n = normals.row(v).transpose().stableNormalized();
      normals.row(v) = (n.squaredNorm() > 0.5 ? n : Vec3(Vec3::UnitZ())).transpose();
    }
    attributes["NORMAL"] = document.append_rows(normals);
  }
  if (skin.texture.rows() > 0)
  {
    auto texture = skin.texture;
    texture.col(1) = 1.0 - texture.col(1).array(); // glTF's origin is at the upper left
    attributes["TEXCOORD_0"] = document.append_rows(texture);
  }
  if (skin.colors.rows() > 0)
  {
    const std::vector<std::uint8_t> bytes(
      skin.colors.data(), skin.colors.data() + skin.colors.size());
    const int colors = document.append_accessor(bytes, 4, GltfDocument::array_buffer);
    document.list("accessors")[colors]["normalized"] = true;
    attributes["COLOR_0"] = colors;
  }
  if (!skin.joints.empty())
  {
    append_weights(document, packed, 0, skin.points.rows(), attributes);
  }
  std::vector<std::uint32_t> corners(static_cast<std::size_t>(skin.triangles.size()));
  std::copy(skin.triangles.data(), skin.triangles.data() + skin.triangles.size(), corners.begin());
  const int indices = document.append_accessor(corners, 1, GltfDocument::element_array_buffer);
  Json primitive{ { "attributes", std::move(attributes) }, { "indices", indices },
    { "mode", TINYGLTF_MODE_TRIANGLES } };
  document.append(
    "meshes", { { "name", skin.name }, { "primitives", Json::array({ std::move(primitive) }) } });
}

/// Add the scene, and the nodes of the mesh and of the joints. @return the nodes of the joints.
GltfJointNodes add_nodes(GltfDocument& document, const GltfSkin& skin,
  const std::vector<Trs>& local_transforms, bool rest_joint)
{
  document.append("nodes", { { "name", skin.name }, { "mesh", 0 } });
  Json roots = Json::array({ mesh_node });
  GltfJointNodes nodes;
  if (!skin.joints.empty())
  {
    nodes = append_joints(document, skin.joints, local_transforms, rest_joint);
    roots.push_back(nodes.root);
    document.list("nodes")[mesh_node]["skin"] =
      append_skin(document, skin.joints, nodes, Eigen::Affine3d::Identity());
  }
  document.json()["scene"] = document.append("scenes", { { "nodes", std::move(roots) } });
  return nodes;
}

Status check(const GltfSkin& skin, const GltfOptions& options)
{
  const Index vertices = skin.points.rows();
  Status status = check_mesh(skin.points, skin.triangles);
  if (!status.ok())
  {
    return status;
  }
  const auto joints = static_cast<Index>(skin.joints.size());
  const auto matches_vertex_count = [vertices](Index rows)
  { return rows == 0 || rows == vertices; };
  if (skin.triangles.rows() == 0 || !matches_vertex_count(skin.normals.rows()) ||
    !matches_vertex_count(skin.texture.rows()) || !matches_vertex_count(skin.colors.rows()) ||
    (joints > 0 && (skin.weights.rows() != vertices || skin.weights.cols() != joints)))
  {
    return Status::invalid_input(skin.triangles.rows() == 0
        ? "the mesh has no triangles"
        : "the number of normals, texture coordinates, colors or weights differs from the number "
          "of vertices or joints");
  }
  status = check_float_range(skin.points);
  if (!status.ok())
  {
    return status;
  }
  if (!fits_in_float(skin.normals) || !fits_in_float(skin.texture) || !fits_in_float(skin.weights))
  {
    return Status::invalid_input("the mesh contains a value that is not a finite float");
  }
  if (vertices > 0xfffffffeLL || options.influences < 0)
  {
    return Status::invalid_input(
      "the mesh has too many vertices, or the number of influences is negative");
  }
  status = check_joints(skin.joints);
  if (!status.ok())
  {
    return status;
  }
  return check_frames(skin, options.animation);
}

} // namespace

Status write_gltf_skin(const std::string& path, const GltfSkin& skin, const GltfOptions& options)
{
  ExecutionContext context;
  return write_gltf_skin(context, path, skin, options);
}

Status write_gltf_skin(ExecutionContext& context, const std::string& path, const GltfSkin& skin,
  const GltfOptions& options)
{
  Status status = check(skin, options);
  if (!status.ok())
  {
    return status;
  }
  const bool skinned = !skin.joints.empty();
  const bool morph = options.animation == GltfAnimation::morph;
  const GltfWeights packed =
    skinned ? to_gltf_weights(skin.weights, options.influences) : GltfWeights();
  std::vector<Eigen::Affine3d> exact_maps, stored_maps;
  for (const GltfJoint& joint : skin.joints)
  {
    exact_maps.push_back(joint.posed);
  }
  const std::vector<Trs> local_transforms = local_maps(skin.joints, exact_maps, stored_maps);
  const double diagonal = std::max(bounding_box(skin.points, skin.triangles).diagonal(), 1e-300);

  const std::size_t frame_bytes = morph ? 24 * static_cast<std::size_t>(skin.points.rows()) : 0;
  if (skin.frames.size() * (frame_bytes + 40 * skin.joints.size()) +
      static_cast<std::size_t>(skin.points.rows()) * (36 + 6 * packed.weights_per_vertex) >
    GltfDocument::largest_file)
  {
    return Status::invalid_input("a .glb file can have at most 4 GB; use fewer frames or joints");
  }
  GltfDocument document;
  add_mesh(document, skin, packed);
  const GltfJointNodes nodes = add_nodes(document, skin, local_transforms, packed.rest_joint);
  const GltfStoredSkin stored{ skin.points, skin.joints, skin.weights, packed };
  double animation_error = 0.0;
  if (!skin.frames.empty() && morph)
  {
    append_shape_animation(document, skin, 0, mesh_node);
  }
  else if (!skin.frames.empty() && skinned)
  {
    status = append_joint_animation(context, document, skin, nodes, stored, animation_error);
    if (!status.ok())
    {
      return status;
    }
  }
  status = context.canceled() ? Status::canceled() : document.write(path, options.binary);
  if (!status.ok())
  {
    return status;
  }
  Report& report = status.report;
  report.set("counts.vertices", skin.points.rows());
  report.set("counts.triangles", skin.triangles.rows());
  if (skinned)
  {
    report.set("counts.joints", skin.joints.size());
    report_weights(packed, status);
    report.set("pose_error", largest_pose_error(stored, exact_maps, stored_maps) / diagonal);
  }
  if (!skin.frames.empty())
  {
    report.set("counts.frames", skin.frames.size());
    report.set("animation", morph ? "morph" : "joints");
  }
  if (!skin.frames.empty() && !morph)
  {
    report.set("animation_error", animation_error / diagonal);
  }
  return status;
}

} // namespace bindpose
