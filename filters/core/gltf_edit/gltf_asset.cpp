#include "gltf_edit/gltf_asset.h"

#include "geometry/simplex_locator.h"
#include "gltf_edit/gltf_animation.h"
#include "gltf_edit/gltf_joints.h"
#include "gltf_edit/gltf_pose_error.h"
#include "gltf_edit/gltf_weights.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace bindpose
{

namespace
{
using Json = GltfDocument::Json;

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
      const auto id = node["skin"].get<std::size_t>();
      if (id >= skins.size())
      {
        throw GltfError("skin " + std::to_string(id) + " does not exist");
      }
      new_id[id] = 0;
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

Status GltfAsset::read(ExecutionContext& context, const std::string& path, ConvertPicture convert)
{
  *this = GltfAsset();
  return this->finish_reading(path,
    read_gltf_file(context, path,
      [&](const GltfContent& content, Status& status) { this->load(content, convert, status); }));
}

Status GltfAsset::read_bytes(const std::string& path, std::string bytes, ConvertPicture convert)
{
  *this = GltfAsset();
  this->is_converted_ = true;
  return this->finish_reading(path,
    read_gltf_bytes(path, std::move(bytes),
      [&](const GltfContent& content, Status& status) { this->load(content, convert, status); }));
}

void GltfAsset::load(const GltfContent& content, const ConvertPicture& convert, Status& status)
{
  this->document_ =
    GltfDocument(content.bytes, content.model, content.files.folder, status.warnings, convert);
  this->meshes_ = read_gltf_scene(content.model, content.bytes.size(), status);
}

Status GltfAsset::finish_reading(const std::string& path, Status status)
{
  if (!status.ok())
  {
    *this = GltfAsset();
  }
  this->path_ = path;
  return status;
}

std::optional<std::vector<Index>> GltfAsset::find_joints(const std::vector<GltfJoint>& joints) const
{
  constexpr double tolerance = 1e-5; // in bounding-box diagonals; files store floats
  const double diagonal = bounding_box(this->points(), this->triangles()).diagonal();
  std::map<std::string, Index> id_of_name;
  for (std::size_t j = 0; j < this->joints().size(); ++j)
  {
    id_of_name[this->joints()[j].name] = static_cast<Index>(j);
  }
  std::vector<Index> ids;
  for (const GltfJoint& joint : joints)
  {
    const auto entry = id_of_name.find(joint.name);
    if (entry == id_of_name.end() ||
      !((this->joints()[entry->second].rest.translation() - joint.rest.translation()).norm() <=
        tolerance * diagonal))
    {
      return {};
    }
    ids.push_back(entry->second);
  }
  return ids;
}

GltfJointNodes GltfAsset::keep_joints(const std::vector<Index>& ids, GltfSkin& skin) const
{
  const GltfSkinJoints& old = this->meshes_.skin_joints;
  const auto to_scene = [this](int node)
  { return node < 0 ? Eigen::Affine3d::Identity() : this->meshes_.node_to_scene[node]; };
  std::vector<Index> new_id(old.joints.size(), -1);
  for (std::size_t j = 0; j < ids.size(); ++j)
  {
    new_id[ids[j]] = static_cast<Index>(j);
  }
  GltfJointNodes nodes;
  std::vector<Eigen::Affine3d> from_new_to_old; // changes of the rest frames
  for (std::size_t j = 0; j < ids.size(); ++j)
  {
    GltfJoint joint = old.joints[ids[j]];
    nodes.joints.push_back(old.nodes[ids[j]]);
    Index parent = joint.parent;
    while (parent >= 0 && new_id[parent] < 0) // the skin does not have all joints
    {
      parent = old.joints[parent].parent;
    }
    joint.parent = parent < 0 ? -1 : new_id[parent];
    joint.to_parent_joint = to_scene(parent < 0 ? -1 : old.nodes[parent]).inverse() *
      to_scene(this->meshes_.parents[nodes.joints.back()]);
    from_new_to_old.push_back(skin.joints[j].rest.inverse() * joint.rest);
    skin.joints[j] = joint;
  }
  for (GltfFrame& frame : skin.frames)
  {
    for (std::size_t j = 0; j < ids.size(); ++j)
    {
      frame.posed[j] = frame.posed[j] * from_new_to_old[j];
    }
  }
  return nodes;
}

int GltfAsset::common_mover() const
{
  for (const int node : this->meshes_.movers.begin()->second)
  {
    const bool moves_all = std::all_of(this->meshes_.movers.begin(), this->meshes_.movers.end(),
      [node](const auto& entry)
      { return std::find(entry.second.begin(), entry.second.end(), node) != entry.second.end(); });
    if (moves_all && this->meshes_.animated[node] &&
      this->meshes_.node_to_scene[node].linear().determinant() != 0.0)
    {
      return node;
    }
  }
  return -1;
}

void GltfAsset::report_losses(bool keeps_joints, Status& status) const
{
  const auto with_ancestors = [this](int node, std::set<int>& nodes)
  {
    for (; node >= 0; node = this->meshes_.parents[node])
    {
      nodes.insert(node);
    }
  };
  std::set<int> kept; // nodes that move the joints of the new skin
  with_ancestors(this->common_mover(), kept);
  if (keeps_joints)
  {
    for (const int node : this->meshes_.skin_joints.nodes)
    {
      with_ancestors(node, kept);
    }
  }
  std::set<int> lost;
  for (const auto& [mesh, movers] : this->meshes_.movers)
  {
    std::copy_if(movers.begin(), movers.end(), std::inserter(lost, lost.end()),
      [&](int node) { return this->meshes_.animated[node] && kept.count(node) == 0; });
  }
  std::vector<std::string> losses;
  for (const int node : lost)
  {
    const Json& json = this->document_.json()["nodes"][node];
    losses.push_back(
      "the animation of node '" + sanitize_line(json.value("name", std::to_string(node))) + "'");
    status.warnings.push_back(
      losses.back() + " no longer moves its mesh, because the skin moves the mesh");
  }
  const Index animations = keeps_joints ? 0 : this->meshes_.joint_animations;
  if (animations > 0)
  {
    losses.push_back(std::to_string(animations) + (animations == 1 ? " animation" : " animations") +
      " of the old joints");
    status.warnings.push_back(
      losses.back() + (animations == 1 ? " no longer moves" : " no longer move") + " the meshes");
  }
  if (!losses.empty())
  {
    status.report.set("losses[]", losses);
  }
}

GltfJointNodes GltfAsset::add_skeleton(
  const std::vector<GltfJoint>& joints, const std::vector<Trs>& local_transforms, bool rest_joint)
{
  const GltfJointNodes nodes = append_joints(this->document_, joints, local_transforms, rest_joint);
  const int parent = this->common_mover();
  if (parent >= 0)
  {
    Json& json_nodes = this->document_.list("nodes");
    const Eigen::Matrix4d inverse = this->meshes_.node_to_scene[parent].inverse().matrix();
    json_nodes[nodes.root]["matrix"] =
      std::vector<double>(inverse.data(), inverse.data() + inverse.size());
    json_nodes[parent]["children"].push_back(nodes.root);
    return nodes;
  }
  this->add_to_scene(nodes.root);
  return nodes;
}

void GltfAsset::add_to_scene(int node)
{
  if (this->document_.list("scenes").empty())
  {
    Json roots = Json::array();
    for (std::size_t id = 0; id < this->meshes_.parents.size(); ++id)
    {
      if (this->meshes_.parents[id] < 0)
      {
        roots.push_back(id);
      }
    }
    this->document_.json()["scene"] = this->document_.append("scenes", { { "nodes", roots } });
  }
  this->document_.list("scenes")[this->meshes_.scene]["nodes"].push_back(node);
}

Status GltfAsset::check(const GltfSkin& skin, Index maximum_influences) const
{
  const Index vertices = this->points().rows();
  if (skin.weights.rows() != vertices ||
    skin.weights.cols() != static_cast<Index>(skin.joints.size()) || skin.joints.empty())
  {
    return Status::invalid_input("the weights have " + std::to_string(skin.weights.rows()) +
      " rows and " + std::to_string(skin.weights.cols()) + " columns; expected " +
      std::to_string(vertices) + " rows and " + std::to_string(skin.joints.size()) +
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

Status GltfAsset::set_skin(ExecutionContext& context, GltfSkin skin, Index maximum_influences)
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
  catch (const GltfError& failure)
  {
    return Status::invalid_input(this->path_ + ": " + failure.sentence);
  }
  catch (const Json::exception& error) // a value of the file has a wrong type
  {
    return Status::invalid_input(this->path_ + " is not valid: " + error.what());
  }
}

Status GltfAsset::replace_skins(ExecutionContext& context, GltfSkin& skin, Index maximum_influences)
{
  fill_unused_rows(this->points(), this->triangles(), skin.weights);
  const GltfWeights packed = to_gltf_weights(skin.weights, maximum_influences);
  const std::optional<std::vector<Index>> own =
    packed.rest_joint ? std::nullopt : this->find_joints(skin.joints);
  GltfJointNodes nodes;
  if (own)
  {
    nodes = this->keep_joints(*own, skin);
  }
  std::vector<Eigen::Affine3d> exact_maps;
  for (const GltfJoint& joint : skin.joints)
  {
    exact_maps.push_back(joint.posed);
  }
  std::vector<Eigen::Affine3d> stored_maps = exact_maps; // nodes that are kept are exact
  if (!own)
  {
    const std::vector<Trs> local_transforms = local_maps(skin.joints, exact_maps, stored_maps);
    nodes = this->add_skeleton(skin.joints, local_transforms, packed.rest_joint);
  }
  this->attach_skin(skin.joints, packed, nodes, own.has_value());
  remove_unused_skins(this->document_);

  Status status;
  this->report_losses(own.has_value(), status);
  const GltfStoredSkin stored{ this->points(), skin.joints, skin.weights, packed };
  const double diagonal =
    std::max(bounding_box(this->points(), this->triangles()).diagonal(), 1e-300);
  Report& report = status.report;
  report.set("counts.joints", skin.joints.size());
  report.set("kept_joints", own ? "yes" : "no");
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

/// A skin moves a mesh without the transforms of its node and of the node's ancestors. glTF
/// therefore recommends that the node has neither; some programs expect it.
int GltfAsset::move_mesh_to_root(int id)
{
  const Json old = this->document_.list("nodes")[id];
  const std::vector<int>& joints = this->meshes_.skin_joints.nodes;
  const bool has_other_uses = old.contains("children") || old.contains("camera") ||
    old.contains("extensions") || old.contains("extras") || this->meshes_.animated[id] ||
    std::find(joints.begin(), joints.end(), id) != joints.end();
  if (!has_other_uses)
  {
    Json& nodes = this->document_.list("nodes");
    for (const char* property : { "matrix", "translation", "rotation", "scale" })
    {
      nodes[id].erase(property);
    }
    const int parent = this->meshes_.parents[id];
    if (parent >= 0)
    {
      Json& children = nodes[parent]["children"];
      children.erase(std::remove(children.begin(), children.end(), Json(id)), children.end());
      if (children.empty())
      {
        nodes[parent].erase("children");
      }
      this->add_to_scene(id);
    }
    return id;
  }
  Json node{ { "mesh", old["mesh"] } };
  if (old.contains("name"))
  {
    node["name"] = old["name"];
  }
  this->document_.list("nodes")[id].erase("mesh");
  this->document_.list("nodes")[id].erase("skin");
  const int root = this->document_.append("nodes", std::move(node));
  this->add_to_scene(root);
  return root;
}

/// Give nodes that are not edited, such as those of another scene, copies of the meshes whose
/// weights are replaced.
void GltfAsset::copy_meshes_of_other_nodes()
{
  Json& nodes = this->document_.list("nodes");
  std::set<std::size_t> edited_nodes;
  std::map<int, int> copies; // of the edited meshes; -1: no copy yet
  for (const GltfPart& part : this->meshes_.parts)
  {
    edited_nodes.insert(static_cast<std::size_t>(part.node));
    copies.insert({ nodes[part.node]["mesh"].get<int>(), -1 });
  }
  for (std::size_t id = 0; id < nodes.size(); ++id)
  {
    if (edited_nodes.count(id) > 0 || !nodes[id].contains("mesh"))
    {
      continue;
    }
    const auto copy = copies.find(nodes[id]["mesh"].get<int>());
    if (copy == copies.end())
    {
      continue;
    }
    if (copy->second < 0)
    {
      const Json mesh = this->document_.list("meshes")[copy->first];
      copy->second = this->document_.append("meshes", mesh);
    }
    nodes[id]["mesh"] = copy->second;
  }
}

/// Copy all properties of a skin that do not refer to its joints.
void GltfAsset::keep_skin_properties(std::size_t from, int to)
{
  Json& skins = this->document_.list("skins");
  if (from >= skins.size())
  {
    throw GltfError("skin " + std::to_string(from) + " does not exist");
  }
  for (const auto& entry : skins[from].items())
  {
    const std::string& name = entry.key();
    if (name != "joints" && name != "skeleton" && name != "inverseBindMatrices")
    {
      skins[to][name] = entry.value();
    }
  }
}

/// Append one skin per old skin and transform from a mesh to the scene, and give the weights to the
/// primitives.
/// @param keeps_joints whether the joints are those of the file; then a skin keeps its name, extras
/// and extensions
void GltfAsset::attach_skin(const std::vector<GltfJoint>& joints, const GltfWeights& packed,
  const GltfJointNodes& nodes, bool keeps_joints)
{
  this->copy_meshes_of_other_nodes();
  // by the skin whose properties are kept (-1: none) and the transform from the mesh to the scene
  std::map<std::pair<int, std::vector<double>>, int> skins;
  std::map<Index, Json> attributes_of_vertices; // by the first vertex
  std::set<int> edited_meshes;
  int last_node = -1, mesh_node = -1;
  for (const GltfPart& part : this->meshes_.parts)
  {
    if (part.node != last_node)
    {
      last_node = part.node;
      const Eigen::Matrix4d map = this->meshes_.mesh_to_scene[part.node].matrix();
      const int old_skin =
        keeps_joints ? this->document_.list("nodes")[part.node].value("skin", -1) : -1;
      const auto [skin, is_new] =
        skins.insert({ { old_skin, { map.data(), map.data() + map.size() } }, -1 });
      if (is_new)
      {
        skin->second =
          append_skin(this->document_, joints, nodes, this->meshes_.mesh_to_scene[part.node]);
        if (old_skin >= 0)
        {
          this->keep_skin_properties(static_cast<std::size_t>(old_skin), skin->second);
        }
      }
      mesh_node = this->is_converted_ ? this->move_mesh_to_root(part.node) : part.node;
      Json& node = this->document_.list("nodes")[mesh_node];
      node["skin"] = skin->second;
      const int mesh = node["mesh"].get<int>();
      if (!edited_meshes.insert(mesh).second)
      {
        // A second node has this mesh. Its vertices have other weights, so it needs its own mesh,
        // whose weights are replaced below.
        const Json copy = this->document_.list("meshes")[mesh];
        node["mesh"] = this->document_.append("meshes", copy);
      }
    }
    const auto [stored, is_new] = attributes_of_vertices.insert({ part.first, Json::object() });
    if (is_new)
    {
      append_weights(this->document_, packed, part.first, part.first + part.count, stored->second);
    }
    const auto mesh = this->document_.list("nodes")[mesh_node]["mesh"].get<std::size_t>();
    Json& attributes =
      this->document_.list("meshes")[mesh]["primitives"][part.primitive]["attributes"];
    erase_weights(attributes);
    attributes.update(stored->second);
  }
}

Status GltfAsset::write(const std::string& path, bool binary) const
{
  return this->document_.write(path, binary);
}

} // namespace bindpose
