// New skins for glTF files: the rest pose and posed shapes according to the written file, and the
// values of everything that is kept.
#include "gltf_edit/gltf_asset.h"
#include "gltf/gltf_model.h"

#include "support/files.h"
#include "support/meshes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

using namespace bindpose;
using Json = GltfDocument::Json;
using testing::ElementsAre;
using testing::HasSubstr;

namespace
{
/// Bytes that begin like a PNG file.
const std::string picture = std::string("\x89PNG\r\n\x1a\n", 8) + "not a real picture";

/// Return a scene of three nodes with triangles. The nodes "box" and "copy" have the same mesh,
/// whose two primitives share their vertices. The third node has a strip of two triangles and a
/// primitive of points. Other content: a camera, materials, a texture, extras, an unknown
/// extension, a second scene, a morph target, and an animation of the node "lid".
GltfDocument scene()
{
  GltfDocument document;
  const TriangleMesh cube = test::cube();
  const int points = document.append_rows(cube.points);
  std::vector<std::uint16_t> lower, upper;
  for (Index k = 0; k < cube.triangles.size(); ++k)
  {
    const bool first = k < cube.triangles.size() / 2;
    (first ? lower : upper).push_back(static_cast<std::uint16_t>(cube.triangles.data()[k]));
  }
  const int target = GltfDocument::element_array_buffer;
  const int morph = document.append_rows(Points(0.1 * cube.points));
  const Json attributes{ { "POSITION", points }, { "_UNKNOWN", points } };
  const Json targets = Json::array({ Json{ { "POSITION", morph } } });
  document.append("meshes",
    { { "name", "box" },
      { "primitives",
        Json::array(
          { Json{ { "attributes", attributes }, { "targets", targets },
              { "indices", document.append_accessor(lower, 1, target) }, { "material", 0 } },
            Json{ { "attributes", attributes }, { "targets", targets },
              { "indices", document.append_accessor(upper, 1, target) }, { "material", 1 } } }) },
      { "extras", { { "mine", Json::array({ 1, 0.1, 1e-300 }) } } } });
  const TriangleMesh strip = test::grid(1, 1);
  const int strip_points = document.append_rows(strip.points);
  Points far = strip.points;
  far.col(2).array() += 0.25;
  document.append("meshes",
    { { "primitives",
      Json::array({ Json{ { "attributes", { { "POSITION", strip_points } } }, { "mode", 5 } },
        Json{
          { "attributes", { { "POSITION", document.append_rows(far) } } }, { "mode", 0 } } }) } });
  document.append("nodes", { { "name", "box" }, { "mesh", 0 }, { "translation", { 1, 2, 3 } } });
  document.append("nodes",
    { { "name", "parent" }, { "children", { 2, 3 } }, { "rotation", { 0, 0, 0.6, 0.8 } },
      { "extras", "text" } });
  document.append("nodes", { { "name", "copy" }, { "mesh", 0 }, { "scale", { 2, 1, -1 } } });
  document.append("nodes", { { "name", "lid" }, { "mesh", 1 }, { "camera", 0 } });
  document.append("cameras",
    { { "type", "perspective" }, { "perspective", { { "yfov", 0.7 }, { "znear", 0.01 } } } });
  document.append("scenes", { { "nodes", { 0, 1 } }, { "name", "main" } });
  document.append("scenes", { { "nodes", { 0 } } });
  const int view = document.append_view(picture.data(), picture.size(), 0);
  document.append("images", { { "bufferView", view }, { "mimeType", "image/png" } });
  document.append("textures", { { "source", 0 } });
  document.append("materials",
    { { "name", "red" },
      { "pbrMetallicRoughness", { { "baseColorFactor", { 0.1, 0.2, 0.3, 1 } } } } });
  document.append(
    "materials", { { "pbrMetallicRoughness", { { "baseColorTexture", { { "index", 0 } } } } } });
  document.json()["scene"] = 0;
  document.json()["extensionsUsed"] = { "BINDPOSE_unknown" };
  document.json()["extensions"]["BINDPOSE_unknown"] = { { "value", 0.1 } };
  return document;
}

/// Add an animation of the translation of a node.
void animate(GltfDocument& document, int node)
{
  const Eigen::Matrix<double, 2, 1> times(0.0, 1.0);
  const int input = document.append_rows(Eigen::MatrixXd(times), 0);
  const int output = document.append_rows(Points::Random(2, 3).eval(), 0);
  document.append("animations",
    { { "channels",
        Json::array({ Json{
          { "sampler", 0 }, { "target", { { "node", node }, { "path", "translation" } } } } }) },
      { "samplers", Json::array({ Json{ { "input", input }, { "output", output } } }) } });
}

/// Return two joints: a root, and a child that is rotated.
std::vector<GltfJoint> two_joints()
{
  std::vector<GltfJoint> joints(2);
  joints[0].name = "root";
  joints[0].rest.translation() = Vec3(0.5, 0, 0);
  joints[1].name = "tip";
  joints[1].parent = 0;
  joints[1].rest.translation() = Vec3(1, 2, 4);
  joints[1].rest.linear() = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (GltfJoint& joint : joints)
  {
    joint.posed = joint.rest;
  }
  return joints;
}

/// Return weights that depend on the positions.
Weights weights_of(const Points& points)
{
  Weights weights(points.rows(), 2);
  weights.col(0) = 0.5 + 0.4 * points.col(0).array().sin();
  weights.col(1) = 1.0 - weights.col(0).array();
  return weights;
}

GltfSkin make_skin(std::vector<GltfJoint> joints, Weights weights)
{
  GltfSkin skin;
  skin.joints = std::move(joints);
  skin.weights = std::move(weights);
  return skin;
}

struct File
{
  std::string content;
  tinygltf::Model model;
  Json json;

  explicit File(const std::string& path)
  {
    std::ifstream stream(path, std::ios::binary);
    this->content.assign(std::istreambuf_iterator<char>(stream), {});
    GltfBufferFiles files;
    files.folder = std::filesystem::path(path).parent_path().string();
    this->model = parse_gltf(this->content, files);
    std::vector<std::string> warnings;
    this->json = GltfDocument(this->content, this->model, files.folder, warnings).json();
  }

  /// Return the scene positions of the vertices of a node's primitive according to the skin, if
  /// node `moved` is moved by `motion`.
  Points skinned(int node, int primitive, int moved, const Eigen::Affine3d& motion) const
  {
    const GltfAccessors accessors(this->model, this->content.size());
    GltfNodes nodes = read_gltf_nodes(this->model);
    if (moved >= 0)
    {
      nodes.node_transforms[moved].matrix = nodes.node_transforms[moved].affine() * motion;
      nodes.node_transforms[moved].has_matrix = true;
    }
    const auto scene = nodes.scene_transforms();
    const tinygltf::Node& mesh_node = this->model.nodes.at(node);
    const tinygltf::Skin& skin = this->model.skins.at(mesh_node.skin);
    const auto& attributes =
      this->model.meshes.at(mesh_node.mesh).primitives.at(primitive).attributes;
    const GltfNumbers binds = accessors.read(skin.inverseBindMatrices, TINYGLTF_TYPE_MAT4, "binds");
    const GltfNumbers points =
      accessors.read(attributes.at("POSITION"), TINYGLTF_TYPE_VEC3, "points");
    const GltfNumbers joints =
      accessors.read(attributes.at("JOINTS_0"), TINYGLTF_TYPE_VEC4, "joints");
    const GltfNumbers weights =
      accessors.read(attributes.at("WEIGHTS_0"), TINYGLTF_TYPE_VEC4, "weights");
    Points result = Points::Zero(points.rows(), 3);
    for (Index v = 0; v < points.rows(); ++v)
    {
      for (int k = 0; k < 4; ++k)
      {
        const auto joint = static_cast<Index>(joints(v, k));
        const Eigen::Map<const Eigen::Matrix4d> bind(binds.data() + 16 * joint);
        const Eigen::Vector4d p =
          scene[skin.joints[joint]].matrix() * bind * points.row(v).transpose().homogeneous();
        result.row(v) += weights(v, k) * p.head<3>().transpose();
      }
    }
    return result;
  }
};

class GltfAssets : public testing::Test
{
protected:
  const test::Folder folder_;
  GltfAsset asset_;
  ExecutionContext context_;

  std::string write(const GltfDocument& document) const
  {
    EXPECT_TRUE(document.write(this->folder_ / "in.glb", true).ok());
    return this->folder_ / "in.glb";
  }

  /// Read a document and give it the skin of two_joints() and weights_of().
  Status rig(const GltfDocument& document)
  {
    Status status = this->asset_.read(this->context_, this->write(document));
    EXPECT_TRUE(status.ok()) << status.message;
    status = this->asset_.set_skin(
      this->context_, make_skin(two_joints(), weights_of(this->asset_.points())), 4);
    EXPECT_TRUE(status.ok()) << status.message;
    EXPECT_TRUE(this->asset_.write(this->folder_ / "out.glb", true).ok());
    return status;
  }
};
} // namespace

TEST_F(GltfAssets, PointsAreThoseOfTheScene)
{
  const Status status = this->asset_.read(this->context_, this->write(scene()));
  ASSERT_TRUE(status.ok()) << status.message;
  // twice the cube, whose primitives share their vertices, the strip, and the points
  ASSERT_EQ(this->asset_.points().rows(), 8 + 8 + 4 + 4);
  EXPECT_EQ(this->asset_.triangles().rows(), 12 + 12 + 2);
  EXPECT_EQ(status.report.number("counts.meshes", 0), 3);
  EXPECT_EQ(status.report.number("counts.skipped_primitives", 0), 1);
  const TriangleMesh cube = test::cube();
  const Eigen::Matrix3d turn = Eigen::Quaterniond(0.8, 0, 0, 0.6).toRotationMatrix();
  for (Index v = 0; v < 8; ++v)
  {
    const Vec3 p = cube.points.row(v);
    EXPECT_LT((this->asset_.points().row(v).transpose() - (p + Vec3(1, 2, 3))).norm(), 1e-12);
    EXPECT_LT(
      (this->asset_.points().row(8 + v).transpose() - turn * Vec3(2 * p[0], p[1], -p[2])).norm(),
      1e-12);
  }
}

TEST_F(GltfAssets, TheFileHasTheRestPoseAndPosesOfTheSkin)
{
  this->rig(scene());
  const File file(this->folder_ / "out.glb");
  const Points& points = this->asset_.points();
  const Weights weights = weights_of(points);
  const int tip = 6; // four nodes of the scene, the node "handles", "root", "tip"
  ASSERT_EQ(file.model.nodes.at(tip).name, "tip");
  const std::vector<std::array<int, 3>> parts{ { 0, 0, 0 }, { 0, 1, 0 }, { 2, 0, 8 },
    { 3, 0, 16 } };
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();
  for (const int moved : { -1, tip })
  {
    const GltfJoint joint = two_joints()[1];
    const Eigen::Affine3d map = joint.rest * motion * joint.rest.inverse();
    for (const auto& [node, primitive, first] : parts)
    {
      const Points posed = file.skinned(node, primitive, moved, motion);
      for (Index v = 0; v < posed.rows(); ++v)
      {
        const Vec3 p = points.row(first + v);
        const Vec3 expected = p + weights(first + v, 1) * (map * p - p);
        EXPECT_LT((posed.row(v).transpose() - expected).norm(), 1e-5) << node << " " << v;
      }
    }
    motion.linear() = Eigen::AngleAxisd(0.4, Vec3::UnitX()).toRotationMatrix();
    motion.translation() = Vec3(0.1, 0.2, 0.3);
  }
  // the points follow the nearest point of the strip
  const Points followed = file.skinned(3, 1, -1, motion);
  EXPECT_LT((followed - points.bottomRows(4)).cwiseAbs().maxCoeff(), 1e-5);
}

TEST_F(GltfAssets, EverythingElseIsKept)
{
  GltfDocument document = scene();
  animate(document, 1);
  this->rig(document);
  const File before(this->folder_ / "in.glb");
  File after(this->folder_ / "out.glb");
  // The bytes of the buffer are a prefix of the new buffer.
  const auto& old_bytes = before.model.buffers.at(0).data;
  const auto& new_bytes = after.model.buffers.at(0).data;
  ASSERT_GT(new_bytes.size(), old_bytes.size());
  EXPECT_TRUE(std::equal(old_bytes.begin(), old_bytes.end(), new_bytes.begin()));
  // Remove what was added. The rest is the same text.
  Json& json = after.json;
  json.erase("skins");
  for (const char* list : { "accessors", "bufferViews", "nodes" })
  {
    json[list].erase(
      json[list].begin() + static_cast<std::ptrdiff_t>(before.json[list].size()), json[list].end());
  }
  json["buffers"] = before.json["buffers"];
  for (Json& node : json["nodes"])
  {
    node.erase("skin");
  }
  EXPECT_EQ(json["nodes"][2]["mesh"], 2); // the second node with the mesh "box" has its own mesh
  json["nodes"][2]["mesh"] = 0;
  EXPECT_EQ(json["scenes"][0]["nodes"].size(), 2u + 1u); // the skeleton is a root of the scene
  json["scenes"][0]["nodes"].erase(2);
  for (Json& mesh : json["meshes"])
  {
    for (Json& primitive : mesh["primitives"])
    {
      EXPECT_EQ(primitive["attributes"].erase("JOINTS_0"), 1u);
      EXPECT_EQ(primitive["attributes"].erase("WEIGHTS_0"), 1u);
    }
  }
  EXPECT_EQ(json["meshes"][2].dump(), json["meshes"][0].dump());
  json["meshes"].erase(2);
  EXPECT_EQ(json.dump(), before.json.dump());
}

TEST_F(GltfAssets, MotionsThatAreLostAreNamed)
{
  GltfDocument document = scene();
  animate(document, 3);
  Status status = this->rig(document);
  ASSERT_EQ(status.warnings.size(), 1u);
  EXPECT_EQ(status.warnings[0],
    "the animation of node 'lid' no longer moves its mesh, because the skin moves the mesh");
  EXPECT_EQ(std::get<std::vector<std::string>>(*status.report.find("losses[]")),
    std::vector<std::string>{ "the animation of node 'lid'" });
  // The node "parent" moves only two of the three meshes.
  document = scene();
  animate(document, 1);
  status = this->rig(document);
  EXPECT_EQ(status.warnings.size(), 1u);
  // A node that moves all meshes also moves the joints.
  document = scene();
  document.append(
    "nodes", { { "name", "world" }, { "children", { 0, 1 } }, { "translation", { 0, 0, 5 } } });
  document.list("scenes")[0]["nodes"] = { 4 };
  document.list("scenes").erase(1);
  animate(document, 4);
  status = this->rig(document);
  EXPECT_TRUE(status.warnings.empty());
  const File file(this->folder_ / "out.glb");
  EXPECT_EQ(file.json["nodes"][4]["children"], Json({ 0, 1, 5 }));
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();
  motion.translation() = Vec3(7, 8, 9);
  EXPECT_LT(((file.skinned(0, 0, 4, motion) - this->asset_.points().topRows(8)).rowwise() -
              Eigen::RowVector3d(7, 8, 9))
              .cwiseAbs()
              .maxCoeff(),
    1e-5);
}

TEST_F(GltfAssets, ThePoseOfTheJointsAndTheFramesAreWritten)
{
  ASSERT_TRUE(this->asset_.read(this->context_, this->write(scene())).ok());
  const Points& points = this->asset_.points();
  GltfSkin skin = make_skin(two_joints(), weights_of(points));
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();
  motion.linear() = Eigen::AngleAxisd(0.4, Vec3::UnitX()).toRotationMatrix();
  motion.translation() = Vec3(0.1, 0.2, 0.3);
  skin.joints[1].posed = motion * skin.joints[1].rest;
  for (int k = 0; k < 3; ++k)
  {
    skin.frames.emplace_back();
    skin.frames[k].posed = { skin.joints[0].rest, skin.joints[1].rest };
    skin.frames[k].posed[1].translation()[0] += 0.5 * k;
  }
  skin.frames_per_second = 12.0;
  const Status status = this->asset_.set_skin(this->context_, skin, 0);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_LT(status.report.number("pose_error", 1), 1e-6);
  EXPECT_LT(status.report.number("animation_error", 1), 1e-6);
  EXPECT_EQ(status.report.number("counts.frames", 0), 3);
  ASSERT_TRUE(this->asset_.write(this->folder_ / "out.glb", true).ok());
  const File file(this->folder_ / "out.glb");
  const Points posed = file.skinned(3, 0, -1, motion);
  for (Index v = 0; v < posed.rows(); ++v)
  {
    const Vec3 p = points.row(16 + v);
    const Vec3 expected = p + skin.weights(16 + v, 1) * (motion * p - p);
    EXPECT_LT((posed.row(v).transpose() - expected).norm(), 1e-5);
  }
  GltfSkin read;
  ASSERT_TRUE(read_gltf_skin(this->context_, this->folder_ / "out.glb", read).ok());
  EXPECT_EQ(read.frames_per_second, 12.0);
  ASSERT_EQ(read.frames.size(), 3u);
  for (int k = 0; k < 3; ++k)
  {
    for (int j = 0; j < 2; ++j)
    {
      EXPECT_LT((read.frames[k].posed[j].matrix() - skin.frames[k].posed[j].matrix()).norm(), 1e-5);
    }
  }
}

TEST_F(GltfAssets, TheJointsOfTheFileAreKept)
{
  this->rig(scene());
  GltfAsset again;
  ASSERT_TRUE(again.read(this->context_, this->folder_ / "out.glb").ok());
  ASSERT_EQ(again.joints().size(), 2u);
  EXPECT_EQ(again.joints()[1].parent, 0);
  for (std::size_t j = 0; j < 2; ++j)
  {
    EXPECT_LT((again.joints()[j].rest.matrix() - two_joints()[j].rest.matrix()).norm(), 1e-5);
    EXPECT_GT(again.largest_weights()[static_cast<Index>(j)], 0.5);
  }
  // A handle has another frame than its joint, at the same position.
  GltfSkin skin = make_skin(again.joints(), 1.0 - weights_of(again.points()).array());
  skin.joints[1].rest.linear() = Eigen::AngleAxisd(1.0, Vec3::UnitY()).toRotationMatrix();
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();
  motion.linear() = Eigen::AngleAxisd(0.4, Vec3::UnitX()).toRotationMatrix();
  motion.translation() = Vec3(0.1, 0.2, 0.3);
  skin.frames.resize(2);
  skin.frames[0].posed = { skin.joints[0].rest, skin.joints[1].rest };
  skin.frames[1].posed = { skin.joints[0].rest, motion * skin.joints[1].rest };
  const Status status = again.set_skin(this->context_, skin, 0);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(status.report.text("kept_joints"), "yes");
  EXPECT_TRUE(status.warnings.empty());
  EXPECT_LT(status.report.number("animation_error", 1), 1e-6);
  ASSERT_TRUE(again.write(this->folder_ / "again.glb", true).ok());
  const File before(this->folder_ / "out.glb"), after(this->folder_ / "again.glb");
  EXPECT_EQ(after.json["scenes"], before.json["scenes"]);
  EXPECT_EQ(after.json["nodes"].size(), before.json["nodes"].size());
  const int tip = 6;
  EXPECT_EQ(after.json["nodes"][tip], before.json["nodes"][tip]);
  // The meshes follow the node of the joint by the new weights.
  const Eigen::Affine3d local = two_joints()[1].rest.inverse() * motion * two_joints()[1].rest;
  const Points posed = after.skinned(3, 0, tip, local);
  for (Index v = 0; v < posed.rows(); ++v)
  {
    const Vec3 p = again.points().row(16 + v);
    const Vec3 expected = p + skin.weights(16 + v, 1) * (motion * p - p);
    EXPECT_LT((posed.row(v).transpose() - expected).norm(), 1e-5);
  }
  // The animation has this pose in its second frame.
  GltfSkin read;
  ASSERT_TRUE(read_gltf_skin(this->context_, this->folder_ / "again.glb", read).ok());
  ASSERT_EQ(read.frames.size(), 2u);
  EXPECT_LT(
    (read.frames[1].posed[1].matrix() - (motion * two_joints()[1].rest).matrix()).norm(), 1e-5);
}

TEST_F(GltfAssets, JointsAtOtherPositionsAreReplaced)
{
  GltfDocument document = scene();
  this->rig(document);
  GltfAsset again;
  ASSERT_TRUE(again.read(this->context_, this->folder_ / "out.glb").ok());
  GltfSkin skin = make_skin(again.joints(), weights_of(again.points()));
  skin.joints[1].rest.translation()[2] += 0.1;
  const Status status = again.set_skin(this->context_, skin, 0);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(status.report.text("kept_joints"), "no");
}

TEST_F(GltfAssets, JointsBelowOtherNodesAreKept)
{
  // The nodes "armature" and "between" are no joints. All of them are rotated or scaled.
  GltfDocument document;
  const TriangleMesh cube = test::cube();
  std::vector<std::uint16_t> corners(
    cube.triangles.data(), cube.triangles.data() + cube.triangles.size());
  const int ids = document.append_accessor(
    std::vector<std::uint8_t>(static_cast<std::size_t>(4 * cube.points.rows()), 0), 4,
    GltfDocument::array_buffer);
  std::vector<float> ones;
  for (Index v = 0; v < cube.points.rows(); ++v)
  {
    ones.insert(ones.end(), { 1, 0, 0, 0 });
  }
  document.append("meshes",
    { { "primitives",
      Json::array({ Json{
        { "attributes",
          { { "POSITION", document.append_rows(cube.points) }, { "JOINTS_0", ids },
            { "WEIGHTS_0", document.append_accessor(ones, 4, GltfDocument::array_buffer) } } },
        { "indices",
          document.append_accessor(corners, 1, GltfDocument::element_array_buffer) } } }) } });
  document.append("nodes", { { "name", "mesh" }, { "mesh", 0 }, { "skin", 0 } });
  document.append("nodes",
    { { "name", "armature" }, { "children", { 2 } }, { "scale", { 0.01, 0.01, 0.01 } },
      { "rotation", { 0, 0.6, 0, 0.8 } } });
  document.append(
    "nodes", { { "name", "root" }, { "children", { 3 } }, { "translation", { 50, 0, 0 } } });
  document.append(
    "nodes", { { "name", "between" }, { "children", { 4 } }, { "rotation", { 0, 0, 0.6, 0.8 } } });
  document.append("nodes", { { "name", "tip" }, { "translation", { 0, 80, 0 } } });
  document.append("scenes", { { "nodes", { 0, 1 } } });
  const std::vector<int> joint_nodes{ 2, 4 };
  const GltfDocument::Json json = document.json();
  // The inverse bind matrices put the mesh into the bind pose, three times as large.
  Eigen::Affine3d armature = Eigen::Affine3d::Identity();
  armature.rotate(Eigen::Quaterniond(0.8, 0, 0.6, 0)).scale(0.01);
  const Eigen::Affine3d root = armature * Eigen::Translation3d(50, 0, 0);
  const Eigen::Affine3d tip =
    root * Eigen::Quaterniond(0.8, 0, 0, 0.6) * Eigen::Translation3d(0, 80, 0);
  Eigen::Affine3d size = Eigen::Affine3d::Identity();
  size.scale(3.0);
  std::vector<float> binds;
  for (const Eigen::Affine3d& joint : { root, tip })
  {
    const Eigen::Matrix4d bind = (joint.inverse() * size).matrix();
    binds.insert(binds.end(), bind.data(), bind.data() + 16);
  }
  document.append("skins",
    { { "joints", joint_nodes },
      { "inverseBindMatrices", document.append_accessor(binds, 16, 0) } });
  document.json()["scene"] = 0;
  animate(document, 4);
  Status status = this->asset_.read(this->context_, this->write(document));
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_TRUE(status.warnings.empty());
  EXPECT_LT((this->asset_.points() - 3.0 * cube.points).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_LT((this->asset_.joints()[1].rest.matrix() - tip.matrix()).norm(), 1e-5);
  GltfSkin skin = make_skin(this->asset_.joints(), weights_of(this->asset_.points()));
  skin.frames.resize(2);
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();
  motion.rotate(Eigen::AngleAxisd(0.5, Vec3(1, 1, 0).normalized())).translate(Vec3(0.2, 0, 0));
  skin.frames[0].posed = { root, tip };
  skin.frames[1].posed = { motion * root, motion * motion * tip };
  status = this->asset_.set_skin(this->context_, skin, 0);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(status.report.text("kept_joints"), "yes");
  EXPECT_LT(status.report.number("pose_error", 1), 1e-6);
  EXPECT_LT(status.report.number("animation_error", 1), 1e-6);
  ASSERT_TRUE(this->asset_.write(this->folder_ / "out.glb", true).ok());
  const File file(this->folder_ / "out.glb");
  EXPECT_EQ(file.json["nodes"].size(), json["nodes"].size());
  EXPECT_EQ(file.json["animations"].size(), 2u);
  EXPECT_LT((file.skinned(0, 0, -1, motion) - this->asset_.points()).cwiseAbs().maxCoeff(), 1e-5);
  // The new animation is evaluated by the reader, without the old one.
  GltfDocument only = document;
  only.json().erase("animations");
  GltfAsset fresh;
  ASSERT_TRUE(fresh.read(this->context_, this->write(only)).ok());
  skin.joints = fresh.joints();
  ASSERT_TRUE(fresh.set_skin(this->context_, skin, 0).ok());
  ASSERT_TRUE(fresh.write(this->folder_ / "fresh.glb", true).ok());
  GltfSkin read;
  ASSERT_TRUE(read_gltf_skin(this->context_, this->folder_ / "fresh.glb", read).ok());
  ASSERT_EQ(read.frames.size(), 2u);
  EXPECT_LT((read.frames[1].posed[0].matrix() - (motion * root).matrix()).norm(), 1e-5);
  EXPECT_LT((read.frames[1].posed[1].matrix() - (motion * motion * tip).matrix()).norm(), 1e-5);
}

TEST_F(GltfAssets, ACancelWhileFramesAreAddedIsReported)
{
  ASSERT_TRUE(this->asset_.read(this->context_, this->write(scene())).ok());
  GltfSkin skin = make_skin(two_joints(), weights_of(this->asset_.points()));
  skin.frames.resize(1);
  skin.frames[0].posed = { skin.joints[0].rest, skin.joints[1].rest };
  this->context_.request_cancel();
  EXPECT_EQ(this->asset_.set_skin(this->context_, skin, 0).code, StatusCode::canceled);
}

TEST_F(GltfAssets, AnOldSkinIsReplaced)
{
  this->rig(scene());
  GltfAsset again;
  Status status = again.read(this->context_, this->folder_ / "out.glb");
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_TRUE(status.warnings.empty());
  EXPECT_LT((again.points() - this->asset_.points()).cwiseAbs().maxCoeff(), 1e-5);
  std::vector<GltfJoint> one(1);
  one[0].name = "only";
  status =
    again.set_skin(this->context_, make_skin(one, Weights::Ones(again.points().rows(), 1)), 0);
  ASSERT_TRUE(status.ok()) << status.message;
  ASSERT_TRUE(again.write(this->folder_ / "again.glb", true).ok());
  const File file(this->folder_ / "again.glb");
  for (const tinygltf::Skin& skin : file.model.skins)
  {
    EXPECT_EQ(skin.joints.size(), 1u);
  }
  for (const auto& mesh : file.model.meshes)
  {
    for (const auto& primitive : mesh.primitives)
    {
      EXPECT_EQ(primitive.attributes.count("JOINTS_0"), 1u);
    }
  }
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();
  EXPECT_LT(
    (file.skinned(2, 0, -1, motion) - again.points().middleRows(8, 8)).cwiseAbs().maxCoeff(), 1e-5);
}

TEST_F(GltfAssets, BuffersAndPicturesInFilesAreStoredInTheFile)
{
  const GltfDocument document = scene();
  const std::string glb = this->write(document);
  const File file(glb);
  Json json = file.json;
  const auto& bytes = file.model.buffers.at(0).data;
  this->folder_.write("data one.bin", "abc");
  this->folder_.write("data.bin", std::string(bytes.begin(), bytes.end()));
  this->folder_.write("picture.png", picture);
  json["buffers"] = Json::array({ Json{ { "uri", "data%20one.bin" }, { "byteLength", 3 } },
    Json{ { "uri", "data.bin" }, { "byteLength", bytes.size() } } });
  for (Json& view : json["bufferViews"])
  {
    view["buffer"] = 1;
  }
  json["images"] = Json::array(
    { Json{ { "uri", "picture.png" }, { "name", "kept" } }, Json{ { "uri", "missing.png" } } });
  const std::string path = this->folder_.write("in.gltf", json.dump());
  Status status = this->asset_.read(this->context_, path);
  ASSERT_TRUE(status.ok()) << status.message;
  ASSERT_EQ(status.warnings.size(), 1u);
  EXPECT_THAT(status.warnings[0], HasSubstr("the image 'missing.png' is not stored"));
  ASSERT_TRUE(this->asset_.write(this->folder_ / "all.glb", true).ok());
  const File all(this->folder_ / "all.glb");
  ASSERT_EQ(all.model.buffers.size(), 1u);
  EXPECT_EQ(all.json["images"][0]["name"], "kept");
  const auto& view =
    all.model.bufferViews.at(all.json["images"][0]["bufferView"].get<std::size_t>());
  const auto& joined = all.model.buffers[0].data;
  EXPECT_EQ(std::string(joined.begin() + static_cast<std::ptrdiff_t>(view.byteOffset),
              joined.begin() + static_cast<std::ptrdiff_t>(view.byteOffset + view.byteLength)),
    picture);
  GltfAsset from_glb;
  ASSERT_TRUE(from_glb.read(this->context_, this->folder_ / "all.glb").ok());
  EXPECT_EQ(from_glb.points(), this->asset_.points());
  // as .gltf with everything inside
  ASSERT_TRUE(this->asset_.write(this->folder_ / "all.gltf", false).ok());
  ASSERT_TRUE(from_glb.read(this->context_, this->folder_ / "all.gltf").ok());
  EXPECT_EQ(from_glb.points(), this->asset_.points());
}

TEST_F(GltfAssets, MeshesOfConvertedFilesMoveToRootNodes)
{
  std::string bytes;
  ASSERT_TRUE(scene().to_bytes(true, bytes).ok());
  ASSERT_TRUE(this->asset_.read_bytes("in.fbx", bytes).ok());
  const Points points = this->asset_.points();
  ASSERT_TRUE(
    this->asset_.set_skin(this->context_, make_skin(two_joints(), weights_of(points)), 4).ok());
  ASSERT_TRUE(this->asset_.write(this->folder_ / "out.glb", true).ok());
  const File file(this->folder_ / "out.glb");
  Index first = 0;
  for (std::size_t id = 0; id < file.json["nodes"].size(); ++id)
  {
    const Json& node = file.json["nodes"][id];
    if (!node.contains("mesh"))
    {
      continue;
    }
    EXPECT_TRUE(node.contains("skin"));
    for (const char* property : { "translation", "rotation", "scale", "children", "camera" })
    {
      EXPECT_FALSE(node.contains(property)) << property;
    }
    const Json& roots = file.json["scenes"][0]["nodes"];
    EXPECT_EQ(std::count(roots.begin(), roots.end(), Json(id)), 1);
    const Points rest = file.skinned(static_cast<int>(id), 0, -1, Eigen::Affine3d::Identity());
    EXPECT_LT((rest - points.middleRows(first, rest.rows())).cwiseAbs().maxCoeff(), 1e-6);
    first += rest.rows();
  }
  EXPECT_EQ(first, 8 + 8 + 4);
  // A node that only has the mesh moves; a node with a camera stays.
  EXPECT_EQ(file.json["nodes"][2]["name"], "copy");
  EXPECT_TRUE(file.json["nodes"][2].contains("mesh"));
  EXPECT_EQ(file.json["nodes"][1]["children"], Json({ 3 }));
  EXPECT_FALSE(file.json["nodes"][3].contains("mesh"));
  EXPECT_EQ(file.json["nodes"][3]["camera"], 0);
}

TEST_F(GltfAssets, PicturesOutsideTheFolderAreRefused)
{
  const test::Folder other;
  other.write("secret.png", picture);
  Json json = File(this->write(scene())).json;
  json["images"][0] = Json{ { "uri",
    "../" + std::filesystem::path(other.path()).filename().string() + "/secret.png" } };
  json.erase("textures");
  GltfDocument document = scene();
  document.json()["images"] = json["images"];
  const Status status = this->asset_.read(this->context_, this->write(document));
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  EXPECT_THAT(status.message, HasSubstr("is not in the folder of the file"));
}

TEST_F(GltfAssets, FurtherChunksAreKept)
{
  std::string content;
  {
    std::ifstream stream(this->write(scene()), std::ios::binary);
    content.assign(std::istreambuf_iterator<char>(stream), {});
  }
  const std::string chunk("\x04\0\0\0XTRAdata", 12);
  content += chunk;
  const auto size = static_cast<std::uint32_t>(content.size());
  std::memcpy(content.data() + 8, &size, sizeof(size));
  ASSERT_TRUE(this->asset_.read(this->context_, this->folder_.write("more.glb", content)).ok());
  ASSERT_TRUE(this->asset_.write(this->folder_ / "out.glb", true).ok());
  const std::string written = this->folder_.read("out.glb");
  EXPECT_EQ(written.substr(written.size() - 12), chunk);
}

TEST_F(GltfAssets, WrongInputIsNamed)
{
  GltfDocument empty;
  empty.append("nodes", { { "name", "nothing" } });
  Status status = this->asset_.read(this->context_, this->write(empty));
  EXPECT_THAT(status.message, HasSubstr("the default scene contains no triangles"));
  status = this->asset_.read(this->context_, this->folder_ / "missing.glb");
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  ASSERT_TRUE(this->asset_.read(this->context_, this->write(scene())).ok());
  status = this->asset_.set_skin(this->context_, make_skin(two_joints(), Weights::Ones(3, 2)), 0);
  EXPECT_EQ(status.message,
    "the weights have 3 rows and 2 columns; expected 24 rows and 2 columns, at least one");
  std::vector<GltfJoint> cyclic = two_joints();
  cyclic[0].parent = 1;
  status =
    this->asset_.set_skin(this->context_, make_skin(cyclic, weights_of(this->asset_.points())), 0);
  EXPECT_THAT(status.message, HasSubstr("cycle"));
}
