// The transfer of weights from a lattice to its surface (see embedded_surface.h). Where parts of
// the surface are near each other but not connected, the lattice has several copies of a tet, one
// per part. Copies have the same position, so they are found by their common center. For a given
// point, the correct copy is the copy that is connected with the surface point nearest to the given
// point. The reason is that the segment between these two points crosses no surface. A
// breadth-first search over tets with common vertices starts at the tet that contains this surface
// point and ends at the first copy of the tet at the given point.
//
// Let w_i and g_i be the values and gradients at the corners x_i of a tet. The interpolated value
// at p is
//   sum l_i (w_i + g_i.(p - x_i) / 2), where l_i are the barycentric coordinates of p.
// This interpolation is continuous. It is exact for quadratic functions if the gradients are exact.
#include "domain/embedded_surface.h"

#include "base/parallel.h"
#include "base/sort_unique.h"
#include "domain/surface_smoothing.h"
#include "embedding/lattice_cover.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_set>

namespace bindpose
{

namespace
{
constexpr double minimum_fraction = 0.03;
/// After smoothing, values smaller than this are set to 0. Smoothing spreads each value over the
/// whole surface, which makes distant zeros tiny nonzero values. Such values have no visible
/// effect, but posing costs time for each nonzero weight.
constexpr double negligible_value = 1e-12;

/// Return the gradients of the columns at the vertices, #V x (3 #columns): the x components of all
/// columns, then the y components, then the z components. The gradient at a vertex is a weighted
/// mean over its tets. The weight of a tet is the part of its volume that is inside the surface.
Eigen::MatrixXd corner_gradients(const Domain& domain, WeightsView values)
{
  const Index n = domain.points.rows();
  const Index m = values.cols();
  Eigen::MatrixXd gradients = Eigen::MatrixXd::Zero(n, 3 * m);
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(n);
  for (Index t = 0; t < domain.tets.rows(); ++t)
  {
    const auto corner = [&](int k) -> Vec3 { return domain.points.row(domain.tets(t, k)); };
    const Vec3 a = corner(1) - corner(0), b = corner(2) - corner(0), c = corner(3) - corner(0);
    const double volume_times_six = a.cross(b).dot(c);
    const double volume =
      volume_times_six * (domain.inside_fractions.size() > 0 ? domain.inside_fractions[t] : 1.0);
    const Vec3 hat_gradients[3] = { b.cross(c) / volume_times_six, c.cross(a) / volume_times_six,
      a.cross(b) / volume_times_six };
    const auto row = [&](int k) { return values.row(domain.tets(t, k)); };
    for (int axis = 0; axis < 3; ++axis)
    {
      Eigen::RowVectorXd g = Eigen::RowVectorXd::Zero(m);
      for (int k = 1; k < 4; ++k)
      {
        g += hat_gradients[k - 1][axis] * (row(k) - row(0));
      }
      for (int k = 0; k < 4; ++k)
      {
        gradients.row(domain.tets(t, k)).segment(axis * m, m) += volume * g;
      }
    }
    for (int k = 0; k < 4; ++k)
    {
      sums[domain.tets(t, k)] += volume;
    }
  }
  for (Index v = 0; v < n; ++v)
  {
    gradients.row(v) /= sums[v] > 0.0 ? sums[v] : 1.0;
  }
  return gradients;
}

/// Group items by their keys, which are 0 … count - 1. The indices of the items with key k are
/// grouped[first[k]] to grouped[first[k + 1] - 1].
template <typename KeyOf>
void group_by_key(Index count, Index items, const KeyOf& key_of, std::vector<Index>& first,
  std::vector<Index>& grouped)
{
  first.assign(static_cast<std::size_t>(count) + 1, 0);
  for (Index i = 0; i < items; ++i)
  {
    ++first[key_of(i) + 1];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  grouped.resize(static_cast<std::size_t>(items));
  std::vector<Index> next(first.begin(), first.end() - 1);
  for (Index i = 0; i < items; ++i)
  {
    grouped[next[key_of(i)]++] = i;
  }
}
} // namespace

std::size_t EmbeddedSurface::LatticePositionHash::operator()(const LatticePosition& position) const
{
  std::size_t hash = 0;
  for (const Index x : position)
  {
    hash = hash * 1000003 + static_cast<std::size_t>(x);
  }
  return hash;
}

EmbeddedSurface::EmbeddedSurface(PointsView points, TrianglesView triangles,
  const SimplexLocator& surface, const TetMesh& lattice, const PointBinding& binding)
  : points_(points), triangles_(triangles), lattice_(lattice), binding_(binding),
    tets_(lattice.points, lattice.tets), surface_(surface)
{
  for (int k = 1; k < 4; ++k)
  {
    this->spacing_ = std::max(this->spacing_,
      (lattice.points.row(lattice.tets(0, k)) - lattice.points.row(lattice.tets(0, k - 1))).norm());
  }
  this->spacing_ = std::max(this->spacing_,
    (lattice.points.row(lattice.tets(0, 0)) - lattice.points.row(lattice.tets(0, 3))).norm());
  for (Index t = 0; t < lattice.tets.rows(); ++t)
  {
    this->copies_[this->center_of(t)].push_back(t);
  }
  for (auto at = this->copies_.begin(); at != this->copies_.end();)
  {
    at = at->second.size() > 1 ? std::next(at) : this->copies_.erase(at);
  }
  group_by_key(
    lattice.points.rows(), lattice.tets.size(), [&](Index i) { return lattice.tets.data()[i]; },
    this->first_corner_, this->corners_of_vertex_);
}

EmbeddedSurface::LatticePosition EmbeddedSurface::center_of(Index tet) const
{
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < 4; ++k)
  {
    sum += (this->lattice_.points.row(this->lattice_.tets(tet, k)) - this->lattice_.points.row(0));
  }
  LatticePosition position;
  for (int k = 0; k < 3; ++k)
  {
    // Lattice nodes are at multiples of half the edge of a cube, so means of four nodes are at
    // multiples of an eighth of this edge.
    position[k] = static_cast<Index>(std::llround(2.0 * sum[k] / this->spacing_));
  }
  return position;
}

Domain EmbeddedSurface::domain(const Eigen::VectorXd& inside_fractions) const
{
  Domain result;
  result.points = this->lattice_.points;
  result.tets = this->lattice_.tets;
  result.inside_fractions = inside_fractions.cwiseMax(minimum_fraction);
  result.embedded_points = this->points_;
  for (const Index tet : this->binding_.tets)
  {
    result.embedded_point_corners.push_back(tet < 0 ? -1 : this->lattice_.tets(tet, 0));
  }
  return result;
}

Index EmbeddedSurface::tet_of(const Vec3& position) const
{
  const Index found = this->tets_.locate(position).element;
  const auto copies = found < 0 ? this->copies_.end() : this->copies_.find(this->center_of(found));
  if (copies == this->copies_.end())
  {
    return found;
  }
  const SimplexLocation surface_location = this->surface_.locate(position);
  if (surface_location.element < 0)
  {
    return found;
  }
  const auto corner = std::max_element(
    surface_location.barycentric.begin(), surface_location.barycentric.begin() + 3);
  const Index start = this->binding_.tets[this->triangles_(
    surface_location.element, corner - surface_location.barycentric.begin())];
  std::vector<Index> queue{ start };
  std::unordered_set<Index> visited{ start };
  for (std::size_t i = 0; i < queue.size(); ++i)
  {
    if (std::find(copies->second.begin(), copies->second.end(), queue[i]) != copies->second.end())
    {
      return queue[i];
    }
    for (int k = 0; k < 4; ++k)
    {
      const Index v = this->lattice_.tets(queue[i], k);
      for (Index at = this->first_corner_[v]; at < this->first_corner_[v + 1]; ++at)
      {
        const Index tet = this->corners_of_vertex_[at] / 4;
        if (visited.insert(tet).second)
        {
          queue.push_back(tet);
        }
      }
    }
  }
  return found; // no copy is connected with the nearest surface point
}

Status EmbeddedSurface::interpolate(
  ExecutionContext& context, const HandleInsertion& mesh, WeightsView values, Weights& result) const
{
  const Domain& domain = mesh.domain;
  const Index m = values.cols();
  const Eigen::MatrixXd gradients = corner_gradients(domain, values);
  // For each tet of the lattice, the elements into which handle insertion has split it.
  std::vector<Index> first, parts;
  group_by_key(
    this->lattice_.tets.rows(), domain.tets.rows(), [&](Index e) { return mesh.parent_element[e]; },
    first, parts);

  const Eigen::RowVectorXd lowest = values.colwise().minCoeff();
  const Eigen::RowVectorXd highest = values.colwise().maxCoeff();
  result.resize(this->points_.rows(), m);
  const bool completed = parallel_for(context, this->points_.rows(), 512,
    [&](Index begin, Index end)
    {
      for (Index i = begin; i < end; ++i)
      {
        const Vec3 p = this->points_.row(i);
        Index tet = this->binding_.tets[i];
        if (tet < 0)
        {
          tet = p.allFinite() ? this->tet_of(p) : -1;
        }
        if (tet < 0)
        {
          result.row(i).setZero();
          continue;
        }
        SimplexLocation best;
        best.distance = 1e300;
        for (Index at = first[tet]; at < first[tet + 1]; ++at)
        {
          const auto corner = [&](int k) -> Vec3
          { return domain.points.row(domain.tets(parts[at], k)); };
          SimplexLocation candidate = nearest_in_tet(p, corner(0), corner(1), corner(2), corner(3));
          if (candidate.distance < best.distance)
          {
            best = candidate;
            best.element = parts[at];
          }
        }
        Vec3 position = Vec3::Zero();
        for (int k = 0; k < 4; ++k)
        {
          position +=
            best.barycentric[k] * domain.points.row(domain.tets(best.element, k)).transpose();
        }
        result.row(i).setZero();
        for (int k = 0; k < 4; ++k)
        {
          const Index v = domain.tets(best.element, k);
          const Vec3 half = 0.5 * (position - domain.points.row(v).transpose());
          result.row(i) += best.barycentric[k] *
            (values.row(v) + half[0] * gradients.row(v).segment(0, m) +
              half[1] * gradients.row(v).segment(m, m) +
              half[2] * gradients.row(v).segment(2 * m, m));
        }
        result.row(i) = result.row(i).cwiseMax(lowest).cwiseMin(highest);
      }
    });
  return completed ? Status() : Status::canceled();
}

/// Return the id of the surface's point at a position; -1: no point there.
Index EmbeddedSurface::point_at(const Vec3& position) const
{
  const SimplexLocation at = this->surface_.locate(position);
  for (int k = 0; k < 3 && at.element >= 0; ++k)
  {
    if (at.distance <= 1e-7 * this->spacing_ && at.barycentric[k] >= 1.0 - 1e-7)
    {
      return this->triangles_(at.element, k);
    }
  }
  return -1;
}

Status EmbeddedSurface::smooth(ExecutionContext& context, const std::vector<Index>& fixed_points,
  double length, Weights& result) const
{
  constexpr double welding_end = 0.03; // progress after equal points have been merged
  LatticeSurface welded;
  {
    const ProgressRange range(context, 0.0, welding_end);
    if (!welded.build(context, this->points_, this->triangles_, {}))
    {
      return Status::canceled();
    }
  }
  const ProgressRange range(context, welding_end, 1.0);
  const auto n = static_cast<Index>(welded.points.size());
  Points points(n, 3);
  for (Index v = 0; v < n; ++v)
  {
    points.row(v) = welded.points[v];
  }
  Triangles triangles(static_cast<Index>(welded.triangles.size()), 3);
  for (Index f = 0; f < triangles.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      triangles(f, k) = welded.triangles[f][k];
    }
  }
  std::vector<Index> fixed;
  for (const Index point : fixed_points)
  {
    fixed.push_back(welded.vertex_of_point[point]);
  }
  sort_unique(fixed);

  Eigen::MatrixXd smooth = Eigen::MatrixXd::Zero(n, result.cols());
  for (Index i = 0; i < result.rows(); ++i)
  {
    if (welded.vertex_of_point[i] >= 0)
    {
      smooth.row(welded.vertex_of_point[i]) = result.row(i);
    }
  }
  if (!smooth_on_surface(context, points, triangles, fixed, length, smooth))
  {
    return Status::canceled();
  }
  const Eigen::RowVectorXd lowest = result.colwise().minCoeff();
  const Eigen::RowVectorXd highest = result.colwise().maxCoeff();
  for (Index i = 0; i < result.rows(); ++i)
  {
    if (welded.vertex_of_point[i] >= 0)
    {
      const Index v = welded.vertex_of_point[i];
      result.row(i) = smooth.row(v).cwiseMax(lowest).cwiseMin(highest);
    }
  }
  result = (result.array().abs() < negligible_value).select(0.0, result);
  return {};
}

Status EmbeddedSurface::transfer_values(ExecutionContext& context, const HandleInsertion& mesh,
  const Handles& handles, WeightsView values, Smoothness smoothness, Weights& result) const
{
  constexpr double smoothing = 0.3;
  const bool smoothed = smoothness == Smoothness::smoothed;
  const double interpolation = smoothed ? 0.1 : 1.0; // progress at the end of the interpolation
  Status status;
  {
    const ProgressRange range(context, 0.0, interpolation);
    status = this->interpolate(context, mesh, values, result);
  }
  if (!status.ok())
  {
    return status;
  }
  // Points on handles get the values of the handle's vertex, even if this vertex is a small
  // distance away.
  std::vector<Index> fixed;
  for (std::size_t j = 0; j < mesh.handles.size(); ++j)
  {
    const std::vector<Index>& vertices = mesh.handles[j].vertices;
    for (const Index v : vertices)
    {
      fixed.push_back(this->point_at(mesh.domain.points.row(v)));
    }
    if (handles[j].kind != HandleKind::bone && vertices.size() == 1)
    {
      const Index point = this->point_at(handles[j].head);
      if (point >= 0)
      {
        result.row(point) = values.row(vertices[0]);
        fixed.push_back(point);
      }
    }
  }
  fixed.erase(std::remove(fixed.begin(), fixed.end(), -1), fixed.end());
  const ProgressRange range(context, interpolation, 1.0);
  return smoothed ? this->smooth(context, fixed, smoothing * this->spacing_, result) : Status();
}

} // namespace bindpose
