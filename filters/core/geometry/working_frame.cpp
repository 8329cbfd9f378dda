// Frames for extreme coordinates (see working_frame.h).
#include "geometry/working_frame.h"

#include "base/number_text.h"

#include <cmath>

namespace bindpose
{

namespace
{
constexpr double smallest_diagonal = 1e-102;
constexpr double largest_diagonal = 1e102;
constexpr int maximum_unscaled_exponent = 100; // binary exponent of the bounding-box diagonal
constexpr double maximum_unmoved_distance = 1024.0; // from the origin, in bounding-box diagonals
constexpr double maximum_spacing = 1e-6; // distance of adjacent doubles, in bounding-box diagonals

/// Return a clause for messages, such as "coordinate x of point 17 is 1e+300". The clause names the
/// coordinate of the box's corners that is farthest from 0.
std::string farthest_coordinate(PointsView points, const Box& box)
{
  const Vec3 distances = box.lower.cwiseAbs().cwiseMax(box.upper.cwiseAbs());
  Index axis = 0;
  distances.maxCoeff(&axis);
  Index id = 0;
  while (id + 1 < points.rows() && std::abs(points(id, axis)) != distances[axis])
  {
    ++id;
  }
  return std::string("coordinate ") + "xyz"[axis] + " of point " + std::to_string(id) + " is " +
    short_number(points(id, axis));
}
} // namespace

Status WorkingFrame::choose(
  PointsView points, const Box& box, const std::string& subject, WorkingFrame& frame)
{
  frame = WorkingFrame();
  // Compute with half of the size and with quotients, because the size and its squares can
  // overflow.
  const Vec3 half_size = 0.5 * box.upper - 0.5 * box.lower;
  const double half_side = box.empty() ? 0.0 : half_size.maxCoeff();
  if (half_side == 0.0)
  {
    return {};
  }
  const double diagonal = 2.0 * half_side * (half_size / half_side).norm();
  if (!(diagonal <= largest_diagonal && diagonal >= smallest_diagonal))
  {
    return Status::invalid_input("the bounding-box diagonal of " + subject + " is " +
      short_number(diagonal) + "; expected 1e-102 to 1e102 (" + farthest_coordinate(points, box) +
      ")");
  }
  const double distance = box.lower.cwiseAbs().cwiseMax(box.upper.cwiseAbs()).maxCoeff();
  const double spacing = std::nextafter(distance, 2.0 * distance) - distance;
  if (spacing > maximum_spacing * diagonal)
  {
    return Status::invalid_input(subject + " is too far from the origin: " +
      farthest_coordinate(points, box) + ", where doubles are " + short_number(spacing) +
      " apart; expected at most 1e-6 of the diagonal " + short_number(diagonal));
  }
  const int exponent = std::ilogb(diagonal);
  if (std::abs(exponent) > maximum_unscaled_exponent)
  {
    frame.scale_ = std::ldexp(1.0, -exponent);
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    const double middle = 0.5 * (box.lower[axis] + box.upper[axis]);
    if (std::abs(middle) > maximum_unmoved_distance * diagonal)
    {
      frame.center_[axis] = middle;
    }
  }
  if (!frame.center_.isZero(0.0))
  {
    frame.scale_ = std::ldexp(1.0, -exponent);
  }
  return {};
}

namespace
{
template <typename Elements>
Status choose_for_mesh(
  PointsView points, const Elements& elements, const std::string& subject, WorkingFrame& frame)
{
  frame = WorkingFrame();
  const Status status = check_mesh(points, elements);
  if (!status.ok())
  {
    return status;
  }
  Box box;
  for (Index k = 0; k < elements.size(); ++k)
  {
    box.add(points.row(elements.data()[k]));
  }
  return WorkingFrame::choose(points, box, subject, frame);
}
} // namespace

Status WorkingFrame::choose(
  PointsView points, TrianglesView triangles, const std::string& subject, WorkingFrame& frame)
{
  return choose_for_mesh(points, triangles, subject, frame);
}

Status WorkingFrame::choose(
  PointsView points, TetsView tets, const std::string& subject, WorkingFrame& frame)
{
  return choose_for_mesh(points, tets, subject, frame);
}

Points WorkingFrame::to_frame(PointsView points) const
{
  if (this->is_identity())
  {
    return points;
  }
  return (points.rowwise() - this->center_.transpose()) * this->scale_;
}

Points WorkingFrame::from_frame(PointsView points) const
{
  if (this->is_identity())
  {
    return points; // adding a center of 0 would change -0 to +0
  }
  return (points / this->scale_).rowwise() + this->center_.transpose();
}

double WorkingFrame::size_to_frame(double size, int power) const
{
  return size * std::pow(this->scale_, power);
}

double WorkingFrame::size_from_frame(double size, int power) const
{
  return size / std::pow(this->scale_, power);
}

void WorkingFrame::convert_report(Report& report, const std::string& key, int power) const
{
  const Report::Value* entry = report.find(key);
  if (!entry)
  {
    return;
  }
  Report::Value value = *entry;
  if (auto* number = std::get_if<double>(&value))
  {
    *number = this->size_from_frame(*number, power);
  }
  else if (auto* numbers = std::get_if<std::vector<double>>(&value))
  {
    for (double& each : *numbers)
    {
      each = this->size_from_frame(each, power);
    }
  }
  report.set(key, std::move(value));
}

} // namespace bindpose
