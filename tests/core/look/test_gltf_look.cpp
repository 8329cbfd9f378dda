// The look of glTF files: vertices, texture coordinates, colors and materials.
#include "gltf/gltf_scene_meshes.h"
#include "look/gltf_look.h"

#include "gltf_edit/gltf_document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace bindpose;
using Json = GltfDocument::Json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

namespace
{
const std::string picture_bytes = std::string("\x89PNG\r\n\x1a\n", 8) + "not a real picture";

class GltfLooks : public testing::Test
{
protected:
  GltfDocument document_;
  Json attributes_;

  /// Add the attributes of a square.
  GltfLooks()
  {
    Points points(4, 3);
    points << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
    Eigen::Matrix<double, 4, 2, Eigen::RowMajor> coordinates;
    coordinates << 0, 1, 1, 1, 1, 0, 0.25, 0.5;
    this->attributes_ = { { "POSITION", this->document_.append_rows(points) },
      { "TEXCOORD_0", this->document_.append_rows(coordinates) } };
  }

  /// Return a primitive with one triangle of the square.
  Json triangle(std::uint16_t a, std::uint16_t b, std::uint16_t c, int material)
  {
    Json primitive{ { "attributes", this->attributes_ },
      { "indices",
        this->document_.append_accessor(
          std::vector<std::uint16_t>{ a, b, c }, 1, GltfDocument::element_array_buffer) } };
    if (material >= 0)
    {
      primitive["material"] = material;
    }
    return primitive;
  }

  /// Add a texture of a picture that is stored in the document, and return its id.
  int add_texture()
  {
    return this->document_.append(
      "textures", { { "source", this->document_.append_image(picture_bytes, "") } });
  }

  Status read(Json primitives, SurfaceLook& look)
  {
    const int mesh = this->document_.append("meshes", { { "primitives", std::move(primitives) } });
    this->document_.append("nodes", { { "mesh", mesh } });
    std::string bytes;
    EXPECT_TRUE(this->document_.to_bytes(true, bytes).ok());
    return read_gltf_bytes("m.glb", bytes,
      [&](const GltfContent& content, Status& status)
      {
        const GltfSceneMeshes scene = read_gltf_scene(content.model, content.bytes.size(), status);
        look = read_gltf_look(content, scene.parts, scene.points.rows(), status.warnings);
      });
  }
};
} // namespace

TEST_F(GltfLooks, PrimitivesOfOneMeshKeepOnlyTheirOwnVertices)
{
  this->document_.append("materials", { { "name", "a" } });
  SurfaceLook look;
  const Status status =
    this->read(Json::array({ this->triangle(0, 1, 2, 0), this->triangle(0, 2, 3, -1) }), look);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(look.point_count, 4);
  EXPECT_THAT(look.points, ElementsAre(0, 1, 2, 0, 2, 3));
  EXPECT_THAT(look.triangle_materials, ElementsAre(0, -1));
  EXPECT_EQ(look.coordinates.row(0), Eigen::RowVector2d(0, 0)) << "the origin moves down";
  EXPECT_EQ(look.coordinates.row(5), Eigen::RowVector2d(0.25, 0.5));
  EXPECT_EQ(look.colors.rows(), 0);
  EXPECT_TRUE(look.is_plain()) << "white, without textures";
}

TEST_F(GltfLooks, MaterialsHaveTheValuesOfTheFile)
{
  const int texture = this->add_texture();
  this->document_.append("samplers", { { "wrapS", 33648 }, { "magFilter", 9728 } });
  this->document_.list("textures")[texture]["sampler"] = 0;
  this->document_.append("materials",
    { { "name", "wood" },
      { "pbrMetallicRoughness",
        { { "baseColorFactor", { 0.5, 0.25, 1.0, 0.75 } }, { "metallicFactor", 0.125 },
          { "roughnessFactor", 0.5 }, { "metallicRoughnessTexture", { { "index", texture } } } } },
      { "occlusionTexture", { { "index", texture }, { "strength", 0.25 } } },
      { "normalTexture", { { "index", texture }, { "scale", 0.5 } } },
      { "emissiveFactor", { 0.0, 1.0, 0.5 } }, { "alphaMode", "MASK" }, { "alphaCutoff", 0.125 },
      { "doubleSided", true } });
  SurfaceLook look;
  const Status status = this->read(Json::array({ this->triangle(0, 1, 2, 0) }), look);
  ASSERT_TRUE(status.ok()) << status.message;
  ASSERT_THAT(look.materials, SizeIs(1));
  const LookMaterial& material = look.materials.front();
  EXPECT_EQ(material.name, "wood");
  EXPECT_EQ(material.base_color, Eigen::Vector4d(0.5, 0.25, 1.0, 0.75));
  EXPECT_EQ(material.metallic, 0.125);
  EXPECT_EQ(material.roughness, 0.5);
  EXPECT_EQ(material.base_color_texture.image, -1);
  EXPECT_EQ(material.metallic_roughness_texture.image, 0);
  EXPECT_EQ(material.metallic_roughness_texture.wrap, LookTexture::Wrap::mirror);
  EXPECT_FALSE(material.metallic_roughness_texture.interpolates);
  EXPECT_EQ(material.occlusion_strength, 0.25);
  EXPECT_EQ(material.normal_scale, 0.5);
  EXPECT_EQ(material.emission, Vec3(0.0, 1.0, 0.5));
  EXPECT_EQ(material.alpha, LookMaterial::Alpha::mask);
  EXPECT_EQ(material.alpha_cutoff, 0.125);
  EXPECT_TRUE(material.is_double_sided);
  EXPECT_FALSE(material.is_unlit);
  ASSERT_THAT(look.images, SizeIs(1));
  EXPECT_EQ(look.images.front().bytes, picture_bytes);
  EXPECT_EQ(look.images.front().format, "png");
  EXPECT_FALSE(look.is_plain());
}

TEST_F(GltfLooks, TheFirstTextureOfAMaterialTransformsTheCoordinates)
{
  const int texture = this->add_texture();
  const Json transform{ { "KHR_texture_transform",
    { { "offset", { 0.5, 0.25 } }, { "scale", { 2.0, 4.0 } } } } };
  this->document_.append("materials",
    { { "pbrMetallicRoughness",
        { { "baseColorTexture", { { "index", texture }, { "extensions", transform } } } } },
      { "normalTexture", { { "index", texture } } } });
  SurfaceLook look;
  const Status status = this->read(Json::array({ this->triangle(0, 2, 3, 0) }), look);
  ASSERT_TRUE(status.ok()) << status.message;
  // (0.25, 0.5) becomes (0.5 + 2 * 0.25, 0.25 + 4 * 0.5); the last step moves the origin.
  EXPECT_EQ(look.coordinates.row(2), Eigen::RowVector2d(1.0, 1.0 - 2.25));
}

TEST_F(GltfLooks, VerticesWithoutColorsAreWhite)
{
  const Json colorless = this->triangle(0, 1, 2, -1);
  Points colors(4, 3);
  colors << 0, 0, 0, 0.5, 2.0, -1.0, 0, 0, 0, 0, 0, 0;
  this->attributes_["COLOR_0"] = this->document_.append_rows(colors);
  SurfaceLook look;
  const Status status = this->read(Json::array({ colorless, this->triangle(0, 1, 2, -1) }), look);
  ASSERT_TRUE(status.ok()) << status.message;
  ASSERT_EQ(look.colors.rows(), 6);
  EXPECT_TRUE(look.colors.topRows(3).isOnes());
  EXPECT_EQ(look.colors.row(4), Eigen::RowVector4d(0.5, 1.0, 0.0, 1.0)) << "limited to 0 and 1";
  EXPECT_FALSE(look.is_plain());
}

TEST_F(GltfLooks, MirroringNodesFlipTriangles)
{
  this->document_.append("nodes", { { "mesh", 0 }, { "scale", { -1.0, 1.0, 1.0 } } });
  SurfaceLook look;
  const Status status = this->read(Json::array({ this->triangle(0, 1, 2, -1) }), look);
  ASSERT_TRUE(status.ok()) << status.message;
  ASSERT_EQ(look.triangles.rows(), 2);
  EXPECT_EQ(look.triangles.row(0), (Triangles(1, 3) << 0, 2, 1).finished());
  EXPECT_EQ(look.triangles.row(1), (Triangles(1, 3) << 3, 4, 5).finished());
}

TEST_F(GltfLooks, InvalidReferencesAreRefused)
{
  const auto sentence = [this](const Json& material, const char* list = nullptr, Json entry = {})
  {
    GltfLooks::document_.list("materials") = Json::array({ material });
    if (list)
    {
      this->document_.list(list) = Json::array({ std::move(entry) });
    }
    SurfaceLook look;
    return this->read(Json::array({ this->triangle(0, 1, 2, 0) }), look).message;
  };
  const Json normal{ { "normalTexture", { { "index", 7 } } } };
  EXPECT_THAT(sentence(normal), HasSubstr("m.glb: texture 7 does not exist"));
  const Json first{ { "normalTexture", { { "index", 0 } } } };
  EXPECT_THAT(
    sentence(first, "textures", { { "source", 3 } }), HasSubstr("image 3 does not exist"));
  EXPECT_THAT(sentence(first, "textures", { { "source", 0 }, { "sampler", 2 } }),
    HasSubstr("image 0 does not exist"));
  this->document_.append(
    "bufferViews", { { "buffer", 0 }, { "byteOffset", 8 }, { "byteLength", 100000 } });
  const auto view = static_cast<int>(this->document_.list("bufferViews").size()) - 1;
  this->document_.list("textures") = Json::array({ { { "source", 0 } } });
  EXPECT_THAT(sentence(first, "images", { { "bufferView", view }, { "mimeType", "image/png" } }),
    testing::AnyOf(HasSubstr("extends beyond the end"), HasSubstr("the file is not valid")));
}
