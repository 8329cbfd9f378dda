// The window draws meshes with the materials and textures of their files.
#include "app/weights/weight_panel.h"
#include "app/window/window_sessions.h"
#include "window_test.h"

#include "document/document.h"

#include "scene/colors.h"
#include "support/files.h"
#include "support/meshes.h"

#include "vtkDoubleArray.h"

#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFileInfo>
#include <QImage>
#include <QMimeData>
#include <QUndoStack>

#include <algorithm>
#include <sstream>

using namespace bindpose;

namespace
{
class LookWindow : public test::WindowTest
{
protected:
  /// Write a sphere whose picture has green and blue pixels, in a folder of its own.
  LookWindow()
  {
    const TriangleMesh sphere = test::sphere(3);
    std::ostringstream text;
    text << "mtllib ball.mtl\nusemtl paint\n";
    for (Index v = 0; v < sphere.points.rows(); ++v)
    {
      text << "v " << sphere.points.row(v) << "\nvt " << (sphere.points(v, 2) > 0.0 ? 0.25 : 0.75)
           << " 0.5\n";
    }
    for (Index t = 0; t < sphere.triangles.rows(); ++t)
    {
      text << "f";
      for (int k = 0; k < 3; ++k)
      {
        const Index v = sphere.triangles(t, k) + 1;
        text << " " << v << "/" << v;
      }
      text << "\n";
    }
    this->path_ = this->folder_.write("ball.obj", text.str());
    this->folder_.write("ball.mtl", "newmtl paint\nKd 1 1 1\nmap_Kd paint.png\n");
    QImage picture(2, 1, QImage::Format_RGB32);
    picture.setPixelColor(0, 0, Qt::green);
    picture.setPixelColor(1, 0, Qt::blue);
    EXPECT_TRUE(picture.save(test::to_qt(this->folder_ / "paint.png")));
    this->resize({ 900, 600 });
  }

  int greens()
  {
    return count(this->picture(),
      [](const QColor& color)
      {
        return color.green() > 1.5 * color.red() && color.green() > 1.5 * color.blue() &&
          color.green() > 60;
      });
  }
  void toggle()
  {
    const QString action = "view.materials_and_textures";
    app::tour::SimulatedUser(&this->window).action(action)->trigger();
  }
  app::view::Viewport* viewport() { return this->part<app::view::Viewport>(); }

  test::Folder folder_;
  std::string path_;
};
} // namespace

TEST_F(LookWindow, AMeshIsDrawnWithItsTexturesAndTheMenuSwitchesThemOff)
{
  ASSERT_TRUE(this->window.open(test::to_qt(this->path_)));
  const int textured = this->greens();
  EXPECT_GT(textured, 5000);
  EXPECT_TRUE(this->viewport()->has_texture());
  this->toggle();
  EXPECT_EQ(this->greens(), 0);
  EXPECT_FALSE(this->viewport()->has_texture());
  EXPECT_FALSE(this->window.document()->option("show.look").toBool());
  this->window.document()->history()->undo();
  EXPECT_EQ(this->greens(), textured);
  // A mesh without materials has none to switch off.
  ASSERT_TRUE(
    this->window.set_mesh(to_polydata(test::cube().points, test::cube().triangles), "cube"));
  EXPECT_FALSE(
    app::tour::SimulatedUser(&this->window).action("view.materials_and_textures")->isEnabled());
  EXPECT_EQ(this->greens(), 0);
  this->window.document()->history()->undo();
  EXPECT_EQ(this->greens(), textured) << "the textures come back with their mesh";
}

TEST_F(LookWindow, TexturesFollowThePose)
{
  ASSERT_TRUE(this->window.open(test::to_qt(this->path_)));
  const int before = this->greens();
  Points points = to_points(this->window.document()->surface()).view();
  points.col(0) *= 0.5;
  this->viewport()->move_surface(points);
  const int narrow = this->greens();
  EXPECT_LT(narrow, 0.8 * before);
  EXPECT_GT(narrow, 0.2 * before);
}

TEST_F(LookWindow, WeightsAreDrawnOverTextures)
{
  ASSERT_TRUE(this->window.open(test::to_qt(this->path_)));
  ASSERT_TRUE(this->window.set_handles(test::two_points(), "points"));
  const int before = this->greens();
  this->viewport()->show_column(-1, QString());
  vtkNew<vtkDoubleArray> values;
  values->SetNumberOfValues(this->viewport()->drawn()->GetNumberOfPoints());
  values->Fill(0.9);
  const ColorMap map = weight_map();
  this->viewport()->set_tint(1.0);
  this->viewport()->show_values(values, true, "values", map);
  EXPECT_EQ(this->greens(), 0) << "opaque colors hide the textures";
  this->viewport()->set_tint(0.0);
  EXPECT_EQ(this->greens(), before);
  this->viewport()->set_tint(1.0);
  this->toggle();
  EXPECT_TRUE(this->viewport()->shows_values(values));
  EXPECT_EQ(this->greens(), 0);
  this->viewport()->set_surface_appearance(app::view::Viewport::see_through);
  this->toggle();
  this->viewport()->set_surface_appearance(app::view::Viewport::solid);
  EXPECT_EQ(this->greens(), 0) << "the colors move to the tint again";
  this->viewport()->show_values(nullptr, true);
  EXPECT_EQ(this->greens(), before);
}

TEST_F(LookWindow, ASessionKeepsTheTextures)
{
  ASSERT_TRUE(this->window.open(test::to_qt(this->path_)));
  const QString session = test::to_qt(this->folder_ / "work.bindpose");
  ASSERT_TRUE(this->part<app::window::WindowSessions>()->write(session));
  ASSERT_TRUE(
    this->window.set_mesh(to_polydata(test::cube().points, test::cube().triangles), "cube"));
  EXPECT_FALSE(this->viewport()->has_texture());
  this->window.document()->set_saved();
  ASSERT_TRUE(this->window.open(session));
  EXPECT_TRUE(this->viewport()->has_texture());
  EXPECT_GT(this->greens(), 5000);
}

TEST_F(LookWindow, AFolderWithOneMeshCanBeDropped)
{
  const auto drop = [this](const std::string& path)
  {
    QMimeData data;
    data.setUrls({ QUrl::fromLocalFile(test::to_qt(path)) });
    QDragEnterEvent enter({ 10, 10 }, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&this->window, &enter);
    QDropEvent event({ 10, 10 }, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&this->window, &event);
    return event.isAccepted();
  };
  EXPECT_TRUE(drop(this->folder_.path()));
  EXPECT_GT(this->greens(), 5000);
  this->folder_.write("second.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_FALSE(drop(this->folder_.path()));
  EXPECT_TRUE(this->window.error().contains("2 meshes, for example ball.obj and second.obj"))
    << this->window.error().toStdString();
  const test::Folder empty;
  EXPECT_FALSE(drop(empty.path()));
  EXPECT_TRUE(this->window.error().contains("contains no mesh"));
}
