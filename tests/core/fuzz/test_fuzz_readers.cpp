// Fuzz test of the file readers. The test damages valid files of every format that the core library
// reads: bits are flipped, lines moved, numbers replaced, and ends cut off. A reader must return
// usable data or an error message of one sentence.
#include "gltf/gltf_skin.h"
#include "io/dmat.h"
#include "io/medit.h"
#include "io/obj.h"
#include "io/off.h"
#include "io/ply.h"
#include "io/stl.h"
#include "io/tgf.h"
#include "pose/pose_file.h"
#include "support/files.h"
#include "support/fuzz.h"
#include "support/handles.h"

#include <cstring>
#include <map>

using namespace bindpose;

namespace
{
// Memory limit in MiB. The files have a few KiB, so only a reader that trusts a damaged size
// exceeds the limit.
constexpr Index memory_limit = 256;

std::size_t random_index(test::Random& random, std::size_t size)
{
  return static_cast<std::size_t>(random.below(static_cast<Index>(size)));
}

std::string bytes(test::Random& random, Index most)
{
  std::string result(static_cast<std::size_t>(1 + random.below(most)), ' ');
  const Index kind = random.below(3);
  for (char& c : result)
  {
    const char* blanks = "\n\r\t \0#\"{}[]/-";
    c = kind == 0 ? static_cast<char>(random.below(256))
      : kind == 1 ? static_cast<char>(32 + random.below(95))
                  : blanks[random.below(14)];
  }
  return result;
}

/// Return the positions of the line starts, and the end of the text.
std::vector<std::size_t> line_begins(const std::string& text)
{
  std::vector<std::size_t> begins{ 0 };
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    if (text[i] == '\n' && i + 1 < text.size())
    {
      begins.push_back(i + 1);
    }
  }
  begins.push_back(text.size());
  return begins;
}

/// Replace one number of the text by a random text: an invalid, too large, negative or ordinary
/// number.
void replace_number(test::Random& random, std::string& text)
{
  static const char* const others[] = { "nan", "inf", "-inf", "-1", "0", "1", "2", "-0", "1e400",
    "-1e400", "1e-400", "1e308", "-1.7e308", "5e-324", "127", "256", "65536", "2147483647",
    "2147483648", "-2147483648", "4294967295", "4294967296", "1099511627775", "1099511627776",
    "4611686018427387904", "9223372036854775807", "-9223372036854775808", "18446744073709551616",
    "99999999999999999999999999", "0x10", "1.5", "1e3", "+", "-", "1,5", "" };
  const std::size_t from = text.find_first_of("0123456789", random_index(random, text.size()));
  if (from == std::string::npos)
  {
    return;
  }
  const std::size_t begin = text.find_last_not_of("0123456789+-.eE", from) + 1;
  const std::size_t end = std::min(text.find_first_not_of("0123456789+-.eE", from), text.size());
  text.replace(begin, end - begin, others[random.below(std::size(others))]);
}

/// Replace one raw number of a binary file by an invalid, too large, negative or ordinary number.
void replace_binary(test::Random& random, std::string& text)
{
  const double reals[] = { std::nan(""), HUGE_VAL, -HUGE_VAL, 1e300, -1.0, 0.0, 1e-310 };
  const float floats[] = { std::nanf(""), HUGE_VALF, -HUGE_VALF, 3e38f, -1.0f, 1e9f, 1e-40f };
  const std::int32_t integers[] = { -1, 0, 1, 2147483647, -2147483647 - 1, 8, 1 << 24 };
  const Index kind = random.below(3), which = random.below(7);
  char raw[8] = {};
  const std::size_t size = kind == 0 ? 8 : 4;
  std::memcpy(raw,
    kind == 0     ? static_cast<const void*>(&reals[which])
      : kind == 1 ? static_cast<const void*>(&floats[which])
                  : static_cast<const void*>(&integers[which]),
    size);
  if (text.size() >= size)
  {
    text.replace(random_index(random, text.size() - size + 1), size, raw, size);
  }
}

void corrupt_lines(test::Random& random, std::string& text)
{
  const std::vector<std::size_t> begins = line_begins(text);
  const std::size_t lines = begins.size() - 1;
  const auto line = [&](std::size_t i)
  { return text.substr(begins[i], begins[i + 1] - begins[i]); };
  const std::size_t a = random_index(random, lines), b = random_index(random, lines);
  const std::string at_a = line(a), at_b = line(b);
  switch (random.below(3))
  {
    case 0:
      text.erase(begins[a], at_a.size());
      break;
    case 1:
      text.insert(begins[b], at_a);
      break;
    default:
      text.replace(begins[std::max(a, b)], line(std::max(a, b)).size(), line(std::min(a, b)));
      text.replace(begins[std::min(a, b)], line(std::min(a, b)).size(), a < b ? at_b : at_a);
  }
}

/// Apply one to four random changes to a file.
std::string corrupted_file(test::Random& random, std::string text)
{
  const Index count = 1 + random.below(4);
  for (Index k = 0; k < count && !text.empty(); ++k)
  {
    const std::size_t at = random_index(random, text.size());
    switch (random.below(9))
    {
      case 0:
        text[at] = static_cast<char>(text[at] ^ (1 << random.below(8)));
        break;
      case 1:
        text[at] = static_cast<char>(random.below(256));
        break;
      case 2:
        text.resize(at);
        break;
      case 3:
        text.insert(at, bytes(random, 12));
        break;
      case 4:
        text.erase(at, static_cast<std::size_t>(1 + random.below(20)));
        break;
      case 5:
        replace_binary(random, text);
        break;
      case 6:
        corrupt_lines(random, text);
        break;
      default:
        replace_number(random, text);
    }
  }
  return text;
}

void expect_refused(const Status& status)
{
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  test::expect_valid_messages(status);
}

void expect_consistent(const Status& status, const PolygonMesh& mesh)
{
  if (!status.ok())
  {
    expect_refused(status);
    EXPECT_EQ(mesh.points.rows(), 0);
    EXPECT_EQ(mesh.polygon_count(), 0);
    return;
  }
  EXPECT_TRUE(mesh.points.allFinite());
  ASSERT_FALSE(mesh.offsets.empty());
  EXPECT_EQ(mesh.offsets.front(), 0);
  EXPECT_EQ(mesh.offsets.back(), static_cast<Index>(mesh.corners.size()));
  for (std::size_t f = 1; f < mesh.offsets.size(); ++f)
  {
    ASSERT_GE(mesh.offsets[f], mesh.offsets[f - 1] + 3);
  }
  for (const Index corner : mesh.corners)
  {
    ASSERT_TRUE(corner >= 0 && corner < mesh.points.rows()) << corner;
  }
  EXPECT_TRUE(check_mesh(mesh.points, fan_triangles(mesh)).ok());
}

/// Run a reader on damaged copies of valid texts.
template <typename Read>
void fuzz_texts(const char* what, Index rounds, const std::vector<std::string>& valid, Read read)
{
  const test::Folder folder;
  const test::MemoryLimit limit(memory_limit);
  test::fuzz(what, rounds,
    [&](test::Random& random)
    {
      const std::string& text = valid[random_index(random, valid.size())];
      const std::string path = folder.write("file", corrupted_file(random, text));
      read(path);
      if (testing::Test::HasFailure())
      {
        std::cout << "The text:\n" << folder.read("file") << "\n";
      }
    });
}

using ReadPolygons = Status (*)(const std::string&, PolygonMesh&);

void fuzz_polygons(
  const char* what, Index rounds, const std::vector<std::string>& valid, ReadPolygons read)
{
  const test::Folder folder;
  for (const std::string& text : valid)
  {
    PolygonMesh mesh;
    const Status status = read(folder.write("valid", text), mesh);
    ASSERT_TRUE(status.ok()) << status.message;
    ASSERT_GT(mesh.polygon_count(), 0);
  }
  fuzz_texts(what, rounds, valid,
    [&](const std::string& path)
    {
      PolygonMesh mesh;
      const Status status = read(path, mesh);
      expect_consistent(status, mesh);
    });
}

/// Return the bytes of a file to which the given function has written a cube.
std::string written(Status (*write)(const std::string&, const PolygonMesh&))
{
  const test::Folder folder;
  const TriangleMesh cube = test::cube(-0.1, 1.5);
  EXPECT_TRUE(write(folder / "mesh", to_polygons(cube.points, cube.triangles)).ok());
  return folder.read("mesh");
}

template <typename T>
void append_binary(std::string& text, T value, bool swap)
{
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (swap)
  {
    std::reverse(raw, raw + sizeof(T));
  }
  text.append(raw, sizeof(T));
}

/// Return a square in binary PLY with typical extra data of a scanner: colors, quality, and lists.
/// The reader ignores the extra data.
std::string binary_ply(bool big_endian)
{
  std::string text = std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
    "_endian 1.0\ncomment a square\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nproperty uchar red\nproperty list uchar short seen\nelement face 2\n"
    "property double quality\nproperty list uchar int vertex_indices\nend_header\n";
  for (int v = 0; v < 4; ++v)
  {
    append_binary(text, v % 2 ? 1.0f : 0.0f, big_endian);
    append_binary(text, v > 1 ? 1.0f : 0.0f, big_endian);
    append_binary(text, 0.25f, big_endian);
    append_binary(text, std::uint8_t(200), big_endian);
    append_binary(text, std::uint8_t(2), big_endian);
    append_binary(text, std::int16_t(7), big_endian);
    append_binary(text, std::int16_t(-7), big_endian);
  }
  const std::int32_t corners[2][3] = { { 0, 1, 3 }, { 0, 3, 2 } };
  for (const auto& face : corners)
  {
    append_binary(text, 0.5, big_endian);
    append_binary(text, std::uint8_t(3), big_endian);
    for (const std::int32_t corner : face)
    {
      append_binary(text, corner, big_endian);
    }
  }
  return text;
}

const char* const square_ply =
  "ply\nformat ascii 1.0\ncomment a square\nelement vertex 4\nproperty float x\nproperty float y\n"
  "property double z\nproperty uchar red\nelement edge 1\nproperty int vertex1\nproperty int "
  "vertex2\nelement face 2\nproperty list uchar int vertex_index\nproperty list uchar float uv\n"
  "end_header\n0 0 0 255\n1 0 0 255\n1 1 0.5 255\n0 1 0 0\n0 1\n3 0 1 2 2 0.5 0.5\n4 0 1 2 3 0\n";

const char* const square_stl = "solid a square\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
                               "vertex 1 0 0\nvertex 1 1e0 0\nendloop\nendfacet\n"
                               "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 1 0\n"
                               "vertex -0 1 0\nendloop\nendfacet\nendsolid a square\n";
} // namespace

TEST(FuzzReaders, Off)
{
  fuzz_polygons("OFF texts", 3000,
    { written(write_off),
      "COFF # colors\n4 2 0\n0 0 0 255 0 0 255\n1 0 0 1 0 0 1\n\n1 1 0\n0 1 0\n# faces\n"
      "3 0 1 2 200 0 0\n4 0 1 2 3\n2 0 1\n",
      "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n" },
    read_off);
}

TEST(FuzzReaders, Obj)
{
  fuzz_polygons("OBJ texts", 3000,
    { written(write_obj),
      "# exported\nmtllib a.mtl\no square\nv 0 0 0\nv 1 0 0 1\nv 1 1 0 0.5 0.5 0.5\nv 0 1 0\n"
      "vt 0 0\nvn 0 0 1\ng first\nusemtl red\nf 1/1/1 2/1/1 3/1/1\nf -4//1 -2//1 -1//1\nl 1 2\n" },
    read_obj);
}

TEST(FuzzReaders, Ply)
{
  fuzz_polygons("PLY files", 6000,
    { written(write_ply), square_ply, binary_ply(false), binary_ply(true) }, read_ply);
}

TEST(FuzzReaders, Stl)
{
  fuzz_polygons("STL files", 4000, { written(write_stl), square_stl }, read_stl);
}

TEST(FuzzReaders, Tgf)
{
  const std::vector<std::string> valid{ "1 0 0 0 root\n2 1 0 0\n3 2 0.5 -1e-3 a tip\n#\n"
                                        "1 2 1 0 0\n2 3\n3 1 0 0 1\n",
    "-5 0 0 0\n7 1 1 1\n#\n-5 7 0 1 0\n#\nignored\n", "1 0 0 0\n2 1 0 0\n" };
  fuzz_texts("TGF texts", 3000, valid,
    [](const std::string& path)
    {
      Tgf graph;
      const Status status = read_tgf(path, graph);
      const auto count = static_cast<Index>(graph.nodes.size());
      if (!status.ok())
      {
        expect_refused(status);
        EXPECT_TRUE(graph.nodes.empty() && graph.edges.empty());
        return;
      }
      EXPECT_GT(count, 0);
      for (const Tgf::Node& node : graph.nodes)
      {
        EXPECT_TRUE(node.position.allFinite());
        EXPECT_EQ(node.text.find('\n'), std::string::npos);
      }
      for (const Tgf::Edge& edge : graph.edges)
      {
        EXPECT_TRUE(edge.from >= 0 && edge.from < count && edge.to >= 0 && edge.to < count);
        EXPECT_NE(edge.from, edge.to);
      }
    });
}

TEST(FuzzReaders, Dmat)
{
  const test::Folder folder;
  Weights matrix(5, 3);
  for (Index k = 0; k < matrix.size(); ++k)
  {
    matrix.data()[k] = 0.125 * static_cast<double>(k);
  }
  std::vector<std::string> valid{ "0 0\n", "3 0\n" };
  for (const DmatEncoding encoding : { DmatEncoding::ascii, DmatEncoding::binary })
  {
    ASSERT_TRUE(write_dmat(folder / "m", matrix, encoding).ok());
    valid.push_back(folder.read("m"));
    valid.push_back(folder.read("m"));
  }
  fuzz_texts("DMAT files", 4000, valid,
    [](const std::string& path)
    {
      Weights back;
      const Status status = read_dmat(path, back);
      if (!status.ok())
      {
        expect_refused(status);
        EXPECT_EQ(back.size(), 0);
      }
      // A matrix without entries may still have rows or columns, but not a huge number of them.
      EXPECT_LE(std::max(back.rows(), back.cols()), Index(1) << 20);
      EXPECT_LE(back.size(), static_cast<Index>(std::filesystem::file_size(path)));
    });
}

namespace
{
/// Return the glTF file of a rig. The animation moves the joints, or it blends between shapes.
std::string gltf(bool binary, GltfAnimation animation)
{
  const test::Folder folder;
  const TriangleMesh cube = test::cube(-0.1, 1.5);
  GltfSkin skin;
  skin.points = cube.points;
  skin.normals = cube.points;
  skin.texture = cube.points.leftCols<2>();
  skin.colors.setConstant(8, 4, 99);
  skin.triangles = cube.triangles;
  skin.weights.setConstant(8, 6, 0.1);
  for (Index j = 0; j < 6; ++j)
  {
    GltfJoint joint;
    joint.name = "j" + std::to_string(j);
    joint.parent = j - 1;
    joint.rest.translation() = joint.posed.translation() = Vec3(0, 0.2 * static_cast<double>(j), 0);
    joint.handle_extras = GltfHandleExtras{ "cage_vertex", joint.rest.translation(),
      joint.rest.translation(), 0, { { j, (j + 1) % 6, -1 } } };
    skin.joints.push_back(joint);
  }
  for (int k = 0; k < 3; ++k)
  {
    GltfFrame frame;
    frame.points = cube.points * (1.0 + k);
    for (const GltfJoint& joint : skin.joints)
    {
      frame.posed.push_back(joint.rest * Eigen::Translation3d(0, 0, k));
    }
    skin.frames.push_back(frame);
  }
  GltfOptions options;
  options.binary = binary;
  options.animation = animation;
  EXPECT_TRUE(write_gltf_skin(folder / "rig", skin, options).ok());
  return folder.read("rig");
}
} // namespace

TEST(FuzzReaders, Gltf)
{
  std::vector<std::string> valid;
  for (const bool binary : { true, true, false })
  {
    for (const auto animation : { GltfAnimation::joints, GltfAnimation::morph })
    {
      valid.push_back(gltf(binary, animation));
    }
  }
  fuzz_texts("glTF files", 8000, valid,
    [](const std::string& path)
    {
      GltfSkin skin;
      const Status status = read_gltf_skin(path, skin);
      test::expect_valid_messages(status);
      if (!status.ok())
      {
        expect_refused(status);
        EXPECT_EQ(skin.points.rows() + static_cast<Index>(skin.joints.size()), 0);
        return;
      }
      EXPECT_TRUE(check_mesh(skin.points, skin.triangles).ok());
      const auto joints = static_cast<Index>(skin.joints.size());
      EXPECT_EQ(skin.weights.cols(), joints);
      EXPECT_TRUE(skin.weights.allFinite());
      for (const GltfJoint& joint : skin.joints)
      {
        test::expect_sentence(joint.name);
        EXPECT_TRUE(joint.parent >= -1 && joint.parent < joints);
        EXPECT_TRUE(joint.rest.matrix().allFinite() && joint.posed.matrix().allFinite());
      }
      for (const GltfFrame& frame : skin.frames)
      {
        ASSERT_EQ(static_cast<Index>(frame.posed.size()), joints);
      }
      EXPECT_GT(skin.frames_per_second, 0.0);
      // A skin that was read successfully can be written again, unless its values exceed the range
      // of float.
      const Status again = write_gltf_skin(path + ".glb", skin);
      test::expect_valid_messages(again);
    });
}

TEST(FuzzReaders, Medit)
{
  const test::Folder folder;
  const TetMesh box = test::tet_box(1, 1, 1);
  ASSERT_TRUE(write_medit(folder / "m", box.points, boundary_triangles(box.tets), box.tets).ok());
  fuzz_texts("MEDIT texts", 3000,
    { folder.read("m"),
      "MeshVersionFormatted 1\nDimension\n2\nVertices 3\n0 0 1\n1 0 1\n0 1 1\n# edges\nEdges\n1\n"
      "1 2 0\nTriangles\n1\n1 2 3 5\nRidges 1\n1\nEnd\n" },
    [](const std::string& path)
    {
      MeditMesh mesh;
      const Status status = read_medit(path, mesh);
      if (!status.ok())
      {
        expect_refused(status);
        EXPECT_EQ(mesh.points.rows() + mesh.triangles.rows() + mesh.tets.rows(), 0);
        return;
      }
      EXPECT_TRUE(mesh.points.allFinite());
      EXPECT_TRUE(check_mesh(mesh.points, mesh.triangles).ok());
      EXPECT_TRUE(check_mesh(mesh.points, mesh.tets).ok());
    });
}

namespace
{
Handles named_handles()
{
  Handles handles{ test::point_handle("p", Vec3(1, 2, 3)),
    test::bone_handle("fore", Vec3(1, 0, 0), Vec3(2, 0, 0)),
    test::bone_handle("upper", Vec3(0, 0, 0), Vec3(1, 0, 0)) };
  handles[1].parent = 2;
  return handles;
}

/// Return the largest number in an edit of a handle. If it is huge, products may exceed the range
/// of double.
double largest_number(const HandleEdit& edit)
{
  double largest = std::max(std::abs(edit.scale.value_or(0)), edit.stretch.value_or(0));
  for (const auto& vector : { edit.translate, edit.head, edit.tail })
  {
    largest = std::max(largest, vector.value_or(Vec3::Zero()).cwiseAbs().maxCoeff());
  }
  return largest;
}
} // namespace

TEST(FuzzReaders, Poses)
{
  const Handles handles = named_handles();
  const std::vector<std::string> valid{
    R"({"version": 2, "handles": {"p": {"mode": "position", "translate": [1, 0.5, -2e-1],
 "rotate": {"axis": [0, 0, 1], "degrees": 90}, "scale": 2},
 "fore": {"rotate": {"axis": [1, 1, 1], "degrees": -30}, "space": "parent"},
 "upper": {"head": [0, 1, 0], "tail": [3, 1, 0], "stretch": 1.5, "twist": [10, -20]}}})",
    R"({"frames": [{"handles": {"p": {"mode": "free"}}},
{"handles": {}},
{"handles": {"fore": {"mode": "full", "tail": [1, 1, 0]}}}],
"fps": 25})"
  };
  test::fuzz("pose texts", 12000,
    [&](test::Random& random)
    {
      const std::string text = corrupted_file(random, valid[random_index(random, 2)]);
      SCOPED_TRACE(text);
      PoseSequence sequence;
      const Status status = parse_pose_file(text, handles, sequence);
      if (!status.ok())
      {
        expect_refused(status);
        EXPECT_TRUE(sequence.frames.empty());
        return;
      }
      EXPECT_GT(sequence.frames_per_second, 0.0);
      ASSERT_FALSE(sequence.frames.empty());
      std::vector<Pose> poses;
      bool moderate = true;
      for (const auto& frame : sequence.frames)
      {
        for (const HandleEdit& edit : frame.handles)
        {
          ASSERT_TRUE(edit.handle >= 0 && edit.handle < 3);
          const double largest = largest_number(edit);
          moderate = moderate && largest < 1e50 && edit.scale.value_or(1.0) > 1e-50;
        }
        poses.push_back(apply_edits(frame, handles, Pose(3)));
      }
      for (const Pose& pose : poses)
      {
        for (const HandlePose& handle : pose)
        {
          EXPECT_TRUE(!moderate || (handle.transform.allFinite() && handle.stretch > 0.0));
        }
      }
      // Poses that were read successfully can be written and read again.
      std::string again;
      const Status formatted = format_pose_file(poses, sequence.frames_per_second, handles, again);
      test::expect_valid_messages(formatted);
      EXPECT_TRUE(formatted.ok() || !moderate);
      if (formatted.ok())
      {
        PoseSequence back;
        const Status reread = parse_pose_file(again, handles, back);
        ASSERT_TRUE(reread.ok()) << reread.message << "\n" << again;
        ASSERT_EQ(back.frames.size(), poses.size());
      }
    });
}

TEST(FuzzReaders, NamesInPoseFiles)
{
  test::fuzz("names of handles", 3000,
    [](test::Random& random)
    {
      Handles handles = named_handles();
      for (Handle& handle : handles)
      {
        handle.name = bytes(random, 12) + handle.name;
      }
      std::string text;
      const Status formatted = format_pose_file({ Pose(3) }, 24.0, handles, text);
      test::expect_valid_messages(formatted);
      if (!formatted.ok())
      {
        return;
      }
      PoseSequence back;
      const Status status = parse_pose_file(text, handles, back);
      ASSERT_TRUE(status.ok()) << status.message;
      EXPECT_EQ(back.frames[0].handles.size(), 3u);
      // Unknown handle names are refused with an error message of one sentence.
      test::expect_valid_messages(parse_pose_file(text, named_handles(), back));
    });
}
