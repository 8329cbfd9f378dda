// The mesh formats OFF, OBJ, PLY and MEDIT. Round trips preserve all bits, and the dialects of
// other programs are accepted. For any other input, the reader returns an error message with the
// line number and never crashes.
#include "io/medit.h"
#include "io/obj.h"
#include "io/off.h"
#include "io/ply.h"
#include "io/stl.h"
#include "io/text_scanner.h"

#include "support/files.h"
#include "support/meshes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <clocale>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
using Read = Status (*)(const std::string&, PolygonMesh&);
using Write = Status (*)(const std::string&, const PolygonMesh&);

struct Format
{
  const char* extension;
  Read read;
  Write write;

  /// Print the extension of the format. GoogleTest and CTest show it as the parameter of a test.
  friend void PrintTo(const Format& format, std::ostream* out) { *out << format.extension; }
};

class PolygonFiles : public testing::TestWithParam<Format>
{
protected:
  test::Folder folder;
};

/// Return a mesh whose coordinates survive a round trip only if the writer prints enough digits.
PolygonMesh awkward_mesh()
{
  PolygonMesh mesh = to_polygons(
    test::sphere(2, 1.0 / 3.0, Vec3(1e6, -1e-9, 1e-300)).points, test::sphere(2).triangles);
  mesh.corners.insert(mesh.corners.end(), { 0, 1, 2, 3, 4 });
  mesh.end_polygon();
  return mesh;
}
} // namespace

TEST_P(PolygonFiles, ReadBackWhatWasWritten)
{
  const PolygonMesh mesh = awkward_mesh();
  const std::string path = this->folder / "mesh.x";
  ASSERT_TRUE(GetParam().write(path, mesh).ok());
  PolygonMesh reread;
  const Status status = GetParam().read(path, reread);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(reread.points, mesh.points);
  EXPECT_EQ(reread.offsets, mesh.offsets);
  EXPECT_EQ(reread.corners, mesh.corners);
}

TEST_P(PolygonFiles, EveryTruncationIsAnErrorOrAMesh)
{
  ASSERT_TRUE(
    GetParam()
      .write(this->folder / "whole", to_polygons(test::cube().points, test::cube().triangles))
      .ok());
  const std::string whole = this->folder.read("whole");
  for (std::size_t size = 0; size < whole.size(); ++size)
  {
    PolygonMesh mesh;
    const Status status = GetParam().read(this->folder.write("part", whole.substr(0, size)), mesh);
    if (status.ok())
    {
      // A truncated file is accepted in two cases: only digits of the last value are missing, or
      // the format has no counts and whole faces are missing.
      for (const Index corner : mesh.corners)
      {
        EXPECT_LT(corner, mesh.points.rows());
      }
      continue;
    }
    EXPECT_EQ(status.code, StatusCode::invalid_input);
    EXPECT_THAT(status.message, HasSubstr("part"));
    EXPECT_EQ(mesh.points.rows(), 0);
  }
}

TEST_P(PolygonFiles, GarbledBytesNeverCrash)
{
  ASSERT_TRUE(
    GetParam()
      .write(this->folder / "whole", to_polygons(test::cube().points, test::cube().triangles))
      .ok());
  const std::string whole = this->folder.read("whole");
  test::Random random(7);
  for (int round = 0; round < 2000; ++round)
  {
    std::string text = whole;
    for (int k = 0; k < 4; ++k)
    {
      text[random.below(static_cast<Index>(text.size()))] =
        static_cast<char>(random.below(round % 2 ? 256 : 64));
    }
    PolygonMesh mesh;
    const Status status = GetParam().read(this->folder.write("garbled", text), mesh);
    EXPECT_TRUE(status.ok() || !status.message.empty());
    for (const Index corner : mesh.corners)
    {
      ASSERT_TRUE(corner >= 0 && corner < mesh.points.rows());
    }
  }
}

TEST_P(PolygonFiles, MissingFolderAndEmptyFilesAreNamed)
{
  PolygonMesh mesh;
  EXPECT_THAT(GetParam().read(this->folder / "none", mesh).message, HasSubstr("No such file"));
  EXPECT_THAT(GetParam().read(this->folder.path(), mesh).message, HasSubstr("directory"));
  EXPECT_THAT(GetParam().read(this->folder.write("e", ""), mesh).message, HasSubstr("is empty"));
  EXPECT_THAT(GetParam().write(this->folder / "no/such", mesh).message, HasSubstr("cannot write"));
  EXPECT_THAT(GetParam().write("/dev/full", awkward_mesh()).message, HasSubstr("No space left"));
}

INSTANTIATE_TEST_SUITE_P(Formats, PolygonFiles,
  testing::Values(Format{ "off", read_off, write_off }, Format{ "obj", read_obj, write_obj },
    Format{ "ply", read_ply, write_ply }));

namespace
{
class TextFiles : public testing::Test
{
protected:
  std::string off_error(const std::string& text)
  {
    return read_off(this->folder.write("m.off", text), this->mesh).message;
  }
  std::string medit_error(const std::string& text)
  {
    return read_medit(this->folder.write("m.mesh", text), this->medit).message;
  }
  test::Folder folder;
  PolygonMesh mesh;
  MeditMesh medit;
};

const std::string square_points = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
} // namespace

TEST_F(TextFiles, OffVariantsOfTheWild)
{
  const Points corners = (Points(4, 3) << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0).finished();
  for (const std::string& text : { "OFF\n4 2 0\n" + square_points + "3 0 1 2\n3 0 2 3\n",
         // The vertex and face counts are on the first line.
         "OFF 4 2 5\n" + square_points + "3 0 1 2\n3 0 2 3\n",
         // The edge count and the last newline are missing.
         "OFF\n4 2\n" + square_points + "3 0 1 2\n3 0 2 3",
         "# made by hand\nOFF # really\n\n4 2 0 # counts\n" + square_points +
           "3 0 1 2 # lower\n3 0 2 3\n",
         std::string("COFF\r\n4 2 0\r\n0 0 0 255 0 0 255\r\n1 0 0 0 0 0 0\r\n1 1 0 1 1 1 1\r\n"
                     "0 1 0 1 1 1 1\r\n3 0 1 2\r\n3 0 2 3\r\n"),
         std::string("NOFF\n4 2 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n"
                     "3 0 2 3\n"),
         std::string("STCNOFF\n4 2 0\n0 0 0 0 0 1 0 0 0 0 .5 .5\n1 0 0 0 0 1 0 0 0 0 1 1\n"
                     "1 1 0 0 0 1 0 0 0 0 .5 .5\n0 1 0 0 0 1 0 0 0 0 1 1\n3 0 1 2\n3 0 2 3\n"),
         "OFF\n4 2 0\n" + square_points + "3 0 1 2 255 0 0\n3 0 2 3 0.5 0.5 0.5\ntrailing words\n",
         "\xef\xbb\xbfOFF\n4 2 0\n" + square_points + "3 0 1 2\n3 0 2 3\n",
         // The face with two corners is skipped.
         "OFF\n4 3 0\n" + square_points + "3 0 1 2\n2 0 1\n3 0 2 3\n" })
  {
    ASSERT_EQ(this->off_error(text), "") << text;
    EXPECT_EQ(this->mesh.points, corners);
    EXPECT_EQ(this->mesh.corners, (std::vector<Index>{ 0, 1, 2, 0, 2, 3 }));
    EXPECT_EQ(fan_triangles(this->mesh).rows(), 2);
  }
  EXPECT_EQ(this->mesh.skipped, 1);
  ASSERT_EQ(this->off_error("OFF\n4 1 0\n" + square_points + "4 0 1 2 3\n"), "");
  const Triangles fan = fan_triangles(this->mesh);
  EXPECT_EQ(fan, (Triangles(2, 3) << 0, 1, 2, 0, 2, 3).finished());
}

TEST_F(TextFiles, OffErrorsNameTheLine)
{
  EXPECT_THAT(this->off_error("hello world\n"),
    HasSubstr("m.off, line 1: an OFF file must begin with the word OFF"));
  EXPECT_THAT(this->off_error("OFF BINARY\n1 1 1\n"), HasSubstr("binary"));
  EXPECT_THAT(this->off_error("4OFF\n1 1 1\n"), HasSubstr("not three-dimensional"));
  EXPECT_THAT(this->off_error("OFF\n-3 1 0\n"), HasSubstr("line 2"));
  EXPECT_THAT(this->off_error("OFF\n4 x 0\n" + square_points), HasSubstr("'x'"));
  EXPECT_THAT(this->off_error("OFF\n4 1 0\n0 0 0\n1 nan 0\n1 1 0\n0 1 0\n3 0 1 2\n"),
    HasSubstr("line 4: a vertex coordinate is not a finite number: 'nan'"));
  EXPECT_THAT(this->off_error("OFF\n4 1 0\n0 0 0\n1 1e999 0\n1 1 0\n0 1 0\n3 0 1 2\n"),
    HasSubstr("line 4: a vertex coordinate is not a finite number"));
  EXPECT_THAT(
    this->off_error("OFF\n4 1 0\n0 0 0\n1 0,5 0\n1 1 0\n0 1 0\n3 0 1 2\n"), HasSubstr("line 4"));
  EXPECT_THAT(this->off_error("OFF\n4 1 0\n" + square_points + "3 0 1 4\n"),
    HasSubstr("line 7: a vertex id of a face is out of range: '4'"));
  EXPECT_THAT(this->off_error("OFF\n4 1 0\n" + square_points + "3 0 1 -1\n"), HasSubstr("line 7"));
  EXPECT_THAT(this->off_error("OFF\n4 2 0\n" + square_points + "3 0 1 2\n"),
    HasSubstr("unexpected end of file"));
  EXPECT_THAT(this->off_error("OFF\n1000000000 2 0\n" + square_points), HasSubstr("truncated"));
  EXPECT_THAT(
    this->off_error("OFF\n4 99999999999999999999 0\n" + square_points), HasSubstr("line 2"));
}

TEST_F(TextFiles, ObjCornersIdsAndErrors)
{
  const auto read = [this](const std::string& text)
  { return read_obj(this->folder.write("m.obj", text), this->mesh).message; };
  ASSERT_EQ(read("# cube\nmtllib a.mtl\nv 0 0 0 1.0\nv 1 0 0\nvt 0 0\nvn 0 0 1\nv 1 1 0\n"
                 "f 1/1/1 2//1 3/1\nv 0 1 0\nf -4 -2 -1\nl 1 2\n"),
    "");
  EXPECT_EQ(this->mesh.corners, (std::vector<Index>{ 0, 1, 2, 0, 2, 3 }));
  EXPECT_EQ(this->mesh.points.rows(), 4);
  // The text begins with a byte order mark, and a backslash continues a face on the next line.
  ASSERT_EQ(read("\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                 "f 1/1 \\\r\n 2/2\\\n3/3 4/4\nf 1 2 3\n"),
    "");
  EXPECT_EQ(this->mesh.points.rows(), 4);
  EXPECT_EQ(this->mesh.corners, (std::vector<Index>{ 0, 1, 2, 3, 0, 1, 2 }));
  EXPECT_THAT(
    read("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 \\ 2 3\n"), HasSubstr("line 4: expected a vertex id"));
  EXPECT_THAT(read("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 \\"), HasSubstr("0 faces"));
  EXPECT_THAT(read("v 0 0 0\nv 1 0 0\nv 1 inf 0\nf 1 2 3\n"), HasSubstr("m.obj, line 3"));
  EXPECT_THAT(read("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 0\n"), HasSubstr("line 4"));
  EXPECT_THAT(read("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 7\n"), HasSubstr("vertex 7"));
  EXPECT_THAT(read("v 0 0 0\nf a b c\n"), HasSubstr("line 2"));
  EXPECT_THAT(read("v 0 0 0\n"), HasSubstr("0 faces"));
}

TEST_F(TextFiles, ObjLooksOfFaces)
{
  const std::string path = this->folder.write("m.obj",
    "mtllib my colors.mtl\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 1\n"
    "vt 0 0.25\nvt 1\nvn 0 0 1\n"
    "f 1/1/1 2/2/1 3/-1/-1\n"
    "o box\nusemtl dark red\nf 1//1 3/1 4\n"
    "g lid\nf 1/7/1 2/0 3/x\n" // texture coordinates that do not exist
    "o ball\ng\nusemtl blue\nf 1/3 2/3 3/3\nvt 0.5 0.5\nf 1 2\n"
    "o box\ng lid\nusemtl dark red\nf 2/3/1 3/3/1 4/3/1\n");
  MeshLook look;
  const Status status = read_obj(path, this->mesh, look);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(this->mesh.polygon_count(), 5);
  EXPECT_EQ(this->mesh.skipped, 1);
  EXPECT_EQ(look.libraries, std::vector<std::string>{ "my colors.mtl" });
  EXPECT_EQ(look.material_names, (std::vector<std::string>{ "dark red", "blue" }));
  EXPECT_EQ(look.part_names, (std::vector<std::string>{ "", "box", "box lid", "ball" }));
  EXPECT_EQ(look.materials, (std::vector<Index>{ -1, 0, 0, 1, 0 }));
  EXPECT_EQ(look.parts, (std::vector<Index>{ 0, 1, 2, 3, 2 }));
  EXPECT_EQ(
    look.texture_ids, (std::vector<Index>{ 0, 1, 1, -1, 0, -1, -1, -1, -1, 2, 2, 2, 2, 2, 2 }));
  EXPECT_EQ(
    look.normal_ids, (std::vector<Index>{ 0, 0, 0, 0, -1, -1, 0, -1, -1, -1, -1, -1, 0, 0, 0 }));
  EXPECT_EQ(look.texture, (decltype(look.texture)(3, 2) << 0, 0.25, 1, 0, 0.5, 0.5).finished());
  EXPECT_EQ(look.normals, (Points(1, 3) << 0, 0, 1).finished());
  EXPECT_EQ(look.colors.row(3), Eigen::RowVector3d(1, 1, 1));
  ASSERT_EQ(status.warnings.size(), 1u);
  EXPECT_THAT(status.warnings[0], HasSubstr("3 corners of faces reference"));
  EXPECT_THAT(
    read_obj(this->folder.write("n.obj", "v 0 0 0\nvn 0 x 1\n"), this->mesh, look).message,
    HasSubstr("line 2"));
}

TEST_F(TextFiles, PlyAsciiAndBigEndian)
{
  ASSERT_EQ(read_ply(this->folder.write("a.ply",
                       "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 3\n"
                       "property float x\nproperty float y\nproperty float z\n"
                       "property uchar red\nelement face 1\nproperty uchar flag\n"
                       "property list uchar int vertex_indices\nelement other 1\n"
                       "property list uchar float stuff\nend_header\n"
                       "0 0 0 255\n1 0 0 255\n0 1 0.1 255\n7 3 0 1 2\n2 0.5 0.5\n"),
              this->mesh)
              .message,
    "");
  EXPECT_EQ(this->mesh.points(2, 2), 0.1); // text is parsed as double, whatever type is declared
  EXPECT_EQ(this->mesh.corners, (std::vector<Index>{ 0, 1, 2 }));

  std::string text = "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty float x\n"
                     "property float y\nproperty float z\nelement face 1\n"
                     "property list uchar ushort vertex_index\nend_header\n";
  for (const char* value : { "\0\0\0\0", "\0\0\0\0", "\0\0\0\0", "\x3f\x80\0\0", "\0\0\0\0",
         "\0\0\0\0", "\0\0\0\0", "\x3f\x80\0\0", "\xc0\0\0\0" })
  {
    text.append(value, 4);
  }
  text.append("\3\0\0\0\1\0\2", 7);
  ASSERT_EQ(read_ply(this->folder.write("b.ply", text), this->mesh).message, "");
  EXPECT_EQ(this->mesh.points, (Points(3, 3) << 0, 0, 0, 1, 0, 0, 0, 1, -2).finished());
  EXPECT_EQ(this->mesh.corners, (std::vector<Index>{ 0, 1, 2 }));
}

TEST_F(TextFiles, PlyHeadersThatContradictThemselves)
{
  const std::string vertex = "\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string face = "element face 0\nproperty list uchar int vertex_indices\nend_header\n";
  std::string numbers;
  for (int k = 0; k < 100; ++k)
  {
    numbers += "1 2 3\n";
  }
  // The header declares the element "vertex" twice. The arrays are allocated for the first count,
  // which the second count must not replace.
  EXPECT_THAT(read_ply(this->folder.write("t.ply",
                         "ply\nformat ascii 1.0\nelement vertex 90" + vertex + "element vertex 2" +
                           vertex + face + numbers),
                this->mesh)
                .message,
    HasSubstr("t.ply, line 13: the header has two elements vertex"));
}

TEST_F(TextFiles, PlyLooksOfFaces)
{
  const std::string vertices = "element vertex 4\nproperty double x\nproperty double y\n"
                               "property double z\nproperty float nx\nproperty float ny\n"
                               "property float nz\nproperty uchar red\nproperty uchar green\n"
                               "property uchar blue\nproperty uchar alpha\nproperty float s\n"
                               "property float t\n";
  const std::string rows = "0 0 0 0 0 1 255 0 51 255 0.25 0.5\n1 0 0 0 0 1 0 0 0 0 1 0\n"
                           "1 1 0 0 1 0 0 0 0 0 1 1\n0 1 0 0 1 0 0 0 0 0 nan 1\n";
  const auto read = [this](const std::string& text)
  {
    MeshLook look;
    const Status status = read_ply(this->folder.write("m.ply", text), this->mesh, look);
    EXPECT_TRUE(status.ok()) << status.message;
    return look;
  };
  const MeshLook by_vertex = read("ply\nformat ascii 1.0\ncomment TextureFile my wood.png\n" +
    vertices + "element face 3\nproperty list uchar int vertex_indices\nend_header\n" + rows +
    "3 0 1 2\n2 0 1\n4 0 1 2 3\n");
  EXPECT_EQ(by_vertex.picture, "my wood.png");
  EXPECT_EQ(by_vertex.material_names, std::vector<std::string>{ "texture" });
  EXPECT_EQ(by_vertex.materials, (std::vector<Index>{ 0, 0 }));
  EXPECT_EQ(by_vertex.parts, (std::vector<Index>{ 0, 0 }));
  EXPECT_EQ(by_vertex.texture_ids, this->mesh.corners);
  EXPECT_EQ(by_vertex.normal_ids, this->mesh.corners);
  EXPECT_EQ(by_vertex.texture.row(0), Eigen::RowVector2d(0.25, 0.5));
  EXPECT_EQ(by_vertex.texture.row(3), Eigen::RowVector2d(0, 1)); // NaN becomes 0
  EXPECT_EQ(by_vertex.normals.row(2), Eigen::RowVector3d(0, 1, 0));
  EXPECT_LT((by_vertex.colors.row(0) - Eigen::RowVector3d(1, 0, 0.2)).norm(), 1e-15);
  // MeshLab stores texture coordinates per corner.
  const MeshLook by_corner = read("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                                  "property float y\nproperty float z\nelement face 3\n"
                                  "property list uchar int vertex_indices\n"
                                  "property list uchar float texcoord\nend_header\n"
                                  "0 0 0\n1 0 0\n0 1 0\n"
                                  "3 0 1 2 6 0 0 1 0 0 1\n2 0 1 4 9 9 9 9\n3 2 1 0 0\n");
  EXPECT_EQ(by_corner.texture_ids, (std::vector<Index>{ 0, 1, 2, -1, -1, -1 }));
  EXPECT_EQ(by_corner.texture.row(1), Eigen::RowVector2d(1, 0));
  EXPECT_EQ(by_corner.colors.rows() + by_corner.normals.rows(), 0);
  EXPECT_EQ(by_corner.materials, (std::vector<Index>{ -1, -1 }));
}

TEST_F(TextFiles, StlIsWeldedAndSizedExactly)
{
  const TriangleMesh torus = test::torus(20, 10, 1.0, 0.25);
  ASSERT_TRUE(write_stl(this->folder / "t.stl", to_polygons(torus.points, torus.triangles)).ok());
  ASSERT_EQ(read_stl(this->folder / "t.stl", this->mesh).message, "");
  EXPECT_EQ(this->mesh.points.rows(), torus.points.rows());
  const Triangles triangles = fan_triangles(this->mesh);
  EXPECT_TRUE(count_edges(triangles).closed);
  EXPECT_NEAR(signed_volume(this->mesh.points, triangles),
    signed_volume(torus.points, torus.triangles), 1e-6);
  const std::string whole = this->folder.read("t.stl");
  EXPECT_THAT(
    read_stl(this->folder.write("p.stl", whole.substr(0, whole.size() - 1)), this->mesh).message,
    HasSubstr("p.stl is not a valid STL file"));
  ASSERT_EQ(read_stl(this->folder.write("p.stl", whole + "more"), this->mesh).message, "");
  EXPECT_EQ(fan_triangles(this->mesh), triangles);

  const std::string text =
    "solid my vertex\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
    "vertex 0 1 -0.0\nendloop\nendfacet\nfacet normal 0 0 1\n outer loop\n vertex 1 0 0\n"
    "vertex 1 1 0.1\nvertex 0 1 0\nendloop\nendfacet\nendsolid my vertex\n";
  ASSERT_EQ(read_stl(this->folder.write("a.stl", text), this->mesh).message, "");
  EXPECT_EQ(this->mesh.corners, (std::vector<Index>{ 0, 1, 2, 1, 3, 2 }));
  EXPECT_EQ(this->mesh.points(3, 2), 0.1);
  // The text has two solids, upper-case letters, and lines that end with CR.
  std::string other = text + "solid vertex 1 2 3\nendsolid\n";
  std::transform(other.begin(), other.end(), other.begin(),
    [](unsigned char c) { return static_cast<char>(c == '\n' ? '\r' : std::toupper(c)); });
  ASSERT_EQ(read_stl(this->folder.write("a.stl", other), this->mesh).message, "");
  EXPECT_EQ(this->mesh.corners, (std::vector<Index>{ 0, 1, 2, 1, 3, 2 }));
  const auto error = [this](const std::string& broken)
  { return read_stl(this->folder.write("b.stl", broken), this->mesh).message; };
  EXPECT_THAT(error(text.substr(0, 120)), HasSubstr("b.stl, line"));
  EXPECT_THAT(error("solid x\nendsolid x\n"), HasSubstr("no triangle"));
  EXPECT_THAT(error("solid x\nvertex 0 nan 0\n"), HasSubstr("line 2"));
}

TEST_F(TextFiles, StlRefusesCoordinatesOutOfFloatRange)
{
  TriangleMesh cube = test::cube();
  cube.points(3, 1) = 1e39;
  EXPECT_THAT(write_stl(this->folder / "l.stl", to_polygons(cube.points, cube.triangles)).message,
    HasSubstr("coordinate y of point 3 is 1e+39; single precision allows at most 3.4e38"));
  cube = test::cube();
  cube.points *= 1e-60;
  EXPECT_THAT(write_stl(this->folder / "l.stl", to_polygons(cube.points, cube.triangles)).message,
    HasSubstr("single precision resolves only"));
}

TEST_F(TextFiles, MeditReadsTetsAndSkipsTheRest)
{
  ASSERT_EQ(this->medit_error("MeshVersionFormatted 2\nDimension\n3\n# comment\nVertices\n4\n"
                              "0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 1\nEdges\n1\n1 2 0\n"
                              "Tetrahedra\n1\n1 2 3 4 9\nCorners 2\n1\n2\n"
                              "Triangles\n1\n1 3 2 0\nEnd\nwhatever\n"),
    "");
  EXPECT_EQ(this->medit.tets, (Tets(1, 4) << 0, 1, 2, 3).finished());
  EXPECT_EQ(this->medit.triangles, (Triangles(1, 3) << 0, 2, 1).finished());
  EXPECT_THAT(this->medit_error("OFF\n1 2 3\n"), HasSubstr("MeshVersionFormatted"));
  EXPECT_THAT(this->medit_error("MeshVersionFormatted 1\nDimension 3\nVertices\n2\n0 0 0 0\n1 nan"),
    HasSubstr("line 6"));
  EXPECT_THAT(this->medit_error("MeshVersionFormatted 1\nDimension 3\nVertices\n1\n0 0 0 0\n"
                                "Tetrahedra\n1\n1 1 1 2 0\nEnd\n"),
    HasSubstr("tet 1 references vertex 2"));
  EXPECT_THAT(
    this->medit_error("MeshVersionFormatted 1\nDimension 3\nEnd\n"), HasSubstr("no vertices"));
}

TEST_F(TextFiles, MeditReadsBackWhatWasWritten)
{
  const TetMesh box = test::tet_box(3, 2, 1, Vec3(1e-7, 0, 1), Vec3(1.0 / 3, 2, 1e9));
  const Triangles boundary = boundary_triangles(box.tets);
  ASSERT_TRUE(write_medit(this->folder / "b.mesh", box.points, boundary, box.tets).ok());
  ASSERT_TRUE(read_medit(this->folder / "b.mesh", this->medit).ok());
  EXPECT_EQ(this->medit.points, box.points);
  EXPECT_EQ(this->medit.tets, box.tets);
  EXPECT_EQ(this->medit.triangles, boundary);
}

TEST_F(TextFiles, NumbersHaveAPointInEveryLocale)
{
  const std::string before = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_ALL, "de_DE.UTF-8"); // has no effect if the locale is not installed
  double value = 0;
  EXPECT_TRUE(parse_number("+1.5e-3", value));
  EXPECT_EQ(value, 1.5e-3);
  std::string text;
  append_number(text, 0.1);
  EXPECT_EQ(text, "0.1");
  std::setlocale(LC_ALL, before.c_str());
  EXPECT_TRUE(parse_number("1e-400", value));
  EXPECT_EQ(value, 0.0);
  EXPECT_TRUE(parse_number("-1e400", value));
  EXPECT_EQ(value, -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(parse_number(std::string(400, '9') + "e-1", value));
  EXPECT_EQ(value, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(parse_number("-0." + std::string(400, '0') + "1e+5", value));
  EXPECT_EQ(value, 0.0);
  EXPECT_TRUE(parse_number("1e99999999999", value));
  EXPECT_EQ(value, std::numeric_limits<double>::infinity());
  for (const char* word : { "", "+", "+-1", "1,5", "0x10", "1e", "one", "1 " })
  {
    EXPECT_FALSE(parse_number(word, value)) << word;
  }
}
