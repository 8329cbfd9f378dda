// Meshes with a look as glTF documents: vertices, materials and pictures.
#include "gltf_edit/gltf_asset.h"
#include "io/obj.h"
#include "look/look_document.h"
#include "look/mtl_materials.h"

#include "support/files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace bindpose;
using Json = GltfDocument::Json;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

namespace
{
const std::string png = std::string("\x89PNG\r\n\x1a\n", 8) + "not a real picture";

class LookDocuments : public testing::Test
{
protected:
  test::Folder folder_;
  GltfDocument document_;
  std::map<std::string, int> materials_;
  std::vector<std::string> warnings_;

  void add_materials(const std::string& text, const std::vector<std::string>& names)
  {
    append_mtl_materials(
      text, this->folder_.path(), names, this->document_, this->materials_, this->warnings_);
  }

  /// Add an OBJ file, whose faces are triangles, and return the asset of the document.
  GltfAsset add_scene(const std::string& text)
  {
    PolygonMesh mesh;
    MeshLook look;
    const Status status = read_obj(this->folder_.write("m.obj", text), mesh, look);
    EXPECT_TRUE(status.ok()) << status.message;
    LookTriangles triangles;
    triangles.corners.resize(mesh.polygon_count(), 3);
    for (Index f = 0; f < mesh.polygon_count(); ++f)
    {
      triangles.corners.row(f) << 3 * f, 3 * f + 1, 3 * f + 2;
      triangles.faces.push_back(f);
    }
    append_look_scene(mesh, look, triangles, this->materials_, this->document_);
    std::string bytes;
    EXPECT_TRUE(this->document_.to_bytes(true, bytes).ok());
    GltfAsset asset;
    const Status read = asset.read_bytes("m.obj", bytes);
    EXPECT_TRUE(read.ok()) << read.message;
    return asset;
  }

  /// Return the values of an attribute of a mesh, according to the bytes of the document.
  GltfNumbers attribute(int mesh, const char* name, int type) const
  {
    std::string bytes;
    EXPECT_TRUE(this->document_.to_bytes(true, bytes).ok());
    GltfBufferFiles files;
    const tinygltf::Model model = parse_gltf(bytes, files);
    const GltfAccessors accessors(model, bytes.size());
    return accessors.read(
      model.meshes.at(mesh).primitives.at(0).attributes.at(name), type, "attribute");
  }
};
} // namespace

TEST_F(LookDocuments, CornersWithDifferentLooksGetDifferentVertices)
{
  this->add_materials("newmtl red\nKd 1 0 0\n", { "red" });
  const GltfAsset asset = this->add_scene(
    "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0.5 0.25\nvn 0 0 3\nvn 0 2 0\n"
    "o front\nusemtl red\nf 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1\n" // a quad: four vertices
    "usemtl none\nf 1/1/1 2/2/1 3/4/1\n" // vertex 3 has other coordinates
    "o back\nf 1//1 3//1 2//2\n");
  EXPECT_EQ(asset.points().rows(), 5 + 3);
  EXPECT_EQ(asset.triangles().rows(), 4);
  const Json& json = this->document_.json();
  ASSERT_EQ(json["meshes"].size(), 2u);
  const Json& front = json["meshes"][0];
  EXPECT_EQ(front["name"], "front");
  ASSERT_EQ(front["primitives"].size(), 2u);
  EXPECT_EQ(front["primitives"][0]["attributes"], front["primitives"][1]["attributes"]);
  EXPECT_EQ(front["primitives"][0]["material"], 0);
  EXPECT_EQ(front["primitives"][1]["material"], 1);
  EXPECT_EQ(json["materials"][1]["name"], "default");
  EXPECT_FALSE(json["meshes"][1]["primitives"][0]["attributes"].contains("TEXCOORD_0"));
  const GltfNumbers texture = this->attribute(0, "TEXCOORD_0", TINYGLTF_TYPE_VEC2);
  EXPECT_EQ(texture.row(3), Eigen::RowVector2d(0.5, 0.75)); // the origin is at the upper left
  EXPECT_EQ(this->attribute(1, "NORMAL", TINYGLTF_TYPE_VEC3).row(2), Eigen::RowVector3d(0, 1, 0));
}

TEST_F(LookDocuments, PartsWithoutMaterialsGetASkin)
{
  GltfAsset asset = this->add_scene("v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nvn 0 0 1\n"
                                    "o a\nf 1//1 2//1 3//1\no b\nf 1//1 3//1 4//1\n"
                                    "o c\nf 1//1 2//1 4//1\n");
  GltfSkin skin;
  skin.joints.resize(1);
  skin.joints[0].name = "root";
  skin.weights = Weights::Ones(asset.points().rows(), 1);
  ExecutionContext context;
  const Status status = asset.set_skin(context, skin, 4);
  ASSERT_TRUE(status.ok()) << status.message;
  ASSERT_TRUE(asset.write(this->folder_ / "out.gltf", false).ok());
  const Json json = Json::parse(this->folder_.read("out.gltf"));
  for (int k = 0; k < 3; ++k)
  {
    EXPECT_EQ(json["nodes"][k]["skin"], 0);
    EXPECT_TRUE(json["meshes"][k]["primitives"][0]["attributes"].contains("WEIGHTS_0"));
  }
}

TEST_F(LookDocuments, TextureCoordinatesThatAreNoFloatsAreZero)
{
  this->add_scene("v 0 0 0\nv 2 0 0\nv 2 2 0\nvt 0.5 nan\nvt 1e300 0\nvt 0.5 0.25\n"
                  "f 1/1 2/2 3/3\n");
  const GltfNumbers texture = this->attribute(0, "TEXCOORD_0", TINYGLTF_TYPE_VEC2);
  EXPECT_EQ(texture, (GltfNumbers(3, 2) << 0, 0, 0, 0, 0.5, 0.75).finished());
}

TEST_F(LookDocuments, AMeshFarFromTheOriginKeepsItsDetail)
{
  const GltfAsset asset = this->add_scene(
    "v 1000000 2000000 0\nv 1000000.015625 2000000 0\nv 1000000 2000000.03125 0.001\nf 1 2 3\n");
  EXPECT_LT((asset.points().row(1) - asset.points().row(0) - Eigen::RowVector3d(0.015625, 0, 0))
              .cwiseAbs()
              .maxCoeff(),
    1e-9);
}

TEST_F(LookDocuments, VertexColorsAreLinear)
{
  this->add_scene("v 0 0 0 1 0.5 0\nv 1 0 0 0.02 0 2\nv 1 1 0 0 0 0\nf 1 2 3\n");
  const GltfNumbers colors = this->attribute(0, "COLOR_0", TINYGLTF_TYPE_VEC3);
  EXPECT_NEAR(colors(0, 0), 1.0, 1e-6);
  EXPECT_NEAR(colors(0, 1), 0.2140411, 1e-6); // sRGB's value of 0.5
  EXPECT_NEAR(colors(1, 0), 0.02 / 12.92, 1e-6);
  EXPECT_EQ(colors(1, 2), 1.0);
}

TEST_F(LookDocuments, MaterialsBecomeThoseOfGltf)
{
  this->folder_.write("wood.png", png);
  this->folder_.write("bark.png", png + "2");
  this->add_materials("newmtl wood\nKd 0 0 0\nNs 98\nmap_Kd -s 2 2 2 C:\\pictures\\wood.png\n"
                      "map_Bump bark.png\nd 0.5\n"
                      "newmtl lamp\nKd 0.5 2 nan\nKe 0 1 0.25\nPr 0.75\nPm 1\nmap_Kd wood.png\n"
                      "newmtl unused\nKd 1 1 1\n",
    { "wood", "lamp", "missing" });
  EXPECT_TRUE(this->warnings_.empty());
  EXPECT_THAT(
    this->materials_, UnorderedElementsAre(testing::Pair("wood", 0), testing::Pair("lamp", 1)));
  const Json& json = this->document_.json();
  ASSERT_EQ(json["materials"].size(), 2u);
  const Json& wood = json["materials"][0];
  EXPECT_EQ(wood["name"], "wood");
  // a black color would hide the picture
  EXPECT_EQ(wood["pbrMetallicRoughness"]["baseColorFactor"], Json({ 1.0, 1.0, 1.0, 0.5 }));
  EXPECT_EQ(wood["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
  EXPECT_NEAR(
    wood["pbrMetallicRoughness"]["roughnessFactor"].get<double>(), std::pow(0.02, 0.25), 1e-12);
  EXPECT_EQ(wood["normalTexture"]["index"], 1);
  EXPECT_EQ(wood["alphaMode"], "BLEND");
  const Json& lamp = json["materials"][1];
  EXPECT_EQ(lamp["pbrMetallicRoughness"]["baseColorFactor"][1], 1.0);
  EXPECT_EQ(lamp["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0); // the same texture
  EXPECT_DOUBLE_EQ(lamp["pbrMetallicRoughness"]["roughnessFactor"].get<double>(), 0.75);
  EXPECT_EQ(lamp["pbrMetallicRoughness"]["metallicFactor"], 1.0);
  EXPECT_EQ(lamp["emissiveFactor"], Json({ 0.0, 1.0, 0.25 }));
  EXPECT_FALSE(lamp.contains("alphaMode"));
  EXPECT_EQ(json["images"].size(), 2u);
}

TEST_F(LookDocuments, PicturesThatCannotBeReadAreNamed)
{
  this->folder_.write("a.tga", "0000000000000000");
  this->add_materials("newmtl m\nmap_Kd gone.png\nmap_Ke a.tga\n", { "m" });
  ASSERT_EQ(this->warnings_.size(), 2u);
  EXPECT_THAT(this->warnings_[0], HasSubstr("'gone.png' is left out because cannot open"));
  EXPECT_THAT(this->warnings_[1], HasSubstr("'a.tga' is left out because it is damaged"));
  EXPECT_FALSE(this->document_.json().contains("images"));
  const test::Folder other;
  other.write("secret.png", png);
  const std::string outside =
    "../" + std::filesystem::path(other.path()).filename().string() + "/secret.png";
  EXPECT_THROW(this->add_materials("newmtl n\nmap_Kd " + outside + "\n", { "n" }), GltfError);
}
