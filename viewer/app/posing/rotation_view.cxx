// Shows the rotations of as-rigid-as-possible methods as colors. The colors of clusters change only
// with the next bind. The angles change with every pose: they are written into the array that is
// already drawn, with one look-up per point.
#include "app/posing/rotation_view.h"

#include "app/posing/pose_panel.h"
#include "app/posing/posing.h"
#include "app/view/viewport.h"

#include "pose/transform_parts.h"
#include "scene/coloring.h"
#include "scene/rotation_colors.h"

#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>

namespace app::posing
{

using namespace bindpose;

RotationView::RotationView(view::Viewport* viewport, const PosePanel* panel, PoseController* posing)
  : QObject(viewport), viewport_(viewport), panel_(panel), posing_(posing)
{
}

void RotationView::set_active(bool active)
{
  this->active_ = active;
  this->update();
}

void RotationView::update()
{
  // Show no rotations while DistanceView shows the distances between two methods.
  const bool may_color =
    this->active_ && this->posing_->ghost()->display_mode() != PoseGhost::in_colors;
  const PosePanel::RotationDisplay requested =
    may_color ? this->panel_->shown_rotations() : PosePanel::no_rotations;
  const PoseRotations* found = requested ? this->posing_->rotations() : nullptr;
  if (!found || !this->viewport_->drawn() ||
    static_cast<Index>(found->cluster_of_point->size()) != this->posing_->points().rows())
  {
    if (this->viewport_->shows_values(this->values_))
    {
      this->viewport_->show_values(nullptr, true);
    }
    this->values_ = nullptr;
    return;
  }
  this->axis_angles_.clear();
  for (const Eigen::Matrix3d& rotation : found->rotations)
  {
    this->axis_angles_.push_back(
      this->posing_->shows_rest() ? Vec3::Zero().eval() : rotation_vector(rotation));
  }
  if (!this->viewport_->shows_values(this->values_) ||
    this->cluster_of_point_ != found->cluster_of_point)
  {
    this->values_ = nullptr; // another surface was set, or other values were shown meanwhile
    this->cluster_of_point_ = found->cluster_of_point;
  }
  if (requested == PosePanel::clusters)
  {
    this->show_clusters(*found);
  }
  else
  {
    this->show_angles(*found);
  }
}

void RotationView::show_clusters(const PoseRotations& found)
{
  if (this->values_ && this->scale_ == 0.0)
  {
    return;
  }
  vtkNew<vtkPolyData> drawn;
  drawn->CopyStructure(this->viewport_->drawn());
  vtkNew<vtkIntArray> clusters;
  clusters->SetName("RotationCluster");
  for (const Index point : this->viewport_->drawn_points())
  {
    clusters->InsertNextValue(
      static_cast<int>((*found.cluster_of_point)[static_cast<std::size_t>(point)]));
  }
  drawn->GetPointData()->AddArray(clusters);
  PictureOptions options;
  options.color_by = ColorBy::rotation_cluster;
  Coloring coloring;
  if (choose_coloring({ { drawn.Get(), nullptr, "" } }, options, coloring).ok())
  {
    bool on_points = false;
    this->scale_ = 0.0;
    this->values_ = color_values(drawn, coloring, on_points);
    this->viewport_->show_values(
      this->values_, on_points, QString::fromStdString(coloring.legend_name()), coloring.map);
  }
}

void RotationView::show_angles(const PoseRotations& found)
{
  std::vector<double> degrees;
  for (const Vec3& axis_angle : this->axis_angles_)
  {
    degrees.push_back(axis_angle.norm());
  }
  const double scale =
    angle_scale(degrees.empty() ? 0.0 : *std::max_element(degrees.begin(), degrees.end()));
  const bool is_new_array = !this->values_ || this->scale_ != scale;
  const std::vector<Index>& points = this->viewport_->drawn_points();
  if (is_new_array)
  {
    this->values_ = vtkSmartPointer<vtkDoubleArray>::New();
    this->values_->SetNumberOfValues(static_cast<vtkIdType>(points.size()));
  }
  double* value = this->values_->GetPointer(0);
  for (const Index point : points)
  {
    const Index cluster = (*found.cluster_of_point)[static_cast<std::size_t>(point)];
    *value++ = cluster < 0 ? 0.0 : degrees[static_cast<std::size_t>(cluster)];
  }
  this->values_->Modified();
  if (is_new_array)
  {
    Coloring rotation_coloring;
    rotation_coloring.by = ColorBy::rotation;
    this->scale_ = scale;
    this->viewport_->show_values(this->values_, true,
      QString::fromStdString(rotation_coloring.legend_name()), sequential_map(0.0, scale, 0));
  }
}

QString RotationView::reading(Index point) const
{
  if (!this->viewport_->shows_values(this->values_) ||
    point >= static_cast<Index>(this->cluster_of_point_->size()))
  {
    return {};
  }
  const Index cluster = (*this->cluster_of_point_)[static_cast<std::size_t>(point)];
  if (cluster < 0)
  {
    return PoseController::tr("No rotation cluster");
  }
  const Vec3& axis_angle = this->axis_angles_[static_cast<std::size_t>(cluster)];
  const double degrees = axis_angle.norm();
  // Smaller angles would be displayed as 0.0, so they are omitted.
  constexpr double minimum_angle = 0.05;
  const Vec3 axis = axis_angle.normalized();
  const auto number = [](double x) { return QString::number(x, 'f', 2); };
  return PoseController::tr("Rotation cluster %1 of %2: %3°%4")
    .arg(cluster)
    .arg(this->axis_angles_.size())
    .arg(degrees, 0, 'f', 1)
    .arg(degrees < minimum_angle ? QString()
                                 : PoseController::tr(" about %1, %2, %3")
                                     .arg(number(axis.x()), number(axis.y()), number(axis.z())));
}

} // namespace app::posing
