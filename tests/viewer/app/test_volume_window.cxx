// Volumes in the window, as a user inspects them: Qt mouse events on the view, and sliders and
// buttons of the panel. The tests compare positions, winding numbers and areas with closed forms.
#include "unclipped.h"
#include "window_test.h"

#include "app/handles/side_panel.h"
#include "app/parts/value_row.h"
#include "app/view/viewport.h"
#include "app/volume/volume_panel.h"
#include "app/volume/volume_view.h"
#include "app/window/main_window.h"
#include "app/window/panel_column.h"
#include "document/document.h"

#include "base/constants.h"
#include "conversion.h"
#include "scene/colors.h"
#include "scene/volume.h"

#include "support/meshes.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkHandleSetRepresentation.h"
#include "vtkHandleSetWidget.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkXMLImageDataWriter.h"
#include "vtkXMLPolyDataWriter.h"

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>
#include <QSlider>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>

using namespace bindpose;

namespace
{
/// The isosurface of level w is a sphere of radius 1.5 - w.
double cone(const Vec3& p)
{
  return 1.5 - p.norm();
}

vtkSmartPointer<vtkImageData> volume(const std::function<double(const Vec3&)>& value = cone,
  int depth = 41, const char* name = "WindingNumber")
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(41, 41, depth);
  image->SetSpacing(0.08, 0.08, 0.08);
  image->SetOrigin(-1.6, -1.6, -1.6);
  vtkNew<vtkDoubleArray> values;
  values->SetName(name);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    values->InsertNextValue(value(Vec3(image->GetPoint(i))));
  }
  image->GetPointData()->AddArray(values);
  return image;
}

vtkSmartPointer<vtkPolyData> square_boundary()
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkIntArray> multiplicity;
  multiplicity->SetName("Multiplicity");
  for (int i = 0; i < 4; ++i)
  {
    points->InsertNextPoint(i == 1 || i == 2 ? 1.2 : -1.2, i < 2 ? -1.2 : 1.2, 1.0);
    const vtkIdType line[2] = { i, (i + 1) % 4 };
    lines->InsertNextCell(2, line);
    multiplicity->InsertNextValue(1);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetLines(lines);
  data->GetCellData()->AddArray(multiplicity);
  return data;
}

class VolumeWindow : public test::WindowTest
{
protected:
  app::volume::VolumeView* view() { return this->part<app::volume::VolumeView>(); }
  app::volume::VolumePanel* panel() { return this->part<app::window::PanelColumn>()->volume(); }

  /// Return a row of the panel: row 0 is the position of the slice, row 1 the level of the
  /// isosurface.
  app::parts::ValueRow* row(int which)
  {
    return this->panel()->findChildren<app::parts::ValueRow*>()[which];
  }

  void open(const vtkSmartPointer<vtkImageData>& image = volume())
  {
    ASSERT_TRUE(this->window.set_volume(image, "field.vti")) << this->window.error().toStdString();
    this->render();
  }

  /// Return the reading (the text about the data under the mouse) at a position. A window of
  /// another test on the same screen may cover this window, and the mouse then counts as outside of
  /// it. The function therefore moves the mouse again.
  QString reading_at(const Vec3& position)
  {
    for (int attempt = 0; attempt < 50; ++attempt)
    {
      this->hover(this->pixel(position));
      if (!this->window.reading().isEmpty())
      {
        break;
      }
      this->render();
    }
    return this->window.reading();
  }
};

/// Return the part of a reading that begins with the coordinates, or an empty text if the reading
/// contains no coordinates.
const char* coordinates_in(const std::string& reading)
{
  const std::size_t begin = reading.find("  x ");
  return begin == std::string::npos ? "" : reading.c_str() + begin + 2;
}

bool is_green(const QColor& c)
{
  return c.green() > c.red() + 40 && c.green() > c.blue() + 10;
}
} // namespace

TEST_F(VolumeWindow, ASliceHasTheColorsOfItsValues)
{
  this->open();
  EXPECT_TRUE(this->panel()->isVisible());
  EXPECT_FALSE(this->part<app::handles::SidePanel>()->isVisible());
  const QImage image = this->picture();
  for (const Vec3& position :
    { Vec3(0.8, 0.1, 0), Vec3(-1.2, 0.3, 0), Vec3(0.2, 0.1, 0), Vec3(-1.3, -1.3, 0) })
  {
    const QColor seen = image.pixelColor(this->pixel(position));
    const Rgb expected = winding_color(cone(position));
    EXPECT_NEAR(seen.red(), 255.0 * expected[0], 8.0) << position.transpose();
    EXPECT_NEAR(seen.green(), 255.0 * expected[1], 8.0) << position.transpose();
    EXPECT_NEAR(seen.blue(), 255.0 * expected[2], 8.0) << position.transpose();
  }
}

TEST_F(VolumeWindow, TheMouseDragsTheSliceAndTheStatusBarReadsTheField)
{
  this->open();
  const QPoint grip = this->pixel(Vec3(0.5, 0.4, 0));
  const QPoint drag_end = this->pixel(Vec3(0.5, 0.4, 0.6));
  this->drag(grip, drag_end);
  // The drag has moved the slice along its normal. The panel shows the position of the slice.
  EXPECT_NEAR(this->view()->position(), 0.6, 0.08);
  EXPECT_EQ(this->view()->slice_normal(), Vec3(0, 0, 1));
  EXPECT_NEAR(this->row(0)->value(), this->view()->position(), 0.01);
  // The reading under the mouse equals the field at that position.
  int reading_count = 0;
  for (const Vec3& position : { Vec3(0.3, 0.2, 0.6), Vec3(-0.9, 0.5, 0.6), Vec3(1.0, -1.0, 0.6) })
  {
    const std::string reading = this->reading_at(position).toStdString();
    double x = 0;
    double y = 0;
    double z = 0;
    double w = 0;
    ASSERT_EQ(std::sscanf(reading.c_str(), "Slice: winding number w = %lf", &w), 1) << reading;
    ASSERT_EQ(std::sscanf(coordinates_in(reading), "x %lf y %lf z %lf", &x, &y, &z), 3) << reading;
    EXPECT_NEAR(z, this->view()->position(), 1e-3);
    EXPECT_NEAR(x, position.x(), 0.1);
    EXPECT_NEAR(w, cone(Vec3(x, y, z)), 0.005);
    ++reading_count;
  }
  EXPECT_EQ(reading_count, 3);
  this->hover(QPoint(3, 3));
  EXPECT_EQ(this->window.reading(), QString()) << "beside the slice";
}

TEST_F(VolumeWindow, ButtonsAndTheFieldPlaceTheSlice)
{
  this->open();
  const char* const axes[] = { "X", "Y", "Z" };
  for (int axis = 0; axis < 3; ++axis)
  {
    this->find<QPushButton>(axes[axis])->click();
    EXPECT_EQ(this->view()->slice_normal(), Vec3(Vec3::Unit(axis)));
    this->row(0)->field()->setValue(0.4 - 0.5 * axis);
    EXPECT_NEAR(this->view()->position(), 0.4 - 0.5 * axis, 1e-9);
    EXPECT_NEAR(this->view()->slice_origin()[axis], 0.4 - 0.5 * axis, 1e-9);
  }
  // At both ends of the slider a whole slice is visible.
  for (const int end : { 0, 1000 })
  {
    this->row(0)->slider()->setValue(end);
    this->render();
    EXPECT_NE(this->reading_at(Vec3(0.1, 0.1, end ? 1.6 : -1.6)), QString()) << end;
  }
  // The arrow of a free slice rotates it. Slices perpendicular to an axis have no arrow.
  this->row(0)->field()->setValue(0.0);
  this->find<QPushButton>("Free")->click();
  this->render();
  const Vec3 tip = this->view()->slice_origin() + 0.3 * 3.2 * std::sqrt(3.0) * Vec3(0, 0, 1);
  this->drag(this->pixel(tip), this->pixel(tip) + QPoint(70, 30));
  EXPECT_LT(this->view()->slice_normal().z(), 0.99);
  EXPECT_NEAR(this->view()->slice_normal().norm(), 1.0, 1e-9);
}

TEST_F(VolumeWindow, TheLevelsSliderGivesTheSphereOfThatLevel)
{
  this->open();
  for (const int step : { 620, 700, 830 })
  {
    this->row(1)->slider()->setValue(step);
    const double level = this->row(1)->value();
    EXPECT_NEAR(this->view()->level(), level, 1e-9);
    const double radius = 1.5 - level;
    ASSERT_GT(radius, 0.3);
    ASSERT_LT(radius, 1.6);
    const double area = surface_area(this->view()->isosurface());
    EXPECT_NEAR(area, 4.0 * pi * radius * radius, 0.01 * area);
    EXPECT_NE(this->find<QLabel>(QString("Area %1").arg(area, 0, 'g', 5)), nullptr);
  }
  this->row(1)->field()->setValue(0.5);
  EXPECT_NEAR(surface_area(this->view()->isosurface()), 4.0 * pi, 0.01 * 4.0 * pi);
  // At the first position, the isosurface covers the slice, so the text about the data under the
  // mouse describes the isosurface. Beside the isosurface, the text describes the slice.
  this->render();
  const std::string reading = this->reading_at(Vec3(0.2, 0.1, 0)).toStdString();
  Vec3 position;
  double level = 0.0;
  ASSERT_EQ(std::sscanf(reading.c_str(), "Isosurface: winding number w = %lf", &level), 1)
    << reading;
  ASSERT_EQ(std::sscanf(coordinates_in(reading), "x %lf y %lf z %lf", &position.x(), &position.y(),
              &position.z()),
    3)
    << reading;
  EXPECT_NEAR(level, 0.5, 1e-9);
  EXPECT_NEAR(position.norm(), 1.0, 0.01);
  EXPECT_NE(this->reading_at(Vec3(1.4, 1.4, 0)).indexOf("Slice"), -1);
  this->find<QCheckBox>("Isosurface where w is")->setChecked(false);
  EXPECT_EQ(this->view()->isosurface()->GetNumberOfPolys(), 0);
}

TEST_F(VolumeWindow, ACloudIsClearWhereTheWindingNumberIsZero)
{
  this->open(volume([](const Vec3& p) { return p.norm() < 0.8 ? 1.0 : 0.0; }));
  this->find<QCheckBox>("Show the slice")->setChecked(false);
  const QImage before = this->picture();
  this->find<QCheckBox>("Show as a cloud")->setChecked(true);
  const QImage after = this->picture();
  const QPoint inside = this->pixel(Vec3(0, 0, 0));
  const QPoint outside = this->pixel(Vec3(1.1, 1.1, 0));
  EXPECT_GT(std::abs(before.pixelColor(inside).blue() - after.pixelColor(inside).blue()), 20);
  EXPECT_EQ(this->reading_at(Vec3(0, 0, 0)),
    "Cloud: winding number from 0.000 to 1.000 along the line of sight");
  EXPECT_EQ(this->reading_at(Vec3(1.2, 0.1, 0)).left(32), "Cloud: winding number from 0.000");
  EXPECT_EQ(before.pixelColor(outside), after.pixelColor(outside));
  this->find<QCheckBox>("Show as a cloud")->setChecked(false);
  EXPECT_EQ(this->picture().pixelColor(inside), before.pixelColor(inside));
}

TEST_F(VolumeWindow, ASurfaceAlongWithAVolumeIsSeeThrough)
{
  const TriangleMesh ball = test::sphere(3, 1.2);
  ASSERT_TRUE(this->window.set_mesh(to_polydata(ball.points, ball.triangles), "ball"));
  this->render();
  EXPECT_TRUE(this->part<app::handles::SidePanel>()->isVisible());
  EXPECT_EQ(this->part<app::view::Viewport>()->surface_actor()->GetProperty()->GetOpacity(), 1.0);
  this->open();
  EXPECT_LT(this->part<app::view::Viewport>()->surface_actor()->GetProperty()->GetOpacity(), 0.5);
  // The surface is translucent: the orange of the slice behind it is visible. There is a text about
  // the data under the mouse.
  const QColor seen = this->picture().pixelColor(this->pixel(Vec3(0.3, 0.1, 0)));
  EXPECT_GT(seen.red(), seen.blue() + 40);
  EXPECT_NE(this->reading_at(Vec3(0.3, 0.1, 0)).indexOf("Slice"), -1);
  auto* look = this->panel()->findChild<QComboBox*>("volume.surface_look");
  look->setCurrentIndex(app::view::Viewport::hidden);
  EXPECT_FALSE(this->part<app::view::Viewport>()->surface_actor()->GetVisibility());
  look->setCurrentIndex(app::view::Viewport::edges_only);
  EXPECT_TRUE(this->part<app::view::Viewport>()->surface_actor()->GetVisibility());
  // Both panels are available. After a click on "Close the volume", the surface is shown as before.
  this->find<QPushButton>("Pose")->click();
  EXPECT_TRUE(this->part<app::handles::SidePanel>()->isVisible());
  this->find<QPushButton>("Close the volume")->click();
  EXPECT_FALSE(this->panel()->isVisible());
  EXPECT_TRUE(this->part<app::handles::SidePanel>()->isVisible());
  EXPECT_EQ(this->part<app::view::Viewport>()->surface_actor()->GetProperty()->GetOpacity(), 1.0);
  EXPECT_EQ(this->part<app::view::Viewport>()->surface_actor()->GetProperty()->GetRepresentation(),
    VTK_SURFACE);
  EXPECT_EQ(this->reading_at(Vec3(0.3, 0.1, 0)).left(8), "Triangle");
}

/// Winding numbers are computed for the shape at rest, so the shape is not posed while winding
/// numbers are shown.
TEST_F(VolumeWindow, NoSliceLiesInAPosedShape)
{
  const TriangleMesh ball = test::sphere(3, 1.2);
  const auto mesh = to_polydata(ball.points, ball.triangles);
  vtkNew<vtkDoubleArray> weights;
  weights->SetName("Weights");
  weights->SetNumberOfComponents(2);
  for (vtkIdType v = 0; v < mesh->GetNumberOfPoints(); ++v)
  {
    weights->InsertNextTuple2(0.5, 0.5);
  }
  mesh->GetPointData()->AddArray(weights);
  ASSERT_TRUE(this->window.set_mesh(mesh, "ball"));
  ASSERT_TRUE(this->window.set_handles(test::two_points(), "points"));
  ASSERT_TRUE(this->window.is_bound());
  Pose pose(2);
  pose[0].transform.col(3) = pose[1].transform.col(3) = Vec3(0, 1, 0);
  this->window.document()->set_pose(pose, "up");
  const auto top = [this]
  {
    double bounds[6];
    this->part<app::view::Viewport>()->drawn()->GetBounds(bounds);
    return bounds[3];
  };
  auto* handles = this->part<app::view::Viewport>()->handle_widget()->GetHandleSetRepresentation();
  EXPECT_NEAR(top(), 2.2, 1e-3);
  this->open();
  EXPECT_TRUE(this->view()->is_slice_shown());
  EXPECT_NEAR(top(), 1.2, 1e-3);
  EXPECT_NEAR(handles->GetBounds()[3], 0.0, 1e-9);
  EXPECT_EQ(this->part<app::view::Viewport>()->state_name(),
    "Rest shape: required to show winding numbers");
  // The shape is posed again while the slice is hidden. Both the check box and a switch to the
  // panel Pose hide the slice.
  this->find<QCheckBox>("Show the slice")->setChecked(false);
  EXPECT_NEAR(top(), 2.2, 1e-3);
  this->find<QCheckBox>("Show the slice")->setChecked(true);
  EXPECT_NEAR(top(), 1.2, 1e-3);
  this->find<QPushButton>("Pose")->click();
  EXPECT_NEAR(top(), 2.2, 1e-3);
  EXPECT_NEAR(handles->GetBounds()[3], 1.0, 1e-9);
  EXPECT_EQ(this->part<app::view::Viewport>()->state_name(), QString());
  EXPECT_FALSE(this->view()->is_slice_shown());
  EXPECT_EQ(this->part<app::view::Viewport>()->surface_actor()->GetProperty()->GetOpacity(), 1.0);
  this->find<QPushButton>("Volume")->click();
  EXPECT_TRUE(this->view()->is_slice_shown());
  EXPECT_NEAR(top(), 1.2, 1e-3);
}

TEST_F(VolumeWindow, BoundaryCurvesAreDrawnAndAreNoBones)
{
  const std::string path = testing::TempDir() + "bindpose_boundary.vtp";
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(square_boundary());
  writer->SetFileName(path.c_str());
  writer->Write();
  this->open();
  EXPECT_EQ(count(this->picture(), is_green), 0);
  EXPECT_TRUE(this->window.open(QString::fromStdString(path)));
  std::remove(path.c_str());
  EXPECT_EQ(this->window.error(), QString());
  const QImage image = this->picture();
  for (const Vec3& position : { Vec3(0.3, 1.2, 1.0), Vec3(-1.2, 0.1, 1.0), Vec3(0.7, -1.2, 1.0) })
  {
    EXPECT_TRUE(is_green(image.pixelColor(this->pixel(position)))) << position.transpose();
  }
  // If no curve file is open, the line cells of a mesh are drawn as curves, in addition to its
  // faces.
  app::window::MainWindow other;
  other.show();
  const TriangleMesh ball = test::sphere(2, 0.5);
  const auto mesh = to_polydata(ball.points, ball.triangles);
  vtkNew<vtkCellArray> line;
  const vtkIdType ends[2] = { 0, 5 };
  line->InsertNextCell(2, ends);
  mesh->SetLines(line);
  ASSERT_TRUE(other.set_mesh(mesh, "ball")) << other.error().toStdString();
  QApplication::processEvents();
  other.findChild<app::view::Viewport*>()->renderWindow()->Render();
  EXPECT_GT(count(other.findChild<app::view::Viewport*>()->grabFramebuffer(), is_green), 0);
}

TEST_F(VolumeWindow, WhatIsNoVolumeIsSaidAndTheWorkStays)
{
  this->open();
  vtkImageData* before = this->view()->volume();
  const auto refused = [this](vtkImageData* image, const char* words)
  {
    EXPECT_FALSE(this->window.set_volume(image, "field.vti"));
    EXPECT_NE(this->window.error().indexOf(words), -1) << this->window.error().toStdString();
    EXPECT_EQ(this->window.error().count('\n'), 0);
  };
  refused(volume(cone, 41, "Heat"), "no point array 'WindingNumber'; available: Heat");
  refused(volume(cone, 1), "one sample thick along z");
  refused(volume([](const Vec3& p)
            { return p.x() < -1.55 ? std::numeric_limits<double>::quiet_NaN() : 0.0; }),
    "1681 of the 68921 values of 'WindingNumber' are not finite");
  vtkNew<vtkImageData> empty;
  refused(empty, "no samples");
  // This file contains an empty image.
  const std::string path = testing::TempDir() + "bindpose_empty.vti";
  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetInputData(empty);
  writer->SetFileName(path.c_str());
  writer->Write();
  EXPECT_FALSE(this->window.open(QString::fromStdString(path)));
  EXPECT_FALSE(this->window.error().isEmpty());
  std::remove(path.c_str());
  EXPECT_EQ(this->view()->volume(), before);
  EXPECT_NE(this->reading_at(Vec3(0.3, 0.2, 0)), QString());
}

TEST_F(VolumeWindow, AConstantFieldIsShown)
{
  this->open(volume([](const Vec3&) { return 1.0; }));
  this->find<QCheckBox>("Show as a cloud")->setChecked(true);
  this->find<QCheckBox>("Isosurface where w is")->setChecked(true);
  this->render();
  EXPECT_NE(this->reading_at(Vec3(0.3, 0.2, 0)).indexOf("w = 1.000"), -1);
  EXPECT_EQ(this->view()->isosurface()->GetNumberOfPolys(), 0);
}

TEST_F(VolumeWindow, NoTextOfTheVolumePanelIsClipped)
{
  const TriangleMesh ball = test::sphere(2);
  ASSERT_TRUE(this->window.set_mesh(to_polydata(ball.points, ball.triangles), "ball"));
  this->open(volume([](const Vec3& p) { return -1234.5678 * p.x(); }));
  this->row(1)->slider()->setValue(300);
  for (const QSize& size : { QSize(900, 600), QSize(1280, 800), QSize(1920, 1080) })
  {
    this->resize(size);
    test::expect_unclipped_buttons(this->part<app::window::PanelColumn>());
    for (QCheckBox* box : this->panel()->findChildren<QCheckBox*>())
    {
      EXPECT_LE(box->sizeHint().width(), box->width()) << box->text().toStdString();
    }
    for (QDoubleSpinBox* field : this->panel()->findChildren<QDoubleSpinBox*>())
    {
      for (const double end : { field->minimum(), field->maximum() })
      {
        EXPECT_LE(
          field->fontMetrics().horizontalAdvance(field->textFromValue(end)), field->width() - 14)
          << end;
      }
    }
    for (QLabel* label : this->panel()->findChildren<QLabel*>())
    {
      EXPECT_LE(label->sizeHint().width(), label->width()) << label->text().toStdString();
    }
  }
}
