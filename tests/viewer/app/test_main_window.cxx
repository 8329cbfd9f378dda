// The main window as a user operates it: open, bind, drag, undo, cancel. Drags are synthetic events
// on VTK's interactor. The tests assert the positions of vertices.
#include "app/weights/binding.h"
#include "columns.h"
#include "unclipped.h"
#include "window_test.h"

#include "app/handles/edit_tools.h"
#include "app/handles/side_panel.h"
#include "app/parts/style.h"
#include "app/tour/viewer.h"
#include "app/view/viewport.h"
#include "app/volume/volume_view.h"
#include "app/window/main_window.h"
#include "app/window/panel_column.h"
#include "document/document.h"

#include "conversion.h"

#include "support/files.h"
#include "support/meshes.h"

#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkGLTFSkinWriter.h"
#include "vtkHandleSetRepresentation.h"
#include "vtkHandleSetWidget.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"

#include <QApplication>
#include <QElapsedTimer>
#include <QLabel>
#include <QMenuBar>
#include <QProgressBar>
#include <QPushButton>
#include <QSurfaceFormat>
#include <QToolButton>
#include <QTreeWidget>
#include <QUndoStack>

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

using namespace bindpose;
using test::column;
using test::two_points;
using test::wait_for;
using test::with_linear_weights;

namespace
{
Vec3 highest_point(vtkPolyData* data)
{
  Vec3 top(0, 0, -1e300);
  for (vtkIdType v = 0; v < data->GetNumberOfPoints(); ++v)
  {
    double p[3];
    data->GetPoint(v, p);
    if (p[2] > top.z())
    {
      top = Vec3(p[0], p[1], p[2]);
    }
  }
  return top;
}

/// Count the deep blue pixels (blue is well above red), which show a weight of one. A shaded
/// surface without weights has none.
int blue_pixels(const QImage& image)
{
  int count = 0;
  for (int y = 0; y < image.height(); ++y)
  {
    for (int x = 0; x < image.width(); ++x)
    {
      const QColor c = image.pixelColor(x, y);
      count += c.blue() > c.red() + 60;
    }
  }
  return count;
}

class Window : public test::WindowTest
{
protected:
  void open_bound()
  {
    ASSERT_TRUE(this->window.set_mesh(with_linear_weights(column(3)), "column"));
    ASSERT_TRUE(this->window.set_handles(two_points(), "points"));
    ASSERT_TRUE(this->window.is_bound());
    this->window.document()->history()->clear(); // discard the undo steps of opening the files
    this->render();
  }

  void render()
  {
    QApplication::processEvents();
    this->part<app::view::Viewport>()->renderWindow()->Render();
  }

  /// Return the pixel of a handle in the window, in VTK's coordinates (y upward).
  Eigen::Vector2i pixel_of(vtkIdType handle)
  {
    auto* representation =
      this->part<app::view::Viewport>()->handle_widget()->GetHandleSetRepresentation();
    double p[3];
    representation->GetPosedHead(handle, p);
    vtkRenderer* renderer = this->part<app::view::Viewport>()->renderer();
    renderer->SetWorldPoint(p[0], p[1], p[2], 1.0);
    renderer->WorldToDisplay();
    const double* d = renderer->GetDisplayPoint();
    return { static_cast<int>(d[0]), static_cast<int>(d[1]) };
  }

  void mouse(const Eigen::Vector2i& at, unsigned long event)
  {
    vtkRenderWindowInteractor* interactor = this->part<app::view::Viewport>()->interactor();
    interactor->SetEventInformation(at.x(), at.y(), 0, 0, 0, 0, nullptr);
    interactor->InvokeEvent(event);
  }

  void press_and_move(vtkIdType handle, const Eigen::Vector2i& offset)
  {
    const Eigen::Vector2i at = this->pixel_of(handle);
    this->mouse(at, vtkCommand::MouseMoveEvent);
    this->mouse(at, vtkCommand::LeftButtonPressEvent);
    for (int step = 1; step <= 4; ++step)
    {
      this->mouse(at + offset * step / 4, vtkCommand::MouseMoveEvent);
    }
  }

  void drag(vtkIdType handle, const Eigen::Vector2i& offset)
  {
    const Eigen::Vector2i at = this->pixel_of(handle);
    this->press_and_move(handle, offset);
    this->mouse(at + offset, vtkCommand::LeftButtonReleaseEvent);
  }
};
} // namespace

TEST_F(Window, ADragMovesVerticesAndUndoTakesItBack)
{
  this->open_bound();
  const Vec3 rest = highest_point(this->window.shown());
  this->drag(1, { 80, 0 });
  const Vec3 moved = highest_point(this->window.shown());
  EXPECT_GT((moved - rest).norm(), 0.1);
  ASSERT_EQ(this->window.document()->history()->count(), 1);
  EXPECT_NE(this->window.document()->history()->undoText().indexOf("top"), -1);
  this->window.document()->history()->undo();
  EXPECT_EQ(highest_point(this->window.shown()), rest);
  this->window.document()->history()->redo();
  EXPECT_EQ(highest_point(this->window.shown()), moved);
}

/// If a desktop icon starts the program, there is no visible terminal, so the window must show the
/// errors.
TEST_F(Window, FilesThatCannotBeReadAreNamedInTheErrorBar)
{
  const test::Folder folder;
  const std::string noise = folder.write("noise.png", "no picture");
  const std::string session = folder.write("old.bindpose", "{");
  const TriangleMesh mesh = column(3);
  const auto surface = to_polydata(mesh.points, mesh.triangles);
  ASSERT_TRUE(write_shape(surface, folder / "good.vtp").ok());
  std::vector<app::tour::InitialFile> files(4);
  files[0] = { folder / "gone.off", {}, "cannot open gone.off: No such file or directory" };
  files[1] = { noise, {}, {} };
  files[2] = { session, {}, {} };
  files[3] = { folder / "good.vtp", {}, {} };
  app::tour::open_initial_files(this->window, files);
  const QStringList errors = this->window.error().split('\n');
  ASSERT_EQ(errors.size(), 3) << this->window.error().toStdString();
  EXPECT_EQ(errors[0], "cannot open gone.off: No such file or directory");
  EXPECT_TRUE(errors[1].contains("noise.png")) << errors[1].toStdString();
  EXPECT_TRUE(errors[2].contains("old.bindpose")) << errors[2].toStdString();
  ASSERT_NE(this->window.shown(), nullptr) << "what can be opened is open";
  // Opening another file removes the errors.
  ASSERT_TRUE(this->window.set_mesh(surface, "again"));
  EXPECT_EQ(this->window.error(), QString());
}

TEST_F(Window, ARigIsReadyToBePosed)
{
  const std::string path = testing::TempDir() + "bindpose_rig.glb";
  vtkNew<vtkGLTFSkinWriter> writer;
  writer->SetInputData(0, with_linear_weights(column(3)));
  writer->SetHandlesData(two_points());
  writer->SetFileName(path.c_str());
  writer->OverwriteOn();
  ASSERT_EQ(writer->Write(), 1) << writer->GetStatusMessage();
  EXPECT_TRUE(this->window.open(QString::fromStdString(path)));
  std::remove(path.c_str());
  ASSERT_TRUE(this->window.is_bound()); // the weights in the file make the mesh bound
  this->render();
  const Vec3 rest = highest_point(this->window.shown());
  this->drag(1, { 80, 0 });
  EXPECT_GT((highest_point(this->window.shown()) - rest).norm(), 0.1);
}

TEST_F(Window, EscapeTakesTheDragBackAndLeavesNoHistory)
{
  this->open_bound();
  const Vec3 rest = highest_point(this->window.shown());
  this->press_and_move(1, { 80, 0 });
  EXPECT_GT((highest_point(this->window.shown()) - rest).norm(), 0.1);
  vtkRenderWindowInteractor* interactor = this->part<app::view::Viewport>()->interactor();
  interactor->SetKeySym("Escape");
  interactor->InvokeEvent(vtkCommand::KeyPressEvent);
  EXPECT_EQ(highest_point(this->window.shown()), rest);
  EXPECT_EQ(this->window.document()->history()->count(), 0);
}

TEST_F(Window, AllMethodsFollowTheHandles)
{
  this->open_bound();
  const Vec3 rest = highest_point(this->window.shown());
  this->drag(1, { 80, 0 });
  const Vec3 linear = highest_point(this->window.shown());
  for (const int handle : { 0, 1 })
  {
    this->window.set_mode(handle, static_cast<int>(HandleMode::full));
  }
  for (const int method : { 1, 2 })
  {
    this->window.set_method(method);
    EXPECT_EQ(this->window.error(), QString());
    // The two handles determine the motion of the top, so all methods agree on it.
    EXPECT_NEAR(
      (highest_point(this->window.shown()) - linear).norm(), 0.0, 0.05 * (linear - rest).norm());
  }
}

TEST_F(Window, ModesAreRememberedAndUndone)
{
  this->open_bound();
  this->window.set_method(2);
  this->window.set_mode(1, 1);
  EXPECT_EQ(this->window.document()->history()->count(), 2);
  this->drag(1, { 60, 0 });
  EXPECT_EQ(this->window.error(), QString());
  this->window.reset_to_rest();
  EXPECT_EQ(this->window.document()->history()->count(), 4);
  for (int step = 0; step < 4; ++step)
  {
    this->window.document()->history()->undo();
  }
  auto* representation =
    this->part<app::view::Viewport>()->handle_widget()->GetHandleSetRepresentation();
  EXPECT_EQ(representation->GetHandleMode(1), static_cast<int>(HandleMode::automatic));
}

TEST_F(Window, BindsOffTheUiThreadWithProgress)
{
  const TriangleMesh mesh = column(3);
  ASSERT_TRUE(this->window.set_mesh(to_polydata(mesh.points, mesh.triangles), "column"));
  ASSERT_TRUE(this->window.set_handles(two_points(), "points"));
  EXPECT_FALSE(this->window.is_bound());
  double last = 0.0;
  std::string decreases; // phases whose progress decreased, and by how much
  int steps = 0;
  QObject::connect(this->window.findChild<app::weights::BindJob*>(),
    &app::weights::BindJob::progress,
    [&](double fraction, const QString& phase)
    {
      if (fraction < last)
      {
        decreases += phase.toStdString() + ": " + std::to_string(last) + " to " +
          std::to_string(fraction) + "; ";
      }
      last = fraction;
      ++steps;
    });
  this->part<app::weights::Binding>()->start();
  EXPECT_TRUE(this->part<app::weights::Binding>()->is_running());
  ASSERT_TRUE(wait_for([this] { return !this->part<app::weights::Binding>()->is_running(); }));
  EXPECT_EQ(this->window.error(), QString());
  ASSERT_TRUE(this->window.is_bound());
  EXPECT_EQ(decreases, "");
  EXPECT_GT(steps, 3);
  this->render();
  const Vec3 rest = highest_point(this->window.shown());
  this->drag(1, { 80, 0 });
  EXPECT_GT((highest_point(this->window.shown()) - rest).norm(), 0.1);
}

TEST_F(Window, ACanceledBindLeavesAtMostItsPreview)
{
  TriangleMesh mesh = test::sphere(5);
  ASSERT_TRUE(this->window.set_mesh(to_polydata(mesh.points, mesh.triangles), "ball"));
  ASSERT_TRUE(this->window.set_handles(two_points(), "points"));
  this->part<app::weights::Binding>()->start();
  wait_for([] { return false; }, 1);
  QElapsedTimer clock;
  clock.start();
  this->part<app::weights::Binding>()->cancel();
  ASSERT_TRUE(wait_for([this] { return !this->part<app::weights::Binding>()->is_running(); }));
  EXPECT_LT(clock.elapsed(), 30000);
  EXPECT_FALSE(this->window.document()->has_preview());
  EXPECT_EQ(this->window.error(), QString());
}

TEST_F(Window, APreviewIsThereToPoseWithBeforeTheBindEnds)
{
  TriangleMesh mesh = test::sphere(5);
  ASSERT_TRUE(this->window.set_mesh(to_polydata(mesh.points, mesh.triangles), "ball"));
  ASSERT_TRUE(this->window.set_handles(two_points(), "points"));
  this->part<app::weights::Binding>()->start();
  ASSERT_TRUE(wait_for([this] { return this->window.is_bound(); }));
  EXPECT_TRUE(this->part<app::weights::Binding>()->is_running());
  ASSERT_TRUE(wait_for([this] { return !this->part<app::weights::Binding>()->is_running(); }));
  EXPECT_TRUE(this->window.is_bound());

  // If the first bind is canceled after its preview, the weights of the preview stay. They are a
  // step that can be undone.
  ASSERT_TRUE(this->window.set_mesh(to_polydata(mesh.points, mesh.triangles), "ball"));
  EXPECT_FALSE(this->window.is_bound());
  this->part<app::weights::Binding>()->start();
  ASSERT_TRUE(wait_for([this] { return this->window.is_bound(); }));
  ASSERT_TRUE(this->part<app::weights::Binding>()->is_running());
  this->part<app::weights::Binding>()->cancel();
  ASSERT_TRUE(wait_for([this] { return !this->part<app::weights::Binding>()->is_running(); }));
  EXPECT_TRUE(this->window.is_bound());
  EXPECT_FALSE(this->window.document()->has_preview());
  EXPECT_EQ(this->window.error(), QString());
  // If the next bind is canceled, the existing weights stay.
  vtkDataArray* kept = this->window.shown()->GetPointData()->GetArray("Weights");
  this->part<app::weights::Binding>()->start();
  ASSERT_TRUE(wait_for([this] { return this->window.document()->has_preview(); }));
  this->part<app::weights::Binding>()->cancel();
  ASSERT_TRUE(wait_for([this] { return !this->part<app::weights::Binding>()->is_running(); }));
  EXPECT_EQ(this->window.shown()->GetPointData()->GetArray("Weights"), kept);
  this->window.document()->history()->undo();
  EXPECT_FALSE(this->window.is_bound());
}

TEST_F(Window, WhatCannotBeOpenedIsSaidAndTheWorkStays)
{
  this->open_bound();
  vtkPolyData* before = this->window.shown();
  EXPECT_FALSE(this->window.open("/no/such/mesh.off"));
  EXPECT_NE(this->window.error().indexOf("mesh.off"), -1) << this->window.error().toStdString();
  const std::string path = testing::TempDir() + "bindpose_broken.off";
  std::ofstream(path) << "OFF\n3 1 0\n0 0 0\n1 0 0\n";
  EXPECT_FALSE(this->window.open(QString::fromStdString(path)));
  std::remove(path.c_str());
  EXPECT_FALSE(this->window.error().isEmpty());
  EXPECT_EQ(this->window.shown(), before);
  EXPECT_TRUE(this->window.is_bound());
}

TEST_F(Window, WeightsOfOtherHandlesAreNotUsed)
{
  this->open_bound();
  Handles single_handle(1);
  single_handle[0].name = "only";
  EXPECT_TRUE(this->window.set_handles(to_polydata(single_handle), "one"));
  EXPECT_FALSE(this->window.is_bound());
  EXPECT_NE(this->window.error().indexOf("weights for 2 handles"), -1);
}

TEST_F(Window, AColumnOfTheWeightsColorsTheSurface)
{
  this->open_bound();
  const QImage shaded = this->part<app::view::Viewport>()->grabFramebuffer();
  this->part<app::handles::SidePanel>()->show_column(1);
  this->render();
  const QImage colored = this->part<app::view::Viewport>()->grabFramebuffer();
  EXPECT_GT(blue_pixels(colored), 2000 + blue_pixels(shaded));
}

TEST_F(Window, WeightsOfHandlesWithOtherNamesAreNotUsed)
{
  const auto mesh = with_linear_weights(column(3));
  mesh->GetPointData()->GetArray("Weights")->SetComponentName(0, "left");
  mesh->GetPointData()->GetArray("Weights")->SetComponentName(1, "right");
  ASSERT_TRUE(this->window.set_mesh(mesh, "column"));
  EXPECT_TRUE(this->window.set_handles(two_points(), "points"));
  EXPECT_FALSE(this->window.is_bound());
  EXPECT_NE(this->window.error().indexOf("other names"), -1);
}

TEST_F(Window, AnotherMeshTakesTheColorsAndTheLegendAway)
{
  this->open_bound();
  const TriangleMesh mesh = column(3);
  this->part<app::handles::SidePanel>()->show_column(1);
  this->render();
  ASSERT_TRUE(this->window.set_mesh(to_polydata(mesh.points, mesh.triangles), "plain"));
  this->render();
  EXPECT_EQ(this->part<app::handles::SidePanel>()->shown_column(), -1);
  EXPECT_EQ(blue_pixels(this->part<app::view::Viewport>()->grabFramebuffer()), 0);
}

TEST_F(Window, AClickOnAHandleSelectsItInTheListEvenIfItIsFree)
{
  this->open_bound();
  this->window.set_mode(1, 2);
  const Eigen::Vector2i at = this->pixel_of(1);
  this->mouse(at, vtkCommand::MouseMoveEvent);
  this->mouse(at, vtkCommand::LeftButtonPressEvent);
  this->mouse(at, vtkCommand::LeftButtonReleaseEvent);
  EXPECT_EQ(this->part<app::handles::SidePanel>()->selected_handle(), 1);
}

TEST_F(Window, ABindKeepsTheSelectedHandle)
{
  const TriangleMesh mesh = column(3);
  ASSERT_TRUE(this->window.set_mesh(to_polydata(mesh.points, mesh.triangles), "column"));
  ASSERT_TRUE(this->window.set_handles(two_points(), "points"));
  this->part<app::handles::SidePanel>()->select_handle(1);
  this->part<app::weights::Binding>()->start();
  EXPECT_EQ(this->part<app::handles::SidePanel>()->selected_handle(), 1);
  ASSERT_TRUE(wait_for([this] { return !this->part<app::weights::Binding>()->is_running(); }));
  EXPECT_EQ(this->part<app::handles::SidePanel>()->selected_handle(), 1);
  auto* representation =
    this->part<app::view::Viewport>()->handle_widget()->GetHandleSetRepresentation();
  EXPECT_EQ(representation->GetSelectedHandle(), 1);
}

TEST_F(Window, TheKeyboardBindsAndCancelsWithoutChoosingAHandle)
{
  const TriangleMesh mesh = test::sphere(5);
  ASSERT_TRUE(this->window.set_mesh(to_polydata(mesh.points, mesh.triangles), "ball"));
  ASSERT_TRUE(this->window.set_handles(two_points(), "points"));
  QApplication::setActiveWindow(&this->window);
  const auto focused = []
  {
    auto* at = qobject_cast<QPushButton*>(QApplication::focusWidget());
    return at ? at->text() : QString();
  };
  for (QPushButton* button :
    this->part<app::handles::SidePanel>()->findChildren<QPushButton*>("primary"))
  {
    button->setFocus();
    ASSERT_EQ(focused(), "Bind");
    button->click();
  }
  EXPECT_EQ(focused(), "Cancel");
  qobject_cast<QPushButton*>(QApplication::focusWidget())->click();
  ASSERT_TRUE(wait_for([this] { return !this->part<app::weights::Binding>()->is_running(); }));
  EXPECT_EQ(focused(), "Bind");
  EXPECT_EQ(this->part<app::handles::SidePanel>()->selected_handle(), -1);
}

TEST_F(Window, UndoDuringADragEndsTheDrag)
{
  this->open_bound();
  const Vec3 rest = highest_point(this->window.shown());
  this->drag(1, { 80, 0 });
  this->press_and_move(1, { 0, 40 });
  this->window.document()->history()->undo();
  EXPECT_FALSE(this->part<app::view::Viewport>()->handle_widget()->IsDragging());
  EXPECT_EQ(highest_point(this->window.shown()), rest);
}

TEST_F(Window, HandlesWithoutAMeshAreInView)
{
  ASSERT_TRUE(this->window.set_handles(two_points(), "points"));
  this->render();
  for (const vtkIdType handle : { 0, 1 })
  {
    const Eigen::Vector2i at = this->pixel_of(handle);
    const int* size = this->part<app::view::Viewport>()->renderer()->GetSize();
    EXPECT_GT(at.x(), 0);
    EXPECT_LT(at.x(), size[0]);
    EXPECT_GT(at.y(), 0);
    EXPECT_LT(at.y(), size[1]);
  }
}

TEST_F(Window, WhatCannotBeDoneYetIsDisabledInTheMenus)
{
  const auto enabled = [this](const char* text)
  {
    for (QAction* menu : this->window.menuBar()->actions())
    {
      for (QAction* entry : menu->menu()->actions())
      {
        if (entry->text().remove('&').startsWith(text))
        {
          return entry->isEnabled();
        }
      }
    }
    ADD_FAILURE() << "no entry " << text;
    return false;
  };
  const std::vector<const char*> disabled_entries = { "Export shape", "Export rig", "Export pose",
    "Export film", "Bind", "Back to rest", "Linear", "Dual", "Reduced", "Full" };
  EXPECT_TRUE(enabled("Open"));
  EXPECT_TRUE(enabled("Export picture"));
  for (const char* text : disabled_entries)
  {
    EXPECT_FALSE(enabled(text)) << text;
  }
  this->open_bound();
  for (const char* text : disabled_entries)
  {
    EXPECT_TRUE(enabled(text)) << text;
  }
}

/// No text of the panel is clipped, for any names of handles and any size of the window.
TEST_F(Window, NoTextOfThePanelIsClipped)
{
  Handles handles(2);
  handles[0].name = "top";
  handles[0].head = handles[0].tail = Vec3(0, 0, 0.9);
  handles[1].name = "the_handle_of_the_left_hind_leg_as_an_exporter_would_name_it";
  handles[1].head = handles[1].tail = Vec3(0, 0, -0.9);
  ASSERT_TRUE(this->window.set_mesh(with_linear_weights(column(3)), "column"));
  ASSERT_TRUE(this->window.set_handles(to_polydata(handles), "points"));
  for (const QSize& size : { QSize(900, 600), QSize(1280, 800), QSize(1920, 1080) })
  {
    this->window.resize(size);
    QApplication::processEvents();
    EXPECT_EQ(this->window.size(), size);
    test::expect_unclipped_items(this->part<app::handles::SidePanel>());
    test::expect_unclipped_buttons(this->part<app::handles::SidePanel>());
    for (QLabel* label : this->part<app::handles::SidePanel>()->findChildren<QLabel*>())
    {
      if (!label->isVisible())
      {
        continue;
      }
      EXPECT_LE(label->heightForWidth(label->width()), label->height())
        << label->text().toStdString();
      EXPECT_GT(label->height(), 0);
    }
    EXPECT_GT(this->part<app::handles::SidePanel>()->handle_list()->tree()->height(), 60);
  }
}

TEST_F(Window, ChoosingPanelsKeepsTheSize)
{
  this->window.resize(1100, 700);
  this->open_bound();
  for (const int panel : { app::window::PanelColumn::tets, app::window::PanelColumn::bind_and_pose,
         app::window::PanelColumn::weights, app::window::PanelColumn::tets,
         app::window::PanelColumn::weights, app::window::PanelColumn::bind_and_pose })
  {
    this->part<app::window::PanelColumn>()->show_panel(panel);
    QApplication::processEvents();
    EXPECT_EQ(this->part<app::window::PanelColumn>()->shown_panel(), panel);
    EXPECT_EQ(this->window.size(), QSize(1100, 700)) << "panel " << panel;
  }
}

TEST_F(Window, HandlesAreDraggedBesideAnOpenVolumeInThePanelPose)
{
  this->open_bound();
  vtkNew<vtkImageData> volume;
  volume->SetDimensions(9, 9, 9);
  volume->SetSpacing(0.4, 0.4, 0.4);
  volume->SetOrigin(-1.6, -1.6, -1.6);
  vtkNew<vtkDoubleArray> values;
  values->SetName("WindingNumber");
  for (vtkIdType i = 0; i < volume->GetNumberOfPoints(); ++i)
  {
    values->InsertNextValue(i % 2);
  }
  volume->GetPointData()->AddArray(values);
  ASSERT_TRUE(this->window.set_volume(volume, "field"));
  EXPECT_TRUE(this->window.is_bound());
  this->render();
  const double slice = this->part<app::volume::VolumeView>()->position();
  const Vec3 rest = highest_point(this->window.shown());
  // While the slice is shown, the shape is at rest and handles cannot be dragged. A drag that
  // begins on a handle does not move the slice behind the handle either.
  this->drag(1, { 80, 0 });
  EXPECT_EQ(highest_point(this->window.shown()), rest);
  EXPECT_EQ(this->part<app::volume::VolumeView>()->position(), slice);
  this->part<app::window::PanelColumn>()->show_panel(app::window::PanelColumn::bind_and_pose);
  this->render();
  this->drag(1, { 80, 0 });
  EXPECT_GT((highest_point(this->window.shown()) - rest).norm(), 0.1);
  EXPECT_EQ(this->part<app::volume::VolumeView>()->position(), slice);
  EXPECT_EQ(this->window.document()->history()->count(), 2); // steps: open volume, drag handle
}

TEST_F(Window, ALongErrorDoesNotWidenTheWindow)
{
  this->window.resize(900, 600);
  QApplication::processEvents();
  EXPECT_FALSE(this->window.open(QString("/no/such/%1.off").arg(QString(300, 'x'))));
  QApplication::processEvents();
  EXPECT_EQ(this->window.width(), 900);
  EXPECT_LT(this->window.error().size(), 150);
}

TEST_F(Window, TurnsDarkAndLightAgain)
{
  this->open_bound();
  this->part<app::handles::SidePanel>()->show_column(1);
  this->render();
  const QImage light = this->window.grab().toImage();
  const auto tools =
    this->window.findChild<app::handles::EditTools*>()->findChildren<QToolButton*>();
  std::vector<QImage> light_icons;
  for (const QToolButton* tool : tools)
  {
    light_icons.push_back(tool->icon().pixmap(20).toImage());
  }
  app::parts::choose_appearance(*qApp, app::parts::Appearance::dark);
  EXPECT_EQ(app::parts::chosen_appearance(), app::parts::Appearance::dark);
  EXPECT_TRUE(app::parts::is_dark());
  this->render();
  const QImage dark = this->window.grab().toImage();
  for (int k = 0; k < tools.size(); ++k)
  {
    EXPECT_NE(tools[k]->icon().pixmap(20).toImage(), light_icons[static_cast<std::size_t>(k)])
      << tools[k]->text().toStdString();
  }
  if (const char* folder = std::getenv("BINDPOSE_PICTURES"))
  {
    EXPECT_TRUE(dark.save(QString(folder) + "/dark.png"));
  }
  // Panel, menu and view have a dark background and light text.
  const auto light_fraction = [](const QImage& image, const QRect& at)
  {
    int light_pixels = 0, all = 0;
    for (int y = at.top(); y <= at.bottom(); ++y)
    {
      for (int x = at.left(); x <= at.right(); ++x, ++all)
      {
        light_pixels += qGray(image.pixel(x, y)) > 128;
      }
    }
    return static_cast<double>(light_pixels) / all;
  };
  for (const QWidget* part : { static_cast<const QWidget*>(this->part<app::handles::SidePanel>()),
         static_cast<const QWidget*>(this->window.menuBar()),
         static_cast<const QWidget*>(this->part<app::view::Viewport>()) })
  {
    const QRect at(part->mapTo(&this->window, QPoint()), part->size());
    EXPECT_LT(light_fraction(dark, at), 0.3) << part->metaObject()->className();
    EXPECT_GT(light_fraction(dark, at), 0.0005) << part->metaObject()->className();
    EXPECT_GT(light_fraction(light, at), 0.7) << part->metaObject()->className();
  }
  app::parts::choose_appearance(*qApp, app::parts::Appearance::light);
  EXPECT_FALSE(app::parts::is_dark());
  app::parts::choose_appearance(*qApp, app::parts::Appearance::system);
  EXPECT_FALSE(app::parts::is_dark()) << "the desktop of the tests is light";
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  if (testing::GTEST_FLAG(list_tests))
  {
    return RUN_ALL_TESTS(); // the build lists the tests, perhaps on a machine without a display
  }
  // The tests must not change the recent files and the backups of the user.
  const bindpose::test::Folder folder;
  qputenv("XDG_CONFIG_HOME", QByteArray::fromStdString(folder / "config"));
  qputenv("XDG_DATA_HOME", QByteArray::fromStdString(folder / "data"));
  QSurfaceFormat::setDefaultFormat(QVTKOpenGLNativeWidget::defaultFormat());
  QApplication application(argc, argv);
  app::parts::apply_style(application);
  return RUN_ALL_TESTS();
}
