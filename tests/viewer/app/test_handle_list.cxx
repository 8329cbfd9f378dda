// The list of handles, the panel of weights and the view always show the same selection. Choices in
// the panel apply to all selected handles. The list is a tree with a search field.
#include "window_test.h"

#include "app/handles/handle_commands.h"
#include "app/handles/handle_editing.h"
#include "app/handles/handle_selection.h"
#include "app/handles/side_panel.h"
#include "app/posing/handle_fields.h"
#include "app/weights/weight_panel.h"
#include "document/document.h"

#include "weights_arrays.h"

#include "support/meshes.h"

#include "vtkDoubleArray.h"
#include "vtkHandleSetRepresentation.h"
#include "vtkHandleSetWidget.h"
#include "vtkPointData.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QSplitter>
#include <QTest>
#include <QTreeWidget>
#include <QUndoStack>

using namespace bindpose;

namespace
{
class HandleList : public test::WindowTest
{
protected:
  /// Open a ball with three points along z and a bone. The weights are equal everywhere.
  void SetUp() override
  {
    Handles handles(4);
    const char* const names[] = { "bottom", "middle", "top", "spine" };
    for (int k = 0; k < 4; ++k)
    {
      handles[static_cast<std::size_t>(k)].name = names[k];
    }
    for (int k = 0; k < 3; ++k)
    {
      Handle& point = handles[static_cast<std::size_t>(k)];
      point.head = point.tail = Vec3(0, 0, 0.8 * (k - 1));
    }
    handles[3].kind = HandleKind::bone;
    handles[3].head = Vec3(0.3, 0, -0.4);
    handles[3].tail = Vec3(0.3, 0, 0.4);
    const TriangleMesh mesh = test::sphere(2);
    const auto ball = to_polydata(mesh.points, mesh.triangles);
    const Weights weights = Weights::Constant(mesh.points.rows(), 4, 0.25);
    ball->GetPointData()->AddArray(to_weights_array("Weights", weights, handles));
    ASSERT_TRUE(this->window.set_mesh(ball, "ball"));
    ASSERT_TRUE(this->window.set_handles(to_polydata(handles), "handles"));
    ASSERT_TRUE(this->window.is_bound());
    this->render();
  }

  app::handles::HandleTree* list() { return this->part<app::handles::SidePanel>()->handle_list(); }
  void click(int row, Qt::KeyboardModifiers modifiers = Qt::NoModifier)
  {
    QTreeWidget* tree = this->list()->tree();
    const QRect at = tree->visualItemRect(this->list()->item(row));
    QTest::mouseClick(tree->viewport(), Qt::LeftButton, modifiers, at.center());
    QApplication::processEvents();
  }
  /// Return the selected handles. Expect that the list, the panel and the view show this selection.
  std::vector<int> selected()
  {
    const std::vector<int> result =
      this->part<app::handles::HandleEditing>()->selection()->selected();
    auto* representation =
      this->part<app::view::Viewport>()->handle_widget()->GetHandleSetRepresentation();
    for (int k = 0; k < static_cast<int>(this->list()->rows().size()); ++k)
    {
      const bool is_selected = std::find(result.begin(), result.end(), k) != result.end();
      EXPECT_EQ(this->list()->item(k)->isSelected(), is_selected) << k;
      EXPECT_EQ(representation->IsSelected(this->window.document()->handle_cells()[k]), is_selected)
        << k;
    }
    EXPECT_EQ(this->part<app::handles::SidePanel>()->selected_handles(), result);
    return result;
  }
  /// Click a handle in the view.
  void click_handle(const char* name, Qt::KeyboardModifiers modifiers = Qt::NoModifier)
  {
    QPoint at;
    ASSERT_EQ(this->user.find_handle_position(name, 0.0, at), QString());
    this->user.move(at, modifiers);
    this->user.press(at, Qt::LeftButton, modifiers);
    this->user.release(at, Qt::LeftButton, modifiers);
    QApplication::processEvents();
  }
  QString note()
  {
    for (const QLabel* label :
      this->part<app::handles::SidePanel>()->fields()->findChildren<QLabel*>("note"))
    {
      if (label->text().contains("selected") &&
        label->isVisibleTo(this->part<app::handles::SidePanel>()))
      {
        return label->text();
      }
    }
    return {};
  }
  QComboBox* modes()
  {
    for (QComboBox* box : this->part<app::handles::SidePanel>()->findChildren<QComboBox*>())
    {
      if (box->findText("position only") >= 0)
      {
        return box;
      }
    }
    return nullptr;
  }
  int entry_of(HandleMode mode) { return this->modes()->findData(static_cast<int>(mode)); }
  bool is_mode_available(HandleMode mode)
  {
    const QAbstractItemModel* model = this->modes()->model();
    return model->flags(model->index(this->entry_of(mode), 0)) & Qt::ItemIsEnabled;
  }
  HandleMode mode(int handle)
  {
    return this->window.document()->pose()[static_cast<std::size_t>(handle)].mode;
  }

  app::tour::SimulatedUser user{ &this->window };
};

using Indices = std::vector<int>;
} // namespace

TEST_F(HandleList, ClicksWithCtrlAndShiftSelectSeveralInThePicture)
{
  this->click(0);
  EXPECT_EQ(this->selected(), Indices({ 0 }));
  EXPECT_EQ(this->note(), QString());
  this->click(2, Qt::ControlModifier);
  EXPECT_EQ(this->selected(), Indices({ 0, 2 }));
  this->click(0, Qt::ControlModifier);
  EXPECT_EQ(this->selected(), Indices({ 2 }));
  this->click(0, Qt::ControlModifier);
  EXPECT_EQ(this->selected(), Indices({ 2, 0 })) << "in the order in which they were chosen";
  this->click(1);
  EXPECT_EQ(this->selected(), Indices({ 1 }));
  this->click(3, Qt::ShiftModifier);
  EXPECT_EQ(this->selected(), Indices({ 1, 2, 3 }));
  this->click(1, Qt::ControlModifier);
  this->click(2, Qt::ControlModifier);
  this->click(3, Qt::ControlModifier);
  EXPECT_EQ(this->selected(), Indices());
}

TEST_F(HandleList, WhatIsSelectedInThePictureIsSelectedInTheList)
{
  this->click_handle("top");
  EXPECT_EQ(this->selected(), Indices({ 2 }));
  this->click_handle("bottom", Qt::ShiftModifier);
  EXPECT_EQ(this->selected(), Indices({ 2, 0 }));
  this->user.trigger("select_all");
  EXPECT_EQ(this->selected(), Indices({ 0, 1, 2, 3 }));
  this->click_handle("middle", Qt::ShiftModifier);
  EXPECT_EQ(this->selected(), Indices({ 0, 2, 3 }));
  // Undo restores the deleted handles, but does not select them.
  this->user.trigger("delete");
  EXPECT_EQ(this->selected(), Indices());
  this->user.trigger("edit.undo");
  EXPECT_EQ(this->list()->rows().size(), 4U);
  EXPECT_EQ(this->selected(), Indices());
}

TEST_F(HandleList, TheFieldsAreThoseOfTheFirstAndSayHowMany)
{
  Pose pose(4);
  pose[2].transform.col(3) = Vec3(0.25, 0, 0);
  pose[0].transform.col(3) = Vec3(0.125, 0, 0);
  this->window.document()->set_pose(pose, "moved");
  this->click(2);
  this->click(0, Qt::ControlModifier);
  QDoubleSpinBox* along_x = this->part<app::handles::SidePanel>()->fields()->field(0);
  EXPECT_EQ(along_x->value(), 0.25);
  EXPECT_EQ(this->note(), "2 selected; values of top:");
  along_x->setValue(0.5);
  EXPECT_NEAR(this->window.document()->pose()[2].transform(0, 3), 0.5, 1e-12);
  EXPECT_EQ(this->window.document()->pose()[0].transform(0, 3), 0.125) << "only the first";
  this->click(0);
  EXPECT_EQ(along_x->value(), 0.125);
  EXPECT_EQ(this->note(), QString());
}

TEST_F(HandleList, AModeIsForAllThatAreSelectedAndOneStep)
{
  const int before = this->window.document()->history()->index();
  this->click(0);
  this->click(2, Qt::ControlModifier);
  EXPECT_EQ(this->window.document()->history()->index(), before) << "to select is no step";
  this->modes()->setCurrentIndex(this->entry_of(HandleMode::position));
  EXPECT_EQ(this->window.document()->history()->index(), before + 1);
  EXPECT_EQ(this->window.document()->history()->undoText(), "mode of 2 handles");
  EXPECT_EQ(this->mode(0), HandleMode::position);
  EXPECT_EQ(this->mode(1), HandleMode::automatic);
  EXPECT_EQ(this->mode(2), HandleMode::position);
  EXPECT_EQ(this->selected(), Indices({ 0, 2 }));
  this->user.trigger("edit.undo");
  EXPECT_EQ(this->mode(0), HandleMode::automatic);
  EXPECT_EQ(this->mode(2), HandleMode::automatic);
  EXPECT_EQ(this->modes()->currentIndex(), this->entry_of(HandleMode::automatic));
  // The mode "tail" is available for bones only.
  EXPECT_FALSE(this->is_mode_available(HandleMode::tail));
  this->click(3);
  EXPECT_TRUE(this->is_mode_available(HandleMode::tail));
  this->click(2, Qt::ControlModifier);
  EXPECT_FALSE(this->is_mode_available(HandleMode::tail)) << "one of them is a point";
  EXPECT_NE(this->user.set_mode("tail"), QString());
  EXPECT_EQ(this->user.set_mode("free"), QString());
  EXPECT_EQ(this->mode(2), HandleMode::free);
  EXPECT_EQ(this->mode(3), HandleMode::free);
}

// ---- The panel of weights ----------------------------------------------------------------------

TEST_F(HandleList, TheWeightsPanelAndTheSelectionFollowEachOther)
{
  app::weights::WeightPanel* weights = this->part<app::window::PanelColumn>()->weight();
  this->click(2);
  this->part<app::window::PanelColumn>()->show_panel(app::window::PanelColumn::weights);
  EXPECT_EQ(weights->column(), 2) << "what was selected before";
  this->click_handle("bottom");
  EXPECT_EQ(this->selected(), Indices({ 0 }));
  EXPECT_EQ(weights->column(), 0);
  this->click(3);
  EXPECT_EQ(weights->column(), 3);
  auto* box = weights->findChild<QComboBox*>("weights.column");
  box->setCurrentIndex(1 + 1);
  EXPECT_EQ(this->selected(), Indices({ 1 }));
  // If several handles are selected, the panel shows the weights of the most recently selected one.
  // All handles stay selected.
  this->click(2, Qt::ControlModifier);
  EXPECT_EQ(this->selected(), Indices({ 1, 2 }));
  EXPECT_EQ(weights->column(), 2);
  box->setCurrentIndex(0); // this entry shows all handles
  EXPECT_EQ(this->selected(), Indices({ 1, 2 }));
}

// ---- The tree ----------------------------------------------------------------------------------

namespace
{
/// A window with a ball and 17 handles: a point and 16 bones. The bones are a spine of two bones,
/// two arms of two bones each, and five fingers per arm.
class HandleTreeWindow : public test::WindowTest
{
protected:
  void add(const std::string& name, int parent)
  {
    Handle bone;
    bone.name = name;
    bone.kind = HandleKind::bone;
    bone.parent = parent;
    const double k = static_cast<double>(this->handles.size());
    bone.head = Vec3(0.5 * std::cos(k), 0.5 * std::sin(k), 0.02 * k - 0.4);
    bone.tail = bone.head + Vec3(0, 0, 0.015);
    this->handles.push_back(bone);
  }
  void SetUp() override
  {
    Handle point;
    point.name = "nose";
    point.head = point.tail = Vec3(0, 0, 0.7);
    this->handles.push_back(point);
    this->add("hips", -1);
    this->add("chest", 1);
    for (const std::string side : { "left", "right" })
    {
      const int arm = static_cast<int>(this->handles.size());
      this->add(side + "_arm", 2);
      this->add(side + "_hand", arm);
      for (int finger = 0; finger < 5; ++finger)
      {
        this->add(side + "_finger_" + std::to_string(finger), arm + 1);
      }
    }
    const TriangleMesh mesh = test::sphere(2);
    ASSERT_TRUE(this->window.set_mesh(to_polydata(mesh.points, mesh.triangles), "ball"));
    ASSERT_TRUE(this->window.set_handles(to_polydata(this->handles), "rig"));
    this->render();
  }
  app::handles::HandleTree* list() { return this->part<app::handles::SidePanel>()->handle_list(); }
  QString text(int handle) { return this->list()->item(handle)->text(0); }
  int number(const std::string& name)
  {
    const Handles& now = this->window.document()->handles();
    return static_cast<int>(
      std::find_if(now.begin(), now.end(), [&](const Handle& each) { return each.name == name; }) -
      now.begin());
  }
  /// Return the names of the handles whose rows are visible without scrolling.
  QStringList visible_names()
  {
    QApplication::processEvents();
    QStringList names;
    QTreeWidget* tree = this->list()->tree();
    for (QTreeWidgetItem* item = tree->topLevelItem(0); item; item = tree->itemBelow(item))
    {
      const QRect at = tree->visualItemRect(item);
      if (!at.isEmpty() && tree->viewport()->rect().contains(at.adjusted(0, 0, -at.width() + 1, 0)))
      {
        names << item->text(0);
      }
    }
    return names;
  }

  Handles handles;
};
} // namespace

TEST_F(HandleTreeWindow, ChildrenAreBelowTheirParents)
{
  const Handles& now = this->window.document()->handles();
  ASSERT_EQ(now.size(), 17U);
  for (int k = 0; k < 17; ++k)
  {
    const auto& handle = now[static_cast<std::size_t>(k)];
    QTreeWidgetItem* above = this->list()->item(k)->parent();
    EXPECT_EQ(above ? app::handles::HandleTree::handle_of(above) : -1, handle.parent)
      << handle.name;
    EXPECT_EQ(this->text(k).toStdString(), handle.name);
    EXPECT_TRUE(this->list()->item(k)->isExpanded());
  }
  // Set a new parent, as the context menu does. The row moves below its new parent, and collapsed
  // rows stay collapsed.
  this->list()->item(this->number("right_hand"))->setExpanded(false);
  this->part<app::handles::SidePanel>()->select_handle(this->number("left_hand"));
  this->part<app::handles::HandleEditing>()->commands()->set_parent(this->number("hips"));
  QTreeWidgetItem* moved = this->list()->item(this->number("left_hand"));
  ASSERT_NE(moved->parent(), nullptr);
  EXPECT_EQ(moved->parent()->text(0), "hips");
  EXPECT_FALSE(this->list()->item(this->number("right_hand"))->isExpanded());
  // If a handle below a collapsed row is selected, the tree expands this row.
  this->part<app::handles::SidePanel>()->select_handle(this->number("right_finger_2"));
  EXPECT_TRUE(this->list()->item(this->number("right_hand"))->isExpanded());
}

TEST_F(HandleTreeWindow, TheSearchShowsMatchesBelowTheirParents)
{
  this->resize(QSize(1920, 1040));
  QLineEdit* search = this->list()->search();
  search->setFocus();
  QTest::keyClicks(search, "RIGHT_F");
  EXPECT_EQ(this->visible_names(),
    QStringList({ "hips", "chest", "right_arm", "right_hand", "right_finger_0", "right_finger_1",
      "right_finger_2", "right_finger_3", "right_finger_4" }));
  EXPECT_EQ(this->part<app::handles::HandleEditing>()->mode(), app::handles::HandleEditing::pose)
    << "letters are no shortcuts there";
  QTest::keyClick(search, Qt::Key_Return);
  EXPECT_EQ(this->part<app::handles::HandleEditing>()->selection()->selected(),
    Indices({ this->number("right_finger_0") }));
  // If a selected handle does not match the search text, its row is visible nevertheless.
  this->part<app::handles::SidePanel>()->select_handle(this->number("nose"));
  EXPECT_TRUE(this->visible_names().contains("nose"));
  search->setFocus();
  QTest::keyClick(search, Qt::Key_Escape);
  EXPECT_EQ(search->text(), QString());
  EXPECT_GE(this->visible_names().size(), 12);
  for (int k = 0; k < 17; ++k)
  {
    EXPECT_FALSE(this->list()->item(k)->isHidden()) << k;
  }
  QTest::keyClicks(search, "no such name");
  this->part<app::handles::SidePanel>()->select_handles({});
  search->setText("no such name at all");
  EXPECT_EQ(this->visible_names(), QStringList());
}

TEST_F(HandleTreeWindow, ALargeScreenShowsADozenRowsAndTheHeightCanBeDragged)
{
  // On a screen of 1920 x 1080 pixels, a desktop leaves this space for a window.
  this->resize(QSize(1920, 1040));
  EXPECT_GE(this->visible_names().size(), 12);
  this->resize(QSize(1280, 760));
  EXPECT_GE(this->visible_names().size(), 4);
  const int before = this->list()->height();
  auto* splitter = this->part<app::window::PanelColumn>()->findChild<QSplitter*>();
  QWidget* grip = splitter->handle(1);
  const QPoint at = grip->rect().center();
  const auto send = [grip](QEvent::Type type, const QPoint& place, Qt::MouseButton button)
  {
    QMouseEvent event(
      type, place, grip->mapToGlobal(place), button, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(grip, &event);
  };
  send(QEvent::MouseButtonPress, at, Qt::LeftButton);
  send(QEvent::MouseMove, at + QPoint(0, 100), Qt::NoButton);
  send(QEvent::MouseButtonRelease, at, Qt::LeftButton);
  QApplication::processEvents();
  EXPECT_GT(this->list()->height(), before + 50);
  const int dragged = this->list()->height();
  this->part<app::window::PanelColumn>()->show_panel(app::window::PanelColumn::tets);
  EXPECT_FALSE(this->list()->isVisible());
  this->part<app::window::PanelColumn>()->show_panel(app::window::PanelColumn::weights);
  EXPECT_TRUE(this->list()->isVisible());
  EXPECT_NEAR(this->list()->height(), dragged, 3) << "a person's choice stays";
}

TEST_F(HandleTreeWindow, ParentsInACircleAreNoParents)
{
  app::handles::HandleTree tree;
  tree.set_rows({ { "a", HandleKind::bone, 1, 0 }, { "b", HandleKind::bone, 0, 0 },
    { "c", HandleKind::bone, 2, 0 }, { "d", HandleKind::bone, 99, 0 },
    { "e", HandleKind::bone, 3, 0 } });
  for (const int handle : { 0, 1, 2, 3 })
  {
    EXPECT_EQ(tree.item(handle)->parent(), nullptr) << handle;
  }
  EXPECT_EQ(tree.tree()->topLevelItemCount() + tree.item(3)->childCount(), 5);
}
