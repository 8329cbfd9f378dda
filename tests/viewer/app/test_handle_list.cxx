// The list of handles and the picture show the same selection, however it was made, and what is
// chosen in the panel is for all of it.
#include "window_test.h"

#include "document/document.h"
#include "handle_editing.h"
#include "handle_fields.h"
#include "side_panel.h"

#include "weights_arrays.h"

#include "support/meshes.h"

#include "vtkDoubleArray.h"
#include "vtkHandleSetRepresentation.h"
#include "vtkHandleSetWidget.h"
#include "vtkPointData.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QListWidget>
#include <QTest>
#include <QUndoStack>

using namespace bindpose;

namespace
{
class HandleList : public test::WindowTest
{
protected:
  /// A ball with three points along z and a bone, all weighing the same.
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

  QListWidget* list() { return this->window.panel()->handle_list(); }
  void click(int row, Qt::KeyboardModifiers held = Qt::NoModifier)
  {
    const QRect at = this->list()->visualItemRect(this->list()->item(row));
    QTest::mouseClick(this->list()->viewport(), Qt::LeftButton, held, at.center());
    QApplication::processEvents();
  }
  /// What is selected, of which all that show it say the same.
  std::vector<int> selected()
  {
    const std::vector<int> result = this->window.editing()->selected();
    auto* drawn = this->window.viewport()->handle_widget()->GetHandleSetRepresentation();
    for (int k = 0; k < this->list()->count(); ++k)
    {
      const bool is = std::find(result.begin(), result.end(), k) != result.end();
      EXPECT_EQ(this->list()->item(k)->isSelected(), is) << k;
      EXPECT_EQ(drawn->IsSelected(this->window.document()->handle_cells()[k]), is) << k;
    }
    EXPECT_EQ(this->window.panel()->selected_handles(), result);
    return result;
  }
  /// A click on a handle in the picture.
  void pick(const char* name, Qt::KeyboardModifiers held = Qt::NoModifier)
  {
    QPoint at;
    ASSERT_EQ(this->hand.place_of(name, 0.0, at), QString());
    this->hand.move(at, held);
    this->hand.press(at, Qt::LeftButton, held);
    this->hand.release(at, Qt::LeftButton, held);
    QApplication::processEvents();
  }
  QString note()
  {
    for (const QLabel* label : this->window.panel()->fields()->findChildren<QLabel*>("note"))
    {
      if (label->text().contains("selected") && label->isVisibleTo(this->window.panel()))
      {
        return label->text();
      }
    }
    return {};
  }
  QComboBox* modes()
  {
    for (QComboBox* box : this->window.panel()->findChildren<QComboBox*>())
    {
      if (box->findText("position only") >= 0)
      {
        return box;
      }
    }
    return nullptr;
  }
  bool offers(HandleMode mode)
  {
    const QAbstractItemModel* model = this->modes()->model();
    return model->flags(model->index(static_cast<int>(mode), 0)) & Qt::ItemIsEnabled;
  }
  HandleMode mode(int handle)
  {
    return this->window.document()->pose()[static_cast<std::size_t>(handle)].mode;
  }

  WindowHand hand{ &this->window };
};

using Numbers = std::vector<int>;
} // namespace

TEST_F(HandleList, ClicksWithCtrlAndShiftSelectSeveralInThePicture)
{
  this->click(0);
  EXPECT_EQ(this->selected(), Numbers({ 0 }));
  EXPECT_EQ(this->note(), QString());
  this->click(2, Qt::ControlModifier);
  EXPECT_EQ(this->selected(), Numbers({ 0, 2 }));
  this->click(0, Qt::ControlModifier);
  EXPECT_EQ(this->selected(), Numbers({ 2 }));
  this->click(0, Qt::ControlModifier);
  EXPECT_EQ(this->selected(), Numbers({ 2, 0 })) << "in the order in which they were chosen";
  this->click(1);
  EXPECT_EQ(this->selected(), Numbers({ 1 }));
  this->click(3, Qt::ShiftModifier);
  EXPECT_EQ(this->selected(), Numbers({ 1, 2, 3 }));
  this->click(1, Qt::ControlModifier);
  this->click(2, Qt::ControlModifier);
  this->click(3, Qt::ControlModifier);
  EXPECT_EQ(this->selected(), Numbers());
}

TEST_F(HandleList, WhatIsSelectedInThePictureIsSelectedInTheList)
{
  this->pick("top");
  EXPECT_EQ(this->selected(), Numbers({ 2 }));
  this->pick("bottom", Qt::ShiftModifier);
  EXPECT_EQ(this->selected(), Numbers({ 2, 0 }));
  this->hand.trigger("select_all");
  EXPECT_EQ(this->selected(), Numbers({ 0, 1, 2, 3 }));
  this->pick("middle", Qt::ShiftModifier);
  EXPECT_EQ(this->selected(), Numbers({ 0, 2, 3 }));
  // What is deleted and comes back by undo is selected by its names.
  this->hand.trigger("delete");
  EXPECT_EQ(this->selected(), Numbers());
  this->hand.trigger("edit.undo");
  EXPECT_EQ(this->list()->count(), 4);
  this->selected();
}

TEST_F(HandleList, TheFieldsAreThoseOfTheFirstAndSayHowMany)
{
  Pose pose(4);
  pose[2].transform.col(3) = Vec3(0.25, 0, 0);
  pose[0].transform.col(3) = Vec3(0.125, 0, 0);
  this->window.document()->set_pose(pose, "moved");
  this->click(2);
  this->click(0, Qt::ControlModifier);
  QDoubleSpinBox* along_x = this->window.panel()->fields()->field(0);
  EXPECT_EQ(along_x->value(), 0.25);
  EXPECT_EQ(this->note(), "2 selected; the values of top:");
  along_x->setValue(0.5);
  EXPECT_NEAR(this->window.document()->pose()[2].transform(0, 3), 0.5, 1e-12);
  EXPECT_EQ(this->window.document()->pose()[0].transform(0, 3), 0.125) << "only the first";
  this->click(0);
  EXPECT_EQ(along_x->value(), 0.125);
  EXPECT_EQ(this->note(), QString());
}

TEST_F(HandleList, AModeIsForAllThatAreSelectedAndOneStep)
{
  const int before = this->window.history()->index();
  this->click(0);
  this->click(2, Qt::ControlModifier);
  EXPECT_EQ(this->window.history()->index(), before) << "to select is no step";
  this->modes()->setCurrentIndex(static_cast<int>(HandleMode::position));
  EXPECT_EQ(this->window.history()->index(), before + 1);
  EXPECT_EQ(this->window.history()->undoText(), "mode of 2 handles");
  EXPECT_EQ(this->mode(0), HandleMode::position);
  EXPECT_EQ(this->mode(1), HandleMode::full);
  EXPECT_EQ(this->mode(2), HandleMode::position);
  EXPECT_EQ(this->selected(), Numbers({ 0, 2 }));
  this->hand.trigger("edit.undo");
  EXPECT_EQ(this->mode(0), HandleMode::full);
  EXPECT_EQ(this->mode(2), HandleMode::full);
  EXPECT_EQ(this->modes()->currentIndex(), static_cast<int>(HandleMode::full));
  // A tail is held of bones only.
  EXPECT_FALSE(this->offers(HandleMode::tail));
  this->click(3);
  EXPECT_TRUE(this->offers(HandleMode::tail));
  this->click(2, Qt::ControlModifier);
  EXPECT_FALSE(this->offers(HandleMode::tail)) << "one of them is a point";
  EXPECT_NE(this->hand.set_mode("tail"), QString());
  EXPECT_EQ(this->hand.set_mode("free"), QString());
  EXPECT_EQ(this->mode(2), HandleMode::free);
  EXPECT_EQ(this->mode(3), HandleMode::free);
}
