// Requests for pictures that cannot be drawn, and their error messages. Picture files are written
// completely or not at all.
#include "conversion.h"
#include "pictures/picture.h"
#include "support/files.h"
#include "support/meshes.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPNGReader.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
vtkSmartPointer<vtkPolyData> ball()
{
  const TriangleMesh mesh = test::sphere(2);
  auto data = to_polydata(mesh.points, mesh.triangles);
  vtkNew<vtkDoubleArray> weights;
  weights->SetName("Weights");
  weights->SetNumberOfComponents(2);
  weights->SetComponentName(0, "hip");
  weights->SetComponentName(1, "knee");
  weights->SetNumberOfTuples(mesh.points.rows());
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    const double s = 0.5 * (1.0 + mesh.points(v, 1));
    weights->SetTuple2(v, s, 1.0 - s);
  }
  data->GetPointData()->AddArray(weights);
  return data;
}

PictureOptions tiny_options()
{
  PictureOptions options;
  options.width = 64;
  options.height = 48;
  options.supersampling = 1;
  return options;
}

Status try_to_draw(const std::vector<Tile>& tiles, const PictureOptions& options)
{
  vtkSmartPointer<vtkImageData> image;
  const Status status = render_to_image(tiles, options, image);
  EXPECT_EQ(status.ok(), image != nullptr);
  return status;
}
} // namespace

TEST(Picture, NamesWhatThereIsWhenAskedForWhatIsNot)
{
  PictureOptions options = tiny_options();
  options.array = "Wieghts";
  EXPECT_THAT(try_to_draw({ { ball(), nullptr, "" } }, options).message,
    HasSubstr("no array 'Wieghts'; available: Weights"));
  options.array = "Weights";
  options.component = "elbow";
  EXPECT_THAT(try_to_draw({ { ball(), nullptr, "" } }, options).message,
    HasSubstr("no component 'elbow'; available: hip, knee"));
  options.component = "2";
  EXPECT_EQ(try_to_draw({ { ball(), nullptr, "" } }, options).code, StatusCode::invalid_input);
  options.array = "";
  options.component = "hip";
  EXPECT_EQ(try_to_draw({ { ball(), nullptr, "" } }, options).code, StatusCode::invalid_input);
}

TEST(Picture, ReportsWhatIsShown)
{
  PictureOptions options = tiny_options();
  options.array = "Weights";
  options.component = "1";
  const Status status = try_to_draw({ { ball(), nullptr, "" } }, options);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(status.report.text("picture.component"), "knee");
  EXPECT_EQ(status.report.number("picture.width", 0), 64);
}

TEST(Picture, RefusesWhatCannotBeDrawn)
{
  PictureOptions options = tiny_options();
  EXPECT_EQ(try_to_draw({}, options).code, StatusCode::invalid_input);
  const auto empty = vtkSmartPointer<vtkPolyData>::New();
  EXPECT_THAT(try_to_draw({ { empty, nullptr, "" } }, options).message, HasSubstr("empty"));
  EXPECT_THAT(try_to_draw({ { nullptr, nullptr, "" } }, options).message, HasSubstr("empty"));
  const auto broken = ball();
  broken->GetPoints()->SetPoint(3, 0.0, std::numeric_limits<double>::quiet_NaN(), 0.0);
  EXPECT_THAT(try_to_draw({ { broken, nullptr, "" } }, options).message, HasSubstr("not finite"));
  options.width = 0;
  EXPECT_THAT(try_to_draw({ { ball(), nullptr, "" } }, options).message, HasSubstr("8192"));
  options = tiny_options();
  options.view.up = "w";
  EXPECT_THAT(try_to_draw({ { ball(), nullptr, "" } }, options).message, HasSubstr("up"));
  options = tiny_options();
  options.view.zoom = 0.0;
  EXPECT_THAT(try_to_draw({ { ball(), nullptr, "" } }, options).message, HasSubstr("zoom"));
  options = tiny_options();
  options.section = 2.0;
  EXPECT_THAT(try_to_draw({ { ball(), nullptr, "" } }, options).message, HasSubstr("section"));
}

TEST(Picture, DrawsEveryKindOfData)
{
  const TetMesh box = test::tet_box(2, 2, 2);
  const auto tets = to_unstructured_grid(box.points, box.tets);
  vtkNew<vtkDoubleArray> volumes;
  volumes->SetName("Volume");
  for (Index t = 0; t < box.tets.rows(); ++t)
  {
    volumes->InsertNextValue(static_cast<double>(t));
  }
  tets->GetCellData()->AddArray(volumes);
  PictureOptions options = tiny_options();
  options.array = "Volume";
  EXPECT_TRUE(try_to_draw({ { tets, nullptr, "" } }, options).ok());
  options.array = "";
  const auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(to_vtk_points(box.points));
  EXPECT_TRUE(try_to_draw({ { cloud, nullptr, "" } }, options).ok());
  Handles handles(1);
  handles[0].name = "only";
  EXPECT_TRUE(try_to_draw({ { to_polydata(handles), nullptr, "" } }, options).ok());
  const auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(4, 5, 1);
  image->AllocateScalars(VTK_DOUBLE, 1);
  image->GetPointData()->GetScalars()->SetName("height");
  image->GetPointData()->GetScalars()->Fill(1.0);
  EXPECT_TRUE(try_to_draw({ { image, nullptr, "" } }, options).ok());
  // Only the first of two tiles has the array. The dataset of the second tile is drawn without
  // colors.
  options.array = "Weights";
  EXPECT_TRUE(try_to_draw({ { ball(), nullptr, "a" }, { cloud, nullptr, "b" } }, options).ok());
}

TEST(Picture, TetsAreColoredByWhatTheyHave)
{
  const TetMesh box = test::tet_box(2, 2, 2);
  const auto tets = to_unstructured_grid(box.points, box.tets);
  const Tile tile{ tets, nullptr, "" };
  const auto refused = [&](const PictureOptions& options, const Tile& drawn_tile)
  {
    const Status status = try_to_draw({ drawn_tile }, options);
    EXPECT_EQ(status.code, StatusCode::invalid_input);
    EXPECT_EQ(status.message.find('\n'), std::string::npos);
    return status.message;
  };
  PictureOptions options = tiny_options();
  options.color_by = ColorBy::label;
  EXPECT_THAT(refused(options, tile), HasSubstr("no cell array 'Label'"));
  options.color_by = ColorBy::method;
  EXPECT_THAT(refused(options, tile), HasSubstr("no field data array 'Method'"));
  options.color_by = ColorBy::winding_number;
  EXPECT_THAT(refused(options, tile), HasSubstr("no array 'WindingNumber'"));
  options.color_by = ColorBy::quality;
  EXPECT_THAT(refused(options, { ball(), nullptr, "" }), HasSubstr("need tets"));
  const Status drawn = try_to_draw({ tile, { ball(), nullptr, "" } }, options);
  EXPECT_TRUE(drawn.ok()) << drawn.message;
  EXPECT_EQ(drawn.report.text("picture.array"), "quality");
  options.array = "Weights";
  EXPECT_THAT(refused(options, tile), HasSubstr("can only be given when coloring by array"));

  vtkNew<vtkIntArray> labels;
  labels->SetName("Label");
  for (Index t = 0; t < box.tets.rows(); ++t)
  {
    labels->InsertNextValue(t == 7 ? 2 : 1);
  }
  tets->GetCellData()->AddArray(labels);
  options = tiny_options();
  options.color_by = ColorBy::label;
  const Status labeled = try_to_draw({ tile }, options);
  ASSERT_TRUE(labeled.ok()) << labeled.message;
  const auto* counts = labeled.report.find("picture.colors[].count");
  ASSERT_NE(counts, nullptr);
  EXPECT_EQ(std::get<std::vector<std::int64_t>>(*counts),
    (std::vector<std::int64_t>{ box.tets.rows() - 1, 1 }));
  labels->SetValue(3, 5);
  EXPECT_THAT(refused(options, tile), HasSubstr("'Label' of cell 3 is 5"));
}

TEST(Picture, SectionsAndSizesThatLeaveNothing)
{
  const TetMesh box = test::tet_box(2, 2, 2);
  const Tile tile{ to_unstructured_grid(box.points, box.tets), nullptr, "" };
  PictureOptions options = tiny_options();
  options.section_plane = Plane{ Vec3(0, 0, -3), Vec3(0, 0, 1) };
  EXPECT_THAT(try_to_draw({ tile }, options).message, HasSubstr("removes all tets"));
  options.section_plane = Plane{ Vec3(0, 0, 0.5), Vec3(0, 0, 0) };
  EXPECT_THAT(try_to_draw({ tile }, options).message, HasSubstr("plane"));
  options.section_plane = Plane{ Vec3(0, 0, 0.5), Vec3(0, 0, 1) };
  EXPECT_THAT(
    try_to_draw({ { ball(), nullptr, "" } }, options).message, HasSubstr("needs tets or a volume"));
  const Status half = try_to_draw({ tile }, options);
  ASSERT_TRUE(half.ok()) << half.message;
  EXPECT_EQ(half.report.number("picture.tets", -1), box.tets.rows() / 2);
  for (const double size : { 0.0, -1.0, 1.5, std::numeric_limits<double>::quiet_NaN() })
  {
    options = tiny_options();
    options.shrink = size;
    EXPECT_THAT(try_to_draw({ tile }, options).message, HasSubstr("shrunk"));
  }
  options.shrink = 0.5;
  EXPECT_THAT(
    try_to_draw({ { ball(), nullptr, "" } }, options).message, HasSubstr("shrinking needs tets"));
}

TEST(Picture, FilesAppearWholeOrNotAtAll)
{
  const test::Folder folder;
  const std::string path = folder / "ball.png";
  ASSERT_TRUE(render_to_png({ { ball(), nullptr, "" } }, tiny_options(), path).ok());
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  int size[3];
  reader->GetOutput()->GetDimensions(size);
  EXPECT_EQ(size[0], 64);
  EXPECT_EQ(size[1], 48);
  const Status again = render_to_png({ { ball(), nullptr, "" } }, tiny_options(), path);
  EXPECT_EQ(again.code, StatusCode::invalid_input);
  EXPECT_TRUE(render_to_png({ { ball(), nullptr, "" } }, tiny_options(), path, true).ok());
  const Status nowhere =
    render_to_png({ { ball(), nullptr, "" } }, tiny_options(), folder / "no/such/ball.png");
  EXPECT_EQ(nowhere.code, StatusCode::invalid_input);
  EXPECT_THAT(nowhere.message, HasSubstr("no/such"));
  EXPECT_EQ(folder.number_of_files(), 1u);
}
