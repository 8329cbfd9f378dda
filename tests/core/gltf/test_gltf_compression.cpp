// Files that are compressed by Draco and meshopt: equal to their uncompressed twins. The libraries
// compress the files here; bindpose-importer decompresses them.
#include "gltf/gltf_compression.h"
#include "gltf/gltf_file.h"
#include "gltf_edit/gltf_asset.h"

#include "support/files.h"
#include "support/meshes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <set>

#ifdef BINDPOSE_HAS_DRACO
#include <draco/compression/expert_encode.h>
#endif
#ifdef BINDPOSE_HAS_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

using namespace bindpose;
using Json = GltfDocument::Json;
using testing::HasSubstr;

namespace
{
struct Ball
{
  std::vector<float> points, texture;
  std::vector<std::uint8_t> colors; ///< three per vertex
  std::vector<std::uint32_t> corners;

  Ball()
  {
    const TriangleMesh mesh = test::sphere(3);
    for (Index v = 0; v < mesh.points.rows(); ++v)
    {
      for (int c = 0; c < 3; ++c)
      {
        this->points.push_back(static_cast<float>(mesh.points(v, c)));
        this->colors.push_back(static_cast<std::uint8_t>(v % 200 + c));
      }
      this->texture.push_back(this->points[3 * v]);
      this->texture.push_back(1.0F - this->points[3 * v + 1]);
    }
    for (Index k = 0; k < mesh.triangles.size(); ++k)
    {
      this->corners.push_back(static_cast<std::uint32_t>(mesh.triangles.data()[k]));
    }
  }

  std::size_t vertex_count() const { return this->points.size() / 3; }
};

/// Add a mesh, with a node whose extras must be kept.
void add_node(GltfDocument& document, Json primitive)
{
  document.append("meshes", { { "name", "ball" }, { "primitives", Json::array({ primitive }) } });
  document.append("nodes", { { "mesh", 0 }, { "extras", { { "mine", 0.1 } } } });
  document.append("scenes", { { "nodes", { 0 } } });
  document.json()["scene"] = 0;
}

/// Return the document without compression.
GltfDocument twin(const Ball& ball)
{
  GltfDocument document;
  std::vector<std::uint8_t> colors; // rows of four bytes, as glTF requires
  for (std::size_t k = 0; k < ball.colors.size(); ++k)
  {
    colors.push_back(ball.colors[k]);
    if (k % 3 == 2)
    {
      colors.push_back(0);
    }
  }
  const int color_view = document.append_view(colors.data(), colors.size(), 34962);
  document.json()["bufferViews"][color_view]["byteStride"] = 4;
  const int color = document.append("accessors",
    { { "bufferView", color_view }, { "componentType", 5121 }, { "normalized", true },
      { "count", ball.vertex_count() }, { "type", "VEC3" } });
  const int target = GltfDocument::array_buffer;
  add_node(document,
    { { "attributes",
        { { "POSITION", document.append_accessor(ball.points, 3, target) },
          { "TEXCOORD_0", document.append_accessor(ball.texture, 2, target) },
          { "COLOR_0", color } } },
      { "indices",
        document.append_accessor(ball.corners, 1, GltfDocument::element_array_buffer) } });
  return document;
}

/// The content of a file as it is read, with all attributes of its first primitive.
struct Content
{
  Status status;
  GltfNumbers points, texture, colors;
  std::vector<std::array<Index, 3>> triangles;
  Json json;
};

Content read(const std::string& path)
{
  Content content;
  ExecutionContext context;
  content.status = read_gltf_file(context, path,
    [&](const GltfContent& file, Status&)
    {
      const GltfAccessors accessors(file.model, file.bytes.size());
      const tinygltf::Primitive& primitive = file.model.meshes.at(0).primitives.at(0);
      content.points =
        read_gltf_attribute(accessors, primitive, "POSITION", TINYGLTF_TYPE_VEC3, -1);
      content.texture =
        read_gltf_attribute(accessors, primitive, "TEXCOORD_0", TINYGLTF_TYPE_VEC2, -1);
      content.colors = read_gltf_attribute(accessors, primitive, "COLOR_0", TINYGLTF_TYPE_VEC3, -1);
      content.triangles = read_gltf_triangles(accessors, primitive, content.points.rows());
      std::vector<std::string> warnings;
      content.json = GltfDocument(file.bytes, file.model, file.files.folder, warnings).json();
    });
  return content;
}

/// Begin each triangle with its smallest vertex, because compression may rotate its vertices.
std::multiset<std::array<Index, 3>> rotated(const std::vector<std::array<Index, 3>>& triangles)
{
  std::multiset<std::array<Index, 3>> result;
  for (std::array<Index, 3> triangle : triangles)
  {
    std::rotate(
      triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    result.insert(triangle);
  }
  return result;
}

class CompressedFiles : public testing::Test
{
protected:
  const Ball ball_;
  const test::Folder folder_;

  std::string write(const GltfDocument& document, const std::string& name = "in.glb") const
  {
    const bool binary = name.find(".glb") != std::string::npos;
    EXPECT_TRUE(document.write(this->folder_ / name, binary).ok());
    return this->folder_ / name;
  }
  Content read_twin() const { return read(this->write(twin(this->ball_), "twin.glb")); }
  std::string error(const GltfDocument& document) const
  {
    return read(this->write(document)).status.message;
  }
};

/// Check that a file has the values of the file without compression, and no trace of the
/// compression.
void expect_equal(const Content& file, const Content& twin)
{
  ASSERT_TRUE(file.status.ok()) << file.status.message;
  EXPECT_EQ(file.points, twin.points);
  EXPECT_EQ(file.texture, twin.texture);
  EXPECT_EQ(file.colors, twin.colors);
  EXPECT_EQ(rotated(file.triangles), rotated(twin.triangles));
  EXPECT_EQ(file.json["nodes"], twin.json["nodes"]);
  EXPECT_FALSE(file.json.contains("extensionsUsed"));
  EXPECT_FALSE(file.json.contains("extensionsRequired"));
  EXPECT_EQ(file.json.dump().find("compression"), std::string::npos);
  EXPECT_EQ(file.json["buffers"].size(), 1);
}
} // namespace

#ifdef BINDPOSE_HAS_DRACO

namespace
{
template <typename Number>
std::uint32_t add_attribute(draco::Mesh& mesh, draco::GeometryAttribute::Type type,
  draco::DataType number, const std::vector<Number>& values, int columns)
{
  draco::GeometryAttribute attribute;
  const std::size_t row = static_cast<std::size_t>(columns) * sizeof(Number);
  attribute.Init(type, nullptr, static_cast<std::int8_t>(columns), number,
    type == draco::GeometryAttribute::COLOR, static_cast<std::int64_t>(row), 0);
  const int id = mesh.AddAttribute(attribute, true, mesh.num_points());
  for (std::uint32_t v = 0; v < mesh.num_points(); ++v)
  {
    mesh.attribute(id)->SetAttributeValue(
      draco::AttributeValueIndex(v), values.data() + std::size_t(v) * columns);
  }
  return mesh.attribute(id)->unique_id();
}

/// Return a document whose mesh is compressed by Draco.
/// @param method MESH_SEQUENTIAL_ENCODING keeps the order of vertices
/// @param bits bits per coordinate; 0: coordinates are kept exactly
GltfDocument draco_document(const Ball& ball, int method, int bits)
{
  draco::Mesh mesh;
  mesh.set_num_points(static_cast<std::uint32_t>(ball.vertex_count()));
  for (std::size_t k = 0; k < ball.corners.size(); k += 3)
  {
    mesh.AddFace({ draco::PointIndex(ball.corners[k]), draco::PointIndex(ball.corners[k + 1]),
      draco::PointIndex(ball.corners[k + 2]) });
  }
  const std::uint32_t points =
    add_attribute(mesh, draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, ball.points, 3);
  const std::uint32_t texture =
    add_attribute(mesh, draco::GeometryAttribute::TEX_COORD, draco::DT_FLOAT32, ball.texture, 2);
  const std::uint32_t colors =
    add_attribute(mesh, draco::GeometryAttribute::COLOR, draco::DT_UINT8, ball.colors, 3);
  draco::ExpertEncoder encoder(mesh);
  encoder.SetEncodingMethod(method);
  if (bits > 0)
  {
    encoder.SetAttributeQuantization(0, bits);
  }
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeToBuffer(&buffer).ok());

  GltfDocument document;
  const int view = document.append_view(buffer.data(), buffer.size(), 0);
  const std::size_t count = ball.vertex_count();
  document.append("accessors",
    { { "componentType", 5126 }, { "count", count }, { "type", "VEC3" }, { "min", { -9, -9, -9 } },
      { "max", { 9, 9, 9 } } });
  document.append(
    "accessors", { { "componentType", 5126 }, { "count", count }, { "type", "VEC2" } });
  document.append("accessors",
    { { "componentType", 5121 }, { "normalized", true }, { "count", count }, { "type", "VEC3" } });
  document.append("accessors",
    { { "componentType", 5123 }, { "count", ball.corners.size() }, { "type", "SCALAR" } });
  add_node(document,
    { { "attributes", { { "POSITION", 0 }, { "TEXCOORD_0", 1 }, { "COLOR_0", 2 } } },
      { "indices", 3 },
      { "extensions",
        { { draco_extension,
          { { "bufferView", view },
            { "attributes",
              { { "POSITION", points }, { "TEXCOORD_0", texture },
                { "COLOR_0", colors } } } } } } } });
  document.json()["extensionsUsed"] = { draco_extension };
  document.json()["extensionsRequired"] = { draco_extension };
  return document;
}

Json& primitive_of(GltfDocument& document)
{
  return document.json()["meshes"][0]["primitives"][0];
}
} // namespace

TEST_F(CompressedFiles, DracoMeshesAreEqualToTheirTwins)
{
  const GltfDocument document = draco_document(this->ball_, draco::MESH_SEQUENTIAL_ENCODING, 0);
  const Content twin = this->read_twin();
  for (const char* name : { "in.glb", "in.gltf" })
  {
    const Content file = read(this->write(document, name));
    expect_equal(file, twin);
    EXPECT_EQ(file.json["accessors"][0]["max"], Json({ 1.0, 1.0, 1.0 }));
  }
}

TEST_F(CompressedFiles, RoundedDracoMeshesDifferByOneStep)
{
  const Content file =
    read(this->write(draco_document(this->ball_, draco::MESH_EDGEBREAKER_ENCODING, 12)));
  ASSERT_TRUE(file.status.ok()) << file.status.message;
  const Content twin = this->read_twin();
  ASSERT_EQ(file.points.rows(), twin.points.rows());
  EXPECT_EQ(file.triangles.size(), twin.triangles.size());
  // The order of the vertices differs. Each triangle of the sphere has a counterpart.
  const double step = 2.0 / 4095.0;
  for (Index v = 0; v < file.points.rows(); ++v)
  {
    const Eigen::VectorXd distances =
      (twin.points.rowwise() - file.points.row(v)).rowwise().lpNorm<Eigen::Infinity>();
    Index nearest = -1;
    EXPECT_LE(distances.minCoeff(&nearest), 0.51 * step);
    EXPECT_EQ(file.colors.row(v), twin.colors.row(nearest));
  }
}

TEST_F(CompressedFiles, PrimitivesMayShareACompressedMesh)
{
  GltfDocument document = draco_document(this->ball_, draco::MESH_SEQUENTIAL_ENCODING, 0);
  Json& primitives = document.json()["meshes"][0]["primitives"];
  const Json first = primitives[0];
  primitives.push_back(first);
  primitives[1].erase("indices");
  primitives[1]["indices"] = 3;
  GltfAsset asset;
  ExecutionContext context;
  const Status status = asset.read(context, this->write(document));
  ASSERT_TRUE(status.ok()) << status.message;
  const auto count = static_cast<Index>(this->ball_.vertex_count());
  ASSERT_EQ(asset.points().rows(), 2 * count);
  EXPECT_EQ(asset.points().topRows(count), asset.points().bottomRows(count));
}

TEST_F(CompressedFiles, AnAssetIsWrittenWithoutCompression)
{
  GltfAsset asset;
  ExecutionContext context;
  ASSERT_TRUE(
    asset
      .read(context, this->write(draco_document(this->ball_, draco::MESH_SEQUENTIAL_ENCODING, 0)))
      .ok());
  ASSERT_TRUE(asset.write(this->folder_ / "out.glb", true).ok());
  expect_equal(read(this->folder_ / "out.glb"), this->read_twin());
  // The compressed data is not in the file.
  EXPECT_LT(std::filesystem::file_size(this->folder_ / "out.glb"),
    std::filesystem::file_size(this->write(twin(this->ball_))) + 300);
}

TEST_F(CompressedFiles, BufferFilesAreRead)
{
  GltfDocument document = draco_document(this->ball_, draco::MESH_SEQUENTIAL_ENCODING, 0);
  std::string text;
  ASSERT_TRUE(document.to_bytes(false, text).ok());
  Json json = Json::parse(text);
  std::string bytes;
  ASSERT_TRUE(document.to_bytes(true, bytes).ok());
  const std::string buffer =
    bytes.substr(bytes.size() - (json["buffers"][0]["byteLength"].get<std::size_t>() + 3) / 4 * 4);
  std::filesystem::create_directory(this->folder_ / "parts");
  this->folder_.write("parts/a b.bin", buffer);
  json["buffers"][0]["uri"] = "parts/a%20b.bin";
  expect_equal(read(this->folder_.write("in.gltf", json.dump())), this->read_twin());

  std::vector<std::string> files;
  ExecutionContext context;
  read_gltf_file(context, this->folder_ / "in.gltf",
    [&](const GltfContent& content, Status&) { files = content.files.paths; });
  EXPECT_THAT(files, testing::ElementsAre(HasSubstr("parts/a b.bin")));

  std::filesystem::create_directory(this->folder_ / "scene");
  json["buffers"][0]["uri"] = "../parts/a%20b.bin";
  EXPECT_THAT(read(this->folder_.write("scene/in.gltf", json.dump())).status.message,
    HasSubstr("in the folder of the file"));
}

TEST_F(CompressedFiles, DefectsOfDracoMeshesAreRefused)
{
  const auto changed = [&](auto change)
  {
    GltfDocument document = draco_document(this->ball_, draco::MESH_SEQUENTIAL_ENCODING, 0);
    change(document);
    const std::string message = this->error(document);
    EXPECT_THAT(message, HasSubstr("in.glb cannot be read"));
    return message;
  };
  const auto extension_of = [](GltfDocument& document) -> Json&
  { return primitive_of(document)["extensions"][draco_extension]; };
  EXPECT_THAT(changed([](GltfDocument& d) { d.json()["bufferViews"][0]["byteLength"] = 40; }),
    HasSubstr("mesh 0: primitive 0: the data cannot be decompressed"));
  EXPECT_THAT(changed([](GltfDocument& d) { d.json()["bufferViews"][0]["byteLength"] = 1 << 30; }),
    HasSubstr("beyond the end"));
  EXPECT_THAT(changed([&](GltfDocument& d) { extension_of(d)["attributes"]["POSITION"] = 77; }),
    HasSubstr("attribute 77 of the compressed mesh does not exist"));
  EXPECT_THAT(changed([&](GltfDocument& d) { extension_of(d)["bufferView"] = 9; }),
    HasSubstr("element 9 of 'bufferViews'"));
  EXPECT_THAT(changed([&](GltfDocument& d) { extension_of(d).erase("bufferView"); }),
    HasSubstr("'bufferView' is missing"));
  EXPECT_THAT(changed([](GltfDocument& d) { d.json()["accessors"][0]["type"] = "VEC2"; }),
    HasSubstr("type of its accessor"));
  EXPECT_THAT(changed([](GltfDocument& d) { d.json()["accessors"][0]["type"] = "MAT4"; }),
    HasSubstr("expected SCALAR"));
  EXPECT_THAT(changed([](GltfDocument& d) { d.json()["accessors"][0]["componentType"] = 5130; }),
    HasSubstr("component type"));
  EXPECT_THAT(changed([](GltfDocument& d) { primitive_of(d)["indices"] = 12; }),
    HasSubstr("element 12 of 'accessors'"));
  EXPECT_THAT(changed([&](GltfDocument& d) { extension_of(d) = 3; }),
    HasSubstr("mesh 0: primitive 0: the value 'bufferView' is missing"));
}

TEST_F(CompressedFiles, OptionalCompressionIsNotUsed)
{
  // A file with both kinds of data needs no program that decompresses.
  setenv("BINDPOSE_IMPORTER", "/none", 1);
  GltfDocument document = twin(this->ball_);
  GltfDocument compressed = draco_document(this->ball_, draco::MESH_SEQUENTIAL_ENCODING, 0);
  primitive_of(document)["extensions"] = primitive_of(compressed)["extensions"];
  document.json()["extensionsUsed"] = { draco_extension };
  expect_equal(read(this->write(document)), this->read_twin());
  unsetenv("BINDPOSE_IMPORTER");
}

TEST_F(CompressedFiles, TheProgramThatDecompressesMayBeMissing)
{
  setenv("BINDPOSE_IMPORTER", "/none", 1);
  const Content file =
    read(this->write(draco_document(this->ball_, draco::MESH_SEQUENTIAL_ENCODING, 0)));
  unsetenv("BINDPOSE_IMPORTER");
  EXPECT_EQ(file.status.code, StatusCode::unavailable);
  EXPECT_THAT(file.status.message, HasSubstr("BINDPOSE_IMPORTER"));
}

#endif

#ifdef BINDPOSE_HAS_MESHOPTIMIZER

namespace
{
/// Compress buffer views of a document. The decompressed views are in a second buffer without
/// data.
class MeshoptWriter
{
public:
  explicit MeshoptWriter(GltfDocument& document) : document_(document) {}

  /// Append a compressed view and return its id.
  int append(const std::vector<unsigned char>& compressed, std::size_t count, std::size_t stride,
    const char* mode, const char* filter = "NONE")
  {
    const int id = this->document_.append_view(compressed.data(), compressed.size(), 0);
    Json& view = this->document_.json()["bufferViews"][id];
    Json extension = view;
    extension["byteStride"] = stride;
    extension["count"] = count;
    extension["mode"] = mode;
    extension["filter"] = filter;
    const std::size_t size = count * stride;
    view = { { "buffer", 1 }, { "byteOffset", this->size_ }, { "byteLength", size },
      { "extensions", { { meshopt_extension, extension } } } };
    if (std::string(mode) == "ATTRIBUTES")
    {
      view["byteStride"] = stride;
    }
    this->size_ += (size + 3) / 4 * 4;
    return id;
  }

  template <typename Number>
  int append_vertices(
    const std::vector<Number>& values, std::size_t columns, const char* filter = "NONE")
  {
    const std::size_t stride = columns * sizeof(Number), count = values.size() / columns;
    std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(count, stride));
    bytes.resize(
      meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), values.data(), count, stride));
    return this->append(bytes, count, stride, "ATTRIBUTES", filter);
  }

  /// @param stride bytes per index: 2 or 4
  int append_corners(const Ball& ball, bool is_sequence, std::size_t stride)
  {
    const std::size_t count = ball.corners.size();
    std::vector<unsigned char> bytes(is_sequence
        ? meshopt_encodeIndexSequenceBound(count, ball.vertex_count())
        : meshopt_encodeIndexBufferBound(count, ball.vertex_count()));
    bytes.resize(is_sequence
        ? meshopt_encodeIndexSequence(bytes.data(), bytes.size(), ball.corners.data(), count)
        : meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), ball.corners.data(), count));
    return this->append(bytes, count, stride, is_sequence ? "INDICES" : "TRIANGLES");
  }

  /// Declare the extension and the second buffer.
  void finish()
  {
    Json& json = this->document_.json();
    json["buffers"].push_back({ { "byteLength", this->size_ },
      { "extensions", { { meshopt_extension, { { "fallback", true } } } } } });
    json["extensionsUsed"] = { meshopt_extension, "KHR_mesh_quantization" };
    json["extensionsRequired"] = { meshopt_extension, "KHR_mesh_quantization" };
  }

private:
  GltfDocument& document_;
  std::size_t size_ = 0;
};

/// Append an accessor for a compressed view.
int append_accessor(
  GltfDocument& document, int view, int type, std::size_t count, const char* shape)
{
  return document.append("accessors",
    { { "bufferView", view }, { "componentType", type }, { "count", count }, { "type", shape } });
}

/// Return a document whose views are compressed by meshopt.
GltfDocument meshopt_document(const Ball& ball, bool is_sequence, std::size_t index_size)
{
  GltfDocument document;
  MeshoptWriter writer(document);
  const std::size_t count = ball.vertex_count();
  std::vector<std::uint8_t> colors(4 * count);
  for (std::size_t k = 0; k < ball.colors.size(); ++k)
  {
    colors[k / 3 * 4 + k % 3] = ball.colors[k];
  }
  const int points =
    append_accessor(document, writer.append_vertices(ball.points, 3), 5126, count, "VEC3");
  const int texture =
    append_accessor(document, writer.append_vertices(ball.texture, 2), 5126, count, "VEC2");
  const int color =
    append_accessor(document, writer.append_vertices(colors, 4), 5121, count, "VEC3");
  document.json()["accessors"][color]["normalized"] = true;
  const int corners =
    append_accessor(document, writer.append_corners(ball, is_sequence, index_size),
      index_size == 2 ? 5123 : 5125, ball.corners.size(), "SCALAR");
  add_node(document,
    { { "attributes", { { "POSITION", points }, { "TEXCOORD_0", texture }, { "COLOR_0", color } } },
      { "indices", corners } });
  writer.finish();
  return document;
}
} // namespace

TEST_F(CompressedFiles, MeshoptViewsAreEqualToTheirTwins)
{
  Content twin = this->read_twin();
  for (const bool is_sequence : { false, true })
  {
    for (const std::size_t index_size : { 2, 4 })
    {
      const GltfDocument document = meshopt_document(this->ball_, is_sequence, index_size);
      for (const char* name : { "in.glb", "in.gltf" })
      {
        Content file = read(this->write(document, name));
        ASSERT_TRUE(file.status.ok()) << file.status.message;
        // The attributes have integers, so the extension for them stays.
        EXPECT_EQ(file.json["extensionsUsed"], Json({ "KHR_mesh_quantization" }));
        file.json.erase("extensionsUsed");
        file.json.erase("extensionsRequired");
        expect_equal(file, twin);
      }
    }
  }
}

TEST_F(CompressedFiles, BuffersForOtherProgramsAreNotRead)
{
  GltfDocument document = meshopt_document(this->ball_, false, 4);
  document.json()["buffers"][1]["uri"] = "missing.bin";
  const Content file = read(this->write(document));
  ASSERT_TRUE(file.status.ok()) << file.status.message;
  EXPECT_EQ(file.points, this->read_twin().points);
}

TEST_F(CompressedFiles, MeshoptFiltersAreApplied)
{
  // The filter stores each coordinate as m * 2^e; the steps are powers of two, so that the values
  // of this test are exact.
  Ball ball;
  for (float& value : ball.points)
  {
    value = std::round(value * 512.0F) / 512.0F;
  }
  const std::size_t count = ball.vertex_count();
  std::vector<std::uint32_t> encoded(ball.points.size());
  meshopt_encodeFilterExp(encoded.data(), count, 12, 15, ball.points.data());
  GltfDocument document;
  MeshoptWriter writer(document);
  const int points = append_accessor(
    document, writer.append_vertices(encoded, 3, "EXPONENTIAL"), 5126, count, "VEC3");
  const int corners = append_accessor(
    document, writer.append_corners(ball, false, 4), 5125, ball.corners.size(), "SCALAR");
  add_node(document, { { "attributes", { { "POSITION", points } } }, { "indices", corners } });
  writer.finish();
  const Content file = read(this->write(document));
  ASSERT_TRUE(file.status.ok()) << file.status.message;
  const Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>> expected(
    ball.points.data(), static_cast<Index>(count), 3);
  EXPECT_LE((file.points - expected.cast<double>()).cwiseAbs().maxCoeff(), 1e-4);
}

TEST_F(CompressedFiles, DefectsOfMeshoptViewsAreRefused)
{
  const auto changed = [&](const char* name, const Json& value)
  {
    GltfDocument document = meshopt_document(this->ball_, false, 4);
    document.json()["bufferViews"][0]["extensions"][meshopt_extension][name] = value;
    const std::string message = this->error(document);
    EXPECT_THAT(message, HasSubstr("in.glb cannot be read"));
    return message;
  };
  EXPECT_THAT(
    changed("byteLength", 100), HasSubstr("buffer view 0: the data cannot be decompressed"));
  EXPECT_THAT(changed("byteLength", 1 << 30), HasSubstr("beyond the end"));
  EXPECT_THAT(changed("buffer", 1), HasSubstr("beyond the end"));
  EXPECT_THAT(changed("buffer", 9), HasSubstr("beyond the end"));
  EXPECT_THAT(changed("count", 0), HasSubstr("do not fit together"));
  EXPECT_THAT(changed("count", std::size_t(1) << 60), HasSubstr("do not fit together"));
  EXPECT_THAT(changed("count", -1), HasSubstr("'count'"));
  EXPECT_THAT(changed("byteStride", 7), HasSubstr("do not fit together"));
  EXPECT_THAT(changed("mode", "STRIPS"), HasSubstr("do not fit together"));
  EXPECT_THAT(changed("filter", "QUATERNION"), HasSubstr("do not fit together"));
  EXPECT_THAT(changed("filter", 3), HasSubstr("in.glb"));
  GltfDocument longer = meshopt_document(this->ball_, false, 4);
  longer.json()["bufferViews"][0]["byteLength"] = 12;
  EXPECT_THAT(this->error(longer), HasSubstr("byteLength and byteStride differ"));
}

#endif
