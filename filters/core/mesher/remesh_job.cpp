// Tets of {winding number >= threshold} by CGAL's Delaunay refinement (Mesh_3; Jamin, Alliez,
// Yvinec, Boissonnat, CGALmesh: a Generic Framework for Delaunay Mesh Generation, 2015).
//
// 1. A sizing field is computed from the thickness of the region and from the edge lengths of those
//    parts of the surface that bound the region.
// 2. The initial triangulation is built from points on the boundary, in this order: corners, other
//    crease vertices, points on long crease edges, all other surface vertices, points in triangles.
//    A point is omitted if an existing vertex is too near, because no good tet fits between them.
//    The limit is the desired edge length for points in triangles, and half of it for the others.
// 3. Refinement inserts points of the boundary and circumcenters until facets and cells are small
//    and round enough. Facets and cells smaller than a fraction of the desired length are never
//    split. Therefore refinement ends even at creases that are too sharp for the required angles,
//    and in parts thinner than the shortest edge.
//
// The result contains slivers. Tet improvement (tet_improvement.h) removes them better than CGAL's
// exudation and perturbation, and it always ends. (Measured smallest dihedral angles: 2 and 7
// degrees after exudation, 12 degrees after improvement.)
#include "mesher/circumcenter_traits.h"
#include "mesher/jobs.h"

#include "base/number_text.h"
#include "base/stopwatch.h"
#include "inside/crease_points.h"
#include "inside/sizing_field.h"
#include "segmentation/region_boundary.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/refine_mesh_3.h>

#include <algorithm>
#include <map>

namespace bindpose
{

namespace
{
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Domain = CGAL::Labeled_mesh_domain_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain, CircumcenterKernel>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using FacetCriteria = CGAL::Mesh_facet_criteria_3<Triangulation>;
using CellCriteria = CGAL::Mesh_cell_criteria_3<Triangulation>;

Vec3 to_vec3(const Kernel::Point_3& p)
{
  return { p.x(), p.y(), p.z() };
}
Kernel::Point_3 to_point(const Vec3& p)
{
  return { p.x(), p.y(), p.z() };
}

/// A multiple of the sizing field, with the interface that CGAL requires.
struct ScaledSizing
{
  using FT = Kernel::FT;
  using Point_3 = Kernel::Point_3;
  using Index = Domain::Index;
  FT operator()(const Point_3& p, int, const Index&) const
  {
    return this->factor * this->field->at(to_vec3(p));
  }
  const SizingField* field;
  double factor;
};

// Bounds for circumradii, in units of the desired edge length. For comparison, the circumradius is
// 0.577 for an equilateral triangle, 0.707 for half a square, and 0.612 for a regular tet.
constexpr double facet_radius = 0.8;
constexpr double cell_radius = 0.85;
constexpr double facet_distance = 0.2;
constexpr double facet_angle = 25.0; // degrees
constexpr double radius_edge = 2.0;
// Facets and cells with circumradii smaller than this, in units of the desired edge length, are not
// split.
constexpr double least_facet_radius = 0.25;
constexpr double least_cell_radius = 0.25;

class BoundedFacetCriteria
{
public:
  using Visitor = FacetCriteria::Visitor;
  using Facet_quality = FacetCriteria::Facet_quality;
  using Is_facet_bad = FacetCriteria::Is_facet_bad;
  using Has_manifold_criterion = CGAL::Tag_true;

  explicit BoundedFacetCriteria(const SizingField& field)
    : criteria_(
        facet_angle, ScaledSizing{ &field, facet_radius }, ScaledSizing{ &field, facet_distance }),
      field_(field)
  {
  }
  Is_facet_bad operator()(const Triangulation& t, const Triangulation::Facet& facet) const
  {
    Is_facet_bad bad = this->criteria_(t, facet);
    if (bad)
    {
      const auto center = facet.first->get_facet_surface_center(facet.second);
      const auto corner = facet.first->vertex((facet.second + 1) % 4)->point().point();
      const double least = least_facet_radius * this->field_.at(to_vec3(center));
      if (CGAL::squared_distance(center, corner) < least * least)
      {
        return Is_facet_bad();
      }
    }
    return bad;
  }
  CGAL::Mesh_facet_topology topology() const { return this->criteria_.topology(); }

private:
  FacetCriteria criteria_;
  const SizingField& field_;
};

class BoundedCellCriteria
{
public:
  using Visitor = CellCriteria::Visitor;
  using Cell_quality = CellCriteria::Cell_quality;
  using Is_cell_bad = CellCriteria::Is_cell_bad;

  explicit BoundedCellCriteria(const SizingField& field)
    : criteria_(radius_edge, ScaledSizing{ &field, cell_radius }), field_(field)
  {
  }
  Is_cell_bad operator()(const Triangulation& t, const Triangulation::Cell_handle& cell) const
  {
    Is_cell_bad bad = this->criteria_(t, cell);
    if (bad)
    {
      const auto center = t.dual(cell);
      const double least = least_cell_radius * this->field_.at(to_vec3(center));
      if (CGAL::squared_distance(center, cell->vertex(0)->point().point()) < least * least)
      {
        return Is_cell_bad();
      }
    }
    return bad;
  }

private:
  CellCriteria criteria_;
  const SizingField& field_;
};

class Criteria
{
public:
  using Facet_criteria = BoundedFacetCriteria;
  using Cell_criteria = BoundedCellCriteria;

  explicit Criteria(const SizingField& field) : facets_(field), cells_(field) {}
  const Facet_criteria& facet_criteria_object() const { return this->facets_; }
  const Cell_criteria& cell_criteria_object() const { return this->cells_; }

private:
  BoundedFacetCriteria facets_;
  BoundedCellCriteria cells_;
};

/// Return the fraction of the boundary, by area, at which the region or the gap next to the region
/// is not thicker than smallest_edge.
double thin_fraction(const BoundarySites& sites, double smallest_edge)
{
  const double area = sites.areas.sum();
  const double thin_area =
    (sites.thickness.array() <= smallest_edge).select(sites.areas.array(), 0.0).sum();
  return area > 0.0 ? thin_area / area : 0.0;
}

/// Create the sizing field. Increase options.smallest_edge until the expected number of tets is at
/// most options.tet_limit.
SizingField make_field(const BoundarySites& sites, RemeshJobOptions& options)
{
  for (;; options.smallest_edge *= 1.1)
  {
    options.largest_edge = std::max(options.largest_edge, options.smallest_edge);
    const Eigen::VectorXd lengths =
      sites.lengths.array().max(options.smallest_edge).min(options.largest_edge);
    // A regular tet with edges of length e has the volume 0.118 e^3. At the depth d below the
    // boundary, e = h + growth d, where h is the length at the boundary. The integral of e^-3 over
    // d is 1 / (2 growth h^2). Therefore per_area / h^2 tets are expected per boundary area.
    const double per_area = 0.5 / (0.118 * options.growth);
    const double tets = per_area * (sites.areas.array() / lengths.array().square()).sum();
    if (tets <= options.tet_limit)
    {
      return { sites.points, lengths, options.growth, options.largest_edge };
    }
  }
}

class InitialMesh
{
public:
  InitialMesh(Complex& complex, const Domain::Index& index, const SizingField& field)
    : complex_(complex), index_(index), field_(field)
  {
  }
  void insert(const Vec3& p, double point_spacing)
  {
    Triangulation& t = this->complex_.triangulation();
    const Triangulation::Weighted_point point(to_point(p));
    if (t.number_of_vertices() > 0)
    {
      const auto nearest_vertex = t.nearest_power_vertex(point.point());
      const double least = point_spacing * this->field_.at(p);
      if (CGAL::squared_distance(nearest_vertex->point().point(), point.point()) < least * least)
      {
        return;
      }
    }
    const auto vertex = t.insert(point);
    if (vertex != Triangulation::Vertex_handle())
    {
      this->complex_.set_dimension(vertex, 2);
      this->complex_.set_index(vertex, this->index_);
    }
  }

private:
  Complex& complex_;
  Domain::Index index_;
  const SizingField& field_;
};

void copy_result(const Complex& complex, MesherData& data)
{
  std::map<Triangulation::Vertex_handle, Index> ids;
  std::vector<Vec3> points;
  std::vector<std::array<Index, 4>> tets;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell)
  {
    std::array<Index, 4> tet{};
    for (int k = 0; k < 4; ++k)
    {
      const auto [entry, is_new] = ids.emplace(cell->vertex(k), static_cast<Index>(points.size()));
      if (is_new)
      {
        points.push_back(to_vec3(cell->vertex(k)->point().point()));
      }
      tet[k] = entry->second;
    }
    tets.push_back(tet);
  }
  data = MesherData();
  data.points.resize(static_cast<Index>(points.size()), 3);
  for (Index v = 0; v < data.points.rows(); ++v)
  {
    data.points.row(v) = points[v];
  }
  data.tets.resize(static_cast<Index>(tets.size()), 4);
  for (Index t = 0; t < data.tets.rows(); ++t)
  {
    data.tets.row(t) << tets[t][0], tets[t][1], tets[t][2], tets[t][3];
  }
}
} // namespace

std::string remesh(MesherData& data, RemeshJobOptions options)
{
  const Stopwatch clock;
  ExecutionContext context;
  WindingNumber winding;
  const Status status = winding.build(context, data.points, data.triangles);
  if (!status.usable())
  {
    return status.message;
  }
  const RegionBoundary region(data.points, data.triangles, winding, options.winding_threshold);
  BoundarySampling sampling;
  sampling.smallest = options.smallest_edge;
  sampling.largest = options.largest_edge;
  BoundarySites sites;
  sample_boundary(context, region, sampling, sites);
  report_value("counts.boundary_vertices", static_cast<double>(sites.vertices.size()));
  if (sites.points.rows() == 0)
  {
    data = MesherData(); // the surface encloses no volume
    return {};
  }
  const double thin = thin_fraction(sites, options.smallest_edge);
  report_value("thin_fraction", thin);
  if (thin > options.maximum_thin_fraction)
  {
    constexpr double percent = 100.0;
    return short_number(percent * thin) +
      " % of the boundary's area bounds parts or gaps thinner than the smallest edge (at most " +
      short_number(percent * options.maximum_thin_fraction) + " % is allowed)";
  }
  const SizingField field = make_field(sites, options);
  const CreasePoints creases = find_creases(region, field);
  report_value("seconds.sample", clock.seconds());

  const Box box = region.box();
  const double radius = 0.5 * box.diagonal();
  constexpr double error = 1e-7;
  const Domain domain = Domain::create_implicit_mesh_domain([&](const Kernel::Point_3& p)
    { return region.contains(to_vec3(p)) ? -1.0 : 1.0; },
    Kernel::Sphere_3(to_point(box.center()), 1.21 * radius * radius),
    CGAL::parameters::relative_error_bound = error);
  Complex complex;
  const Domain::Index on_surface =
    domain.index_from_surface_patch_index(Domain::Surface_patch_index(0, 1));
  InitialMesh initial_mesh(complex, on_surface, field);
  constexpr double point_spacing = 0.5;
  for (const auto* vertices : { &creases.corners, &creases.vertices })
  {
    for (const Index v : *vertices)
    {
      initial_mesh.insert(region.points().row(v), point_spacing);
    }
  }
  for (Index i = 0; i < creases.edge_points.rows(); ++i)
  {
    initial_mesh.insert(creases.edge_points.row(i), point_spacing);
  }
  for (const Index v : sites.vertices)
  {
    initial_mesh.insert(region.points().row(v), point_spacing);
  }
  for (Index i = static_cast<Index>(sites.vertices.size()); i < sites.points.rows(); ++i)
  {
    constexpr double wide_spacing = 1.0;
    initial_mesh.insert(sites.points.row(i), wide_spacing);
  }
  // If the surface is open, the part that bounds the region may lie in one plane. Then the initial
  // triangulation needs points in other planes.
  std::vector<std::pair<Kernel::Point_3, Domain::Index>> extra_points;
  constexpr int extra_point_count = 100;
  if (complex.triangulation().dimension() < 3)
  {
    domain.construct_initial_points_object()(std::back_inserter(extra_points), extra_point_count);
  }
  for (const auto& [p, index] : extra_points)
  {
    constexpr double no_spacing = 0.0;
    initial_mesh.insert(to_vec3(p), no_spacing);
  }
  if (complex.triangulation().dimension() < 3)
  {
    return "the boundary of the enclosed region is flat";
  }
  report_value("seconds.start", clock.seconds());

  // A mesh has about five tets per vertex, so this limit is far above the expected number of
  // vertices. The limit stops refinements that would not end by themselves.
  const auto maximum_vertices =
    static_cast<std::size_t>(options.tet_limit) + 2 * complex.triangulation().number_of_vertices();
  CGAL::Mesh_error_code code = CGAL::CGAL_MESH_3_NO_ERROR;
  CGAL::refine_mesh_3(complex, domain, Criteria(field), CGAL::parameters::no_reset_c3t3(),
    CGAL::parameters::no_perturb(), CGAL::parameters::no_exude(), CGAL::parameters::manifold(),
    CGAL::parameters::mesh_3_options(
      CGAL::parameters::maximal_number_of_vertices = maximum_vertices,
      CGAL::parameters::pointer_to_error_code = &code));
  if (code != CGAL::CGAL_MESH_3_NO_ERROR)
  {
    return "the refinement did not terminate after " + std::to_string(maximum_vertices) +
      " vertices";
  }
  report_value("seconds.refine", clock.seconds());
  if (complex.number_of_cells_in_complex() == 0)
  {
    return "the refinement found no cells inside the surface";
  }
  copy_result(complex, data);
  return {};
}

} // namespace bindpose
