// Two methods side by side. Each shape fits its half of the view, and one camera is used for both
// halves. The handles belong to the left half.
#include "window_test.h"

#include "app/handles/handle_editing.h"
#include "app/handles/side_panel.h"
#include "app/posing/pose_ghost.h"
#include "app/posing/pose_panel.h"
#include "app/posing/posing.h"
#include "document/document.h"

#include "weights_arrays.h"

#include "support/meshes.h"

#include "vtkCamera.h"
#include "vtkDoubleArray.h"
#include "vtkHandleSetRepresentation.h"
#include "vtkHandleSetWidget.h"
#include "vtkPointData.h"

#include <QUndoStack>

#include <cmath>

using namespace bindpose;

namespace
{
class SplitWindow : public test::WindowTest
{
protected:
  /// Open an ellipsoid that is long along x, with a point handle at each end.
  void SetUp() override
  {
    this->resize({ 1100, 700 });
    Handles handles(2);
    handles[0].name = "left";
    handles[0].head = handles[0].tail = Vec3(-1.8, 0, 0);
    handles[1].name = "right";
    handles[1].head = handles[1].tail = Vec3(1.8, 0, 0);
    TriangleMesh mesh = test::sphere(3);
    Weights weights(mesh.points.rows(), 2);
    weights.col(1) = 0.5 * (1.0 + mesh.points.col(0).array()).matrix();
    weights.col(0) = 1.0 - weights.col(1).array();
    mesh.points.col(0) *= 2.0;
    mesh.points.col(1) *= 0.5;
    mesh.points.col(2) *= 0.5;
    const auto data = to_polydata(mesh.points, mesh.triangles);
    data->GetPointData()->AddArray(to_weights_array("Weights", weights, handles));
    ASSERT_TRUE(this->window.set_mesh(data, "cigar"));
    ASSERT_TRUE(this->window.set_handles(to_polydata(handles), "handles"));
    ASSERT_TRUE(this->window.is_bound());
    this->render();
  }

  app::posing::PoseController* posing() { return this->part<app::posing::PoseController>(); }
  vtkRenderer* left() { return this->part<app::view::Viewport>()->renderer(); }
  vtkRenderer* right() { return this->posing()->ghost()->renderer(); }
  vtkCamera* camera() { return this->left()->GetActiveCamera(); }
  void choose(const char* option, int value)
  {
    ASSERT_EQ(this->user.choose(option, value), QString()) << option;
    this->render();
  }
  void compare()
  {
    this->choose("pose.compared", 1 + static_cast<int>(PoseMethod::dual_quaternion));
  }
  void beside() { this->choose("pose.ghost", 1); }

  /// Return the largest absolute coordinate of the shape in the view of a renderer. The view
  /// extends from -1 to 1.
  static double extent(vtkRenderer* renderer, PointsView points)
  {
    double largest = 0.0;
    for (Index v = 0; v < points.rows(); ++v)
    {
      renderer->SetWorldPoint(points(v, 0), points(v, 1), points(v, 2), 1.0);
      renderer->WorldToView();
      const double* view = renderer->GetViewPoint();
      largest = std::max({ largest, std::abs(view[0]), std::abs(view[1]) });
    }
    return largest;
  }
  double extent_left() { return extent(this->left(), to_points(this->window.shown()).view()); }
  double extent_right()
  {
    return extent(this->right(), this->posing()->compared_deformation()->points());
  }
  /// Expect that both shapes are within their halves and fill them.
  void expect_both_in_view(const char* when)
  {
    const double first = this->extent_left();
    const double second = this->extent_right();
    EXPECT_LT(std::max(first, second), 1.0) << when;
    EXPECT_GT(std::max(first, second), 0.65) << when;
    EXPECT_EQ(this->right()->GetActiveCamera(), this->camera()) << when;
    // The clipping planes of the camera clip neither shape.
    double range[2];
    this->camera()->GetClippingRange(range);
    const Vec3 eye(this->camera()->GetPosition());
    const Vec3 view_direction(this->camera()->GetDirectionOfProjection());
    for (const Points& points : { Points(to_points(this->window.shown()).view()),
           this->posing()->compared_deformation()->points() })
    {
      const Eigen::VectorXd depths = (points.rowwise() - eye.transpose()) * view_direction;
      EXPECT_GT(depths.minCoeff(), range[0]) << when;
      EXPECT_LT(depths.maxCoeff(), range[1]) << when;
    }
  }
  /// Count the pixels between the columns `from` and `to` that differ from the background. The
  /// columns are fractions of the width.
  int drawn(double from, double to)
  {
    const QImage image = this->picture();
    int count = 0;
    for (int y = 0; y < image.height() - 60; ++y) // exclude the names at the bottom of the view
    {
      const QColor empty = image.pixelColor(1, y);
      for (int x = static_cast<int>(from * image.width()); x < to * image.width(); ++x)
      {
        count += std::abs(image.pixelColor(x, y).blue() - empty.blue()) > 12;
      }
    }
    return count;
  }

  app::tour::SimulatedUser user{ &this->window };
};
} // namespace

TEST_F(SplitWindow, EachShapeFitsIntoItsHalf)
{
  const double whole = this->extent_left();
  ASSERT_GT(whole, 0.6);
  const Vec3 before(this->camera()->GetPosition());
  const Vec3 view_direction(this->camera()->GetDirectionOfProjection());
  this->compare();
  this->beside();
  ASSERT_TRUE(this->part<app::view::Viewport>()->is_split());
  this->expect_both_in_view("beside");
  EXPECT_NEAR(this->extent_left(), whole, 0.12) << "as much of the half as of the whole";
  EXPECT_LT((Vec3(this->camera()->GetDirectionOfProjection()) - view_direction).norm(), 1e-9);
  // No pixel at the border between the halves is covered, and both shapes have the same size.
  EXPECT_EQ(this->drawn(0.498, 0.502), 0);
  const int left = this->drawn(0.0, 0.5);
  const int right = this->drawn(0.5, 1.0);
  EXPECT_GT(left, 2000);
  EXPECT_NEAR(left, right, 0.15 * left); // the handles cover a part of the left shape
  // After the comparison ends, the view is as before.
  this->user.trigger("edit.undo");
  this->render();
  EXPECT_FALSE(this->part<app::view::Viewport>()->is_split());
  EXPECT_LT((Vec3(this->camera()->GetPosition()) - before).norm(), 1e-6);
  this->user.trigger("edit.redo");
  this->render();
  EXPECT_TRUE(this->part<app::view::Viewport>()->is_split());
  this->expect_both_in_view("redo");
}

TEST_F(SplitWindow, AnotherSizeAndAnotherViewKeepBothInTheirHalves)
{
  this->compare();
  this->beside();
  for (const QSize& size : { QSize(900, 740), QSize(1270, 640), QSize(1100, 700) })
  {
    this->resize(size);
    this->expect_both_in_view("resized");
  }
  // Rotating the view in the right half rotates both halves.
  const Vec3 view_direction(this->camera()->GetDirectionOfProjection());
  this->drag(this->user.pixel_of_fractions(0.9, 0.1), this->user.pixel_of_fractions(0.8, 0.15));
  EXPECT_GT((Vec3(this->camera()->GetDirectionOfProjection()) - view_direction).norm(), 0.05);
  EXPECT_EQ(this->right()->GetActiveCamera(), this->camera());
  this->user.press_key("Home");
  this->render();
  this->expect_both_in_view("home");
  // If a pose moves a shape out of its half, the key Home fits the view to the shape again.
  Pose pose(2);
  pose[1].transform.col(3) = Vec3(1.5, 0, 3.0);
  this->window.document()->set_pose(pose, "far");
  this->user.press_key("Home");
  this->render();
  this->expect_both_in_view("far");
}

TEST_F(SplitWindow, AZoomStaysAndAShiftedShapeComesBack)
{
  // If the view shows an enlarged detail, the halves also show this detail after the view is split.
  this->compare();
  this->camera()->Dolly(3.0);
  const double detail = this->extent_left();
  this->beside();
  EXPECT_GT(this->extent_left(), 0.6 * detail);
  this->choose("pose.ghost", 0);
  EXPECT_NEAR(this->extent_left(), detail, 1e-6 * detail);
  // A shape that is completely visible but not centered is still completely visible after the view
  // is split.
  this->part<app::view::Viewport>()->reset_view();
  this->camera()->Dolly(0.5);
  vtkCamera* camera = this->camera();
  const Vec3 right = Vec3(camera->GetDirectionOfProjection()).cross(Vec3(camera->GetViewUp()));
  const Vec3 offset = -0.2 * camera->GetDistance() * right;
  camera->SetFocalPoint((Vec3(camera->GetFocalPoint()) + offset).eval().data());
  camera->SetPosition((Vec3(camera->GetPosition()) + offset).eval().data());
  ASSERT_LT(this->extent_left(), 1.0);
  this->beside();
  EXPECT_LT(this->extent_left(), 1.0);
  EXPECT_LT(this->extent_right(), 1.0);
}

TEST_F(SplitWindow, HandlesAreTakenHoldOfInTheLeftHalfAlone)
{
  this->compare();
  this->beside();
  QPoint position;
  ASSERT_EQ(this->user.find_handle_position("right", 0.0, position), QString());
  const int half = this->part<app::view::Viewport>()->width() / 2;
  ASSERT_LT(position.x(), half);
  auto* drawn = this->part<app::view::Viewport>()->handle_widget()->GetHandleSetRepresentation();
  // At the same position in the right half there is no handle.
  this->hover(position + QPoint(half, 0));
  EXPECT_LT(drawn->GetHoveredHandle(), 0);
  // Show the rest shape and the pose again while the mouse is in the right half. Handles must still
  // be picked in the left half.
  this->user.press_key("T");
  this->user.press_key("T");
  this->render();
  this->hover(position);
  ASSERT_GE(drawn->GetHoveredHandle(), 0);
  const Points before = this->posing()->compared_deformation()->points();
  const int steps = this->window.document()->history()->index();
  this->drag(position, position + QPoint(-20, -60));
  EXPECT_EQ(this->window.document()->history()->undoText(), "move right");
  EXPECT_EQ(this->window.document()->history()->index(), steps + 1);
  QPoint new_position;
  ASSERT_EQ(this->user.find_handle_position("right", 0.0, new_position), QString());
  EXPECT_NEAR(new_position.x(), position.x() - 20, 2);
  EXPECT_NEAR(new_position.y(), position.y() - 60, 2);
  EXPECT_GT((this->posing()->compared_deformation()->points() - before).cwiseAbs().maxCoeff(), 0.1)
    << "the other method has the same pose";
  // A handle beyond the border is not drawn in the other half, so it cannot be picked there.
  this->camera()->Dolly(2.0);
  this->left()->ResetCameraClippingRange();
  this->render();
  ASSERT_EQ(this->user.find_handle_position("right", 0.0, new_position), QString());
  ASSERT_GT(new_position.x(), half);
  this->hover(new_position);
  EXPECT_LT(drawn->GetHoveredHandle(), 0);
}
