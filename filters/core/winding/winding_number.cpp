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
constexpr Index maximum_direct_triangles = 24;
/// Up to this many open edges (edges not used equally often in both directions), the sum over the
/// caps takes less time than a descent of the tree. The tree is also slower if the number of open
/// edges is at least half the number of triangles. Measured: 14-20 ns per open edge, 20 ns per
/// triangle, 20 to 600 us for the tree (more on rougher surfaces).
constexpr Index maximum_summed_edges = 15000;
/// Up to this many open edges, the exact sum over the caps takes about as much time as the
/// DipoleField of the caps.
constexpr Index maximum_exact_edges = 12;
/// Measured nanoseconds of WindingCells: to build, per triangle; to evaluate a point; to evaluate a
/// sample of a row.
constexpr double cell_build_ns_per_face = 450.0;
constexpr double cell_ns_per_point = 40.0;
constexpr double cell_ns_per_sample = 6.0;
/// Nanoseconds to write a sample of a row.
constexpr double write_ns_per_sample = 1.0;
/// Largest number of points for which rays are used; each point takes 30 bytes.
constexpr Index maximum_ray_points = 1 << 22;

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

struct WindingNumber::Impl
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
  // The cells are built by build(), or later by the first evaluation that uses cells (see
  // are_rays_faster()). Earlier evaluations count crossings by rays, which gives the same values.
  mutable WindingCells cells;
  mutable std::mutex cells_mutex;
  mutable std::atomic<bool> cells_built{ false };
  /// Sum of the predicted times of all evaluations by rays so far.
  mutable std::atomic<double> ray_nanoseconds{ 0.0 };
  std::unique_ptr<RayCrossings> rays;
  std::vector<Edge> open_edge_list; ///< edges not used equally often in both directions
  Triangles caps; ///< triangles that close the surface (boundary_caps.h)
  SurfaceBoundary boundary; ///< boundary edges and components, in ids and units of the input
  DipoleField field; ///< field of the caps, used by the method `fast`

  bool uses_crossings() const
  {
    return this->method == WindingMethod::crossings || this->method == WindingMethod::fast;
  }
  void choose(WindingMethod requested, Index open_edges);
  bool build_tree(ExecutionContext& context) const;
  bool build_cells(ExecutionContext& context) const;
  bool are_rays_faster(double ray_cost, double cell_cost) const;
  /// Add to ray_nanoseconds atomically, because evaluations may run concurrently.
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
  double evaluate_robustly(const Vec3& framed, bool* on_surface) const;
  bool accepts(const SampleGrid& grid) const;
  void evaluate_caps(const Vec3* framed, Index count, double* winding_numbers, bool* touches) const;
};

WindingNumber::WindingNumber() : impl_(new Impl) {}
WindingNumber::WindingNumber(PointsView points, TrianglesView triangles) : impl_(new Impl)
{
  ExecutionContext context;
  this->build(context, points, triangles);
}
WindingNumber::~WindingNumber() = default;
WindingNumber::WindingNumber(WindingNumber&&) noexcept = default;
WindingNumber& WindingNumber::operator=(WindingNumber&&) noexcept = default;

void WindingNumber::Impl::choose(WindingMethod requested, Index open_edges)
{
  const Index count = this->triangles.rows();
  std::string reason = "requested";
  this->method = requested;
  const std::string numbers =
    std::to_string(count) + " triangles, " + std::to_string(open_edges) + " open edges: ";
  if (requested == WindingMethod::fast && open_edges == 0)
  {
    this->method = WindingMethod::crossings;
    reason = numbers + "a closed surface, for which an exact method is as fast";
  }
  else if (requested == WindingMethod::automatic && count > maximum_direct_triangles &&
    open_edges > maximum_exact_edges)
  {
    this->method = WindingMethod::fast;
    reason = numbers + "exact sums over the open edges would take many times longer";
  }
  else if (requested == WindingMethod::automatic || requested == WindingMethod::exact)
  {
    if (count <= maximum_direct_triangles && open_edges > 0)
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
    else if (open_edges <= maximum_summed_edges || 2 * open_edges >= count)
    {
      this->method = WindingMethod::crossings;
      reason = numbers +
        (open_edges ? "ray crossings plus a sum over the open edges is fastest"
                    : "a closed surface needs only ray crossings");
    }
    else
    {
      this->method = WindingMethod::hierarchical;
      reason = numbers + "too many open edges to sum over all of them at every query point";
    }
  }
  this->status.report.set("method", to_string(this->method));
  this->status.report.set("method_reason", reason);
}

Status WindingNumber::build(
  ExecutionContext& context, PointsView points, TrianglesView triangles, const Options& options)
{
  this->impl_.reset(new Impl);
  Impl& impl = *this->impl_;
  Status& status = impl.status;
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
  if (status.ok() &&
    !(options.query_region.lower.allFinite() && options.query_region.upper.allFinite()))
  {
    status = Status::invalid_input("query_region must have finite coordinates");
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
  impl.frame = triangles.rows() ? ExactFrame(bounding_box(points, triangles)) : ExactFrame();
  WeldedSurface welded;
  bool done = true;
  {
    const ProgressRange range(context, 0.0, 0.4);
    done = weld_surface(context, points, triangles, impl.frame, welded);
  }
  impl.points = std::move(welded.points);
  impl.triangles = std::move(welded.triangles);
  if (done)
  {
    impl.open_edge_list = std::move(welded.open_edges);
    const auto open = static_cast<Index>(impl.open_edge_list.size());
    impl.caps = boundary_caps(impl.open_edge_list);
    impl.boundary = surface_boundary(impl.points, impl.triangles, impl.open_edge_list, impl.caps);
    const double unit = 1.0 / impl.frame.scale;
    double volume = 0.0;
    for (SurfaceBoundary::BoundaryEdge& edge : impl.boundary.edges)
    {
      edge.from = welded.original_vertices[edge.from];
      edge.to = welded.original_vertices[edge.to];
    }
    for (SurfaceBoundary::Component& component : impl.boundary.components)
    {
      component.volume *= unit * unit * unit;
      volume += component.volume;
    }
    report.set("counts.vertices", points.rows());
    report.set("counts.triangles", triangles.rows());
    report.set("counts.boundary_edges", welded.boundary_edges);
    report.set("counts.nonmanifold_edges", welded.nonmanifold_edges);
    report.set("counts.open_edges", open);
    report.set("counts.components", static_cast<Index>(impl.boundary.components.size()));
    report.set("counts.merged_vertices", welded.merged_vertices);
    report.set("counts.degenerate_triangles", welded.degenerate_triangles);
    report.set("counts.duplicate_triangles", welded.duplicate_triangles);
    report.set("volume", volume);
    impl.choose(options.method, open);
    if (impl.triangles.rows() == 0)
    {
      status.warnings.push_back(triangles.rows() == 0
          ? "the surface has no triangles, so its winding number is 0 everywhere"
          : "all triangles are degenerate, so the winding number is 0 everywhere");
      impl.method = WindingMethod::direct;
    }
  }
  // If the DipoleField is a plain sum over the caps, the number of caps determines its cost, so
  // the caps from boundary_caps() are kept. Otherwise small caps take the least time.
  if (done && impl.method == WindingMethod::fast &&
    !DipoleField::uses_direct_sum(options.expected_queries))
  {
    impl.caps = smaller_caps(impl.points, impl.triangles, impl.caps);
  }
  impl.max_leaf_size = options.max_leaf_size;
  if (done && impl.method == WindingMethod::hierarchical)
  {
    const ProgressRange range(context, 0.4, 1.0);
    done = impl.build_tree(context);
  }
  if (done && impl.uses_crossings())
  {
    const ProgressRange range(context, 0.4, impl.method == WindingMethod::fast ? 0.6 : 1.0);
    impl.rays =
      std::make_unique<RayCrossings>(impl.points, impl.triangles, impl.caps, impl.frame.tolerance);
    // If the number of queries is known, the first evaluation chooses between rays and cells.
    done = options.expected_queries > 0 || impl.build_cells(context);
  }
  if (done && impl.method == WindingMethod::fast)
  {
    const ProgressRange range(context, 0.6, 1.0);
    DipoleField::Options field;
    field.tolerance = options.tolerance;
    field.expected_points = options.expected_queries;
    // The default padding of grids, as a fraction of the bounding-box diagonal.
    constexpr double padding = 0.1;
    field.region = bounding_box(impl.points, impl.triangles);
    const double pad = padding * field.region.diagonal();
    field.region.lower.array() -= pad;
    field.region.upper.array() += pad;
    if (!options.query_region.empty())
    {
      const Box padded = field.region;
      field.region.lower = padded.lower.cwiseMax(impl.frame(options.query_region.lower));
      field.region.upper = padded.upper.cwiseMin(impl.frame(options.query_region.upper));
      if (field.region.empty())
      {
        field.region = padded;
      }
    }
    // The field cuts long caps at rounded positions. Points for which this rounding matters count
    // as touching a cap. The exact sum is used for these points.
    const double cut_tolerance = impl.frame.tolerance / options.tolerance;
    done = impl.field.build(context, impl.points, impl.caps,
      std::vector<int>(static_cast<std::size_t>(impl.caps.rows()), 1), cut_tolerance, field);
    report.set("error_bound", options.tolerance);
    report.set("measured_error", impl.field.measured_error());
  }
  if (!done)
  {
    this->impl_.reset(new Impl);
    this->impl_->status = Status::canceled();
  }
  return this->impl_->status;
}

const Status& WindingNumber::status() const
{
  return this->impl_->status;
}

WindingMethod WindingNumber::method() const
{
  return this->impl_->method;
}

const SurfaceBoundary& WindingNumber::boundary() const
{
  return this->impl_->boundary;
}

Index WindingNumber::memory() const
{
  return static_cast<Index>(sizeof(double)) * this->impl_->points.size() +
    static_cast<Index>(sizeof(Index)) * (this->impl_->triangles.size() + this->impl_->caps.size()) +
    this->impl_->tree.memory() + this->impl_->cells.memory() + this->impl_->field.memory();
}

/// Report whether an evaluation by rays is predicted to be faster than an evaluation by cells.
/// `ray_cost` and `cell_cost` are the predicted times of this evaluation in nanoseconds. If the
/// cells are not built yet, the time to build them is added to `cell_cost`, and the times of all
/// earlier evaluations by rays are added to `ray_cost`.
bool WindingNumber::Impl::are_rays_faster(double ray_cost, double cell_cost) const
{
  if (this->cells_built)
  {
    return ray_cost < cell_cost;
  }
  const double build =
    cell_build_ns_per_face * static_cast<double>(this->triangles.rows() + this->caps.rows());
  return this->ray_nanoseconds + ray_cost < build + cell_cost;
}

bool WindingNumber::Impl::build_cells(ExecutionContext& context) const
{
  const std::lock_guard<std::mutex> lock(this->cells_mutex);
  this->cells_built = this->cells_built ||
    this->cells.build(context, this->points, this->triangles, this->caps, this->frame.tolerance);
  return this->cells_built;
}

/// Evaluate up to WindingCells::maximum_batch points. `counts` and `resolved` are the results of
/// RayCrossings for these points, or null.
void WindingNumber::Impl::at(const Vec3* queries, Index number, const int* counts,
  const unsigned char* resolved, double* winding_numbers, bool* on_surface) const
{
  std::array<Vec3, WindingCells::maximum_batch> framed;
  framed.fill(Vec3::Zero());
  // Indices of the points whose winding number must be computed: finite and not too far away.
  std::array<Index, WindingCells::maximum_batch> active;
  Index count = 0;
  for (Index i = 0; i < number; ++i)
  {
    on_surface[i] = false;
    const Vec3 p = this->frame(queries[i]);
    winding_numbers[i] = queries[i].allFinite() ? 0.0 : std::numeric_limits<double>::quiet_NaN();
    if (this->triangles.rows() > 0 && p.cwiseAbs().maxCoeff() < zero_distance)
    {
      framed[count] = p;
      active[count++] = i;
    }
  }
  if (!this->uses_crossings())
  {
    for (Index k = 0; k < count; ++k)
    {
      winding_numbers[active[k]] = this->evaluate_robustly(framed[k], &on_surface[active[k]]);
    }
    return;
  }
  std::array<int, WindingCells::maximum_batch> crossing_counts;
  std::array<bool, WindingCells::maximum_batch> is_resolved;
  if (counts)
  {
    for (Index k = 0; k < count; ++k)
    {
      crossing_counts[k] = counts[active[k]];
      is_resolved[k] = resolved[active[k]] != 0;
    }
  }
  else
  {
    if (!this->cells_built)
    {
      ExecutionContext silent_context;
      this->build_cells(silent_context);
    }
    this->cells.evaluate(framed.data(), count, crossing_counts.data(), is_resolved.data());
  }
  std::array<double, WindingCells::maximum_batch> cap_winding;
  std::array<bool, WindingCells::maximum_batch> touches;
  this->evaluate_caps(framed.data(), count, cap_winding.data(), touches.data());
  for (Index k = 0; k < count; ++k)
  {
    winding_numbers[active[k]] = is_resolved[k] && !touches[k]
      ? crossing_counts[k] - cap_winding[k]
      : this->evaluate_robustly(framed[k], &on_surface[active[k]]);
  }
}

/// Compute the winding numbers of the caps at the points, and report whether a point touches a cap.
void WindingNumber::Impl::evaluate_caps(
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
bool WindingNumber::Impl::build_tree(ExecutionContext& context) const
{
  const std::lock_guard<std::mutex> lock(this->tree_mutex);
  this->tree_built = this->tree_built ||
    this->tree.build(
      context, this->points, this->triangles, this->frame.tolerance, this->max_leaf_size);
  return this->tree_built;
}

/// Evaluate a point by a method that is correct everywhere: the plain sum or the tree.
double WindingNumber::Impl::evaluate_robustly(const Vec3& p, bool* on_surface) const
{
  if (this->method == WindingMethod::direct)
  {
    return direct_sum(this->points, this->triangles, p, this->frame.tolerance, on_surface);
  }
  if (!this->tree_built)
  {
    ExecutionContext silent_context;
    this->build_tree(silent_context);
  }
  SolidAngleSum sum(p, this->frame.tolerance);
  this->tree.add_to(sum, p);
  if (on_surface)
  {
    *on_surface = sum.on_surface();
  }
  // If the surface is closed, round the value to an integer, because the values from WindingCells
  // are integers, too.
  const bool is_integer = this->open_edge_list.empty() && !sum.on_surface();
  return is_integer ? std::round(sum.winding_number()) : sum.winding_number();
}

double WindingNumber::evaluate_exactly_at(const Vec3& point, bool* on_surface) const
{
  const Impl& impl = *this->impl_;
  const Vec3 p = impl.frame(point);
  if (impl.method == WindingMethod::fast && impl.triangles.rows() > 0 &&
    p.cwiseAbs().maxCoeff() < zero_distance)
  {
    bool touches = false;
    const double winding_number = impl.evaluate_robustly(p, &touches);
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
  this->impl_->at(&point, 1, nullptr, nullptr, &winding_number, &touches);
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
  const Impl& impl = *this->impl_;
  if (!impl.status.ok())
  {
    return impl.status;
  }
  std::vector<int> counts;
  std::vector<unsigned char> resolved;
  bool use_rays = false;
  if (impl.uses_crossings() && count > 0 && impl.triangles.rows() > 0)
  {
    const double ray_cost = impl.rays->predicted_nanoseconds(count);
    use_rays = count <= maximum_ray_points &&
      impl.are_rays_faster(ray_cost, cell_ns_per_point * static_cast<double>(count));
    const ProgressRange range(context, 0.0, 0.5);
    if (use_rays)
    {
      impl.add_ray_cost(ray_cost);
      std::vector<Vec3> framed;
      reserve_in_large_pages(framed, static_cast<std::size_t>(count));
      for (Index i = 0; i < count; ++i)
      {
        framed.push_back(impl.frame(point_at(i)));
      }
      counts.resize(static_cast<std::size_t>(count));
      resolved.resize(static_cast<std::size_t>(count));
      if (!impl.rays->count(context, framed.data(), count, counts.data(), resolved.data()))
      {
        return Status::canceled();
      }
    }
    else if (!impl.cells_built && !impl.build_cells(context))
    {
      return Status::canceled();
    }
  }
  const ProgressRange range(context, use_rays ? 0.5 : 0.0, 1.0);
  // The estimate of the time assumes the worst case: a tree is as slow as the plain sum.
  const double nanoseconds = impl.method == WindingMethod::fast ? 500.0
    : impl.method == WindingMethod::crossings ? 100.0 + 20.0 * static_cast<double>(impl.caps.rows())
                                              : 20.0 * static_cast<double>(impl.triangles.rows());
  return point_values(context, count, nanoseconds, out, on_surface,
    [&](Index begin, Index end, unsigned char* flags)
    {
      // Sort the points spatially, so that neighboring points use the data of a cell while it is in
      // the cache.
      const Index block_count = end - begin;
      std::vector<Vec3> points(static_cast<std::size_t>(block_count));
      for (Index i = 0; i < block_count; ++i)
      {
        points[i] = point_at(begin + i);
      }
      const std::vector<std::int32_t> order = spatial_sort(points);
      constexpr Index batch_size = WindingCells::maximum_batch;
      std::array<Vec3, batch_size> batch_points;
      std::array<double, batch_size> values;
      std::array<bool, batch_size> touches;
      std::array<int, batch_size> batch_counts;
      std::array<unsigned char, batch_size> batch_resolved;
      for (Index first = 0; first < block_count; first += batch_size)
      {
        const Index number = std::min(batch_size, block_count - first);
        for (Index i = 0; i < number; ++i)
        {
          batch_points[i] = points[order[first + i]];
          if (use_rays)
          {
            batch_counts[i] = counts[begin + order[first + i]];
            batch_resolved[i] = resolved[begin + order[first + i]];
          }
        }
        impl.at(batch_points.data(), number, use_rays ? batch_counts.data() : nullptr,
          use_rays ? batch_resolved.data() : nullptr, values.data(), touches.data());
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
auto point_function(const SampleGrid& grid)
{
  return [&grid](Index i) { return grid.point(i); };
}

auto point_function(PointsView queries)
{
  return [queries](Index i) -> Vec3 { return queries.row(i); };
}
} // namespace

Status WindingNumber::evaluate(
  ExecutionContext& context, PointsView queries, double* out, unsigned char* on_surface) const
{
  return this->evaluate_points(context, queries.rows(), point_function(queries), out, on_surface);
}

Status WindingNumber::evaluate(
  ExecutionContext& context, const SampleGrid& grid, double* out, unsigned char* on_surface) const
{
  if (this->impl_->status.ok() && this->impl_->uses_crossings() && this->impl_->accepts(grid))
  {
    return this->evaluate_rows(context, grid, out, on_surface);
  }
  return this->evaluate_points(context, grid.count(), point_function(grid), out, on_surface);
}

template <typename PointAt>
Status WindingNumber::evaluate_gradients(
  ExecutionContext& context, Index count, const PointAt& point_at, double* out) const
{
  const Impl& impl = *this->impl_;
  if (!impl.status.ok())
  {
    return impl.status;
  }
  const double nanoseconds = impl.method == WindingMethod::fast
    ? 1000.0
    : 10.0 + 10.0 * static_cast<double>(impl.open_edge_list.size());
  return point_gradients(context, count, nanoseconds,
    [&](Index i) { Eigen::Map<Vec3>(out + 3 * i) = impl.gradient_at(point_at(i)); });
}

Status WindingNumber::evaluate_gradient(
  ExecutionContext& context, PointsView queries, double* out) const
{
  return this->evaluate_gradients(context, queries.rows(), point_function(queries), out);
}

Status WindingNumber::evaluate_gradient(
  ExecutionContext& context, const SampleGrid& grid, double* out) const
{
  return this->evaluate_gradients(context, grid.count(), point_function(grid), out);
}

/// Return the gradient of the winding number: a sum over the boundary edges (the magnetic field of
/// an electric current along these edges). It does not depend on the triangles between the boundary
/// edges. The method `fast` computes it from the DipoleField of the caps.
Vec3 WindingNumber::Impl::gradient_at(const Vec3& point) const
{
  if (!point.allFinite())
  {
    return Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  const Vec3 p = this->frame(point);
  if (this->open_edge_list.empty() || !(p.cwiseAbs().maxCoeff() < zero_distance))
  {
    return Vec3::Zero();
  }
  if (this->method == WindingMethod::fast)
  {
    return -this->frame.scale * this->field.gradient(p);
  }
  Vec3 sum = Vec3::Zero();
  for (const Edge& edge : this->open_edge_list)
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
bool WindingNumber::Impl::accepts(const SampleGrid& grid) const
{
  const auto corner = [&](int end)
  { return this->frame(grid.point(grid.extent[end], grid.extent[2 + end], grid.extent[4 + end])); };
  return this->triangles.rows() > 0 && grid.count() > 0 && corner(0).allFinite() &&
    corner(1).allFinite() && corner(0).cwiseAbs().maxCoeff() < zero_distance &&
    corner(1).cwiseAbs().maxCoeff() < zero_distance;
}

/// Evaluate the grid by rows along x. Samples of a row in one cell share the descent to the cell.
Status WindingNumber::evaluate_rows(
  ExecutionContext& context, const SampleGrid& grid, double* out, unsigned char* on_surface) const
{
  const Impl& impl = *this->impl_;
  const Index length = grid.size(0);
  std::vector<double> xs(static_cast<std::size_t>(length));
  for (Index i = 0; i < length; ++i)
  {
    xs[i] = impl.frame(grid.point(grid.extent[0] + i, grid.extent[2], grid.extent[4])).x();
  }
  const bool closed = impl.caps.rows() == 0;
  const bool fast = impl.method == WindingMethod::fast;
  request_large_pages(out, static_cast<std::size_t>(grid.count()) * sizeof(double));
  RayCrossings::Grid framed;
  RayCrossings::Layers layers;
  bool use_rays = (grid.spacing.array() > 0.0).all();
  if (use_rays)
  {
    framed.at[0] = xs;
    for (int k = 1; k < 3; ++k)
    {
      for (Index i = 0; i < grid.size(k); ++i)
      {
        std::array<Index, 3> at{ grid.extent[0], grid.extent[2], grid.extent[4] };
        at[k] += i;
        framed.at[k].push_back(impl.frame(grid.point(at[0], at[1], at[2]))[k]);
      }
    }
    layers = impl.rays->find_layers(framed);
    const auto samples = static_cast<double>(grid.count());
    const double ray_cost = layers.nanoseconds + write_ns_per_sample * samples;
    use_rays = impl.are_rays_faster(ray_cost, cell_ns_per_sample * samples);
    impl.add_ray_cost(use_rays ? ray_cost : 0.0);
  }
  if (!use_rays && !impl.cells_built && !impl.build_cells(context))
  {
    return Status::canceled();
  }
  const Index cost = fast ? 10 : 1 + impl.caps.rows();
  const Index rows_per_block = use_rays ? layers.layers_per_slab * grid.size(1)
                                        : std::max<Index>(1, 1000000 / (cost * length));
  std::atomic<Index> touching{ 0 };
  const bool done = parallel_for(context, grid.size(1) * grid.size(2), rows_per_block,
    [&](Index begin, Index end)
    {
      Index touching_in_block = 0;
      std::vector<Index> unresolved, slab_unresolved;
      if (use_rays)
      {
        impl.rays->count_slab(
          framed, layers, begin / rows_per_block, out + begin * length, slab_unresolved);
        std::sort(slab_unresolved.begin(), slab_unresolved.end());
      }
      auto next_in_slab = slab_unresolved.begin();
      std::vector<double> cap_windings(fast ? static_cast<std::size_t>(length) : 0);
      std::vector<unsigned char> on_cap(cap_windings.size());
      for (Index row = begin; row < end; ++row)
      {
        Vec3 p = impl.frame(grid.point(grid.extent[0], grid.extent[2] + row % grid.size(1),
          grid.extent[4] + row / grid.size(1)));
        double* values = out + row * length;
        unsigned char* flags = on_surface ? on_surface + row * length : nullptr;
        unresolved.clear();
        if (use_rays)
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
          impl.cells.evaluate_row(xs.data(), length, p.y(), p.z(), values, unresolved);
        }
        if (fast)
        {
          impl.field.evaluate_row(
            xs.data(), p.y(), p.z(), length, cap_windings.data(), on_cap.data());
        }
        for (Index i = 0; i < length && !closed; ++i)
        {
          p.x() = xs[i];
          bool touches = fast && on_cap[i];
          double cap_winding = fast ? cap_windings[i] : 0.0;
          if (!fast)
          {
            impl.evaluate_caps(&p, 1, &cap_winding, &touches);
          }
          values[i] -= cap_winding;
          if (touches)
          {
            unresolved.push_back(i);
          }
        }
        // The list contains a sample twice if its crossings are unresolved and it touches a cap.
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
          values[i] = impl.evaluate_robustly(p, &touches);
          touching_in_block += touches;
          if (flags)
          {
            flags[i] = touches;
          }
        }
      }
      touching += touching_in_block;
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
  if (!(p.cwiseAbs().maxCoeff() < zero_distance))
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
