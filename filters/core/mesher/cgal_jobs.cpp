// Exact refinement of a triangle soup, and plain Delaunay tets.
//
// A round of refinement has four steps:
// 1. Exact predicates find the pairs of triangles whose intersection contains more than shared
//    vertices and edges, among the pairs with overlapping boxes.
// 2. The exact intersection of each such pair (points and segments) is recorded for both triangles.
// 3. Each triangle with recorded intersections is projected along its largest normal component. An
//    exact constrained Delaunay triangulation of the triangle's edges and intersections cuts the
//    triangle. New vertices are lifted back to the plane of the triangle.
// 4. New vertices are rounded to doubles. The same exact point has the same rounding in every
//    triangle that contains it, so neighboring triangles still match. Equal vertices are welded.
//    Triangles without area and duplicates are removed.
//
// Rounding moves vertices by a unit in the last place, so that triangles may cross again. Therefore
// rounds are repeated until no triangles cross. If sheets coincide except for the rounding of the
// program that computed them, the number of crossings increases in every round. In this case the
// job starts again with the input's vertices rounded to a grid in which such sheets coincide. The
// spacing of this grid is far larger than the resolution of doubles and far smaller than the
// details of shapes.
#include "mesher/jobs.h"

#include "base/stopwatch.h"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace bindpose
{

namespace
{
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Inexact = CGAL::Exact_predicates_inexact_constructions_kernel;
using Face = std::array<Index, 3>;
using Pair = std::pair<Index, Index>;
using Coordinates = std::array<double, 3>;

struct Soup
{
  std::vector<Coordinates> points;
  std::vector<Face> faces;
  std::map<Coordinates, Index> ids; // id of each point, by coordinates

  Inexact::Point_3 to_inexact(Index v) const
  {
    return { this->points[v][0], this->points[v][1], this->points[v][2] };
  }
  Exact::Point_3 exact(Index v) const
  {
    return { this->points[v][0], this->points[v][1], this->points[v][2] };
  }
  Inexact::Triangle_3 to_inexact(const Face& f) const
  {
    return { this->to_inexact(f[0]), this->to_inexact(f[1]), this->to_inexact(f[2]) };
  }
  Exact::Triangle_3 exact(const Face& f) const
  {
    return { this->exact(f[0]), this->exact(f[1]), this->exact(f[2]) };
  }
  Index add(const Coordinates& p)
  {
    const auto [entry, is_new] = this->ids.emplace(p, static_cast<Index>(this->points.size()));
    if (is_new)
    {
      this->points.push_back(p);
    }
    return entry->second;
  }
  bool degenerate(const Face& f) const
  {
    return f[0] == f[1] || f[1] == f[2] || f[2] == f[0] ||
      CGAL::collinear(this->to_inexact(f[0]), this->to_inexact(f[1]), this->to_inexact(f[2]));
  }
  /// Weld vertices with equal coordinates. Remove faces without area and duplicate faces.
  void remove_degenerate()
  {
    std::set<Face> added_faces;
    std::vector<Face> kept;
    for (Face f : this->faces)
    {
      for (Index& v : f)
      {
        v = this->ids.at(this->points[v]);
      }
      Face key = f;
      std::sort(key.begin(), key.end());
      if (!this->degenerate(f) && added_faces.insert(key).second)
      {
        kept.push_back(f);
      }
    }
    this->faces = std::move(kept);
  }
};

/// Report whether the intersection of two triangles with positive area contains more than the
/// vertices and edges that they share.
bool faces_cross(const Soup& soup, const Face& f, const Face& g)
{
  // Move shared vertices to the front of both triangles.
  Face a = f;
  Face b = g;
  int shared = 0;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = shared; j < 3; ++j)
    {
      if (f[i] == b[j])
      {
        std::swap(b[shared], b[j]);
        std::swap(*std::find(a.begin() + shared, a.end(), f[i]), a[shared]);
        ++shared;
        break;
      }
    }
  }
  const auto point = [&](Index v) { return soup.to_inexact(v); };
  if (shared == 0)
  {
    return CGAL::do_intersect(soup.to_inexact(f), soup.to_inexact(g));
  }
  if (shared == 1)
  {
    // The intersection is convex. If it contains more than the shared vertex, then the edge of one
    // triangle that is opposite to this vertex intersects the other triangle.
    return CGAL::do_intersect(Inexact::Segment_3(point(a[1]), point(a[2])), soup.to_inexact(g)) ||
      CGAL::do_intersect(Inexact::Segment_3(point(b[1]), point(b[2])), soup.to_inexact(f));
  }
  if (shared == 2)
  {
    return CGAL::coplanar(point(a[0]), point(a[1]), point(a[2]), point(b[2])) &&
      CGAL::coplanar_orientation(point(a[0]), point(a[1]), point(a[2]), point(b[2])) ==
      CGAL::POSITIVE;
  }
  return true;
}

/// Return the pairs of crossing triangles, sorted. If there are more than `maximum_pairs` pairs,
/// the list is incomplete.
std::vector<Pair> crossing_pairs(const Soup& soup, std::size_t maximum_pairs)
{
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, Index>;
  std::vector<Box> boxes;
  boxes.reserve(soup.faces.size());
  for (std::size_t f = 0; f < soup.faces.size(); ++f)
  {
    boxes.emplace_back(soup.to_inexact(soup.faces[f]).bbox(), static_cast<Index>(f));
  }
  std::vector<Pair> pairs;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(),
    [&](const Box& a, const Box& b)
    {
      if (pairs.size() <= maximum_pairs &&
        faces_cross(soup, soup.faces[a.info()], soup.faces[b.info()]))
      {
        pairs.push_back(std::minmax(a.info(), b.info()));
      }
    });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Points and segments along which a triangle must be cut.
struct Cuts
{
  std::vector<Exact::Point_3> points;
  std::vector<Exact::Segment_3> segments;
};

/// Append the intersection of an edge of one triangle with the other triangle to `points` or
/// `segments`.
void add_intersection(const Exact::Segment_3& edge, const Exact::Triangle_3& triangle,
  std::vector<Exact::Point_3>& points, std::vector<Exact::Segment_3>& segments)
{
  const auto intersection = CGAL::intersection(edge, triangle);
  if (!intersection)
  {
    return;
  }
  if (const auto* point = boost::get<Exact::Point_3>(&*intersection))
  {
    if (std::find(points.begin(), points.end(), *point) == points.end())
    {
      points.push_back(*point);
    }
  }
  else if (const auto* segment = boost::get<Exact::Segment_3>(&*intersection))
  {
    segments.push_back(*segment);
  }
}

void add_pair_intersections(
  const Soup& soup, const Face& f, const Face& g, Cuts& cuts_of_f, Cuts& cuts_of_g)
{
  const Exact::Triangle_3 a = soup.exact(f);
  const Exact::Triangle_3 b = soup.exact(g);
  std::vector<Exact::Point_3> points;
  std::vector<Exact::Segment_3> segments;
  for (int k = 0; k < 3; ++k)
  {
    add_intersection(Exact::Segment_3(a.vertex(k), a.vertex(k + 1)), b, points, segments);
    add_intersection(Exact::Segment_3(b.vertex(k), b.vertex(k + 1)), a, points, segments);
  }
  // For triangles in different planes, `points` contains at most two points: the ends of the
  // intersection segment. Triangles in one plane intersect in a single point, in a segment or in a
  // polygon. In the last two cases, `segments` contains the segment or the outline of the polygon,
  // and every point is an end of a segment.
  if (segments.empty() && points.size() == 2)
  {
    segments.emplace_back(points[0], points[1]);
  }
  for (Cuts* cuts : { &cuts_of_f, &cuts_of_g })
  {
    cuts->points.insert(cuts->points.end(), points.begin(), points.end());
    cuts->segments.insert(cuts->segments.end(), segments.begin(), segments.end());
  }
}

using VertexBase = CGAL::Triangulation_vertex_base_2<Exact>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Exact>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Planar =
  CGAL::Constrained_Delaunay_triangulation_2<Exact, Structure, CGAL::Exact_intersections_tag>;

/// Return the exact value, rounded to double. The result must not depend on the interval
/// approximation of x, which depends on how x was computed.
double rounded(const Exact::FT& x)
{
  return CGAL::to_double(CGAL::exact(x));
}

void cut(Soup& soup, const Face& face, const Cuts& cuts, std::vector<Face>& pieces)
{
  const std::array<Exact::Point_3, 3> corners{ soup.exact(face[0]), soup.exact(face[1]),
    soup.exact(face[2]) };
  const Exact::Vector_3 normal =
    CGAL::cross_product(corners[1] - corners[0], corners[2] - corners[0]);
  int axis = 0;
  for (int k = 1; k < 3; ++k)
  {
    if (CGAL::abs(CGAL::to_double(normal[k])) > CGAL::abs(CGAL::to_double(normal[axis])))
    {
      axis = k;
    }
  }
  if (normal[axis] == 0) // to_double() may have rounded tiny components of the normal to 0
  {
    axis = normal[0] != 0 ? 0 : (normal[1] != 0 ? 1 : 2);
  }
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  const bool keeps_orientation = normal[axis] > 0;
  const auto project = [&](const Exact::Point_3& p) { return Exact::Point_2(p[u], p[v]); };

  Planar planar;
  std::map<Planar::Vertex_handle, Index> ids;
  std::array<Planar::Vertex_handle, 3> ends;
  for (int k = 0; k < 3; ++k)
  {
    ends[k] = planar.insert(project(corners[k]));
    ids[ends[k]] = face[k];
  }
  for (int k = 0; k < 3; ++k)
  {
    planar.insert_constraint(ends[k], ends[(k + 1) % 3]);
  }
  // The positions of the recorded points in space are known. Only the vertices at which segments
  // cross each other must be lifted from the plane.
  std::map<Planar::Vertex_handle, Exact::Point_3> exact_points;
  const auto insert = [&](const Exact::Point_3& p)
  {
    const Planar::Vertex_handle vertex = planar.insert(project(p));
    exact_points.emplace(vertex, p);
    return vertex;
  };
  for (const Exact::Point_3& p : cuts.points)
  {
    insert(p);
  }
  for (const Exact::Segment_3& s : cuts.segments)
  {
    const Planar::Vertex_handle source = insert(s.source());
    const Planar::Vertex_handle target = insert(s.target());
    if (source != target)
    {
      planar.insert_constraint(source, target);
    }
  }
  for (auto vertex = planar.finite_vertices_begin(); vertex != planar.finite_vertices_end();
       ++vertex)
  {
    if (ids.count(vertex))
    {
      continue;
    }
    Coordinates p{};
    if (const auto entry = exact_points.find(vertex); entry != exact_points.end())
    {
      for (int k = 0; k < 3; ++k)
      {
        p[k] = rounded(entry->second[k]);
      }
    }
    else
    {
      const Exact::FT x = vertex->point().x();
      const Exact::FT y = vertex->point().y();
      const Exact::FT z = corners[0][axis] -
        (normal[u] * (x - corners[0][u]) + normal[v] * (y - corners[0][v])) / normal[axis];
      p[u] = rounded(x);
      p[v] = rounded(y);
      p[axis] = rounded(z);
    }
    ids[vertex] = soup.add(p);
  }
  for (auto f = planar.finite_faces_begin(); f != planar.finite_faces_end(); ++f)
  {
    const Face piece{ ids.at(f->vertex(0)), ids.at(f->vertex(1)), ids.at(f->vertex(2)) };
    pieces.push_back(keeps_orientation ? piece : Face{ piece[0], piece[2], piece[1] });
  }
}

std::string too_many_crossings(const std::string& message)
{
  report_value("too_many", 1.0);
  return message;
}

std::string time_limit_reached(double limit)
{
  return too_many_crossings(
    "still splitting crossing triangles after " + std::to_string(static_cast<int>(limit)) + " s");
}

/// Cut all triangles of the crossing pairs (one round of refinement). @return empty, or the reason
/// for giving up.
std::string split(Soup& soup, const std::vector<Pair>& pairs, const Stopwatch& clock,
  const RefineOptions& options, std::size_t face_limit)
{
  std::map<Index, Cuts> cuts;
  constexpr std::size_t check_interval = 256;
  for (std::size_t p = 0; p < pairs.size(); ++p)
  {
    const auto [f, g] = pairs[p];
    add_pair_intersections(soup, soup.faces[f], soup.faces[g], cuts[f], cuts[g]);
    if (p % check_interval == 0 && clock.seconds() > options.time_limit)
    {
      return time_limit_reached(options.time_limit);
    }
  }
  std::vector<Face> next;
  next.reserve(soup.faces.size());
  std::size_t done = 0;
  for (std::size_t f = 0; f < soup.faces.size(); ++f)
  {
    const auto entry = cuts.find(static_cast<Index>(f));
    if (entry == cuts.end())
    {
      next.push_back(soup.faces[f]);
      continue;
    }
    cut(soup, Face(soup.faces[f]), entry->second, next);
    if (++done % check_interval == 0)
    {
      report_progress(std::min(clock.seconds() / options.time_limit, 1.0));
    }
    if (next.size() > face_limit)
    {
      return too_many_crossings("crossing triangles would be split into more than " +
        std::to_string(face_limit) + " pieces");
    }
    if (clock.seconds() > options.time_limit)
    {
      return time_limit_reached(options.time_limit);
    }
  }
  soup.faces = std::move(next);
  soup.remove_degenerate();
  return {};
}

Soup soup_of(const MesherData& data)
{
  Soup soup;
  soup.points.resize(static_cast<std::size_t>(data.points.rows()));
  for (Index v = 0; v < data.points.rows(); ++v)
  {
    soup.points[v] = { data.points(v, 0), data.points(v, 1), data.points(v, 2) };
    soup.ids.emplace(soup.points[v], v);
  }
  for (Index f = 0; f < data.triangles.rows(); ++f)
  {
    soup.faces.push_back({ data.triangles(f, 0), data.triangles(f, 1), data.triangles(f, 2) });
  }
  soup.remove_degenerate();
  return soup;
}

/// Round the points to a grid of about 2^-42 (2e-13) of the bounding-box diagonal.
void round_points(MesherData& data)
{
  constexpr double fraction = 0x1p-42;
  const double step =
    std::exp2(std::round(std::log2(fraction * bounding_box(data.points).diagonal())));
  data.points = (data.points / step).array().round() * step;
}
} // namespace

std::string refine(MesherData& data, const RefineOptions& options)
{
  const Stopwatch clock;
  Soup soup = soup_of(data);
  // growth_limit is multiplied by the number of input faces, but at least by this number. Thus a
  // few hundred large triangles can be cut into tens of thousands of pieces and still be meshed.
  constexpr std::size_t minimum_limited_faces = 10000;
  const auto face_limit = static_cast<std::size_t>(
    options.growth_limit * static_cast<double>(std::max(soup.faces.size(), minimum_limited_faces)));
  // An increase in the number of crossing pairs is ignored if there are at most this many pairs.
  constexpr std::size_t minimum_crossings = 64;
  // After the input has been rounded, the job gives up if the number of crossings increases in this
  // many rounds.
  constexpr int maximum_growing_rounds = 3;
  // Maximum number of crossing pairs. More pairs would exceed the time limit or the growth limit,
  // because each pair adds at least two triangles.
  constexpr double seconds_per_pair = 2.5e-4;
  const auto pair_limit = std::min(static_cast<std::size_t>(options.time_limit / seconds_per_pair),
    face_limit / 2 - std::min(face_limit, soup.faces.size()) / 2);
  bool rounded = false;
  std::size_t before = std::numeric_limits<std::size_t>::max();
  int growing_rounds = 0; // number of rounds with more crossings than the round before
  int round = 0;
  for (; round < options.round_limit; ++round)
  {
    const std::vector<Pair> pairs = crossing_pairs(soup, pair_limit);
    // If few triangles cross, the first search takes about this fraction of the total time.
    constexpr double first_found = 0.4;
    report_progress(first_found);
    if (pairs.size() > pair_limit)
    {
      return too_many_crossings("more than " + std::to_string(pair_limit) +
        " pairs of triangles cross, too many to split them");
    }
    if (round == 0 && !rounded)
    {
      report_value("counts.self_intersections", static_cast<double>(pairs.size()));
    }
    if (pairs.empty())
    {
      break;
    }
    growing_rounds += pairs.size() > std::max(before, minimum_crossings) ? 1 : 0;
    before = std::max(pairs.size(), minimum_crossings);
    if (growing_rounds > 0 && !rounded)
    {
      round_points(data);
      soup = soup_of(data);
      rounded = true;
      growing_rounds = 0;
      before = std::numeric_limits<std::size_t>::max();
      round = -1;
      continue;
    }
    if (growing_rounds == maximum_growing_rounds)
    {
      return "the number of crossing triangles increases with every round of splitting";
    }
    std::string error = split(soup, pairs, clock, options, face_limit);
    if (!error.empty())
    {
      return error;
    }
  }
  if (round == options.round_limit)
  {
    return "triangles still cross after " + std::to_string(round) + " rounds of splitting";
  }
  report_value("rounded", rounded ? 1.0 : 0.0);
  report_value("rounds", round);
  data = MesherData();
  data.points.resize(static_cast<Index>(soup.points.size()), 3);
  for (Index v = 0; v < data.points.rows(); ++v)
  {
    data.points.row(v) << soup.points[v][0], soup.points[v][1], soup.points[v][2];
  }
  data.triangles.resize(static_cast<Index>(soup.faces.size()), 3);
  for (Index f = 0; f < data.triangles.rows(); ++f)
  {
    data.triangles.row(f) << soup.faces[f][0], soup.faces[f][1], soup.faces[f][2];
  }
  return {};
}

std::string delaunay(MesherData& data)
{
  using Base = CGAL::Triangulation_vertex_base_with_info_3<Index, Inexact>;
  using Triangulation = CGAL::Delaunay_triangulation_3<Inexact,
    CGAL::Triangulation_data_structure_3<Base, CGAL::Delaunay_triangulation_cell_base_3<Inexact>>>;
  std::vector<std::pair<Inexact::Point_3, Index>> points;
  points.reserve(static_cast<std::size_t>(data.points.rows()));
  for (Index v = 0; v < data.points.rows(); ++v)
  {
    points.emplace_back(
      Inexact::Point_3(data.points(v, 0), data.points(v, 1), data.points(v, 2)), v);
  }
  const Triangulation triangulation(points.begin(), points.end());
  if (triangulation.dimension() < 3)
  {
    return "all points are in one plane";
  }
  data.triangles.resize(0, 3);
  data.tets.resize(static_cast<Index>(triangulation.number_of_finite_cells()), 4);
  Index t = 0;
  for (auto cell = triangulation.finite_cells_begin(); cell != triangulation.finite_cells_end();
       ++cell, ++t)
  {
    for (int k = 0; k < 4; ++k)
    {
      data.tets(t, k) = cell->vertex(k)->info();
    }
  }
  return {};
}

} // namespace bindpose
