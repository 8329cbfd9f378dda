#include "gltf/gltf_scene_meshes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <string>

namespace bindpose
{

namespace
{
/// Return the nodes of the default scene, parents first. A file without scenes has all its nodes in
/// one scene.
std::vector<int> scene_nodes(const tinygltf::Model& model)
{
  std::vector<int> ids;
  if (model.scenes.empty())
  {
    ids.resize(model.nodes.size());
    std::iota(ids.begin(), ids.end(), 0);
    return ids;
  }
  std::vector<char> found(model.nodes.size(), 0);
  const auto add = [&](int id)
  {
    gltf_element(model.nodes, id, "node");
    if (!found[id])
    {
      found[id] = 1;
      ids.push_back(id);
    }
  };
  const tinygltf::Scene& scene =
    gltf_element(model.scenes, std::max(0, model.defaultScene), "scene");
  std::for_each(scene.nodes.begin(), scene.nodes.end(), add);
  for (std::size_t k = 0; k < ids.size(); ++k)
  {
    const std::vector<int>& children = model.nodes[ids[k]].children;
    std::for_each(children.begin(), children.end(), add);
  }
  return ids;
}

/// A skin of the file.
struct OldSkin
{
  std::vector<Index> joints; ///< per joint of the skin: index into the joints of all skins
  Eigen::Affine3d mesh_to_scene = Eigen::Affine3d::Identity(); ///< in the bind pose
  bool is_posed = false; ///< whether the joints are not in the bind pose
  std::vector<int> movers; ///< common ancestors of the joints, the nearest first
};

class SceneReader
{
public:
  SceneReader(const tinygltf::Model& model, std::size_t file_size)
    : model_(model), accessors_(model, file_size), nodes_(read_gltf_nodes(model))
  {
    this->meshes_.scene = std::max(0, model.defaultScene);
    this->meshes_.parents = this->nodes_.parents;
    this->meshes_.node_to_scene = this->nodes_.scene_transforms();
    this->meshes_.mesh_to_scene = this->meshes_.node_to_scene;
  }

  GltfSceneMeshes read(Status& status)
  {
    for (const int id : scene_nodes(this->model_))
    {
      if (this->model_.nodes[id].mesh >= 0)
      {
        this->read_mesh(id);
      }
    }
    if (this->triangles_.empty())
    {
      throw GltfError("the default scene contains no triangles");
    }
    this->meshes_.points.resize(static_cast<Index>(this->points_.size()), 3);
    for (std::size_t v = 0; v < this->points_.size(); ++v)
    {
      this->meshes_.points.row(static_cast<Index>(v)) = this->points_[v];
    }
    if (!this->meshes_.points.allFinite())
    {
      throw GltfError("a vertex has a coordinate that is not finite");
    }
    this->meshes_.triangles = to_matrix(this->triangles_);
    this->meshes_.skin_joints =
      read_gltf_joints(this->model_, this->nodes_, this->joint_nodes_, this->joint_rests_);
    this->meshes_.largest_weights = Eigen::Map<const Eigen::RowVectorXd>(
      this->largest_weights_.data(), static_cast<Index>(this->largest_weights_.size()));
    this->read_animations();
    if (this->posed_meshes_ > 0)
    {
      status.warnings.push_back(std::to_string(this->posed_meshes_) +
        (this->posed_meshes_ == 1 ? " mesh is" : " meshes are") +
        " not in the bind pose of the skin; the weights are those of the bind pose");
    }
    Report& report = status.report;
    report.set("counts.meshes", this->meshes_.movers.size());
    report.set("counts.vertices", this->meshes_.points.rows());
    report.set("counts.triangles", this->meshes_.triangles.rows());
    report.set("counts.skipped_primitives", this->skipped_);
    return std::move(this->meshes_);
  }

private:
  void read_mesh(int id)
  {
    const tinygltf::Node& node = this->model_.nodes[id];
    const tinygltf::Mesh& mesh = gltf_element(this->model_.meshes, node.mesh, "mesh");
    if (std::none_of(mesh.primitives.begin(), mesh.primitives.end(), has_triangles))
    {
      this->skipped_ += static_cast<Index>(mesh.primitives.size());
      return;
    }
    const OldSkin* skin = node.skin >= 0 ? &this->skin(node.skin) : nullptr;
    if (skin)
    {
      this->meshes_.mesh_to_scene[id] = skin->mesh_to_scene;
      this->posed_meshes_ += skin->is_posed ? 1 : 0;
    }
    this->meshes_.movers[id] = skin ? skin->movers : this->with_ancestors(id);
    std::map<int, Index> first_of_accessor; // primitives with different materials share vertices
    for (std::size_t k = 0; k < mesh.primitives.size(); ++k)
    {
      const tinygltf::Primitive& primitive = mesh.primitives[k];
      const auto position = primitive.attributes.find("POSITION");
      if (position == primitive.attributes.end())
      {
        throw GltfError("a mesh has no attribute POSITION");
      }
      const auto [entry, is_new] =
        first_of_accessor.insert({ position->second, static_cast<Index>(this->points_.size()) });
      const Index count = is_new
        ? this->add_points(position->second, this->meshes_.mesh_to_scene[id])
        : static_cast<Index>(
            gltf_element(this->model_.accessors, position->second, "accessor").count);
      this->meshes_.parts.push_back({ id, static_cast<int>(k), entry->second, count });
      if (skin)
      {
        this->read_weights(primitive, count, *skin);
      }
      if (!has_triangles(primitive))
      {
        this->skipped_ += 1;
        continue;
      }
      for (const auto& t : read_gltf_triangles(this->accessors_, primitive, count))
      {
        this->triangles_.push_back(
          { entry->second + t[0], entry->second + t[1], entry->second + t[2] });
      }
    }
  }

  Index add_points(int accessor, const Eigen::Affine3d& mesh_to_scene)
  {
    const GltfNumbers rows = this->accessors_.read_finite(accessor, TINYGLTF_TYPE_VEC3, "POSITION");
    for (Index v = 0; v < rows.rows(); ++v)
    {
      this->points_.emplace_back(mesh_to_scene * Vec3(rows.row(v).transpose()));
    }
    return rows.rows();
  }

  /// Return a node and its ancestors.
  std::vector<int> with_ancestors(int node) const
  {
    std::vector<int> chain;
    for (int id = node; id >= 0; id = this->nodes_.parents[id])
    {
      chain.push_back(id);
    }
    return chain;
  }

  /// Return a skin, which is read at its first use.
  const OldSkin& skin(int id)
  {
    const auto [entry, is_new] = this->skins_.insert({ id, OldSkin() });
    if (is_new)
    {
      this->read_skin(gltf_element(this->model_.skins, id, "skin"), entry->second);
    }
    return entry->second;
  }

  void read_skin(const tinygltf::Skin& from, OldSkin& skin)
  {
    if (from.joints.empty())
    {
      throw GltfError("the skin has no joints");
    }
    const std::vector<Eigen::Affine3d> inverse_binds = read_inverse_binds(this->accessors_, from);
    std::map<int, std::size_t> joints_below; // per node: number of joints that are below it
    std::size_t top = 0; // the first of the joints with the fewest ancestors
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    for (std::size_t j = 0; j < from.joints.size(); ++j)
    {
      gltf_element(this->model_.nodes, from.joints[j], "node");
      const std::vector<int> chain = this->with_ancestors(from.joints[j]);
      for (const int node : chain)
      {
        joints_below[node] += 1;
      }
      if (chain.size() < fewest)
      {
        fewest = chain.size();
        top = j;
      }
    }
    const auto bind_map = [&](std::size_t j)
    { return this->meshes_.node_to_scene[from.joints[j]] * inverse_binds[j]; };
    skin.mesh_to_scene = bind_map(top);
    for (std::size_t j = 0; j < from.joints.size(); ++j)
    {
      constexpr double tolerance = 1e-4; // matrices are stored as floats
      const Eigen::Matrix4d difference = bind_map(j).matrix() - skin.mesh_to_scene.matrix();
      skin.is_posed =
        skin.is_posed || !(difference.norm() <= tolerance * skin.mesh_to_scene.matrix().norm());
      const auto [index, is_new] = this->joint_of_node_.insert(
        { from.joints[j], static_cast<Index>(this->joint_nodes_.size()) });
      if (is_new)
      {
        this->joint_nodes_.push_back(from.joints[j]);
        this->joint_rests_.push_back(skin.mesh_to_scene * inverse_binds[j].inverse());
        this->largest_weights_.push_back(0.0);
      }
      skin.joints.push_back(index->second);
    }
    for (const int node : this->with_ancestors(from.joints[top]))
    {
      const bool is_joint =
        std::find(from.joints.begin(), from.joints.end(), node) != from.joints.end();
      if (!is_joint && joints_below[node] == from.joints.size())
      {
        skin.movers.push_back(node);
      }
    }
  }

  void read_weights(const tinygltf::Primitive& primitive, Index vertices, const OldSkin& skin)
  {
    GltfInfluences influences;
    read_gltf_weights(this->accessors_, primitive, vertices, skin.joints.size(), influences);
    for (const auto& row : influences)
    {
      for (const auto& [joint, weight] : row)
      {
        double& largest = this->largest_weights_[skin.joints[joint]];
        largest = std::max(largest, weight);
      }
    }
  }

  void read_animations()
  {
    this->meshes_.animated.assign(this->model_.nodes.size(), 0);
    for (const tinygltf::Animation& animation : this->model_.animations)
    {
      bool moves_joint = false;
      for (const tinygltf::AnimationChannel& channel : animation.channels)
      {
        if (channel.target_node >= 0 && channel.target_path != "weights")
        {
          gltf_element(this->model_.nodes, channel.target_node, "node");
          this->meshes_.animated[channel.target_node] = 1;
          moves_joint = moves_joint || this->joint_of_node_.count(channel.target_node) > 0;
        }
      }
      this->meshes_.joint_animations += moves_joint ? 1 : 0;
    }
  }

  const tinygltf::Model& model_;
  const GltfAccessors accessors_;
  const GltfNodes nodes_;
  GltfSceneMeshes meshes_;
  std::vector<Vec3> points_;
  std::vector<std::array<Index, 3>> triangles_;
  std::map<int, OldSkin> skins_;
  std::map<int, Index> joint_of_node_;
  std::vector<int> joint_nodes_;
  std::vector<Eigen::Affine3d> joint_rests_;
  std::vector<double> largest_weights_;
  Index skipped_ = 0;
  Index posed_meshes_ = 0; ///< number of meshes that are not in the bind pose
};
} // namespace

GltfSceneMeshes read_gltf_scene(const tinygltf::Model& model, std::size_t file_size, Status& status)
{
  return SceneReader(model, file_size).read(status);
}

} // namespace bindpose
