// Curve skeletons by mean curvature flow (Tagliasacchi, Alhashim, Olson, Zhang, Mean Curvature
// Skeletons, Computer Graphics Forum 31(5), 2012), as implemented in CGAL. Closed components are
// processed one at a time.
//
// 1. The triangles become closed manifold meshes: sheets are separated at edges where more than two
//    triangles meet. Components of negative volume ("hollow") are omitted, because they have no
//    inside.
// 2. Each component is remeshed to some thousands of triangles of even size. In every step the flow
//    solves a linear system whose unknowns are the vertices, so parts with large triangles
//    would have too few vertices for the contraction.
// 3. The flow contracts the surface and pulls it to its medial axis. Short edges are collapsed,
//    flat triangles are split, and vertices that cannot shrink further are fixed. The flow ends
//    when the area is almost constant.
// 4. The edges of the resulting thin surface are collapsed until no triangle remains.
#include "mesher/jobs.h"
#include "mesher/triangle_soup.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mean_curvature_flow_skeletonization.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/boost/graph/Face_filtered_graph.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace bindpose
{

namespace
{
namespace pmp = CGAL::Polygon_mesh_processing;
namespace simplification = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Flow = CGAL::Mean_curvature_flow_skeletonization<Mesh>;

Mesh to_manifold(const MesherData& data)
{
  TriangleSoup<Kernel::Point_3> soup(data);
  // orient_polygon_soup() separates sheets where they are not manifold. Each sheet is then stitched
  // along its borders.
  pmp::orient_polygon_soup(soup.points, soup.triangles);
  Mesh mesh;
  pmp::polygon_soup_to_polygon_mesh(soup.points, soup.triangles, mesh);
  pmp::stitch_borders(mesh);
  return mesh;
}

/// A closed component of the surface.
struct Part
{
  Mesh mesh;
  double volume = 0.0;
};

/// Return the closed components, the largest first.
std::vector<Part> closed_parts(const Mesh& mesh, Index& open, Index& nonpositive_parts)
{
  std::vector<std::size_t> component(mesh.number_of_faces());
  auto map = boost::make_iterator_property_map(
    component.begin(), get(boost::face_index, mesh), component.front());
  const std::size_t count = pmp::connected_components(mesh, map);
  std::vector<Part> parts;
  for (std::size_t c = 0; c < count; ++c)
  {
    Part part;
    CGAL::copy_face_graph(CGAL::Face_filtered_graph<Mesh>(mesh, c, map), part.mesh);
    if (!CGAL::is_closed(part.mesh))
    {
      ++open;
      continue;
    }
    part.volume = CGAL::to_double(pmp::volume(part.mesh));
    if (part.volume > 0.0)
    {
      parts.push_back(std::move(part));
    }
    else
    {
      ++nonpositive_parts;
    }
  }
  std::stable_sort(
    parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.volume > b.volume; });
  return parts;
}

/// Remesh to about `triangles` triangles of even size.
void remesh_uniformly(Mesh& mesh, double triangles)
{
  constexpr double edges_per_triangle = 1.5;
  if (static_cast<double>(mesh.number_of_faces()) > triangles)
  {
    const simplification::Count_stop_predicate<Mesh> stop(
      static_cast<std::size_t>(edges_per_triangle * triangles));
    simplification::edge_collapse(mesh, stop,
      CGAL::parameters::get_cost(simplification::LindstromTurk_cost<Mesh>())
        .get_placement(simplification::LindstromTurk_placement<Mesh>()));
    mesh.collect_garbage();
  }
  // Edge length of an equilateral triangle whose area is the area of the mesh divided by
  // `triangles`.
  const double edge =
    std::sqrt(4.0 / std::sqrt(3.0) * CGAL::to_double(pmp::area(mesh)) / triangles);
  pmp::isotropic_remeshing(mesh.faces(), edge, mesh, CGAL::parameters::number_of_iterations(2));
  mesh.collect_garbage();
}

/// Contract a closed mesh to its skeleton, and append the skeleton to `points` and `segments`.
void contract(const Mesh& mesh, const SkeletonJobOptions& options, double begin, double end,
  Index& iterations, std::vector<Vec3>& points, std::vector<std::array<Index, 2>>& segments)
{
  Flow flow(mesh);
  const double initial_area = CGAL::to_double(pmp::area(mesh));
  double last = initial_area;
  double contraction = 0.0;
  for (Index i = 0; i < options.iteration_limit; ++i)
  {
    flow.contract_geometry();
    flow.collapse_edges();
    flow.split_faces();
    flow.detect_degeneracies();
    ++iterations;
    const double area = CGAL::to_double(pmp::area(flow.meso_skeleton()));
    const double change = std::abs(last - area) / initial_area;
    last = area;
    if (!(change >= flow.area_variation_factor()))
    {
      break;
    }
    // The change in area decreases approximately as a power of the step number, so the logarithm of
    // the change is used as progress.
    contraction = std::max(
      contraction, std::log(std::min(change, 1.0)) / std::log(flow.area_variation_factor()));
    report_progress(begin + (end - begin) * std::min(contraction, 1.0));
  }
  Flow::Skeleton skeleton;
  flow.convert_to_skeleton(skeleton);
  const Index first = static_cast<Index>(points.size());
  for (const auto v : CGAL::make_range(boost::vertices(skeleton)))
  {
    const Kernel::Point_3& p = skeleton[v].point;
    points.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto e : CGAL::make_range(boost::edges(skeleton)))
  {
    segments.push_back({ first + static_cast<Index>(boost::source(e, skeleton)),
      first + static_cast<Index>(boost::target(e, skeleton)) });
  }
}
} // namespace

std::string skeleton(MesherData& data, const SkeletonJobOptions& options)
{
  const Mesh mesh = to_manifold(data);
  if (mesh.number_of_faces() == 0)
  {
    return "the surface has no triangles";
  }
  Index open = 0;
  Index nonpositive_parts = 0;
  std::vector<Part> parts = closed_parts(mesh, open, nonpositive_parts);
  if (parts.empty())
  {
    return "the surface has no closed component that encloses a volume";
  }
  Index dropped_parts = 0;
  while (parts.back().volume < options.smallest_part * parts.front().volume)
  {
    parts.pop_back();
    ++dropped_parts;
  }
  double area = 0.0;
  for (const Part& part : parts)
  {
    area += CGAL::to_double(pmp::area(part.mesh));
  }
  std::vector<Vec3> points;
  std::vector<std::array<Index, 2>> segments;
  Index iterations = 0;
  Index triangles = 0;
  double done = 0.0;
  for (Part& part : parts)
  {
    const double fraction = CGAL::to_double(pmp::area(part.mesh)) / area;
    // A small component needs a minimum number of triangles to represent its shape.
    constexpr double minimum = 1000.0;
    remesh_uniformly(part.mesh, std::max(minimum, fraction * options.triangles));
    triangles += static_cast<Index>(part.mesh.number_of_faces());
    constexpr double remeshed_fraction = 0.2;
    report_progress(done + remeshed_fraction * fraction);
    contract(part.mesh, options, done + remeshed_fraction * fraction, done + fraction, iterations,
      points, segments);
    done += fraction;
  }
  data = MesherData();
  data.points.resize(static_cast<Index>(points.size()), 3);
  data.segments.resize(static_cast<Index>(segments.size()), 2);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    data.points.row(static_cast<Index>(i)) = points[i].transpose();
  }
  for (std::size_t i = 0; i < segments.size(); ++i)
  {
    data.segments.row(static_cast<Index>(i)) << segments[i][0], segments[i][1];
  }
  report_value("parts", static_cast<double>(parts.size()));
  report_value("open", static_cast<double>(open));
  report_value("hollow", static_cast<double>(nonpositive_parts));
  report_value("crumbs", static_cast<double>(dropped_parts));
  report_value("triangles", static_cast<double>(triangles));
  report_value("iterations", static_cast<double>(iterations));
  return {};
}

} // namespace bindpose
