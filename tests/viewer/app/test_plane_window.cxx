// The three planes that the mouse can drag: the slice of a volume, the cut through tets, and the
// slice of weights. A drag is one undo step, Esc cancels it, and sessions store the plane.
#include "columns.h"
#include "window_test.h"

#include "app/parts/value_row.h"
#include "app/tets/tet_inspection.h"
#include "app/tets/tet_panel.h"
#include "app/view/plane_handle.h"
#include "app/volume/volume_panel.h"
#include "app/volume/volume_view.h"
#include "app/weights/weight_inspection.h"
#include "app/weights/weight_panel.h"
#include "app/window/window_sessions.h"
#include "document/document.h"

#include "support/demo_meshes.h"
#include "support/files.h"
#include "support/meshes.h"

#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLImageDataWriter.h"
#include "vtkXMLUnstructuredGridWriter.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QPushButton>
#include <QSlider>
#include <QUndoStack>

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

using namespace bindpose;

namespace
{
struct PlaneCase
{
  const char* name; ///< prefix of the plane's options
  int panel;
  const char* move; ///< name of the undo step of a move
  const char* turn;
  const char* axis;
};

std::ostream& operator<<(std::ostream& stream, const PlaneCase& plane)
{
  return stream << plane.name;
}

/// Return a box of tets from -1 to 1, with weights linear along z.
vtkSmartPointer<vtkUnstructuredGrid> box_with_weights()
{
  const TetMesh mesh = test::tet_box(4, 4, 4, Vec3(-1, -1, -1), Vec3(1, 1, 1));
  auto grid = to_unstructured_grid(mesh.points, mesh.tets);
  test::add_linear_weights(grid);
  return grid;
}

/// Return a volume that is sampled in the box from -1 to 1.
vtkSmartPointer<vtkImageData> samples()
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(21, 21, 21);
  image->SetSpacing(0.1, 0.1, 0.1);
  image->SetOrigin(-1.0, -1.0, -1.0);
  vtkNew<vtkDoubleArray> values;
  values->SetName("WindingNumber");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    values->InsertNextValue(1.2 - Vec3(image->GetPoint(i)).norm());
  }
  image->GetPointData()->AddArray(values);
  return image;
}

app::view::PlaneHandle* plane_of(app::window::MainWindow& window, const std::string& name)
{
  return name == "volume" ? window.findChild<app::volume::VolumeView*>()->plane()
    : name == "tets"      ? window.findChild<app::tets::TetInspection*>()->tet_view()->plane()
                          : window.findChild<app::weights::WeightInspection*>()->view()->plane();
}

class PlaneWindow : public test::WindowTest, public testing::WithParamInterface<PlaneCase>
{
protected:
  void SetUp() override
  {
    if (std::string(GetParam().name) == "volume")
    {
      test::write_with<vtkXMLImageDataWriter>(samples(), this->folder / "box.vti");
      this->open("box.vti");
    }
    else
    {
      test::write_with<vtkXMLUnstructuredGridWriter>(box_with_weights(), this->folder / "box.vtu");
      this->open("box.vtu");
    }
    this->part<app::window::PanelColumn>()->show_panel(GetParam().panel);
    this->render();
    const std::string name = GetParam().name;
    if (name == "weights")
    {
      this->find<QCheckBox>("Slice through the volume")->click();
      this->render();
    }
    this->begin = this->window.document()->history()->index();
  }

  void open(const char* file)
  {
    ASSERT_TRUE(this->window.open(QString::fromStdString(this->folder / file)))
      << this->window.error().toStdString();
  }
  app::view::PlaneHandle* plane() { return plane_of(this->window, GetParam().name); }
  QString key(const char* option_name)
  {
    return QString("%1.%2").arg(GetParam().name, option_name);
  }
  QVariant option(const char* option_name)
  {
    return this->window.document()->option(this->key(option_name));
  }
  app::parts::ValueRow* row()
  {
    return this->part<app::window::PanelColumn>()->findChild<app::parts::ValueRow*>(
      this->key("place"));
  }
  int steps() { return this->window.document()->history()->index() - this->begin; }
  std::string undo_text() { return this->window.document()->history()->undoText().toStdString(); }
  void undo() { this->user.trigger("edit.undo"); }
  void redo() { this->user.trigger("edit.redo"); }

  /// Drag a plane along z, from z = `from` to z = `to`. The plane must be perpendicular to z. The
  /// mouse button stays down until end_drag().
  void begin_drag(double from, double to)
  {
    const QPoint start = this->pixel(Vec3(0.4, 0.3, from));
    const QPoint end = this->pixel(Vec3(0.4, 0.3, to));
    this->user.move(start);
    QApplication::processEvents();
    this->user.press(start, Qt::LeftButton);
    for (int k = 1; k <= 4; ++k)
    {
      this->user.move(start + (end - start) * k / 4);
      QApplication::processEvents();
    }
    this->last = end;
  }
  void end_drag()
  {
    this->user.release(this->last, Qt::LeftButton);
    this->render();
  }
  /// Rotate a free plane: drag the tip of its arrow by this vector in pixels.
  void turn(const QPoint& by)
  {
    const Vec3 tip = this->plane()->origin() + 0.3 * std::sqrt(12.0) * this->plane()->normal();
    this->drag(this->pixel(tip), this->pixel(tip) + by);
  }
  void expect_position(double position, const char* when)
  {
    EXPECT_NEAR(this->plane()->position(), position, 1e-9) << when;
    EXPECT_NEAR(this->row()->value(), position, 0.002) << when;
    EXPECT_NEAR(
      this->option("place").toDouble(), this->plane()->relative_position_before_drag(), 0.0)
      << when;
  }

  test::Folder folder;
  app::tour::SimulatedUser user{ &this->window };
  QPoint last;
  int begin = 0;
};
} // namespace

INSTANTIATE_TEST_SUITE_P(All, PlaneWindow,
  testing::Values(PlaneCase{ "volume", app::window::PanelColumn::volume_slice, "move the slice",
                    "turn the slice", "orientation of the slice" },
    PlaneCase{ "tets", app::window::PanelColumn::tets, "move the cut", "turn the cut",
      "orientation of the cut" },
    PlaneCase{ "weights", app::window::PanelColumn::weights, "move the slice of weights",
      "turn the slice of weights", "orientation of the slice of weights" }),
  [](const auto& each) { return std::string(each.param.name); });

TEST(PlaneShare, IsNotWornAwayByPositionsGivenBack)
{
  app::window::MainWindow window;
  app::view::PlaneHandle* plane =
    window.findChild<app::weights::WeightInspection*>()->view()->plane();
  test::Random random(11);
  for (int k = 0; k < 200; ++k)
  {
    const Vec3 lower = random.in_box(Vec3::Constant(-3.0), Vec3::Constant(3.0));
    Box box;
    box.add(lower);
    box.add(lower + random.in_box(Vec3::Constant(0.01), Vec3::Constant(5.0)));
    plane->set_box(box);
    plane->set_orientation(k % 3);
    const double place = 0.1 * (k % 11);
    plane->set_relative_position(place);
    plane->set_position(plane->position());
    EXPECT_EQ(plane->relative_position_before_drag(), place) << k;
    const auto [first, last] = plane->positions();
    plane->set_position(first + 0.3 * (last - first));
    EXPECT_NEAR(plane->relative_position_before_drag(), 0.3, 1e-12);
  }
}

TEST_P(PlaneWindow, ADragIsOneStepAndUndoTakesItBack)
{
  this->expect_position(0.0, "at first");
  const QImage at_first = this->picture();
  this->begin_drag(0.0, 0.4);
  EXPECT_EQ(this->steps(), 0) << "the drag still goes on";
  EXPECT_EQ(this->option("place").toDouble(), 0.5) << "the drag still goes on";
  this->end_drag();
  ASSERT_EQ(this->steps(), 1);
  EXPECT_EQ(this->undo_text(), GetParam().move);
  const double moved = this->plane()->position();
  EXPECT_NEAR(moved, 0.4, 0.08);
  EXPECT_NEAR(this->option("place").toDouble(), 0.5 * (1.0 + moved), 1e-12);
  const QImage then = this->picture();
  EXPECT_NE(then, at_first);
  this->begin_drag(moved, -0.3);
  this->end_drag();
  ASSERT_EQ(this->steps(), 2) << "another drag is another step";
  EXPECT_NEAR(this->plane()->position(), -0.3, 0.08);
  this->undo();
  this->expect_position(moved, "the second drag is undone");
  this->user.move(QPoint(2, 2)); // there is nothing under the mouse here
  EXPECT_EQ(this->picture(), then);
  this->undo();
  this->expect_position(0.0, "both are");
  this->redo();
  this->expect_position(moved, "the first is done again");
  EXPECT_EQ(this->picture(), then);
}

TEST_P(PlaneWindow, EscDuringADragTakesItBack)
{
  this->row()->field()->setValue(0.2);
  this->render();
  ASSERT_EQ(this->steps(), 1);
  this->begin_drag(0.2, 0.6);
  EXPECT_GT(this->plane()->position(), 0.4);
  EXPECT_EQ(this->user.press_key("Esc"), QString());
  this->expect_position(0.2, "Esc");
  EXPECT_FALSE(this->plane()->is_dragged());
  this->user.move(this->last + QPoint(40, 40)); // the mouse button is still down
  this->end_drag();
  this->expect_position(0.2, "the button is let go");
  EXPECT_EQ(this->steps(), 1);
  // Undo ends the drag, and also reverts the step before the drag.
  this->begin_drag(0.2, 0.6);
  this->undo();
  this->end_drag();
  this->expect_position(0.0, "undo");
  EXPECT_EQ(this->steps(), 0);
  EXPECT_EQ(this->window.document()->history()->count(), this->begin + 1)
    << "the step can be done again";
  // Saving during a drag saves the state before the drag.
  this->begin_drag(0.0, 0.5);
  ASSERT_TRUE(this->part<app::window::WindowSessions>()->write(
    QString::fromStdString(this->folder / "half.bindpose")));
  EXPECT_EQ(this->option("place").toDouble(), 0.5);
  this->end_drag();
  EXPECT_EQ(this->undo_text(), GetParam().move);
  EXPECT_NEAR(this->plane()->position(), 0.5, 0.08);
}

TEST_P(PlaneWindow, TheSliderIsOneStepUntilItIsLetGo)
{
  QSlider* slider = this->row()->slider();
  for (const int end : { 700, 300 })
  {
    slider->setSliderDown(true);
    for (int slider_value = 500; slider_value != end; slider_value += end > 500 ? 50 : -50)
    {
      slider->setValue(slider_value + (end > 500 ? 50 : -50));
      EXPECT_EQ(slider->value(), slider_value + (end > 500 ? 50 : -50))
        << "it stays under the mouse";
    }
    slider->setSliderDown(false);
    this->expect_position(-1.0 + 0.002 * end, "slider");
  }
  EXPECT_EQ(this->steps(), 2);
  EXPECT_EQ(this->undo_text(), GetParam().move);
  this->undo();
  this->expect_position(0.4, "undo");
  EXPECT_EQ(slider->value(), 700);
  this->undo();
  this->expect_position(0.0, "undo of all");
  // Tours (scripts that operate the window) set the position of the plane as a fraction of the
  // range of the slider.
  EXPECT_EQ(this->user.choose(this->key("place"), 0.25), QString());
  this->expect_position(-0.5, "a tour");
}

TEST_P(PlaneWindow, AFreePlaneIsTurnedInOneStep)
{
  EXPECT_EQ(this->user.choose(this->key("orientation"), app::view::PlaneHandle::x_axis), QString());
  EXPECT_EQ(this->undo_text(), GetParam().axis);
  this->row()->field()->setValue(0.1);
  EXPECT_EQ(
    this->user.choose(this->key("orientation"), app::view::PlaneHandle::free_plane), QString());
  EXPECT_EQ(this->plane()->normal(), Vec3(1, 0, 0)) << "it begins where the axis was";
  EXPECT_NEAR(this->plane()->position(), 0.1, 1e-9);
  EXPECT_EQ(this->user.choose(this->key("orientation"), app::view::PlaneHandle::z_axis), QString());
  EXPECT_EQ(
    this->user.choose(this->key("orientation"), app::view::PlaneHandle::free_plane), QString());
  this->render();
  const int before = this->steps();
  this->turn({ 70, 30 });
  const Vec3 turned = this->plane()->normal();
  const double moved = this->plane()->position();
  ASSERT_LT(turned.z(), 0.99);
  ASSERT_EQ(this->steps(), before + 1);
  EXPECT_EQ(this->undo_text(), GetParam().turn);
  const QVariantList stored_normal = this->option("normal").toList();
  ASSERT_EQ(stored_normal.size(), 3);
  for (int k = 0; k < 3; ++k)
  {
    EXPECT_EQ(stored_normal[k].toDouble(), turned[k]);
  }
  // Choose an axis for the plane, then undo. The free plane has its previous orientation again.
  EXPECT_EQ(this->user.choose(this->key("orientation"), app::view::PlaneHandle::y_axis), QString());
  EXPECT_EQ(this->plane()->normal(), Vec3(0, 1, 0));
  this->undo();
  EXPECT_EQ(this->plane()->normal(), turned);
  this->expect_position(moved, "undo of an axis");
  this->undo();
  EXPECT_EQ(this->plane()->normal(), Vec3(0, 0, 1));
  EXPECT_EQ(this->plane()->orientation(), app::view::PlaneHandle::free_plane);
  this->redo();
  EXPECT_EQ(this->plane()->normal(), turned);
  this->expect_position(moved, "redo of the turn");
  this->redo();
  EXPECT_EQ(this->plane()->normal(), Vec3(0, 1, 0));
  for (int k = 0; k < 7; ++k)
  {
    this->undo();
  }
  EXPECT_EQ(this->plane()->orientation(), app::view::PlaneHandle::z_axis);
  this->expect_position(0.0, "undo of all");
}

TEST_P(PlaneWindow, SessionsKeepThePlane)
{
  EXPECT_EQ(
    this->user.choose(this->key("orientation"), app::view::PlaneHandle::free_plane), QString());
  this->render();
  this->turn({ 70, 30 });
  this->row()->field()->setValue(0.3);
  const Vec3 turned = this->plane()->normal();
  ASSERT_LT(turned.z(), 0.99);
  const std::string path = this->folder / "work.bindpose";
  ASSERT_TRUE(this->part<app::window::WindowSessions>()->write(QString::fromStdString(path)));
  {
    app::window::MainWindow other;
    other.show();
    ASSERT_TRUE(other.open(QString::fromStdString(path))) << other.error().toStdString();
    app::view::PlaneHandle* plane = plane_of(other, GetParam().name);
    EXPECT_EQ(plane->orientation(), app::view::PlaneHandle::free_plane);
    EXPECT_EQ(plane->normal(), turned);
    EXPECT_NEAR(plane->position(), 0.3, 1e-9);
    EXPECT_NEAR(other.findChild<app::window::PanelColumn*>()
                  ->findChild<app::parts::ValueRow*>(this->key("place"))
                  ->value(),
      0.3, 0.002);
    EXPECT_EQ(other.document()->history()->count(), 0) << "to open a session is no step";
    EXPECT_FALSE(other.isWindowModified());
  }
  // A session that was saved before these options existed gives the same plane as a new window.
  std::ifstream file(path);
  nlohmann::json old = nlohmann::json::parse(file);
  for (const char* option_name : { "place", "normal", "orientation" })
  {
    ASSERT_EQ(old["options"].erase(this->key(option_name).toStdString()), 1u);
  }
  this->folder.write("old.bindpose", old.dump());
  ASSERT_TRUE(this->window.open(QString::fromStdString(this->folder / "old.bindpose")))
    << this->window.error().toStdString();
  EXPECT_EQ(this->plane()->orientation(), app::view::PlaneHandle::z_axis);
  this->expect_position(0.0, "an old session");
}
