// Evaluation of the multipole approximation of the winding number. In a cell, the value is the
// polynomial of the leaf plus the sum over the triangles in the leaf's near list. Outside the
// cells, the value is the sum of the multipoles of the groups that are far enough away, plus the
// sum over the triangles of the other groups. dipole_field_build.cpp builds the cells.
#include "winding/dipole_field.h"

#include "base/constants.h"
#include "solid_angle/local_polynomial.h"
#include "solid_angle/solid_harmonics.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
} // namespace

DipoleField::Corners DipoleField::corners(Index slot) const
{
  Corners corners;
  const Index original_count = this->points_->rows();
  for (int k = 0; k < 3; ++k)
  {
    const Index id = this->ids_[slot][k];
    corners[k] =
      id < original_count ? Vec3(this->points_->row(id)) : this->extra_points_[id - original_count];
  }
  return corners;
}

Index DipoleField::block_count() const
{
  return static_cast<Index>(this->ids_.size()) / triangle_lanes;
}

/// Computes the exact solid angles of the triangles that the fast formula rejects.
class DipoleField::AccurateSum : public FallbackSum
{
public:
  AccurateSum(const DipoleField& field, const Vec3& point)
    : field_(field), sum_(point, field.touch_tolerance_)
  {
  }
  void add(Index block, const int* lanes) override
  {
    for (int i = 0; i < triangle_lanes; ++i)
    {
      if (lanes[i])
      {
        const Corners c = this->field_.corners(block * triangle_lanes + i);
        const double weight = this->field_.double_precision_
          ? this->field_.double_blocks_[block].weight[i]
          : static_cast<double>(this->field_.float_blocks_[block].weight[i]);
        if (weight != 0.0)
        {
          this->sum_.add(c[0], c[1], c[2], static_cast<int>(weight));
        }
        this->used_ = true;
      }
    }
  }
  double winding_number() const { return this->used_ ? this->sum_.winding_number() : 0.0; }
  bool on_surface() const { return this->sum_.on_surface(); }

private:
  const DipoleField& field_;
  SolidAngleSum sum_;
  bool used_ = false;
};

double DipoleField::near_sum(
  const BlockRun* runs, Index count, const Vec3& point, bool& on_surface) const
{
  AccurateSum fallback(*this, point);
  const double sum = this->double_precision_
    ? sum_blocks(this->double_blocks_.data(), runs, count, point, this->touch_tolerance_, fallback)
    : sum_blocks(this->float_blocks_.data(), runs, count, point, this->touch_tolerance_, fallback);
  on_surface = on_surface || fallback.on_surface();
  return sum + fallback.winding_number();
}

double DipoleField::exact_sum(const Vec3& point) const
{
  AccurateSum fallback(*this, point);
  constexpr int every[triangle_lanes] = { 1, 1, 1, 1, 1, 1, 1, 1 };
  for (Index b = 0; b < this->block_count(); ++b)
  {
    fallback.add(b, every);
  }
  return fallback.winding_number();
}

bool DipoleField::is_in_cells(const Vec3& point) const
{
  bool inside = true;
  for (int k = 0; k < 3; ++k)
  {
    const double x = point[k] - this->lower_[k];
    inside = inside && x >= 0.0 && x < this->size_;
  }
  return inside;
}

std::uint32_t DipoleField::cell_coordinate(double x, int axis) const
{
  constexpr std::uint32_t last = (1u << finest_level) - 1;
  const double at = (x - this->lower_[axis]) * (static_cast<double>(last + 1) / this->size_);
  return std::min(static_cast<std::uint32_t>(at), last);
}

DipoleField::Leaf DipoleField::leaf_at(const CellCoordinates& at) const
{
  int level = this->top_level_;
  int shift = finest_level - level;
  Id entry =
    this
      ->cells_[(at[0] >> shift) + ((at[1] >> shift) << level) + ((at[2] >> shift) << (2 * level))];
  while (entry >= 0)
  {
    ++level;
    --shift;
    entry = this->cells_[entry +
      static_cast<Id>(
        (at[0] >> shift & 1) | (at[1] >> shift & 1) << 1 | (at[2] >> shift & 1) << 2)];
  }
  Leaf leaf;
  leaf.id = ~entry;
  leaf.shift = shift;
  const double size = this->size_ / static_cast<double>(1u << level);
  leaf.inverse = 2.0 / size;
  for (int k = 0; k < 3; ++k)
  {
    leaf.center[k] = this->lower_[k] + size * (static_cast<double>(at[k] >> shift) + 0.5);
  }
  return leaf;
}

DipoleField::Leaf DipoleField::leaf_at(const Vec3& point) const
{
  return this->leaf_at(CellCoordinates{ this->cell_coordinate(point[0], 0),
    this->cell_coordinate(point[1], 1), this->cell_coordinate(point[2], 2) });
}

/// Call `use` with the coefficients of a leaf's expansion, and return the result of `use`. The
/// coefficients are floats or doubles.
template <typename Use>
auto DipoleField::with_coefficients(Id leaf, const Use& use) const
{
  const std::size_t first = static_cast<std::size_t>(leaf) *
    static_cast<std::size_t>(local_coefficient_count(this->order_));
  return this->double_precision_ ? use(&this->double_locals_[first])
                                 : use(&this->float_locals_[first]);
}

void DipoleField::contract(const Leaf& leaf, double y, double z, double* polynomial) const
{
  this->with_coefficients(leaf.id,
    [&](const auto* coefficients)
    {
      contract_local(this->order_, coefficients, (y - leaf.center[1]) * leaf.inverse,
        (z - leaf.center[2]) * leaf.inverse, polynomial);
    });
}

double DipoleField::evaluate(const Vec3& point, bool* on_surface) const
{
  double value = 0.0;
  bool touched = false;
  this->evaluate(&point, 1, &value, &touched);
  if (on_surface)
  {
    *on_surface = touched;
  }
  return value;
}

/// Memory latency dominates the cost. Therefore the data of all points in a batch is prefetched
/// before the first point is evaluated.
void DipoleField::evaluate(const Vec3* points, Index count, double* out, bool* on_surface) const
{
  constexpr Index batch_size = 16;
  std::array<Leaf, batch_size> leaves;
  const auto prefetch = [](const void* begin, std::size_t bytes)
  {
    for (std::size_t i = 0; i < bytes; i += 64)
    {
      __builtin_prefetch(static_cast<const char*>(begin) + i);
    }
  };
  for (Index first = 0; first < count; first += batch_size)
  {
    const Index end = std::min(count, first + batch_size);
    for (Index i = first; i < end; ++i)
    {
      Leaf& leaf = leaves[i - first];
      leaf.id = -1;
      if (!this->ids_.empty() && this->is_in_cells(points[i]))
      {
        leaf = this->leaf_at(points[i]);
        this->with_coefficients(leaf.id,
          [&](const auto* coefficients)
          {
            prefetch(coefficients,
              static_cast<std::size_t>(local_coefficient_count(this->order_)) *
                sizeof(*coefficients));
          });
        prefetch(&this->first_run_[leaf.id], 1);
      }
    }
    for (Index i = first; i < end; ++i)
    {
      on_surface[i] = false;
      out[i] = 0.0;
      const Leaf& leaf = leaves[i - first];
      if (leaf.id >= 0)
      {
        double polynomial[polynomial_capacity];
        this->contract(leaf, points[i][1], points[i][2], polynomial);
        out[i] = evaluate_polynomial(
          polynomial, this->order_, (points[i][0] - leaf.center[0]) * leaf.inverse);
        prefetch(&this->runs_[this->first_run_[leaf.id]], 64);
      }
    }
    for (Index i = first; i < end; ++i)
    {
      const Leaf& leaf = leaves[i - first];
      if (leaf.id >= 0)
      {
        const Id run = this->first_run_[leaf.id];
        const Index runs = this->first_run_[leaf.id + 1] - run;
        if (runs > 0)
        {
          out[i] += this->near_sum(&this->runs_[run], runs, points[i], on_surface[i]);
        }
      }
      else if (!this->ids_.empty())
      {
        out[i] = this->outer_sum(points[i], on_surface[i]);
      }
    }
  }
}

void DipoleField::evaluate_row(
  const double* x, double y, double z, Index count, double* out, unsigned char* on_surface) const
{
  for (Index i = 0; i < count;)
  {
    bool touched = false;
    if (this->ids_.empty() || !this->is_in_cells(Vec3(x[i], y, z)))
    {
      out[i] = this->ids_.empty() ? 0.0 : this->outer_sum(Vec3(x[i], y, z), touched);
      if (on_surface)
      {
        on_surface[i] = touched;
      }
      ++i;
      continue;
    }
    const CellCoordinates at{ this->cell_coordinate(x[i], 0), this->cell_coordinate(y, 1),
      this->cell_coordinate(z, 2) };
    const Leaf leaf = this->leaf_at(at);
    double polynomial[polynomial_capacity];
    this->contract(leaf, y, z, polynomial);
    const BlockRun* runs = this->runs_.data() + this->first_run_[leaf.id];
    const Index run_count = this->first_run_[leaf.id + 1] - this->first_run_[leaf.id];
    const std::uint32_t cell = at[0] >> leaf.shift;
    do
    {
      out[i] =
        evaluate_polynomial(polynomial, this->order_, (x[i] - leaf.center[0]) * leaf.inverse);
      touched = false;
      if (run_count > 0)
      {
        out[i] += this->near_sum(runs, run_count, Vec3(x[i], y, z), touched);
      }
      if (on_surface)
      {
        on_surface[i] = touched;
      }
      ++i;
    } while (i < count && this->is_in_cells(Vec3(x[i], y, z)) &&
      this->cell_coordinate(x[i], 0) >> leaf.shift == cell);
  }
}

void DipoleField::evaluate_row(
  const Vec3& first, const Vec3& step, Index count, double* out, unsigned char* on_surface) const
{
  constexpr Index chunk = 256;
  double x[chunk];
  for (Index begin = 0; begin < count; begin += chunk)
  {
    const Index end = std::min(count, begin + chunk);
    if (step[1] == 0.0 && step[2] == 0.0)
    {
      for (Index i = begin; i < end; ++i)
      {
        x[i - begin] = first[0] + static_cast<double>(i) * step[0];
      }
      this->evaluate_row(
        x, first[1], first[2], end - begin, out + begin, on_surface ? on_surface + begin : nullptr);
      continue;
    }
    for (Index i = begin; i < end; ++i)
    {
      const Vec3 point = first + static_cast<double>(i) * step;
      bool touched = false;
      out[i] = this->evaluate(point, &touched);
      if (on_surface)
      {
        on_surface[i] = touched;
      }
    }
  }
}

template <typename UseMoments, typename All>
void DipoleField::visit_outer(
  const Vec3& point, const UseMoments& use_moments, const All& all) const
{
  const auto count = static_cast<Id>(this->outer_.size());
  const int stride = 2 * harmonic_count(this->order_ + 1);
  for (Id n = 0; n < count;)
  {
    const OuterNode& node = this->outer_[n];
    const Vec3 offset = point - node.center;
    const double distance = offset.norm();
    const double inverse = 1.0 / distance;
    double error = node.bound / (1.0 - node.radius * inverse);
    for (int k = 0; k < this->order_ + 3; ++k)
    {
      error *= inverse;
    }
    const bool is_far = distance > 1.05 * node.radius && error <= this->outer_threshold_;
    if (is_far)
    {
      use_moments(&this->outer_moments_[std::size_t(n) * stride], offset);
    }
    else if (node.leaf)
    {
      all(node.blocks);
    }
    n = is_far || node.leaf ? node.skip : n + 1;
  }
}

namespace
{
/// Compute the irregular harmonics of one point with polar axis x, as pairs of real and imaginary
/// parts.
void irregular_at(int order, const Vec3& point, double* out)
{
  const double inverse = 1.0 / point.squaredNorm();
  const double x = point[harmonic_axes[0]] * inverse, y = point[harmonic_axes[1]] * inverse,
               z = point[harmonic_axes[2]] * inverse;
  out[0] = std::sqrt(inverse);
  out[1] = 0.0;
  for (int n = 1; n <= order; ++n)
  {
    const double* last = out + 2 * harmonic_index(n - 1, 0);
    const double* before = n > 1 ? out + 2 * harmonic_index(n - 2, 0) : nullptr;
    double* current = out + 2 * harmonic_index(n, 0);
    const double odd = 2.0 * n - 1.0;
    current[2 * n] = odd * (x * last[2 * n - 2] - y * last[2 * n - 1]);
    current[2 * n + 1] = odd * (x * last[2 * n - 1] + y * last[2 * n - 2]);
    for (int m = 0; m < n; ++m)
    {
      const double factor = static_cast<double>((n - 1) * (n - 1) - m * m) * inverse;
      for (int part = 0; part < 2; ++part)
      {
        current[2 * m + part] =
          odd * z * last[2 * m + part] - (m <= n - 2 ? factor * before[2 * m + part] : 0.0);
      }
    }
  }
}

/// Write the coefficient (n, m) to `re` and `im`. `all` stores only the coefficients for m >= 0;
/// those for m < 0 follow by symmetry.
void coefficient(const double* all, int n, int m, double& re, double& im)
{
  const double* at = all + 2 * harmonic_index(n, std::abs(m));
  const double sign = m < 0 && m % 2 ? -1.0 : 1.0;
  re = sign * at[0];
  im = m < 0 ? -sign * at[1] : at[1];
}

/// Add the contribution of an edge to the derivative of a triangle's winding number at the origin.
/// The derivative is a line integral along the edges of the triangle.
void add_gradient_of_edge(const Vec3& a, const Vec3& b, double weight, Vec3& sum)
{
  const double la = a.norm(), lb = b.norm();
  const double denominator = la * lb * (la * lb + a.dot(b));
  if (denominator > 0.0)
  {
    sum += (weight * (la + lb) / (denominator * four_pi)) * a.cross(b);
  }
}
} // namespace

double DipoleField::outer_sum(const Vec3& point, bool& on_surface) const
{
  double harmonics[2 * harmonic_count(largest_polynomial_order + 1)];
  double sum = 0.0;
  this->visit_outer(
    point,
    [&](const double* moments, const Vec3& offset)
    {
      irregular_at(this->order_ + 1, offset, harmonics);
      for (int n = 1; n <= this->order_ + 1; ++n)
      {
        const double* moment = moments + 2 * harmonic_index(n, 0);
        const double* harmonic = harmonics + 2 * harmonic_index(n, 0);
        double part = 0.0;
        for (int m = 1; m <= n; ++m)
        {
          part += moment[2 * m] * harmonic[2 * m] + moment[2 * m + 1] * harmonic[2 * m + 1];
        }
        sum += moment[0] * harmonic[0] + 2.0 * part;
      }
    },
    [&](const BlockRun& blocks) { sum += this->near_sum(&blocks, 1, point, on_surface); });
  return sum;
}

Vec3 DipoleField::gradient(const Vec3& point) const
{
  Vec3 sum = Vec3::Zero();
  if (this->ids_.empty())
  {
    return sum;
  }
  const auto add_blocks = [&](const BlockRun& run)
  {
    for (Index b = run.first; b < run.first + run.count; ++b)
    {
      for (int i = 0; i < triangle_lanes; ++i)
      {
        const double weight = this->double_precision_
          ? this->double_blocks_[b].weight[i]
          : static_cast<double>(this->float_blocks_[b].weight[i]);
        if (weight != 0.0)
        {
          const Corners c = this->corners(b * triangle_lanes + i);
          for (int k = 0; k < 3; ++k)
          {
            add_gradient_of_edge(c[k] - point, c[(k + 1) % 3] - point, weight, sum);
          }
        }
      }
    }
  };
  const int top = std::max(this->order_ + 2, 1);
  double harmonics[2 * harmonic_count(largest_polynomial_order + 2)];
  if (!this->is_in_cells(point))
  {
    // The derivatives of an irregular harmonic T(n, m) are irregular harmonics:
    // d/dz T(n, m) = -T(n+1, m), (d/dx + i d/dy) T(n, m) = -T(n+1, m+1).
    this->visit_outer(
      point,
      [&](const double* moments, const Vec3& offset)
      {
        irregular_at(top, offset, harmonics);
        for (int n = 1; n <= this->order_ + 1; ++n)
        {
          for (int m = -n; m <= n; ++m)
          {
            double mr, mi, tr, ti;
            coefficient(moments, n, m, mr, mi);
            coefficient(harmonics, n + 1, m, tr, ti);
            sum[harmonic_axes[2]] -= mr * tr + mi * ti;
            coefficient(harmonics, n + 1, m + 1, tr, ti);
            sum[harmonic_axes[0]] -= mr * tr + mi * ti;
            sum[harmonic_axes[1]] -= mr * ti - mi * tr;
          }
        }
      },
      add_blocks);
    return sum;
  }
  const Leaf leaf = this->leaf_at(point);
  const Vec3 local = (point - leaf.center) * leaf.inverse;
  double polynomial[polynomial_capacity];
  this->contract(leaf, point[1], point[2], polynomial);
  double slope = 0.0;
  for (int j = this->order_; j > 0; --j)
  {
    slope = slope * local[0] + j * polynomial[j];
  }
  sum[0] += leaf.inverse * slope;
  const std::array<double, 2> across = this->with_coefficients(leaf.id,
    [&](const auto* coefficients)
    { return transverse_derivatives(this->order_, coefficients, local); });
  sum[1] += leaf.inverse * across[0];
  sum[2] += leaf.inverse * across[1];
  for (Id r = this->first_run_[leaf.id]; r < this->first_run_[leaf.id + 1]; ++r)
  {
    add_blocks(this->runs_[r]);
  }
  return sum;
}

Index DipoleField::memory() const
{
  const auto bytes = [](const auto& v)
  { return static_cast<Index>(v.capacity() * sizeof(*v.data())); };
  return bytes(this->extra_points_) + bytes(this->ids_) + bytes(this->float_blocks_) +
    bytes(this->double_blocks_) + bytes(this->float_locals_) + bytes(this->double_locals_) +
    bytes(this->cells_) + bytes(this->first_run_) + bytes(this->runs_) + bytes(this->outer_) +
    bytes(this->outer_moments_);
}
} // namespace bindpose
