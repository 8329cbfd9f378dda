// Layout of the window: all its parts fit on a small screen. Bars with messages are drawn over the
// 3D view and neither move nor resize it. The timeline is hidden until the first key frame is set
// or the user shows it. Two more tests operate controls of the window: one chooses the domain in
// which a bind solves the weights, the other computes the winding numbers of the surface on a grid.
#include "window_test.h"

#include "app/handles/side_panel.h"
#include "app/parts/error_bar.h"
#include "app/parts/notice_bar.h"
#include "app/posing/key_strip.h"
#include "app/posing/posing.h"
#include "app/volume/volume_panel.h"
#include "app/volume/volume_view.h"
#include "app/volume/winding_volume.h"
#include "document/document.h"

#include "document/session.h"

#include "support/files.h"
#include "support/meshes.h"

#include "report_field_data.h"

#include "vtkImageData.h"
#include "vtkPointData.h"

#include <QMenuBar>
#include <QPushButton>
#include <QScrollArea>
#include <QStatusBar>
#include <QUndoStack>

using namespace bindpose;
using test::two_points;
using test::wait_for;

namespace
{
class WindowRoom : public test::WindowTest
{
protected:
  void open_ball(bool handles = true)
  {
    const TriangleMesh mesh = test::sphere(2);
    ASSERT_TRUE(this->window.set_mesh(to_polydata(mesh.points, mesh.triangles), "ball"));
    if (handles)
    {
      ASSERT_TRUE(this->window.set_handles(two_points(), "points"));
    }
    ASSERT_TRUE(wait_for([this] { return app::tour::is_idle(&this->window); }));
    this->render();
  }
  void open_figure()
  {
    for (const char* name : { "figure_weights.vtp", "figure.tgf" })
    {
      ASSERT_TRUE(this->window.open(QString(BINDPOSE_TOURS "/data/") + name)) << name;
    }
    ASSERT_TRUE(wait_for([this] { return app::tour::is_idle(&this->window); }));
    this->render();
  }
  QRect viewport_rectangle()
  {
    QApplication::processEvents();
    const app::view::Viewport* viewport = this->part<app::view::Viewport>();
    return { viewport->mapTo(&this->window, QPoint()), viewport->size() };
  }

  app::tour::SimulatedUser user{ &this->window };
};

/// Return the class names of the parts that are hidden or extend beyond the window.
QStringList parts_outside(const QWidget& window, const QList<const QWidget*>& parts)
{
  QStringList names;
  for (const QWidget* part : parts)
  {
    const QRect at(part->mapTo(&window, QPoint()), part->size());
    if (!part->isVisible() || !window.rect().contains(at))
    {
      names << part->metaObject()->className();
    }
  }
  return names;
}
} // namespace

TEST_F(WindowRoom, BarsNeitherMoveNorResizeThePicture)
{
  this->open_ball();
  const QRect view_rectangle = this->viewport_rectangle();
  const QPoint handle_pixel = this->pixel(Vec3(0, 0, 0.9));
  const auto expect_view_unchanged = [&](const char* what)
  {
    EXPECT_EQ(this->viewport_rectangle(), view_rectangle) << what;
    this->render();
    EXPECT_EQ(this->pixel(Vec3(0, 0, 0.9)), handle_pixel) << what;
  };
  int bars = 0;
  for (app::parts::NoticeBar* bar : { this->bar("note_bar"), this->bar("rebind_bar"),
         this->bar("recovery_bar"), this->bar("export_bar") })
  {
    bar->offer("A sentence that is long enough for two lines in a window of this size, for it goes "
               "on and on, and then some more, so that there are surely two of them.",
      { { "Do it", [] {} } }, "Close");
    expect_view_unchanged("a notice came");
    EXPECT_TRUE(bar->isVisible());
    EXPECT_TRUE(view_rectangle.contains(QRect(bar->mapTo(&this->window, QPoint()), bar->size())));
    ++bars;
  }
  this->window.show_error("Something has gone wrong.");
  expect_view_unchanged("an error came");
  EXPECT_EQ(bars, 4);
  // The bars overlap neither each other nor the title of the edit mode.
  EXPECT_EQ(this->user.press_key("A"), QString());
  expect_view_unchanged("a mode began");
  QList<QRect> bar_rectangles;
  for (const QWidget* bar :
    { static_cast<QWidget*>(this->part<app::parts::ErrorBar>()),
      static_cast<QWidget*>(this->bar("note_bar")), static_cast<QWidget*>(this->bar("rebind_bar")),
      static_cast<QWidget*>(this->part<app::view::Viewport>()->findChild<QFrame*>("mode")) })
  {
    const QRect at(bar->mapTo(&this->window, QPoint()), bar->size());
    for (const QRect& other : bar_rectangles)
    {
      EXPECT_FALSE(at.intersects(other));
    }
    bar_rectangles << at;
  }
  for (app::parts::NoticeBar* bar : { this->bar("note_bar"), this->bar("rebind_bar"),
         this->bar("recovery_bar"), this->bar("export_bar") })
  {
    bar->hide();
    expect_view_unchanged("a notice left");
  }
  // The status line shows a hint about the mouse.
  this->hover(handle_pixel);
  expect_view_unchanged("a hint came");
  // After a bar is hidden, nothing covers the view at the position of the bar.
  this->part<app::parts::ErrorBar>()->hide();
  QApplication::processEvents();
  const QWidget* widget_under_point =
    this->part<app::view::Viewport>()->childAt(this->part<app::view::Viewport>()->width() / 2, 60);
  EXPECT_EQ(widget_under_point, nullptr) << widget_under_point->metaObject()->className();
}

TEST_F(WindowRoom, ABarDoesNotEndADrag)
{
  this->open_figure();
  QPoint at;
  ASSERT_EQ(this->user.find_handle_position("left_hand", 0.0, at), QString());
  this->user.move(at, Qt::NoModifier);
  this->user.press(at, Qt::LeftButton, Qt::NoModifier);
  this->user.move(at + QPoint(0, -20), Qt::NoModifier);
  this->window.show_error("Something has gone wrong meanwhile.");
  QApplication::processEvents();
  this->user.move(at + QPoint(0, -60), Qt::NoModifier);
  this->user.release(at + QPoint(0, -60), Qt::LeftButton, Qt::NoModifier);
  EXPECT_EQ(this->window.document()->history()->undoText(), "move left_hand");
  QPoint new_position;
  ASSERT_EQ(this->user.find_handle_position("left_hand", 0.0, new_position), QString());
  EXPECT_NEAR(new_position.y(), at.y() - 60, 3);
}

TEST_F(WindowRoom, TheTimelineComesWithTheFirstKeyOrOnDemand)
{
  this->open_figure();
  const auto shown = [this]
  {
    QApplication::processEvents();
    const QAction* entry = this->user.action("view.timeline");
    EXPECT_EQ(entry->isChecked(), this->part<app::posing::KeyStrip>()->isVisible());
    return this->part<app::posing::KeyStrip>()->isVisible();
  };
  EXPECT_FALSE(shown());
  EXPECT_EQ(this->user.press_key("K"), QString());
  EXPECT_TRUE(shown());
  EXPECT_EQ(this->user.trigger("view.timeline"), QString());
  EXPECT_FALSE(shown());
  EXPECT_EQ(this->user.press_key("K"), QString()); // K does not show a hidden timeline
  EXPECT_FALSE(shown()) << "a person has sent it away";
  EXPECT_EQ(this->user.trigger("edit.undo"), QString());
  EXPECT_EQ(this->user.trigger("edit.undo"), QString());
  EXPECT_TRUE(this->part<app::posing::PoseController>()->stored_poses().keys.keys().empty());
  EXPECT_EQ(this->user.trigger("view.timeline"), QString());
  EXPECT_TRUE(shown()) << "there is none, but it was asked for";
}

TEST_F(WindowRoom, AScreenOf1280By800FitsAllOfIt)
{
  this->open_figure();
  EXPECT_EQ(this->user.press_key("K"), QString());
  // On a screen of 1280 x 800 pixels, a desktop leaves this space for a window.
  const QSize available_size(1280, 720);
  for (int panel = 0; panel < 4; ++panel)
  {
    this->part<app::window::PanelColumn>()->show_panel(panel);
    QApplication::processEvents();
    const QSize minimum_size = this->window.minimumSizeHint();
    EXPECT_LE(minimum_size.width(), available_size.width()) << panel;
    EXPECT_LE(minimum_size.height(), available_size.height()) << panel;
    this->resize(available_size);
    EXPECT_EQ(
      parts_outside(this->window,
        { this->window.menuBar(), this->window.statusBar(), this->part<app::view::Viewport>(),
          this->part<app::posing::KeyStrip>(), this->part<app::window::PanelColumn>() }),
      QStringList())
      << panel;
    EXPECT_GT(this->part<app::view::Viewport>()->height(), 400) << panel;
    // Panels scroll vertically only.
    for (const QScrollArea* area :
      this->part<app::window::PanelColumn>()->findChildren<QScrollArea*>())
    {
      if (area->isVisible())
      {
        EXPECT_LE(area->widget()->minimumSizeHint().width(), area->viewport()->width()) << panel;
      }
    }
  }
}

TEST_F(WindowRoom, TheDomainOfABindIsChosen)
{
  this->open_ball();
  EXPECT_EQ(this->user.choose("bind.domain", 4), QString()); // surface
  EXPECT_EQ(this->part<app::handles::SidePanel>()->domain(), WeightsDomain::surface);
  EXPECT_EQ(this->user.trigger("edit.bind"), QString());
  ASSERT_TRUE(wait_for([this] { return app::tour::is_idle(&this->window); }));
  ASSERT_TRUE(this->window.is_bound()) << this->window.error().toStdString();
  EXPECT_EQ(read_report(this->window.document()->surface()).text("domain"), "surface");
  EXPECT_EQ(this->user.choose("bind.domain", 2), QString()); // lattice
  EXPECT_EQ(this->user.trigger("edit.bind"), QString());
  ASSERT_TRUE(wait_for([this] { return app::tour::is_idle(&this->window); }));
  EXPECT_EQ(read_report(this->window.document()->surface()).text("domain"), "embedding");
  EXPECT_EQ(this->window.error(), QString());
}

TEST_F(WindowRoom, WindingNumbersOfASurfaceAreComputedThere)
{
  EXPECT_NE(this->user.show_panel("volume"), QString()) << "of nothing";
  this->open_ball(false);
  ASSERT_EQ(this->user.show_panel("volume"), QString());
  EXPECT_EQ(this->user.choose("volume.samples", 0), QString());
  ASSERT_EQ(this->user.push_button("Compute"), QString());
  ASSERT_TRUE(wait_for([this] { return app::tour::is_idle(&this->window); }));
  vtkImageData* volume = this->part<app::volume::VolumeView>()->volume();
  ASSERT_NE(volume, nullptr) << this->window.error().toStdString();
  EXPECT_EQ(this->window.document()->history()->undoText(), "compute winding numbers");
  int size[3];
  volume->GetDimensions(size);
  EXPECT_EQ(*std::max_element(size, size + 3), 48);
  vtkDataArray* values = volume->GetPointData()->GetArray("WindingNumber");
  int inside = 0;
  for (vtkIdType v = 0; v < volume->GetNumberOfPoints(); ++v)
  {
    const double radius = Vec3(volume->GetPoint(v)).norm();
    if (radius < 0.8 || radius > 1.01) // skip samples near the facets of the ball
    {
      EXPECT_NEAR(values->GetComponent(v, 0), radius < 0.8, 1e-9) << radius;
      inside += radius < 0.8;
    }
  }
  EXPECT_GT(inside, 1000);
  EXPECT_EQ(this->user.choose("volume.isosurface", true), QString());
  // The volume was computed and is in no file, so the session stores it.
  const test::Folder folder;
  const QString path = QString::fromStdString(folder / "ball.bindpose");
  SessionFile file;
  Session session;
  session.work = this->window.document()->work();
  ASSERT_TRUE(file.write(path, session).ok());
  Session restored;
  ASSERT_TRUE(read_session(path, restored).ok());
  EXPECT_EQ(restored.notes, QStringList());
  ASSERT_NE(restored.work.volume, nullptr);
  EXPECT_EQ(restored.work.volume->GetNumberOfPoints(), volume->GetNumberOfPoints());
  EXPECT_EQ(Vec3(restored.work.volume->GetOrigin()), Vec3(volume->GetOrigin()));
  EXPECT_EQ(restored.work.volume->GetPointData()->GetArray("WindingNumber")->GetComponent(1000, 0),
    values->GetComponent(1000, 0));
  EXPECT_EQ(this->user.push_button("Close the volume"), QString());
  EXPECT_EQ(this->part<app::volume::VolumeView>()->volume(), nullptr);
  EXPECT_EQ(this->user.trigger("edit.undo"), QString());
  EXPECT_EQ(this->part<app::volume::VolumeView>()->volume(), volume);
}
