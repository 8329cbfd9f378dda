// The 2D mode of the window, which shows images and flat meshes. A flat mesh may be in any plane.
// Weights are drawn over the image.
#include "app/weights/binding.h"
#include "window_test.h"

#include "app/parts/notice_bar.h"
#include "app/posing/posing.h"

#include "document/document.h"
#include "handle_edit_cells.h"
#include "scene/camera.h"
#include "scene/colors.h"

#include "support/meshes.h"

#include "vtkCamera.h"
#include "vtkHandleSetWidget.h"
#include "vtkPointData.h"

#include <QAction>
#include <QUndoStack>

#include <algorithm>
#include <cmath>
#include <cstdlib>

using namespace bindpose;

namespace
{
class PlanarWindow : public test::WindowTest
{
protected:
  /// Open a flat rectangle, rotated by `rotation` and centered at `center`.
  void open(const Eigen::Matrix3d& rotation, const Vec3& center = Vec3(1, 2, 3))
  {
    this->mesh = test::grid(16, 8, 2.0, 1.0);
    this->mesh.points =
      ((this->mesh.points.rowwise() - Eigen::RowVector3d(1.0, 0.5, 0.0)) * rotation.transpose())
        .rowwise() +
      center.transpose();
    ASSERT_TRUE(
      this->window.set_mesh(to_polydata(this->mesh.points, this->mesh.triangles), "rectangle"));
    this->resize({ 1000, 700 });
  }
  vtkCamera* camera() { return this->part<app::view::Viewport>()->renderer()->GetActiveCamera(); }
  Vec3 view_direction() { return Vec3(this->camera()->GetDirectionOfProjection()); }
  QAction* flat_view_action()
  {
    return app::tour::SimulatedUser(&this->window).action("view.2d_view");
  }
  void choose(const char* option, const QVariant& value)
  {
    const QString refused = app::tour::SimulatedUser(&this->window).choose(option, value);
    EXPECT_TRUE(refused.isEmpty()) << refused.toStdString();
    this->render();
  }

  TriangleMesh mesh;
};

Eigen::Matrix3d rotation_about(double degrees, const Vec3& axis)
{
  return Eigen::AngleAxisd(degrees * M_PI / 180.0, axis.normalized()).toRotationMatrix();
}

const Eigen::Matrix3d tilted_rotation = rotation_about(35.0, Vec3(1.0, 0.4, 0.2));
} // namespace

TEST_F(PlanarWindow, AShapeInAPlaneIsSeenFromInFrontWithoutPerspective)
{
  for (const auto& [rotation, normal, up] :
    { std::tuple(Eigen::Matrix3d(Eigen::Matrix3d::Identity()), Vec3(0, 0, 1), Vec3(0, 1, 0)),
      std::tuple(rotation_about(90.0, Vec3::UnitY()), Vec3(1, 0, 0), Vec3(0, 1, 0)),
      std::tuple(rotation_about(90.0, Vec3::UnitX()), Vec3(0, -1, 0), Vec3(0, 0, 1)),
      std::tuple(tilted_rotation, Vec3(tilted_rotation.col(2)),
        Vec3((Vec3::UnitY() - tilted_rotation(1, 2) * tilted_rotation.col(2)).normalized())) })
  {
    this->open(rotation);
    EXPECT_TRUE(this->part<app::view::Viewport>()->is_flat());
    EXPECT_TRUE(this->camera()->GetParallelProjection() != 0);
    EXPECT_LT((this->view_direction() + normal).norm(), 1e-9) << normal.transpose();
    EXPECT_LT((Vec3(this->camera()->GetViewUp()) - up).norm(), 1e-9) << normal.transpose();
    // The whole shape is visible. It is large and centered in the view.
    QRect seen;
    for (Index v = 0; v < this->mesh.points.rows(); ++v)
    {
      seen |= QRect(this->pixel(this->mesh.points.row(v)), QSize(1, 1));
    }
    const QRect view = this->part<app::view::Viewport>()->rect();
    EXPECT_TRUE(view.contains(seen));
    EXPECT_LE((seen.center() - view.center()).manhattanLength(), 3);
    EXPECT_GT(
      std::max(1.0 * seen.width() / view.width(), 1.0 * seen.height() / view.height()), 0.7);
    EXPECT_TRUE(this->bar("note_bar")->message().isEmpty() || !this->bar("note_bar")->isVisible())
      << "the border of a rectangle is no defect";
  }
}

TEST_F(PlanarWindow, DraggingMovesItAndTheMenuLetsItBeTurned)
{
  this->open(tilted_rotation);
  const Vec3 view_direction = this->view_direction();
  const QPoint position = this->part<app::view::Viewport>()->rect().center();
  const Vec3 middle(1, 2, 3);
  const QPoint before = this->pixel(middle);
  this->drag(position, position + QPoint(60, 25));
  EXPECT_LT((this->view_direction() - view_direction).norm(), 1e-9);
  EXPECT_LE((this->pixel(middle) - before - QPoint(60, 25)).manhattanLength(), 3);
  // Leave the 2D mode and return to it.
  ASSERT_TRUE(this->flat_view_action()->isEnabled());
  EXPECT_TRUE(this->flat_view_action()->isChecked());
  this->flat_view_action()->trigger();
  this->render();
  EXPECT_FALSE(this->part<app::view::Viewport>()->is_flat());
  EXPECT_FALSE(this->flat_view_action()->isChecked());
  EXPECT_FALSE(this->camera()->GetParallelProjection() != 0);
  const Vec3 direction_before = this->view_direction();
  this->drag(position, position + QPoint(60, 25));
  EXPECT_GT((this->view_direction() - direction_before).norm(), 0.05);
  this->flat_view_action()->trigger();
  this->render();
  EXPECT_TRUE(this->part<app::view::Viewport>()->is_flat());
  EXPECT_LT((this->view_direction() + tilted_rotation.col(2)).norm(), 1e-9);
  // A ball has no 2D mode.
  const TriangleMesh ball = test::sphere(3);
  ASSERT_TRUE(this->window.set_mesh(to_polydata(ball.points, ball.triangles), "ball"));
  EXPECT_FALSE(this->part<app::view::Viewport>()->is_flat());
  EXPECT_FALSE(this->flat_view_action()->isEnabled());
  EXPECT_FALSE(this->camera()->GetParallelProjection() != 0);
}

TEST_F(PlanarWindow, ATiltedPlaneIsBoundPosedInItselfAndLayered)
{
  this->open(tilted_rotation);
  Handles handles(2);
  handles[0].name = "left";
  handles[0].head = handles[0].tail = Vec3(1, 2, 3) - 0.9 * tilted_rotation.col(0);
  handles[1].name = "right";
  handles[1].head = handles[1].tail = Vec3(1, 2, 3) + 0.9 * tilted_rotation.col(0);
  ASSERT_TRUE(this->window.set_handles(to_polydata(handles), "points"));
  this->part<app::weights::Binding>()->start();
  ASSERT_TRUE(
    test::wait_for([this] { return !this->part<app::weights::Binding>()->is_running(); }));
  ASSERT_EQ(this->window.error(), QString());
  ASSERT_TRUE(this->window.is_bound());
  // The mouse moves the handle within the plane of the shape.
  const QPoint position = this->pixel(handles[1].head);
  this->render();
  this->drag(position, position + QPoint(-40, -60));
  const Points posed = to_points(this->window.shown()).view();
  EXPECT_GT((posed - this->mesh.points).rowwise().norm().maxCoeff(), 0.05);
  const Vec3 normal = tilted_rotation.col(2);
  EXPECT_LT(((posed.rowwise() - Eigen::RowVector3d(1, 2, 3)) * normal).cwiseAbs().maxCoeff(), 1e-9);
  // Layers move the drawn surface along its normal. They change nothing else.
  set_handle_layer(
    this->window.document()->handle_data(), this->window.document()->handle_cells()[1], 3.0);
  this->window.document()->commit_handles("layer", "layer");
  this->render();
  vtkPolyData* drawn = this->part<app::view::Viewport>()->drawn();
  const auto& from = this->part<app::view::Viewport>()->drawn_points();
  double minimum_offset = 1e300, maximum_offset = -1e300;
  for (vtkIdType v = 0; v < drawn->GetNumberOfPoints(); ++v)
  {
    const Vec3 offset = Vec3(drawn->GetPoint(v)) -
      Vec3(this->window.shown()->GetPoint(from[static_cast<std::size_t>(v)]));
    EXPECT_LT((offset - offset.dot(normal) * normal).norm(), 1e-9);
    minimum_offset = std::min(minimum_offset, offset.dot(normal));
    maximum_offset = std::max(maximum_offset, offset.dot(normal));
  }
  EXPECT_GT(maximum_offset - minimum_offset, 1e-4);
}

TEST_F(PlanarWindow, WeightsLieOverThePictureAsMuchAsIsWanted)
{
  ASSERT_TRUE(this->window.open(QString(BINDPOSE_TOURS) + "/data/doll.png"));
  ASSERT_TRUE(this->window.open(QString(BINDPOSE_TOURS) + "/data/doll.tgf"));
  ASSERT_TRUE(this->part<app::view::Viewport>()->is_flat());
  this->part<app::view::Viewport>()->handle_widget()->SetEnabled(false);
  const Index points = this->window.document()->surface()->GetNumberOfPoints();
  const auto columns = static_cast<Index>(this->window.document()->handles().size());
  // Weights that are equal everywhere give one color and no isolines.
  Weights weights = Weights::Constant(points, columns, 0.65 / (columns - 1));
  weights.col(0).setConstant(0.35);
  ASSERT_TRUE(this->window.document()->set_weights(weights, "even").ok());
  this->part<app::view::Viewport>()->handle_widget()->SetEnabled(false);
  this->part<app::window::PanelColumn>()->show_panel(app::window::PanelColumn::weights);
  this->resize({ 1000, 700 });
  this->choose("weights.column", 1);
  this->choose("weights.over_picture", 0.0);
  const QImage picture = this->picture();
  this->choose("weights.over_picture", 1.0);
  EXPECT_EQ(this->window.document()->history()->undoText(), "opacity of the colors");
  const QImage colors = this->picture();
  this->choose("weights.over_picture", 0.5);
  const QImage both = this->picture();
  const Rgb band = color_of(weight_map(), 0.35);
  int covered_pixels = 0, wrong_pixels = 0;
  const auto channel = [](const QColor& c, int k) {
    return k == 0 ? c.red() : k == 1 ? c.green() : c.blue();
  };
  for (int y = 0; y < both.height(); ++y)
  {
    for (int x = 200; x < both.width(); ++x) // columns of pixels to the right of the scalar bar
    {
      const QColor c = colors.pixelColor(x, y);
      const bool inside = std::abs(c.red() - 255.0 * band[0]) < 3 &&
        std::abs(c.green() - 255.0 * band[1]) < 3 && std::abs(c.blue() - 255.0 * band[2]) < 3;
      covered_pixels += inside;
      for (int k = 0; inside && k < 3; ++k)
      {
        wrong_pixels += std::abs(channel(both.pixelColor(x, y), k) -
                          0.5 * (channel(picture.pixelColor(x, y), k) + channel(c, k))) > 3.0;
      }
    }
  }
  EXPECT_GT(covered_pixels, 20000);
  EXPECT_EQ(wrong_pixels, 0);
  // Weights with opacity 0 look the same as the shaded surface without weights.
  this->part<app::window::PanelColumn>()->show_panel(app::window::PanelColumn::bind_and_pose);
  this->choose("show.column", 0);
  const QImage plain = this->picture();
  int differing_pixels = 0;
  for (int y = 0; y < plain.height(); ++y)
  {
    for (int x = 200; x < plain.width(); ++x)
    {
      differing_pixels += plain.pixel(x, y) != picture.pixel(x, y);
    }
  }
  EXPECT_EQ(differing_pixels, 0);
}

TEST_F(PlanarWindow, BesideEachOtherBothShapesHaveThePicture)
{
  ASSERT_TRUE(this->window.open(QString(BINDPOSE_TOURS) + "/data/doll.png"));
  ASSERT_TRUE(this->window.open(QString(BINDPOSE_TOURS) + "/data/doll.tgf"));
  const Index points = this->window.document()->surface()->GetNumberOfPoints();
  const auto columns = static_cast<Index>(this->window.document()->handles().size());
  const Weights equal_weights =
    Weights::Constant(points, columns, 1.0 / static_cast<double>(columns));
  ASSERT_TRUE(this->window.document()->set_weights(equal_weights, "even").ok());
  this->resize({ 1100, 700 });
  this->choose("pose.compared", 2);
  this->choose("pose.ghost", 1);
  this->part<app::view::Viewport>()->handle_widget()->SetEnabled(false);
  const QImage seen = this->picture();
  // Exclude the names at the bottom of the view.
  const int half = seen.width() / 2, image_bottom = seen.height() - 60;
  int colored_pixels = 0, differing_pixels = 0;
  for (int y = 0; y < image_bottom; ++y)
  {
    for (int x = 0; x < half; ++x)
    {
      const QColor a = seen.pixelColor(x, y), b = seen.pixelColor(x + half, y);
      colored_pixels += b.saturation() > 60;
      differing_pixels += std::max({ std::abs(a.red() - b.red()), std::abs(a.green() - b.green()),
                            std::abs(a.blue() - b.blue()) }) > 24;
    }
  }
  EXPECT_GT(colored_pixels, 5000);
  // At rest both halves are equal; if the width is odd, one half is shifted by half a pixel.
  EXPECT_LT(differing_pixels, colored_pixels / 10);
  // The shape of the compared method is drawn over the first shape, in translucent blue. It is
  // visible wherever the two shapes differ.
  this->choose("pose.ghost", 0);
  const auto is_blue = [](const QColor& c) { return c.blue() > c.red() + 20; };
  const int same = count(this->picture(), is_blue);
  Pose pose(static_cast<std::size_t>(columns));
  pose[0].transform.leftCols<3>() = Eigen::AngleAxisd(1.5, Vec3::UnitZ()).toRotationMatrix();
  this->window.document()->set_pose(pose, "turn");
  EXPECT_GT(count(this->picture(), is_blue), same + 3000);
}

TEST_F(PlanarWindow, IsolinesStayOnTopOfThePicture)
{
  ASSERT_TRUE(this->window.open(QString(BINDPOSE_TOURS) + "/data/doll.png"));
  ASSERT_TRUE(this->window.open(QString(BINDPOSE_TOURS) + "/data/doll.tgf"));
  const auto rest = to_points(this->window.document()->surface());
  const auto columns = static_cast<Index>(this->window.document()->handles().size());
  Weights weights = Weights::Zero(rest.view().rows(), columns);
  const double low = rest.view().col(1).minCoeff();
  const double high = rest.view().col(1).maxCoeff();
  weights.col(1) = (rest.view().col(1).array() - low) / (high - low);
  weights.col(0) = 1.0 - weights.col(1).array();
  ASSERT_TRUE(this->window.document()->set_weights(weights, "heights").ok());
  this->part<app::window::PanelColumn>()->show_panel(app::window::PanelColumn::weights);
  this->resize({ 1000, 700 });
  this->choose("weights.column", 2);
  this->part<app::view::Viewport>()->handle_widget()->SetEnabled(false);
  for (const double opacity : { 0.0, 0.6, 1.0 })
  {
    this->choose("weights.over_picture", opacity);
    this->choose("weights.isolines", true);
    const QImage with = this->picture();
    if (const char* folder = std::getenv("BINDPOSE_PICTURES"))
    {
      EXPECT_TRUE(with.save(QString(folder) + QString("/over_%1.png").arg(opacity)));
    }
    this->choose("weights.isolines", false);
    const QImage without = this->picture();
    EXPECT_GT(count(with, [](const QColor& c) { return c.lightness() < 60; }),
      count(without, [](const QColor& c) { return c.lightness() < 60; }) + 200)
      << opacity;
  }
}
