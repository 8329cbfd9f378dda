// Generalized winding numbers of triangle meshes: choice of the method, exact and fast evaluation.
//
// The build merges equal vertices, drops triangles that use a vertex twice, counts edges, chooses a
// method and builds its data structures. The evaluation treats each point independently, so that
// results are bit-identical for every number of threads and every extent of a grid.
//
// The methods `crossings` and `fast` close the surface by caps over its boundary. Surface and caps
// together have an integer winding number, which ray crossings count. Then the winding number of
// the caps is subtracted: the method `crossings` computes an exact sum over the caps, the method
// `fast` evaluates a DipoleField. If the point touches the surface or a cap, the tree or the plain
// sum is used instead.
//
// All computations use coordinates that are scaled to a size of about 1 and shifted to the origin
// without rounding (ExactFrame).
#include "winding/winding_number.h"

#include "base/constants.h"
#include "base/large_pages.h"
#include "base/parallel.h"
#include "geometry/point_order.h"
#include "solid_angle/solid_angle.h"
#include "winding/boundary_caps.h"
#include "winding/dipole_field.h"
#include "winding/point_values.h"
#include "winding/ray_crossings.h"
#include "winding/welded_surface.h"
#include "winding/winding_cells.h"
#include "winding/winding_tree.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <sstream>

namespace bindpose
{

namespace
{
/// Up to this many triangles the plain sum takes no more time than a data structure.
constexpr Index few_triangles = 24;
/// Up to this many open edges (edges whose directions do not cancel), the sum over the caps takes
/// less time than a descent of the tree. The tree is also slower if the number of open edges is at
/// least half the number of triangles. Measured: 14-20 ns per open edge, 20 ns per triangle, 20 to
/// 600 us for the tree (more on rougher surfaces).
constexpr Index few_open_edges = 15000;
/// Up to this many open edges, the exact sum over the caps takes about as much time as the
/// DipoleField of the caps.
constexpr Index hardly_open = 12;
/// Measured nanoseconds of WindingCells: to build, per triangle; to evaluate a point; to evaluate a
/// sample of a row.
constexpr double cells_per_face = 450.0;
constexpr double cells_per_point = 40.0;
constexpr double cells_per_sample = 6.0;
/// Nanoseconds to write a sample of a row.
constexpr double write_per_sample = 1.0;
/// Largest number of points for which rays are used; each point takes 30 bytes.
constexpr Index most_ray_points = 1 << 22;

double direct_sum(
  PointsView points, TrianglesView triangles, const Vec3& p, double tolerance, bool* on_surface)
{
  SolidAngleSum sum(p, tolerance);
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    sum.add(points.row(triangles(t, 0)), points.row(triangles(t, 1)), points.row(triangles(t, 2)));
  }
  if (on_surface)
  {
    *on_surface = sum.on_surface();
  }
  return sum.winding_number();
}
} // namespace

const char* to_string(WindingMethod method)
{
  switch (method)
  {
    case WindingMethod::automatic:
      return "automatic";
    case WindingMethod::exact:
      return "exact";
    case WindingMethod::fast:
      return "fast";
    case WindingMethod::direct:
      return "direct";
    case WindingMethod::hierarchical:
      return "hierarchical";
    case WindingMethod::crossings:
      return "crossings";
  }
  return "automatic";
}

struct WindingNumber::Parts
{
  Status status;
  WindingMethod method = WindingMethod::direct;
  ExactFrame frame;
  Points points;
  Triangles triangles;
  Index max_leaf_size = 64;
  // The tree is built on first use, because points that touch the surface are rare.
  mutable WindingTree tree;
  mutable std::mutex tree_mutex;
  mutable std::atomic<bool> tree_built{ false };
  // The cells are built during the build, or later when they save time. Until then, crossings are
  // counted by rays, which gives the same values.
  mutable WindingCells cells;
  mutable std::mutex cells_mutex;
  mutable std::atomic<bool> cells_built{ false };
  /// Sum of the predicted times of all ray counts so far.
  mutable std::atomic<double> ray_nanoseconds{ 0.0 };
  std::unique_ptr<RayCrossings> rays;
  std::vector<Edge> rim; ///< edges whose directions do not cancel
  Triangles caps; ///< triangles that close the surface (boundary_caps.h)
  SurfaceBoundary boundary; ///< boundary edges and components, in ids and units of the input
  DipoleField field; ///< field of the caps, used by the method `fast`

  bool by_crossings() const
  {
    return this->method == WindingMethod::crossings || this->method == WindingMethod::fast;
  }
  void choose(WindingMethod wanted, Index open_edges);
  bool build_tree(ExecutionContext& context) const;
  bool build_cells(ExecutionContext& context) const;
  bool rays_pay(double ray_cost, double cell_cost) const;
  /// Add to ray_nanoseconds; evaluations may run at the same time.
  void add_ray_cost(double nanoseconds) const
  {
    double sum = this->ray_nanoseconds;
    while (!this->ray_nanoseconds.compare_exchange_weak(sum, sum + nanoseconds))
    {
    }
  }
  void at(const Vec3* queries, Index number, const int* counts, const unsigned char* resolved,
    double* winding_numbers, bool* on_surface) const;
  Vec3 gradient_at(const Vec3& point) const;
  double slowly_at(const Vec3& framed, bool* on_surface) const;
  bool reaches(const SampleGrid& grid) const;
  void caps_at(const Vec3* framed, Index count, double* winding_numbers, bool* touches) const;
};

WindingNumber::WindingNumber() : parts_(new Parts) {}
WindingNumber::WindingNumber(PointsView points, TrianglesView triangles) : parts_(new Parts)
{
  ExecutionContext context;
  this->build(context, points, triangles);
}
WindingNumber::~WindingNumber() = default;
WindingNumber::WindingNumber(WindingNumber&&) noexcept = default;
WindingNumber& WindingNumber::operator=(WindingNumber&&) noexcept = default;

void WindingNumber::Parts::choose(WindingMethod wanted, Index open_edges)
{
  const Index count = this->triangles.rows();
  std::string reason = "requested";
  this->method = wanted;
  const std::string numbers =
    std::to_string(count) + " triangles, " + std::to_string(open_edges) + " open edges: ";
  if (wanted == WindingMethod::fast && open_edges == 0)
  {
    this->method = WindingMethod::crossings;
    reason = numbers + "a closed surface, for which an exact method is as fast";
  }
  else if (wanted == WindingMethod::automatic && count > few_triangles && open_edges > hardly_open)
  {
    this->method = WindingMethod::fast;
    reason = numbers + "exact sums over the open edges would take many times longer";
  }
  else if (wanted == WindingMethod::automatic || wanted == WindingMethod::exact)
  {
    if (count <= few_triangles && open_edges > 0)
    {
      this->method = WindingMethod::direct;
      reason = numbers + "a direct sum is fastest for so few triangles";
    }
    else if (2 * open_edges > 3 * count)
    {
      this->method = WindingMethod::direct;
      reason =
        numbers + "a triangle soup with almost no shared edges, for which a direct sum is fastest";
    }
    else if (open_edges <= few_open_edges || 2 * open_edges >= count)
    {
      this->method = WindingMethod::crossings;
      reason = numbers +
        (open_edges ? "ray crossings plus a sum over the open edges is fastest"
                    : "a closed surface needs only ray crossings");
    }
    else
    {
      this->method = WindingMethod::hierarchical;
      reason = numbers + "too many open edges for a sum at every point";
    }
  }
  this->status.report.set("method", to_string(this->method));
  this->status.report.set("method_reason", reason);
}

Status WindingNumber::build(
  ExecutionContext& context, PointsView points, TrianglesView triangles, const Options& options)
{
  this->parts_.reset(new Parts);
  Parts& parts = *this->parts_;
  Status& status = parts.status;
  status = check_mesh(points, triangles);
  if (status.ok() && triangles.rows() > std::numeric_limits<std::int32_t>::max() / 4)
  {
    status = Status::invalid_input("the surface has " + std::to_string(triangles.rows()) +
      " triangles: expected fewer than 2^29");
  }
  if (status.ok() && points.rows() > std::numeric_limits<std::int32_t>::max())
  {
    status = Status::invalid_input(
      "the surface has " + std::to_string(points.rows()) + " points; the maximum is 2^31 - 1");
  }
  if (status.ok() && options.expected_queries < 0)
  {
    status = Status::invalid_input(
      "expected_queries must be at least 0 (got " + std::to_string(options.expected_queries) + ")");
  }
  if (status.ok() && !(options.tolerance >= 1e-8 && options.tolerance <= 0.1))
  {
    std::ostringstream text;
    text << "the tolerance must be from 1e-8 to 0.1, not " << options.tolerance;
    status = Status::invalid_input(text.str());
  }
  if (status.ok() && (options.max_leaf_size < 1 || options.max_leaf_size > 10000))
  {
    status = Status::invalid_input(
      "max_leaf_size must be from 1 to 10000, not " + std::to_string(options.max_leaf_size));
  }
  if (!status.ok())
  {
    return status;
  }

  Report& report = status.report;
  parts.frame = triangles.rows() ? ExactFrame(bounding_box(points, triangles)) : ExactFrame();
  WeldedSurface welded;
  bool done = true;
  {
    const ProgressRange range(context, 0.0, 0.4);
    done = weld_surface(context, points, triangles, parts.frame, welded);
  }
  parts.points = std::move(welded.points);
  parts.triangles = std::move(welded.triangles);
  if (done)
  {
    parts.rim = std::move(welded.open_edges);
    const auto open = static_cast<Index>(parts.rim.size());
    parts.caps = boundary_caps(parts.rim);
    parts.boundary = surface_boundary(parts.points, parts.triangles, parts.rim, parts.caps);
    const double unit = 1.0 / parts.frame.scale;
    double volume = 0.0;
    for (SurfaceBoundary::BoundaryEdge& edge : parts.boundary.edges)
    {
      edge.from = welded.original_vertices[edge.from];
      edge.to = welded.original_vertices[edge.to];
    }
    for (SurfaceBoundary::Component& component : parts.boundary.components)
    {
      component.volume *= unit * unit * unit;
      volume += component.volume;
    }
    report.set("counts.vertices", points.rows());
    report.set("counts.triangles", triangles.rows());
    report.set("counts.boundary_edges", welded.boundary_edges);
    report.set("counts.nonmanifold_edges", welded.nonmanifold_edges);
    report.set("counts.open_edges", open);
    report.set("counts.components", static_cast<Index>(parts.boundary.components.size()));
    report.set("counts.merged_vertices", welded.merged_vertices);
    report.set("counts.degenerate_triangles", welded.degenerate_triangles);
    report.set("counts.duplicate_triangles", welded.duplicate_triangles);
    report.set("volume", volume);
    parts.choose(options.method, open);
    if (parts.triangles.rows() == 0)
    {
      status.warnings.push_back(triangles.rows() == 0
          ? "the surface has no triangles, so its winding number is 0 everywhere"
          : "all triangles are degenerate, so the winding number is 0 everywhere");
      parts.method = WindingMethod::direct;
    }
  }
  // The plain sum needs the minimum number of caps; the cells of the field need caps of minimum
  // size.
  if (done && parts.method == WindingMethod::fast &&
    !DipoleField::sums_all(options.expected_queries))
  {
    parts.caps = smaller_caps(parts.points, parts.triangles, parts.caps);
  }
  parts.max_leaf_size = options.max_leaf_size;
  if (done && parts.method == WindingMethod::hierarchical)
  {
    const ProgressRange range(context, 0.4, 1.0);
    done = parts.build_tree(context);
  }
  if (done && parts.by_crossings())
  {
    const ProgressRange range(context, 0.4, parts.method == WindingMethod::fast ? 0.6 : 1.0);
    parts.rays = std::make_unique<RayCrossings>(
      parts.points, parts.triangles, parts.caps, parts.frame.tolerance);
    // If the number of queries is known, the first evaluation chooses between rays and cells.
    done = options.expected_queries > 0 || parts.build_cells(context);
  }
  if (done && parts.method == WindingMethod::fast)
  {
    const ProgressRange range(context, 0.6, 1.0);
    DipoleField::Options field;
    field.tolerance = options.tolerance;
    field.expected_points = options.expected_queries;
    // The default padding of grids, as a fraction of the bounding-box diagonal.
    constexpr double padding = 0.1;
    field.region = bounding_box(parts.points, parts.triangles);
    const double pad = padding * field.region.diagonal();
    field.region.lower.array() -= pad;
    field.region.upper.array() += pad;
    // The field cuts long caps at rounded positions. Points for which this rounding matters count
    // as touching a cap. The exact sum is used for these points.
    const double shows = parts.frame.tolerance / options.tolerance;
    done = parts.field.build(context, parts.points, parts.caps,
      std::vector<int>(static_cast<std::size_t>(parts.caps.rows()), 1), shows, field);
    report.set("error_bound", options.tolerance);
    report.set("measured_error", parts.field.measured_error());
  }
  if (!done)
  {
    this->parts_.reset(new Parts);
    this->parts_->status = Status::canceled();
  }
  return this->parts_->status;
}

const Status& WindingNumber::status() const
{
  return this->parts_->status;
}

WindingMethod WindingNumber::method() const
{
  return this->parts_->method;
}

const SurfaceBoundary& WindingNumber::boundary() const
{
  return this->parts_->boundary;
}

Index WindingNumber::memory() const
{
  return static_cast<Index>(sizeof(double)) * this->parts_->points.size() +
    static_cast<Index>(sizeof(Index)) *
    (this->parts_->triangles.size() + this->parts_->caps.size()) +
    this->parts_->tree.memory() + this->parts_->cells.memory() + this->parts_->field.memory();
}

/// Report whether counting crossings by rays is faster than by cells. `ray_cost` and `cell_cost`
/// are the predicted times of this evaluation in nanoseconds. Cells that do not exist count as
/// slower until the total time of rays would exceed the time to build the cells.
bool WindingNumber::Parts::rays_pay(double ray_cost, double cell_cost) const
{
  if (this->cells_built)
  {
    return ray_cost < cell_cost;
  }
  const double build =
    cells_per_face * static_cast<double>(this->triangles.rows() + this->caps.rows());
  return this->ray_nanoseconds + ray_cost < build + cell_cost;
}

bool WindingNumber::Parts::build_cells(ExecutionContext& context) const
{
  const std::lock_guard<std::mutex> lock(this->cells_mutex);
  this->cells_built = this->cells_built ||
    this->cells.build(context, this->points, this->triangles, this->caps, this->frame.tolerance);
  return this->cells_built;
}

/// Evaluate up to WindingCells::most_at_once points. `counts` and `resolved` are the results of
/// RayCrossings for these points, or null.
void WindingNumber::Parts::at(const Vec3* queries, Index number, const int* counts,
  const unsigned char* resolved, double* winding_numbers, bool* on_surface) const
{
  std::array<Vec3, WindingCells::most_at_once> framed;
  framed.fill(Vec3::Zero());
  // Indices of the points that need an evaluation.
  std::array<Index, WindingCells::most_at_once> asked;
  Index count = 0;
  for (Index i = 0; i < number; ++i)
  {
    on_surface[i] = false;
    const Vec3 p = this->frame(queries[i]);
    winding_numbers[i] = queries[i].allFinite() ? 0.0 : std::numeric_limits<double>::quiet_NaN();
    if (this->triangles.rows() > 0 && p.cwiseAbs().maxCoeff() < far_away)
    {
      framed[count] = p;
      asked[count++] = i;
    }
  }
  if (!this->by_crossings())
  {
    for (Index k = 0; k < count; ++k)
    {
      winding_numbers[asked[k]] = this->slowly_at(framed[k], &on_surface[asked[k]]);
    }
    return;
  }
  std::array<int, WindingCells::most_at_once> crossed;
  std::array<bool, WindingCells::most_at_once> is_resolved;
  if (counts)
  {
    for (Index k = 0; k < count; ++k)
    {
      crossed[k] = counts[asked[k]];
      is_resolved[k] = resolved[asked[k]] != 0;
    }
  }
  else
  {
    if (!this->cells_built)
    {
      ExecutionContext quiet;
      this->build_cells(quiet);
    }
    this->cells.evaluate(framed.data(), count, crossed.data(), is_resolved.data());
  }
  std::array<double, WindingCells::most_at_once> of_caps;
  std::array<bool, WindingCells::most_at_once> touches;
  this->caps_at(framed.data(), count, of_caps.data(), touches.data());
  for (Index k = 0; k < count; ++k)
  {
    winding_numbers[asked[k]] = is_resolved[k] && !touches[k]
      ? crossed[k] - of_caps[k]
      : this->slowly_at(framed[k], &on_surface[asked[k]]);
  }
}

/// Compute the winding numbers of the caps at the points, and report whether a point touches a cap.
void WindingNumber::Parts::caps_at(
  const Vec3* framed, Index count, double* winding_numbers, bool* touches) const
{
  if (this->method == WindingMethod::fast && this->caps.rows() > 0)
  {
    this->field.evaluate(framed, count, winding_numbers, touches);
    return;
  }
  for (Index i = 0; i < count; ++i)
  {
    touches[i] = false;
    winding_numbers[i] = this->caps.rows() > 0
      ? direct_sum(this->points, this->caps, framed[i], this->frame.tolerance, &touches[i])
      : 0.0;
  }
}

/// Build the tree if it does not exist. Called when the first point needs the tree.
bool WindingNumber::Parts::build_tree(ExecutionContext& context) const
{
  const std::lock_guard<std::mutex> lock(this->tree_mutex);
  this->tree_built = this->tree_built ||
    this->tree.build(
      context, this->points, this->triangles, this->frame.tolerance, this->max_leaf_size);
  return this->tree_built;
}

/// Evaluate a point by a method that is correct everywhere: the plain sum or the tree.
double WindingNumber::Parts::slowly_at(const Vec3& p, bool* on_surface) const
{
  if (this->method == WindingMethod::direct)
  {
    return direct_sum(this->points, this->triangles, p, this->frame.tolerance, on_surface);
  }
  if (!this->tree_built)
  {
    ExecutionContext quiet;
    this->build_tree(quiet);
  }
  SolidAngleSum sum(p, this->frame.tolerance);
  this->tree.add_to(sum, p);
  if (on_surface)
  {
    *on_surface = sum.on_surface();
  }
  // Round the value to an integer if the surface is closed, because WindingCells returns integers
  // for the other points.
  const bool whole = this->rim.empty() && !sum.on_surface();
  return whole ? std::round(sum.winding_number()) : sum.winding_number();
}

double WindingNumber::evaluate_exactly_at(const Vec3& point, bool* on_surface) const
{
  const Parts& parts = *this->parts_;
  const Vec3 p = parts.frame(point);
  if (parts.method == WindingMethod::fast && parts.triangles.rows() > 0 &&
    p.cwiseAbs().maxCoeff() < far_away)
  {
    bool touches = false;
    const double winding_number = parts.slowly_at(p, &touches);
    if (on_surface)
    {
      *on_surface = touches;
    }
    return winding_number;
  }
  return this->evaluate_at(point, on_surface);
}

double WindingNumber::evaluate_at(const Vec3& point, bool* on_surface) const
{
  double winding_number = 0.0;
  bool touches = false;
  this->parts_->at(&point, 1, nullptr, nullptr, &winding_number, &touches);
  if (on_surface)
  {
    *on_surface = touches;
  }
  return winding_number;
}

template <typename PointAt>
Status WindingNumber::evaluate_points(ExecutionContext& context, Index count,
  const PointAt& point_at, double* out, unsigned char* on_surface) const
{
  const Parts& parts = *this->parts_;
  if (!parts.status.ok())
  {
    return parts.status;
  }
  std::vector<int> counts;
  std::vector<unsigned char> resolved;
  bool by_rays = false;
  if (parts.by_crossings() && count > 0 && parts.triangles.rows() > 0)
  {
    const double ray_cost = parts.rays->predicted_nanoseconds(count);
    by_rays = count <= most_ray_points &&
      parts.rays_pay(ray_cost, cells_per_point * static_cast<double>(count));
    const ProgressRange range(context, 0.0, 0.5);
    if (by_rays)
    {
      parts.add_ray_cost(ray_cost);
      std::vector<Vec3> framed;
      reserve_in_large_pages(framed, static_cast<std::size_t>(count));
      for (Index i = 0; i < count; ++i)
      {
        framed.push_back(parts.frame(point_at(i)));
      }
      counts.resize(static_cast<std::size_t>(count));
      resolved.resize(static_cast<std::size_t>(count));
      if (!parts.rays->count(context, framed.data(), count, counts.data(), resolved.data()))
      {
        return Status::canceled();
      }
    }
    else if (!parts.cells_built && !parts.build_cells(context))
    {
      return Status::canceled();
    }
  }
  const ProgressRange range(context, by_rays ? 0.5 : 0.0, 1.0);
  // The estimate for the tree is the worst case, in which the tree takes the time of the plain sum.
  const double nanoseconds = parts.method == WindingMethod::fast ? 500.0
    : parts.method == WindingMethod::crossings
    ? 100.0 + 20.0 * static_cast<double>(parts.caps.rows())
    : 20.0 * static_cast<double>(parts.triangles.rows());
  return point_values(context, count, nanoseconds, out, on_surface,
    [&](Index begin, Index end, unsigned char* flags)
    {
      // Sort the points spatially, so that neighboring points use the data of a cell while it is in
      // the cache.
      const Index count_here = end - begin;
      std::vector<Vec3> points(static_cast<std::size_t>(count_here));
      for (Index i = 0; i < count_here; ++i)
      {
        points[i] = point_at(begin + i);
      }
      const std::vector<std::int32_t> order = spatial_sort(points);
      constexpr Index at_once = WindingCells::most_at_once;
      std::array<Vec3, at_once> some;
      std::array<double, at_once> values;
      std::array<bool, at_once> touches;
      std::array<int, at_once> counts_here;
      std::array<unsigned char, at_once> resolved_here;
      for (Index first = 0; first < count_here; first += at_once)
      {
        const Index number = std::min(at_once, count_here - first);
        for (Index i = 0; i < number; ++i)
        {
          some[i] = points[order[first + i]];
          if (by_rays)
          {
            counts_here[i] = counts[begin + order[first + i]];
            resolved_here[i] = resolved[begin + order[first + i]];
          }
        }
        parts.at(some.data(), number, by_rays ? counts_here.data() : nullptr,
          by_rays ? resolved_here.data() : nullptr, values.data(), touches.data());
        for (Index i = 0; i < number; ++i)
        {
          out[begin + order[first + i]] = values[i];
          flags[order[first + i]] = touches[i];
        }
      }
    });
}

namespace
{
auto points_of(const SampleGrid& grid)
{
  return [&grid](Index i) { return grid.point(i); };
}

auto points_of(PointsView queries)
{
  return [queries](Index i) -> Vec3 { return queries.row(i); };
}
} // namespace

Status WindingNumber::evaluate(
  ExecutionContext& context, PointsView queries, double* out, unsigned char* on_surface) const
{
  return this->evaluate_points(context, queries.rows(), points_of(queries), out, on_surface);
}

Status WindingNumber::evaluate(
  ExecutionContext& context, const SampleGrid& grid, double* out, unsigned char* on_surface) const
{
  if (this->parts_->status.ok() && this->parts_->by_crossings() && this->parts_->reaches(grid))
  {
    return this->evaluate_rows(context, grid, out, on_surface);
  }
  return this->evaluate_points(context, grid.count(), points_of(grid), out, on_surface);
}

template <typename PointAt>
Status WindingNumber::evaluate_gradients(
  ExecutionContext& context, Index count, const PointAt& point_at, double* out) const
{
  const Parts& parts = *this->parts_;
  if (!parts.status.ok())
  {
    return parts.status;
  }
  const double nanoseconds = parts.method == WindingMethod::fast
    ? 1000.0
    : 10.0 + 10.0 * static_cast<double>(parts.rim.size());
  return point_gradients(context, count, nanoseconds,
    [&](Index i) { Eigen::Map<Vec3>(out + 3 * i) = parts.gradient_at(point_at(i)); });
}

Status WindingNumber::evaluate_gradient(
  ExecutionContext& context, PointsView queries, double* out) const
{
  return this->evaluate_gradients(context, queries.rows(), points_of(queries), out);
}

Status WindingNumber::evaluate_gradient(
  ExecutionContext& context, const SampleGrid& grid, double* out) const
{
  return this->evaluate_gradients(context, grid.count(), points_of(grid), out);
}

/// Return the sum over the boundary edges (the field of an electric current along them). The result
/// does not depend on the triangles between the boundary edges.
Vec3 WindingNumber::Parts::gradient_at(const Vec3& point) const
{
  if (!point.allFinite())
  {
    return Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  const Vec3 p = this->frame(point);
  if (this->rim.empty() || !(p.cwiseAbs().maxCoeff() < far_away))
  {
    return Vec3::Zero();
  }
  if (this->method == WindingMethod::fast)
  {
    return -this->frame.scale * this->field.gradient(p);
  }
  Vec3 sum = Vec3::Zero();
  for (const Edge& edge : this->rim)
  {
    const Vec3 a = this->points.row(edge.a).transpose() - p;
    const Vec3 b = this->points.row(edge.b).transpose() - p;
    const double la = a.norm();
    const double lb = b.norm();
    const double angle = la * lb + a.dot(b);
    if (angle > 1e-28 * la * lb && la > 0.0 && lb > 0.0)
    {
      sum += edge.net_direction * ((la + lb) / (la * lb * angle)) * a.cross(b);
    }
  }
  return this->frame.scale / four_pi * sum;
}

/// Report whether all samples are within the range of coordinates that cells and rays accept.
bool WindingNumber::Parts::reaches(const SampleGrid& grid) const
{
  const auto corner = [&](int end)
  { return this->frame(grid.point(grid.extent[end], grid.extent[2 + end], grid.extent[4 + end])); };
  return this->triangles.rows() > 0 && grid.count() > 0 && corner(0).allFinite() &&
    corner(1).allFinite() && corner(0).cwiseAbs().maxCoeff() < far_away &&
    corner(1).cwiseAbs().maxCoeff() < far_away;
}

/// Evaluate the grid by rows along x. Samples of a row in one cell share the descent to the cell.
Status WindingNumber::evaluate_rows(
  ExecutionContext& context, const SampleGrid& grid, double* out, unsigned char* on_surface) const
{
  const Parts& parts = *this->parts_;
  const Index length = grid.size(0);
  std::vector<double> xs(static_cast<std::size_t>(length));
  for (Index i = 0; i < length; ++i)
  {
    xs[i] = parts.frame(grid.point(grid.extent[0] + i, grid.extent[2], grid.extent[4])).x();
  }
  const bool closed = parts.caps.rows() == 0;
  const bool fast = parts.method == WindingMethod::fast;
  ask_for_large_pages(out, static_cast<std::size_t>(grid.count()) * sizeof(double));
  RayCrossings::Grid framed;
  RayCrossings::Layers layers;
  bool by_rays = (grid.spacing.array() > 0.0).all();
  if (by_rays)
  {
    framed.at[0] = xs;
    for (int k = 1; k < 3; ++k)
    {
      for (Index i = 0; i < grid.size(k); ++i)
      {
        std::array<Index, 3> at{ grid.extent[0], grid.extent[2], grid.extent[4] };
        at[k] += i;
        framed.at[k].push_back(parts.frame(grid.point(at[0], at[1], at[2]))[k]);
      }
    }
    layers = parts.rays->layers_of(framed);
    const auto samples = static_cast<double>(grid.count());
    const double ray_cost = layers.nanoseconds + write_per_sample * samples;
    by_rays = parts.rays_pay(ray_cost, cells_per_sample * samples);
    parts.add_ray_cost(by_rays ? ray_cost : 0.0);
  }
  if (!by_rays && !parts.cells_built && !parts.build_cells(context))
  {
    return Status::canceled();
  }
  const Index cost = fast ? 10 : 1 + parts.caps.rows();
  const Index rows_per_block =
    by_rays ? layers.per_slab * grid.size(1) : std::max<Index>(1, 1000000 / (cost * length));
  std::atomic<Index> touching{ 0 };
  const bool done = parallel_for(context, grid.size(1) * grid.size(2), rows_per_block,
    [&](Index begin, Index end)
    {
      Index touching_here = 0;
      std::vector<Index> unresolved, slab_unresolved;
      if (by_rays)
      {
        parts.rays->count_slab(
          framed, layers, begin / rows_per_block, out + begin * length, slab_unresolved);
        std::sort(slab_unresolved.begin(), slab_unresolved.end());
      }
      auto next_in_slab = slab_unresolved.begin();
      std::vector<double> caps_wind(fast ? static_cast<std::size_t>(length) : 0);
      std::vector<unsigned char> on_cap(caps_wind.size());
      for (Index row = begin; row < end; ++row)
      {
        Vec3 p = parts.frame(grid.point(grid.extent[0], grid.extent[2] + row % grid.size(1),
          grid.extent[4] + row / grid.size(1)));
        double* values = out + row * length;
        unsigned char* flags = on_surface ? on_surface + row * length : nullptr;
        unresolved.clear();
        if (by_rays)
        {
          const Index first = (row - begin) * length;
          for (; next_in_slab != slab_unresolved.end() && *next_in_slab < first + length;
               ++next_in_slab)
          {
            unresolved.push_back(*next_in_slab - first);
          }
        }
        else
        {
          parts.cells.evaluate_row(xs.data(), length, p.y(), p.z(), values, unresolved);
        }
        if (fast)
        {
          parts.field.evaluate_row(
            xs.data(), p.y(), p.z(), length, caps_wind.data(), on_cap.data());
        }
        for (Index i = 0; i < length && !closed; ++i)
        {
          p.x() = xs[i];
          bool touches = fast && on_cap[i];
          double of_caps = fast ? caps_wind[i] : 0.0;
          if (!fast)
          {
            parts.caps_at(&p, 1, &of_caps, &touches);
          }
          values[i] -= of_caps;
          if (touches)
          {
            unresolved.push_back(i);
          }
        }
        // A sample can be in the list twice: unresolved, and touching a cap.
        std::sort(unresolved.begin(), unresolved.end());
        unresolved.erase(std::unique(unresolved.begin(), unresolved.end()), unresolved.end());
        if (flags)
        {
          std::fill_n(flags, length, static_cast<unsigned char>(0));
        }
        for (const Index i : unresolved)
        {
          p.x() = xs[i];
          bool touches = false;
          values[i] = parts.slowly_at(p, &touches);
          touching_here += touches;
          if (flags)
          {
            flags[i] = touches;
          }
        }
      }
      touching += touching_here;
    });
  if (!done)
  {
    return Status::canceled();
  }
  Status status;
  status.report.set("counts.queries", grid.count());
  status.report.set("counts.on_surface", touching.load());
  return status;
}

Status WindingNumber::evaluate(
  ExecutionContext& context, PointsView queries, Eigen::VectorXd& out) const
{
  out.resize(queries.rows());
  return this->evaluate(context, queries, out.data());
}

Status WindingNumber::evaluate(
  ExecutionContext& context, const SampleGrid& grid, Eigen::VectorXd& out) const
{
  out.resize(grid.count());
  return this->evaluate(context, grid, out.data());
}

double winding_number_direct(
  PointsView points, TrianglesView triangles, const Vec3& point, bool* on_surface)
{
  if (on_surface)
  {
    *on_surface = false;
  }
  if (triangles.rows() == 0 || !point.allFinite())
  {
    return point.allFinite() ? 0.0 : std::numeric_limits<double>::quiet_NaN();
  }
  const ExactFrame frame(bounding_box(points, triangles));
  const Vec3 p = frame(point);
  if (!(p.cwiseAbs().maxCoeff() < far_away))
  {
    return 0.0;
  }
  SolidAngleSum sum(p, frame.tolerance);
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    const Vec3 a = frame(points.row(triangles(t, 0)));
    const Vec3 b = frame(points.row(triangles(t, 1)));
    const Vec3 c = frame(points.row(triangles(t, 2)));
    if (a != b && b != c && c != a) // A degenerate triangle contributes 0 and cannot be touched.
    {
      sum.add(a, b, c);
    }
  }
  if (on_surface)
  {
    *on_surface = sum.on_surface();
  }
  return sum.winding_number();
}

} // namespace bindpose
