// Curves in the plane: exact arrangement, and quality triangles of a region.
//
// Arrangement: all points and segments are inserted into a constrained Delaunay triangulation with
// exact coordinates, which splits segments where they cross, overlap or contain a point. New
// vertices are rounded to doubles. Rounding moves vertices by a unit in the last place, so that the
// parts of segments may cross again. Therefore insertion and rounding are repeated until no new
// vertex appears.
//
// Curves that almost touch leave gaps that are too narrow for refinement. In this case, new
// vertices are rounded to a coarser grid instead, and an edge that passes close to a point is
// replaced by two edges through the point (snap rounding: Hobby; Guibas and Marimont).
//
// Filling: Delaunay refinement (Ruppert, Shewchuk; CGAL's Delaunay_mesher_2), one point at a time,
// with a limit on the number of points. A minimum angle of up to 20.6 degrees can always be
// reached, except at smaller angles of the outline itself. A minimum angle of 30 degrees can
// usually be reached.
#include "mesher/jobs.h"

#include "base/stopwatch.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace bindpose
{

namespace
{
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Inexact = CGAL::Exact_predicates_inexact_constructions_kernel;
using Pair = std::pair<Index, Index>;
using Pairs = std::set<Pair>; // edges without direction: the lower id first
using Coordinates = std::array<double, 2>;

/// Id of a vertex; -1: no id.
struct VertexId
{
  Index value = -1;
};

using ExactVertex = CGAL::Triangulation_vertex_base_with_info_2<VertexId, Exact>;
using ExactFace = CGAL::Constrained_triangulation_face_base_2<Exact>;
using Arrangement = CGAL::Constrained_Delaunay_triangulation_2<Exact,
  CGAL::Triangulation_data_structure_2<ExactVertex, ExactFace>, CGAL::Exact_intersections_tag>;

struct Plane
{
  std::vector<Coordinates> points;
  // Id of each point, by coordinates; if several points are equal, id of the first one.
  std::map<Coordinates, Index> ids;

  Index add(const Coordinates& p)
  {
    const auto [entry, is_new] = this->ids.emplace(p, static_cast<Index>(this->points.size()));
    if (is_new)
    {
      this->points.push_back(p);
    }
    return entry->second;
  }
};

Pair ordered_pair(Index a, Index b)
{
  return { std::min(a, b), std::max(a, b) };
}

/// Return the exact value, rounded to double. The result must not depend on the interval
/// approximation of x, which depends on how x was computed.
double rounded(const Exact::FT& x)
{
  return CGAL::to_double(CGAL::exact(x));
}

/// Round a coordinate to the grid, or return it unchanged if there is no grid.
double snapped(double x, double grid)
{
  return grid > 0.0 ? std::round(x / grid) * grid : x;
}

/// If an edge passes a vertex at less than half of the grid spacing, replace it by two edges
/// through the vertex. @return whether an edge was replaced.
bool snap_edges_to_points(
  const Arrangement& arrangement, const Plane& plane, double grid, Pairs& edges)
{
  bool any = false;
  for (auto f = arrangement.finite_faces_begin(); f != arrangement.finite_faces_end(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Index a = f->vertex(Arrangement::ccw(k))->info().value;
      const Index b = f->vertex(Arrangement::cw(k))->info().value;
      const Index v = f->vertex(k)->info().value;
      const auto edge = edges.find(ordered_pair(a, b));
      if (edge == edges.end() || v == a || v == b)
      {
        continue;
      }
      const auto difference = [&](Index from, Index to)
      {
        return Coordinates{ plane.points[to][0] - plane.points[from][0],
          plane.points[to][1] - plane.points[from][1] };
      };
      const Coordinates edge_vector = difference(a, b);
      const Coordinates to_v = difference(a, v);
      const double length = std::hypot(edge_vector[0], edge_vector[1]);
      const double along_edge = (edge_vector[0] * to_v[0] + edge_vector[1] * to_v[1]) / length;
      const double edge_distance =
        std::abs(edge_vector[0] * to_v[1] - edge_vector[1] * to_v[0]) / length;
      if (edge_distance < 0.5 * grid && along_edge > 0.0 && along_edge < length)
      {
        edges.erase(edge);
        edges.insert(ordered_pair(a, v));
        edges.insert(ordered_pair(v, b));
        any = true;
      }
    }
  }
  return any;
}

/// Insert points and edges. @return empty, or the reason for giving up.
std::string insert(const Plane& plane, const Pairs& edges, Arrangement& arrangement)
{
  std::vector<std::pair<Exact::Point_2, VertexId>> points;
  points.reserve(plane.ids.size());
  for (const auto& [p, id] : plane.ids)
  {
    points.emplace_back(Exact::Point_2(p[0], p[1]), VertexId{ id });
  }
  arrangement.insert(points.begin(), points.end());
  std::vector<Arrangement::Vertex_handle> vertices(plane.points.size());
  for (auto v = arrangement.finite_vertices_begin(); v != arrangement.finite_vertices_end(); ++v)
  {
    vertices[v->info().value] = v;
  }
  constexpr std::size_t growth = 20;
  constexpr std::size_t vertex_allowance = 2000000;
  const std::size_t limit = growth * vertices.size() + vertex_allowance;
  std::size_t done = 0;
  for (const auto& [a, b] : edges)
  {
    arrangement.insert_constraint(vertices[a], vertices[b]);
    if (arrangement.number_of_vertices() > limit)
    {
      return "the curves cross at more than " + std::to_string(limit) + " points";
    }
    constexpr std::size_t check_interval = 4096;
    if (++done % check_interval == 0)
    {
      report_progress(0.5 * static_cast<double>(done) / static_cast<double>(edges.size()));
    }
  }
  return {};
}

using FillVertex = CGAL::Delaunay_mesh_vertex_base_2<Inexact,
  CGAL::Triangulation_vertex_base_with_info_2<VertexId, Inexact>>;
using FillFace = CGAL::Delaunay_mesh_face_base_2<Inexact>;
using Filling = CGAL::Constrained_Delaunay_triangulation_2<Inexact,
  CGAL::Triangulation_data_structure_2<FillVertex, FillFace>, CGAL::Exact_predicates_tag>;

/// Quality criteria for the refinement: bounds for angles and lengths. Triangles with a side
/// shorter than `smallest_side` are not refined for their angles. Without this exception,
/// refinement could continue down to the resolution of doubles, because an angle bound above 20.6
/// degrees cannot be satisfied everywhere.
class Criteria : public CGAL::Delaunay_mesh_size_criteria_2<Filling>
{
public:
  using Base = CGAL::Delaunay_mesh_size_criteria_2<Filling>;

  Criteria(double sine_squared, double longest_edge, double smallest_side)
    // Delaunay_mesh_criteria_2 is a virtual base class, so the most derived class calls its
    // constructor.
    : CGAL::Delaunay_mesh_criteria_2<Filling>(sine_squared), Base(sine_squared, longest_edge),
      smallest_side_(smallest_side)
  {
  }

  class Is_bad : public Base::Is_bad // NOLINT(readability-identifier-naming): required by CGAL
  {
  public:
    using BaseIsBad = Base::Is_bad;

    Is_bad(const BaseIsBad& base, double smallest_side)
      : BaseIsBad(base), smallest_side_squared_(smallest_side * smallest_side)
    {
    }

    CGAL::Mesh_2::Face_badness operator()(const Quality quality) const
    {
      return BaseIsBad::operator()(quality);
    }
    CGAL::Mesh_2::Face_badness operator()(const Filling::Face_handle& face, Quality& quality) const
    {
      const CGAL::Mesh_2::Face_badness badness = BaseIsBad::operator()(face, quality);
      return badness == CGAL::Mesh_2::BAD && this->is_tiny(face) ? CGAL::Mesh_2::NOT_BAD : badness;
    }

  private:
    bool is_tiny(const Filling::Face_handle& face) const
    {
      for (int k = 0; k < 3; ++k)
      {
        const auto& a = face->vertex(k)->point();
        const auto& b = face->vertex(Filling::ccw(k))->point();
        if (CGAL::squared_distance(a, b) < this->smallest_side_squared_)
        {
          return true;
        }
      }
      return false;
    }

    double smallest_side_squared_;
  };

  Is_bad is_bad_object() const { return { Base::is_bad_object(), this->smallest_side_ }; }

private:
  double smallest_side_;
};

/// Triangulate the region and mark the faces inside it.
std::string build(const MesherData& data, Filling& filling)
{
  // Sides that belong to only one triangle. They are directed, with the inside to the left.
  std::set<Pair> outline;
  std::set<Index> used;
  for (Index t = 0; t < data.triangles.rows(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Index a = data.triangles(t, k);
      const Index b = data.triangles(t, (k + 1) % 3);
      used.insert(a);
      if (outline.erase({ b, a }) == 0)
      {
        outline.insert({ a, b });
      }
    }
  }
  std::vector<std::pair<Inexact::Point_2, VertexId>> points;
  points.reserve(used.size());
  for (const Index v : used)
  {
    points.emplace_back(Inexact::Point_2(data.points(v, 0), data.points(v, 1)), VertexId{ v });
  }
  filling.insert(points.begin(), points.end());
  std::map<Index, Filling::Vertex_handle> vertices;
  for (auto v = filling.finite_vertices_begin(); v != filling.finite_vertices_end(); ++v)
  {
    vertices[v->info().value] = v;
  }
  for (const auto& [a, b] : outline)
  {
    filling.insert_constraint(vertices.at(a), vertices.at(b));
  }
  for (Index e = 0; e < data.segments.rows(); ++e)
  {
    filling.insert_constraint(vertices.at(data.segments(e, 0)), vertices.at(data.segments(e, 1)));
  }
  if (filling.number_of_vertices() != used.size())
  {
    return "the region's edges cross";
  }
  for (auto f = filling.all_faces_begin(); f != filling.all_faces_end(); ++f)
  {
    f->set_in_domain(false);
  }
  std::vector<Filling::Face_handle> front;
  const auto add_face = [&](Filling::Face_handle face)
  {
    if (!face->is_in_domain() && !filling.is_infinite(face))
    {
      face->set_in_domain(true);
      front.push_back(face);
    }
  };
  for (const auto& [a, b] : outline)
  {
    Filling::Face_handle face;
    int side = 0;
    if (!filling.is_edge(vertices.at(a), vertices.at(b), face, side))
    {
      return "the outline of the region is not a set of edges";
    }
    const bool left = face->vertex(Filling::ccw(side))->info().value == a;
    add_face(left ? face : face->neighbor(side));
  }
  while (!front.empty())
  {
    const Filling::Face_handle face = front.back();
    front.pop_back();
    for (int k = 0; k < 3; ++k)
    {
      const Index a = face->vertex(Filling::ccw(k))->info().value;
      const Index b = face->vertex(Filling::cw(k))->info().value;
      if (outline.count({ a, b }) == 0)
      {
        add_face(face->neighbor(k));
      }
    }
  }
  return {};
}

double area_of(const MesherData& data)
{
  double twice = 0.0;
  for (Index t = 0; t < data.triangles.rows(); ++t)
  {
    const auto corner = [&](int k) { return data.points.row(data.triangles(t, k)); };
    twice += (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
  }
  return 0.5 * twice;
}

/// Refine the triangulation. @return whether the bounds are satisfied everywhere with at most
/// `limit` vertices.
bool refine(Filling& filling, double min_angle, const FillOptions& options, std::size_t limit,
  const Stopwatch& clock)
{
  const double sine = std::sin(min_angle * M_PI / 180.0);
  const Criteria criteria(sine * sine, options.longest_edge, options.smallest_side);
  CGAL::Delaunay_mesher_2<Filling, Criteria> mesher(filling, criteria);
  mesher.init(true);
  std::size_t steps = 0;
  while (!mesher.is_refinement_done())
  {
    mesher.step_by_step_refine_mesh();
    constexpr std::size_t check_interval = 1024;
    if (++steps % check_interval == 0)
    {
      const auto vertices = static_cast<double>(filling.number_of_vertices());
      report_progress(std::min(vertices / static_cast<double>(limit), 1.0));
      if (filling.number_of_vertices() > limit || clock.seconds() > options.time_limit)
      {
        return false;
      }
    }
  }
  return true;
}

void collect_triangles(const Filling& filling, MesherData& data)
{
  std::vector<Inexact::Point_2> added_points;
  std::map<Filling::Vertex_handle, Index> ids;
  std::vector<std::array<Index, 3>> triangles;
  for (auto f = filling.finite_faces_begin(); f != filling.finite_faces_end(); ++f)
  {
    if (!f->is_in_domain())
    {
      continue;
    }
    std::array<Index, 3> triangle{};
    for (int k = 0; k < 3; ++k)
    {
      const Filling::Vertex_handle v = f->vertex(k);
      triangle[k] = v->info().value;
      if (triangle[k] < 0)
      {
        const Index next = data.points.rows() + static_cast<Index>(added_points.size());
        const auto [entry, is_new] = ids.emplace(v, next);
        if (is_new)
        {
          added_points.push_back(v->point());
        }
        triangle[k] = entry->second;
      }
    }
    triangles.push_back(triangle);
  }
  const Index old_count = data.points.rows();
  data.points.conservativeResize(old_count + static_cast<Index>(added_points.size()), 3);
  for (std::size_t k = 0; k < added_points.size(); ++k)
  {
    data.points.row(old_count + static_cast<Index>(k)) << added_points[k].x(), added_points[k].y(),
      0.0;
  }
  data.triangles.resize(static_cast<Index>(triangles.size()), 3);
  for (Index t = 0; t < data.triangles.rows(); ++t)
  {
    data.triangles.row(t) << triangles[t][0], triangles[t][1], triangles[t][2];
  }
  data.segments.resize(0, 2);
}
} // namespace

std::string arrange(MesherData& data, double grid)
{
  Plane plane;
  for (Index v = 0; v < data.points.rows(); ++v)
  {
    plane.points.push_back({ data.points(v, 0), data.points(v, 1) });
    plane.ids.emplace(plane.points.back(), v);
  }
  Pairs edges;
  for (Index e = 0; e < data.segments.rows(); ++e)
  {
    const Index a = plane.ids.at(plane.points[data.segments(e, 0)]);
    const Index b = plane.ids.at(plane.points[data.segments(e, 1)]);
    if (a != b)
    {
      edges.insert(ordered_pair(a, b));
    }
  }
  constexpr int round_limit = 30;
  for (int round = 1;; ++round)
  {
    Arrangement arrangement;
    std::string error = insert(plane, edges, arrangement);
    if (!error.empty())
    {
      return error;
    }
    bool has_added_points = false;
    for (auto v = arrangement.finite_vertices_begin(); v != arrangement.finite_vertices_end(); ++v)
    {
      if (v->info().value < 0)
      {
        v->info().value = plane.add(
          { snapped(rounded(v->point().x()), grid), snapped(rounded(v->point().y()), grid) });
        has_added_points = true;
      }
    }
    edges.clear();
    for (auto e = arrangement.constrained_edges_begin(); e != arrangement.constrained_edges_end();
         ++e)
    {
      const Index a = e->first->vertex(Arrangement::ccw(e->second))->info().value;
      const Index b = e->first->vertex(Arrangement::cw(e->second))->info().value;
      if (a != b) // rounding may have merged the two ends of the edge
      {
        edges.insert(ordered_pair(a, b));
      }
    }
    has_added_points =
      (grid > 0.0 && snap_edges_to_points(arrangement, plane, grid, edges)) || has_added_points;
    if (!has_added_points)
    {
      report_value("rounds", round);
      data.triangles.resize(static_cast<Index>(arrangement.number_of_faces()), 3);
      Index t = 0;
      for (auto f = arrangement.finite_faces_begin(); f != arrangement.finite_faces_end(); ++f, ++t)
      {
        for (int k = 0; k < 3; ++k)
        {
          data.triangles(t, k) = f->vertex(k)->info().value;
        }
      }
      data.triangles.conservativeResize(t, 3);
      break;
    }
    if (round == round_limit)
    {
      return "curves still cross after " + std::to_string(round) + " rounds of splitting";
    }
  }
  data.points.resize(static_cast<Index>(plane.points.size()), 3);
  for (Index v = 0; v < data.points.rows(); ++v)
  {
    data.points.row(v) << plane.points[v][0], plane.points[v][1], 0.0;
  }
  data.segments.resize(static_cast<Index>(edges.size()), 2);
  Index e = 0;
  for (const auto& [a, b] : edges)
  {
    data.segments.row(e++) << a, b;
  }
  return {};
}

std::string fill_plane(MesherData& data, const FillOptions& options)
{
  const Stopwatch clock;
  // Upper estimate of the number of triangles. It assumes equilateral triangles with edges of
  // length options.longest_edge / 2. The triangles that refinement creates are larger.
  const double triangles = options.longest_edge > 0.0
    ? area_of(data) / (0.4 * 0.25 * options.longest_edge * options.longest_edge)
    : 0.0;
  constexpr double triangle_allowance = 20000.0;
  constexpr double growth = 30.0;
  const auto limit = static_cast<std::size_t>(
    triangle_allowance + triangles + growth * static_cast<double>(data.points.rows()));
  constexpr double guaranteed_angle = 20.6; // degrees; this bound can always be satisfied
  Filling filling;
  double angle = options.min_angle;
  bool done = false;
  for (;;)
  {
    std::string error = build(data, filling);
    if (!error.empty())
    {
      return error;
    }
    done = refine(filling, angle, options, limit, clock);
    if (done || angle <= guaranteed_angle || clock.seconds() > options.time_limit)
    {
      break;
    }
    angle = guaranteed_angle;
    filling.clear();
  }
  collect_triangles(filling, data);
  report_value("min_angle", angle);
  report_value("stopped", done ? 0.0 : 1.0);
  return {};
}

} // namespace bindpose
