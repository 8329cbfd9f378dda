// Inner vertices for the tets of method cdt. Weights can vary inside a volume only if the tets have
// vertices there. The points of an octree that becomes coarser away from the boundary
// (inner_points.h) are inserted as vertices (tet_insertion.h). Then flat tets are improved
// (tet_improvement.h). The boundary changes only where long edges are split (find_positions) and
// where the shared edge of two coplanar triangles is swapped (improve).
#include "inside/cdt_tets.h"

#include "base/number_text.h"
#include "inside/inner_points.h"
#include "tets/tet_improvement.h"
#include "tets/tet_insertion.h"
#include "tets/tet_quality.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <numeric>

namespace bindpose
{

namespace
{
/// Tolerance in bounding-box diagonals: boundary triangles count as coplanar if all their vertices
/// are within this distance of one plane.
constexpr double coplanar = 1e-10;
/// Approximate minimum number of tets if no interior edge length is requested.
constexpr Index minimum_tets = 1500;
/// Approximate number of tets per triangle of the surface if no interior edge length is requested.
constexpr double tets_per_triangle = 4.2;
/// Largest number of tets if an interior edge length is requested.
constexpr Index maximum_requested_tets = 20000000;
/// Approximate number of tets per inner vertex and per boundary triangle, used for estimates.
constexpr Index tets_per_vertex = 6;
constexpr Index tets_per_boundary_triangle = 2;

/// Return the maximum number of new vertices. It is chosen such that the mesh gets `minimum_tets`
/// or `tets_per_triangle` times #triangles tets, whichever is more. If the boundary alone already
/// requires so many tets, a small number of vertices is still allowed.
Index maximum_inner_vertices(Index surface_triangles, Index boundary_triangles)
{
  // This many new vertices per triangle of the surface are always allowed.
  constexpr double least = 0.1;
  const double triangles = static_cast<double>(surface_triangles);
  const double tets = std::max(static_cast<double>(minimum_tets), tets_per_triangle * triangles) -
    static_cast<double>(tets_per_boundary_triangle * boundary_triangles);
  return static_cast<Index>(std::max(least * triangles, tets / tets_per_vertex));
}

/// Remove the positions in `positions` whose distance to one of `others` is less than half of the
/// local edge length.
void remove_near(Points& positions, const Points& others, const SizingField& sizes)
{
  if (others.rows() == 0)
  {
    return;
  }
  // Indices of the rows of `others`, sorted by x.
  std::vector<Index> order(static_cast<std::size_t>(others.rows()));
  std::iota(order.begin(), order.end(), Index(0));
  std::sort(
    order.begin(), order.end(), [&](Index a, Index b) { return others(a, 0) < others(b, 0); });
  Index kept = 0;
  for (Index i = 0; i < positions.rows(); ++i)
  {
    const Vec3 p = positions.row(i);
    // Minimum distance from the other points, in units of the local edge length.
    constexpr double spacing = 0.5;
    const double least = spacing * sizes.at(p);
    bool is_near = false;
    for (auto other = std::lower_bound(order.begin(), order.end(), p.x() - least,
           [&](Index a, double x) { return others(a, 0) < x; });
         other != order.end() && others(*other, 0) <= p.x() + least && !is_near; ++other)
    {
      is_near = (others.row(*other).transpose() - p).norm() < least;
    }
    if (!is_near)
    {
      positions.row(kept++) = p;
    }
  }
  positions.conservativeResize(kept, 3);
}
} // namespace

/// Data of fill(): the region that the boundary of the tets encloses, and the new vertices in it.
struct CdtTets::FillState
{
  Interior interior;
  Index boundary_triangles = 0;
  std::unique_ptr<SizingField> sizes;
  Points positions; ///< positions of new vertices
};

/// Insert vertices inside, beginning with the points of handles.
Status CdtTets::fill()
{
  const double start = this->context_.elapsed_seconds();
  constexpr double found = 0.35; // progress when the positions have been found
  FillState inside;
  Status status;
  {
    const ProgressRange range(this->context_, 0.0, found);
    status = this->options_.bare ? this->prepare_interior(this->diagonal_, inside)
                                 : this->find_positions(inside);
  }
  const Points handle_positions = status.ok() ? this->positions_on_handles(inside) : Points(0, 3);
  this->log_.add("places inside", this->context_.elapsed_seconds() - start, status);
  Points positions(handle_positions.rows() + inside.positions.rows(), 3);
  positions << handle_positions, inside.positions;
  if (!status.ok() || positions.rows() == 0)
  {
    return status;
  }
  const ProgressRange range(this->context_, found, 1.0);
  std::vector<Index> vertices;
  status = this->insert(positions, vertices);
  if (status.ok())
  {
    std::copy_if(vertices.begin(), vertices.begin() + handle_positions.rows(),
      std::back_inserter(this->handle_vertices_), [](Index v) { return v >= 0; });
  }
  return status;
}

/// Find positions of new vertices. Boundary edges that are long compared with the edge length
/// inside are split.
Status CdtTets::find_positions(FillState& inside)
{
  const double target_length = this->options_.interior_edge * this->diagonal_;
  if (target_length > 0.0)
  {
    // Length above which a boundary edge is split, in units of the requested length.
    constexpr double long_edge = 3.0;
    return this->find_even_positions(target_length, long_edge * target_length,
      maximum_requested_tets, maximum_requested_tets, inside);
  }
  Status status = this->prepare_interior(this->diagonal_, inside);
  if (status.ok())
  {
    status = this->find_inner_positions(
      maximum_inner_vertices(this->surface_.triangles.rows(), inside.boundary_triangles), inside);
  }
  const Index expected = tets_per_boundary_triangle * inside.boundary_triangles +
    tets_per_vertex * inside.positions.rows();
  if (!status.ok() || expected >= minimum_tets)
  {
    return status;
  }
  // Too few tets are expected. Use the same edge length everywhere, such that about `minimum_tets`
  // tets fill the volume.
  const double length =
    std::cbrt(this->volume_ / (static_cast<double>(minimum_tets) * regular_tet_volume));
  constexpr double long_edge = 2.0;
  // Maximum fraction of the tets that may result from splitting boundary edges.
  constexpr double split_fraction = 0.6;
  return this->find_even_positions(length, long_edge * length,
    static_cast<Index>(split_fraction * static_cast<double>(minimum_tets)),
    minimum_tets / tets_per_vertex, inside);
}

/// Split boundary edges longer than `long_edge`; stop if there are `maximum_tets` tets. Then find
/// positions inside. The target edge length there is nowhere above `length`. If there are more than
/// about `most` positions, the shorter target lengths are increased (see inner_points()).
Status CdtTets::find_even_positions(
  double length, double long_edge, Index maximum_tets, Index most, FillState& inside)
{
  if (!split_long_edges(this->context_, this->mesh_, long_edge, maximum_tets))
  {
    return Status::canceled();
  }
  const Status status = this->prepare_interior(length, inside);
  return status.ok() ? this->find_inner_positions(most, inside) : status;
}

Status CdtTets::find_inner_positions(Index most, FillState& inside)
{
  return inner_points(this->context_, inside.interior, *inside.sizes, most, inside.positions)
    ? Status()
    : Status::canceled();
}

/// Set the target edge lengths inside. At a boundary vertex, the length is that of the shortest
/// boundary edge at the vertex. The length increases with the distance from the boundary at a rate
/// of 0.75, up to `longest`. (With the mean instead of the shortest edge, tets are too coarse for
/// small details between long triangles.)
Status CdtTets::prepare_interior(double longest, FillState& inside)
{
  const Points& points = this->mesh_.points;
  const Triangles boundary = boundary_triangles(this->mesh_.tets);
  constexpr double no_limit = std::numeric_limits<double>::infinity();
  Eigen::VectorXd shortest = Eigen::VectorXd::Constant(points.rows(), no_limit);
  for (const Edge& edge : mesh_edges(boundary))
  {
    const double length = (points.row(edge.a) - points.row(edge.b)).norm();
    for (const Index v : { edge.a, edge.b })
    {
      shortest[v] = std::min(shortest[v], length);
    }
  }
  Points sites(points.rows(), 3);
  Eigen::VectorXd lengths(points.rows());
  Index count = 0;
  for (Index v = 0; v < points.rows(); ++v)
  {
    if (shortest[v] < no_limit)
    {
      sites.row(count) = points.row(v);
      lengths[count++] = shortest[v];
    }
  }
  sites.conservativeResize(count, 3);
  lengths.conservativeResize(count);
  constexpr double growth = 0.75;
  inside.sizes = std::make_unique<SizingField>(sites, lengths, growth, longest);
  inside.positions.resize(0, 3);
  inside.boundary_triangles = boundary.rows();
  return inside.interior.build(this->context_, points, boundary);
}

/// Return the handle points that are inside, and samples of the handles' segments and triangles.
/// Samples keep some distance from the boundary, because the boundary has enough vertices, and tets
/// between a sample and the boundary would be flat. Positions in `inside` that are near a returned
/// point are removed.
Points CdtTets::positions_on_handles(FillState& inside) const
{
  // Minimum distance of samples from the boundary, in units of the local edge length.
  constexpr double minimum_boundary_distance = 0.3;
  // Minimum distance of the handles' points from the boundary, in bounding-box diagonals.
  constexpr double minimum_point_distance = 1e-6;
  const SizingField& sizes = *inside.sizes;
  const HandleSamples samples =
    sample_handle_elements(this->options_.handles, [&](const Vec3& p) { return sizes.at(p); });
  Points kept(samples.points.rows(), 3);
  Index count = 0;
  for (Index i = 0; i < samples.points.rows(); ++i)
  {
    const Vec3 p = samples.points.row(i);
    const double distance = i < samples.handle_point_count
      ? minimum_point_distance * this->diagonal_
      : minimum_boundary_distance * sizes.at(p);
    if (inside.interior.has_clearance(p, distance) && inside.interior.contains(p))
    {
      kept.row(count++) = p;
    }
  }
  kept.conservativeResize(count, 3);
  remove_near(inside.positions, kept, sizes);
  return kept;
}

Status CdtTets::insert(const Points& positions, std::vector<Index>& vertices)
{
  const double start = this->context_.elapsed_seconds();
  TetMesh mesh = this->mesh_;
  if (!insert_vertices(this->context_, mesh, positions, vertices))
  {
    return Status::canceled();
  }
  const Status status = this->accept(mesh);
  this->log_.add("vertices inside", this->context_.elapsed_seconds() - start, status);
  return status;
}

/// Replace the mesh by `mesh` if its tets are valid and fill the same volume.
Status CdtTets::accept(TetMesh& mesh)
{
  const double after = tet_volumes(mesh.points, mesh.tets).sum();
  constexpr double rounding = 1e-9;
  if (std::abs(after - this->volume_) > rounding * this->volume_)
  {
    return Status::failure(StatusCode::internal_error,
      "the added vertices changed the volume by a factor of " +
        short_number(after / this->volume_, 12));
  }
  Status status = check_tets(mesh.points, mesh.tets);
  if (status.ok())
  {
    this->mesh_ = std::move(mesh);
  }
  return status;
}

/// Improve flat tets. The vertices of the input and of handles do not move. The boundary changes
/// only where the shared edge of two coplanar triangles is swapped.
Status CdtTets::improve()
{
  const double start = this->context_.elapsed_seconds();
  TetMesh mesh = this->mesh_;
  std::vector<char> fixed(static_cast<std::size_t>(mesh.points.rows()), 0);
  std::fill_n(fixed.begin(), std::min(this->mesh_original_.size(), fixed.size()), 1);
  for (const Index v : this->handle_vertices_)
  {
    fixed[v] = 1;
  }
  ImproveOptions options;
  options.release_angle = 0.0; // held (constrained) vertices never move
  options.keep_boundary = true;
  options.coplanar = coplanar * this->diagonal_;
  options.insert = true;
  options.slack = 0.7;
  Improvement improvement;
  {
    const ProgressRange range(this->context_, 0.0, 0.9);
    if (!improve_tets(this->context_, mesh, std::move(fixed), {}, options, improvement))
    {
      return Status::canceled();
    }
  }
  // For millions of tets, each of the following steps takes up to a few seconds. Therefore a cancel
  // request is checked between them.
  std::vector<TetFacet> facets = tet_facets(mesh.tets);
  this->context_.progress(0.94);
  if (this->context_.canceled())
  {
    return Status::canceled();
  }
  peel_slivers(mesh.points, mesh.tets, facets, flat_height * this->diagonal_);
  this->context_.progress(0.97);
  if (this->context_.canceled())
  {
    return Status::canceled();
  }
  const Status status = check_tets(mesh.points, mesh.tets, facets);
  this->log_.add("flat tets improved", this->context_.elapsed_seconds() - start, status);
  if (status.ok())
  {
    this->mesh_ = std::move(mesh);
  }
  return {};
}

} // namespace bindpose
