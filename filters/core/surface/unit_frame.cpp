// Scaling to a standard size (see unit_frame.h).
#include "surface/unit_frame.h"

#include <cmath>

namespace bindpose
{

UnitFrame::UnitFrame(const Box& box)
  : center_(box.center()), scale_(std::exp2(-std::floor(std::log2(box.diagonal()))))
{
}

Points UnitFrame::to_frame(PointsView points) const
{
  return (points.rowwise() - this->center_.transpose()) * this->scale_;
}

Points UnitFrame::from_frame(PointsView points) const
{
  return (points / this->scale_).rowwise() + this->center_.transpose();
}

Status check_frame(PointsView points, TrianglesView triangles)
{
  Status status = check_mesh(points, triangles);
  if (!status.ok())
  {
    return status;
  }
  if (triangles.rows() == 0)
  {
    return Status::invalid_input("the surface has no triangles");
  }
  const double diagonal = bounding_box(points, triangles).diagonal();
  if (!(diagonal > 0.0))
  {
    return Status::invalid_input("all points of the surface coincide");
  }
  constexpr double largest = 1e100;
  if (!(diagonal < largest))
  {
    return Status::invalid_input("the surface must be at most 1e100 long in each direction");
  }
  return {};
}

} // namespace bindpose
