// Points inside a closed surface, taken from an octree.
//
// The octree is built level by level: a cell that is larger than the sizing field allows is divided
// into eight. A cell that does not intersect the surface is entirely inside or entirely outside.
// Cells outside are not divided.
#include "inside/inner_points.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace bindpose
{

namespace
{
// Maximum side of a cell, in units of the requested edge length. The edges of the tets are 0.87 and
// 1 times as long as the cell's side.
constexpr double largest_cell = 1.1;
// Minimum distance of points from the surface, relative to the requested edge length there.
constexpr double clearance = 0.5;
constexpr int maximum_level = 19; // maximum number of octree levels
constexpr Index cells_per_block = 256;
// Maximum number of cells on one level, as a multiple of the maximum number of cells inside. A
// shape that is much thinner than the requested edge length contains no cells, but its surface
// intersects millions of cells.
constexpr Index maximum_cells_per_cell_inside = 40;

/// Integer coordinates in units of half of the smallest cell's side: 21 bits per coordinate.
using LatticePosition = std::array<std::uint64_t, 3>;

class PointLattice
{
public:
  PointLattice(ExecutionContext& context, const Interior& interior, const SizingField& sizes)
    : interior_(interior), sizes_(sizes), context_(context)
  {
    // Side of the root cell: the largest allowed cell side, doubled until the root covers the box.
    // If the largest allowed cell already covers the box, the root is only as large as the longest
    // side of the box.
    const Box& box = interior.box();
    const double side = box.size().maxCoeff();
    double root_size = largest_cell * sizes.largest();
    root_size = root_size < side
      ? std::ldexp(root_size, static_cast<int>(std::ceil(std::log2(side / root_size))))
      : side;
    this->unit_ = std::ldexp(root_size, -maximum_level - 1);
    this->lower_ = box.center() - Vec3::Constant(0.5 * root_size);
  }

  /// Build the octree and choose its points.
  /// @return false if canceled, if more than `maximum_count` cells are inside, or if there are too
  /// many cells at the surface. In these cases points() is empty.
  bool build(Index maximum_count)
  {
    std::vector<Cell> cells{ Cell() };
    constexpr double choice_begin = 0.7; // progress at which select_points() starts
    double done = 0.0; // estimated completed fraction of the octree, 0 to 1
    for (int level = 0; !cells.empty(); ++level)
    {
      // The number of levels is unknown and most cells are in the last levels, so progress is
      // estimated from the number of cells.
      const double fraction =
        static_cast<double>(cells.size()) / static_cast<double>(maximum_count);
      const double next = std::min(0.5 * (1.0 + done), done + fraction);
      const ProgressRange range(this->context_, choice_begin * done, choice_begin * next);
      if (!this->classify(cells, level) || !this->subdivide(cells, level, maximum_count))
      {
        return false;
      }
      done = next;
    }
    const ProgressRange range(this->context_, choice_begin, 1.0);
    return this->select_points();
  }

  const Points& points() const { return this->points_; }

private:
  struct Cell
  {
    LatticePosition corner{}; ///< lower corner
    bool inside = false; ///< the whole cell is inside
    bool outside = false;
    bool large = false;
  };

  /// A packed position. The last bit is 1 if the position may be outside. Equal positions are
  /// sorted so that the key of a position known to be inside comes first.
  using Key = std::uint64_t;
  static constexpr int bits = 21;
  static constexpr Key mask = (Key(1) << bits) - 1;

  static Key key_of(const LatticePosition& coordinates, bool inside)
  {
    return ((coordinates[0] << bits | coordinates[1]) << bits | coordinates[2]) << 1 |
      (inside ? 0 : 1);
  }

  Vec3 position(Key key) const
  {
    const Key coordinates = key >> 1;
    return this->position(
      LatticePosition{ coordinates >> (2 * bits), coordinates >> bits & mask, coordinates & mask });
  }

  Vec3 position(const LatticePosition& coordinates) const
  {
    const Vec3 units(static_cast<double>(coordinates[0]), static_cast<double>(coordinates[1]),
      static_cast<double>(coordinates[2]));
    return this->lower_ + this->unit_ * units;
  }

  static std::uint64_t side_of(int level)
  {
    return std::uint64_t(1) << (maximum_level + 1 - level);
  }

  static LatticePosition moved(LatticePosition coordinates, int corner, std::uint64_t step)
  {
    for (int k = 0; k < 3; ++k)
    {
      coordinates[k] += (corner >> k & 1) * step;
    }
    return coordinates;
  }

  bool classify(std::vector<Cell>& cells, int level)
  {
    const std::uint64_t units = side_of(level);
    const double side = this->unit_ * static_cast<double>(units);
    const double half_diagonal = 0.5 * std::sqrt(3.0) * side;
    return parallel_for(this->context_, static_cast<Index>(cells.size()), cells_per_block,
      [&](Index begin, Index end)
      {
        for (Index i = begin; i < end; ++i)
        {
          Cell& cell = cells[i];
          const Vec3 center = this->position(moved(cell.corner, 7, units / 2));
          if (!cell.inside && this->interior_.has_clearance(center, half_diagonal))
          {
            cell.inside = this->interior_.contains(center);
            cell.outside = !cell.inside;
          }
          cell.large =
            level < maximum_level && !cell.outside && side > largest_cell * this->sizes_.at(center);
        }
      });
  }

  /// Compute the cells of the next level. The corners and centers of cells that are not divided are
  /// added to keys_.
  bool subdivide(std::vector<Cell>& cells, int level, Index maximum_count)
  {
    const std::uint64_t units = side_of(level);
    std::vector<Cell> parts;
    for (const Cell& cell : cells)
    {
      for (int corner = 0; corner < 8 && !cell.outside; ++corner)
      {
        if (cell.large)
        {
          Cell part;
          part.corner = moved(cell.corner, corner, units / 2);
          part.inside = cell.inside;
          parts.push_back(part);
        }
        else
        {
          this->keys_.push_back(key_of(moved(cell.corner, corner, units), cell.inside));
        }
      }
      if (!cell.large && !cell.outside)
      {
        this->keys_.push_back(key_of(moved(cell.corner, 7, units / 2), cell.inside));
        this->cells_inside_ += cell.inside ? 1 : 0;
      }
    }
    cells = std::move(parts);
    return this->cells_inside_ <= maximum_count &&
      static_cast<Index>(cells.size()) <= maximum_cells_per_cell_inside * maximum_count;
  }

  /// Keep the positions that are inside and far enough from the surface.
  bool select_points()
  {
    std::vector<Key>& keys = this->keys_;
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end(), [](Key a, Key b) { return a >> 1 == b >> 1; }),
      keys.end());
    std::vector<char> good(keys.size(), 0);
    // `clearance` is in units of the edge length at the surface. Convert it to units of the edge
    // length at the point. The edge length increases with the distance from the surface at the rate
    // growth().
    const double least = clearance / (1.0 + clearance * this->sizes_.growth());
    const bool is_complete =
      parallel_for(this->context_, static_cast<Index>(keys.size()), cells_per_block,
        [&](Index begin, Index end)
        {
          for (Index i = begin; i < end; ++i)
          {
            const Vec3 p = this->position(keys[i]);
            good[i] = this->interior_.has_clearance(p, least * this->sizes_.at(p)) &&
              ((keys[i] & 1) == 0 || this->interior_.contains(p));
          }
        });
    if (!is_complete)
    {
      return false;
    }
    this->points_.resize(std::count(good.begin(), good.end(), 1), 3);
    Index count = 0;
    for (std::size_t i = 0; i < keys.size(); ++i)
    {
      if (good[i])
      {
        this->points_.row(count++) = this->position(keys[i]);
      }
    }
    return true;
  }

  const Interior& interior_;
  const SizingField& sizes_;
  ExecutionContext& context_;
  double unit_; ///< half of the side of a smallest cell
  Vec3 lower_;
  std::vector<Key> keys_; ///< corners and centers of the undivided cells
  Index cells_inside_ = 0;
  Points points_{ 0, 3 };
};
} // namespace

Status Interior::build(ExecutionContext& context, Points points, Triangles boundary)
{
  this->points_ = std::move(points);
  this->boundary_ = std::move(boundary);
  this->box_ = bounding_box(this->points_, this->boundary_);
  this->tree_ = std::make_unique<TriangleTree>(this->points_, this->boundary_);
  WindingNumber::Options options;
  // An estimate of the number of queries.
  options.expected_queries = std::max<Index>(1, this->boundary_.rows());
  return this->winding_.build(context, this->points_, this->boundary_, options);
}

bool Interior::contains(const Vec3& p) const
{
  constexpr double half = 0.5; // the winding number is 0 or 1
  return this->winding_.evaluate_at(p) > half;
}

bool Interior::has_clearance(const Vec3& p, double distance) const
{
  return !this->tree_->is_within(p, distance);
}

double Interior::estimate_layer_cells(const SizingField& sizes) const
{
  constexpr Index samples = 1024;
  const Index step = std::max<Index>(1, this->boundary_.rows() / samples);
  double sum = 0.0;
  for (Index t = 0; t < this->boundary_.rows(); t += step)
  {
    const Vec3 a = this->points_.row(this->boundary_(t, 0));
    const Vec3 b = this->points_.row(this->boundary_(t, 1));
    const Vec3 c = this->points_.row(this->boundary_(t, 2));
    const double size = sizes.at((a + b + c) / 3.0);
    sum += 0.5 * (b - a).cross(c - a).norm() / (size * size);
  }
  // Growth rates below this have little effect on the number of cells near the surface.
  constexpr double least_growth = 0.1;
  return sum * static_cast<double>(step) / (2.0 * std::max(sizes.growth(), least_growth));
}

namespace
{
/// Searches for the scale of the edge lengths that gives the target number of points. The number of
/// points decreases with a power of the scale. The exponent depends on the surface: 3 in wide
/// spaces, 2 in a layer at the surface, less if many triangles are near each other.
class ScaleSearch
{
public:
  ScaleSearch(double first, double target) : target_(target), minimum_scale_(first) {}

  /// Add a measurement: the number of points at a scale, or infinity if there were too many to
  /// count.
  void add(double scale, double points)
  {
    Sample& sample = points > this->target_ ? this->above_target_ : this->below_target_;
    if (std::isfinite(points) && points > this->target_ &&
      std::isfinite(this->above_target_.points) && this->above_target_.scale > 0.0)
    {
      constexpr double least_power = 0.4;
      constexpr double largest_power = 3.0;
      this->power_ = std::clamp(
        std::log(this->above_target_.points / points) / std::log(scale / this->above_target_.scale),
        least_power, largest_power);
    }
    sample = { scale, points };
  }

  /// Return the scale to try next.
  double next() const
  {
    const Sample& above = this->above_target_;
    const Sample& below = this->below_target_;
    // Factor for the scale if the last scale gave too many points to count.
    constexpr double unmeasured_step = 12.0;
    constexpr double largest_step = 12.0;
    constexpr double least_step = 1.1;
    if (below.scale == 0.0)
    {
      const double step = std::isfinite(above.points)
        ? std::pow(above.points / this->target_, 1.0 / this->power_)
        : unmeasured_step;
      return above.scale * std::clamp(step, least_step, largest_step);
    }
    if (above.scale == 0.0)
    {
      constexpr double largest_step_back = 0.1;
      return std::max(this->minimum_scale_,
        below.scale * std::max(largest_step_back, below.points / this->target_));
    }
    // Position of the next scale between above.scale (0) and below.scale (1), on a logarithmic
    // axis.
    double fraction = 0.5;
    if (std::isfinite(above.points) && below.points > 0.0)
    {
      constexpr double margin = 0.15;
      fraction =
        std::clamp(std::log(above.points / this->target_) / std::log(above.points / below.points),
          margin, 1.0 - margin);
    }
    return above.scale * std::pow(below.scale / above.scale, fraction);
  }

  /// Report whether the interval between the two measured scales is too small to continue.
  bool ended() const
  {
    constexpr double close_ratio = 1.05;
    return this->below_target_.scale > 0.0 &&
      this->below_target_.scale <
      close_ratio * std::max(this->minimum_scale_, this->above_target_.scale);
  }

private:
  struct Sample
  {
    double scale = 0.0; ///< scale of the edge lengths; 0: no measurement
    double points = 0.0;
  };
  double target_;
  double minimum_scale_; ///< smallest scale that may be tried
  double power_ = 1.0;
  /// Measurement at the largest scale that gave more than `target_` points.
  Sample above_target_;
  /// Measurement at the smallest scale that gave at most `target_` points.
  Sample below_target_;
};

/// Return a subset of `target` points, chosen at equal index intervals.
Points subsample(const Points& points, Index target)
{
  Points kept(target, 3);
  for (Index i = 0; i < target; ++i)
  {
    kept.row(i) = points.row(i * points.rows() / target);
  }
  return kept;
}
} // namespace

bool inner_points(ExecutionContext& context, const Interior& interior, SizingField& sizes,
  Index maximum_count, Points& inner)
{
  // An attempt ends if the number of cells inside exceeds this factor times the maximum number of
  // points.
  constexpr double abort_ratio = 5.0;
  // An attempt may always have this many cells inside, because they take little time.
  constexpr double minimum_cell_limit = 2000.0;
  constexpr double maximum_point_ratio = 1.2;
  constexpr double minimum_target_ratio = 0.6;
  constexpr int attempts = 20;
  // Largest growth rate of edge lengths that octree cells can follow.
  constexpr double most_growth = 1.0;
  const double target = static_cast<double>(std::max<Index>(1, maximum_count));
  ScaleSearch search(sizes.scale(), target);
  // Before an attempt, increase the edge lengths until the expected number of points is small
  // enough: first the growth rate, then the scale. The expected number is a low estimate, because
  // most surfaces have 4 to 20 points per cell of the layer at the surface.
  const double first_scale = sizes.scale();
  const auto raise = [&]
  {
    constexpr double points_per_cell = 3.0;
    constexpr double largest_guess = 30.0;
    constexpr double step = 1.5;
    while (points_per_cell * interior.estimate_layer_cells(sizes) > maximum_point_ratio * target &&
      sizes.scale() < largest_guess * first_scale)
    {
      if (sizes.growth() < most_growth)
      {
        sizes.set_growth(most_growth);
        continue;
      }
      sizes.set_scale(step * sizes.scale());
    }
  };
  raise();
  Points largest_fitting; // largest point set so far that is not above the target
  Points surplus_points; // smallest point set so far with too many points
  double before = -1.0;
  double begin = 0.0; // progress at the start of this attempt
  for (int attempt = 0; attempt < attempts; ++attempt)
  {
    // There are typically two or three attempts. Each attempt gets this fraction of the remaining
    // progress.
    constexpr double fraction = 0.45;
    const double end = begin + fraction * (1.0 - begin);
    const ProgressRange range(context, begin, end);
    begin = end;
    PointLattice lattice(context, interior, sizes);
    const bool is_complete =
      lattice.build(static_cast<Index>(std::max(minimum_cell_limit, abort_ratio * target)) + 1);
    if (context.canceled())
    {
      return false;
    }
    inner = lattice.points();
    const double points =
      is_complete ? static_cast<double>(inner.rows()) : std::numeric_limits<double>::infinity();
    const bool is_above_target = points > maximum_point_ratio * target;
    if (is_above_target && sizes.growth() < most_growth)
    {
      sizes.set_growth(most_growth);
      raise();
      continue;
    }
    search.add(sizes.scale(), points);
    // If two attempts give the same number of points, the maximum edge length determines the cell
    // size, and another scale would have no effect.
    const bool is_unchanged = is_complete && points == before;
    before = points;
    if (!is_above_target &&
      (points >= minimum_target_ratio * target || sizes.scale() == first_scale))
    {
      return true;
    }
    if (!is_above_target && inner.rows() >= largest_fitting.rows())
    {
      largest_fitting = inner;
    }
    if (is_above_target && is_complete &&
      (surplus_points.rows() == 0 || inner.rows() < surplus_points.rows()))
    {
      surplus_points = inner;
    }
    if (search.ended() || is_unchanged || attempt + 1 == attempts)
    {
      break;
    }
    sizes.set_scale(search.next());
  }
  // In a plate, all cells may be divided at the same scale. At this scale, the number of points
  // jumps from too few to too many. In this case, a subset of surplus_points is used.
  constexpr double minimum_usable_ratio = 0.3;
  const bool uses_subset = surplus_points.rows() > 0 &&
    static_cast<double>(largest_fitting.rows()) < minimum_usable_ratio * target;
  inner = uses_subset ? subsample(surplus_points, static_cast<Index>(target))
                      : std::move(largest_fitting);
  return true;
}

} // namespace bindpose
