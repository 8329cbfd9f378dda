// Constraints of handles at mesh points. The mesh points of all handles are found once; the
// constraints are selected again whenever the modes of the handles change.
#include "arap/mesh_grips.h"

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
/// A mesh point is treated as a vertex if its barycentric weight at the vertex is at least this.
constexpr double whole = 1.0 - 1e-9;
/// Maximum number of intervals between the constrained points of a bone that has no vertices.
constexpr double most_places = 16.0;

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
    if (parts.of_vertex[v] >= 0)
    {
      box.add(points.row(v).transpose());
    }
  }
  this->diagonal_ = box.diagonal();
  const SimplexLocator locator(this->rest_, elements);
  double edge = 0.0;
  for (Index e = 0; e < elements.rows(); ++e)
  {
    edge += (this->rest_.row(elements(e, 0)) - this->rest_.row(elements(e, 1))).norm();
  }
  edge /= static_cast<double>(elements.rows());

  double farthest = 0.0;
  std::vector<Index> beside;
  const auto point_at = [&](const Vec3& p, double& distance) -> MeshPoint
  {
    Index nearest = -1;
    double least = vertex_tolerance * this->diagonal_;
    for (Index v = 0; v < this->rest_.rows(); ++v)
    {
      const double length = (this->rest_.row(v) - p.transpose()).norm();
      if (length <= least && parts.of_vertex[v] >= 0)
      {
        least = length;
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
      const double share = found.barycentric[k];
      if (share >= whole)
      {
        return vertex_point(elements(found.element, k));
      }
      if (share > 1.0 - whole)
      {
        point.emplace_back(elements(found.element, k), share);
        sum += share;
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
        if (region_ids[v] == handle.region_id && parts.of_vertex[v] >= 0)
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
          if (parts.of_vertex[v] >= 0 &&
            nearest_in_triangle(this->rest_.row(v), handle.head, handle.tail, handle.tail)
                .distance <= vertex_tolerance * this->diagonal_)
          {
            grip.points.push_back(vertex_point(v));
          }
        }
        const double length = (handle.tail - handle.head).norm();
        const double places = std::clamp(std::ceil(length / edge), 1.0, most_places);
        const bool along = grip.points.size() < 2;
        for (double k = 0.0; along && k <= places; k += 1.0)
        {
          grip.points.push_back(
            point_at(handle.head + k / places * (handle.tail - handle.head), distance));
        }
      }
      else
      {
        grip.points.push_back(grip.pivot);
      }
    }
    if (distance > on_mesh * this->diagonal_)
    {
      farthest = std::max(farthest, distance);
      beside.push_back(static_cast<Index>(this->grips_.size()));
    }
    this->grips_.push_back(std::move(grip));
  }
  if (!beside.empty())
  {
    status.warnings.push_back("these handles are up to " + std::to_string(farthest) +
      " away from the mesh and constrain its nearest points: " +
      quoted_names(this->handles_, beside));
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

Vec3 MeshGrips::at_rest(const MeshPoint& point) const
{
  Vec3 sum = Vec3::Zero();
  for (const auto& [v, share] : point)
  {
    sum += share * this->rest_.row(v).transpose();
  }
  return sum;
}

/// Return the target displacement of a constrained point. The points of a full handle are
/// transformed with the handle. If the pivot is not on the mesh, its nearest mesh point has the
/// displacement of the pivot.
Vec3 MeshGrips::wanted(const Hold& hold, const HandlePose& pose) const
{
  const Eigen::Matrix3d linear = pose.transform.leftCols<3>() - Eigen::Matrix3d::Identity();
  const Handle& handle = this->handles_[hold.handle];
  if (hold.tail)
  {
    return posed_tail(handle, pose) - handle.tail;
  }
  const bool by_pivot = constrains_pivot(pose.mode) && handle.kind != HandleKind::region;
  return linear * (by_pivot ? handle.head : this->at_rest(hold.point)) + pose.transform.col(3);
}

void MeshGrips::choose(const Pose& pose, const std::vector<Index>& staying)
{
  this->holds_.clear();
  this->doubled_.clear();
  this->given_.clear();
  this->held_.clear();
  this->holder_.clear();
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
        this->holds_.push_back({ handle, this->grips_[h].points[k] });
      }
      if (constrains_pivot(pose[h].mode))
      {
        this->holds_.push_back({ handle, this->grips_[h].pivot });
      }
      if (constrains_tail(pose[h].mode))
      {
        this->holds_.push_back({ handle, this->grips_[h].tail, -1, -1, true });
      }
    }
  }
  // A position handle at a vertex that a full handle constrains is redundant. If several position
  // handles are at one vertex, all except the first are reported as redundant, but the target is
  // the mean of all their targets.
  std::map<Index, bool> given; // vertex -> whether a full handle constrains it
  for (const Hold& hold : this->holds_)
  {
    if (hold.point.size() == 1)
    {
      given.insert({ hold.point[0].first, constrains_transform(pose[hold.handle].mode) });
    }
  }
  for (const Index v : staying)
  {
    given.insert({ v, false });
  }
  std::map<Index, Index> place;
  for (const auto& entry : given)
  {
    place[entry.first] = static_cast<Index>(this->given_.size());
    this->given_.push_back(entry.first);
  }
  std::vector<char> taken(this->given_.size(), 0);
  for (Hold& hold : this->holds_)
  {
    const bool full = constrains_transform(pose[hold.handle].mode);
    if (hold.point.size() > 1)
    {
      hold.held = static_cast<Index>(this->held_.size());
      this->held_.push_back(hold.point);
      this->holder_.push_back(hold.handle);
    }
    else
    {
      const Index v = hold.point[0].first;
      if (full || !given[v])
      {
        hold.given = place[v];
      }
      if (!full && taken[place[v]])
      {
        this->doubled_.push_back(hold.handle);
      }
      taken[place[v]] = 1;
    }
  }
}

void MeshGrips::targets(const Pose& pose, Rows& given, Rows& held) const
{
  given = Rows::Zero(static_cast<Index>(this->given_.size()), 3);
  held = Rows::Zero(static_cast<Index>(this->held_.size()), 3);
  Eigen::VectorXd owners = Eigen::VectorXd::Zero(given.rows());
  for (const Hold& hold : this->holds_)
  {
    const Vec3 move = this->wanted(hold, pose[hold.handle]);
    if (hold.given >= 0)
    {
      // Update the mean incrementally. If all handles have the same target, the result is exact to
      // the bit.
      owners[hold.given] += 1.0;
      given.row(hold.given) += (move.transpose() - given.row(hold.given)) / owners[hold.given];
    }
    else if (hold.held >= 0)
    {
      held.row(hold.held) = move.transpose();
    }
  }
}

std::vector<std::string> MeshGrips::redundancy(
  const Pose& pose, const std::vector<Index>& points) const
{
  std::vector<Index> redundant = this->doubled_;
  for (const Index point : points)
  {
    const Index handle = this->holder_[point];
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
  for (const Hold& hold : this->holds_)
  {
    Vec3 miss = this->wanted(hold, pose[hold.handle]);
    for (const auto& [v, share] : hold.point)
    {
      miss -= share * displacements.row(v).transpose();
    }
    const double length = miss.norm() / std::max(this->diagonal_, 1e-300);
    residual = std::max(residual, length);
    if (length > contradictory_miss &&
      (contradicting.empty() || contradicting.back() != hold.handle))
    {
      contradicting.push_back(hold.handle);
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
