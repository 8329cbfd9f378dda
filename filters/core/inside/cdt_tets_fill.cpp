// Vertices inside of the tets of method cdt, so that weights have something to vary over: by
// TetGen's refinement where needles on the boundary do not keep that from ending, else by fill_tets
// (tet_filling.h). Then flat tets are improved (tet_improvement.h). Both keep the boundary.
#include "inside/cdt_tets.h"

#include "base/number_text.h"
#include "helper/mesher_process.h"
#include "inside/tet_filling.h"
#include "inside/tet_improvement.h"
#include "inside/tet_quality.h"
#include "surface/triangle_shape.h"
#include "surface/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace bindpose
{

namespace
{
/// Triangles of the boundary within this height of one plane, of the diagonal, are in one plane.
constexpr double coplanar = 1e-10;
/// Without a request for a length inside: there are at least about so many tets,
constexpr Index fewest_tets = 1500;
/// and vertices are added until there are so many tets per triangle of the surface.
constexpr double most_tets_per_triangle = 4.5;
/// With one.
constexpr Index most_tets_on_request = 20000000;
} // namespace

/// Adds vertices inside, those of handles first.
Status CdtTets::fill()
{
  const Triangles boundary = boundary_triangles(this->mesh_.tets);
  const SizingField field = this->lengths_inside(boundary);
  Points places(0, 3);
  if (!this->options_.handles.empty())
  {
    const Status status = this->place_handles(boundary, field, places);
    if (!status.ok())
    {
      return status;
    }
  }
  if (this->fills() && this->suits_tetgen(boundary))
  {
    const Status status = this->fill_by_tetgen(places);
    if (status.ok() || status.code == StatusCode::cancelled)
    {
      return status;
    }
  }
  return this->fill_by_cavities(field, std::move(places));
}

/// Volume that no tet inside is to exceed.
double CdtTets::largest_inner_tet() const
{
  return this->options_.interior_edge > 0.0 ? this->volume_bound()
                                            : this->volume_ / static_cast<double>(fewest_tets);
}

/// TetGen's refinement does not end at needles, and does not split triangles of the boundary that
/// are larger than the tets wanted.
bool CdtTets::suits_tetgen(const Triangles& boundary) const
{
  constexpr double long_edge = 2.0; // of the wanted length
  constexpr double most_needles = 0.02; // of the triangles
  return this->mean_surface_edge() <=
    long_edge * std::cbrt(this->largest_inner_tet() / regular_tet_volume) &&
    static_cast<double>(count_needles(this->mesh_.points, boundary, sliver_angle)) <=
    most_needles * static_cast<double>(boundary.rows());
}

/// TetGen's refinement with the boundary left alone: its tets are the best where it ends.
Status CdtTets::fill_by_tetgen(const Points& places)
{
  const double start = this->context_.elapsed_seconds();
  // TetGen inserts all points behind the last one that a tet uses: the places may stand there, the
  // hull's other vertices may not.
  const Index vertices = this->mesh_.tets.maxCoeff() + 1;
  const double largest = this->largest_inner_tet();
  MesherData data;
  data.tets = this->mesh_.tets;
  data.points.resize(vertices + places.rows(), 3);
  data.points << this->mesh_.points.topRows(vertices), places;
  data.largest_volumes.assign(static_cast<std::size_t>(data.tets.rows()), largest);
  constexpr double seconds = 3.0;
  constexpr double seconds_per_tet = 2e-4;
  MesherAnswer answer;
  Status status = this->run_job({ "tetgen", "--switches", "rYq1.414/10a" }, data,
    seconds + seconds_per_tet * (static_cast<double>(data.tets.rows()) + this->volume_ / largest),
    answer);
  TetMesh mesh{ std::move(answer.data.points), std::move(answer.data.tets) };
  constexpr double most_bad = 0.05; // of the tets
  if (status.ok() &&
    static_cast<double>(measure_tets(mesh.points, mesh.tets).below_5_degrees) >
      most_bad * static_cast<double>(mesh.tets.rows()))
  {
    status = Status::failure(StatusCode::internal_error, "too many tets are flat");
  }
  if (status.ok())
  {
    status = this->accept(mesh);
  }
  this->log_.add("vertices inside by tetgen", this->context_.elapsed_seconds() - start, status);
  if (status.ok())
  {
    this->mesh_original_.resize(
      std::min(this->mesh_original_.size(), static_cast<std::size_t>(vertices)));
    for (Index i = 0; i < places.rows(); ++i)
    {
      this->handle_vertices_.push_back(vertices + i);
    }
  }
  return status;
}

/// Needs no good triangles: see fill_tets().
Status CdtTets::fill_by_cavities(const SizingField& field, Points places)
{
  const double start = this->context_.elapsed_seconds();
  FillOptions options;
  options.required = std::move(places);
  if (!this->fills())
  {
    options.most_tets = 0;
  }
  else if (this->options_.interior_edge > 0.0)
  {
    options.most_tets = most_tets_on_request;
    constexpr double long_edge = 3.0;
    options.longest_boundary_edge = long_edge * this->options_.interior_edge * this->diagonal_;
  }
  else
  {
    options.fewest_tets = fewest_tets;
    options.most_tets = std::max(fewest_tets,
      static_cast<Index>(
        most_tets_per_triangle * static_cast<double>(this->surface_.triangles.rows())));
  }
  TetMesh mesh = this->mesh_;
  Filling done;
  if (!fill_tets(mesh, field, options, done, this->context_))
  {
    return Status::cancelled();
  }
  const Status status = this->accept(mesh);
  this->log_.add("vertices inside", this->context_.elapsed_seconds() - start, status);
  if (status.ok())
  {
    std::copy_if(done.required.begin(), done.required.end(),
      std::back_inserter(this->handle_vertices_), [](Index v) { return v >= 0; });
  }
  return status;
}

/// Takes the tets if they are valid and fill the same volume.
Status CdtTets::accept(TetMesh& mesh)
{
  const double after = tet_volumes(mesh.points, mesh.tets).sum();
  constexpr double rounding = 1e-9;
  if (std::abs(after - this->volume_) > rounding * this->volume_)
  {
    return Status::failure(StatusCode::internal_error,
      "they changed the volume from " + short_number(this->volume_) + " to " + short_number(after));
  }
  Status status = check_tets(mesh.points, mesh.tets);
  if (status.ok())
  {
    this->mesh_ = std::move(mesh);
  }
  return status;
}

/// Points of the handles that lie inside, and points between them. Those between keep some distance
/// from the boundary: there are vertices enough there, and flat tets would lie between.
Status CdtTets::place_handles(const Triangles& boundary, const SizingField& field, Points& places)
{
  const Points& points = this->mesh_.points;
  const HandleSamples samples =
    sample_places(this->options_.handles, [&](const Vec3& p) { return field.at(p); });
  WindingNumber winding;
  WindingNumber::Options few;
  few.expected_queries = std::max<Index>(1, samples.points.rows());
  Status status = winding.build(points, boundary, this->context_, few);
  Eigen::VectorXd w;
  status = status.ok() ? winding.evaluate(samples.points, this->context_, w) : status;
  if (!status.usable())
  {
    return status;
  }
  const TriangleTree tree(points, boundary);
  places.resize(samples.points.rows(), 3);
  Index kept = 0;
  for (Index i = 0; i < samples.points.rows(); ++i)
  {
    const Vec3 p = samples.points.row(i);
    constexpr double near = 0.3; // of the local length
    constexpr double touching = 1e-6; // of the diagonal
    const double distance = i < samples.chosen ? touching * this->diagonal_ : near * field.at(p);
    constexpr double half = 0.5; // the numbers are 0 and 1
    if (w[i] > half && tree.distance(p, distance) > distance)
    {
      places.row(kept++) = p;
    }
  }
  places.conservativeResize(kept, 3);
  return {};
}

/// How long edges inside become: as long as the shortest ones of the boundary near them, and longer
/// by half of the distance to these. (Means of the lengths make tets too coarse for small details
/// between long triangles.)
SizingField CdtTets::lengths_inside(const Triangles& boundary) const
{
  const Points& points = this->mesh_.points;
  constexpr double none = std::numeric_limits<double>::infinity();
  Eigen::VectorXd shortest = Eigen::VectorXd::Constant(points.rows(), none);
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
    if (shortest[v] < none)
    {
      sites.row(count) = points.row(v);
      lengths[count++] = shortest[v];
    }
  }
  sites.conservativeResize(count, 3);
  lengths.conservativeResize(count);
  constexpr double growth = 0.5;
  const double largest = this->options_.interior_edge > 0.0 ? this->options_.interior_edge : 1.0;
  return SizingField(sites, lengths, growth, largest * this->diagonal_);
}

/// Makes flat tets better. The input's vertices and those of handles stay, and so does the boundary
/// but for the diagonals of triangles in one plane.
Status CdtTets::improve()
{
  const double start = this->context_.elapsed_seconds();
  TetMesh mesh = this->mesh_;
  std::vector<char> held(static_cast<std::size_t>(mesh.points.rows()), 0);
  std::fill_n(held.begin(), std::min(this->mesh_original_.size(), held.size()), 1);
  for (const Index v : this->handle_vertices_)
  {
    held[v] = 1;
  }
  ImproveOptions options;
  options.least_angle = 0.0; // held vertices never move
  options.keep_boundary = true;
  options.coplanar = coplanar * this->diagonal_;
  options.insert = true;
  options.slack = 0.7;
  Improvement done;
  if (!improve_tets(mesh, std::move(held), {}, options, done, this->context_))
  {
    return Status::cancelled();
  }
  std::vector<TetFacet> facets = tet_facets(mesh.tets);
  peel_slivers(mesh.points, mesh.tets, facets, flat_height * this->diagonal_);
  const Status status = check_tets(mesh.points, mesh.tets, facets);
  this->log_.add("flat tets improved", this->context_.elapsed_seconds() - start, status);
  if (status.ok())
  {
    this->mesh_ = std::move(mesh);
  }
  return {};
}

/// Vertices are wanted inside.
bool CdtTets::fills() const
{
  return this->options_.quality > 0.0 || this->options_.interior_edge > 0.0;
}

} // namespace bindpose
