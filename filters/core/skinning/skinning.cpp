// Skinning by tiles of vertices (weight_tiles.h).
//
// Weights are stored in tiles of vertices, without the columns that are zero in the whole tile. The
// 3x4 matrices (or dual quaternions) of the handles are blended first, and then each vertex is
// transformed once. Therefore a weight costs 12 (or 8) multiply-adds, which are computed in
// parallel for as many vertices as fit in a register.
//
// Linear blending uses T - identity, so that a handle that does not move contributes exactly zero.
#include "skinning/skinning.h"

#include "base/parallel.h"
#include "pose/rotation_fit.h"
#include "skinning/bone_moves.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bindpose
{

namespace
{
constexpr Index skinning_block = 2048; // vertices per block; a multiple of the tile sizes
/// If a row sum differs from one by more than this, there is a warning.
constexpr double row_sum_tolerance = 1e-6;

/// Return the transforms minus the identity, for points relative to the center.
template <typename Scalar>
BlendValues<Scalar, 12> displacements(const std::vector<Affine>& transforms, const Vec3& center)
{
  BlendValues<Scalar, 12> moves;
  moves.values.reserve(12 * transforms.size());
  for (const Affine& transform : transforms)
  {
    Affine t = transform;
    t.leftCols<3>() -= Eigen::Matrix3d::Identity();
    t.col(3) += t.leftCols<3>() * center;
    for (int e = 0; e < 12; ++e)
    {
      moves.values.push_back(static_cast<Scalar>(t.data()[e]));
    }
  }
  return moves;
}

/// Add the coordinates in `summand` to those in `to`.
template <typename Scalar>
void add(const TilePoints<Scalar>& summand, TilePoints<Scalar>& to)
{
  for (int c = 0; c < 3; ++c)
  {
    for (Index i = 0; i < WeightTiles<Scalar>::lanes; ++i)
    {
      to.at[c][i] += summand.at[c][i];
    }
  }
}

/// Return the 3 x 4 matrix of a vertex from its tile.
template <typename Scalar>
Affine affine_of(const BlendedTile<Scalar, 12>& blended, Index lane)
{
  Affine a;
  for (int e = 0; e < 12; ++e)
  {
    a.data()[e] = static_cast<double>(blended.sums[e][lane]);
  }
  return a;
}

/// Return adj(A)^T. It transforms normals (area vectors) if A transforms points.
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

/// Transform a normal by a linear map and return it with unit length, or return the old normal if
/// the result has no direction. The scale of the map has no effect. The map is first scaled by a
/// power of two, which is exact, so that squares of huge and tiny entries neither overflow nor
/// underflow.
Vec3 transform_normal(const Eigen::Matrix3d& linear, const Vec3& n)
{
  const double largest = linear.cwiseAbs().maxCoeff();
  if (!(largest > 1e-300))
  {
    return n;
  }
  const Eigen::Matrix3d scaled = linear * std::ldexp(1.0, -std::ilogb(largest));
  return unit_or(cofactors(scaled) * n, n);
}

/// A rigid motion as a dual quaternion: a real and a dual part, each in the order (x, y, z, w).
struct DualQuaternion
{
  Eigen::Vector4d real, dual;
};

DualQuaternion dual_quaternion_of(const Eigen::Matrix3d& rotation, const Vec3& translation)
{
  Eigen::Quaterniond q(rotation);
  q.normalize();
  // The sign of the quaternion is fixed, so that equal rotations have equal quaternions.
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

/// A linear map as the product of a shear (with scale) and a rotation. If there is no shear, the
/// rotation equals the map bit for bit.
struct SplitMap
{
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d shear; ///< shear matrix minus the identity
};

SplitMap split(const Eigen::Matrix3d& linear)
{
  SplitMap map;
  fit_rotation(linear.transpose(), map.rotation);
  map.shear = map.rotation.transpose() * linear - Eigen::Matrix3d::Identity();
  if (map.shear.norm() <= 1e-14)
  {
    // The map itself is a rotation. Return it unchanged, because the fitted rotation has rounding
    // errors.
    map.shear.setZero();
    map.rotation = linear;
  }
  return map;
}

/// Set `quaternions.signs`, one sign for each pair of a handle and a reference handle. The sign is
/// negative if the dot product of their quaternions is negative; the blending then negates the
/// quaternion of the handle. `signs` is empty if no sign is negative.
template <typename Scalar>
void set_signs(const std::vector<DualQuaternion>& motions, BlendValues<Scalar, 8>& quaternions)
{
  bool any_flip = false;
  for (const DualQuaternion& column_motion : motions)
  {
    for (const DualQuaternion& reference_motion : motions)
    {
      const bool flip = column_motion.real.dot(reference_motion.real) < 0.0;
      any_flip = any_flip || flip;
      quaternions.signs.push_back(flip ? quaternions.sign_bit : 0);
    }
  }
  if (!any_flip)
  {
    quaternions.signs.clear();
  }
}

/// The kept weights of one row, and the factor that compensates for the dropped weights.
class PrunedRow
{
public:
  explicit PrunedRow(const SkinningOptions& options) : options_(options) {}

  void assign_row(WeightsView weights, Index v)
  {
    this->columns_.clear();
    double all = 0.0, kept_sum = 0.0;
    Index nonzero = 0;
    for (Index j = 0; j < weights.cols(); ++j)
    {
      const double w = weights(v, j);
      all += w;
      nonzero += w != 0.0 ? 1 : 0;
      if (std::abs(w) > this->options_.smallest_weight)
      {
        this->columns_.push_back(j);
      }
    }
    const auto most = static_cast<std::size_t>(this->options_.influences);
    if (most > 0 && this->columns_.size() > most)
    {
      std::stable_sort(this->columns_.begin(), this->columns_.end(),
        [&](Index a, Index b) { return std::abs(weights(v, a)) > std::abs(weights(v, b)); });
      this->columns_.resize(most);
      std::sort(this->columns_.begin(), this->columns_.end());
    }
    double size = 0.0;
    for (const Index j : this->columns_)
    {
      kept_sum += weights(v, j);
      size += std::abs(weights(v, j));
    }
    this->row_sum_ = all;
    this->dropped_ = nonzero - static_cast<Index>(this->columns_.size());
    this->dropped_weight_ = this->dropped_ > 0 ? weights.row(v).cwiseAbs().sum() - size : 0.0;
    this->factor_ = this->dropped_ > 0 && kept_sum > 0.0 && all > 0.0 ? all / kept_sum : 1.0;
  }

  const std::vector<Index>& columns() const { return this->columns_; }
  double factor() const { return this->factor_; }
  double row_sum() const { return this->row_sum_; }
  Index dropped() const { return this->dropped_; }
  double dropped_weight() const { return this->dropped_weight_; }

private:
  const SkinningOptions& options_;
  std::vector<Index> columns_;
  double factor_ = 1.0, row_sum_ = 0.0, dropped_weight_ = 0.0;
  Index dropped_ = 0;
};
/// Transform the points of a tile by an affine map.
void apply_placement(
  const Affine& placement, const TilePoints<float>& points, TilePoints<float>& placed_points)
{
  constexpr Index lanes = WeightTiles<float>::lanes;
  const Eigen::Matrix<float, 3, 4> p = placement.cast<float>();
  for (int r = 0; r < 3; ++r)
  {
    for (Index i = 0; i < lanes; ++i)
    {
      placed_points.at[r][i] =
        p(r, 0) * points.at[0][i] + p(r, 1) * points.at[1][i] + p(r, 2) * points.at[2][i] + p(r, 3);
    }
  }
}
} // namespace

template <>
const WeightTiles<float>& Skinning::tiles() const
{
  return this->single_tiles_;
}
template <>
const WeightTiles<double>& Skinning::tiles() const
{
  return this->double_tiles_;
}

Vec3 Skinning::center_of(PointsView points) const
{
  if (this->center_)
  {
    return *this->center_;
  }
  const Index sample_count = std::min<Index>(points.rows(), 64);
  Vec3 sum = Vec3::Zero();
  for (Index i = 0; i < sample_count; ++i)
  {
    sum += points.row(i * points.rows() / sample_count).transpose();
  }
  return sample_count > 0 ? Vec3(sum / static_cast<double>(sample_count)) : sum;
}

/// Copy the kept weights to tiles. The first pass finds the columns of each tile, the second pass
/// copies the weights.
template <typename Scalar>
bool Skinning::pack(ExecutionContext& context, WeightsView weights, const SkinningOptions& options,
  WeightTiles<Scalar>& tiles)
{
  constexpr Index lanes = WeightTiles<Scalar>::lanes;
  const Index rows = weights.rows();
  const Index count = (rows + lanes - 1) / lanes;
  std::vector<std::vector<std::int32_t>> columns(static_cast<std::size_t>(count));
  bool done = parallel_for(context, count, skinning_block / lanes,
    [&](Index begin, Index end)
    {
      PrunedRow row(options);
      std::vector<char> is_used(static_cast<std::size_t>(this->handles_));
      for (Index tile = begin; tile < end; ++tile)
      {
        std::fill(is_used.begin(), is_used.end(), 0);
        for (Index v = tile * lanes; v < std::min((tile + 1) * lanes, rows); ++v)
        {
          row.assign_row(weights, v);
          for (const Index j : row.columns())
          {
            is_used[static_cast<std::size_t>(j)] = 1;
          }
        }
        for (std::size_t j = 0; j < is_used.size(); ++j)
        {
          if (is_used[j])
          {
            columns[static_cast<std::size_t>(tile)].push_back(static_cast<std::int32_t>(j));
          }
        }
      }
    });
  if (!done)
  {
    return false;
  }
  tiles = WeightTiles<Scalar>();
  for (const std::vector<std::int32_t>& tile_columns : columns)
  {
    tiles.columns.insert(tiles.columns.end(), tile_columns.begin(), tile_columns.end());
    tiles.start.push_back(static_cast<Index>(tiles.columns.size()));
  }
  tiles.weights.assign(tiles.columns.size() * static_cast<std::size_t>(lanes), Scalar(0));
  this->reference_handles_.assign(static_cast<std::size_t>(count * lanes), 0);
  return parallel_for(context, rows, skinning_block,
    [&](Index begin, Index end)
    {
      PrunedRow row(options);
      for (Index v = begin; v < end; ++v)
      {
        row.assign_row(weights, v);
        Index k = tiles.start[static_cast<std::size_t>(tiles.tile_of(v))];
        Index largest = -1;
        for (const Index j : row.columns())
        {
          while (tiles.columns[static_cast<std::size_t>(k)] != j)
          {
            ++k;
          }
          tiles.weights[static_cast<std::size_t>(tiles.weight_of(k, tiles.lane_of(v)))] =
            static_cast<Scalar>(row.factor() * weights(v, j));
          largest = largest < 0 || weights(v, j) > weights(v, largest) ? j : largest;
        }
        this->reference_handles_[static_cast<std::size_t>(v)] =
          static_cast<std::int32_t>(std::max<Index>(largest, 0));
      }
    });
}

Status Skinning::bind(
  ExecutionContext& context, WeightsView weights, const SkinningOptions& options)
{
  *this = Skinning();
  const Index rows = weights.rows(), cols = weights.cols();
  if (!(options.smallest_weight >= 0.0 && options.smallest_weight < 1.0) || options.influences < 0)
  {
    return Status::invalid_input("the smallest weight must be at least 0 and less than 1, and the "
                                 "number of influences at least 0");
  }
  struct Block
  {
    Index nonfinite_entry = -1;
    Index worst_row = 0, inexact_rows = 0, count = 0, dropped = 0;
    double error = 0.0, largest_dropped_weight = 0.0;
  };
  std::vector<Block> blocks(static_cast<std::size_t>((rows + skinning_block - 1) / skinning_block));
  bool done = parallel_for(context, rows, skinning_block,
    [&](Index begin, Index end)
    {
      Block& block = blocks[static_cast<std::size_t>(begin / skinning_block)];
      PrunedRow row(options);
      for (Index v = begin; v < end; ++v)
      {
        for (Index j = 0; j < cols && block.nonfinite_entry < 0; ++j)
        {
          block.nonfinite_entry = std::isfinite(weights(v, j)) ? -1 : v * cols + j;
        }
        row.assign_row(weights, v);
        const double error = std::abs(row.row_sum() - 1.0);
        block.worst_row = v == begin || error > block.error ? v : block.worst_row;
        block.error = v == begin ? error : std::max(block.error, error);
        block.inexact_rows += error > row_sum_tolerance ? 1 : 0;
        block.count += static_cast<Index>(row.columns().size());
        block.dropped += row.dropped();
        block.largest_dropped_weight = std::max(block.largest_dropped_weight, row.dropped_weight());
      }
    });
  if (!done)
  {
    return Status::canceled();
  }
  Block all;
  for (const Block& block : blocks)
  {
    if (block.nonfinite_entry >= 0)
    {
      return Status::invalid_input("the weight of vertex " +
        std::to_string(block.nonfinite_entry / cols) + " in column " +
        std::to_string(block.nonfinite_entry % cols) + " is not a finite number");
    }
    all.worst_row = block.error > all.error ? block.worst_row : all.worst_row;
    all.error = std::max(all.error, block.error);
    all.inexact_rows += block.inexact_rows;
    all.count += block.count;
    all.dropped += block.dropped;
    all.largest_dropped_weight = std::max(all.largest_dropped_weight, block.largest_dropped_weight);
  }
  this->center_ = options.center;
  this->vertices_ = rows;
  this->handles_ = cols;
  this->weight_count_ = all.count;
  this->is_single_precision_ = options.single_precision;
  done = this->is_single_precision_ ? this->pack(context, weights, options, this->single_tiles_)
                                    : this->pack(context, weights, options, this->double_tiles_);
  if (!done)
  {
    *this = Skinning();
    return Status::canceled();
  }
  Status status;
  status.report.set("row_sum_error", Report::Value(all.error));
  if (options.smallest_weight > 0.0 || options.influences > 0)
  {
    status.report.set("counts.dropped_weights", Report::Value(all.dropped));
    status.report.set("dropped_share", Report::Value(all.largest_dropped_weight));
  }
  if (all.inexact_rows > 0)
  {
    status.warnings.push_back("the weights of " + std::to_string(all.inexact_rows) + " of " +
      std::to_string(rows) + " vertices do not sum to one (worst: vertex " +
      std::to_string(all.worst_row) + ", off by " + std::to_string(all.error) +
      "); the missing weight is applied to the rest position");
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

Status Skinning::check_pivots(PointsView pivots) const
{
  return pivots.rows() == this->handles_
    ? Status()
    : Status::invalid_input("there are " + std::to_string(pivots.rows()) +
        " pivots, but the weights have " + std::to_string(this->handles_) + " columns");
}

template <typename Scalar>
bool Skinning::blend_affine(ExecutionContext& context, PointsView rest,
  const std::vector<Affine>& transforms, bool normals, PointsOutput output) const
{
  const WeightTiles<Scalar>& tiles = this->tiles<Scalar>();
  constexpr Index lanes = WeightTiles<Scalar>::lanes;
  const Vec3 center = normals ? Vec3::Zero() : this->center_of(rest);
  const auto moves = displacements<Scalar>(transforms, center);
  Eigen::Map<Points> posed = output.resized(rest.rows());
  return parallel_for(context, rest.rows(), skinning_block,
    [&](Index begin, Index end)
    {
      BlendedTile<Scalar, 12> blended;
      for (Index v = begin; v < end; v += lanes)
      {
        const Index count = std::min(lanes, end - v);
        if (!normals)
        {
          blend_points_of_tile(
            tiles, v / lanes, moves, center, rest.data() + 3 * v, count, posed.data() + 3 * v);
          continue;
        }
        blend_tile(tiles, v / lanes, moves, nullptr, blended);
        for (Index i = 0; i < count; ++i)
        {
          const Eigen::Matrix3d linear =
            Eigen::Matrix3d::Identity() + affine_of(blended, i).template leftCols<3>();
          const Vec3 n = rest.row(v + i);
          posed.row(v + i) = transform_normal(linear, n).transpose();
        }
      }
    });
}

Status Skinning::linear_blend(ExecutionContext& context, PointsView rest,
  const std::vector<Affine>& transforms, PointsOutput output) const
{
  const Status status = this->check(rest, transforms);
  if (!status.ok())
  {
    return status;
  }
  const bool done = this->is_single_precision_
    ? this->blend_affine<float>(context, rest, transforms, false, output)
    : this->blend_affine<double>(context, rest, transforms, false, output);
  return done ? status : Status::canceled();
}

Status Skinning::linear_blend_many(ExecutionContext& context, PointsView rest,
  const std::vector<std::vector<Affine>>& transforms, std::vector<FloatPoints>& posed,
  const std::vector<Affine>& placements) const
{
  std::vector<float*> rows;
  posed.resize(transforms.size());
  for (FloatPoints& points : posed)
  {
    points.resize(rest.rows(), 3);
    rows.push_back(points.data());
  }
  return this->linear_blend_many(context, rest, transforms, rows, placements);
}

Status Skinning::linear_blend_many(ExecutionContext& context, PointsView rest,
  const std::vector<std::vector<Affine>>& transforms, const std::vector<float*>& posed,
  const std::vector<Affine>& placements) const
{
  if (!this->is_single_precision_)
  {
    return Status::invalid_input("posing many instances needs weights in single precision");
  }
  const auto check_instance_count = [&](std::size_t count, const char* phrase)
  {
    return count == transforms.size()
      ? Status()
      : Status::invalid_input("there are " + std::to_string(count) + phrase +
          std::to_string(transforms.size()) + " instances");
  };
  Status count_status = check_instance_count(posed.size(), " arrays of points for ");
  if (count_status.ok() && !placements.empty())
  {
    count_status = check_instance_count(placements.size(), " placements for ");
  }
  if (!count_status.ok())
  {
    return count_status;
  }
  constexpr Index lanes = WeightTiles<float>::lanes;
  const Vec3 center = this->center_of(rest);
  std::vector<BlendValues<float, 12>> moves;
  for (std::size_t i = 0; i < transforms.size(); ++i)
  {
    const Status status = this->check(rest, transforms[i]);
    if (!status.ok())
    {
      return status;
    }
    // The placement P is applied to the transforms: P (v + sum w (T v - v)) = P v + sum w L (T v -
    // v), where L is the linear part of P.
    std::vector<Affine> placed_transforms = transforms[i];
    for (std::size_t j = 0; !placements.empty() && j < placed_transforms.size(); ++j)
    {
      placed_transforms[j] = identity_affine() +
        placements[i].leftCols<3>() * (placed_transforms[j] - identity_affine());
    }
    moves.push_back(displacements<float>(placed_transforms, center));
  }
  const bool done = parallel_for(context, rest.rows(), skinning_block,
    [&](Index begin, Index end)
    {
      std::vector<TilePoints<float>> points(skinning_block / lanes), at(points.size());
      for (Index v = begin; v < end; v += lanes)
      {
        const auto tile = static_cast<std::size_t>((v - begin) / lanes);
        const Index count = std::min(lanes, end - v);
        load_points(rest.data() + 3 * v, count, center, points[tile]);
        load_points(rest.data() + 3 * v, count, Vec3::Zero(), at[tile]);
      }
      TilePoints<float> placed_points;
      for (std::size_t i = 0; i < moves.size(); ++i)
      {
        for (Index v = begin; v < end; v += lanes)
        {
          const auto tile = static_cast<std::size_t>((v - begin) / lanes);
          if (!placements.empty())
          {
            apply_placement(placements[i], at[tile], placed_points);
          }
          pose_tile(this->single_tiles_, v / lanes, moves[i], points[tile],
            placements.empty() ? at[tile] : placed_points, std::min(lanes, end - v),
            posed[i] + 3 * v);
        }
      }
    });
  return done ? Status() : Status::canceled();
}

Status Skinning::linear_blend_normals(ExecutionContext& context, PointsView rest_normals,
  const std::vector<Affine>& transforms, PointsOutput posed_normals) const
{
  const Status status = this->check(rest_normals, transforms);
  if (!status.ok())
  {
    return status;
  }
  const bool done = this->is_single_precision_
    ? this->blend_affine<float>(context, rest_normals, transforms, true, posed_normals)
    : this->blend_affine<double>(context, rest_normals, transforms, true, posed_normals);
  return done ? status : Status::canceled();
}

template <typename Scalar>
bool Skinning::blend_bones(ExecutionContext& context, PointsView rest,
  const std::vector<Affine>& transforms, const std::vector<BoneChange>& bones,
  WeightsView endpoints, PointsOutput output) const
{
  const WeightTiles<Scalar>& tiles = this->tiles<Scalar>();
  constexpr Index lanes = WeightTiles<Scalar>::lanes;
  const Vec3 center = this->center_of(rest);
  const auto moves = displacements<Scalar>(transforms, center);
  const auto frames = bone_frames<Scalar>(bones, transforms, center);
  Eigen::Map<Points> posed = output.resized(rest.rows());
  return parallel_for(context, rest.rows(), skinning_block,
    [&](Index begin, Index end)
    {
      BlendedTile<Scalar, 12> blended;
      TilePoints<Scalar> points, moved;
      for (Index v = begin; v < end; v += lanes)
      {
        const Index count = std::min(lanes, end - v);
        blend_tile(tiles, v / lanes, moves, nullptr, blended);
        load_points(rest.data() + 3 * v, count, center, points);
        affine_moves(blended, points, moved);
        add_bone_moves(tiles, frames, endpoints, v, count, points, moved);
        store_moved(rest.data() + 3 * v, count, moved, posed.data() + 3 * v);
      }
    });
}

Status Skinning::stretchable_bones(ExecutionContext& context, PointsView rest,
  const std::vector<Affine>& transforms, const std::vector<BoneChange>& bones,
  WeightsView endpoints, PointsOutput output) const
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
    status = Status::invalid_input("the endpoint weights have size " +
      std::to_string(endpoints.rows()) + " x " + std::to_string(endpoints.cols()) +
      ", but there are " + std::to_string(rest.rows()) + " vertices and " +
      std::to_string(this->handles_) + " handles");
  }
  if (!status.ok())
  {
    return status;
  }
  const bool done = this->is_single_precision_
    ? this->blend_bones<float>(context, rest, transforms, bones, endpoints, output)
    : this->blend_bones<double>(context, rest, transforms, bones, endpoints, output);
  return done ? status : Status::canceled();
}

template <typename Scalar>
bool Skinning::blend_dual(ExecutionContext& context, PointsView rest,
  const std::vector<Affine>& transforms, PointsView pivots, bool normals, PointsOutput output) const
{
  const WeightTiles<Scalar>& tiles = this->tiles<Scalar>();
  constexpr Index lanes = WeightTiles<Scalar>::lanes;
  const Vec3 center = normals ? Vec3::Zero() : this->center_of(rest);
  // Each transform x -> L x + t is split: first the scale and shear x -> c + P (x - c) about the
  // pivot c, then the rigid motion y -> R y + u.
  std::vector<Affine> shears(transforms.size());
  std::vector<DualQuaternion> motions(transforms.size());
  BlendValues<Scalar, 8> quaternions;
  bool any_shear = false;
  for (std::size_t j = 0; j < transforms.size(); ++j)
  {
    const Vec3 c = pivots.row(static_cast<Index>(j));
    const auto [rotation, shear] = split(transforms[j].leftCols<3>());
    any_shear = any_shear || !shear.isZero(0.0);
    shears[j].leftCols<3>() = Eigen::Matrix3d::Identity() + shear;
    shears[j].col(3) = -shear * c;
    const Vec3 translation = transforms[j].col(3) + rotation * (shear * c);
    motions[j] =
      dual_quaternion_of(rotation, translation + (rotation - Eigen::Matrix3d::Identity()) * center);
    for (int e = 0; e < 8; ++e)
    {
      quaternions.values.push_back(
        static_cast<Scalar>(e < 4 ? motions[j].real[e] : motions[j].dual[e - 4]));
    }
  }
  set_signs(motions, quaternions);
  const auto shear_moves = displacements<Scalar>(shears, center);
  Eigen::Map<Points> posed = output.resized(rest.rows());
  return parallel_for(context, rest.rows(), skinning_block,
    [&](Index begin, Index end)
    {
      BlendedTile<Scalar, 12> sheared;
      BlendedTile<Scalar, 8> blended;
      TilePoints<Scalar> points, moved, first;
      Points transformed_normals; // normals after scale and shear
      for (Index v = begin; v < end; v += lanes)
      {
        const Index count = std::min(lanes, end - v);
        const double* from = rest.data() + 3 * v;
        double* to = posed.data() + 3 * v;
        blend_tile(tiles, v / lanes, quaternions, this->reference_handles_.data() + v, blended);
        if (any_shear)
        {
          blend_tile(tiles, v / lanes, shear_moves, nullptr, sheared);
        }
        if (normals && any_shear)
        {
          transformed_normals.resize(count, 3);
          for (Index i = 0; i < count; ++i)
          {
            const Eigen::Matrix3d linear =
              Eigen::Matrix3d::Identity() + affine_of(sheared, i).template leftCols<3>();
            transformed_normals.row(i) =
              transform_normal(linear, Vec3(rest.row(v + i))).transpose();
          }
          from = transformed_normals.data();
        }
        if (normals)
        {
          // Set the dual parts to zero, because directions are not translated.
          std::fill(&blended.sums[4][0], &blended.sums[4][0] + 4 * lanes, Scalar(0));
        }
        load_points(from, count, center, points);
        if (any_shear && !normals)
        {
          affine_moves(sheared, points, first);
          add(first, points);
          dual_quaternion_moves(blended, points, moved);
          add(first, moved);
        }
        else
        {
          dual_quaternion_moves(blended, points, moved);
        }
        store_moved(from, count, moved, to);
      }
    });
}

Status Skinning::dual_quaternion(ExecutionContext& context, PointsView rest,
  const std::vector<Affine>& transforms, PointsView pivots, PointsOutput output) const
{
  Status status = this->check(rest, transforms);
  status = status.ok() ? this->check_pivots(pivots) : status;
  if (!status.ok())
  {
    return status;
  }
  const bool done = this->is_single_precision_
    ? this->blend_dual<float>(context, rest, transforms, pivots, false, output)
    : this->blend_dual<double>(context, rest, transforms, pivots, false, output);
  return done ? status : Status::canceled();
}

Status Skinning::dual_quaternion_normals(ExecutionContext& context, PointsView rest_normals,
  const std::vector<Affine>& transforms, PointsView pivots, PointsOutput posed_normals) const
{
  Status status = this->check(rest_normals, transforms);
  status = status.ok() ? this->check_pivots(pivots) : status;
  if (!status.ok())
  {
    return status;
  }
  const bool done = this->is_single_precision_
    ? this->blend_dual<float>(context, rest_normals, transforms, pivots, true, posed_normals)
    : this->blend_dual<double>(context, rest_normals, transforms, pivots, true, posed_normals);
  return done ? status : Status::canceled();
}

/// Blend rotations about centers.
/// @param centers if null, `rest` contains normals instead of points.
template <typename Scalar>
bool Skinning::blend_about(ExecutionContext& context, PointsView rest,
  const std::vector<Affine>& transforms, const PointsView* centers, PointsOutput output) const
{
  const WeightTiles<Scalar>& tiles = this->tiles<Scalar>();
  constexpr Index lanes = WeightTiles<Scalar>::lanes;
  const Vec3 middle = centers ? this->center_of(*centers) : Vec3::Zero();
  const auto moves = displacements<Scalar>(transforms, middle);
  std::vector<Affine> shears;
  std::vector<DualQuaternion> motions;
  BlendValues<Scalar, 8> quaternions; // the dual parts are zero because only rotations are blended
  bool any_shear = false;
  for (const Affine& transform : transforms)
  {
    const SplitMap map = split(transform.leftCols<3>());
    any_shear = any_shear || !map.shear.isZero(0.0);
    shears.push_back(identity_affine());
    shears.back().leftCols<3>() += map.shear;
    motions.push_back(dual_quaternion_of(map.rotation, Vec3::Zero()));
    for (int e = 0; e < 8; ++e)
    {
      quaternions.values.push_back(static_cast<Scalar>(e < 4 ? motions.back().real[e] : 0.0));
    }
  }
  set_signs(motions, quaternions);
  const auto shear_moves = displacements<Scalar>(shears, Vec3::Zero());
  Eigen::Map<Points> posed = output.resized(rest.rows());
  return parallel_for(context, rest.rows(), skinning_block,
    [&](Index begin, Index end)
    {
      BlendedTile<Scalar, 12> moved, sheared;
      BlendedTile<Scalar, 8> rotation_tile;
      for (Index v = begin; v < end; v += lanes)
      {
        const Index count = std::min(lanes, end - v);
        blend_tile(
          tiles, v / lanes, quaternions, this->reference_handles_.data() + v, rotation_tile);
        if (any_shear)
        {
          blend_tile(tiles, v / lanes, shear_moves, nullptr, sheared);
        }
        if (centers)
        {
          blend_tile(tiles, v / lanes, moves, nullptr, moved);
        }
        for (Index i = 0; i < count; ++i)
        {
          Eigen::Vector4d q(rotation_tile.sums[0][i], rotation_tile.sums[1][i],
            rotation_tile.sums[2][i], rotation_tile.sums[3][i]);
          const double length = q.norm();
          q = length > 1e-300 ? Eigen::Vector4d(q / length) : Eigen::Vector4d(0, 0, 0, 1);
          const Vec3 axis = q.head<3>();
          const Eigen::Matrix3d shear = any_shear
            ? Eigen::Matrix3d(affine_of(sheared, i).template leftCols<3>())
            : Eigen::Matrix3d(Eigen::Matrix3d::Zero());
          if (!centers)
          {
            const Eigen::Matrix3d linear =
              Eigen::Quaterniond(q).toRotationMatrix() * (Eigen::Matrix3d::Identity() + shear);
            posed.row(v + i) = transform_normal(linear, Vec3(rest.row(v + i))).transpose();
            continue;
          }
          // Only displacements are added, so that a handle that does not move contributes exactly
          // zero.
          const Vec3 center = centers->row(v + i);
          const Affine move = affine_of(moved, i);
          const Vec3 arm = rest.row(v + i).transpose() - center;
          const Vec3 longer = shear * arm;
          const Vec3 across = axis.cross(arm + longer);
          posed.row(v + i) = rest.row(v + i) +
            (move.leftCols<3>() * (center - middle) + move.col(3) + longer +
              2.0 * (q[3] * across + axis.cross(across)))
              .transpose();
        }
      }
    });
}

Status Skinning::centers_of_rotation(ExecutionContext& context, PointsView rest,
  const std::vector<Affine>& transforms, PointsView centers, PointsOutput output) const
{
  Status status = this->check(rest, transforms);
  if (status.ok() && centers.rows() != rest.rows())
  {
    status = Status::invalid_input("there are " + std::to_string(centers.rows()) +
      " centers of rotation for " + std::to_string(rest.rows()) + " vertices");
  }
  if (!status.ok())
  {
    return status;
  }
  const bool done = this->is_single_precision_
    ? this->blend_about<float>(context, rest, transforms, &centers, output)
    : this->blend_about<double>(context, rest, transforms, &centers, output);
  return done ? status : Status::canceled();
}

Status Skinning::centers_of_rotation_normals(ExecutionContext& context, PointsView rest_normals,
  const std::vector<Affine>& transforms, PointsOutput posed_normals) const
{
  const Status status = this->check(rest_normals, transforms);
  if (!status.ok())
  {
    return status;
  }
  const bool done = this->is_single_precision_
    ? this->blend_about<float>(context, rest_normals, transforms, nullptr, posed_normals)
    : this->blend_about<double>(context, rest_normals, transforms, nullptr, posed_normals);
  return done ? status : Status::canceled();
}

Status skinning_transforms(
  const Handles& handles, const Pose& pose, std::vector<Affine>& transforms)
{
  Status status;
  transforms.assign(handles.size(), identity_affine());
  std::vector<Index> free;
  for (std::size_t h = 0; h < handles.size(); ++h)
  {
    if (constrains_transform(pose[h].mode) || pose[h].mode == HandleMode::ends)
    {
      transforms[h] = pose[h].transform;
    }
    else if (pose[h].mode == HandleMode::position)
    {
      transforms[h].col(3) = posed_pivot(handles[h], pose[h]) - handles[h].head;
    }
    else if (pose[h].mode == HandleMode::tail)
    {
      transforms[h].col(3) = posed_tail(handles[h], pose[h]) - handles[h].tail;
    }
    else
    {
      free.push_back(static_cast<Index>(h));
    }
  }
  if (!free.empty())
  {
    status.warnings.push_back(
      "skinning cannot compute transforms of free handles; these handles stay at rest: " +
      quoted_names(handles, free));
  }
  return status;
}

std::vector<BoneChange> bone_changes(const Handles& handles, const Pose& pose)
{
  std::vector<BoneChange> changes(handles.size());
  for (std::size_t h = 0; h < handles.size(); ++h)
  {
    if (handles[h].kind == HandleKind::bone &&
      (constrains_transform(pose[h].mode) || pose[h].mode == HandleMode::ends))
    {
      changes[h] = { handles[h].head, handles[h].tail - handles[h].head, pose[h].stretch,
        pose[h].twist };
    }
  }
  return changes;
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
