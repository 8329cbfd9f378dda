// Writer of skinned meshes as glTF files (see gltf_skin.h). This file fills a tinygltf model:
// weights are packed into sets of four, arrays become accessors of one buffer, joints become nodes,
// and frames become an animation. The pose in the file has an error. The causes are rounding to
// floats, dropped weights, and nodes that contain only translation, rotation and scale. To measure
// the error, the vertices are moved twice: according to the file, and exactly.
#include "gltf/gltf_skin.h"

#include "gltf/gltf_transform.h"
#include "gltf/tiny_gltf.h"
#include "io/text_scanner.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <limits>
#include <sstream>

namespace bindpose
{

namespace
{
// Maximum size of a file in bytes; a .glb file stores its size in 32 bits.
constexpr std::size_t largest_file = 0xf0000000;
// Adding a weight of at most this size to a float of value 1 does not change the float.
constexpr float smallest_weight = 0x1p-24F;
constexpr double row_sum_tolerance = 1e-6; // tolerance of the row sums of weights

using Transforms = std::vector<Eigen::Affine3d>;

// ---- Weights -----------------------------------------------------------------------------------

/// The weights as stored in the file: `weights_per_vertex` weights per vertex, the largest first.
struct PackedWeights
{
  Index weights_per_vertex = 0; // number of stored weights per vertex, a multiple of 4
  std::vector<std::uint16_t> joints;
  std::vector<float> weights;
  bool rest_joint = false; // whether there is an additional joint "rest" after all others
  Index dropped_weights = 0;
  double dropped_weight = 0.0;
  Index negative_rows = 0; // number of rows with a negative weight or a sum above one
};

struct Influence
{
  double weight;
  Index joint;
};

/// Return the influences that the file stores for one vertex. Their weights are at least 0 and sum
/// to one, including the weight of the joint "rest".
std::vector<Influence> influences_of(
  const GltfSkin& skin, Index v, Index maximum_influences, PackedWeights& packed)
{
  const auto joints = static_cast<Index>(skin.joints.size());
  std::vector<Influence> row;
  double missing_weight = 1.0;
  bool changed = false;
  for (Index j = 0; j < joints; ++j)
  {
    const double w = skin.weights(v, j);
    missing_weight -= w;
    changed = changed || w < -row_sum_tolerance;
    if (w > smallest_weight)
    {
      row.push_back({ w, j });
    }
  }
  packed.negative_rows += changed || missing_weight < -row_sum_tolerance;
  // If the weights sum to less than one, the joint "rest" gets the missing weight. Negative weights
  // are included in this sum, but they are not stored.
  if (missing_weight > row_sum_tolerance)
  {
    row.push_back({ missing_weight, joints });
  }
  std::stable_sort(row.begin(), row.end(),
    [](const Influence& a, const Influence& b) { return a.weight > b.weight; });
  if (maximum_influences > 0 && static_cast<Index>(row.size()) > maximum_influences)
  {
    double dropped_sum = 0.0;
    for (std::size_t k = static_cast<std::size_t>(maximum_influences); k < row.size(); ++k)
    {
      dropped_sum += row[k].weight;
    }
    packed.dropped_weights += static_cast<Index>(row.size()) - maximum_influences;
    packed.dropped_weight = std::max(packed.dropped_weight, dropped_sum);
    row.resize(static_cast<std::size_t>(maximum_influences));
  }
  double sum = 0.0;
  for (const Influence& influence : row)
  {
    sum += influence.weight;
  }
  if (row.empty()) // the row sums to one, but no weight exceeds smallest_weight
  {
    return { { 1.0, joints } };
  }
  for (Influence& influence : row)
  {
    influence.weight /= sum;
  }
  return row;
}

PackedWeights pack(const GltfSkin& skin, Index maximum_influences)
{
  PackedWeights packed;
  const Index vertices = skin.points.rows();
  std::vector<std::vector<Influence>> rows(static_cast<std::size_t>(vertices));
  std::size_t maximum_row_size = 1;
  for (Index v = 0; v < vertices; ++v)
  {
    rows[v] = influences_of(skin, v, maximum_influences, packed);
    maximum_row_size = std::max(maximum_row_size, rows[v].size());
  }
  packed.weights_per_vertex = static_cast<Index>((maximum_row_size + 3) / 4 * 4);
  packed.joints.assign(static_cast<std::size_t>(vertices * packed.weights_per_vertex), 0);
  packed.weights.assign(static_cast<std::size_t>(vertices * packed.weights_per_vertex), 0.0F);
  for (Index v = 0; v < vertices; ++v)
  {
    const Index first_weight = v * packed.weights_per_vertex;
    float sum = 0.0F;
    for (std::size_t k = rows[v].size(); k-- > 0;)
    {
      const Influence& influence = rows[v][k];
      packed.joints[first_weight + k] = static_cast<std::uint16_t>(influence.joint);
      // The largest weight is computed from the others, so that the rounded row sums to one.
      packed.weights[first_weight + k] = k == 0 ? 1.0F - sum : static_cast<float>(influence.weight);
      sum += packed.weights[first_weight + k];
      packed.rest_joint =
        packed.rest_joint || influence.joint == static_cast<Index>(skin.joints.size());
    }
  }
  return packed;
}

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

Vec3 moved(const Transforms& maps, const Vec3& p, const PackedWeights& packed, Index v)
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
double largest_error(const GltfSkin& skin, const PackedWeights& packed,
  const Transforms& exact_maps, const Transforms& stored_maps, const Points& points)
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

/// Return the joint ids in an order in which each joint follows its parent. Joints in a cycle are
/// missing.
std::vector<Index> parents_first(const std::vector<GltfJoint>& joints)
{
  // children[j + 1] are the children of joint j; children[0] are the joints without a parent.
  std::vector<std::vector<Index>> children(joints.size() + 1);
  for (std::size_t j = 0; j < joints.size(); ++j)
  {
    children[joints[j].parent + 1].push_back(static_cast<Index>(j));
  }
  std::vector<Index> order = children[0];
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    const std::vector<Index>& child_ids = children[order[k] + 1];
    order.insert(order.end(), child_ids.begin(), child_ids.end());
  }
  return order;
}

/// Compute the local transforms of the joints' glTF nodes for the joint-to-scene maps `exact_maps`.
/// A node stores a translation, a rotation and scales, so it can only approximate a map with shear.
/// Set `stored_maps` to the joint-to-scene maps of the nodes.
/// @return one local transform per joint.
std::vector<Trs> local_maps(
  const GltfSkin& skin, const Transforms& exact_maps, Transforms& stored_maps)
{
  std::vector<Trs> local_transforms(skin.joints.size());
  stored_maps.resize(skin.joints.size());
  for (const Index j : parents_first(skin.joints))
  {
    const Index parent = skin.joints[j].parent;
    const Eigen::Affine3d parent_map =
      parent < 0 ? Eigen::Affine3d::Identity() : stored_maps[parent];
    Eigen::Affine3d local = parent_map.inverse() * exact_maps[j];
    // If the parent's map is singular, no local transform can correct the joint.
    if (!local.matrix().allFinite())
    {
      local = exact_maps[j];
    }
    local_transforms[j] = nearest_trs(local);
    stored_maps[j] = parent_map * local_transforms[j].affine();
  }
  return local_transforms;
}

// ---- The model ---------------------------------------------------------------------------------

class Builder
{
public:
  tinygltf::Model model;

  Builder()
  {
    this->model.buffers.resize(1);
    this->model.asset.version = "2.0";
    this->model.asset.generator = "Bindpose";
  }

  /// Add an accessor with a separate bufferView.
  template <typename Number>
  int add(const std::vector<Number>& values, int components, int type, int target = 0)
  {
    std::vector<unsigned char>& bytes = this->model.buffers[0].data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = bytes.size();
    view.byteLength = values.size() * sizeof(Number);
    view.target = target;
    const auto* raw = reinterpret_cast<const unsigned char*>(values.data());
    bytes.insert(bytes.end(), raw, raw + view.byteLength);
    bytes.resize((bytes.size() + 3) / 4 * 4);
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(this->model.bufferViews.size());
    accessor.componentType = std::is_same_v<Number, float> ? TINYGLTF_COMPONENT_TYPE_FLOAT
      : sizeof(Number) == 1                                ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE
      : sizeof(Number) == 2                                ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT
                                                           : TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    accessor.count = values.size() / static_cast<std::size_t>(components);
    accessor.type = type;
    this->model.bufferViews.push_back(view);
    this->model.accessors.push_back(accessor);
    return static_cast<int>(this->model.accessors.size()) - 1;
  }

  /// Add the rows of a matrix as floats, with the minimum and maximum of each column.
  template <typename Matrix>
  int add_rows(const Matrix& rows, int type, int target = TINYGLTF_TARGET_ARRAY_BUFFER)
  {
    std::vector<float> values(static_cast<std::size_t>(rows.size()));
    for (Index k = 0; k < rows.size(); ++k)
    {
      values[k] = static_cast<float>(rows.data()[k]);
    }
    const auto columns = static_cast<int>(rows.cols());
    const int accessor = this->add(values, columns, type, target);
    for (int c = 0; c < columns; ++c)
    {
      float minimum = std::numeric_limits<float>::max();
      float largest = std::numeric_limits<float>::lowest();
      for (std::size_t k = c; k < values.size(); k += columns)
      {
        minimum = std::min(minimum, values[k]);
        largest = std::max(largest, values[k]);
      }
      this->model.accessors[accessor].minValues.push_back(minimum);
      this->model.accessors[accessor].maxValues.push_back(largest);
    }
    return accessor;
  }

  std::size_t bytes() const { return this->model.buffers[0].data.size(); }
};

using Column = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

std::vector<double> to_vector(const Vec3& v)
{
  return { v[0], v[1], v[2] };
}

/// Return the components in glTF's order: x, y, z, w.
std::vector<double> to_vector(const Eigen::Quaterniond& q)
{
  return { q.x(), q.y(), q.z(), q.w() };
}

tinygltf::Value to_value(const Vec3& v)
{
  return tinygltf::Value({ tinygltf::Value(v[0]), tinygltf::Value(v[1]), tinygltf::Value(v[2]) });
}

tinygltf::Value to_value(const GltfHandleExtras& handle_extras)
{
  tinygltf::Value::Object properties;
  properties["kind"] = tinygltf::Value(handle_extras.kind);
  properties["head"] = to_value(handle_extras.head);
  properties["tail"] = to_value(handle_extras.tail);
  if (handle_extras.region != 0)
  {
    properties["region"] = tinygltf::Value(static_cast<double>(handle_extras.region));
  }
  if (!handle_extras.cage.empty())
  {
    tinygltf::Value::Array elements;
    for (const auto& element : handle_extras.cage)
    {
      tinygltf::Value::Array corners;
      for (const Index corner : element)
      {
        corners.emplace_back(static_cast<int>(corner));
      }
      elements.emplace_back(corners);
    }
    properties["cage"] = tinygltf::Value(elements);
  }
  return tinygltf::Value(tinygltf::Value::Object{ { "bindpose", tinygltf::Value(properties) } });
}

void set_trs(const Trs& trs, tinygltf::Node& node)
{
  node.translation = to_vector(trs.translation);
  node.rotation = to_vector(trs.rotation);
  node.scale = to_vector(trs.scale);
}

void add_mesh(Builder& builder, const GltfSkin& skin, const PackedWeights& packed)
{
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  auto& attributes = primitive.attributes;
  attributes["POSITION"] = builder.add_rows(skin.points, TINYGLTF_TYPE_VEC3);
  if (skin.normals.rows() > 0)
  {
    Points normals = skin.normals;
    for (Index v = 0; v < normals.rows(); ++v) // glTF requires unit normals
    {
      const Vec3 n = normals.row(v).transpose().stableNormalized();
      normals.row(v) = (n.squaredNorm() > 0.5 ? n : Vec3(Vec3::UnitZ())).transpose();
    }
    attributes["NORMAL"] = builder.add_rows(normals, TINYGLTF_TYPE_VEC3);
  }
  if (skin.texture.rows() > 0)
  {
    auto texture = skin.texture;
    texture.col(1) = 1.0 - texture.col(1).array(); // glTF's origin is at the upper left
    attributes["TEXCOORD_0"] = builder.add_rows(texture, TINYGLTF_TYPE_VEC2);
  }
  if (skin.colors.rows() > 0)
  {
    const std::vector<std::uint8_t> bytes(
      skin.colors.data(), skin.colors.data() + skin.colors.size());
    const int colors = builder.add(bytes, 4, TINYGLTF_TYPE_VEC4, TINYGLTF_TARGET_ARRAY_BUFFER);
    builder.model.accessors[colors].normalized = true;
    attributes["COLOR_0"] = colors;
  }
  const std::size_t rows = skin.joints.empty() ? 0 : static_cast<std::size_t>(skin.points.rows());
  const bool bytes = skin.joints.size() + packed.rest_joint <= 256;
  for (Index set = 0; rows > 0 && set < packed.weights_per_vertex / 4; ++set)
  {
    std::vector<std::uint8_t> small;
    std::vector<std::uint16_t> joints;
    std::vector<float> weights;
    for (std::size_t v = 0; v < rows; ++v)
    {
      const std::size_t first_weight = v * packed.weights_per_vertex + 4 * set;
      for (std::size_t k = first_weight; k < first_weight + 4; ++k)
      {
        bytes ? small.push_back(static_cast<std::uint8_t>(packed.joints[k]))
              : joints.push_back(packed.joints[k]);
        weights.push_back(packed.weights[k]);
      }
    }
    const int target = TINYGLTF_TARGET_ARRAY_BUFFER;
    attributes["JOINTS_" + std::to_string(set)] = bytes
      ? builder.add(small, 4, TINYGLTF_TYPE_VEC4, target)
      : builder.add(joints, 4, TINYGLTF_TYPE_VEC4, target);
    attributes["WEIGHTS_" + std::to_string(set)] =
      builder.add(weights, 4, TINYGLTF_TYPE_VEC4, target);
  }
  std::vector<std::uint32_t> corners(static_cast<std::size_t>(skin.triangles.size()));
  std::copy(skin.triangles.data(), skin.triangles.data() + skin.triangles.size(), corners.begin());
  primitive.indices =
    builder.add(corners, 1, TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  tinygltf::Mesh mesh;
  mesh.name = skin.name;
  mesh.primitives.push_back(primitive);
  builder.model.meshes.push_back(mesh);
}

/// Node 0 is the mesh, node 1 is the parent of all joints without a parent, and node 2 + j is joint
/// j.
constexpr int first_joint = 2;

void add_nodes(Builder& builder, const GltfSkin& skin, const std::vector<Trs>& local_transforms,
  bool uses_rest_pose)
{
  tinygltf::Model& model = builder.model;
  model.nodes.resize(1);
  model.nodes[0].name = skin.name;
  model.nodes[0].mesh = 0;
  model.scenes.resize(1);
  model.scenes[0].nodes = { 0 };
  model.defaultScene = 0;
  const std::size_t joints = skin.joints.size();
  if (joints == 0)
  {
    return;
  }
  model.nodes.resize(first_joint + joints + uses_rest_pose);
  model.nodes[0].skin = 0;
  model.nodes[1].name = "handles";
  model.scenes[0].nodes.push_back(1);
  tinygltf::Skin gltf_skin;
  gltf_skin.name = "skin";
  gltf_skin.skeleton = 1;
  std::vector<float> inverse_binds;
  for (std::size_t j = 0; j < joints + uses_rest_pose; ++j)
  {
    const int id = first_joint + static_cast<int>(j);
    tinygltf::Node& node = model.nodes[id];
    Index parent = -1;
    Eigen::Matrix4d inverse = Eigen::Matrix4d::Identity();
    if (j < joints)
    {
      const GltfJoint& joint = skin.joints[j];
      node.name = joint.name;
      parent = joint.parent;
      inverse = joint.rest.inverse().matrix();
      set_trs(local_transforms[j], node);
      if (joint.handle_extras)
      {
        node.extras = to_value(*joint.handle_extras);
      }
    }
    else
    {
      node.name = "rest";
      GltfHandleExtras handle_extras;
      handle_extras.kind = "rest";
      node.extras = to_value(handle_extras);
    }
    model.nodes[parent < 0 ? 1 : first_joint + parent].children.push_back(id);
    gltf_skin.joints.push_back(id);
    // Write the matrix column by column, which is also Eigen's storage order.
    for (int k = 0; k < 16; ++k)
    {
      inverse_binds.push_back(static_cast<float>(inverse.data()[k]));
    }
  }
  gltf_skin.inverseBindMatrices = builder.add(inverse_binds, 16, TINYGLTF_TYPE_MAT4);
  model.skins.push_back(gltf_skin);
}

int add_times(Builder& builder, const GltfSkin& skin)
{
  Column times(static_cast<Index>(skin.frames.size()), 1);
  for (Index k = 0; k < times.rows(); ++k)
  {
    times(k, 0) = static_cast<double>(k) / skin.frames_per_second;
  }
  return builder.add_rows(times, TINYGLTF_TYPE_SCALAR, 0);
}

void add_channel(tinygltf::Animation& animation, int times, int values, int node, const char* path)
{
  tinygltf::AnimationSampler sampler;
  sampler.input = times;
  sampler.output = values;
  sampler.interpolation = "LINEAR";
  tinygltf::AnimationChannel channel;
  channel.sampler = static_cast<int>(animation.samplers.size());
  channel.target_node = node;
  channel.target_path = path;
  animation.samplers.push_back(sampler);
  animation.channels.push_back(channel);
}

/// Add three animation tracks per joint. The quaternions q and -q represent the same rotation. The
/// one that is nearer to the quaternion of the previous key is stored, because programs interpolate
/// between keys.
void animate_joints(Builder& builder, const GltfSkin& skin, std::vector<std::vector<Trs>>& frames)
{
  const int times = add_times(builder, skin);
  tinygltf::Animation animation;
  animation.name = "poses";
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
    const int node = first_joint + static_cast<int>(j);
    add_channel(
      animation, times, builder.add_rows(translations, TINYGLTF_TYPE_VEC3, 0), node, "translation");
    add_channel(
      animation, times, builder.add_rows(rotations, TINYGLTF_TYPE_VEC4, 0), node, "rotation");
    add_channel(animation, times, builder.add_rows(scales, TINYGLTF_TYPE_VEC3, 0), node, "scale");
  }
  builder.model.animations.push_back(animation);
}

/// Add one morph target per frame. The weight of a target is one at the time of its frame and zero
/// at the other frames.
void animate_shapes(Builder& builder, const GltfSkin& skin)
{
  tinygltf::Mesh& mesh = builder.model.meshes[0];
  tinygltf::Value::Array names;
  const auto count = static_cast<Index>(skin.frames.size());
  for (Index k = 0; k < count; ++k)
  {
    const GltfFrame& frame = skin.frames[k];
    std::map<std::string, int> target;
    const Points moved = frame.points - skin.points;
    target["POSITION"] = builder.add_rows(moved, TINYGLTF_TYPE_VEC3);
    if (frame.normals.rows() > 0 && skin.normals.rows() > 0)
    {
      const Points normal_offsets = frame.normals - skin.normals;
      target["NORMAL"] = builder.add_rows(normal_offsets, TINYGLTF_TYPE_VEC3);
    }
    mesh.primitives[0].targets.push_back(target);
    names.emplace_back("frame " + std::to_string(k));
  }
  mesh.weights.assign(static_cast<std::size_t>(count), 0.0);
  mesh.extras =
    tinygltf::Value(tinygltf::Value::Object{ { "targetNames", tinygltf::Value(names) } });
  Column target_weights = Column::Identity(count, count);
  const Eigen::Map<Column> in_a_row(target_weights.data(), target_weights.size(), 1);
  tinygltf::Animation animation;
  animation.name = "poses";
  add_channel(animation, add_times(builder, skin),
    builder.add_rows(Column(in_a_row), TINYGLTF_TYPE_SCALAR, 0), 0, "weights");
  builder.model.animations.push_back(animation);
}

// ---- Checks ------------------------------------------------------------------------------------

template <typename Matrix>
bool fits_in_float(const Matrix& matrix)
{
  return matrix.size() == 0 ||
    (matrix.allFinite() &&
      matrix.cwiseAbs().maxCoeff() <= static_cast<double>(std::numeric_limits<float>::max()));
}

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
  if (joints > 65534 || vertices > 0xfffffffeLL || options.influences < 0)
  {
    return Status::invalid_input(joints > 65534
        ? "a glTF file can have at most 65534 handles, not " + std::to_string(joints)
        : "the mesh has too many vertices, or the number of influences is negative");
  }
  for (const GltfJoint& joint : skin.joints)
  {
    if (joint.parent >= joints || joint.parent < -1)
    {
      return Status::invalid_input("joint '" + joint.name + "' has a parent that does not exist");
    }
    if (!fits_in_float(joint.rest.matrix()) || !fits_in_float(joint.posed.matrix()) ||
      joint.rest.linear().determinant() == 0.0)
    {
      return Status::invalid_input(
        "joint '" + joint.name + "' has a transform that is not finite or not invertible");
    }
  }
  if (parents_first(skin.joints).size() != skin.joints.size())
  {
    return Status::invalid_input("the hierarchy of the joints contains a cycle");
  }
  return check_frames(skin, options);
}

Status write_model(const std::string& path, const tinygltf::Model& model, bool binary)
{
  std::ostringstream text;
  try
  {
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&model, text, false, binary))
    {
      return Status::invalid_input(path + " cannot be written");
    }
  }
  catch (const std::bad_alloc&)
  {
    throw;
  }
  catch (const std::exception&) // thrown by nlohmann-json if a name is not UTF-8
  {
    return Status::invalid_input("a name is not valid UTF-8");
  }
  const std::string content = text.str();
  Status status = write_file(path, content);
  status.report.set("file_bytes", content.size());
  return status;
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
  const PackedWeights packed = skinned ? pack(skin, options.influences) : PackedWeights();
  Transforms exact_maps;
  for (const GltfJoint& joint : skin.joints)
  {
    exact_maps.push_back(joint.posed);
  }
  Transforms stored_maps;
  const std::vector<Trs> local_transforms = local_maps(skin, exact_maps, stored_maps);
  const double diagonal = std::max(bounding_box(skin.points, skin.triangles).diagonal(), 1e-300);

  const std::size_t frame_bytes = morph ? 24 * static_cast<std::size_t>(skin.points.rows()) : 0;
  if (skin.frames.size() * (frame_bytes + 40 * skin.joints.size()) +
      static_cast<std::size_t>(skin.points.rows()) * (36 + 6 * packed.weights_per_vertex) >
    largest_file)
  {
    return Status::invalid_input("a .glb file can have at most 4 GB; use fewer frames or joints");
  }
  Builder builder;
  add_mesh(builder, skin, packed);
  add_nodes(builder, skin, local_transforms, packed.rest_joint);
  double animation_error = 0.0;
  if (!skin.frames.empty() && morph)
  {
    animate_shapes(builder, skin);
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
      tracks.push_back(local_maps(skin, frame.posed, stands));
      animation_error =
        std::max(animation_error, largest_error(skin, packed, frame.posed, stands, frame.points));
    }
    animate_joints(builder, skin, tracks);
  }
  status =
    context.canceled() ? Status::canceled() : write_model(path, builder.model, options.binary);
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
    report.set("sets", packed.weights_per_vertex / 4);
    report.set("counts.dropped_weights", packed.dropped_weights);
    report.set("dropped_share", packed.dropped_weight);
    report.set("rest_joint", packed.rest_joint ? "yes" : "no");
    report.set(
      "pose_error", largest_error(skin, packed, exact_maps, stored_maps, Points()) / diagonal);
  }
  if (packed.negative_rows > 0)
  {
    status.warnings.push_back("the weights of " + std::to_string(packed.negative_rows) +
      " vertices were changed because glTF cannot store negative weights or weights with a sum "
      "above 1");
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
