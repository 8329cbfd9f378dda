// Skins as glTF: round trips, files that other programs could write, and an error message of one
// sentence for each defect.
#include "gltf/gltf_skin.h"
#include "gltf/gltf_transform.h"

#include "support/files.h"
#include "support/meshes.h"
#include "support/sanitized.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <cstring>

using namespace bindpose;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

namespace
{
constexpr double float_step = 1.2e-7;

Eigen::Affine3d motion(const Vec3& axis, double degrees, const Vec3& to, double scale = 1.0)
{
  Eigen::Affine3d map = Eigen::Affine3d::Identity();
  map.linear() =
    scale * Eigen::AngleAxisd(degrees * 0.017453292519943295, axis.normalized()).toRotationMatrix();
  map.translation() = to;
  return map;
}

Status read_skin(const std::string& path, GltfSkin& skin)
{
  ExecutionContext context;
  return read_gltf_skin(context, path, skin);
}

/// Return a sphere with random weights on a chain of joints. Each joint precedes its parent.
GltfSkin example(int joints, double row_sum = 1.0)
{
  GltfSkin skin;
  const TriangleMesh mesh = test::sphere(2);
  skin.points = mesh.points;
  skin.triangles = mesh.triangles;
  skin.normals = mesh.points;
  skin.texture = mesh.points.leftCols<2>();
  skin.colors.setConstant(mesh.points.rows(), 4, 200);
  skin.colors.col(1).setConstant(7);
  test::Random random(5);
  for (int j = 0; j < joints; ++j)
  {
    GltfJoint joint;
    joint.name = "joint é " + std::to_string(j);
    joint.parent = j + 1 < joints ? j + 1 : -1;
    joint.rest = motion(Vec3(1, 2, 3), 20.0 * j, Vec3(0.1 * j, 0.3, -0.2 * j));
    joint.posed = joint.rest;
    skin.joints.push_back(joint);
  }
  skin.weights.resize(mesh.points.rows(), joints);
  for (Index v = 0; v < skin.weights.rows(); ++v)
  {
    for (Index j = 0; j < joints; ++j)
    {
      skin.weights(v, j) = random.uniform(0.05, 1.0);
    }
    skin.weights.row(v) *= row_sum / skin.weights.row(v).sum();
  }
  return skin;
}

double largest(const Eigen::MatrixXd& difference)
{
  return difference.cwiseAbs().maxCoeff();
}

double difference_of_affines(const Eigen::Affine3d& a, const Eigen::Affine3d& b)
{
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

/// Return the vertices after linear blend skinning.
Points skinned(const GltfSkin& skin, const std::vector<Eigen::Affine3d>& posed)
{
  Points result = skin.points;
  for (Index v = 0; v < result.rows(); ++v)
  {
    const Vec3 p = skin.points.row(v);
    Vec3 moved = p;
    for (std::size_t j = 0; j < skin.joints.size(); ++j)
    {
      moved +=
        skin.weights(v, static_cast<Index>(j)) * (posed[j] * skin.joints[j].rest.inverse() * p - p);
    }
    result.row(v) = moved.transpose();
  }
  return result;
}

json json_of(const std::string& glb)
{
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, 4);
  return json::parse(glb.substr(20, length));
}

/// Return a small file in the style of another program: a triangle on two joints, as JSON with the
/// binary data in base64.
json foreign()
{
  return json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
"nodes": [{"mesh": 0, "skin": 0, "translation": [9, 9, 9]},
 {"name": "root", "children": [2], "scale": [2, 2, 2]},
 {"name": "arm", "translation": [0, 1, 0], "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476]}],
"skins": [{"joints": [1, 2]}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]}],
"buffers": [{"byteLength": 60,
 "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAEAAAAB//8AAQAA/wAAAEBAAACAgAAA"}],
"bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36},
 {"buffer": 0, "byteOffset": 36, "byteLength": 12}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
 {"bufferView": 1, "componentType": 5121, "count": 3, "type": "VEC4"},
 {"bufferView": 2, "componentType": 5121, "count": 3, "type": "VEC4", "normalized": true}]})");
}
} // namespace

TEST(GltfTransform, AMapWithoutShearInItsAxesIsKept)
{
  test::Random random(3);
  for (int round = 0; round < 100; ++round)
  {
    Trs trs;
    trs.translation = random.in_box(Vec3::Constant(-5), Vec3::Constant(5));
    trs.rotation = Eigen::AngleAxisd(
      random.uniform(-3, 3), random.in_box(Vec3::Constant(-1), Vec3::Ones()).normalized());
    trs.scale = random.in_box(Vec3::Constant(0.1), Vec3::Constant(3));
    if (round % 2)
    {
      trs.scale *= -1.0;
    }
    EXPECT_LT(difference_of_affines(nearest_trs(trs.affine()).affine(), trs.affine()), 1e-13);
  }
  // A mirror image equals a rotation by 180 degrees combined with a point reflection (scale -1).
  Eigen::Affine3d mirror = Eigen::Affine3d::Identity();
  mirror(0, 0) = -1.0;
  EXPECT_LT(difference_of_affines(nearest_trs(mirror).affine(), mirror), 1e-13);
}

TEST(GltfTransform, AShearGivesTheNearestRotation)
{
  Eigen::Affine3d shear = Eigen::Affine3d::Identity();
  shear(0, 1) = 0.4;
  const Eigen::Matrix3d held = nearest_trs(shear).affine().linear();
  const double error = (held - shear.linear()).norm();
  EXPECT_GT(error, 0.1);
  // No rotation about the z axis is closer to the shear than the computed rotation.
  for (double turn = -0.5; turn < 0.5; turn += 0.01)
  {
    const Eigen::Matrix3d r = Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix();
    EXPECT_GE((r - shear.linear()).norm(),
      (nearest_trs(shear).rotation.toRotationMatrix() - shear.linear()).norm() - 1e-12);
  }
  EXPECT_TRUE(nearest_trs(Eigen::Affine3d(Eigen::Scaling(0.0))).affine().matrix().allFinite());
}

TEST(GltfSkin, WhatIsWrittenComesBack)
{
  const test::Folder folder;
  for (const bool binary : { true, false })
  {
    GltfSkin skin = example(7);
    skin.name = "ball";
    skin.joints[2].handle_extras = GltfHandleExtras{ "cage_vertex", Vec3(0.1, 0.2, 0.3),
      Vec3(1, 2, 3), 4, { { 2, 1, -1 }, { 2, 0, 1 } } };
    GltfOptions options;
    options.binary = binary;
    Status status = write_gltf_skin(folder / "rig.gltf", skin, options);
    ASSERT_TRUE(status.ok()) << status.message;
    EXPECT_EQ(status.report.number("sets", 0), 2);
    EXPECT_EQ(
      status.report.number("file_bytes", 0), std::filesystem::file_size(folder / "rig.gltf"));
    EXPECT_EQ(status.report.text("rest_joint"), "no");
    EXPECT_LT(status.report.number("pose_error", 1), 1e-7);
    EXPECT_TRUE(status.warnings.empty());
    GltfSkin reread;
    status = read_skin(folder / "rig.gltf", reread);
    ASSERT_TRUE(status.ok()) << status.message;
    EXPECT_TRUE(status.warnings.empty());
    EXPECT_EQ(reread.name, "ball");
    EXPECT_LT(largest(reread.points - skin.points), float_step);
    EXPECT_LT(largest(reread.normals - skin.normals), float_step);
    EXPECT_LT(largest(reread.texture - skin.texture), float_step);
    EXPECT_EQ(reread.colors, skin.colors);
    EXPECT_EQ(reread.triangles, skin.triangles);
    ASSERT_EQ(reread.joints.size(), skin.joints.size());
    EXPECT_LT(largest(reread.weights - skin.weights), float_step);
    for (std::size_t j = 0; j < skin.joints.size(); ++j)
    {
      EXPECT_EQ(reread.joints[j].name, skin.joints[j].name);
      EXPECT_EQ(reread.joints[j].parent, skin.joints[j].parent);
      EXPECT_LT(difference_of_affines(reread.joints[j].rest, skin.joints[j].rest), 1e-6);
      EXPECT_LT(difference_of_affines(reread.joints[j].posed, skin.joints[j].rest), 1e-12);
    }
    ASSERT_TRUE(reread.joints[2].handle_extras);
    EXPECT_EQ(reread.joints[2].handle_extras->kind, "cage_vertex");
    EXPECT_EQ(reread.joints[2].handle_extras->head, Vec3(0.1, 0.2, 0.3));
    EXPECT_EQ(reread.joints[2].handle_extras->region, 4);
    EXPECT_EQ(reread.joints[2].handle_extras->cage, skin.joints[2].handle_extras->cage);
  }
}

TEST(GltfSkin, RowsInTheFileSumToOne)
{
  const test::Folder folder;
  GltfSkin skin = example(6, 0.75);
  skin.weights.row(0).setZero();
  Status status = write_gltf_skin(folder / "rig.glb", skin);
  ASSERT_TRUE(status.ok());
  EXPECT_EQ(status.report.text("rest_joint"), "yes");
  const json written = json_of(folder.read("rig.glb"));
  // The skin in the file has an additional joint that stays at rest.
  EXPECT_EQ(written["skins"][0]["joints"].size(), 7u);
  // Compute the sum of the weights of each vertex from the bytes of the file.
  const std::string glb = folder.read("rig.glb");
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, 4);
  const auto& attributes = written["meshes"][0]["primitives"][0]["attributes"];
  std::vector<double> sums(static_cast<std::size_t>(skin.points.rows()), 0.0);
  for (const std::string set : { "0", "1" })
  {
    const auto& accessor = written["accessors"][attributes["WEIGHTS_" + set].get<int>()];
    const auto& view = written["bufferViews"][accessor["bufferView"].get<int>()];
    for (std::size_t k = 0; k < 4 * sums.size(); ++k)
    {
      float weight;
      std::memcpy(
        &weight, glb.data() + 28 + length + view.value("byteOffset", 0) + 4 * k, sizeof(weight));
      EXPECT_GE(weight, 0.0F);
      sums[k / 4] += weight;
    }
  }
  for (const double sum : sums)
  {
    EXPECT_NEAR(sum, 1.0, float_step);
  }
  // Reading removes the additional joint. The weights of the original joints are unchanged, so rows
  // sum to less than 1 again.
  GltfSkin reread;
  ASSERT_TRUE(read_skin(folder / "rig.glb", reread).ok());
  ASSERT_EQ(reread.joints.size(), 6u);
  EXPECT_LT(largest(reread.weights - skin.weights), float_step);
}

TEST(GltfSkin, TheLargestWeightsAndWhatThatCosts)
{
  const test::Folder folder;
  GltfSkin skin = example(9);
  for (std::size_t j = 0; j < skin.joints.size(); ++j)
  {
    skin.joints[j].posed =
      motion(Vec3(3, 2, 1), 15.0 * static_cast<double>(j), Vec3(1, 0.2, 0)) * skin.joints[j].rest;
  }
  GltfOptions options;
  options.influences = 4;
  Status status = write_gltf_skin(folder / "four.glb", skin, options);
  ASSERT_TRUE(status.ok());
  EXPECT_EQ(status.report.number("sets", 0), 1);
  EXPECT_EQ(status.report.number("counts.dropped_weights", 0), 5.0 * skin.points.rows());
  GltfSkin reread;
  ASSERT_TRUE(read_skin(folder / "four.glb", reread).ok());
  double dropped_sum = 0.0;
  std::vector<Eigen::Affine3d> posed;
  for (Index v = 0; v < skin.points.rows(); ++v)
  {
    Eigen::VectorXd row = skin.weights.row(v).transpose();
    std::sort(row.data(), row.data() + row.size());
    dropped_sum = std::max(dropped_sum, row.head(5).sum());
    EXPECT_EQ((reread.weights.row(v).array() > 0.0).count(), 4);
  }
  for (const GltfJoint& joint : skin.joints)
  {
    posed.push_back(joint.posed);
  }
  EXPECT_NEAR(status.report.number("dropped_share", 0), dropped_sum, 1e-12);
  // The reported error is the largest displacement of a posed point due to the dropped weights, in
  // bounding-box diagonals.
  GltfSkin cut = skin;
  cut.weights = reread.weights;
  const double error = (skinned(cut, posed) - skinned(skin, posed)).rowwise().norm().maxCoeff() /
    bounding_box(skin.points).diagonal();
  EXPECT_GT(error, 0.001);
  EXPECT_NEAR(status.report.number("pose_error", 0), error, 1e-6);
  status = write_gltf_skin(folder / "all.glb", skin);
  EXPECT_LT(status.report.number("pose_error", 1), 1e-6);
}

TEST(GltfSkin, NegativeWeightsAreTold)
{
  const test::Folder folder;
  GltfSkin skin = example(3);
  skin.weights.row(5) << -0.25, 0.5, 0.75;
  skin.weights.row(6) << 0.5, 0.5, 1.0;
  const Status status = write_gltf_skin(folder / "rig.glb", skin);
  ASSERT_TRUE(status.ok());
  ASSERT_EQ(status.warnings.size(), 1u);
  EXPECT_THAT(status.warnings[0], HasSubstr("2 vertices"));
  GltfSkin reread;
  ASSERT_TRUE(read_skin(folder / "rig.glb", reread).ok());
  EXPECT_LT(largest(reread.weights.row(6) - Eigen::RowVector3d(0.25, 0.25, 0.5)), float_step);
  EXPECT_LT(largest(reread.weights.row(5) - Eigen::RowVector3d(0, 0.4, 0.6)), float_step);
}

TEST(GltfSkin, AnAnimationOfJoints)
{
  const test::Folder folder;
  GltfSkin skin = example(5);
  skin.frames_per_second = 30.0;
  for (int k = 0; k < 7; ++k)
  {
    GltfFrame frame;
    for (std::size_t j = 0; j < skin.joints.size(); ++j)
    {
      const double turn = 40.0 * k * (j == 2 ? 1.0 : -0.5);
      frame.posed.push_back(
        motion(Vec3(1, 1, 0), turn, Vec3(0.1 * k, 0, 0), 1.0 + 0.1 * k) * skin.joints[j].rest);
    }
    skin.frames.push_back(frame);
  }
  Status status = write_gltf_skin(folder / "rig.glb", skin);
  ASSERT_TRUE(status.ok()) << status.message;
  // Rotations and uniform scalings are exact.
  EXPECT_LT(status.report.number("animation_error", 1), 1e-6);
  GltfSkin reread;
  status = read_skin(folder / "rig.glb", reread);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(reread.frames_per_second, 30.0);
  ASSERT_EQ(reread.frames.size(), 7u);
  for (std::size_t k = 0; k < 7; ++k)
  {
    for (std::size_t j = 0; j < skin.joints.size(); ++j)
    {
      EXPECT_LT(difference_of_affines(reread.frames[k].posed[j], skin.frames[k].posed[j]), 3e-6);
    }
  }
  // Shears are not exact, and the report contains their error.
  skin.frames[3].posed[4].linear() *= (Eigen::Matrix3d() << 1, 0.8, 0, 0, 1, 0, 0, 0, 1).finished();
  status = write_gltf_skin(folder / "sheared.glb", skin);
  ASSERT_TRUE(read_skin(folder / "sheared.glb", reread).ok());
  const double error =
    (skinned(reread, reread.frames[3].posed) - skinned(skin, skin.frames[3].posed))
      .rowwise()
      .norm()
      .maxCoeff() /
    bounding_box(skin.points).diagonal();
  EXPECT_GT(error, 0.01);
  EXPECT_NEAR(status.report.number("animation_error", 0), error, 1e-5);
}

TEST(GltfSkin, AnAnimationOfShapes)
{
  const test::Folder folder;
  GltfSkin skin = example(3);
  for (int k = 0; k < 3; ++k)
  {
    GltfFrame frame;
    frame.points = skin.points * (1.0 + 0.25 * k);
    frame.normals = skin.normals;
    skin.frames.push_back(frame);
  }
  GltfOptions options;
  options.animation = GltfAnimation::morph;
  const Status status = write_gltf_skin(folder / "rig.glb", skin, options);
  ASSERT_TRUE(status.ok()) << status.message;
  const std::string glb = folder.read("rig.glb");
  const json written = json_of(glb);
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, 4);
  const auto& primitive = written["meshes"][0]["primitives"][0];
  ASSERT_EQ(primitive["targets"].size(), 3u);
  const auto& accessor = written["accessors"][primitive["targets"][2]["POSITION"].get<int>()];
  const auto offset = written["bufferViews"][accessor["bufferView"].get<int>()]["byteOffset"];
  for (Index k = 0; k < skin.points.size(); ++k)
  {
    float moved;
    std::memcpy(&moved, glb.data() + 28 + length + offset.get<std::size_t>() + 4 * k, 4);
    ASSERT_NEAR(moved, 0.5 * skin.points.data()[k], float_step);
  }
  EXPECT_EQ(written["animations"][0]["channels"][0]["target"]["path"], "weights");
  GltfSkin reread;
  const Status read = read_skin(folder / "rig.glb", reread);
  ASSERT_TRUE(read.ok());
  ASSERT_EQ(read.warnings.size(), 1u);
  EXPECT_THAT(read.warnings[0], HasSubstr("does not keep 1 animation and 3 morph targets"));
  EXPECT_TRUE(reread.frames.empty());
  // An animation of morph targets does not need joints.
  skin.joints.clear();
  skin.weights.resize(0, 0);
  EXPECT_TRUE(write_gltf_skin(folder / "mesh.glb", skin, options).ok());
}

TEST(GltfSkin, OneWarningListsWhatIsNotKept)
{
  const test::Folder folder;
  GltfSkin skin = example(3);
  skin.frames.resize(2);
  for (GltfFrame& frame : skin.frames)
  {
    for (const GltfJoint& joint : skin.joints)
    {
      frame.posed.push_back(joint.rest);
    }
  }
  GltfOptions options;
  options.binary = false;
  ASSERT_TRUE(write_gltf_skin(folder / "own.gltf", skin, options).ok());
  GltfSkin reread;
  EXPECT_TRUE(read_skin(folder / "own.gltf", reread).warnings.empty()) << "it is kept whole";

  json file = json::parse(folder.read("own.gltf"));
  file["animations"][0]["name"] = "Walk";
  for (int copy = 1; copy < 40; ++copy)
  {
    file["animations"].push_back(file["animations"][0]);
  }
  file["materials"] = json::parse(R"([{"name": "cloth"}, {"name": "skin"}])");
  file["images"] = json::parse(R"([{"uri": "cloth.png"}])");
  file["textures"] = json::parse(R"([{"source": 0}])");
  file["cameras"] = json::parse(R"([{"type": "perspective",
    "perspective": {"yfov": 0.8, "znear": 0.1}}])");
  file["meshes"].push_back(file["meshes"][0]);
  file["meshes"][1]["primitives"][0]["attributes"].erase("NORMAL");
  file["nodes"].push_back({ { "mesh", 1 }, { "skin", 0 } });
  const Status status = read_skin(folder.write("character.gltf", file.dump()), reread);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(reread.frames.size(), 2u);
  ASSERT_EQ(status.warnings.size(), 1u);
  for (const char* lost :
    { "character.gltf", "39 of 40 animations ('Walk' is kept)", "2 materials", "1 texture,",
      "1 camera", "division into 2 meshes", "normals, which only some meshes have" })
  {
    EXPECT_THAT(status.warnings[0], HasSubstr(lost));
  }
  EXPECT_THAT(status.warnings[0], Not(HasSubstr("morph")));
  const Report::Value* listed = status.report.find("not_kept[]");
  ASSERT_NE(listed, nullptr);
  EXPECT_EQ(std::get<std::vector<std::string>>(*listed).size(), 6u);
}

TEST(GltfSkin, AFileOfAnotherProgram)
{
  const test::Folder folder;
  GltfSkin skin;
  json file = foreign();
  Status status = read_skin(folder.write("f.gltf", file.dump()), skin);
  ASSERT_TRUE(status.ok()) << status.message;
  ASSERT_EQ(skin.joints.size(), 2u);
  EXPECT_EQ(skin.joints[1].name, "arm");
  EXPECT_EQ(skin.joints[1].parent, 0);
  // The transform of a skinned mesh's node is ignored, and the transforms of the joints' nodes are
  // multiplied along the chain.
  EXPECT_EQ(Vec3(skin.points.row(1)), Vec3(1, 0, 0));
  EXPECT_LT((skin.joints[1].posed * Vec3(1, 0, 0) - Vec3(0, 4, 0)).norm(), 1e-12);
  EXPECT_EQ(skin.joints[1].rest.matrix(), Eigen::Matrix4d::Identity());
  // The raw weights are 64 and 64 of 255; rows are normalized to the sum 1.
  EXPECT_NEAR(skin.weights(1, 0), 0.5, 1e-12);
  // In a triangle strip of three triangles, the second one has the opposite orientation.
  file["nodes"][0].erase("skin");
  ASSERT_TRUE(read_skin(folder.write("f.gltf", file.dump()), skin).ok());
  // If a mesh has no skin, the transform of the mesh's node is applied to the points.
  EXPECT_EQ(Vec3(skin.points.row(0)), Vec3(9, 9, 9));
  EXPECT_TRUE(skin.joints.empty());
  // The binary data may be in a separate file.
  const std::string bytes = folder.read("f.gltf");
  file["buffers"][0]["uri"] = "no such.bin";
  status = read_skin(folder.write("f.gltf", file.dump()), skin);
  EXPECT_THAT(status.message, HasSubstr("no such.bin"));
}

TEST(GltfSkin, BuffersAreFilesBelowItsFolder)
{
  const test::Folder folder;
  std::filesystem::create_directories(folder / "rig/data");
  const std::string bytes(60, '\0');
  folder.write("outside.bin", bytes);
  folder.write("rig/data/inside.bin", bytes);
  std::filesystem::create_symlink(folder / "outside.bin", folder / "rig/link.bin");
  json file = foreign();
  GltfSkin skin;
  const auto read = [&](const std::string& uri)
  {
    file["buffers"][0]["uri"] = uri;
    return read_skin(folder.write("rig/f.gltf", file.dump()), skin);
  };
  const Status inside = read("data/inside.bin");
  EXPECT_TRUE(inside.ok()) << inside.message;
  for (const std::string& uri :
    { std::string("../outside.bin"), folder / "outside.bin", std::string("link.bin") })
  {
    const Status outside = read(uri);
    EXPECT_EQ(outside.code, StatusCode::invalid_input) << uri;
    EXPECT_THAT(outside.message, HasSubstr(uri));
  }
}

TEST(GltfSkin, ErrorsAreNamed)
{
  const test::Folder folder;
  GltfSkin skin;
  const auto error = [&](const std::function<void(json&)>& modify)
  {
    json file = foreign();
    modify(file);
    const Status status = read_skin(folder.write("f.gltf", file.dump()), skin);
    EXPECT_EQ(status.code, StatusCode::invalid_input);
    EXPECT_EQ(skin.points.rows(), 0);
    EXPECT_THAT(status.message, HasSubstr("f.gltf"));
    return status.message;
  };
  EXPECT_THAT(error([](json& f) { f["asset"]["version"] = "1.0"; }), HasSubstr("glTF 1.0"));
  EXPECT_THAT(error([](json& f) { f["accessors"][0]["count"] = 4; }), HasSubstr("beyond"));
  EXPECT_THAT(
    error([](json& f) { f["accessors"][0]["count"] = 4000000000LL; }), HasSubstr("4000000000"));
  EXPECT_THAT(error([](json& f) { f["accessors"][0]["type"] = "VEC2"; }), HasSubstr("POSITION"));
  EXPECT_THAT(error([](json& f) { f["accessors"][1]["componentType"] = 5126; }),
    HasSubstr("unsigned integers"));
  EXPECT_THAT(error([](json& f) { f["bufferViews"][0]["byteOffset"] = 48; }), HasSubstr("beyond"));
  EXPECT_THAT(error([](json& f) { f["bufferViews"][0]["buffer"] = 7; }), HasSubstr("buffer 7"));
  EXPECT_THAT(error([](json& f) { f["skins"][0]["joints"] = { 1 }; }), HasSubstr("joint 1"));
  EXPECT_THAT(error([](json& f) { f["skins"][0]["joints"] = { 1, 9 }; }), HasSubstr("node 9"));
  EXPECT_THAT(error([](json& f) { f["skins"][0]["joints"] = { 1, 1 }; }), HasSubstr("twice"));
  EXPECT_THAT(error([](json& f) { f["nodes"][2]["children"] = { 1 }; }), HasSubstr("cycle"));
  EXPECT_THAT(
    error([](json& f) { f["nodes"][0]["children"] = { 2 }; }), HasSubstr("more than one parent"));
  EXPECT_THAT(error(
                [](json& f) {
                  f["nodes"][2]["rotation"] = { 0, 0, 0, 0 };
                }),
    HasSubstr("rotation"));
  EXPECT_THAT(error(
                [](json& f) {
                  f["nodes"][2]["translation"] = { 0, 0 };
                }),
    HasSubstr("translation"));
  EXPECT_THAT(error([](json& f) { f["skins"][0]["inverseBindMatrices"] = 0; }),
    HasSubstr("inverse bind matrices"));
  EXPECT_THAT(
    error([](json& f) { f["meshes"][0]["primitives"][0]["mode"] = 1; }), HasSubstr("no triangle"));
  EXPECT_THAT(error([](json& f) { f["extensionsRequired"] = { "EXT_mesh_gpu_instancing" }; }),
    HasSubstr("EXT_mesh_gpu_instancing is not supported"));
  json deep = "x";
  // With sanitizers, deeper nesting makes the JSON writer of this test overflow the stack.
  for (int k = 0; k < (test::sanitized ? 500 : 5000); ++k)
  {
    deep = json::array({ deep });
  }
  EXPECT_THAT(error([&](json& f) { f["extras"] = deep; }), HasSubstr("nested"));
  EXPECT_THAT(read_skin(folder.write("f.glb", "glTF"), skin).message, HasSubstr("f.glb"));
  EXPECT_THAT(read_skin(folder / "none.glb", skin).message, HasSubstr("none.glb"));
}

TEST(GltfSkin, ACancelLeavesNoFile)
{
  const test::Folder folder;
  GltfSkin skin = example(3);
  skin.frames.resize(50);
  for (GltfFrame& frame : skin.frames)
  {
    frame.posed.assign(3, Eigen::Affine3d::Identity());
  }
  int cancel_checks = 0;
  ExecutionContext context({}, [&cancel_checks] { return ++cancel_checks > 10; });
  const Status status = write_gltf_skin(context, folder / "rig.glb", skin, GltfOptions());
  EXPECT_EQ(status.code, StatusCode::canceled);
  EXPECT_EQ(folder.number_of_files(), 0u);
  EXPECT_LT(cancel_checks, 20);
}

TEST(GltfSkin, WhatCannotBeWrittenIsTold)
{
  const test::Folder folder;
  const auto error = [&](const std::function<void(GltfSkin&)>& modify)
  {
    GltfSkin skin = example(3);
    modify(skin);
    const Status status = write_gltf_skin(folder / "rig.glb", skin);
    EXPECT_EQ(status.code, StatusCode::invalid_input);
    return status.message;
  };
  EXPECT_THAT(error([](GltfSkin& s) { s.points(3, 1) = NAN; }), HasSubstr("finite"));
  EXPECT_THAT(error([](GltfSkin& s) { s.points(3, 1) = 1e300; }), HasSubstr("y of point 3"));
  EXPECT_THAT(error([](GltfSkin& s) { s.weights(3, 1) = NAN; }), HasSubstr("float"));
  EXPECT_THAT(error([](GltfSkin& s) { s.triangles.resize(0, 3); }), HasSubstr("triangle"));
  EXPECT_THAT(error([](GltfSkin& s) { s.joints.pop_back(); }), HasSubstr("weights"));
  EXPECT_THAT(error([](GltfSkin& s) { s.joints[0].name = "\xff"; }), HasSubstr("UTF-8"));
  EXPECT_THAT(error([](GltfSkin& s) { s.joints[2].parent = 0; }), HasSubstr("cycle"));
  EXPECT_THAT(error([](GltfSkin& s) { s.frames.resize(1); }), HasSubstr("frame"));
}
