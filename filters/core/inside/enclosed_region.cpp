// Volume of the region that a surface encloses, and winding numbers of the tets in it.
//
// The winding number of the whole surface determines the region. The triangles of a closed surface
// separate cells of space, and the winding number is a constant integer in each cell. One point per
// cell, far from the triangles, is then enough. If the surface is open, every tet is evaluated.
#include "inside/enclosed_region.h"

#include "base/number_text.h"
#include "base/parallel.h"
#include "tets/tet_quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace bindpose
{

namespace
{
constexpr double smallest_volume_ratio = 0.9;
constexpr double largest_volume_ratio = 1.1;
/// Winding numbers in the openings of a surface differ from the threshold by less than this. The
/// winding numbers on the two sides of a wall, and in all regions of a closed surface, differ from
/// the threshold by more.
constexpr double undecided_margin = 0.25;

/// Return points spread evenly over a box, by an additive recurrence with the powers of 1 / x,
/// where x is the positive root of x^4 = x + 1. The points are the same in every run.
Points quasi_random_points(const Box& box, Index count)
{
  const Vec3 step(0.8191725133961645, 0.6710436067037893, 0.5497004779019703);
  const Vec3 size = box.size();
  Points points(count, 3);
  for (Index i = 0; i < count; ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      const double t = 0.5 + static_cast<double>(i + 1) * step[k];
      points(i, k) = box.lower[k] + (t - std::floor(t)) * size[k];
    }
  }
  return points;
}
} // namespace

Status EnclosedRegion::build(
  ExecutionContext& context, RepairedSurface& surface, double threshold, bool& flipped)
{
  this->threshold_ = threshold;
  this->closed_ = surface.closed;
  this->box_ = bounding_box(surface.points);
  double negative = 0.0;
  Status status = this->sample(context, surface, negative);
  flipped = status.ok() && negative > this->volume_ && !surface.is_clean();
  if (flipped)
  {
    surface.triangles.col(1).swap(surface.triangles.col(2));
    this->largest_winding_ = 0.0;
    status = this->sample(context, surface, negative);
  }
  if (surface.is_clean() && surface.found.components == 1)
  {
    // The winding number of a clean surface is 1 inside and never 2, so the volume is 0 for
    // thresholds above 1.
    this->volume_ = threshold <= 1.0 ? signed_volume(surface.points, surface.triangles) : 0.0;
    this->volume_error_ = 0.0;
  }
  return status;
}

Status EnclosedRegion::sample(
  ExecutionContext& context, const RepairedSurface& surface, double& negative)
{
  // Estimate of the number of queries: the samples below and, later, one query per tet.
  WindingNumber::Options winding;
  winding.expected_queries = 500000;
  Status status = this->winding_.build(context, surface.points, surface.triangles, winding);
  if (surface.found.flat)
  {
    this->volume_ = 0.0;
    this->volume_error_ = 0.0;
    return status.usable() ? Status() : status;
  }
  // Add samples until enough of them are inside. The time limit is about 0.2 s plus 20 us per
  // triangle, but at most 2 s. A sample takes about 1 us with the fast method, 0.1 us per triangle
  // with the direct method, and 0.1 us plus 15 ns per open edge with the other exact methods.
  const auto triangles = static_cast<double>(surface.triangles.rows());
  const WindingMethod method = this->winding_.method();
  const double cost = method == WindingMethod::fast ? 1.0
    : method == WindingMethod::direct
    ? 0.1 * triangles
    : 0.1 + 0.015 * static_cast<double>(surface.found.boundary_edges);
  const double maximum_cost = std::min(2e6, 2e5 + 20.0 * triangles); // microseconds
  constexpr double maximum_samples = 1e6;
  // The initial number of points is that of a grid with 40 points along the longest side. The
  // points do not form a grid, because faces of boxes and of CAD models may be aligned with the
  // planes of a grid. Then a whole layer of points would be counted wrongly.
  const Vec3 size = this->box_.size();
  // Sufficient number of samples inside; the error is then below one percent.
  constexpr double sufficient_samples = 20000.0;
  constexpr double growth = 3.375;
  auto samples = static_cast<Index>((40.0 * size / size.maxCoeff()).array().ceil().max(1.0).prod());
  for (;; samples = static_cast<Index>(growth * static_cast<double>(samples)))
  {
    const Points points = quasi_random_points(this->box_, samples);
    Eigen::VectorXd w;
    status = this->winding_.evaluate(context, points, w);
    if (!status.ok())
    {
      break;
    }
    const double cell = size.prod() / static_cast<double>(samples);
    const double threshold = this->threshold_;
    const auto inside_samples = static_cast<double>((w.array() >= threshold).count());
    negative = cell * static_cast<double>((w.array() <= -threshold).count());
    this->volume_ = cell * inside_samples;
    this->volume_error_ = inside_samples > 0.0 ? 1.0 / std::sqrt(inside_samples) : 1.0;
    this->near_threshold_fraction_ =
      static_cast<double>(((w.array() - threshold).abs() < undecided_margin).count()) /
      std::max(inside_samples, 1.0);
    this->largest_winding_ = std::max(this->largest_winding_, w.maxCoeff());
    const double next_samples = growth * static_cast<double>(w.size());
    if (inside_samples >= sufficient_samples || negative > this->volume_ ||
      next_samples > maximum_samples || next_samples * cost > maximum_cost)
    {
      break;
    }
  }
  return status.code == StatusCode::canceled ? status
    : status.usable()                        ? Status()
                                             : Status::failure(status.code, status.message);
}

double EnclosedRegion::misfit(double volume) const
{
  return volume > 0.0 && this->volume_ > 0.0 ? std::abs(std::log(volume / this->volume_))
                                             : std::numeric_limits<double>::infinity();
}

std::string EnclosedRegion::relative_volume(double tet_volume) const
{
  return this->volume_ > 0.0
    ? "the volume of the tets is " + short_number(100.0 * tet_volume / this->volume_, 3) +
      " % of the enclosed volume by winding number"
    : "the tets have a volume, but the enclosed volume by winding number is 0";
}

Status EnclosedRegion::nothing_enclosed_error() const
{
  return Status::invalid_input("the surface encloses nothing: its largest winding number is " +
    short_number(this->largest_winding_) +
    (this->largest_winding_ < this->threshold_
        ? ", below the threshold of "
        : ", but only regions of negligible size reach the threshold of ") +
    short_number(this->threshold_));
}

Status EnclosedRegion::no_tets_error() const
{
  const double fraction = this->volume_ / this->box_.size().prod();
  constexpr double speck = 1e-6;
  return fraction > speck
    ? Status::failure(StatusCode::unavailable,
        "the surface encloses about " + short_number(100.0 * fraction, 3) +
          " % of its bounding box, but this region is too thin for tets of this size")
    : this->nothing_enclosed_error();
}

Status EnclosedRegion::check_not_specks(const RepairedSurface& surface) const
{
  constexpr Index minimum_triangles = 10000;
  // minimum fraction of the triangle sides that are boundary edges
  constexpr double minimum_boundary_fraction = 0.9;
  // Maximum volume of the enclosed region, as a fraction of the volume of the box.
  constexpr double maximum_fraction = 1e-3;
  // Maximum mean thickness of the enclosed region, relative to the mean size of a triangle.
  constexpr double largest_thickness = 0.1;
  const Index count = surface.triangles.rows();
  const double fraction = this->volume_ / this->box_.size().prod();
  if (count < minimum_triangles || fraction > maximum_fraction ||
    static_cast<double>(surface.found.boundary_edges) <
      minimum_boundary_fraction * 3.0 * static_cast<double>(count))
  {
    return {};
  }
  const double area = surface_area(surface.points, surface.triangles);
  const double size = std::sqrt(area / static_cast<double>(count));
  return this->volume_ > largest_thickness * size * area
    ? Status()
    : Status::invalid_input("the surface consists of " + std::to_string(count) +
        " mostly disconnected triangles that enclose only about " +
        short_number(100.0 * fraction, 3) + " % of its bounding box");
}

bool EnclosedRegion::fits(double volume) const
{
  const double slack = this->volume_error_;
  return volume > 0.0 &&
    (slack >= 0.5 ||
      (volume >= (smallest_volume_ratio - slack) * this->volume_ &&
        volume <= (largest_volume_ratio + slack) * this->volume_));
}

Status EnclosedRegion::label(ExecutionContext& context, const MesherData& data, Eigen::VectorXd& w)
{
  Status status = this->closed_ && !data.regions.empty() ? this->label_regions(context, data, w)
                                                         : this->label_tets(context, data, w);
  if (status.ok() && w.size() > 0)
  {
    this->largest_winding_ = std::max(this->largest_winding_, w.maxCoeff());
  }
  return status;
}

/// Compute the winding numbers of the tets of a closed surface. One value is evaluated per group of
/// tets that no triangle separates (`data.regions`), because the winding number is constant there.
Status EnclosedRegion::label_regions(
  ExecutionContext& context, const MesherData& data, Eigen::VectorXd& w) const
{
  const Eigen::VectorXd volumes = tet_volumes(data.points, data.tets);
  std::map<Index, Index> largest; // index of the largest tet of each region
  for (Index t = 0; t < data.tets.rows(); ++t)
  {
    const auto [entry, is_new] = largest.emplace(data.regions[t], t);
    if (!is_new && volumes[t] > volumes[entry->second])
    {
      entry->second = t;
    }
  }
  std::map<Index, double> winding_of_region;
  for (const auto& [region, t] : largest)
  {
    Vec3 center = Vec3::Zero();
    for (int k = 0; k < 4; ++k)
    {
      center += 0.25 * data.points.row(data.tets(t, k)).transpose();
    }
    winding_of_region[region] = this->winding_.evaluate_at(center);
  }
  w.resize(data.tets.rows());
  for (Index t = 0; t < data.tets.rows(); ++t)
  {
    w[t] = winding_of_region[data.regions[t]];
  }
  return context.canceled() ? Status::canceled() : Status();
}

/// Compute the winding numbers of the tets of an open surface: the value at the center or, for
/// large tets near the threshold, the mean of four points.
Status EnclosedRegion::label_tets(
  ExecutionContext& context, const MesherData& data, Eigen::VectorXd& w) const
{
  const Points centers = tet_centers(data.points, data.tets);
  Status status = this->winding_.evaluate(context, centers, w);
  if (!status.usable())
  {
    return status;
  }
  // A fast winding number may be on the wrong side of the threshold if it differs from the
  // threshold by less than the error bound. Evaluate such winding numbers exactly.
  const double error_bound = this->winding_.method() == WindingMethod::fast
    ? this->winding_.status().report.number("error_bound", 0.0)
    : 0.0;
  std::vector<Index> undecided;
  for (Index t = 0; t < w.size(); ++t)
  {
    if (std::abs(w[t] - this->threshold_) < error_bound)
    {
      undecided.push_back(t);
    }
  }
  if (!parallel_for(context, static_cast<Index>(undecided.size()), 8,
        [&](Index begin, Index end)
        {
          for (Index i = begin; i < end; ++i)
          {
            w[undecided[i]] = this->winding_.evaluate_exactly_at(centers.row(undecided[i]));
          }
        }))
  {
    return Status::canceled();
  }
  // A tet is large if its longest edge is longer than this, in bounding-box diagonals.
  constexpr double large = 0.05;
  std::vector<Index> tets;
  for (Index t = 0; t < data.tets.rows(); ++t)
  {
    if (std::abs(w[t] - this->threshold_) < undecided_margin &&
      longest_edge(data.points, data.tets, t) > large * this->box_.diagonal())
    {
      tets.push_back(t);
    }
  }
  Points sample_points(4 * static_cast<Index>(tets.size()), 3);
  for (std::size_t i = 0; i < tets.size(); ++i)
  {
    for (int k = 0; k < 4; ++k)
    {
      // Quadrature rule of degree 2 with four points.
      constexpr double own_corner_weight = 0.5854101966249685;
      constexpr double other_corner_weight = 0.1381966011250105;
      sample_points.row(4 * static_cast<Index>(i) + k) =
        4.0 * other_corner_weight * centers.row(tets[i]) +
        (own_corner_weight - other_corner_weight) * data.points.row(data.tets(tets[i], k));
    }
  }
  Eigen::VectorXd values;
  status = this->winding_.evaluate(context, sample_points, values);
  for (std::size_t i = 0; i < tets.size() && status.usable(); ++i)
  {
    w[tets[i]] = 0.25 * values.segment(4 * static_cast<Index>(i), 4).sum();
  }
  // TetGen's box is larger than the box of the surface. Outside the surface's box, the winding
  // numbers of two sheets may add up to the threshold, but such points are not inside.
  for (Index t = 0; t < w.size(); ++t)
  {
    const Vec3 p = centers.row(t);
    if ((p.array() < this->box_.lower.array()).any() ||
      (p.array() > this->box_.upper.array()).any())
    {
      w[t] = 0.0;
    }
  }
  return status.usable() ? Status() : status;
}

} // namespace bindpose
