// Motions of glTF files: all nodes are joints, with or without meshes.
#include "gltf/gltf_motion.h"

#include "support/files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

using namespace bindpose;
using nlohmann::json;
using testing::HasSubstr;

namespace
{
/// Return a file with three nodes in a chain and no mesh; the second one is animated if `animated`.
json chain_of_nodes(bool animated)
{
  json file = { { "asset", { { "version", "2.0" } } }, { "scene", 0 },
    { "scenes", { { { "nodes", { 0 } } } } },
    { "nodes",
      { { { "name", "hips" }, { "children", { 1 } }, { "translation", { 0, 1, 0 } } },
        { { "name", "spine" }, { "children", { 2 } }, { "translation", { 0, 1, 0 } } },
        { { "name", "head" }, { "translation", { 0, 1, 0 } } } } } };
  if (animated)
  {
    // Two keys, at 0 and 1 s: the translation of the spine changes from (0, 1, 0) to (2, 1, 0).
    // These are the floats 0, 1, and 0, 1, 0, 2, 1, 0.
    file["buffers"] = { { { "byteLength", 32 },
      { "uri",
        "data:application/octet-stream;base64,AAAAAAAAgD8AAAAAAACAPwAAAAAAAABAAACAPwAAAAA=" } } };
    file["bufferViews"] = { { { "buffer", 0 }, { "byteOffset", 0 }, { "byteLength", 8 } },
      { { "buffer", 0 }, { "byteOffset", 8 }, { "byteLength", 24 } } };
    file["accessors"] = { { { "bufferView", 0 }, { "componentType", 5126 }, { "count", 2 },
                            { "type", "SCALAR" }, { "min", { 0 } }, { "max", { 1 } } },
      { { "bufferView", 1 }, { "componentType", 5126 }, { "count", 2 }, { "type", "VEC3" } } };
    file["animations"] = { { { "samplers", { { { "input", 0 }, { "output", 1 } } } },
      { "channels",
        { { { "sampler", 0 }, { "target", { { "node", 1 }, { "path", "translation" } } } } } } } };
  }
  return file;
}

Status read_motion(const std::string& path, GltfMotion& motion)
{
  ExecutionContext context;
  return read_gltf_motion(context, path, motion);
}
} // namespace

TEST(GltfMotion, NodesAreJoints)
{
  const test::Folder folder;
  GltfMotion motion;
  Status status = read_motion(folder.write("walk.gltf", chain_of_nodes(true).dump()), motion);
  ASSERT_TRUE(status.ok()) << status.message;
  ASSERT_EQ(motion.joints.size(), 3u);
  EXPECT_EQ(motion.joints[2].name, "head");
  EXPECT_EQ(motion.joints[2].parent, 1);
  EXPECT_EQ(motion.joints[2].rest.translation(), Vec3(0, 3, 0));
  ASSERT_EQ(motion.frames.size(), 2u);
  EXPECT_EQ(motion.frames_per_second, 1.0);
  EXPECT_EQ(motion.frames[0].posed[2].translation(), Vec3(0, 3, 0));
  EXPECT_EQ(motion.frames[1].posed[2].translation(), Vec3(2, 3, 0));
  EXPECT_EQ(motion.frames[1].posed[0].translation(), Vec3(0, 1, 0));
  EXPECT_EQ(motion.animations, 1);
  EXPECT_THAT(motion.animated, testing::ElementsAre(0, 1, 0));
  // Without an animation there are joints, but no frames.
  ASSERT_TRUE(read_motion(folder.write("still.gltf", chain_of_nodes(false).dump()), motion).ok());
  EXPECT_EQ(motion.joints.size(), 3u);
  EXPECT_TRUE(motion.frames.empty());
}

TEST(GltfMotion, NodesOfSizeZeroAreLeftOut)
{
  const test::Folder folder;
  json file = chain_of_nodes(false);
  file["nodes"][2]["scale"] = { 0, 0, 0 };
  GltfMotion motion;
  ASSERT_TRUE(read_motion(folder.write("still.gltf", file.dump()), motion).ok());
  EXPECT_EQ(motion.joints.size(), 2u);
  file = { { "asset", { { "version", "2.0" } } } };
  const Status status = read_motion(folder.write("empty.gltf", file.dump()), motion);
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  EXPECT_THAT(status.message, HasSubstr("no node with an invertible transform"));
}
