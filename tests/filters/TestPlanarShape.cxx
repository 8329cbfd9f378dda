// vtkPlanarShape triangulates images and the regions inside of planar curves. The shape of an image
// is the region that its alpha channel selects, or the whole rectangle. Handles become vertices.
// The tests also cover arrays, report, errors and repeated updates.
#include "TestFilter.h"

#include "conversion.h"
#include "report_field_data.h"
#include "support/environment.h"
#include "support/needs_mesher.h"
#include "vtkPlanarShape.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkErrorCode.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <optional>
#include <sstream>

using namespace bindpose;
using bindpose::test::Listener;
using testing::HasSubstr;

namespace
{
constexpr double radius = 20.0;

/// Return an RGBA image of a disc around the pixel (40, 30), with spacing 0.5, origin (100, 200)
/// and z = 3.
vtkSmartPointer<vtkImageData> disc()
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(80, 60, 1);
  image->SetSpacing(0.5, 0.5, 1.0);
  image->SetOrigin(100.0, 200.0, 3.0);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  for (int y = 0; y < 60; ++y)
  {
    for (int x = 0; x < 80; ++x)
    {
      auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer(x, y, 0));
      pixel[0] = pixel[1] = pixel[2] = 100;
      pixel[3] = std::hypot(x - 40.0, y - 30.0) < radius ? 255 : 0;
    }
  }
  return image;
}

vtkSmartPointer<vtkPolyData> polyline(const std::vector<Vec3>& corners, bool closed)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell(static_cast<int>(corners.size()) + closed);
  for (const Vec3& p : corners)
  {
    lines->InsertCellPoint(points->InsertNextPoint(p.data()));
  }
  if (closed)
  {
    lines->InsertCellPoint(0);
  }
  data->SetPoints(points);
  data->SetLines(lines);
  return data;
}

const std::vector<Vec3> square_corners{ { 0, 0, 7 }, { 2, 0, 7 }, { 2, 2, 7 }, { 0, 2, 7 } };

double area_of(vtkDataSet* data)
{
  SurfaceInput surface;
  const Status status = to_surface(data, surface);
  EXPECT_TRUE(status.ok()) << status.message;
  return status.ok() ? surface_area(surface.points.view(), surface.triangles.view()) : 0.0;
}

class PlanarShapeFilter : public test::MesherTest
{
protected:
  void update(int expected = vtkPlanarShape::OK)
  {
    filter->Update();
    ASSERT_EQ(filter->GetStatus(), expected) << filter->GetStatusMessage();
  }
  void expect_error(vtkDataObject* input, const std::string& words)
  {
    vtkNew<vtkPlanarShape> strict;
    vtkNew<Listener> listener;
    listener->listen(strict);
    strict->SetInputDataObject(0, input);
    strict->Update();
    EXPECT_EQ(strict->GetStatus(), vtkPlanarShape::INVALID_INPUT);
    EXPECT_THAT(strict->GetStatusMessage(), HasSubstr(words));
    EXPECT_NE(strict->GetErrorCode(), vtkErrorCode::NoError);
    EXPECT_EQ(strict->GetOutput()->GetNumberOfCells(), 0);
    EXPECT_EQ(read_report(strict->GetOutput()).text("status"), "invalid_input");
  }

  vtkNew<vtkPlanarShape> filter;
};
} // namespace

TEST_F(PlanarShapeFilter, CutOutOfAnImage)
{
  const auto image = disc();
  filter->SetInputData(image);
  update();
  vtkDataSet* out = filter->GetOutput();
  EXPECT_NEAR(area_of(out), M_PI * radius * radius / 4.0, 10.0);
  auto* texture = out->GetPointData()->GetTCoords();
  auto* ids = vtkIdTypeArray::SafeDownCast(out->GetPointData()->GetArray("OriginalPointIds"));
  auto* winding = vtkDoubleArray::SafeDownCast(out->GetCellData()->GetArray("WindingNumber"));
  ASSERT_NE(texture, nullptr);
  EXPECT_STREQ(texture->GetName(), "TCoords");
  ASSERT_NE(ids, nullptr);
  ASSERT_NE(winding, nullptr);
  EXPECT_EQ(winding->GetNumberOfTuples(), out->GetNumberOfCells());
  for (vtkIdType v = 0; v < out->GetNumberOfPoints(); ++v)
  {
    const Vec3 p(out->GetPoint(v));
    EXPECT_EQ(p.z(), 3.0);
    // The texture coordinates of a vertex are those of the pixel at its position.
    ASSERT_NEAR(texture->GetComponent(v, 0) * 80.0 - 0.5, (p.x() - 100.0) / 0.5, 1e-9);
    ASSERT_NEAR(texture->GetComponent(v, 1) * 60.0 - 0.5, (p.y() - 200.0) / 0.5, 1e-9);
    ASSERT_LE(std::hypot(p.x() - 120.0, p.y() - 215.0), (radius + 1.0) * 0.5);
  }
  const Report report = read_report(out);
  EXPECT_EQ(report.text("domain"), "alpha");
  EXPECT_EQ(report.number("counts.triangles", -1), out->GetNumberOfCells());
  EXPECT_EQ(report.number("counts.loops", -1), 1);
  EXPECT_GE(report.number("min_angle", -1), 30.0 - 1e-9);
  EXPECT_NE(filter->GetReport().find("seconds.fill"), nullptr);
}

TEST_F(PlanarShapeFilter, WholeImage)
{
  const auto image = disc();
  filter->SetInputData(image);
  filter->RectangleOn();
  update();
  EXPECT_NEAR(area_of(filter->GetOutput()), 40.0 * 30.0, 1e-9);
  double range[2];
  filter->GetOutput()->GetPointData()->GetTCoords()->GetRange(range, 0);
  EXPECT_EQ(range[0], 0.0);
  EXPECT_EQ(range[1], 1.0);
  EXPECT_EQ(read_report(filter->GetOutput()).text("domain"), "rectangle");
  // An image without an alpha channel gives a rectangle even if the option Rectangle is off. The
  // spacing of this image is 1.
  vtkNew<vtkImageData> gray;
  gray->SetDimensions(80, 60, 1);
  gray->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  filter->RectangleOff();
  filter->SetInputData(gray);
  update();
  EXPECT_NEAR(area_of(filter->GetOutput()), 80.0 * 60.0, 1e-9);
}

TEST_F(PlanarShapeFilter, AlphaOfAnyType)
{
  vtkNew<vtkImageData> image;
  image->SetExtent(5, 14, -3, 6, 2, 2); // this is 10 x 10 pixels
  vtkNew<vtkFloatArray> alpha;
  alpha->SetName("Alpha");
  for (int v = 0; v < 100; ++v)
  {
    alpha->InsertNextValue(v % 10 < 5 ? 1.0f : 0.0f);
  }
  image->GetPointData()->AddArray(alpha);
  filter->SetInputData(image);
  filter->SetSimplify(0.0);
  update();
  EXPECT_NEAR(area_of(filter->GetOutput()), 50.0, 1.0);
  double bounds[6];
  filter->GetOutput()->GetBounds(bounds);
  EXPECT_NEAR(bounds[0], 4.5, 1e-9);
  EXPECT_NEAR(bounds[1], 9.5, 1e-9);
  EXPECT_EQ(bounds[4], 2.0);
}

TEST_F(PlanarShapeFilter, LinesAndPolygons)
{
  filter->SetInputData(polyline(square_corners, false));
  update();
  EXPECT_NEAR(area_of(filter->GetOutput()), 4.0, 1e-12);
  EXPECT_EQ(filter->GetOutput()->GetPoint(0)[2], 7.0);
  vtkNew<vtkPlaneSource> plane; // four adjacent squares
  plane->SetResolution(2, 2);
  filter->SetInputConnection(plane->GetOutputPort());
  update();
  EXPECT_NEAR(area_of(filter->GetOutput()), 1.0, 1e-12);
  auto* ids = filter->GetOutput()->GetPointData()->GetArray("OriginalPointIds");
  for (int v = 0; v < 9; ++v)
  {
    EXPECT_EQ(ids->GetComponent(v, 0), v);
  }
}

TEST_F(PlanarShapeFilter, HandlesAreVertices)
{
  Handles handles(4);
  handles[0].name = "eye";
  handles[0].head = handles[0].tail = Vec3(0.5, 0.5, 0);
  handles[1].name = "arm";
  handles[1].kind = HandleKind::bone;
  handles[1].head = Vec3(1, 1, 0);
  handles[1].tail = Vec3(1.5, 1.25, 0);
  handles[2].name = "away";
  handles[2].head = handles[2].tail = Vec3(9, 9, 0);
  handles[3].name = "region";
  handles[3].kind = HandleKind::region;
  handles[3].region_id = 1;
  handles[3].head = handles[3].tail = Vec3(0.3, 0.3, 0);
  filter->SetInputData(0, polyline(square_corners, true));
  filter->SetInputData(1, to_polydata(handles));
  update();
  const Report report = read_report(filter->GetOutput());
  const auto names = std::get<std::vector<std::string>>(*report.find("handles[].name"));
  const auto vertices = std::get<std::vector<std::int64_t>>(*report.find("handles[].vertex"));
  ASSERT_EQ(vertices.size(), 4u);
  for (std::size_t h = 0; h < names.size(); ++h)
  {
    if (names[h] == "away" || names[h] == "region")
    {
      EXPECT_EQ(vertices[h], -1);
      continue;
    }
    ASSERT_GE(vertices[h], 0);
    const Vec3 p(filter->GetOutput()->GetPoint(vertices[h]));
    EXPECT_EQ(p, names[h] == "eye" ? Vec3(0.5, 0.5, 7) : Vec3(1, 1, 7));
  }
  EXPECT_EQ(report.number("counts.outside_handles", -1), 1);
}

TEST_F(PlanarShapeFilter, NoWorkTwiceAndAgainAfterAChange)
{
  vtkNew<Listener> listener;
  listener->listen(filter);
  filter->SetInputData(polyline(square_corners, true));
  update();
  const vtkMTimeType before = filter->GetOutput()->GetMTime();
  update();
  EXPECT_EQ(filter->GetOutput()->GetMTime(), before);
  const vtkIdType cells = filter->GetOutput()->GetNumberOfCells();
  filter->SetEdge(0.1);
  update();
  EXPECT_LT(filter->GetOutput()->GetNumberOfCells(), cells);
  filter->SetWindingThreshold(1.5);
  update(vtkPlanarShape::INVALID_INPUT);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  filter->SetWindingThreshold(0.5);
  update();
  EXPECT_GT(filter->GetOutput()->GetNumberOfCells(), 0);
}

TEST_F(PlanarShapeFilter, Refuses)
{
  expect_error(vtkNew<vtkImageData>(), "no pixels");
  expect_error(vtkNew<vtkPolyData>(), "no lines");
  auto image = disc();
  image->SetDimensions(80, 30, 2);
  expect_error(image, "2 layers");
  image = disc();
  image->GetDirectionMatrix()->SetElement(0, 0, -1.0);
  expect_error(image, "direction matrix");
  image = disc();
  image->SetSpacing(0.0, 1.0, 1.0);
  expect_error(image, "spacing");
  image = disc();
  image->GetPointData()->GetScalars()->FillComponent(3, 0.0);
  expect_error(image, "transparent");
  expect_error(polyline({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0.1 } }, true), "z = const");
  expect_error(polyline({ { 0, 0, 0 }, { 1, NAN, 0 }, { 1, 1, 0 } }, true), "point 1");
  expect_error(polyline({ { 0, 0, 0 }, { 1, 1, 0 }, { 2, 2, 0 } }, true), "one line");
  expect_error(polyline({ { 1, 2, 0 }, { 1, 2, 0 } }, false), "coincide");
  auto wrong = polyline(square_corners, true);
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 0, 1, 9 });
  wrong->SetLines(lines);
  expect_error(wrong, "point 9");
}

TEST(PlanarShapeWithoutHelper, SaysWhatIsMissing)
{
  const bool built = !find_mesher().empty();
  std::optional<test::Environment> nowhere;
  if (built)
  {
    nowhere.emplace("BINDPOSE_MESHER", "/nowhere");
  }
  vtkNew<vtkPlanarShape> filter;
  vtkNew<Listener> listener;
  listener->listen(filter);
  filter->SetInputData(polyline(square_corners, true));
  filter->Update();
  EXPECT_EQ(filter->GetStatus(), vtkPlanarShape::UNAVAILABLE);
  EXPECT_THAT(filter->GetStatusMessage(), HasSubstr(built ? "/nowhere" : "libcgal-dev"));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
}

TEST_F(PlanarShapeFilter, PrintsWhatItHas)
{
  std::ostringstream text;
  filter->Print(text);
  for (const char* name :
    { "Rectangle", "Simplify", "WindingThreshold", "MinAngle", "Edge", "TimeLimit", "MemoryLimit" })
  {
    EXPECT_THAT(text.str(), HasSubstr(name));
  }
}
