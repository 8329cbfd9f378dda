// Interactive editing of handles with Qt mouse and key events on the view. The tests check the
// effect on the document, and that undo and redo restore all bits.
#include "app/weights/binding.h"
#include "unclipped.h"
#include "window_test.h"

#include "app/handles/edit_tools.h"
#include "app/handles/handle_commands.h"
#include "app/handles/handle_editing.h"
#include "app/handles/handle_selection.h"
#include "app/handles/shape_handles.h"
#include "app/handles/side_panel.h"
#include "app/parts/notice_bar.h"
#include "app/parts/window_keys.h"
#include "app/posing/posing.h"
#include "app/window/shortcut_sheet.h"
#include "document/document.h"

#include "support/handles.h"
#include "support/meshes.h"
#include "weights_arrays.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkHandleSetRepresentation.h"
#include "vtkHandleSetWidget.h"
#include "vtkPointData.h"
#include "vtkRegionBrushRepresentation.h"
#include "vtkRegionBrushWidget.h"

#include <QAction>
#include <QCheckBox>
#include <QContextMenuEvent>
#include <QInputDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QPushButton>
#include <QSlider>
#include <QStatusBar>
#include <QTableWidget>
#include <QToolButton>
#include <QTreeWidget>
#include <QUndoStack>
#include <QtTest/qtestkeyboard.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

using namespace bindpose;
using test::wait_for;
using Representation = vtkHandleSetRepresentation;

namespace
{
class HandleWindow : public test::WindowTest
{
protected:
  HandleWindow() { QApplication::setActiveWindow(&this->window); }

  /// Open a pole along z from -1 to 1, with radius 0.4.
  void open_mesh(int levels = 3)
  {
    TriangleMesh mesh = test::sphere(levels);
    mesh.points.col(0) *= 0.4;
    mesh.points.col(1) *= 0.4;
    this->surface = to_polydata(mesh.points, mesh.triangles);
    ASSERT_TRUE(this->window.set_mesh(this->surface, "pole"));
    this->window.document()->history()->clear();
    this->render();
  }

  /// Open a bound pole with two point handles and a bone between them.
  void open_bound()
  {
    const Handles list{ test::point_handle("left", Vec3(-0.3, 0, 0.5)),
      test::point_handle("right", Vec3(0.3, 0, 0.5)),
      test::bone_handle("spine", Vec3(0, 0, -0.8), Vec3(0, 0, 0)) };
    TriangleMesh mesh = test::sphere(3);
    mesh.points.col(0) *= 0.4;
    mesh.points.col(1) *= 0.4;
    Weights weights(mesh.points.rows(), 3);
    for (Index v = 0; v < mesh.points.rows(); ++v)
    {
      for (Index j = 0; j < 3; ++j)
      {
        const Vec3 middle = 0.5 * (list[j].head + list[j].tail);
        weights(v, j) = 1.0 / (1e-3 + (mesh.points.row(v).transpose() - middle).squaredNorm());
      }
      weights.row(v) /= weights.row(v).sum();
    }
    this->surface = to_polydata(mesh.points, mesh.triangles);
    this->surface->GetPointData()->AddArray(to_weights_array("Weights", weights, list));
    ASSERT_TRUE(this->window.set_mesh(this->surface, "pole"));
    ASSERT_TRUE(this->window.set_handles(to_polydata(list), "handles"));
    ASSERT_TRUE(this->window.is_bound());
    this->window.document()->history()->clear();
    this->render();
  }

  app::handles::HandleEditing* editing() { return this->part<app::handles::HandleEditing>(); }
  app::handles::HandleCommands* commands() { return this->editing()->commands(); }
  Document* document() { return this->window.document(); }
  QUndoStack* history() { return this->window.document()->history(); }
  app::view::Viewport* viewport() { return this->part<app::view::Viewport>(); }
  vtkHandleSetWidget* widget() { return this->viewport()->handle_widget(); }
  Representation* representation() { return this->widget()->GetHandleSetRepresentation(); }
  const Handle& handle(const std::string& name)
  {
    for (const Handle& each : this->document()->handles())
    {
      if (each.name == name)
      {
        return each;
      }
    }
    static const Handle none;
    ADD_FAILURE() << "there is no " << name;
    return none;
  }
  int number(const std::string& name)
  {
    for (std::size_t k = 0; k < this->document()->handles().size(); ++k)
    {
      if (this->document()->handles()[k].name == name)
      {
        return static_cast<int>(k);
      }
    }
    return -1;
  }
  QStringList names()
  {
    QStringList result;
    for (const Handle& each : this->document()->handles())
    {
      result << QString::fromStdString(each.name);
    }
    return result;
  }
  Points points() { return to_points(this->window.shown()).view(); }

  void key(Qt::Key which, Qt::KeyboardModifiers modifiers = Qt::NoModifier)
  {
    this->viewport()->setFocus();
    QTest::keyClick(this->viewport(), which, modifiers);
    QApplication::processEvents();
  }
  void click(const QPoint& position)
  {
    this->hover(position);
    this->mouse(QEvent::MouseButtonPress, position, Qt::LeftButton, Qt::LeftButton);
    this->mouse(QEvent::MouseButtonRelease, position, Qt::LeftButton, Qt::NoButton);
    this->render();
  }
  void press(const QPoint& from, const QPoint& to)
  {
    this->hover(from);
    this->mouse(QEvent::MouseButtonPress, from, Qt::LeftButton, Qt::LeftButton);
    for (int step = 1; step <= 4; ++step)
    {
      this->mouse(QEvent::MouseMove, from + (to - from) * step / 4, Qt::NoButton, Qt::LeftButton);
    }
  }
  void release(const QPoint& position)
  {
    this->mouse(QEvent::MouseButtonRelease, position, Qt::LeftButton, Qt::NoButton);
    this->render();
  }
  QPoint grip(int part)
  {
    double position[2] = { 0, 0 };
    EXPECT_TRUE(this->representation()->GetGizmoGrip(part, position));
    return { static_cast<int>(position[0]),
      this->viewport()->height() - 1 - static_cast<int>(position[1]) };
  }
  QString hint()
  {
    for (QLabel* label : this->window.statusBar()->findChildren<QLabel*>())
    {
      if (!label->text().isEmpty())
      {
        return label->text();
      }
    }
    return {};
  }

  /// Return the handles, the pose and the surface as text that distinguishes all their bits.
  std::string state()
  {
    std::ostringstream out;
    out << std::hexfloat;
    for (const Handle& each : this->document()->handles())
    {
      out << each.name << static_cast<int>(each.kind) << each.parent << each.region_id
          << each.cage.size() << each.head.transpose() << each.tail.transpose() << '\n';
    }
    for (const HandlePose& each : this->document()->pose())
    {
      out << static_cast<int>(each.mode) << each.transform << each.stretch << each.twist << '\n';
    }
    vtkPolyData* data = this->document()->handle_data();
    for (const char* name : { "Color", "Locked" })
    {
      vtkDataArray* array = data ? data->GetCellData()->GetArray(name) : nullptr;
      for (vtkIdType i = 0; array && i < array->GetNumberOfValues(); ++i)
      {
        out << array->GetVariantValue(i).ToDouble() << ' ';
      }
    }
    vtkPolyData* shape = this->document()->work().surface;
    vtkDataArray* labels = shape ? shape->GetPointData()->GetArray("RegionId") : nullptr;
    for (vtkIdType v = 0; labels && v < labels->GetNumberOfTuples(); ++v)
    {
      out << labels->GetComponent(v, 0);
    }
    return out.str();
  }
  /// Expect that the edit is one undo step with this name. Undo and redo must restore all bits of
  /// the states before and after the edit.
  template <typename Edit>
  void check(const QString& name, const Edit& edit)
  {
    SCOPED_TRACE(name.toStdString());
    const int steps = this->history()->index();
    const std::string before = this->state();
    const QString error = this->window.error();
    edit();
    const std::string after = this->state();
    EXPECT_NE(after, before);
    ASSERT_EQ(this->history()->index(), steps + 1);
    EXPECT_EQ(this->history()->undoText().toStdString(), name.toStdString());
    this->history()->undo();
    EXPECT_EQ(this->state(), before);
    this->history()->redo();
    EXPECT_EQ(this->state(), after);
    EXPECT_EQ(this->window.error().toStdString(), error.toStdString());
  }

  vtkSmartPointer<vtkPolyData> surface;
};
} // namespace

// ---- Adding ------------------------------------------------------------------------------------

TEST_F(HandleWindow, HandlesComeFromTheShape)
{
  this->open_mesh();
  app::handles::ShapeHandles* handle_creator = this->part<app::handles::ShapeHandles>();
  const auto wait = [handle_creator]
  { return wait_for([handle_creator] { return !handle_creator->is_running(); }); };
  handle_creator->start(AutomaticMethod::points, 5);
  EXPECT_TRUE(handle_creator->is_running());
  EXPECT_FALSE(this->bar("note_bar")->message().isEmpty());
  ASSERT_TRUE(wait());
  EXPECT_EQ(this->window.error(), QString());
  EXPECT_EQ(this->bar("note_bar")->message(), QString());
  EXPECT_EQ(this->names(), QStringList({ "p1", "p2", "p3", "p4", "p5" }));
  EXPECT_EQ(this->history()->undoText(), "points spread over the shape");
  for (const Handle& each : this->document()->handles())
  {
    EXPECT_LT((each.head.array() / Vec3(0.4, 0.4, 1.0).array()).matrix().norm(), 1.0) << "inside";
  }
  // A canceled computation keeps the existing handles.
  handle_creator->start(AutomaticMethod::points, 7);
  handle_creator->cancel();
  ASSERT_TRUE(wait());
  EXPECT_EQ(this->names().size(), 5);
  EXPECT_EQ(this->window.error(), QString());
  handle_creator->start(AutomaticMethod::points, 1000000);
  ASSERT_TRUE(wait());
  EXPECT_TRUE(this->window.error().contains("Cannot create handles"))
    << this->window.error().toStdString();
  EXPECT_EQ(this->names().size(), 5);
  this->history()->undo();
  EXPECT_TRUE(this->names().isEmpty());
  handle_creator->start(AutomaticMethod::skeleton, 0);
  ASSERT_TRUE(wait());
  ASSERT_FALSE(this->names().isEmpty());
  for (const Handle& each : this->document()->handles())
  {
    EXPECT_LT(each.head.head<2>().norm(), 0.1) << "the pole's middle";
    EXPECT_LT(each.tail.head<2>().norm(), 0.1);
  }
}

TEST_F(HandleWindow, AutoRigMakesBonesAndBindsThem)
{
  this->open_mesh();
  app::handles::ShapeHandles* handle_creator = this->part<app::handles::ShapeHandles>();
  const auto wait = [&]
  {
    return wait_for(
      [&] {
        return !handle_creator->is_running() && !this->part<app::weights::Binding>()->is_running();
      });
  };
  handle_creator->auto_rig_action()->trigger();
  EXPECT_TRUE(handle_creator->is_running());
  EXPECT_FALSE(handle_creator->auto_rig_action()->isEnabled());
  ASSERT_TRUE(wait());
  EXPECT_EQ(this->window.error(), QString());
  ASSERT_FALSE(this->document()->handles().empty());
  EXPECT_EQ(this->document()->handles().front().kind, HandleKind::bone);
  EXPECT_TRUE(this->window.is_bound());
  EXPECT_EQ(this->history()->undoText(), "bind");
  this->history()->undo();
  this->history()->undo();
  EXPECT_TRUE(this->document()->handles().empty());
  EXPECT_FALSE(this->window.is_bound());

  // The automatic method finds no bones in a ball, so the ball gets point handles.
  const TriangleMesh ball = test::sphere(3);
  ASSERT_TRUE(this->window.set_mesh(to_polydata(ball.points, ball.triangles), "ball"));
  handle_creator->auto_rig_action()->trigger();
  ASSERT_TRUE(wait());
  EXPECT_EQ(this->window.error(), QString());
  EXPECT_EQ(this->names().size(), 8);
  EXPECT_EQ(this->document()->handles().front().kind, HandleKind::point);
  EXPECT_TRUE(this->window.is_bound());
}

TEST_F(HandleWindow, PointsAreAddedToAMeshWithoutHandlesAndBound)
{
  this->open_mesh();
  auto* nothing = this->window.findChild<QWidget*>("nothing");
  EXPECT_TRUE(nothing->isVisible());
  this->key(Qt::Key_A);
  EXPECT_EQ(this->editing()->mode(), app::handles::HandleEditing::add_points);
  EXPECT_FALSE(nothing->isVisible());
  const QPoint top = this->pixel(Vec3(0, 0, 0.6));
  const QPoint bottom = this->pixel(Vec3(0, 0, -0.6));
  this->check("add point p1", [&] { this->click(top); });
  this->check("add point p2", [&] { this->click(bottom); });
  ASSERT_EQ(this->names(), QStringList({ "p1", "p2" }));
  // The point is halfway through the pole: near its axis, at the height of the mouse.
  EXPECT_NEAR(this->handle("p1").head.z(), 0.6, 0.05);
  EXPECT_LT(this->handle("p1").head.head<2>().norm(), 0.1);
  // With PlaceInside off, the point is on the surface of the ellipsoid.
  this->key(Qt::Key_I);
  this->check("add point p3", [&] { this->click(this->pixel(Vec3(0, 0, 0.0))); });
  const Vec3 surface_point = this->handle("p3").head;
  EXPECT_NEAR(
    Vec3(surface_point.x() / 0.4, surface_point.y() / 0.4, surface_point.z()).norm(), 1.0, 0.02);
  EXPECT_EQ(this->part<app::handles::SidePanel>()->selected_handle(), 2);
  this->key(Qt::Key_Escape);
  EXPECT_EQ(this->editing()->mode(), app::handles::HandleEditing::pose);
  // A bar above the view offers a bind, but the bind does not start by itself. After the bind, the
  // handles bend the shape.
  EXPECT_FALSE(this->window.is_bound());
  this->part<app::weights::Binding>()->start();
  ASSERT_TRUE(wait_for([this] { return !this->part<app::weights::Binding>()->is_running(); }));
  ASSERT_TRUE(this->window.is_bound()) << this->window.error().toStdString();
  this->render();
  const Points rest = this->points();
  const QPoint position = this->pixel(this->handle("p1").head);
  this->check("move p1", [&] { this->drag(position, position + QPoint(60, 0)); });
  EXPECT_GT((this->points() - rest).rowwise().norm().maxCoeff(), 0.05);
}

TEST_F(HandleWindow, UndoingEverythingLeavesNoHandlesAndTheyCanBeAddedAgain)
{
  this->open_mesh();
  const std::string empty = this->state();
  this->key(Qt::Key_A);
  this->click(this->pixel(Vec3(0, 0, 0.5)));
  this->click(this->pixel(Vec3(0, 0, -0.5)));
  while (this->history()->canUndo())
  {
    this->history()->undo();
  }
  EXPECT_EQ(this->state(), empty);
  EXPECT_EQ(this->document()->handle_data(), nullptr);
  this->click(this->pixel(Vec3(0, 0, 0.2)));
  EXPECT_EQ(this->names(), QStringList({ "p1" }));
}

TEST_F(HandleWindow, BonesAreDrawnAsAChain)
{
  this->open_mesh();
  this->key(Qt::Key_B);
  const QPoint bottom = this->pixel(Vec3(0, 0, -0.8));
  const QPoint middle = this->pixel(Vec3(0, 0, 0));
  const QPoint top = this->pixel(Vec3(0, 0, 0.8));
  this->check("add bone b1", [&] { this->drag(bottom, middle); });
  this->check("add bone b2", [&] { this->drag(middle, top); });
  ASSERT_EQ(this->names(), QStringList({ "b1", "b2" }));
  EXPECT_EQ(this->handle("b2").parent, this->number("b1"));
  EXPECT_EQ(this->handle("b2").head, this->handle("b1").tail);
  EXPECT_NEAR((this->handle("b2").tail - this->handle("b2").head).norm(), 0.8, 0.1);
  // A click does not add a bone. Esc discards an unfinished bone.
  const std::string before = this->state();
  const int steps = this->history()->count();
  this->click(this->pixel(Vec3(0.1, 0, 0.3)));
  this->press(bottom, top);
  EXPECT_TRUE(this->hint().contains("Esc")) << this->hint().toStdString();
  this->key(Qt::Key_Escape);
  this->release(top);
  EXPECT_EQ(this->state(), before);
  EXPECT_EQ(this->history()->count(), steps);
  EXPECT_EQ(this->editing()->mode(), app::handles::HandleEditing::add_bones);
}

TEST_F(HandleWindow, CagesAreClosedLeftOpenAndTakenBackVertexByVertex)
{
  this->open_mesh();
  this->key(Qt::Key_C);
  const Vec3 corners[] = { Vec3(-0.5, 0, -0.9), Vec3(0.5, 0, -0.9), Vec3(0.5, 0, 0.9) };
  for (int k = 0; k < 3; ++k)
  {
    this->check(
      QString("add cage vertex c%1").arg(k + 1), [&] { this->click(this->pixel(corners[k])); });
  }
  this->check("close cage", [&] { this->click(this->pixel(this->handle("c1").head)); });
  const auto edges = [this]
  {
    std::size_t count = 0;
    for (const Handle& each : this->document()->handles())
    {
      count += each.cage.size();
    }
    return count;
  };
  EXPECT_EQ(edges(), 3U);
  this->key(Qt::Key_Escape);
  EXPECT_EQ(this->editing()->mode(), app::handles::HandleEditing::pose);
  while (this->history()->canUndo())
  {
    this->history()->undo();
  }
  // Three clicks add cage vertices. A fourth click on the first vertex closes the cage.
  this->key(Qt::Key_C);
  for (const Vec3& corner : corners)
  {
    this->click(this->pixel(corner));
  }
  EXPECT_EQ(edges(), 2U);
  this->click(this->pixel(this->handle("c1").head));
  EXPECT_EQ(this->history()->undoText(), "close cage");
  EXPECT_EQ(edges(), 3U);
  EXPECT_FALSE(this->representation()->IsMakingCage());
  // Esc removes the last vertex; the next Esc ends the mode.
  this->history()->clear();
  const std::string closed = this->state();
  this->click(this->pixel(Vec3(-0.9, 0, 0.3)));
  EXPECT_TRUE(this->representation()->IsMakingCage());
  EXPECT_TRUE(this->hint().contains("closes the cage")) << this->hint().toStdString();
  this->key(Qt::Key_Escape);
  EXPECT_EQ(this->history()->undoText(), "remove cage vertex");
  EXPECT_EQ(this->state(), closed);
  this->key(Qt::Key_Escape);
  EXPECT_EQ(this->editing()->mode(), app::handles::HandleEditing::pose);
  // Enter ends a cage without closing it.
  this->key(Qt::Key_C);
  this->click(this->pixel(Vec3(-0.9, 0, 0.3)));
  this->click(this->pixel(Vec3(-0.9, 0, -0.3)));
  this->key(Qt::Key_Return);
  EXPECT_FALSE(this->representation()->IsMakingCage());
  EXPECT_EQ(edges(), 4U);
}

TEST_F(HandleWindow, RegionsArePaintedErasedAndUndone)
{
  this->open_mesh(4);
  this->key(Qt::Key_P);
  ASSERT_EQ(this->editing()->mode(), app::handles::HandleEditing::paint_regions);
  const auto count_labeled = [this](int label)
  {
    vtkDataArray* labels = this->document()->work().surface->GetPointData()->GetArray("RegionId");
    int count = 0;
    for (vtkIdType v = 0; labels && v < labels->GetNumberOfTuples(); ++v)
    {
      count += labels->GetComponent(v, 0) == label;
    }
    return count;
  };
  const QImage plain = this->picture();
  const QPoint top = this->pixel(Vec3(0, 0, 0.7));
  const QPoint bottom = this->pixel(Vec3(0, 0, -0.7));
  this->check("paint region r1", [&] { this->drag(top, top + QPoint(10, 0)); });
  EXPECT_NE(this->picture(), plain);
  EXPECT_EQ(this->handle("r1").kind, HandleKind::region);
  EXPECT_EQ(this->handle("r1").region_id, 1);
  const int first = count_labeled(1);
  EXPECT_GT(first, 3);
  Vec3 middle = Vec3::Zero();
  vtkPolyData* painted = this->document()->work().surface;
  for (vtkIdType v = 0; v < painted->GetNumberOfPoints(); ++v)
  {
    if (painted->GetPointData()->GetArray("RegionId")->GetComponent(v, 0) == 1)
    {
      middle += Vec3(painted->GetPoint(v)) / first;
    }
  }
  EXPECT_LT((this->handle("r1").head - middle).norm(), 1e-12);
  // The next stroke paints the same label. After a click on "New region", a stroke paints another
  // label.
  this->check("paint region r1", [&] { this->drag(top, top + QPoint(0, 40)); });
  EXPECT_GT(count_labeled(1), first);
  for (QPushButton* button :
    this->window.findChild<app::handles::ModeBar*>()->findChildren<QPushButton*>())
  {
    if (button->text() == "New region")
    {
      EXPECT_TRUE(button->isEnabled());
      button->click();
    }
  }
  this->check("paint region r2", [&] { this->drag(bottom, bottom + QPoint(5, 0)); });
  EXPECT_EQ(this->handle("r2").region_id, 2);
  EXPECT_GT(count_labeled(2), 0);
  // A stroke that is canceled with Esc has no effect, and the edit mode continues.
  const std::string before = this->state();
  this->press(bottom, bottom + QPoint(0, -60));
  this->key(Qt::Key_Escape);
  this->release(bottom + QPoint(0, -60));
  EXPECT_EQ(this->state(), before);
  EXPECT_EQ(this->editing()->mode(), app::handles::HandleEditing::paint_regions);
  // Deleting a region also deletes its labels.
  this->editing()->selection()->select({ this->number("r2") });
  this->check("delete r2", [&] { this->key(Qt::Key_Delete); });
  EXPECT_EQ(count_labeled(2), 0);
  // A key and a slider change the size of the brush.
  auto* brush = this->viewport()->brush_widget()->GetRegionBrushRepresentation();
  const double radius = brush->GetDiscRadius();
  this->key(Qt::Key_BracketRight);
  EXPECT_GT(brush->GetDiscRadius(), radius);
  this->window.findChild<app::handles::ModeBar*>()->findChild<QSlider*>()->setValue(60);
  EXPECT_LT(brush->GetDiscRadius(), radius);
  this->key(Qt::Key_Escape);
  EXPECT_EQ(this->editing()->mode(), app::handles::HandleEditing::pose);
}

TEST_F(HandleWindow, WhatCannotBePlacedIsOneSentence)
{
  this->open_mesh();
  this->key(Qt::Key_A);
  const QPoint position = this->pixel(Vec3(0, 0, 0.5));
  this->click(position);
  const int steps = this->history()->count();
  this->click(position); // a second point at this position is refused
  EXPECT_EQ(this->history()->count(), steps);
  EXPECT_TRUE(this->editing()->is_warning());
  EXPECT_TRUE(this->hint().contains("p1")) << this->hint().toStdString();
  EXPECT_EQ(this->hint().count('.'), 1);
  this->click(this->pixel(Vec3(0, 0, -0.5)));
  EXPECT_FALSE(this->editing()->is_warning());
}

// ---- Changing ----------------------------------------------------------------------------------

TEST_F(HandleWindow, ANewPointMovesNumbersAndNothingElse)
{
  this->open_bound();
  this->document()->set_mode(2, static_cast<int>(HandleMode::ends));
  this->editing()->selection()->select({ 2 });
  this->part<app::handles::SidePanel>()->show_column(2);
  Pose pose = this->document()->pose();
  pose[2].transform.col(3) = Vec3(0.1, 0, 0);
  this->document()->set_pose(pose, "pose");
  const Points posed = this->points();
  this->editing()->set_mode(app::handles::HandleEditing::add_points);
  this->render();
  this->click(this->pixel(Vec3(0, 0, 0.85)));
  ASSERT_EQ(this->names(), QStringList({ "left", "right", "p1", "spine" }));
  EXPECT_EQ(this->document()->pose()[3].mode, HandleMode::ends);
  EXPECT_EQ(this->document()->pose()[3].transform, pose[2].transform);
  // The column of the bone "spine" is still shown.
  EXPECT_EQ(this->part<app::handles::SidePanel>()->shown_column(), 3);
  this->editing()->set_mode(app::handles::HandleEditing::pose);
  EXPECT_LT((this->points() - posed).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_FALSE(this->bar("rebind_bar")->isHidden()); // the window offers a new bind
  // Undo and redo change the index of the bone "spine". The bone stays selected.
  this->editing()->selection()->select({ 3 });
  this->history()->undo();
  ASSERT_EQ(this->names().size(), 3);
  EXPECT_EQ(this->editing()->selection()->selected(), std::vector<int>{ 2 });
  EXPECT_EQ(this->part<app::handles::SidePanel>()->selected_handle(), 2);
  EXPECT_EQ(this->document()->pose()[2].mode, HandleMode::ends);
  this->history()->redo();
  EXPECT_EQ(this->editing()->selection()->selected(), std::vector<int>{ 3 });
  EXPECT_EQ(this->part<app::handles::SidePanel>()->selected_handle(), 3);
}

TEST_F(HandleWindow, RestPlacesAreMovedAndARebindIsOffered)
{
  this->open_bound();
  Pose pose = this->document()->pose();
  pose[0].transform.col(3) = Vec3(-0.2, 0, 0);
  this->document()->set_pose(pose, "pose");
  const Points rest = to_points(this->surface).view();
  this->key(Qt::Key_M);
  this->render();
  EXPECT_EQ(this->points(), rest); // the shape is shown at rest
  const QPoint position = this->pixel(this->handle("left").head);
  EXPECT_TRUE(this->bar("rebind_bar")->isHidden());
  this->check("move at rest left", [&] { this->drag(position, position + QPoint(0, 30)); });
  EXPECT_GT((this->handle("left").head - Vec3(-0.3, 0, 0.5)).norm(), 0.02);
  EXPECT_FALSE(this->bar("rebind_bar")->isHidden());
  this->render(); // the bar that offers a bind has appeared over the view
  // Esc during the drag restores the state bit by bit.
  const std::string before = this->state();
  const int steps = this->history()->count();
  const QPoint from = this->pixel(this->handle("right").head);
  this->press(from, from + QPoint(30, 30));
  EXPECT_NE(this->representation()->GetActiveHandle(), -1);
  this->key(Qt::Key_Escape);
  this->release(from + QPoint(30, 30));
  EXPECT_EQ(this->state(), before);
  EXPECT_EQ(this->history()->count(), steps);
  this->key(Qt::Key_Escape);
  EXPECT_EQ(this->editing()->mode(), app::handles::HandleEditing::pose);
  EXPECT_NE(this->points(), rest);
}

TEST_F(HandleWindow, TheGizmoDragsAlongAnAxisAndIsCanceledBitByBit)
{
  this->open_bound();
  this->click(this->pixel(this->handle("right").head));
  ASSERT_EQ(this->editing()->selection()->selected(), std::vector<int>{ 1 });
  this->key(Qt::Key_W);
  EXPECT_EQ(this->representation()->GetGizmo(), Representation::GIZMO_MOVE);
  this->render();
  // The drag follows the projected axis, with some deviation from it.
  const QPoint z = this->grip(Representation::MOVE_Z);
  const Vec3 head = this->handle("right").head;
  const QPoint along = this->pixel(head + Vec3(0, 0, 0.3)) - this->pixel(head);
  this->check("move right", [&] { this->drag(z, z + along + QPoint(5, -9)); });
  Vec3 translation = this->document()->pose()[1].transform.col(3);
  EXPECT_GT(translation.z(), 0.05);
  EXPECT_EQ(translation.x(), 0.0);
  EXPECT_EQ(translation.y(), 0.0);
  // A canceled drag restores the state bit by bit.
  const std::string before = this->state();
  const Points posed = this->points();
  const QPoint x = this->grip(Representation::MOVE_X);
  this->press(x, x + QPoint(40, 10));
  EXPECT_NE(this->state(), before);
  EXPECT_TRUE(this->hint().startsWith("Move X")) << this->hint().toStdString();
  this->key(Qt::Key_Escape);
  EXPECT_EQ(this->state(), before);
  EXPECT_EQ(this->points(), posed);
  this->release(x + QPoint(40, 10));
  EXPECT_EQ(this->state(), before);
  EXPECT_EQ(this->history()->undoText(), "move right");
  // The rings of the gizmo rotate, and its boxes scale.
  this->key(Qt::Key_E);
  this->render();
  const QPoint ring = this->grip(Representation::TURN_VIEW);
  this->check("turn right", [&] { this->drag(ring, ring + QPoint(20, 20)); });
  this->key(Qt::Key_D);
  this->render();
  const QPoint box = this->grip(Representation::SCALE_X);
  this->check("scale right", [&] { this->drag(box, box + QPoint(20, 0)); });
  EXPECT_NE(this->editing()->action("gizmo.scale"), nullptr);
  EXPECT_TRUE(this->editing()->action("gizmo.scale")->isChecked());
}

TEST_F(HandleWindow, StretchGoesToTheBoneOnlyWhereItIsSeen)
{
  this->open_bound();
  EXPECT_FALSE(this->representation()->GetStretchableBones());
  this->window.set_method(static_cast<int>(PoseMethod::stretchable_bones));
  EXPECT_TRUE(this->representation()->GetStretchableBones());
  this->history()->undo();
  EXPECT_FALSE(this->representation()->GetStretchableBones());
}

/// During a drag, letters and digits control the drag. At other times they are shortcuts of the
/// window.
TEST_F(HandleWindow, KeysOfADragAreNoShortcuts)
{
  this->open_bound();
  const QPoint position = this->pixel(this->handle("right").head);
  this->click(position);
  const int method = this->document()->number("pose.method");
  this->hover(position);
  this->key(Qt::Key_G);
  ASSERT_TRUE(this->widget()->IsDragging());
  this->key(Qt::Key_Z);
  this->key(Qt::Key_Period);
  this->key(Qt::Key_2);
  this->key(Qt::Key_5);
  this->key(Qt::Key_A); // this key must not start an edit mode
  this->key(Qt::Key_Space); // this key must not start playback
  EXPECT_EQ(this->editing()->mode(), app::handles::HandleEditing::pose);
  EXPECT_EQ(this->document()->number("pose.method"), method);
  EXPECT_TRUE(this->hint().contains("Z .25")) << this->hint().toStdString();
  this->key(Qt::Key_Return);
  EXPECT_FALSE(this->widget()->IsDragging());
  EXPECT_EQ(Vec3(this->document()->pose()[1].transform.col(3)), Vec3(0, 0, 0.25));
  EXPECT_EQ(this->history()->undoText(), "move right");
  // Without a drag, the same keys are shortcuts of the window.
  this->key(Qt::Key_2);
  EXPECT_EQ(this->document()->number("pose.method"), 1);
  // R rotates the selected handle, and T shows the shape at rest.
  this->key(Qt::Key_R);
  EXPECT_TRUE(this->widget()->IsDragging());
  EXPECT_FALSE(this->part<app::posing::PoseController>()->is_rest_view());
  this->key(Qt::Key_Escape);
  EXPECT_FALSE(this->widget()->IsDragging());
  this->key(Qt::Key_T);
  EXPECT_TRUE(this->part<app::posing::PoseController>()->is_rest_view());
  this->key(Qt::Key_T);
  EXPECT_FALSE(this->part<app::posing::PoseController>()->is_rest_view());
}

TEST_F(HandleWindow, ARefusedDragSaysWhy)
{
  this->open_bound();
  this->editing()->selection()->select({ 0 });
  this->commands()->set_locked(true);
  this->render();
  const QPoint position = this->pixel(this->handle("left").head);
  const std::string before = this->state();
  this->hover(position);
  EXPECT_TRUE(this->hint().startsWith("left is locked")) << this->hint().toStdString();
  this->drag(position, position + QPoint(40, 0));
  EXPECT_EQ(this->state(), before);
  this->document()->set_mode(1, static_cast<int>(HandleMode::free));
  this->render();
  this->hover(this->pixel(this->handle("right").head));
  EXPECT_TRUE(this->hint().startsWith("right is free")) << this->hint().toStdString();
}

TEST_F(HandleWindow, SeveralSelectedHandlesMoveAsOneStep)
{
  this->open_bound();
  this->editing()->selection()->select({ 0, 1 });
  this->render();
  const QPoint position = this->pixel(this->handle("right").head);
  this->check("move 2 handles", [&] { this->drag(position, position + QPoint(0, -40)); });
  const Pose pose = this->document()->pose();
  EXPECT_LT((pose[0].transform.col(3) - pose[1].transform.col(3)).norm(), 1e-12);
  EXPECT_GT(pose[0].transform.col(3).norm(), 0.02);
  EXPECT_EQ(this->editing()->selection()->selected().size(), 2U);
}

// ---- Commands ----------------------------------------------------------------------------------

TEST_F(HandleWindow, CommandsAreStepsWithNames)
{
  this->open_bound();
  this->editing()->selection()->select({ 0 });
  app::handles::HandleCommands* commands = this->commands();
  this->check("color left", [&] { commands->set_color(QColor(255, 0, 0)); });
  this->check("lock left", [&] { commands->action("lock")->trigger(); });
  EXPECT_TRUE(commands->action("lock")->isChecked());
  this->check("unlock left", [&] { commands->action("lock")->trigger(); });
  this->check("mode of left", [&] { commands->action("fixes.position")->trigger(); });
  EXPECT_TRUE(commands->action("fixes.position")->isChecked());
  EXPECT_FALSE(commands->action("fixes.tail")->isEnabled()); // the handle "left" is not a bone
  this->check("snap to the surface: left", [&] { commands->action("snap")->trigger(); });
  const Vec3 surface_point = this->handle("left").head;
  EXPECT_NEAR(
    Vec3(surface_point.x() / 0.4, surface_point.y() / 0.4, surface_point.z()).norm(), 1.0, 0.03);
  this->check("parent of left", [&] { commands->set_parent(this->number("spine")); });
  EXPECT_EQ(this->handle("left").parent, this->number("spine"));
  Pose pose = this->document()->pose();
  pose[0].transform.col(3) = Vec3(0.3, 0.2, 0);
  this->document()->set_pose(pose, "pose");
  this->check("reset left", [&] { commands->action("reset")->trigger(); });
  EXPECT_EQ(this->document()->pose()[0].transform, identity_affine());
  EXPECT_EQ(this->document()->pose()[0].mode, HandleMode::position);
  this->editing()->selection()->select({ this->number("spine") });
  this->check("mode of spine", [&] { commands->action("fixes.ends")->trigger(); });
  this->check("move spine's end", [&] { /* move its tail */
    this->editing()->selection()->edit("move spine's end",
      [](const Handles& before, EditedHandles& after) {
        return move_ends(before, { { 2, true } }, { Vec3(0.2, 0, 0.1) }, after);
      });
  });
  this->check("mirror spine", [&] { commands->action("mirror.x")->trigger(); });
  ASSERT_EQ(this->document()->handles().size(), 4U);
  const Handle& copy = this->document()->handles().back();
  EXPECT_LT((copy.tail - Vec3(-0.2, 0, 0.1)).norm(), 1e-12);
  EXPECT_EQ(
    this->editing()->selection()->selected(), std::vector<int>{ 3 }); // the new handle is selected
  this->check(
    "delete " + QString::fromStdString(copy.name), [&] { commands->action("delete")->trigger(); });
  EXPECT_TRUE(this->editing()->selection()->selected().empty());
  EXPECT_FALSE(commands->action("delete")->isEnabled());
  this->key(Qt::Key_A, Qt::ControlModifier);
  EXPECT_EQ(this->editing()->selection()->selected().size(), 3U);
  this->check("delete 3 handles", [&] { this->key(Qt::Key_Delete); });
  EXPECT_EQ(this->document()->handle_data(), nullptr);
  EXPECT_TRUE(this->window.findChild<QWidget*>("nothing")->isVisible());
}

TEST_F(HandleWindow, CageEdgesAreToggledBetweenTwoVertices)
{
  this->open_mesh();
  this->key(Qt::Key_C);
  for (const Vec3& corner : { Vec3(-0.5, 0, -0.8), Vec3(0.5, 0, -0.8), Vec3(0.5, 0, 0.8) })
  {
    this->click(this->pixel(corner));
  }
  this->key(Qt::Key_Return);
  this->key(Qt::Key_Escape);
  this->editing()->selection()->select({ 0, 2 });
  ASSERT_TRUE(this->commands()->action("cage_edge")->isEnabled());
  this->check("cage edge", [&] { this->commands()->action("cage_edge")->trigger(); });
  this->editing()->selection()->select({ 0 });
  EXPECT_FALSE(this->commands()->action("cage_edge")->isEnabled());
}

TEST_F(HandleWindow, NamesThatCannotBeAreOneSentence)
{
  this->open_bound();
  // Stored poses also get the new name.
  StoredPoses stored_poses;
  Pose stored_pose(3);
  stored_pose[0].transform.col(3) = Vec3(0.5, 0, 0);
  stored_poses.library.store("wave", NamedPose(this->document()->handles(), stored_pose));
  stored_poses.keys.set(0.5, NamedPose(this->document()->handles(), stored_pose));
  this->document()->set_stored_poses(stored_poses, "keep");
  this->editing()->selection()->select({ 0 });
  this->check("rename left", [&] { EXPECT_TRUE(this->commands()->rename(0, " paw ")); });
  EXPECT_EQ(this->names()[0], "paw");
  EXPECT_EQ(this->editing()->selection()->selected(), std::vector<int>{ 0 });
  const StoredPoses& now = *this->document()->work().stored_poses;
  EXPECT_EQ(
    now.library.entries()[0].pose.for_handles(this->document()->handles(), Pose(3))[0].transform,
    stored_pose[0].transform);
  EXPECT_EQ(now.keys.pose_at(0.5, this->document()->handles(), Pose(3))[0].transform,
    stored_pose[0].transform);
  const std::string before = this->state();
  const int steps = this->history()->count();
  for (const char* bad : { "", "   ", "right", "spine" })
  {
    EXPECT_FALSE(this->commands()->rename(0, bad)) << bad;
    EXPECT_FALSE(this->window.error().isEmpty()) << bad;
    EXPECT_TRUE(this->window.error().endsWith('.'));
    EXPECT_EQ(this->state(), before);
    EXPECT_EQ(this->history()->count(), steps);
  }
  // Rename the handle with F2, which opens a dialog.
  this->key(Qt::Key_F2);
  auto* box = this->window.findChild<QInputDialog*>();
  ASSERT_NE(box, nullptr);
  EXPECT_EQ(box->textValue(), "paw");
  box->setTextValue("claw");
  box->accept();
  EXPECT_EQ(this->names()[0], "claw");
  EXPECT_EQ(this->part<app::handles::SidePanel>()->handle_list()->item(0)->text(0), "claw");
}

TEST_F(HandleWindow, TheRightButtonShowsWhatCanBeDoneWithAHandle)
{
  this->open_bound();
  QMenu* menu = this->commands()->menu();
  const QPoint position = this->pixel(this->handle("right").head);
  this->hover(position);
  this->mouse(QEvent::MouseButtonPress, position, Qt::RightButton, Qt::RightButton);
  EXPECT_TRUE(menu->isVisible());
  EXPECT_EQ(this->editing()->selection()->selected(), std::vector<int>{ 1 });
  menu->hide();
  this->mouse(QEvent::MouseButtonRelease, position, Qt::RightButton, Qt::NoButton);
  const QString texts = [menu]
  {
    QStringList all;
    for (QAction* action : menu->actions())
    {
      all << action->text().remove('&');
    }
    return all.join('|');
  }();
  for (const char* text : { "Rename", "Color", "Locked", "Fixes", "Parent", "Reset",
         "Snap to the surface", "Mirror", "Delete" })
  {
    EXPECT_TRUE(texts.contains(text)) << text;
  }
  // At positions without handles, the right mouse button moves the camera.
  const QPoint beside(20, this->viewport()->height() - 20);
  this->hover(beside);
  this->mouse(QEvent::MouseButtonPress, beside, Qt::RightButton, Qt::RightButton);
  EXPECT_FALSE(menu->isVisible());
  this->mouse(QEvent::MouseButtonRelease, beside, Qt::RightButton, Qt::NoButton);
  // During a drag, the right mouse button cancels the drag.
  const std::string before = this->state();
  this->press(position, position + QPoint(40, 0));
  this->mouse(QEvent::MouseButtonPress, position + QPoint(40, 0), Qt::RightButton, Qt::RightButton);
  EXPECT_EQ(this->state(), before);
  EXPECT_FALSE(menu->isVisible());
  this->mouse(QEvent::MouseButtonRelease, position, Qt::RightButton, Qt::NoButton);
  this->release(position);
  // The list of handles has the same context menu.
  const app::handles::HandleTree* handles = this->part<app::handles::SidePanel>()->handle_list();
  QTreeWidget* list = handles->tree();
  Q_EMIT list->customContextMenuRequested(list->visualItemRect(handles->item(2)).center());
  EXPECT_TRUE(menu->isVisible());
  EXPECT_EQ(this->editing()->selection()->selected(), std::vector<int>{ 2 });
  menu->hide();
  // The menu of parents lists all other handles and an entry for no parent.
  for (QAction* action : menu->actions())
  {
    if (action->menu() && action->text().contains("arent"))
    {
      Q_EMIT action->menu()->aboutToShow();
      EXPECT_EQ(action->menu()->actions().size(), 3);
      EXPECT_TRUE(action->menu()->actions()[0]->isChecked());
    }
  }
}

// ---- The window --------------------------------------------------------------------------------

TEST_F(HandleWindow, UndoWhileSomethingIsDrawnEndsThat)
{
  this->open_mesh();
  this->key(Qt::Key_A);
  this->click(this->pixel(Vec3(0, 0, 0.5)));
  this->editing()->set_mode(app::handles::HandleEditing::add_bones);
  this->press(this->pixel(Vec3(0, 0, -0.8)), this->pixel(Vec3(0, 0, 0)));
  this->history()->undo();
  EXPECT_FALSE(this->widget()->IsDragging());
  EXPECT_EQ(this->document()->handle_data(), nullptr);
  this->release(this->pixel(Vec3(0, 0, 0)));
  EXPECT_EQ(this->document()->handle_data(), nullptr);
  this->editing()->set_mode(app::handles::HandleEditing::paint_regions);
  this->press(this->pixel(Vec3(0, 0, -0.8)), this->pixel(Vec3(0, 0, 0)));
  this->history()->redo();
  EXPECT_FALSE(this->viewport()->brush_widget()->IsPainting());
  EXPECT_EQ(this->names(), QStringList({ "p1" }));
  this->release(this->pixel(Vec3(0, 0, 0)));
}

TEST_F(HandleWindow, ToolsAreOnlyThereForWhatThereIs)
{
  const auto enabled = [this](const char* name)
  { return this->editing()->action(name)->isEnabled(); };
  EXPECT_FALSE(enabled("mode.points"));
  EXPECT_FALSE(enabled("mode.regions"));
  this->open_mesh();
  EXPECT_TRUE(enabled("mode.points"));
  EXPECT_TRUE(enabled("mode.regions"));
  EXPECT_FALSE(enabled("mode.rest"));
  EXPECT_FALSE(enabled("gizmo.move"));
  this->open_bound();
  EXPECT_TRUE(enabled("mode.rest"));
  EXPECT_TRUE(enabled("gizmo.move"));
}

/// The sheet of keys contains every binding of the widgets and every key of the window, and all of
/// them work.
TEST_F(HandleWindow, TheSheetTellsTheKeysThatThereAre)
{
  this->viewport()->setFocus();
  QTest::keyClick(this->viewport(), Qt::Key_Question);
  QApplication::processEvents();
  auto* sheet = this->window.findChild<app::window::ShortcutSheet*>();
  ASSERT_NE(sheet, nullptr);
  EXPECT_TRUE(sheet->isVisible());
  QString all;
  for (int row = 0; row < sheet->table()->rowCount(); ++row)
  {
    for (int column = 0; column < 2; ++column)
    {
      const QTableWidgetItem* item = sheet->table()->item(row, column);
      all += item ? item->text() + '\n' : QString();
    }
  }
  for (int row = 0; row < vtkHandleSetWidget::GetNumberOfBindings(); ++row)
  {
    EXPECT_TRUE(all.contains(QString::fromStdString(vtkHandleSetWidget::GetBindingText(row))));
  }
  for (int row = 0; row < vtkRegionBrushWidget::GetNumberOfBindings(); ++row)
  {
    EXPECT_TRUE(all.contains(QString::fromStdString(vtkRegionBrushWidget::GetBindingText(row))));
  }
  sheet->apply_search("bone head");
  int shown = 0;
  for (int row = 0; row < sheet->table()->rowCount(); ++row)
  {
    shown += !sheet->table()->isRowHidden(row);
  }
  EXPECT_GT(shown, 1);
  EXPECT_LT(shown, 12);
  sheet->close();
  // Every key of the table belongs to exactly one action.
  QMap<QString, QString> action_of_key;
  for (const app::parts::WindowKey& key : app::parts::window_keys)
  {
    if (key.action[0] == '\0' || QString(key.action) == "mode.pose")
    {
      continue;
    }
    for (const QString& keys : QString(key.input).split(", "))
    {
      const QKeySequence sequence(keys);
      ASSERT_FALSE(sequence.isEmpty()) << key.input;
      EXPECT_NE(sequence[0] & ~Qt::KeyboardModifierMask, Qt::Key_unknown) << key.input;
      EXPECT_FALSE(action_of_key.contains(sequence.toString())) << key.input;
      action_of_key[sequence.toString()] = key.action;
      int found = 0;
      for (QAction* action : this->window.findChildren<QAction*>())
      {
        found += action->shortcuts().contains(sequence);
      }
      EXPECT_EQ(found, 1) << key.action;
    }
  }
}

TEST_F(HandleWindow, RegionsAndWeightsAreNotShownAtOnce)
{
  this->open_bound();
  this->part<app::window::PanelColumn>()->show_panel(app::window::PanelColumn::weights);
  const QImage weights = this->picture();
  const QSize size = this->window.size();
  this->editing()->set_mode(app::handles::HandleEditing::paint_regions);
  EXPECT_EQ(
    this->part<app::window::PanelColumn>()->shown_panel(), app::window::PanelColumn::bind_and_pose);
  this->part<app::window::PanelColumn>()->show_panel(app::window::PanelColumn::weights);
  EXPECT_EQ(this->editing()->mode(), app::handles::HandleEditing::pose);
  // The size of the window does not change, because two panels are never visible at the same time.
  EXPECT_EQ(this->window.size(), size);
  EXPECT_EQ(this->picture(), weights);
}

TEST_F(HandleWindow, NothingIsClippedInASmallWindow)
{
  this->open_mesh();
  this->resize(QSize(900, 600)); // the panel contains the text for a mesh without handles
  this->open_bound();
  for (const QSize& size : { QSize(900, 600), QSize(1280, 800) })
  {
    this->resize(size);
    for (int mode = app::handles::HandleEditing::pose;
         mode <= app::handles::HandleEditing::paint_regions; ++mode)
    {
      this->editing()->set_mode(mode);
      this->render();
      EXPECT_EQ(this->window.size(), size);
      auto* bar = this->window.findChild<app::handles::ModeBar*>();
      EXPECT_EQ(bar->isVisible(), mode != app::handles::HandleEditing::pose);
      test::expect_unclipped_buttons(bar);
      for (QToolButton* button : this->editing()->tools()->findChildren<QToolButton*>())
      {
        EXPECT_LE(button->sizeHint().width(), button->width()) << button->text().toStdString();
        EXPECT_LE(button->mapTo(this->editing()->tools(), QPoint(button->width(), 0)).x(),
          this->editing()->tools()->width());
        EXPECT_FALSE(button->toolTip().isEmpty());
      }
      EXPECT_LE(bar->width(), this->viewport()->width());
    }
    this->editing()->set_mode(app::handles::HandleEditing::pose);
  }
}

/// Each edit mode looks different. If the environment variable BINDPOSE_PICTURES contains the path
/// of a folder, images of the window are saved there.
TEST_F(HandleWindow, EveryModeHasAPictureOfItsOwn)
{
  const char* folder = std::getenv("BINDPOSE_PICTURES");
  const char* size_text = std::getenv("BINDPOSE_PICTURE_SIZE"); // width and height, as WxH
  if (size_text)
  {
    const QStringList size = QString(size_text).split('x');
    this->window.resize(size[0].toInt(), size[1].toInt());
  }
  QImage last;
  const auto save = [&](const char* name)
  {
    this->render();
    const QImage now = this->window.grab().toImage();
    EXPECT_NE(now, last) << name;
    last = now;
    if (folder)
    {
      EXPECT_TRUE(now.save(QString("%1/hands_%2.png").arg(folder).arg(name)));
    }
  };
  this->open_mesh(4);
  save("nothing");
  this->key(Qt::Key_B);
  this->render();
  this->drag(this->pixel(Vec3(0, 0, -0.85)), this->pixel(Vec3(0, 0, 0)));
  this->press(this->pixel(Vec3(0, 0, 0)), this->pixel(Vec3(0.02, 0, 0.7)));
  save("bones");
  this->release(this->pixel(Vec3(0.02, 0, 0.7)));
  this->key(Qt::Key_A);
  this->click(this->pixel(Vec3(0.25, 0, 0.3)));
  this->click(this->pixel(Vec3(-0.25, 0, 0.3)));
  this->hover(this->pixel(Vec3(0.2, 0, -0.3)));
  save("points");
  this->key(Qt::Key_C);
  this->render();
  for (const Vec3& corner : { Vec3(-0.6, 0, -1), Vec3(0.6, 0, -1), Vec3(0.6, 0, 1) })
  {
    this->click(this->pixel(corner));
  }
  this->hover(this->pixel(Vec3(-0.6, 0, 0.9)));
  save("cage");
  for (int step = 0; step < 3; ++step)
  {
    this->history()->undo();
  }
  this->key(Qt::Key_P);
  this->render();
  this->drag(this->pixel(Vec3(-0.05, 0, 0.85)), this->pixel(Vec3(0.05, 0, 0.8)));
  this->editing()->selection()->select({});
  this->drag(this->pixel(Vec3(-0.2, 0, -0.5)), this->pixel(Vec3(0.2, 0, -0.5)));
  save("regions");
  this->key(Qt::Key_Escape);
  this->key(Qt::Key_M);
  this->hover(this->pixel(this->handle("p1").head));
  save("rest");
  this->key(Qt::Key_Escape);
  this->part<app::weights::Binding>()->start();
  ASSERT_TRUE(wait_for([this] { return !this->part<app::weights::Binding>()->is_running(); }));
  this->editing()->selection()->select({ this->number("b2") });
  const std::pair<Qt::Key, const char*> gizmos[] = { { Qt::Key_W, "move" }, { Qt::Key_E, "turn" },
    { Qt::Key_D, "scale" }, { Qt::Key_F, "all" } };
  for (const auto& [key, name] : gizmos)
  {
    this->key(key);
    save(name);
  }
  this->key(Qt::Key_E);
  this->render();
  const QPoint ring = this->grip(Representation::TURN_Y);
  this->press(ring, ring + QPoint(60, 40));
  save("drag");
  this->release(ring + QPoint(60, 40));
  this->commands()->menu()->popup(this->viewport()->mapToGlobal(QPoint(300, 200)));
  QApplication::processEvents();
  if (folder)
  {
    EXPECT_TRUE(this->commands()->menu()->grab().save(QString("%1/hands_menu.png").arg(folder)));
  }
  this->commands()->menu()->hide();
  app::window::ShortcutSheet sheet(&this->window);
  sheet.setAttribute(Qt::WA_DeleteOnClose, false);
  sheet.show();
  QApplication::processEvents();
  if (folder)
  {
    EXPECT_TRUE(sheet.grab().save(QString("%1/hands_sheet.png").arg(folder)));
  }
}
