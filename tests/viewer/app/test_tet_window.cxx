// Tets and defects in the window, as a user inspects them. The tests compare the window with known
// positions, with counts by brute force, and with the output of vtkSurfaceDefects.
#include "unclipped.h"
#include "window_test.h"

#include "app/handles/side_panel.h"
#include "app/parts/value_row.h"
#include "app/posing/posing.h"
#include "app/tets/tet_inspection.h"
#include "app/tets/tet_panel.h"
#include "document/document.h"

#include "conversion.h"
#include "scene/categories.h"
#include "scene/colors.h"

#include "support/meshes.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkHandleSetRepresentation.h"
#include "vtkHandleSetWidget.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkSurfaceDefects.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLPolyDataWriter.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <QThread>

#include <algorithm>
#include <cstdio>

using namespace bindpose;

namespace
{
/// Return a box around the origin with n^3 cells of six tets each.
TetMesh make_tet_box(int n)
{
  return test::tet_box(n, n, n, Vec3(-1, -1, -1), Vec3(1, 1, 1));
}

vtkSmartPointer<vtkUnstructuredGrid> to_tet_grid(const TetMesh& mesh)
{
  return to_unstructured_grid(mesh.points, mesh.tets);
}

Index count_tets_behind(const TetMesh& mesh, const Vec3& origin, const Vec3& normal)
{
  Index count = 0;
  for (Index t = 0; t < mesh.tets.rows(); ++t)
  {
    Vec3 center = Vec3::Zero();
    for (int k = 0; k < 4; ++k)
    {
      center += 0.25 * mesh.points.row(mesh.tets(t, k)).transpose();
    }
    count += (center - origin).dot(normal) <= 0.0;
  }
  return count;
}

bool is_cut(const QColor& c)
{
  return c.blue() > c.red() + 20 && c.green() > c.red() + 20;
}

class TetWindow : public test::WindowTest
{
protected:
  app::tets::TetInspection* tet_inspection() { return this->part<app::tets::TetInspection>(); }
  app::tets::TetView* view() { return this->tet_inspection()->tet_view(); }
  app::tets::TetPanel* panel() { return this->part<app::window::PanelColumn>()->tet(); }
  /// Return a row of the panel: row 0 is the position of the cut, row 1 the size of the tets.
  app::parts::ValueRow* row(int which)
  {
    return this->panel()->findChildren<app::parts::ValueRow*>()[which];
  }
  QComboBox* list(const QString& item)
  {
    for (QComboBox* box : this->panel()->findChildren<QComboBox*>())
    {
      if (box->findText(item) >= 0)
      {
        return box;
      }
    }
    ADD_FAILURE() << "no list has " << item.toStdString();
    return nullptr;
  }
  void choose(const QString& item) { this->list(item)->setCurrentText(item); }

  void open(vtkDataSet* mesh, int panel = app::window::PanelColumn::tets)
  {
    ASSERT_TRUE(this->window.set_mesh(mesh, "mesh")) << this->window.error().toStdString();
    this->part<app::window::PanelColumn>()->show_panel(panel);
    this->render();
  }

  /// Wait until no computation is running.
  void wait()
  {
    QElapsedTimer clock;
    clock.start();
    do
    {
      QThread::msleep(5);
      QApplication::processEvents();
    } while (this->tet_inspection()->is_busy() && clock.elapsed() < 60000);
    QApplication::processEvents();
  }
};
} // namespace

TEST_F(TetWindow, TetsAreOpenedCutOpen)
{
  const TetMesh mesh = make_tet_box(5);
  ASSERT_TRUE(this->window.set_mesh(to_tet_grid(mesh), "box"));
  EXPECT_TRUE(this->panel()->isVisible());
  EXPECT_EQ(this->view()->shown_count(),
    count_tets_behind(mesh, this->view()->plane()->origin(), this->view()->plane()->normal()));
  EXPECT_LT(this->view()->shown_count(), mesh.tets.rows());
  EXPECT_FALSE(this->part<app::view::Viewport>()->surface_actor()->GetVisibility());
  const QImage image = this->picture();
  // The plane is in the middle of a layer of cells. The exposed facets are at most one cell away
  // from it.
  EXPECT_GT(count(image, is_cut), 5000);
  EXPECT_TRUE(is_cut(image.pixelColor(this->pixel(Vec3(0.11, 0.23, 0.0)))));
  // Without the cut, no exposed facets are visible.
  this->find<QCheckBox>("Cut the tets")->setChecked(false);
  EXPECT_EQ(this->view()->shown_count(), mesh.tets.rows());
  EXPECT_LT(count(this->picture(), is_cut), 20);
  // Each tet is on at least one side of the plane. Tets with their center on the plane belong to
  // both sides.
  this->find<QCheckBox>("Cut the tets")->setChecked(true);
  const Index shown_behind = this->view()->shown_count();
  this->find<QCheckBox>("Keep the other side")->setChecked(true);
  EXPECT_GE(this->view()->shown_count() + shown_behind, mesh.tets.rows());
  EXPECT_EQ(this->view()->shown_count(),
    count_tets_behind(mesh, this->view()->plane()->origin(), -this->view()->plane()->normal()));
}

/// The first cut faces the camera. If the shape is viewed along x, a cut perpendicular to z would
/// not show the inside.
TEST_F(TetWindow, TheFirstCutShowsTheInside)
{
  for (const Vec3& size : { Vec3(0.5, 1, 1), Vec3(1, 1, 0.5), Vec3(0.3, 1, 0.6) })
  {
    const TetMesh mesh = test::tet_box(5, 5, 5, -size, size);
    app::window::MainWindow other;
    other.show();
    ASSERT_TRUE(other.set_mesh(to_tet_grid(mesh), "box"));
    QApplication::processEvents();
    other.findChild<app::view::Viewport*>()->renderWindow()->Render();
    const app::tets::TetView* tets = other.findChild<app::tets::TetInspection*>()->tet_view();
    const Vec3 normal = tets->plane()->normal();
    const Vec3 view_direction(other.findChild<app::view::Viewport*>()
                                ->renderer()
                                ->GetActiveCamera()
                                ->GetDirectionOfProjection());
    EXPECT_EQ(std::abs(normal.dot(view_direction)), view_direction.cwiseAbs().maxCoeff())
      << size.transpose();
    EXPECT_GT(count(other.findChild<app::view::Viewport*>()->grabFramebuffer(), is_cut), 5000)
      << size.transpose();
    // The cut is through the middle, so about half of the tets remain.
    const double shown_tets = static_cast<double>(tets->shown_count());
    EXPECT_NEAR(shown_tets / static_cast<double>(mesh.tets.rows()), 0.5, 0.15) << size.transpose();
  }
}

/// An orientation that the user has chosen is kept.
TEST_F(TetWindow, AChosenCutStaysForOtherTets)
{
  this->open(to_tet_grid(test::tet_box(3, 3, 3, Vec3(-1, -1, -0.5), Vec3(1, 1, 0.5))));
  EXPECT_EQ(this->view()->plane()->orientation(), app::view::PlaneHandle::z_axis);
  this->find<QPushButton>("Y")->click();
  this->open(to_tet_grid(test::tet_box(3, 3, 3, Vec3(-0.5, -1, -1), Vec3(0.5, 1, 1))));
  EXPECT_EQ(this->view()->plane()->orientation(), app::view::PlaneHandle::y_axis);
}

/// A side of the cut that the user has chosen is kept when other tets are opened. If the program
/// changed the side without an undo step, a redo of all steps would restore another side.
TEST_F(TetWindow, AChosenSideOfTheCutStaysForOtherTets)
{
  this->open(to_tet_grid(test::tet_box(3, 3, 3, Vec3(-1, -1, -0.5), Vec3(1, 1, 0.5))));
  this->find<QCheckBox>("Keep the other side")->click();
  const bool side = this->window.document()->option("tets.other_side").toBool();
  this->open(to_tet_grid(test::tet_box(3, 3, 3, Vec3(-0.5, -1, -1), Vec3(0.5, 1, 1))));
  EXPECT_EQ(this->view()->plane()->orientation(), app::view::PlaneHandle::z_axis);
  EXPECT_EQ(this->window.document()->option("tets.other_side").toBool(), side);
  QUndoStack* history = this->window.document()->history();
  const int index = history->index();
  history->setIndex(0);
  history->setIndex(index);
  EXPECT_EQ(this->view()->plane()->orientation(), app::view::PlaneHandle::z_axis);
  EXPECT_EQ(this->window.document()->option("tets.other_side").toBool(), side);
}

/// Tets and defects have no pose. While they are visible, the shape and the handles are at rest.
TEST_F(TetWindow, NothingIsPosedAroundTetsAtRest)
{
  const auto grid = to_tet_grid(make_tet_box(4));
  vtkNew<vtkDoubleArray> weights;
  weights->SetName("Weights");
  weights->SetNumberOfComponents(2);
  for (vtkIdType v = 0; v < grid->GetNumberOfPoints(); ++v)
  {
    const double height_fraction = 0.5 * (1.0 + grid->GetPoint(v)[2]);
    weights->InsertNextTuple2(1.0 - height_fraction, height_fraction);
  }
  weights->SetComponentName(0, "bottom");
  weights->SetComponentName(1, "top");
  grid->GetPointData()->AddArray(weights);
  this->open(grid, app::window::PanelColumn::bind_and_pose);
  ASSERT_TRUE(this->window.set_handles(test::two_points(), "points"));
  ASSERT_TRUE(this->window.is_bound()) << this->window.error().toStdString();
  Pose pose(2);
  pose[0].transform.col(3) = pose[1].transform.col(3) = Vec3(0, 1, 0);
  this->window.document()->set_pose(pose, "up");
  auto* handles = this->part<app::view::Viewport>()->handle_widget()->GetHandleSetRepresentation();
  const auto heights = [&]
  {
    double shape[6];
    this->part<app::view::Viewport>()->drawn()->GetBounds(shape);
    return std::pair(shape[3], handles->GetBounds()[3]);
  };
  const auto expect = [&](bool rest, const char* when)
  {
    EXPECT_NEAR(heights().first, rest ? 1.0 : 2.0, 1e-9) << when;
    EXPECT_NEAR(heights().second, rest ? 0.0 : 1.0, 1e-9) << when;
    EXPECT_EQ(this->part<app::view::Viewport>()->state_name().startsWith("Rest shape: "), rest)
      << when;
    EXPECT_NEAR(this->window.document()->pose()[1].transform(1, 3), 1.0, 1e-12) << when;
  };
  expect(false, "posed");
  this->part<app::window::PanelColumn>()->show_panel(app::window::PanelColumn::tets);
  ASSERT_GT(this->view()->shown_count(), 0);
  expect(true, "tets");
  // While the shape is at rest, handles cannot be dragged. A click selects them.
  this->drag(this->pixel(Vec3(0, 0, 0.9)), this->pixel(Vec3(0.5, 0, 0.9)));
  expect(true, "a drag");
  this->find<QCheckBox>("Show the tets")->setChecked(false);
  expect(false, "no tets");
  this->find<QCheckBox>("Show its defects")->setChecked(true);
  this->wait();
  expect(true, "defects");
  this->part<app::window::PanelColumn>()->show_panel(app::window::PanelColumn::bind_and_pose);
  expect(false, "the panel Pose");
  this->part<app::posing::PoseController>()->set_rest_view(true);
  expect(true, "T");
  this->part<app::posing::PoseController>()->set_rest_view(false);
  expect(false, "T again");
  // Exports and the undo history use the posed shape, even while tets or defects are shown at rest.
  this->part<app::window::PanelColumn>()->show_panel(app::window::PanelColumn::tets);
  double bounds[6];
  this->window.shown()->GetBounds(bounds);
  EXPECT_NEAR(bounds[3], 2.0, 1e-9);
}

TEST_F(TetWindow, TheMouseDragsThePlane)
{
  const TetMesh mesh = make_tet_box(6);
  this->open(to_tet_grid(mesh));
  this->row(0)->field()->setValue(0.1);
  this->render();
  this->drag(this->pixel(Vec3(0.5, 0.4, 0.1)), this->pixel(Vec3(0.5, 0.4, 0.6)));
  EXPECT_NEAR(this->view()->plane()->position(), 0.6, 0.08);
  EXPECT_NEAR(this->row(0)->value(), this->view()->plane()->position(), 0.01);
  EXPECT_EQ(this->view()->plane()->normal(), Vec3(0, 0, 1));
  EXPECT_EQ(this->view()->shown_count(),
    count_tets_behind(mesh, this->view()->plane()->origin(), Vec3(0, 0, 1)));
  for (int axis = 0; axis < 3; ++axis)
  {
    const char* const names[] = { "X", "Y", "Z" };
    this->find<QPushButton>(names[axis])->click();
    EXPECT_EQ(this->view()->plane()->normal(), Vec3(Vec3::Unit(axis)));
    this->row(0)->slider()->setValue(300 + 100 * axis);
    EXPECT_EQ(this->view()->shown_count(),
      count_tets_behind(mesh, this->view()->plane()->origin(), Vec3::Unit(axis)));
  }
  // At the lower end of the slider, there are no tets on the shown side, and a label states this.
  this->row(0)->slider()->setValue(0);
  EXPECT_EQ(this->view()->shown_count(), 0);
  EXPECT_NE(this->find<QLabel>("There are no tets on this side."), nullptr);
}

TEST_F(TetWindow, AHundredThousandTetsFollowTheMouse)
{
  const TetMesh mesh = make_tet_box(26);
  ASSERT_GT(mesh.tets.rows(), 100000);
  this->open(to_tet_grid(mesh));
  this->choose("By quality");
  const auto median = [this]
  {
    std::vector<double> times;
    for (int step = 0; step < 21; ++step)
    {
      this->row(0)->slider()->setValue(200 + 29 * step);
      times.push_back(this->view()->milliseconds());
    }
    std::nth_element(times.begin(), times.begin() + 10, times.end());
    return times[10];
  };
  EXPECT_LT(median(), 30.0);
  this->row(1)->field()->setValue(0.8);
  EXPECT_LT(median(), 60.0);
}

TEST_F(TetWindow, ShrunkTetsStandApart)
{
  this->open(to_tet_grid(make_tet_box(3)));
  this->find<QCheckBox>("Cut the tets")->setChecked(false);
  const auto count_background = [this]
  {
    // The point is on the face z = 1, which is viewed obliquely.
    const QImage image = this->picture();
    int background_pixels = 0;
    for (int i = 1; i < 100; ++i)
    {
      for (int j = 1; j < 100; ++j)
      {
        const QColor c = image.pixelColor(this->pixel(Vec3(0.018 * i - 0.9, 0.018 * j - 0.9, 1.0)));
        background_pixels += c.red() > 218 && c.green() > 218 && c.blue() > 218;
      }
    }
    return background_pixels;
  };
  EXPECT_LT(count_background(), 30);
  this->row(1)->field()->setValue(0.3);
  EXPECT_GT(count_background(), 1000);
  this->row(1)->field()->setValue(1.0);
  EXPECT_LT(count_background(), 30);
}

TEST_F(TetWindow, ColorsAreThoseOfTheLegend)
{
  const TetMesh mesh = make_tet_box(4);
  const auto grid = to_tet_grid(mesh);
  vtkNew<vtkIntArray> labels;
  labels->SetName("Label");
  for (Index t = 0; t < mesh.tets.rows(); ++t)
  {
    labels->InsertNextValue(mesh.points(mesh.tets(t, 0), 0) < -0.01 ? 0 : 1);
  }
  grid->GetCellData()->AddArray(labels);
  this->open(grid);
  this->find<QCheckBox>("Cut the tets")->setChecked(false);
  this->choose("By label");
  EXPECT_EQ(this->window.error(), QString());
  const QImage image = this->picture();
  const QColor left = image.pixelColor(this->pixel(Vec3(-0.6, 0.13, 1.0)));
  const QColor right = image.pixelColor(this->pixel(Vec3(0.66, 0.13, 1.0)));
  EXPECT_GT(left.blue(), left.red() + 20) << "outside: blue";
  EXPECT_GT(right.red(), right.blue() + 30) << "inside: orange";
  // If the tets have no data for a coloring, an error message appears, and the colors do not
  // change.
  const auto refused = [this](const char* item, const char* words)
  {
    this->choose(item);
    EXPECT_NE(this->window.error().indexOf(words), -1) << this->window.error().toStdString();
    EXPECT_EQ(this->list("By label")->currentText(), QString("By label"));
  };
  refused("By winding number", "no array 'WindingNumber'");
  refused("By method", "no field data array 'Method'");
  EXPECT_EQ(this->picture().pixelColor(this->pixel(Vec3(0.66, 0.13, 1.0))), right);
  this->choose("By quality");
  this->choose("Plain");
}

TEST_F(TetWindow, DefectsAreThoseOfTheFilter)
{
  const TriangleMesh mesh = test::join(
    test::open_cube(), test::translated(test::flipped(test::cube()), Vec3(0.5, 0.3, 0.2)));
  const auto surface = to_polydata(mesh.points, mesh.triangles);
  vtkNew<vtkSurfaceDefects> filter;
  filter->SetInputData(surface);
  filter->Update();
  this->open(surface);
  EXPECT_EQ(this->part<app::view::Viewport>()->surface_actor()->GetProperty()->GetOpacity(), 1.0);
  this->find<QCheckBox>("Show its defects")->setChecked(true);
  this->wait();
  vtkPolyData* shown = this->tet_inspection()->defect_view().defects();
  ASSERT_NE(shown, nullptr) << this->window.error().toStdString();
  std::vector<Category> expected = defect_categories();
  std::vector<Category> seen = defect_categories();
  count_defects(vtkPolyData::SafeDownCast(filter->GetOutput()), expected);
  count_defects(shown, seen);
  Index all = 0;
  for (std::size_t kind = 0; kind < seen.size(); ++kind)
  {
    EXPECT_EQ(seen[kind].count, expected[kind].count) << seen[kind].name;
    all += seen[kind].count;
  }
  EXPECT_EQ(seen[2].count, 4) << "boundary edges";
  // A file with defects contains neither handles nor a surface.
  const std::string path = testing::TempDir() + "bindpose_defects.vtp";
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(shown);
  writer->SetFileName(path.c_str());
  writer->Write();
  EXPECT_FALSE(this->window.open(QString::fromStdString(path)));
  std::remove(path.c_str());
  EXPECT_NE(this->window.error().indexOf("defects cannot be opened directly"), -1);
  EXPECT_EQ(seen[8].count, filter->GetReport().number("counts.inward_components", -1))
    << "components, as bindpose info counts them";
  EXPECT_EQ(seen[8].count, 1);
  EXPECT_NE(this->find<QLabel>(QString("%1 defects").arg(all)), nullptr);
  EXPECT_LT(this->part<app::view::Viewport>()->surface_actor()->GetProperty()->GetOpacity(), 1.0);
  // The edge of the opening is green in the view.
  const QColor edge = this->picture().pixelColor(this->pixel(Vec3(-1.0, -0.4, 1.0)));
  EXPECT_GT(edge.green(), edge.red() + 30);
  // Another surface has its own defects. While another panel is open, defects are hidden.
  const TriangleMesh clean = test::cube();
  ASSERT_TRUE(this->window.set_mesh(to_polydata(clean.points, clean.triangles), "cube"));
  this->wait();
  ASSERT_NE(this->tet_inspection()->defect_view().defects(), nullptr);
  EXPECT_EQ(this->tet_inspection()->defect_view().defects()->GetNumberOfCells(), 0);
  this->find<QPushButton>("Pose")->click();
  EXPECT_EQ(this->part<app::view::Viewport>()->surface_actor()->GetProperty()->GetOpacity(), 1.0);
}

TEST_F(TetWindow, TetsAreMadeAndAFailureKeepsThem)
{
  const TriangleMesh flat = test::grid(4, 4);
  this->open(to_polydata(flat.points, flat.triangles));
  this->choose("Embedding lattice");
  this->find<QPushButton>("Make tets")->click();
  EXPECT_TRUE(this->tet_inspection()->is_busy());
  this->wait();
  ASSERT_NE(this->view()->tets(), nullptr) << this->window.error().toStdString();
  const Index tet_count = this->view()->tets()->GetNumberOfCells();
  EXPECT_GT(tet_count, 100);
  EXPECT_GT(this->view()->shown_count(), 0);
  this->choose("By method");
  EXPECT_EQ(this->window.error(), QString());
  // A flat surface encloses no volume.
  vtkUnstructuredGrid* before = this->view()->tets();
  this->choose("Automatic");
  this->find<QPushButton>("Make tets again")->click();
  this->wait();
  EXPECT_NE(this->window.error().indexOf("flat"), -1) << this->window.error().toStdString();
  EXPECT_EQ(this->window.error().count('\n'), 0);
  EXPECT_EQ(this->view()->tets(), before);
  EXPECT_GT(this->view()->shown_count(), 0);
  // Opening another mesh stops the computation.
  this->choose("Embedding lattice");
  this->find<QPushButton>("Make tets again")->click();
  const TriangleMesh ball = test::sphere(2);
  ASSERT_TRUE(this->window.set_mesh(to_polydata(ball.points, ball.triangles), "ball"));
  this->wait();
  EXPECT_EQ(this->view()->tets(), nullptr);
  EXPECT_TRUE(this->part<app::view::Viewport>()->surface_actor()->GetVisibility());
}

TEST_F(TetWindow, ThePanelDecidesWhatIsSeen)
{
  this->open(to_tet_grid(make_tet_box(3)));
  EXPECT_FALSE(this->part<app::view::Viewport>()->surface_actor()->GetVisibility());
  this->find<QPushButton>("Pose")->click();
  EXPECT_TRUE(this->part<app::handles::SidePanel>()->isVisible());
  EXPECT_TRUE(this->part<app::view::Viewport>()->surface_actor()->GetVisibility());
  EXPECT_EQ(this->view()->shown_count(), 0);
  this->find<QPushButton>("Tets")->click();
  EXPECT_GT(this->view()->shown_count(), 0);
  this->find<QCheckBox>("Show the tets")->setChecked(false);
  EXPECT_TRUE(this->part<app::view::Viewport>()->surface_actor()->GetVisibility());
  EXPECT_FALSE(this->find<QCheckBox>("Cut the tets")->isEnabled());
}

TEST_F(TetWindow, NoTextOfTheTetPanelIsClipped)
{
  this->open(to_tet_grid(make_tet_box(20)));
  this->find<QCheckBox>("Show its defects")->setChecked(true);
  this->wait();
  for (const QSize& size : { QSize(900, 680), QSize(1280, 800), QSize(1920, 1080) })
  {
    this->resize(size);
    test::expect_unclipped_buttons(this->part<app::window::PanelColumn>());
    for (QCheckBox* box : this->panel()->findChildren<QCheckBox*>())
    {
      EXPECT_LE(box->sizeHint().width(), box->width()) << box->text().toStdString();
      EXPECT_LE(box->sizeHint().height(), box->height()) << box->text().toStdString();
    }
    test::expect_unclipped_items(this->panel());
    for (QLabel* label : this->panel()->findChildren<QLabel*>())
    {
      EXPECT_LE(label->sizeHint().height(), label->height()) << label->text().toStdString();
      if (!label->wordWrap())
      {
        EXPECT_LE(label->sizeHint().width(), label->width()) << label->text().toStdString();
      }
    }
  }
}
