// Writer of skinned meshes as glTF files (see gltf_skin.h): the mesh, its joints, and the frames as
// an animation. The pose in the file has an error. The causes are rounding to floats, dropped
// weights, and nodes that contain only translation, rotation and scale. To measure the error, the
// vertices are moved twice: according to the file, and exactly.
#include "gltf/gltf_skin.h"

#include "gltf/gltf_document.h"
#include "gltf/gltf_joints.h"
#include "gltf/gltf_weights.h"

#include <algorithm>
#include <limits>

namespace bindpose
{

namespace
{
using Transforms = std::vector<Eigen::Affine3d>;

// ---- Positions of vertices ---------------------------------------------------------------------

/// Return the rest-to-pose maps of all joints, followed by the identity for the joint "rest".
Transforms rest_to_pose_maps(const GltfSkin& skin, const Transforms& posed)
{
  Transforms maps;
  for (std::size_t j = 0; j < skin.joints.size(); ++j)
  {
    maps.push_back(posed[j] * skin.joints[j].rest.inverse());
  }
  maps.push_back(Eigen::Affine3d::Identity());
  return maps;
}

Vec3 moved(const Transforms& maps, const Vec3& p, const double* weights, Index joints)
{
  Vec3 result = p;
  for (Index j = 0; j < joints; ++j)
  {
    if (weights[j] != 0.0)
    {
      result += weights[j] * (maps[j] * p - p);
    }
  }
  return result;
}

Vec3 moved(const Transforms& maps, const Vec3& p, const GltfWeights& packed, Index v)
{
  Vec3 result = p;
  for (Index k = v * packed.weights_per_vertex; k < (v + 1) * packed.weights_per_vertex; ++k)
  {
    result += static_cast<double>(packed.weights[k]) * (maps[packed.joints[k]] * p - p);
  }
  return result;
}

/// Return the largest distance between the position of a vertex according to the file and its
/// correct position.
/// @param exact_maps exact joint-to-scene maps.
/// @param stored_maps joint-to-scene maps according to the file.
/// @param points correct positions; if empty, computed from `exact_maps`.
double largest_error(const GltfSkin& skin, const GltfWeights& packed, const Transforms& exact_maps,
  const Transforms& stored_maps, const Points& points)
{
  const Transforms right = rest_to_pose_maps(skin, exact_maps);
  const Transforms in_file = rest_to_pose_maps(skin, stored_maps);
  const auto joints = static_cast<Index>(skin.joints.size());
  double largest = 0.0;
  for (Index v = 0; v < skin.points.rows(); ++v)
  {
    const Vec3 p = skin.points.row(v);
    const Vec3 to = points.rows() > 0 ? Vec3(points.row(v))
                                      : moved(right, p, skin.weights.data() + v * joints, joints);
    largest = std::max(largest, (moved(in_file, p, packed, v) - to).norm());
  }
  return largest;
}

// ---- The document ------------------------------------------------------------------------------

using Column = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
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

int add_times(GltfDocument& document, const GltfSkin& skin)
{
  Column times(static_cast<Index>(skin.frames.size()), 1);
  for (Index k = 0; k < times.rows(); ++k)
  {
    times(k, 0) = static_cast<double>(k) / skin.frames_per_second;
  }
  return document.append_rows(times, 0);
}

void add_channel(Json& animation, int times, int values, int node, const char* path)
{
  const std::size_t sampler = animation["samplers"].size();
  animation["samplers"].push_back(
    { { "input", times }, { "output", values }, { "interpolation", "LINEAR" } });
  animation["channels"].push_back(
    { { "sampler", sampler }, { "target", { { "node", node }, { "path", path } } } });
}

/// Add three animation tracks per joint. The quaternions q and -q represent the same rotation. The
/// one that is nearer to the quaternion of the previous key is stored, because programs interpolate
/// between keys.
void animate_joints(GltfDocument& document, const GltfSkin& skin, const GltfJointNodes& nodes,
  std::vector<std::vector<Trs>>& frames)
{
  const int times = add_times(document, skin);
  Json animation{ { "name", "poses" } };
  for (std::size_t j = 0; j < skin.joints.size(); ++j)
  {
    const auto count = static_cast<Index>(frames.size());
    Column translations(count, 3);
    Column rotations(count, 4);
    Column scales(count, 3);
    for (Index k = 0; k < count; ++k)
    {
      Trs& trs = frames[k][j];
      if (k > 0 && trs.rotation.dot(frames[k - 1][j].rotation) < 0.0)
      {
        trs.rotation.coeffs() *= -1.0;
      }
      translations.row(k) = trs.translation.transpose();
      rotations.row(k) = trs.rotation.coeffs().transpose();
      scales.row(k) = trs.scale.transpose();
    }
    const int node = nodes.joints[j];
    add_channel(animation, times, document.append_rows(translations, 0), node, "translation");
    add_channel(animation, times, document.append_rows(rotations, 0), node, "rotation");
    add_channel(animation, times, document.append_rows(scales, 0), node, "scale");
  }
  document.append("animations", std::move(animation));
}

/// Add one morph target per frame. The weight of a target is one at the time of its frame and zero
/// at the other frames.
void animate_shapes(GltfDocument& document, const GltfSkin& skin)
{
  Json targets = Json::array(), names = Json::array();
  const auto count = static_cast<Index>(skin.frames.size());
  for (Index k = 0; k < count; ++k)
  {
    const GltfFrame& frame = skin.frames[k];
    Json target;
    const Points moved = frame.points - skin.points;
    target["POSITION"] = document.append_rows(moved);
    if (frame.normals.rows() > 0 && skin.normals.rows() > 0)
    {
      const Points normal_offsets = frame.normals - skin.normals;
      target["NORMAL"] = document.append_rows(normal_offsets);
    }
    targets.push_back(std::move(target));
    names.push_back("frame " + std::to_string(k));
  }
  Json& mesh = document.list("meshes")[0];
  mesh["primitives"][0]["targets"] = std::move(targets);
  mesh["weights"] = std::vector<double>(static_cast<std::size_t>(count), 0.0);
  mesh["extras"]["targetNames"] = std::move(names);
  Column target_weights = Column::Identity(count, count);
  const Eigen::Map<Column> in_a_row(target_weights.data(), target_weights.size(), 1);
  Json animation{ { "name", "poses" } };
  add_channel(animation, add_times(document, skin), document.append_rows(Column(in_a_row), 0),
    mesh_node, "weights");
  document.append("animations", std::move(animation));
}

// ---- Checks ------------------------------------------------------------------------------------

Status check_frames(const GltfSkin& skin, const GltfOptions& options)
{
  for (std::size_t i = 0; i < skin.frames.size(); ++i)
  {
    const GltfFrame& frame = skin.frames[i];
    const bool morph = options.animation == GltfAnimation::morph;
    if ((!morph && frame.posed.size() != skin.joints.size()) ||
      (frame.points.rows() != skin.points.rows() && (morph || frame.points.rows() != 0)) ||
      (frame.normals.rows() != skin.points.rows() && frame.normals.rows() != 0))
    {
      return Status::invalid_input("animation frame " + std::to_string(i + 1) + " has " +
        std::to_string(frame.posed.size()) + " joints and " + std::to_string(frame.points.rows()) +
        " points; expected " + std::to_string(skin.joints.size()) + " joints and " +
        std::to_string(skin.points.rows()) + " points");
    }
    bool finite = fits_in_float(frame.points) && fits_in_float(frame.normals);
    for (const Eigen::Affine3d& map : frame.posed)
    {
      finite = finite && fits_in_float(map.matrix());
    }
    if (!finite)
    {
      return Status::invalid_input(
        "an animation frame contains a value that is not a finite float");
    }
  }
  if (!skin.frames.empty() && !(skin.frames_per_second > 0.0 && skin.frames_per_second < 1e6))
  {
    return Status::invalid_input("frames per second must be greater than 0 and less than 1000000");
  }
  return {};
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
  return check_frames(skin, options);
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
  Transforms exact_maps;
  for (const GltfJoint& joint : skin.joints)
  {
    exact_maps.push_back(joint.posed);
  }
  Transforms stored_maps;
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
  double animation_error = 0.0;
  if (!skin.frames.empty() && morph)
  {
    animate_shapes(document, skin);
  }
  else if (!skin.frames.empty() && skinned)
  {
    std::vector<std::vector<Trs>> tracks;
    for (const GltfFrame& frame : skin.frames)
    {
      if (context.canceled())
      {
        return Status::canceled();
      }
      context.progress(
        static_cast<double>(tracks.size()) / static_cast<double>(skin.frames.size()));
      Transforms stands;
      tracks.push_back(local_maps(skin.joints, frame.posed, stands));
      animation_error =
        std::max(animation_error, largest_error(skin, packed, frame.posed, stands, frame.points));
    }
    animate_joints(document, skin, nodes, tracks);
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
    report.set(
      "pose_error", largest_error(skin, packed, exact_maps, stored_maps, Points()) / diagonal);
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
