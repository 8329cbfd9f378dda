// Weights are kept row by row without their zeros. A vertex blends the handles' 3x4 matrices (or
// dual quaternions) first and moves once, so the cost a weight is 12 (or 8) multiply-adds.
//
// Linear blending works on T - identity: what does not move adds exactly nothing.
#include "pose/skinning.h"

#include "base/parallel.h"
#include "pose/rotation_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bindpose
{

namespace
{
constexpr Index block_size = 2048;
/// Row sums further from one than this are worth a warning.
constexpr double row_sum_tolerance = 1e-6;

/// The transforms less the identity, as rows that a blend can stream through.
std::vector<Affine> displacements(const std::vector<Affine>& transforms)
{
  std::vector<Affine> result(transforms);
  for (Affine& t : result)
  {
    t.leftCols<3>() -= Eigen::Matrix3d::Identity();
  }
  return result;
}

Affine blend(const std::vector<Affine>& matrices, const std::int32_t* columns,
  const double* weights, Index count)
{
  Affine sum = Affine::Zero();
  for (Index k = 0; k < count; ++k)
  {
    sum += weights[k] * matrices[static_cast<std::size_t>(columns[k])];
  }
  return sum;
}

/// adj(A)^T: takes normals (areas) along when A takes points.
Eigen::Matrix3d cofactors(const Eigen::Matrix3d& a)
{
  Eigen::Matrix3d c;
  c.col(0) = a.col(1).cross(a.col(2));
  c.col(1) = a.col(2).cross(a.col(0));
  c.col(2) = a.col(0).cross(a.col(1));
  return c;
}

Vec3 unit_or(const Vec3& n, const Vec3& fallback)
{
  const double length = n.norm();
  return length > 1e-300 ? Vec3(n / length) : fallback;
}

/// The unit normal under a linear map, the old one where it collapses. Only the map's direction
/// matters: it is scaled, exactly, so that squares of huge and tiny entries stay numbers.
Vec3 turned_normal(const Eigen::Matrix3d& linear, const Vec3& n)
{
  const double largest = linear.cwiseAbs().maxCoeff();
  if (!(largest > 1e-300))
  {
    return n;
  }
  const Eigen::Matrix3d scaled = linear * std::ldexp(1.0, -std::ilogb(largest));
  return unit_or(cofactors(scaled) * n, n);
}

/// By how much a bone's stretch and twist move a point at rest, at the endpoint weight e.
Vec3 change_at(const BoneChange& bone, const Vec3& p, double e)
{
  const double angle = ((1.0 - e) * bone.twist[0] + e * bone.twist[1]) * EIGEN_PI / 180.0;
  const Vec3 axis = bone.vector.stableNormalized();
  const Vec3 arm = axis.cross(p - bone.head);
  return std::sin(angle) * arm + (1.0 - std::cos(angle)) * axis.cross(arm) +
    e * (bone.stretch - 1.0) * bone.vector;
}

/// A rigid motion as a dual quaternion: real part, dual part, each (x, y, z, w).
struct DualQuaternion
{
  Eigen::Vector4d real, dual;
};

DualQuaternion dual_quaternion_of(const Eigen::Matrix3d& rotation, const Vec3& translation)
{
  Eigen::Quaterniond q(rotation);
  q.normalize();
  // A fixed sign, so that equal rotations have equal quaternions.
  Eigen::Vector4d real = q.coeffs();
  for (int i = 3; i >= 0; --i)
  {
    if (real[i] != 0.0)
    {
      real = real[i] < 0.0 ? Eigen::Vector4d(-real) : real;
      break;
    }
  }
  DualQuaternion d;
  d.real = real;
  const Vec3 v = real.head<3>();
  d.dual.head<3>() = 0.5 * (real[3] * translation + translation.cross(v));
  d.dual[3] = -0.5 * translation.dot(v);
  return d;
}
} // namespace

Status Skinning::bind(ExecutionContext& context, WeightsView weights)
{
  *this = Skinning();
  const Index rows = weights.rows(), cols = weights.cols();
  std::vector<Index> count(static_cast<std::size_t>(rows), 0);
  std::vector<double> row_error(static_cast<std::size_t>(rows), 0.0);
  std::vector<Index> bad(static_cast<std::size_t>((rows + block_size - 1) / block_size), -1);
  bool done = parallel_for(context, rows, block_size,
    [&](Index begin, Index end)
    {
      for (Index v = begin; v < end; ++v)
      {
        double sum = 0.0;
        for (Index j = 0; j < cols; ++j)
        {
          const double w = weights(v, j);
          if (!std::isfinite(w) && bad[static_cast<std::size_t>(begin / block_size)] < 0)
          {
            bad[static_cast<std::size_t>(begin / block_size)] = v * cols + j;
          }
          count[static_cast<std::size_t>(v)] += w != 0.0 ? 1 : 0;
          sum += w;
        }
        row_error[static_cast<std::size_t>(v)] = std::abs(sum - 1.0);
      }
    });
  if (!done)
  {
    return Status::cancelled();
  }
  for (const Index at : bad)
  {
    if (at >= 0)
    {
      return Status::invalid_input("the weight of vertex " + std::to_string(at / cols) +
        " in column " + std::to_string(at % cols) + " is not a finite number");
    }
  }
  this->handles_ = cols;
  this->row_start_.assign(static_cast<std::size_t>(rows) + 1, 0);
  Index worst = 0, off = 0;
  for (Index v = 0; v < rows; ++v)
  {
    const auto i = static_cast<std::size_t>(v);
    this->row_start_[i + 1] = this->row_start_[i] + count[i];
    worst = row_error[i] > row_error[static_cast<std::size_t>(worst)] ? v : worst;
    off += row_error[i] > row_sum_tolerance ? 1 : 0;
  }
  this->columns_.resize(static_cast<std::size_t>(this->row_start_.back()));
  this->weights_.resize(static_cast<std::size_t>(this->row_start_.back()));
  done = parallel_for(context, rows, block_size,
    [&](Index begin, Index end)
    {
      for (Index v = begin; v < end; ++v)
      {
        auto at = static_cast<std::size_t>(this->row_start_[static_cast<std::size_t>(v)]);
        for (Index j = 0; j < cols; ++j)
        {
          if (weights(v, j) != 0.0)
          {
            this->columns_[at] = static_cast<std::int32_t>(j);
            this->weights_[at] = weights(v, j);
            ++at;
          }
        }
      }
    });
  if (!done)
  {
    return Status::cancelled();
  }
  Status status;
  const double largest = rows > 0 ? row_error[static_cast<std::size_t>(worst)] : 0.0;
  status.report.set("row_sum_error", Report::Value(largest));
  if (off > 0)
  {
    status.warnings.push_back("the weights of " + std::to_string(off) + " of " +
      std::to_string(rows) + " vertices do not sum to one (worst: vertex " + std::to_string(worst) +
      ", off by " + std::to_string(largest) + "); the missing share stays at rest");
  }
  return status;
}

Status Skinning::check(PointsView rest, const std::vector<Affine>& transforms) const
{
  if (rest.rows() != this->vertex_count())
  {
    return Status::invalid_input("the weights have " + std::to_string(this->vertex_count()) +
      " rows, but there are " + std::to_string(rest.rows()) + " vertices");
  }
  if (static_cast<Index>(transforms.size()) != this->handles_)
  {
    return Status::invalid_input("the weights have " + std::to_string(this->handles_) +
      " columns, but there are " + std::to_string(transforms.size()) + " transforms");
  }
  return {};
}

Status Skinning::linear_blend(ExecutionContext& context, PointsView rest,
  const std::vector<Affine>& transforms, Points& posed) const
{
  Status status = this->check(rest, transforms);
  if (!status.ok())
  {
    return status;
  }
  const std::vector<Affine> moves = displacements(transforms);
  posed.resize(rest.rows(), 3);
  const bool done = parallel_for(context, rest.rows(), block_size,
    [&](Index begin, Index end)
    {
      for (Index v = begin; v < end; ++v)
      {
        const Index from = this->row_start_[static_cast<std::size_t>(v)];
        const Index to = this->row_start_[static_cast<std::size_t>(v) + 1];
        const Affine a =
          blend(moves, this->columns_.data() + from, this->weights_.data() + from, to - from);
        const Vec3 p = rest.row(v);
        posed.row(v) = (p + (a.leftCols<3>() * p + a.col(3))).transpose();
      }
    });
  return done ? status : Status::cancelled();
}

Status Skinning::linear_blend_normals(ExecutionContext& context, PointsView rest_normals,
  const std::vector<Affine>& transforms, Points& posed_normals) const
{
  Status status = this->check(rest_normals, transforms);
  if (!status.ok())
  {
    return status;
  }
  const std::vector<Affine> moves = displacements(transforms);
  posed_normals.resize(rest_normals.rows(), 3);
  const bool done = parallel_for(context, rest_normals.rows(), block_size,
    [&](Index begin, Index end)
    {
      for (Index v = begin; v < end; ++v)
      {
        const Index from = this->row_start_[static_cast<std::size_t>(v)];
        const Index to = this->row_start_[static_cast<std::size_t>(v) + 1];
        const Affine a =
          blend(moves, this->columns_.data() + from, this->weights_.data() + from, to - from);
        const Eigen::Matrix3d linear = Eigen::Matrix3d::Identity() + a.leftCols<3>();
        const Vec3 n = rest_normals.row(v);
        posed_normals.row(v) = turned_normal(linear, n).transpose();
      }
    });
  return done ? status : Status::cancelled();
}

Status Skinning::stretchable_bones(ExecutionContext& context, PointsView rest,
  const std::vector<Affine>& transforms, const std::vector<BoneChange>& bones,
  WeightsView endpoints, Points& posed) const
{
  Status status = this->check(rest, transforms);
  if (status.ok() && bones.size() != transforms.size())
  {
    status = Status::invalid_input("there are " + std::to_string(bones.size()) +
      " bones, but the weights have " + std::to_string(this->handles_) + " columns");
  }
  if (status.ok() && endpoints.size() > 0 &&
    (endpoints.rows() != rest.rows() || endpoints.cols() != this->handles_))
  {
    status = Status::invalid_input("there are " + std::to_string(endpoints.rows()) + " x " +
      std::to_string(endpoints.cols()) + " endpoint weights for " + std::to_string(rest.rows()) +
      " vertices and " + std::to_string(this->handles_) + " handles");
  }
  status = status.ok() ? this->linear_blend(context, rest, transforms, posed) : status;
  const bool any =
    std::any_of(bones.begin(), bones.end(), [](const BoneChange& bone) { return bone.any(); });
  if (!status.ok() || !any)
  {
    return status;
  }
  const bool done = parallel_for(context, rest.rows(), block_size,
    [&](Index begin, Index end)
    {
      for (Index v = begin; v < end; ++v)
      {
        const Vec3 p = rest.row(v);
        for (Index k = this->row_start_[static_cast<std::size_t>(v)];
             k < this->row_start_[static_cast<std::size_t>(v) + 1]; ++k)
        {
          const std::int32_t j = this->columns_[static_cast<std::size_t>(k)];
          const BoneChange& bone = bones[static_cast<std::size_t>(j)];
          if (bone.any())
          {
            const double given =
              endpoints.size() > 0 ? endpoints(v, j) : std::numeric_limits<double>::quiet_NaN();
            const double e =
              std::isnan(given) ? projected_endpoint(p, bone.head, bone.vector) : given;
            posed.row(v) += this->weights_[static_cast<std::size_t>(k)] *
              (transforms[static_cast<std::size_t>(j)].leftCols<3>() * change_at(bone, p, e))
                .transpose();
          }
        }
      }
    });
  return done ? status : Status::cancelled();
}

Status Skinning::dual_quaternion_any(ExecutionContext& context, PointsView rest,
  const std::vector<Affine>& transforms, PointsView pivots, bool normals, Points& posed) const
{
  Status status = this->check(rest, transforms);
  if (status.ok() && pivots.rows() != this->handles_)
  {
    status = Status::invalid_input("there are " + std::to_string(pivots.rows()) +
      " pivots, but the weights have " + std::to_string(this->handles_) + " columns");
  }
  if (!status.ok())
  {
    return status;
  }
  // x -> L x + t is the scale and shear x -> c + P (x - c), then the rigid y -> R y + u.
  std::vector<Affine> shears(transforms.size());
  std::vector<DualQuaternion> motions(transforms.size());
  bool any_shear = false;
  for (std::size_t j = 0; j < transforms.size(); ++j)
  {
    const Eigen::Matrix3d linear = transforms[j].leftCols<3>();
    const Vec3 c = pivots.row(static_cast<Index>(j));
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    fit_rotation(linear.transpose(), rotation);
    Eigen::Matrix3d shear = rotation.transpose() * linear - Eigen::Matrix3d::Identity();
    if (shear.norm() <= 1e-14)
    {
      shear.setZero();
      rotation = linear; // rigid already; the fit would only round it
    }
    any_shear = any_shear || !shear.isZero(0.0);
    shears[j].leftCols<3>() = shear;
    shears[j].col(3) = -shear * c;
    motions[j] = dual_quaternion_of(rotation, transforms[j].col(3) + rotation * (shear * c));
  }
  posed.resize(rest.rows(), 3);
  const bool done = parallel_for(context, rest.rows(), block_size,
    [&](Index begin, Index end)
    {
      for (Index v = begin; v < end; ++v)
      {
        const Index from = this->row_start_[static_cast<std::size_t>(v)];
        const Index count = this->row_start_[static_cast<std::size_t>(v) + 1] - from;
        const std::int32_t* columns = this->columns_.data() + from;
        const double* weights = this->weights_.data() + from;
        Vec3 p = rest.row(v);
        if (any_shear)
        {
          const Affine a = blend(shears, columns, weights, count);
          const Eigen::Matrix3d linear = Eigen::Matrix3d::Identity() + a.leftCols<3>();
          p = normals ? turned_normal(linear, p) : Vec3(linear * p + a.col(3));
        }
        Index largest = 0;
        for (Index k = 1; k < count; ++k)
        {
          largest = weights[k] > weights[largest] ? k : largest;
        }
        DualQuaternion sum{ Eigen::Vector4d::Zero(), Eigen::Vector4d::Zero() };
        for (Index k = 0; k < count; ++k)
        {
          const DualQuaternion& d = motions[static_cast<std::size_t>(columns[k])];
          const bool flip =
            d.real.dot(motions[static_cast<std::size_t>(columns[largest])].real) < 0.0;
          const double w = flip ? -weights[k] : weights[k];
          sum.real += w * d.real;
          sum.dual += w * d.dual;
        }
        const double length = sum.real.norm();
        if (length > 1e-300)
        {
          sum.real /= length;
          sum.dual /= length;
          const Vec3 d0 = sum.real.head<3>(), de = sum.dual.head<3>();
          p += 2.0 * d0.cross(d0.cross(p) + sum.real[3] * p);
          if (!normals)
          {
            p += 2.0 * (sum.real[3] * de - sum.dual[3] * d0 + d0.cross(de));
          }
        }
        posed.row(v) = p.transpose();
      }
    });
  return done ? status : Status::cancelled();
}

Status Skinning::dual_quaternion(ExecutionContext& context, PointsView rest,
  const std::vector<Affine>& transforms, PointsView pivots, Points& posed) const
{
  return this->dual_quaternion_any(context, rest, transforms, pivots, false, posed);
}

Status Skinning::dual_quaternion_normals(ExecutionContext& context, PointsView rest_normals,
  const std::vector<Affine>& transforms, PointsView pivots, Points& posed_normals) const
{
  return this->dual_quaternion_any(context, rest_normals, transforms, pivots, true, posed_normals);
}

Status skinning_transforms(
  const Handles& handles, const Pose& pose, std::vector<Affine>& transforms)
{
  Status status;
  transforms.assign(handles.size(), identity_affine());
  std::string free_names;
  for (std::size_t h = 0; h < handles.size(); ++h)
  {
    if (pose[h].mode == HandleMode::full)
    {
      transforms[h] = pose[h].transform;
    }
    else if (pose[h].mode == HandleMode::position)
    {
      transforms[h].col(3) = pose[h].transform * handles[h].head.homogeneous() - handles[h].head;
    }
    else
    {
      free_names += (free_names.empty() ? "'" : ", '") + handles[h].name + "'";
    }
  }
  if (!free_names.empty())
  {
    status.warnings.push_back(
      "skinning cannot find the transform of a free handle; at rest stay: " + free_names);
  }
  return status;
}

std::vector<BoneChange> bone_changes(const Handles& handles, const Pose& pose)
{
  std::vector<BoneChange> changes(handles.size());
  for (std::size_t h = 0; h < handles.size(); ++h)
  {
    if (handles[h].kind == HandleKind::bone && pose[h].mode == HandleMode::full)
    {
      changes[h] = { handles[h].head, handles[h].tail - handles[h].head, pose[h].stretch,
        pose[h].twist };
    }
  }
  return changes;
}

double projected_endpoint(const Vec3& point, const Vec3& head, const Vec3& vector)
{
  const double length = vector.stableNorm();
  return length > 0.0 ? std::clamp((point - head).dot(vector / length) / length, 0.0, 1.0) : 0.0;
}

Points handle_pivots(const Handles& handles)
{
  Points pivots(static_cast<Index>(handles.size()), 3);
  for (Index h = 0; h < pivots.rows(); ++h)
  {
    pivots.row(h) = handles[static_cast<std::size_t>(h)].head.transpose();
  }
  return pivots;
}

} // namespace bindpose
