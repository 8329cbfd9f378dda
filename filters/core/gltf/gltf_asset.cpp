#include "gltf/gltf_asset.h"

#include "geometry/simplex_locator.h"
#include "gltf/gltf_animation.h"
#include "gltf/gltf_joints.h"
#include "gltf/gltf_model.h"
#include "gltf/gltf_pose_error.h"
#include "gltf/gltf_weights.h"
#include "io/text_scanner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

namespace bindpose
{

namespace
{
using Json = GltfDocument::Json;

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

/// Return the transform by which a skin moves its meshes if it is in the bind pose: all joints then
/// have the same transform. Otherwise return the identity and set `posed`.
Eigen::Affine3d bind_transform(const tinygltf::Model& model, const GltfAccessors& accessors,
  const std::vector<Eigen::Affine3d>& node_to_scene, const tinygltf::Skin& skin, bool& posed)
{
  posed = true;
  if (skin.joints.empty() || skin.inverseBindMatrices < 0)
  {
    return Eigen::Affine3d::Identity();
  }
  const std::vector<Eigen::Affine3d> inverse_binds = read_inverse_binds(accessors, skin);
  Eigen::Affine3d first = Eigen::Affine3d::Identity();
  for (std::size_t j = 0; j < skin.joints.size(); ++j)
  {
    gltf_element(model.nodes, skin.joints[j], "node");
    const Eigen::Affine3d map = node_to_scene[skin.joints[j]] * inverse_binds[j];
    constexpr double tolerance = 1e-4; // matrices are stored as floats
    if (j == 0)
    {
      first = map;
    }
    else if (!((map.matrix() - first.matrix()).norm() <= tolerance * first.matrix().norm()))
    {
      return Eigen::Affine3d::Identity();
    }
  }
  posed = false;
  return first;
}

/// Replace the weights of each vertex that no triangle uses by those of the nearest point of a
/// triangle.
void fill_unused_rows(const Points& points, const Triangles& triangles, Weights& weights)
{
  std::vector<char> used(static_cast<std::size_t>(points.rows()), 0);
  for (Index k = 0; k < triangles.size(); ++k)
  {
    used[triangles.data()[k]] = 1;
  }
  if (std::all_of(used.begin(), used.end(), [](char vertex) { return vertex != 0; }))
  {
    return;
  }
  const SimplexLocator locator(points, triangles);
  for (Index v = 0; v < points.rows(); ++v)
  {
    if (used[v])
    {
      continue;
    }
    const SimplexLocation nearest = locator.locate(points.row(v));
    weights.row(v).setZero();
    for (int k = 0; k < 3; ++k)
    {
      weights.row(v) += nearest.barycentric[k] * weights.row(triangles(nearest.element, k)).eval();
    }
  }
}

/// Remove the attributes JOINTS_n and WEIGHTS_n of a primitive.
void erase_weights(Json& attributes)
{
  std::vector<std::string> names;
  for (const auto& entry : attributes.items())
  {
    if (entry.key().compare(0, 7, "JOINTS_") == 0 || entry.key().compare(0, 8, "WEIGHTS_") == 0)
    {
      names.push_back(entry.key());
    }
  }
  for (const std::string& name : names)
  {
    attributes.erase(name);
  }
}

/// Remove the skins that no node uses, and renumber the others.
void remove_unused_skins(GltfDocument& document)
{
  Json& skins = document.list("skins");
  std::vector<int> new_id(skins.size(), -1);
  for (const Json& node : document.list("nodes"))
  {
    if (node.contains("skin"))
    {
      new_id.at(node["skin"].get<std::size_t>()) = 0;
    }
  }
  Json kept = Json::array();
  for (std::size_t k = 0; k < skins.size(); ++k)
  {
    if (new_id[k] == 0)
    {
      new_id[k] = static_cast<int>(kept.size());
      kept.push_back(std::move(skins[k]));
    }
  }
  skins = std::move(kept);
  for (Json& node : document.list("nodes"))
  {
    if (node.contains("skin"))
    {
      node["skin"] = new_id[node["skin"].get<std::size_t>()];
    }
  }
}
} // namespace

/// Reads the meshes of a scene.
struct GltfAsset::Reader
{
  Reader(GltfAsset& asset, const tinygltf::Model& model, std::size_t file_size, Status& status)
    : asset_(asset), model_(model), accessors_(model, file_size), status_(status)
  {
  }

  void read()
  {
    const GltfNodes nodes = read_gltf_nodes(this->model_);
    this->asset_.scene_ = std::max(0, this->model_.defaultScene);
    this->asset_.parents_ = nodes.parents;
    this->asset_.node_to_scene_ = nodes.scene_transforms();
    this->asset_.mesh_to_scene_ = this->asset_.node_to_scene_;
    this->asset_.animated_.assign(this->model_.nodes.size(), 0);
    for (const tinygltf::Animation& animation : this->model_.animations)
    {
      for (const tinygltf::AnimationChannel& channel : animation.channels)
      {
        if (channel.target_node >= 0 && channel.target_path != "weights")
        {
          gltf_element(this->model_.nodes, channel.target_node, "node");
          this->asset_.animated_[channel.target_node] = 1;
        }
      }
    }
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
    this->asset_.points_.resize(static_cast<Index>(this->points_.size()), 3);
    for (std::size_t v = 0; v < this->points_.size(); ++v)
    {
      this->asset_.points_.row(static_cast<Index>(v)) = this->points_[v];
    }
    if (!this->asset_.points_.allFinite())
    {
      throw GltfError("a vertex has a coordinate that is not finite");
    }
    this->asset_.triangles_ = to_matrix(this->triangles_);
    this->count_joint_animations();
    if (this->posed_meshes_ > 0)
    {
      this->status_.warnings.push_back(std::to_string(this->posed_meshes_) +
        (this->posed_meshes_ == 1 ? " mesh is" : " meshes are") +
        " not in the bind pose of the skin; the new skin begins with the bind pose");
    }
    Report& report = this->status_.report;
    report.set("counts.meshes", this->meshes_);
    report.set("counts.vertices", this->asset_.points_.rows());
    report.set("counts.triangles", this->asset_.triangles_.rows());
    report.set("counts.skipped_primitives", this->skipped_);
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
    if (node.skin >= 0)
    {
      const tinygltf::Skin& skin = gltf_element(this->model_.skins, node.skin, "skin");
      bool posed = false;
      this->asset_.mesh_to_scene_[id] =
        bind_transform(this->model_, this->accessors_, this->asset_.node_to_scene_, skin, posed);
      this->posed_meshes_ += posed ? 1 : 0;
      this->old_joints_.insert(skin.joints.begin(), skin.joints.end());
    }
    this->meshes_ += 1;
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
        ? this->add_points(position->second, this->asset_.mesh_to_scene_[id])
        : static_cast<Index>(
            gltf_element(this->model_.accessors, position->second, "accessor").count);
      this->asset_.parts_.push_back({ id, static_cast<int>(k), entry->second, count });
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

  void count_joint_animations()
  {
    for (const tinygltf::Animation& animation : this->model_.animations)
    {
      const auto moves_joint = [this](const tinygltf::AnimationChannel& channel)
      { return this->old_joints_.count(channel.target_node) > 0; };
      this->asset_.joint_animations_ +=
        std::any_of(animation.channels.begin(), animation.channels.end(), moves_joint) ? 1 : 0;
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

  GltfAsset& asset_;
  const tinygltf::Model& model_;
  const GltfAccessors accessors_;
  Status& status_;
  std::vector<Vec3> points_;
  std::vector<std::array<Index, 3>> triangles_;
  Index meshes_ = 0;
  Index skipped_ = 0;
  Index posed_meshes_ = 0; ///< number of meshes that are not in the bind pose
  std::set<int> old_joints_; ///< nodes of the joints of the meshes' skins
};

Status GltfAsset::read(const std::string& path)
{
  *this = GltfAsset();
  const Status status = read_gltf_file(path,
    [this](const GltfContent& content, Status& found)
    {
      this->document_ =
        GltfDocument(content.bytes, content.model, content.files.folder, found.warnings);
      Reader(*this, content.model, content.bytes.size(), found).read();
    });
  if (!status.ok())
  {
    *this = GltfAsset();
  }
  this->path_ = path;
  return status;
}

GltfJointNodes GltfAsset::add_skeleton(const std::vector<GltfJoint>& joints,
  const std::vector<Trs>& local_transforms, bool rest_joint, Status& status)
{
  const GltfJointNodes nodes = append_joints(this->document_, joints, local_transforms, rest_joint);
  std::set<int> meshes;
  std::map<int, Index> moved_meshes; // per animated node: number of the meshes that it moves
  for (const Part& part : this->parts_)
  {
    for (int id = meshes.insert(part.node).second ? part.node : -1; id >= 0;
         id = this->parents_[id])
    {
      moved_meshes[id] += this->animated_[id];
    }
  }
  // The joints move with `parent`, so the motion of this node and of its parents is kept.
  int parent = -1;
  for (int id = *meshes.begin(); id >= 0 && parent < 0; id = this->parents_[id])
  {
    const bool moves_all = moved_meshes[id] == static_cast<Index>(meshes.size());
    parent = moves_all && this->node_to_scene_[id].linear().determinant() != 0.0 ? id : -1;
  }
  std::vector<std::string> losses;
  for (const auto& [id, count] : moved_meshes)
  {
    if (count > 0 && count < static_cast<Index>(meshes.size()))
    {
      losses.push_back("the animation of node '" +
        sanitize_line(this->document_.list("nodes")[id].value("name", std::to_string(id))) + "'");
      status.warnings.push_back(
        losses.back() + " no longer moves its mesh, because the skin moves the mesh");
    }
  }
  if (this->joint_animations_ > 0)
  {
    losses.push_back(std::to_string(this->joint_animations_) +
      (this->joint_animations_ == 1 ? " animation" : " animations") + " of the old joints");
    status.warnings.push_back(losses.back() + " no longer move the meshes");
  }
  if (!losses.empty())
  {
    status.report.set("losses[]", losses);
  }
  Json& json_nodes = this->document_.list("nodes");
  if (parent >= 0)
  {
    const Eigen::Matrix4d inverse = this->node_to_scene_[parent].inverse().matrix();
    json_nodes[nodes.root]["matrix"] =
      std::vector<double>(inverse.data(), inverse.data() + inverse.size());
    json_nodes[parent]["children"].push_back(nodes.root);
    return nodes;
  }
  Json& scenes = this->document_.list("scenes");
  if (scenes.empty())
  {
    Json roots = Json::array();
    for (std::size_t id = 0; id < this->parents_.size(); ++id)
    {
      if (this->parents_[id] < 0)
      {
        roots.push_back(id);
      }
    }
    this->document_.json()["scene"] = 0;
    scenes.push_back({ { "nodes", std::move(roots) } });
  }
  scenes[this->scene_]["nodes"].push_back(nodes.root);
  return nodes;
}

Status GltfAsset::check(const GltfSkin& skin, Index maximum_influences) const
{
  if (skin.weights.rows() != this->points_.rows() ||
    skin.weights.cols() != static_cast<Index>(skin.joints.size()) || skin.joints.empty())
  {
    return Status::invalid_input("the weights have " + std::to_string(skin.weights.rows()) +
      " rows and " + std::to_string(skin.weights.cols()) + " columns; expected " +
      std::to_string(this->points_.rows()) + " rows and " + std::to_string(skin.joints.size()) +
      " columns, at least one");
  }
  if (!fits_in_float(skin.weights) || maximum_influences < 0)
  {
    return Status::invalid_input(maximum_influences < 0
        ? "the number of influences is negative"
        : "the weights contain a value that is not a finite float");
  }
  const Status status = check_joints(skin.joints);
  return status.ok() ? check_frames(skin, GltfAnimation::joints) : status;
}

Status GltfAsset::set_skin(
  ExecutionContext& context, const GltfSkin& skin, Index maximum_influences)
{
  const Status status = this->check(skin, maximum_influences);
  if (!status.ok())
  {
    return status;
  }
  try
  {
    return this->replace_skins(context, skin, maximum_influences);
  }
  catch (const Json::exception& error) // a value of the file has a wrong type
  {
    return Status::invalid_input(this->path_ + " is not valid: " + error.what());
  }
}

Status GltfAsset::replace_skins(
  ExecutionContext& context, const GltfSkin& skin, Index maximum_influences)
{
  Weights weights = skin.weights;
  fill_unused_rows(this->points_, this->triangles_, weights);
  const GltfWeights packed = to_gltf_weights(weights, maximum_influences);
  std::vector<Eigen::Affine3d> exact_maps, stored_maps;
  for (const GltfJoint& joint : skin.joints)
  {
    exact_maps.push_back(joint.posed);
  }
  const std::vector<Trs> local_transforms = local_maps(skin.joints, exact_maps, stored_maps);
  Status status;
  const GltfJointNodes nodes =
    this->add_skeleton(skin.joints, local_transforms, packed.rest_joint, status);
  this->attach_skin(skin.joints, packed, nodes);
  remove_unused_skins(this->document_);

  const GltfStoredSkin stored{ this->points_, skin.joints, weights, packed };
  const double diagonal =
    std::max(bounding_box(this->points_, this->triangles_).diagonal(), 1e-300);
  Report& report = status.report;
  report.set("counts.joints", skin.joints.size());
  report_weights(packed, status);
  report.set("pose_error", largest_pose_error(stored, exact_maps, stored_maps) / diagonal);
  if (!skin.frames.empty())
  {
    double error = 0.0;
    const Status animated =
      append_joint_animation(context, this->document_, skin, nodes, stored, error);
    if (!animated.ok())
    {
      return animated;
    }
    report.set("counts.frames", skin.frames.size());
    report.set("animation_error", error / diagonal);
  }
  return status;
}

/// Append one skin per transform from a mesh to the scene, and give the weights to the primitives.
void GltfAsset::attach_skin(
  const std::vector<GltfJoint>& joints, const GltfWeights& packed, const GltfJointNodes& nodes)
{
  std::map<std::vector<double>, int> skins; // by the transform from the mesh to the scene
  std::map<Index, Json> attributes_of_vertices; // by the first vertex
  std::set<int> edited_meshes;
  int last_node = -1;
  for (const Part& part : this->parts_)
  {
    Json& node = this->document_.list("nodes")[part.node];
    if (part.node != last_node)
    {
      last_node = part.node;
      const Eigen::Matrix4d map = this->mesh_to_scene_[part.node].matrix();
      const auto [skin, is_new] = skins.insert({ { map.data(), map.data() + map.size() }, -1 });
      if (is_new)
      {
        skin->second = append_skin(this->document_, joints, nodes, this->mesh_to_scene_[part.node]);
      }
      node["skin"] = skin->second;
      const int mesh = node["mesh"].get<int>();
      if (!edited_meshes.insert(mesh).second)
      {
        // A second node has this mesh. Its vertices have other weights, so it needs its own mesh,
        // whose weights are replaced below.
        node["mesh"] = this->document_.append("meshes", Json(this->document_.list("meshes")[mesh]));
      }
    }
    const auto [stored, is_new] = attributes_of_vertices.insert({ part.first, Json::object() });
    if (is_new)
    {
      append_weights(this->document_, packed, part.first, part.first + part.count, stored->second);
    }
    Json& attributes = this->document_.list(
      "meshes")[node["mesh"].get<std::size_t>()]["primitives"][part.primitive]["attributes"];
    erase_weights(attributes);
    attributes.update(stored->second);
  }
}

Status GltfAsset::write(const std::string& path, bool binary) const
{
  return this->document_.write(path, binary);
}

} // namespace bindpose
