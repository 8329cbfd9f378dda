// Triangulation of the inside of plane curves (see planar_shape.h), in five steps:
// 1. Collect the vertices of segments and handles, merging equal ones. If the vertices are far from
//    the origin, move them toward it. Scale them by a power of two to a size of about 1. Neither
//    operation rounds.
// 2. The helper process splits curves and bones where they intersect, and triangulates their convex
//    hull.
// 3. Keep the triangles whose mean winding number reaches the threshold. For closed curves the
//    winding number is constant on each triangle. If curves are closer to each other than
//    refinement can handle, repeat steps 1 to 3 with points rounded to a grid, which merges nearby
//    points. The spacing of the grid is about 1e-12 of the size.
// 4. The helper refines the kept triangles. Curves and bones in these triangles, and the outline,
//    remain edges.
// 5. Number the vertices, with the vertices of the input first.
#include "planar/planar_shape.h"

#include "base/number_text.h"
#include "base/parallel.h"
#include "base/range_check.h"
#include "helper/child_process.h"
#include "helper/mesher_process.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace bindpose
{

namespace
{
constexpr Index none = -1;

Status check_segments(PlanePointsView points, SegmentsView segments, const std::string& curve_kind)
{
  for (Index e = 0; e < segments.rows(); ++e)
  {
    for (int k = 0; k < 2; ++k)
    {
      const Index v = segments(e, k);
      if (v < 0 || v >= points.rows())
      {
        return Status::invalid_input(curve_kind + " " + std::to_string(e) + " references vertex " +
          std::to_string(v) + ", but there are " + std::to_string(points.rows()) + " vertices");
      }
      if (!points.row(v).allFinite())
      {
        return Status::invalid_input(curve_kind + " " + std::to_string(e) + " references vertex " +
          std::to_string(v) + ", which has a coordinate that is not a finite number");
      }
    }
  }
  return {};
}

Status check_options(const PlanarShapeOptions& options)
{
  const Status status = check_positive("winding_threshold", options.winding_threshold);
  if (!status.ok())
  {
    return status;
  }
  constexpr double largest_angle = 33.0;
  if (!(options.min_angle >= 0.0 && options.min_angle <= largest_angle))
  {
    return Status::invalid_input("the smallest angle must be from 0 to 33 degrees");
  }
  if (!(options.edge >= 0.0) || !std::isfinite(options.edge))
  {
    return Status::invalid_input("the longest edge must be 0 or more, in bounding-box diagonals");
  }
  if (options.edge > 0.0 && options.edge < 1e-4)
  {
    return Status::invalid_input(
      "the longest edge must be 0 or at least 1e-4 bounding-box diagonals");
  }
  return check_limits(options.time_limit, options.memory_limit);
}

/// The vertices in use, where equal vertices are merged.
class MergedVertices
{
public:
  Index add(const Vec2& p, const Vec2& input_point, Index original)
  {
    const auto [entry, inserted] =
      // Adding 0 turns -0 into 0.
      this->ids_.emplace(std::make_pair(p.x() + 0.0, p.y() + 0.0), this->count());
    if (inserted)
    {
      this->points.push_back(p);
      this->originals.push_back(original);
      this->input_points.push_back(input_point);
    }
    return entry->second;
  }
  Index count() const { return static_cast<Index>(this->points.size()); }

  std::vector<Vec2> points; ///< scaled
  /// For each vertex, the lowest input id of the curve vertices that were merged into this vertex;
  /// -1 if the vertex is only the point of a handle.
  std::vector<Index> originals;
  std::vector<Vec2> input_points; ///< input positions

private:
  std::map<std::pair<double, double>, Index> ids_;
};

class Builder
{
public:
  Builder(ExecutionContext& context, PlanePointsView points, SegmentsView segments,
    const PlanarHandles& handles, const PlanarShapeOptions& options)
    : points_(points), segments_(segments), input_handles_(handles), options_(options),
      context_(context)
  {
  }

  Status run(PlanarShape& shape);

private:
  Status scale();
  void merge_vertices();
  Status arrange();
  Status keep_inside_triangles();
  Status fill();
  Status try_fill(double angle, double seconds, MesherResult& answer);
  Status number(PlanarShape& shape);
  void report(const PlanarShape& shape, Status& status) const;
  Status run_job(const std::vector<std::string>& arguments, double seconds, MesherResult& answer);
  Vec2 scaled(const Vec2& p) const;
  double smallest_height() const;
  bool has_positive_areas(bool exact) const;
  Vec2 point(Index v) const { return this->data_.points.row(v).head<2>().transpose(); }
  double mean_winding(Index triangle) const;
  Vec2 unscaled(Index v) const
  {
    const Vec2 p = this->point(v);
    return Vec2(std::ldexp(p.x(), this->exponent_), std::ldexp(p.y(), this->exponent_)) +
      this->shift_;
  }

  PlanePointsView points_;
  SegmentsView segments_;
  const PlanarHandles& input_handles_;
  const PlanarShapeOptions& options_;
  ExecutionContext& context_;
  MergedVertices merged_;
  Segments curves_; ///< segments of the curves, oriented with the inside on the left
  Segments bones_;
  std::vector<Index> handles_; ///< index in merged_ of each handle point
  int exponent_ = 0;
  Vec2 shift_ = Vec2::Zero(); ///< input point that is mapped to the scaled origin
  double rounding_ = 0.0; ///< 8 units in the last place of the coordinates, scaled
  double diagonal_ = 0.0; ///< diagonal of the curves' bounding box, scaled
  PlanePoints curve_points_; ///< scaled
  double smallest_height_ = 0.0; ///< smallest height of a kept triangle, scaled
  double minimum_height_ = 0.0; ///< smallest height that refinement can handle, scaled
  double grid_ = 0.0; ///< grid size, scaled; 0: no grid
  CurveWindingNumber winding_;
  MesherData data_;
  Index crossings_ = 0;
  Index open_ends_ = 0;
  bool reversed_ = false;
  std::vector<std::string> warnings_;
};

Status Builder::scale()
{
  Vec2 lower = Vec2::Constant(std::numeric_limits<double>::max());
  Vec2 upper = -lower;
  for (Index k = 0; k < this->segments_.size(); ++k)
  {
    const Vec2 p = this->points_.row(this->segments_.data()[k]).transpose();
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  // Half of the extent. The coordinates are halved before the subtraction, so that it cannot
  // overflow.
  const Vec2 half = 0.5 * upper - 0.5 * lower;
  if (half.maxCoeff() <= 0.0)
  {
    return Status::invalid_input("all points of the curves coincide");
  }
  std::frexp(half.maxCoeff(), &this->exponent_);
  this->exponent_ += 1;
  const auto to_scale = [&](double x) { return std::ldexp(x, -this->exponent_); };
  this->diagonal_ = 2.0 * std::hypot(to_scale(half.x()), to_scale(half.y()));
  const double farthest = to_scale(lower.cwiseAbs().cwiseMax(upper.cwiseAbs()).maxCoeff());
  if (!std::isfinite(farthest))
  {
    return Status::invalid_input("the curves are too far from the origin for their size");
  }
  // Subtracting the shift must not cause rounding. The difference of two numbers is exact if they
  // differ by at most a factor of two (Sterbenz).
  for (int k = 0; k < 2; ++k)
  {
    const double size = 2.0 * half[k];
    this->shift_[k] = lower[k] > size ? lower[k] : upper[k] < -size ? upper[k] : 0.0;
  }
  this->rounding_ = 0x1p-49 * farthest;
  // The minimum height is the accuracy of the coordinates, but at least 2^-40 of the diagonal, and
  // is rounded up to a power of two. Intended details are larger than 2^-40 of the diagonal.
  int exponent = 0;
  std::frexp(std::max(0x1p-40 * this->diagonal_, this->rounding_), &exponent);
  this->minimum_height_ = std::ldexp(1.0, exponent);
  return {};
}

/// Scale a point, and round it to the grid if there is one.
Vec2 Builder::scaled(const Vec2& p) const
{
  const Vec2 moved = p - this->shift_;
  Vec2 result(std::ldexp(moved.x(), -this->exponent_), std::ldexp(moved.y(), -this->exponent_));
  if (this->grid_ > 0.0)
  {
    result = Vec2(std::round(result.x() / this->grid_), std::round(result.y() / this->grid_)) *
      this->grid_;
  }
  return result;
}

void Builder::merge_vertices()
{
  this->merged_ = MergedVertices();
  this->handles_.clear();
  const auto add = [&](const Vec2& input_point, Index original)
  { return this->merged_.add(this->scaled(input_point), input_point, original); };
  const std::set<Index> used(
    this->segments_.data(), this->segments_.data() + this->segments_.size());
  std::map<Index, Index> gathered;
  for (const Index v : used) // in ascending order, so that the lowest id represents equal points
  {
    gathered[v] = add(this->points_.row(v).transpose(), v);
  }
  this->curves_.resize(this->segments_.rows(), 2);
  for (Index e = 0; e < this->segments_.rows(); ++e)
  {
    this->curves_.row(e) << gathered[this->segments_(e, 0)], gathered[this->segments_(e, 1)];
  }
  const PlanarHandles& handles = this->input_handles_;
  for (Index h = 0; h < handles.points.rows(); ++h)
  {
    this->handles_.push_back(add(handles.points.row(h).transpose(), none));
  }
  this->bones_.resize(handles.bones.rows(), 2);
  for (Index b = 0; b < handles.bones.rows(); ++b)
  {
    this->bones_.row(b) << this->handles_[handles.bones(b, 0)], this->handles_[handles.bones(b, 1)];
  }
  this->data_ = MesherData();
  this->data_.points.resize(this->merged_.count(), 3);
  for (Index v = 0; v < this->merged_.count(); ++v)
  {
    this->data_.points.row(v) << this->merged_.points[v].transpose(), 0.0;
  }
  this->curve_points_ = this->data_.points.leftCols<2>();
}

Status Builder::run_job(
  const std::vector<std::string>& arguments, double seconds, MesherResult& answer)
{
  MesherRequest request;
  request.arguments = arguments;
  request.time_limit = seconds;
  request.memory_limit = this->options_.memory_limit;
  if (request.time_limit <= 0.0)
  {
    return Status::failure(StatusCode::internal_error,
      "the time limit of " + short_number(this->options_.time_limit) +
        " s was reached before the step " + arguments.front());
  }
  return run_mesher(this->context_, request, this->data_, answer);
}

Status Builder::arrange()
{
  const Phase phase(this->context_, "arrange", 0.0, 0.4);
  this->data_.segments.resize(this->curves_.rows() + this->bones_.rows(), 2);
  this->data_.segments << this->curves_, this->bones_;
  MesherResult answer;
  const Status status = this->run_job({ "arrange", "--grid", exact_number(this->grid_) },
    this->options_.time_limit - this->context_.elapsed_seconds(), answer);
  if (!status.ok())
  {
    return status;
  }
  this->data_ = std::move(answer.data);
  this->crossings_ = this->data_.points.rows() - this->merged_.count();
  if (this->data_.triangles.rows() == 0)
  {
    return Status::invalid_input(
      "all points of the curves are on one line, so they enclose nothing");
  }
  return {};
}

/// Return the mean winding number of a triangle, by a quadrature rule of degree 5 with 7 points
/// (Radon). One point is the triangle's center. For each corner, two points are on the line through
/// the corner and the center, one on either side of the center.
double Builder::mean_winding(Index triangle) const
{
  const Vec2 a = this->point(this->data_.triangles(triangle, 0));
  const Vec2 b = this->point(this->data_.triangles(triangle, 1));
  const Vec2 c = this->point(this->data_.triangles(triangle, 2));
  const Vec2 center = (a + b + c) / 3.0;
  const double root = std::sqrt(15.0);
  if (this->open_ends_ == 0)
  {
    return this->winding_.evaluate_at(center);
  }
  double sum = 9.0 / 40.0 * this->winding_.evaluate_at(center);
  for (const double sign : { -1.0, 1.0 })
  {
    const double weight = (155.0 + sign * root) / 1200.0;
    // Position on the line from the triangle's center (0) to a corner (1). A negative position is
    // on the other side of the center.
    const double distance_fraction = (1.0 - sign * root) / 7.0;
    for (const Vec2& corner : { a, b, c })
    {
      sum += weight * this->winding_.evaluate_at(center + distance_fraction * (corner - center));
    }
  }
  return sum;
}

double Builder::smallest_height() const
{
  double smallest = std::numeric_limits<double>::max();
  for (Index t = 0; t < this->data_.triangles.rows(); ++t)
  {
    const Vec2 a = this->point(this->data_.triangles(t, 0));
    const Vec2 b = this->point(this->data_.triangles(t, 1)) - a;
    const Vec2 c = this->point(this->data_.triangles(t, 2)) - a;
    const double longest = std::max({ b.norm(), c.norm(), (c - b).norm() });
    smallest = std::min(smallest, cross(b, c) / longest);
  }
  return smallest;
}

Status Builder::keep_inside_triangles()
{
  const Phase phase(this->context_, "winding", 0.4, 0.5);
  Status status = this->winding_.build(this->context_, this->curve_points_, this->curves_);
  if (status.ok() && status.report.number("area", 0.0) < 0.0)
  {
    this->reversed_ = true;
    this->curves_.col(0).swap(this->curves_.col(1));
    status = this->winding_.build(this->context_, this->curve_points_, this->curves_);
  }
  if (!status.ok())
  {
    return status;
  }
  this->open_ends_ = static_cast<Index>(status.report.number("counts.open_ends", 0.0));
  Eigen::VectorXd means(this->data_.triangles.rows());
  const bool complete = parallel_for(this->context_, means.size(), 256,
    [&](Index begin, Index end)
    {
      for (Index t = begin; t < end; ++t)
      {
        means[t] = this->mean_winding(t);
      }
    });
  if (!complete)
  {
    return Status::canceled();
  }
  std::set<std::pair<Index, Index>> edges;
  Index kept = 0;
  for (Index t = 0; t < means.size(); ++t)
  {
    if (means[t] >= this->options_.winding_threshold - 1e-9)
    {
      for (int k = 0; k < 3; ++k)
      {
        edges.insert(std::minmax(
          Index(this->data_.triangles(t, k)), Index(this->data_.triangles(t, (k + 1) % 3))));
      }
      this->data_.triangles.row(kept++) = this->data_.triangles.row(t).eval();
    }
  }
  if (kept == 0)
  {
    return Status::invalid_input("the curves enclose nothing: the largest winding number is " +
      short_number(means.maxCoeff()) + ", below the threshold of " +
      short_number(this->options_.winding_threshold));
  }
  this->data_.triangles.conservativeResize(kept, 3);
  this->smallest_height_ = this->smallest_height();
  Index inside = 0;
  for (Index e = 0; e < this->data_.segments.rows(); ++e)
  {
    const Index a = this->data_.segments(e, 0);
    const Index b = this->data_.segments(e, 1);
    if (edges.count(std::minmax(a, b)))
    {
      this->data_.segments.row(inside++) << a, b;
    }
  }
  this->data_.segments.conservativeResize(inside, 2);
  return {};
}

Status Builder::fill()
{
  const Phase phase(this->context_, "fill", 0.5, 1.0);
  // Minimum angle in degrees that refinement always reaches, see fill_plane().
  constexpr double guaranteed_angle = 20.6;
  std::vector<double> angles{ this->options_.min_angle };
  for (const double weaker : { guaranteed_angle, 0.0 })
  {
    if (weaker < angles.back())
    {
      angles.push_back(weaker);
    }
  }
  MesherResult answer;
  Status status;
  for (std::size_t k = 0; k < angles.size(); ++k)
  {
    // The helper may crash or hang on gaps at the limit of double precision. Therefore half of the
    // remaining time is kept for an attempt with a smaller angle.
    const double seconds = this->options_.time_limit - this->context_.elapsed_seconds();
    status = this->try_fill(angles[k], k + 1 < angles.size() ? 0.5 * seconds : seconds, answer);
    if (status.code != StatusCode::internal_error)
    {
      break;
    }
  }
  if (!status.ok())
  {
    return status;
  }
  this->data_ = std::move(answer.data);
  if (answer.report.number("stopped", 0.0) > 0.0)
  {
    this->warnings_.emplace_back("the refinement of the triangles was stopped because it would "
                                 "have needed too many points or too much time");
  }
  else if (answer.report.number("min_angle", 0.0) < this->options_.min_angle)
  {
    this->warnings_.emplace_back("a smallest angle of " + short_number(this->options_.min_angle) +
      " degrees could not be reached everywhere; the refinement used " +
      short_number(answer.report.number("min_angle", 0.0)) + " degrees");
  }
  return {};
}

Status Builder::try_fill(double angle, double seconds, MesherResult& answer)
{
  // Fraction of the time for refinement; the rest is for reading and writing.
  constexpr double part = 0.8;
  // Smallest useful size of triangles, as a fraction of the finest detail.
  constexpr double minimum_size_fraction = 0x1p-10;
  const double edge = this->options_.edge * this->diagonal_;
  const double detail =
    edge > 0.0 ? std::min(edge, this->smallest_height_) : this->smallest_height_;
  const double floor = std::max(minimum_size_fraction * detail, this->rounding_);
  return this->run_job(
    { "fill-plane", "--min-angle", exact_number(angle), "--edge", exact_number(edge), "--floor",
      exact_number(floor), "--time", exact_number(part * seconds) },
    seconds, answer);
}

/// Report whether all triangles have a positive area in input coordinates, after their points were
/// rounded to doubles.
/// @param exact use the exact input coordinates of input points instead of their positions on the
/// grid.
bool Builder::has_positive_areas(bool exact) const
{
  const auto input_point = [&](Index v) {
    return exact && v < this->merged_.count() ? this->merged_.input_points[v] : this->unscaled(v);
  };
  for (Index t = 0; t < this->data_.triangles.rows(); ++t)
  {
    const auto side = [&](int from, int to) // edge vector, scaled, because areas could underflow
    {
      const Vec2 edge_vector =
        input_point(this->data_.triangles(t, to)) - input_point(this->data_.triangles(t, from));
      return Vec2(std::ldexp(edge_vector.x(), -this->exponent_),
        std::ldexp(edge_vector.y(), -this->exponent_));
    };
    const Vec2 b = side(0, 1);
    const Vec2 c = side(0, 2);
    if (!(cross(b, c) > 0.0))
    {
      return false;
    }
  }
  return true;
}

Status Builder::number(PlanarShape& shape)
{
  const bool exact = this->has_positive_areas(true);
  if (!exact && !this->has_positive_areas(false))
  {
    return Status::failure(StatusCode::internal_error,
      "rounding flipped a triangle because the curves are too far from the origin for their level "
      "of detail");
  }
  std::vector<Index> ids(static_cast<std::size_t>(this->data_.points.rows()), none);
  for (Index k = 0; k < this->data_.triangles.size(); ++k)
  {
    ids[this->data_.triangles.data()[k]] = 0;
  }
  const auto count = static_cast<Index>(std::count(ids.begin(), ids.end(), 0));
  shape.points.resize(count, 2);
  shape.original_vertices.assign(static_cast<std::size_t>(count), none);
  Index at = 0;
  // Vertices of the input come first, in ascending order.
  for (Index v = 0; v < static_cast<Index>(ids.size()); ++v)
  {
    if (ids[v] == none)
    {
      continue;
    }
    const bool gathered = v < this->merged_.count();
    const Vec2 input_point = gathered && exact ? this->merged_.input_points[v] : this->unscaled(v);
    shape.points.row(at) = input_point.transpose();
    shape.original_vertices[at] = gathered ? this->merged_.originals[v] : none;
    ids[v] = at++;
  }
  shape.handle_vertices.clear();
  for (const Index v : this->handles_)
  {
    shape.handle_vertices.push_back(ids[v]);
  }
  const Index triangles = this->data_.triangles.rows();
  shape.winding_numbers.resize(triangles);
  shape.triangles.resize(triangles, 3);
  for (Index t = 0; t < triangles; ++t)
  {
    Vec2 center = Vec2::Zero();
    for (int k = 0; k < 3; ++k)
    {
      center += this->point(this->data_.triangles(t, k)) / 3.0;
      shape.triangles(t, k) = ids[this->data_.triangles(t, k)];
    }
    shape.winding_numbers[t] = this->winding_.evaluate_at(center);
  }
  return {};
}

void Builder::report(const PlanarShape& shape, Status& status) const
{
  double area = 0.0;
  double longest = 0.0;
  double smallest_angle = 180.0;
  for (Index t = 0; t < shape.triangles.rows(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Vec2 a = this->point(this->data_.triangles(t, k));
      const Vec2 b = this->point(this->data_.triangles(t, (k + 1) % 3)) - a;
      const Vec2 c = this->point(this->data_.triangles(t, (k + 2) % 3)) - a;
      area += k == 0 ? 0.5 * cross(b, c) : 0.0;
      longest = std::max(longest, b.norm());
      smallest_angle = std::min(smallest_angle, std::atan2(cross(b, c), b.dot(c)) * 180.0 / M_PI);
    }
  }
  const auto kept = std::count_if(shape.original_vertices.begin(), shape.original_vertices.end(),
    [](Index original) { return original != none; });
  Report& report = status.report;
  report.set("counts.points",
    static_cast<Index>(std::count_if(this->merged_.originals.begin(), this->merged_.originals.end(),
      [](Index original) { return original != none; })));
  report.set("counts.segments", this->curves_.rows());
  report.set("counts.crossings", this->crossings_);
  report.set("counts.open_ends", this->open_ends_);
  report.set("counts.vertices", shape.points.rows());
  report.set("counts.triangles", shape.triangles.rows());
  report.set("counts.kept_points", static_cast<Index>(kept));
  report.set("area", std::ldexp(area, 2 * this->exponent_));
  report.set("min_angle", smallest_angle);
  report.set("longest_edge", std::ldexp(longest, this->exponent_));
  report.set("turned", this->reversed_ ? 1 : 0);
  report.set("grid", std::ldexp(this->grid_, this->exponent_));
  status.warnings = this->warnings_;
  if (this->reversed_)
  {
    status.warnings.emplace_back(
      "the curves were reversed because they were clockwise around the region that they enclose");
  }
  if (!this->handles_.empty())
  {
    const auto outside = static_cast<Index>(
      std::count(shape.handle_vertices.begin(), shape.handle_vertices.end(), none));
    report.set("counts.outside_handles", outside);
    if (outside > 0)
    {
      status.warnings.push_back(std::to_string(outside) + " of " +
        std::to_string(shape.handle_vertices.size()) +
        " handle points are outside the shape and did not become vertices");
    }
  }
}

Status Builder::run(PlanarShape& shape)
{
  Status status = this->scale();
  for (int attempt = 0; status.ok() && attempt < 2; ++attempt)
  {
    this->merge_vertices();
    status = this->arrange();
    status = status.ok() ? this->keep_inside_triangles() : status;
    if (!status.ok() || this->grid_ > 0.0 || this->smallest_height_ >= this->minimum_height_)
    {
      break;
    }
    this->grid_ = this->minimum_height_;
  }
  status = status.ok() ? this->fill() : status;
  status = status.ok() ? this->number(shape) : status;
  if (status.ok())
  {
    this->report(shape, status);
  }
  return status;
}
} // namespace

Status planar_shape(ExecutionContext& context, PlanePointsView points, SegmentsView segments,
  const PlanarHandles& handles, const PlanarShapeOptions& options, PlanarShape& shape)
{
  shape = PlanarShape();
  Status status = check_options(options);
  if (status.ok() && segments.rows() == 0)
  {
    status = Status::invalid_input("the input has no curves");
  }
  if (status.ok())
  {
    status = check_segments(points, segments, "segment");
  }
  if (status.ok())
  {
    status = check_segments(handles.points, handles.bones, "bone");
  }
  if (status.ok() && !handles.points.allFinite())
  {
    status = Status::invalid_input("a handle has a coordinate that is not a finite number");
  }
  if (!status.ok())
  {
    return status;
  }
  if (context.canceled())
  {
    return Status::canceled();
  }
  return Builder(context, points, segments, handles, options).run(shape);
}

} // namespace bindpose
