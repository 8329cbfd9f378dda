// Pose time of reduced as-rigid-as-possible.
//
// With displacements D from rest (V' = V + M D) and Q = R - I for the rotations, the energy is
//     E(D, Q) = 1/2 <D, L D> - <Q, S0 + K D>,   L, K, S0 projected at bind time,
// because rest with R = I is a minimum: all constant and linear terms cancel. The unknowns are
// split into given ones (blocks of full handles) and open ones D = D* + response K^T Q, where D*
// meets the positions with Q = 0 and response = Z (Z^T L Z)^+ Z^T keeps them met (Z spans what the
// positions leave open). One iteration is
//     S = S* + K (response K^T Q)        a product each with two dense matrices made once
//     Q = best rotations of S - I        the local step
// and the energies after both half-steps follow from Q, S and S* alone:
//     after a global step  E = E* - 1/2 <Q, S + S*>,
//     after a local step   E = E* + 1/2 <Q_before, S - S*> - <Q, S>,   E* = 1/2 <D*, L D*>.
//
// Ranks are decided where the matrices are small: positions by a pivoted QR, the rest by a
// Cholesky factor that gives way to an eigenvalue decomposition when it finds itself
// ill-conditioned. What neither energy nor constraints see stays at rest.
#include "pose/reduced_arap.h"

#include "base/simd.h"
#include "pose/pivot_rotation.h"
#include "pose/rotation_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <chrono>
#include <cmath>
#include <cstring>

namespace bindpose
{

namespace
{
/// Directions below this share of the largest eigenvalue count as seen by no energy.
constexpr double energy_rank = 1e-12;
/// Positions below this share of the largest pivot count as redundant.
constexpr double position_rank = 1e-9;
/// A position missed by more than this share of the diagonal contradicts others.
constexpr double contradiction = 1e-9;
/// Below this share of the rest energy an energy counts as zero for the tolerance.
constexpr double nothing_bends = 1e-6;

constexpr Index tile = 8;

/// y0, y1, y2 += A x0, A x1, A x2 for rows in whole tiles, columns `stride` apart.
BINDPOSE_SIMD_CLONES void multiply_add_tiles(Index rows, Index cols, Index stride,
  const double* __restrict a, const double* x0, const double* x1, const double* x2,
  double* __restrict y0, double* __restrict y1, double* __restrict y2)
{
  typedef double Pack __attribute__((vector_size(tile * sizeof(double)), aligned(8), may_alias));
  Index r = 0;
  for (; r + 2 * tile <= rows; r += 2 * tile)
  {
    Pack s0 = *reinterpret_cast<const Pack*>(y0 + r), t0 = *reinterpret_cast<Pack*>(y0 + r + tile);
    Pack s1 = *reinterpret_cast<const Pack*>(y1 + r), t1 = *reinterpret_cast<Pack*>(y1 + r + tile);
    Pack s2 = *reinterpret_cast<const Pack*>(y2 + r), t2 = *reinterpret_cast<Pack*>(y2 + r + tile);
    for (Index c = 0; c < cols; ++c)
    {
      const Pack u = *reinterpret_cast<const Pack*>(a + c * stride + r);
      const Pack v = *reinterpret_cast<const Pack*>(a + c * stride + r + tile);
      s0 += u * x0[c];
      t0 += v * x0[c];
      s1 += u * x1[c];
      t1 += v * x1[c];
      s2 += u * x2[c];
      t2 += v * x2[c];
    }
    *reinterpret_cast<Pack*>(y0 + r) = s0;
    *reinterpret_cast<Pack*>(y0 + r + tile) = t0;
    *reinterpret_cast<Pack*>(y1 + r) = s1;
    *reinterpret_cast<Pack*>(y1 + r + tile) = t1;
    *reinterpret_cast<Pack*>(y2 + r) = s2;
    *reinterpret_cast<Pack*>(y2 + r + tile) = t2;
  }
  for (; r < rows; r += tile)
  {
    Pack s0 = *reinterpret_cast<const Pack*>(y0 + r);
    Pack s1 = *reinterpret_cast<const Pack*>(y1 + r);
    Pack s2 = *reinterpret_cast<const Pack*>(y2 + r);
    for (Index c = 0; c < cols; ++c)
    {
      const Pack u = *reinterpret_cast<const Pack*>(a + c * stride + r);
      s0 += u * x0[c];
      s1 += u * x1[c];
      s2 += u * x2[c];
    }
    *reinterpret_cast<Pack*>(y0 + r) = s0;
    *reinterpret_cast<Pack*>(y1 + r) = s1;
    *reinterpret_cast<Pack*>(y2 + r) = s2;
  }
}

Index padded(Index count)
{
  return (count + tile - 1) / tile * tile;
}
} // namespace

void ReducedArap::Tall::assign(const Eigen::MatrixXd& matrix)
{
  this->rows = matrix.rows();
  this->cols = matrix.cols();
  this->stride = padded(this->rows);
  this->values.assign(static_cast<std::size_t>(this->stride * this->cols), 0.0);
  for (Index c = 0; c < this->cols; ++c)
  {
    std::copy_n(matrix.data() + c * this->rows, this->rows,
      this->values.begin() + static_cast<std::ptrdiff_t>(c * this->stride));
  }
}

void ReducedArap::Tall::multiply_add(const double* const (&x)[3], double* const (&y)[3]) const
{
  multiply_add_tiles(this->stride, this->cols, this->stride, this->values.data(), x[0], x[1], x[2],
    y[0], y[1], y[2]);
}

Eigen::Matrix<double, 4, 3> ReducedArap::block_of(const Affine& transform, Index column) const
{
  const auto j = static_cast<std::size_t>(column);
  const Eigen::Matrix3d linear = transform.leftCols<3>() - Eigen::Matrix3d::Identity();
  Eigen::Matrix<double, 4, 3> block;
  block.topRows<3>() = this->sizes_[j] * linear.transpose();
  block.row(3) = (linear * this->centers_[j] + transform.col(3)).transpose();
  return block;
}

Affine ReducedArap::affine_of(
  const Eigen::Ref<const Eigen::Matrix<double, 4, 3>>& block, Index column) const
{
  const auto j = static_cast<std::size_t>(column);
  const Eigen::Matrix3d linear = block.topRows<3>().transpose() / this->sizes_[j];
  Affine transform;
  transform.leftCols<3>() = Eigen::Matrix3d::Identity() + linear;
  transform.col(3) = block.row(3).transpose() - linear * this->centers_[j];
  return transform;
}

void ReducedArap::factor(const Pose& pose)
{
  this->modes_.clear();
  this->open_.clear();
  this->positions_.clear();
  this->redundant_.clear();
  for (Index h = 0; h < static_cast<Index>(pose.size()); ++h)
  {
    const HandleMode mode = pose[static_cast<std::size_t>(h)].mode;
    this->modes_.push_back(mode);
    if (mode == HandleMode::position)
    {
      this->positions_.push_back(h);
    }
  }
  for (Index j = 0; j < this->columns_; ++j)
  {
    if (j >= static_cast<Index>(pose.size()) ||
      this->modes_[static_cast<std::size_t>(j)] != HandleMode::full)
    {
      for (Index a = 0; a < 4; ++a)
      {
        this->open_.push_back(4 * j + a);
      }
    }
  }
  const auto size = static_cast<Index>(this->open_.size());
  const auto asked = static_cast<Index>(this->positions_.size());
  Eigen::MatrixXd stiffness(size, size), covariance(this->covariance_.rows(), size),
    rows(asked, size);
  for (Index c = 0; c < size; ++c)
  {
    // Unknowns in units in which a column of M has size one; an empty column drops out.
    const Index from = this->open_[static_cast<std::size_t>(c)];
    const double scale = this->basis_scale_[from];
    for (Index r = 0; r < size; ++r)
    {
      const Index row = this->open_[static_cast<std::size_t>(r)];
      stiffness(r, c) = scale * this->basis_scale_[row] * this->stiffness_(row, from);
    }
    covariance.col(c) = this->covariance_.col(from);
    for (Index r = 0; r < asked; ++r)
    {
      rows(r, c) = scale * this->pivot_rows_(this->positions_[static_cast<std::size_t>(r)], from);
    }
  }

  // Positions: D = particular b + Z z with rows Z = 0; Z is the tail of the orthogonal factor.
  Eigen::MatrixXd free_space = Eigen::MatrixXd::Identity(size, size);
  this->particular_ = Eigen::MatrixXd::Zero(size, asked);
  if (asked > 0 && size > 0)
  {
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(rows.transpose());
    qr.setThreshold(position_rank);
    const Index rank = qr.rank();
    const Eigen::MatrixXd orthogonal = qr.householderQ();
    free_space = orthogonal.rightCols(size - rank);
    for (Index r = rank; r < asked; ++r)
    {
      this->redundant_.push_back(
        this->positions_[static_cast<std::size_t>(qr.colsPermutation().indices()[r])]);
    }
    if (rank > 0)
    {
      const Eigen::MatrixXd reduced = rows * orthogonal.leftCols(rank); // full column rank
      this->particular_ = orthogonal.leftCols(rank) *
        reduced.colPivHouseholderQr().solve(Eigen::MatrixXd::Identity(asked, asked));
    }
  }
  const Eigen::MatrixXd reduced = free_space.transpose() * stiffness * free_space;
  this->response_ = Eigen::MatrixXd::Zero(size, size);
  if (reduced.rows() > 0)
  {
    const Eigen::LLT<Eigen::MatrixXd> llt(reduced);
    if (llt.info() == Eigen::Success && llt.rcond() > 1e3 * energy_rank)
    {
      this->response_ = free_space * llt.solve(free_space.transpose());
    }
    else
    {
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(reduced);
      const double largest = std::max(eigen.eigenvalues().maxCoeff(), 0.0);
      const Eigen::VectorXd inverse = eigen.eigenvalues().unaryExpr(
        [largest](double x) { return x > energy_rank * largest ? 1.0 / x : 0.0; });
      const Eigen::MatrixXd modes = free_space * eigen.eigenvectors();
      this->response_ = modes * inverse.asDiagonal() * modes.transpose();
    }
  }
  for (Index r = 0; r < size; ++r)
  {
    const double scale = this->basis_scale_[this->open_[static_cast<std::size_t>(r)]];
    this->particular_.row(r) *= scale;
    this->response_.row(r) *= scale;
    this->response_.col(r) *= scale;
  }
  const Index clusters = this->groups_.count;
  for (Index i = 0; i < 3; ++i)
  {
    const Eigen::MatrixXd part = covariance.middleRows(i * clusters, clusters);
    this->covariance_open_[static_cast<std::size_t>(i)].assign(part);
    this->gamma_[static_cast<std::size_t>(i)].assign(this->response_ * part.transpose());
  }
}

/// A first guess without history: each cluster turns as the full handles near it do; what is near
/// other handles takes the rotation that fits all pivots, and the full handles' frames, best.
void ReducedArap::start_rotations(const Pose& pose)
{
  const double reach = 0.3 * this->radius_; // the size of a full handle's frame
  const Eigen::Matrix3d common = pivot_rotation(this->handles_, pose, reach);
  for (Index k = 0; k < this->groups_.count; ++k)
  {
    Eigen::Matrix3d blend = 1e-9 * common;
    for (std::size_t h = 0; h < pose.size(); ++h)
    {
      const double w = this->cluster_weights_(k, static_cast<Index>(h));
      blend += w *
        (pose[h].mode == HandleMode::full ? Eigen::Matrix3d(pose[h].transform.leftCols<3>())
                                          : common);
    }
    Eigen::Matrix3d rotation = common;
    fit_rotation(blend.transpose(), rotation);
    for (Index i = 0; i < 3; ++i)
    {
      for (Index j = 0; j < 3; ++j)
      {
        this->rotations_[static_cast<std::size_t>((3 * i + j) * this->stride_ + k)] =
          rotation(i, j);
      }
    }
  }
}

/// s += K d for the open unknowns.
void ReducedArap::covariances(const std::vector<double>& d, std::vector<double>& s) const
{
  const auto length = static_cast<Index>(d.size()) / 3;
  const double* const x[3] = { d.data(), d.data() + length, d.data() + 2 * length };
  for (Index i = 0; i < 3; ++i)
  {
    double* const y[3] = { s.data() + 3 * i * this->stride_, s.data() + (3 * i + 1) * this->stride_,
      s.data() + (3 * i + 2) * this->stride_ };
    this->covariance_open_[static_cast<std::size_t>(i)].multiply_add(x, y);
  }
}

/// sum_k tr(Q_k S_k): entry (i, j) of Q meets entry (j, i) of S.
double ReducedArap::paired(const std::vector<double>& q, const std::vector<double>& s) const
{
  double sum = 0.0;
  for (Index i = 0; i < 3; ++i)
  {
    for (Index j = 0; j < 3; ++j)
    {
      const double* a = q.data() + (3 * i + j) * this->stride_;
      const double* b = s.data() + (3 * j + i) * this->stride_;
      double part = 0.0;
      for (Index k = 0; k < this->groups_.count; ++k)
      {
        part += a[k] * b[k];
      }
      sum += part;
    }
  }
  return sum;
}

Status ReducedArap::solve(ExecutionContext& context, const Pose& pose, const SolveOptions& options)
{
  Status status = check_pose(this->handles_, pose);
  if (!status.ok())
  {
    return status;
  }
  if (!same_modes(this->modes_, pose))
  {
    this->factor(pose);
  }
  if (!this->redundant_.empty())
  {
    status.warnings.push_back(
      "these positions are redundant (others determine them, or no weight is there): " +
      quoted_names(this->handles_, this->redundant_));
  }

  // What this pose gives: blocks of full handles, targets of positions.
  const auto size = static_cast<Index>(this->open_.size());
  const Index length = padded(size), clusters = this->groups_.count;
  Eigen::Matrix<double, Eigen::Dynamic, 3> d =
    Eigen::Matrix<double, Eigen::Dynamic, 3>::Zero(4 * this->columns_, 3);
  for (std::size_t h = 0; h < pose.size(); ++h)
  {
    if (pose[h].mode == HandleMode::full)
    {
      const auto j = static_cast<Index>(h);
      d.middleRows<4>(4 * j) = this->block_of(pose[h].transform, j);
    }
  }
  const auto asked = static_cast<Index>(this->positions_.size());
  Eigen::Matrix<double, Eigen::Dynamic, 3> wanted(asked, 3), target(asked, 3);
  for (Index r = 0; r < asked; ++r)
  {
    const Index h = this->positions_[static_cast<std::size_t>(r)];
    const Vec3 pivot = this->handles_[static_cast<std::size_t>(h)].head;
    wanted.row(r) =
      (pose[static_cast<std::size_t>(h)].transform * pivot.homogeneous() - pivot).transpose();
    target.row(r) = wanted.row(r) - this->pivot_rows_.row(h) * d;
  }
  // D*: the positions met, then the given blocks and that answered with Q = 0.
  Eigen::Matrix<double, Eigen::Dynamic, 3> star = d;
  const Eigen::Matrix<double, Eigen::Dynamic, 3> met = this->particular_ * target;
  for (Index r = 0; r < size; ++r)
  {
    star.row(this->open_[static_cast<std::size_t>(r)]) = met.row(r);
  }
  const Eigen::Matrix<double, Eigen::Dynamic, 3> force = this->stiffness_ * star;
  Eigen::Matrix<double, Eigen::Dynamic, 3> open_force(size, 3);
  for (Index r = 0; r < size; ++r)
  {
    open_force.row(r) = force.row(this->open_[static_cast<std::size_t>(r)]);
  }
  const Eigen::Matrix<double, Eigen::Dynamic, 3> answer = this->response_ * open_force;
  std::vector<double> star_open(static_cast<std::size_t>(3 * length), 0.0);
  for (Index r = 0; r < size; ++r)
  {
    const Index row = this->open_[static_cast<std::size_t>(r)];
    star.row(row) -= answer.row(r);
    for (Index j = 0; j < 3; ++j)
    {
      star_open[static_cast<std::size_t>(j * length + r)] = star(row, j);
    }
  }
  const double star_energy = 0.5 * (star.array() * (this->stiffness_ * star).array()).sum();
  std::vector<double> star_covariance = this->rest_covariance_;
  {
    const Eigen::Matrix<double, Eigen::Dynamic, 3> given = this->covariance_ * star;
    for (Index i = 0; i < 3; ++i)
    {
      for (Index j = 0; j < 3; ++j)
      {
        for (Index k = 0; k < clusters; ++k)
        {
          star_covariance[static_cast<std::size_t>((3 * i + j) * this->stride_ + k)] +=
            given(i * clusters + k, j);
        }
      }
    }
  }

  if (options.start == Start::rest)
  {
    for (Index e = 0; e < 9; ++e)
    {
      std::fill_n(this->rotations_.begin() + static_cast<std::ptrdiff_t>(e * this->stride_),
        clusters, e % 4 == 0 ? 1.0 : 0.0);
    }
  }
  else if (options.start == Start::guess || !this->warm_)
  {
    this->start_rotations(pose);
  }
  std::vector<double> q(this->rotations_.size(), 0.0), before(q), s(q), moved(q.size(), 0.0);
  std::vector<double> open(static_cast<std::size_t>(3 * length), 0.0);
  const auto take_rotations = [&]
  {
    for (Index e = 0; e < 9; ++e)
    {
      for (Index k = 0; k < clusters; ++k)
      {
        const auto at = static_cast<std::size_t>(e * this->stride_ + k);
        q[at] = this->rotations_[at] - (e % 4 == 0 ? 1.0 : 0.0);
      }
    }
  };
  const auto global_step = [&]
  {
    std::fill(open.begin(), open.end(), 0.0);
    double* const y[3] = { open.data(), open.data() + length, open.data() + 2 * length };
    for (Index i = 0; i < 3; ++i)
    {
      // Row i of S goes with column i of the rotations: rotations are stacked transposed.
      const double* const x[3] = { q.data() + i * this->stride_, q.data() + (3 + i) * this->stride_,
        q.data() + (6 + i) * this->stride_ };
      this->gamma_[static_cast<std::size_t>(i)].multiply_add(x, y);
    }
    std::fill(moved.begin(), moved.end(), 0.0);
    this->covariances(open, moved);
    for (std::size_t e = 0; e < s.size(); ++e)
    {
      s[e] = star_covariance[e] + moved[e];
    }
  };
  take_rotations();
  global_step();
  const auto energy_after_global = [&]
  { return star_energy - this->paired(q, star_covariance) - 0.5 * this->paired(q, moved); };
  this->energies_.assign(1, energy_after_global());
  const double floor = nothing_bends * this->rest_energy_;
  Index iterations = 0;
  bool converged = false;
  double change = 0.0;
  const auto start = std::chrono::steady_clock::now();
  while (iterations < options.max_iterations && !converged)
  {
    if (iterations % 64 == 63 && context.cancelled())
    {
      return Status::cancelled();
    }
    const double energy_before = this->energies_.back();
    fit_rotations(clusters, this->stride_, s.data(), this->rotations_.data());
    before.swap(q);
    take_rotations();
    this->energies_.push_back(star_energy + 0.5 * this->paired(before, moved) - this->paired(q, s));
    global_step();
    this->energies_.push_back(energy_after_global());
    ++iterations;
    const double energy = this->energies_.back();
    change = energy_before - energy;
    converged = options.tolerance > 0.0 && change <= options.tolerance * std::max(energy, floor);
  }
  const double microseconds =
    std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
  this->warm_ = true;

  for (Index r = 0; r < size; ++r)
  {
    const Index row = this->open_[static_cast<std::size_t>(r)];
    for (Index j = 0; j < 3; ++j)
    {
      d(row, j) = star_open[static_cast<std::size_t>(j * length + r)] +
        open[static_cast<std::size_t>(j * length + r)];
    }
  }
  for (Index j = 0; j < this->columns_; ++j)
  {
    const auto h = static_cast<std::size_t>(j);
    this->transforms_[h] = h < pose.size() && pose[h].mode == HandleMode::full
      ? pose[h].transform
      : this->affine_of(d.middleRows<4>(4 * j), j);
  }
  double residual = 0.0;
  std::vector<Index> contradicting;
  for (Index r = 0; r < asked; ++r)
  {
    const Index h = this->positions_[static_cast<std::size_t>(r)];
    const double miss =
      (this->pivot_rows_.row(h) * d - wanted.row(r)).norm() / std::max(this->diagonal_, 1e-300);
    residual = std::max(residual, miss);
    if (miss > contradiction)
    {
      contradicting.push_back(h);
    }
  }
  if (!contradicting.empty())
  {
    status.warnings.push_back("these positions contradict each other or cannot be reached, the "
                              "worst is missed by " +
      std::to_string(residual * this->diagonal_) + ": " +
      quoted_names(this->handles_, contradicting));
  }
  status.report.set("energy", Report::Value(std::max(this->energies_.back(), 0.0)));
  status.report.set("iterations", Report::Value(std::int64_t(iterations)));
  status.report.set("microseconds_per_iteration",
    Report::Value(iterations > 0 ? microseconds / static_cast<double>(iterations) : 0.0));
  if (asked > 0)
  {
    status.report.set("constraint_residual", Report::Value(residual));
  }
  if (options.tolerance > 0.0 && !converged && options.max_iterations > 0)
  {
    status.code = StatusCode::not_converged;
    status.message = "the energy still fell by " + std::to_string(change) + " of " +
      std::to_string(this->energies_.back()) + " in the last of " + std::to_string(iterations) +
      " iterations";
  }
  return status;
}

Status ReducedArap::deform(ExecutionContext& context, PointsView rest, Points& posed) const
{
  return this->skinning_.linear_blend(context, rest, this->transforms_, posed);
}

Status ReducedArap::deform_normals(
  ExecutionContext& context, PointsView rest_normals, Points& posed_normals) const
{
  return this->skinning_.linear_blend_normals(
    context, rest_normals, this->transforms_, posed_normals);
}

std::vector<Eigen::Matrix3d> ReducedArap::rotations() const
{
  std::vector<Eigen::Matrix3d> result(static_cast<std::size_t>(this->groups_.count));
  for (Index k = 0; k < this->groups_.count; ++k)
  {
    for (int e = 0; e < 9; ++e)
    {
      result[static_cast<std::size_t>(k)](e / 3, e % 3) =
        this->rotations_[static_cast<std::size_t>(e * this->stride_ + k)];
    }
  }
  return result;
}

} // namespace bindpose
