// Shows the distances between the shapes of two methods as colors. For every pose the distances are
// written into the array that is already drawn. The cost is one vector norm per point.
#include "app/posing/distance_view.h"

#include "app/posing/posing.h"
#include "app/view/viewport.h"

#include "scene/colors.h"

#include <QCoreApplication>

#include <algorithm>
#include <cmath>

namespace app::posing
{

using namespace bindpose;

double distance_scale(double largest)
{
  constexpr double minimum = 0.01;
  const double value = std::max(largest, minimum);
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  constexpr double round_off = 1e-9;
  for (const double factor : { 1.0, 2.0, 5.0 })
  {
    if (factor * power >= value * (1.0 - round_off))
    {
      return factor * power;
    }
  }
  return 10.0 * power;
}

DistanceView::DistanceView(view::Viewport* viewport, PoseController* posing)
  : QObject(viewport), viewport_(viewport), posing_(posing)
{
}

void DistanceView::set_active(bool active)
{
  this->active_ = active;
  this->update();
}

void DistanceView::update()
{
  const Points& points = this->posing_->points();
  const Points& other = this->posing_->compared_deformation()->points();
  if (!this->active_ || this->posing_->ghost()->display_mode() != PoseGhost::in_colors ||
    this->posing_->shows_rest() || this->posing_->compared_deformation()->is_binding() ||
    points.rows() == 0 || points.rows() != other.rows() || !this->viewport_->drawn() ||
    points.rows() != this->posing_->surface()->GetNumberOfPoints())
  {
    if (this->viewport_->shows_values(this->values_))
    {
      this->viewport_->show_values(nullptr, true);
    }
    this->values_ = nullptr;
    return;
  }
  const double percent = 100.0 / this->posing_->rest_diagonal();
  const Eigen::VectorXd distances = percent * (points - other).rowwise().norm();
  const double scale = distance_scale(distances.maxCoeff());
  const std::vector<Index>& drawn = this->viewport_->drawn_points();
  const bool is_new_array = !this->viewport_->shows_values(this->values_) || this->scale_ != scale;
  if (is_new_array)
  {
    this->values_ = vtkSmartPointer<vtkDoubleArray>::New();
    this->values_->SetNumberOfValues(static_cast<vtkIdType>(drawn.size()));
  }
  double* value = this->values_->GetPointer(0);
  for (const Index point : drawn)
  {
    *value++ = distances[point];
  }
  this->values_->Modified();
  if (is_new_array)
  {
    this->scale_ = scale;
    this->viewport_->show_values(this->values_, true,
      QCoreApplication::translate("DistanceView", "Distance (% of diagonal)"),
      sequential_map(0.0, scale, 0));
  }
}

} // namespace app::posing
