// Constraints of handles at mesh points. The mesh points of all handles are found once; the
// constraints are selected again whenever the modes of the handles change.
#include "arap/mesh_grips.h"

#include "base/number_text.h"
#include "geometry/simplex_locator.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace bindpose
{

namespace
{
/// A handle constrains a vertex if their distance is at most this, in bounding-box diagonals.
constexpr double vertex_tolerance = 1e-9;
/// A handle is on the mesh if its distance is at most this, in bounding-box diagonals.
constexpr double on_mesh = 1e-6;
/// A point in an element is replaced by a vertex of the element if the barycentric coordinate of
/// the point at this vertex is at least this value.
constexpr double vertex_coordinate = 1.0 - 1e-9;
/// Maximum number of intervals between the constrained points of a bone that has no vertices.
constexpr double maximum_intervals = 16.0;

MeshPoint vertex_point(Index v)
{
  return { { v, 1.0 } };
}

} // namespace

template <typename Elements>
Status MeshGrips::find_any(PointsView points, const Elements& elements, const Components& parts,
  const Handles& handles, const std::vector<Index>& region_ids)
{
  *this = MeshGrips();
  Status status = check_regions(handles, region_ids, points.rows());
  if (!status.ok())
  {
    return status;
  }
  this->handles_ = handles;
  this->rest_ = points;
  Box box;
  for (Index v = 0; v < points.rows(); ++v)
  {
    if (parts.component_of_vertex[v] >= 0)
    {
      box.add(points.row(v).transpose());
    }
  }
  this->diagonal_ = box.diagonal();
  const SimplexLocator locator(this->rest_, elements);
  double mean_edge_length = 0.0;
  for (Index e = 0; e < elements.rows(); ++e)
  {
    mean_edge_length += (this->rest_.row(elements(e, 0)) - this->rest_.row(elements(e, 1))).norm();
  }
  mean_edge_length /= static_cast<double>(elements.rows());

  double largest_distance = 0.0;
  std::vector<Index> distant_handles;
  const auto point_at = [&](const Vec3& p, double& distance) -> MeshPoint
  {
    Index nearest = -1;
    double minimum = vertex_tolerance * this->diagonal_;
    for (Index v = 0; v < this->rest_.rows(); ++v)
    {
      const double length = (this->rest_.row(v) - p.transpose()).norm();
      if (length <= minimum && parts.component_of_vertex[v] >= 0)
      {
        minimum = length;
        nearest = v;
      }
    }
    if (nearest >= 0)
    {
      return vertex_point(nearest);
    }
    const SimplexLocation found = locator.locate(p);
    distance = std::max(distance, found.distance);
    MeshPoint point;
    double sum = 0.0;
    for (Index k = 0; k < elements.cols(); ++k)
    {
      const double coordinate = found.barycentric[k];
      if (coordinate >= vertex_coordinate)
      {
        return vertex_point(elements(found.element, k));
      }
      if (coordinate > 1.0 - vertex_coordinate)
      {
        point.emplace_back(elements(found.element, k), coordinate);
        sum += coordinate;
      }
    }
    for (auto& term : point)
    {
      term.second /= sum;
    }
    return point;
  };

  for (const Handle& handle : this->handles_)
  {
    Grip grip;
    double distance = 0.0;
    if (handle.kind == HandleKind::region)
    {
      for (Index v = 0; v < this->rest_.rows(); ++v)
      {
        if (region_ids[v] == handle.region_id && parts.component_of_vertex[v] >= 0)
        {
          grip.points.push_back(vertex_point(v));
        }
      }
      if (grip.points.empty())
      {
        return Status::invalid_input("region '" + handle.name +
          "' constrains no vertex because the vertices with its label are not part of any element");
      }
      for (const MeshPoint& point : grip.points)
      {
        grip.pivot.emplace_back(point[0].first, 1.0 / static_cast<double>(grip.points.size()));
      }
    }
    else
    {
      grip.pivot = point_at(handle.head, distance);
      if (handle.kind == HandleKind::bone)
      {
        grip.tail = point_at(handle.tail, distance);
        for (Index v = 0; v < this->rest_.rows(); ++v)
        {
          if (parts.component_of_vertex[v] >= 0 &&
            nearest_in_triangle(this->rest_.row(v), handle.head, handle.tail, handle.tail)
                .distance <= vertex_tolerance * this->diagonal_)
          {
            grip.points.push_back(vertex_point(v));
          }
        }
        const double length = (handle.tail - handle.head).norm();
        const double intervals =
          std::clamp(std::ceil(length / mean_edge_length), 1.0, maximum_intervals);
        const bool needs_samples = grip.points.size() < 2;
        for (double k = 0.0; needs_samples && k <= intervals; k += 1.0)
        {
          grip.points.push_back(
            point_at(handle.head + k / intervals * (handle.tail - handle.head), distance));
        }
      }
      else
      {
        grip.points.push_back(grip.pivot);
      }
    }
    if (distance > on_mesh * this->diagonal_)
    {
      largest_distance = std::max(largest_distance, distance);
      distant_handles.push_back(static_cast<Index>(this->grips_.size()));
    }
    this->grips_.push_back(std::move(grip));
  }
  if (!distant_handles.empty())
  {
    status.warnings.push_back("these handles are up to " +
      short_number(largest_distance / this->diagonal_) +
      " bounding-box diagonals away from the mesh and constrain its nearest points: " +
      quoted_names(this->handles_, distant_handles));
  }
  return status;
}

Status MeshGrips::find(PointsView points, TrianglesView elements, const Components& parts,
  const Handles& handles, const std::vector<Index>& region_ids)
{
  return this->find_any(points, elements, parts, handles, region_ids);
}

Status MeshGrips::find(PointsView points, TetsView elements, const Components& parts,
  const Handles& handles, const std::vector<Index>& region_ids)
{
  return this->find_any(points, elements, parts, handles, region_ids);
}

Vec3 MeshGrips::rest_position(const MeshPoint& point) const
{
  Vec3 sum = Vec3::Zero();
  for (const auto& [v, coordinate] : point)
  {
    sum += coordinate * this->rest_.row(v).transpose();
  }
  return sum;
}

/// Return the target displacement of a constrained point. The points of a handle in mode full are
/// moved by its transform. In the other modes, the point gets the displacement of the pivot or tail
/// itself, even if the pivot or tail is off the mesh.
Vec3 MeshGrips::target_displacement(const Constraint& constraint, const HandlePose& pose) const
{
  const Eigen::Matrix3d linear = pose.transform.leftCols<3>() - Eigen::Matrix3d::Identity();
  const Handle& handle = this->handles_[constraint.handle];
  if (constraint.tail)
  {
    return posed_tail(handle, pose) - handle.tail;
  }
  const bool uses_pivot = constrains_pivot(pose.mode) && handle.kind != HandleKind::region;
  return linear * (uses_pivot ? handle.head : this->rest_position(constraint.point)) +
    pose.transform.col(3);
}

void MeshGrips::choose(const Pose& pose, const std::vector<Index>& fixed_vertices)
{
  this->constraints_.clear();
  this->redundant_handles_.clear();
  this->prescribed_.clear();
  this->constrained_.clear();
  this->handle_of_constrained_.clear();
  for (const bool full : { true, false })
  {
    for (std::size_t h = 0; h < pose.size(); ++h)
    {
      const auto handle = static_cast<Index>(h);
      if (full != constrains_transform(pose[h].mode))
      {
        continue;
      }
      for (std::size_t k = 0; full && k < this->grips_[h].points.size(); ++k)
      {
        this->constraints_.push_back({ handle, this->grips_[h].points[k] });
      }
      if (constrains_pivot(pose[h].mode))
      {
        this->constraints_.push_back({ handle, this->grips_[h].pivot });
      }
      if (constrains_tail(pose[h].mode))
      {
        this->constraints_.push_back({ handle, this->grips_[h].tail, -1, -1, true });
      }
    }
  }
  // A position handle is redundant if a handle in mode full constrains the same vertex. If several
  // position handles are at one vertex, all except the first are reported as redundant, but the
  // target is the mean of all their targets.
  std::map<Index, bool> prescribed; // vertex -> whether a handle in mode full constrains it
  for (const Constraint& constraint : this->constraints_)
  {
    if (constraint.point.size() == 1)
    {
      prescribed.insert(
        { constraint.point[0].first, constrains_transform(pose[constraint.handle].mode) });
    }
  }
  for (const Index v : fixed_vertices)
  {
    prescribed.insert({ v, false });
  }
  std::map<Index, Index> index_of_vertex;
  for (const auto& entry : prescribed)
  {
    index_of_vertex[entry.first] = static_cast<Index>(this->prescribed_.size());
    this->prescribed_.push_back(entry.first);
  }
  std::vector<char> is_claimed(this->prescribed_.size(), 0);
  for (Constraint& constraint : this->constraints_)
  {
    const bool full = constrains_transform(pose[constraint.handle].mode);
    if (constraint.point.size() > 1)
    {
      constraint.constrained = static_cast<Index>(this->constrained_.size());
      this->constrained_.push_back(constraint.point);
      this->handle_of_constrained_.push_back(constraint.handle);
    }
    else
    {
      const Index v = constraint.point[0].first;
      if (full || !prescribed[v])
      {
        constraint.prescribed = index_of_vertex[v];
      }
      if (!full && is_claimed[index_of_vertex[v]])
      {
        this->redundant_handles_.push_back(constraint.handle);
      }
      is_claimed[index_of_vertex[v]] = 1;
    }
  }
}

void MeshGrips::targets(const Pose& pose, Rows& prescribed, Rows& constrained) const
{
  prescribed = Rows::Zero(static_cast<Index>(this->prescribed_.size()), 3);
  constrained = Rows::Zero(static_cast<Index>(this->constrained_.size()), 3);
  Eigen::VectorXd handle_counts = Eigen::VectorXd::Zero(prescribed.rows());
  for (const Constraint& constraint : this->constraints_)
  {
    const Vec3 move = this->target_displacement(constraint, pose[constraint.handle]);
    if (constraint.prescribed >= 0)
    {
      // Update the mean incrementally. If all handles have the same target, the result is exact to
      // the bit.
      handle_counts[constraint.prescribed] += 1.0;
      prescribed.row(constraint.prescribed) +=
        (move.transpose() - prescribed.row(constraint.prescribed)) /
        handle_counts[constraint.prescribed];
    }
    else if (constraint.constrained >= 0)
    {
      constrained.row(constraint.constrained) = move.transpose();
    }
  }
}

std::vector<std::string> MeshGrips::redundancy(
  const Pose& pose, const std::vector<Index>& points) const
{
  std::vector<Index> redundant = this->redundant_handles_;
  for (const Index point : points)
  {
    const Index handle = this->handle_of_constrained_[point];
    if (!constrains_transform(pose[handle].mode))
    {
      redundant.push_back(handle);
    }
  }
  if (redundant.empty())
  {
    return {};
  }
  return {
    "the position constraints of these handles are redundant (other constraints determine them): " +
    quoted_names(this->handles_, redundant)
  };
}

double MeshGrips::residual(
  const Pose& pose, const Rows& displacements, std::vector<std::string>& warnings) const
{
  double residual = 0.0;
  std::vector<Index> contradicting;
  for (const Constraint& constraint : this->constraints_)
  {
    Vec3 violation = this->target_displacement(constraint, pose[constraint.handle]);
    for (const auto& [v, coordinate] : constraint.point)
    {
      violation -= coordinate * displacements.row(v).transpose();
    }
    const double length = violation.norm() / std::max(this->diagonal_, 1e-300);
    residual = std::max(residual, length);
    if (length > contradiction_tolerance &&
      (contradicting.empty() || contradicting.back() != constraint.handle))
    {
      contradicting.push_back(constraint.handle);
    }
  }
  if (!contradicting.empty())
  {
    warnings.push_back("these handles have contradictory constraints, with a largest error of " +
      std::to_string(residual * this->diagonal_) + ": " +
      quoted_names(this->handles_, contradicting));
  }
  return residual;
}

} // namespace bindpose
