// Rigid moving least squares (Schaefer et al. 2006) with analytic weights for points and integrals
// for bones.
//
// At a vertex v each position p of a handle has the weight w = (r / |p - v|)^(2 exponent), where r
// is the distance of the nearest handle. The factor r avoids overflow and underflow. Let q be the
// posed position of p, and let p* and q* be the weighted means of rest and posed positions. The
// rotation R maximizes the sum of w (q - q*) . (R (p - p*)) over all positions. The posed position
// of v is R (v - p*) + q*.
//
// The positions p(t) and q(t) on a bone are linear functions of the parameter t. A warp therefore
// needs only three values per bone: the total weight (amount), and the weighted mean and variance
// of t. These values are integrals over the bone that contain w(t). They depend only on the rest
// pose and are computed by bind(). If v is near the bone, w(t) has a sharp peak at the position
// nearest to v. The bone is therefore divided into pieces for the integration, starting at this
// position in both directions. The first piece in each direction is as long as the distance between
// v and the bone. Each further piece is twice as long as the previous piece. Each piece has eight
// Gauss points, which gives nine correct digits for any distance between v and the bone.
//
// If a vertex is on a handle, its distance from the handle is set to 1e-12 of the handles' extent.
// Then the motions of the vertex and the handle agree to twelve digits, and no division by zero
// occurs.
#include "skinning/moving_least_squares.h"

#include "base/parallel.h"
#include "pose/rotation_fit.h"
#include "skinning/skinning.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
constexpr Index points_per_block = 512;
/// Minimum distance between a vertex and a handle, as a fraction of the handles' extent. Smaller
/// distances are replaced by this minimum.
constexpr double distance_tolerance = 1e-12;
/// Points are in one plane if their z coordinates differ by less than this fraction of the
/// bounding-box diagonal.
constexpr double flat_tolerance = 1e-9;

constexpr double gauss_nodes[4] = { 0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
  0.9602898564975363 };
constexpr double gauss_weight[4] = { 0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
  0.1012285362903763 };

/// Return the parameter of the segment's point that is nearest to v; 0 if the handle is a point.
double nearest_parameter(const Handle& handle, const Vec3& v)
{
  const Vec3 segment_vector = handle.tail - handle.head;
  const double length2 = segment_vector.squaredNorm();
  return length2 > 0.0 ? std::clamp(segment_vector.dot(v - handle.head) / length2, 0.0, 1.0) : 0.0;
}

bool is_bone(const Handle& handle)
{
  return handle.kind == HandleKind::bone;
}

double falloff(double squared_ratio, double exponent)
{
  return exponent == 1.0 ? squared_ratio : std::pow(squared_ratio, exponent);
}

/// Compute the integrals of w(t), t w(t), t^2 w(t) over a bone, as amount, mean and variance. In
/// the integrals, t is counted from the bone's point nearest to v, so that t is small where the
/// weight is large. The amount is scaled so that a bone as long as the handles' extent has the same
/// weight as a point handle.
/// @param nearest distance of v to the nearest handle.
/// @param bone_distance distance of v to this bone.
MovingLeastSquares::HandleMoments bone_moments(const Handle& bone, const Vec3& v, double nearest,
  double bone_distance, double floor, double exponent, double extent)
{
  const Vec3 segment_vector = bone.tail - bone.head;
  const double length = segment_vector.norm();
  const double parameter = nearest_parameter(bone, v);
  const Vec3 offset = bone.head + parameter * segment_vector - v;
  double sums[3] = { 0.0, 0.0, 0.0 };
  for (const double direction : { -1.0, 1.0 })
  {
    const double end = direction < 0.0 ? parameter : 1.0 - parameter;
    double width = bone_distance / length;
    for (double from = 0.0; from < end; width *= 2.0)
    {
      const double half = 0.5 * std::min(width, end - from);
      const double middle = from + half;
      for (int k = 0; k < 8; ++k)
      {
        const double s = direction * (middle + (k % 2 ? half : -half) * gauss_nodes[k / 2]);
        const double distance2 =
          std::max((offset + s * segment_vector).squaredNorm(), floor * floor);
        const double w =
          half * gauss_weight[k / 2] * falloff(nearest * nearest / distance2, exponent);
        sums[0] += w;
        sums[1] += w * s;
        sums[2] += w * s * s;
      }
      // The last piece ends exactly at `end`, because rounding could otherwise leave a remaining
      // piece of length zero.
      from = width >= end - from ? end : from + width;
    }
  }
  const double mean = sums[1] / sums[0];
  return { length / extent * sums[0], parameter + mean,
    std::max(0.0, sums[2] / sums[0] - mean * mean) };
}

/// Report whether the points are in a plane z = const up to the tolerance.
bool is_flat(PointsView points, double tolerance)
{
  return points.rows() == 0 || points.col(2).maxCoeff() - points.col(2).minCoeff() <= tolerance;
}

/// Return the heads of all handles, then the tails, 2 #handles x 3.
Points endpoint_positions(const Handles& handles, const std::vector<Affine>* transforms)
{
  const auto count = static_cast<Index>(handles.size());
  Points result(2 * count, 3);
  for (Index j = 0; j < count; ++j)
  {
    const Handle& handle = handles[static_cast<std::size_t>(j)];
    result.row(j) = handle.head.transpose();
    result.row(count + j) = (is_bone(handle) ? handle.tail : handle.head).transpose();
    if (transforms)
    {
      const Affine& t = (*transforms)[static_cast<std::size_t>(j)];
      for (const Index row : { j, count + j })
      {
        result.row(row) = (t.leftCols<3>() * result.row(row).transpose() + t.col(3)).transpose();
      }
    }
  }
  return result;
}

/// Return the largest distance between two points. It is invariant under rotation, unlike the
/// diagonal of a bounding box.
double largest_distance(const Points& points)
{
  double squared = 0.0;
  for (Index i = 0; i < points.rows(); ++i)
  {
    squared =
      std::max(squared, (points.rowwise() - points.row(i)).rowwise().squaredNorm().maxCoeff());
  }
  return std::sqrt(squared);
}

/// Return the rows of `endpoint_positions` for the handles in `active_handles`: head, tail, head,
/// tail, …
Points rows_of(const Points& endpoint_positions, const std::vector<Index>& active_handles)
{
  const Index count = endpoint_positions.rows() / 2;
  Points result(2 * static_cast<Index>(active_handles.size()), 3);
  for (std::size_t i = 0; i < active_handles.size(); ++i)
  {
    result.row(2 * static_cast<Index>(i)) = endpoint_positions.row(active_handles[i]);
    result.row(2 * static_cast<Index>(i) + 1) = endpoint_positions.row(count + active_handles[i]);
  }
  return result;
}
} // namespace

Status MovingLeastSquares::bind(ExecutionContext& context, const MovingLeastSquaresOptions& options,
  PointsView rest, const Handles& handles)
{
  *this = MovingLeastSquares();
  if (!(options.exponent >= 1.0 && options.exponent <= 8.0))
  {
    return Status::invalid_input("the exponent of moving least squares must be from 1 to 8");
  }
  Status status = check_handles(handles);
  if (!status.ok())
  {
    return status;
  }
  // Lengths are relative to the extent of the handles, so that the motion of a vertex does not
  // depend on other vertices.
  const double extent = largest_distance(endpoint_positions(handles, nullptr));
  const double floor = std::max(distance_tolerance * extent, 1e-150);
  const double exponent = options.exponent;
  const std::size_t count = handles.size();
  this->moments_.resize(static_cast<std::size_t>(rest.rows()) * count);
  const bool done = parallel_for(context, rest.rows(), points_per_block,
    [&](Index begin, Index end)
    {
      std::vector<double> distance(count);
      for (Index i = begin; i < end; ++i)
      {
        const Vec3 v = rest.row(i).transpose();
        for (std::size_t j = 0; j < count; ++j)
        {
          const Handle& h = handles[j];
          const double parameter = is_bone(h) ? nearest_parameter(h, v) : 0.0;
          distance[j] = std::max((h.head + parameter * (h.tail - h.head) - v).norm(), floor);
        }
        const double nearest = *std::min_element(distance.begin(), distance.end());
        HandleMoments* moments = this->moments_.data() + static_cast<std::size_t>(i) * count;
        for (std::size_t j = 0; j < count; ++j)
        {
          const double ratio = nearest / distance[j];
          moments[j] = is_bone(handles[j])
            ? bone_moments(handles[j], v, nearest, distance[j], floor, exponent, extent)
            : HandleMoments{ falloff(ratio * ratio, exponent), 0.0, 0.0 };
        }
      }
    });
  if (!done)
  {
    *this = MovingLeastSquares();
    return Status::canceled();
  }
  this->handles_ = static_cast<Index>(count);
  this->rest_ = rest;
  this->flat_ = is_flat(rest, flat_tolerance * std::max(bounding_box(rest).diagonal(), extent));
  return {};
}

Status MovingLeastSquares::warp(
  ExecutionContext& context, const Handles& handles, const Pose& pose, PointsOutput output) const
{
  const auto count = static_cast<Index>(handles.size());
  if (count != this->handles_ || pose.size() != handles.size())
  {
    return Status::invalid_input("the pose has " + std::to_string(pose.size()) + " handles, but " +
      std::to_string(this->handles_) + " handles are bound");
  }
  std::vector<Affine> transforms;
  std::vector<Index> active_handles;
  for (Index j = 0; j < count; ++j)
  {
    if (pose[static_cast<std::size_t>(j)].mode != HandleMode::free)
    {
      active_handles.push_back(j);
    }
  }
  Status status = skinning_transforms(handles, pose, transforms);
  if (!status.ok())
  {
    return status;
  }
  // Remove the warnings about free handles: in this method free handles have no effect.
  status.warnings.clear();
  if (active_handles.empty())
  {
    output.resized(this->rest_.rows()) = this->rest_;
    status.warnings.emplace_back("all handles are free, so the mesh does not move");
    return status;
  }
  const Points rest_endpoints = endpoint_positions(handles, nullptr);
  const Points posed_endpoints = endpoint_positions(handles, &transforms);
  const Points rest_rows = rows_of(rest_endpoints, active_handles);
  const Points posed_rows = rows_of(posed_endpoints, active_handles);
  const double tolerance = flat_tolerance *
    std::max({ bounding_box(this->rest_).diagonal(), bounding_box(rest_rows).diagonal(),
      bounding_box(posed_rows).diagonal() });
  const bool planar =
    this->flat_ && is_flat(rest_rows, tolerance) && is_flat(posed_rows, tolerance);

  Eigen::Map<Points> posed = output.resized(this->rest_.rows());
  const bool done = parallel_for(context, this->rest_.rows(), points_per_block,
    [&](Index begin, Index end)
    {
      const Index size = end - begin;
      Points rest_means(size, 3);
      Points posed_means(size, 3);
      // Each column contains one entry of all 3 x 3 matrices, as fit_rotations() requires. The
      // fits start from the identity.
      Eigen::MatrixXd s = Eigen::MatrixXd::Zero(size, 9);
      Eigen::MatrixXd rotations = Eigen::MatrixXd::Zero(size, 9);
      rotations.col(0).setOnes();
      rotations.col(4).setOnes();
      rotations.col(8).setOnes();
      for (Index i = 0; i < size; ++i)
      {
        const HandleMoments* moments = this->moments_.data() + (begin + i) * count;
        const auto rest_at = [&](Index j)
        {
          return Vec3(((1.0 - moments[j].mean) * rest_endpoints.row(j) +
            moments[j].mean * rest_endpoints.row(count + j))
                        .transpose());
        };
        const auto posed_at = [&](Index j)
        {
          return Vec3(((1.0 - moments[j].mean) * posed_endpoints.row(j) +
            moments[j].mean * posed_endpoints.row(count + j))
                        .transpose());
        };
        // Means are computed relative to the position with the largest weight. If no other handle
        // has an effect, the means equal this position exactly, and rounding causes no rotation.
        Index dominant = active_handles[0];
        double amount = 0.0;
        for (const Index j : active_handles)
        {
          dominant = moments[j].amount > moments[dominant].amount ? j : dominant;
          amount += moments[j].amount;
        }
        const Vec3 rest_dominant = rest_at(dominant);
        const Vec3 posed_dominant = posed_at(dominant);
        Vec3 p = Vec3::Zero();
        Vec3 q = Vec3::Zero();
        for (const Index j : active_handles)
        {
          const double fraction = moments[j].amount / amount;
          p += fraction * (rest_at(j) - rest_dominant);
          q += fraction * (posed_at(j) - posed_dominant);
        }
        Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
        for (const Index j : active_handles)
        {
          const double fraction = moments[j].amount / amount;
          moment += fraction * (rest_at(j) - rest_dominant - p) *
            (posed_at(j) - posed_dominant - q).transpose();
          if (moments[j].variance > 0.0)
          {
            moment += fraction * moments[j].variance *
              (rest_endpoints.row(count + j) - rest_endpoints.row(j)).transpose() *
              (posed_endpoints.row(count + j) - posed_endpoints.row(j));
          }
        }
        for (int k = 0; k < 9; ++k)
        {
          s(i, k) = moment(k / 3, k % 3);
        }
        rest_means.row(i) = (rest_dominant + p).transpose();
        posed_means.row(i) = (posed_dominant + q).transpose();
      }
      if (!planar)
      {
        fit_rotations(size, size, s.data(), rotations.data());
      }
      for (Index i = 0; i < size; ++i)
      {
        const Vec3 offset = (this->rest_.row(begin + i) - rest_means.row(i)).transpose();
        Vec3 rotated_offset;
        if (planar)
        {
          const double cosine = s(i, 0) + s(i, 4);
          const double sine = s(i, 1) - s(i, 3);
          const double length = std::hypot(cosine, sine);
          const double c = length > 0.0 ? cosine / length : 1.0;
          const double n = length > 0.0 ? sine / length : 0.0;
          rotated_offset =
            Vec3(c * offset[0] - n * offset[1], n * offset[0] + c * offset[1], offset[2]);
        }
        else
        {
          for (int r = 0; r < 3; ++r)
          {
            rotated_offset[r] = rotations(i, 3 * r) * offset[0] +
              rotations(i, 3 * r + 1) * offset[1] + rotations(i, 3 * r + 2) * offset[2];
          }
        }
        posed.row(begin + i) = posed_means.row(i) + rotated_offset.transpose();
      }
    });
  if (!done)
  {
    return Status::canceled();
  }
  status.report.set("planar", planar ? 1 : 0);
  return status;
}

} // namespace bindpose
