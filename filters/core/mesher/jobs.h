#ifndef bindpose_mesher_jobs_h
#define bindpose_mesher_jobs_h

#include "helper/mesher_format.h"

#include <string>

namespace bindpose
{

/// Send the progress of the job in [0, 1] to the parent process, as one line.
void tell_progress(double fraction);
/// Send a number of the report to the parent process, as one line.
void tell_report(const char* key, double number);

struct RefineOptions
{
  double time_limit = 25.0; ///< seconds
  double growth_limit = 10.0; ///< largest number of faces, as a multiple of the input's
  int round_limit = 30;
};

/// Split triangles along their intersections until they meet only in shared vertices and edges.
/// Input vertices keep their ids and coordinates; new ones are appended. Triangles of zero area and
/// duplicates are dropped. If splitting does not end, it starts again with input vertices rounded
/// to about 2e-13 of the diagonal. The job gives up as soon as it expects to exceed the time limit
/// or the growth limit.
/// It reports counts.self_intersections (pairs in the input), rounded (0 or 1), rounds, and
/// too_many (1: it gave up because of the number of crossings).
/// @return empty, or the reason for giving up.
std::string refine(MesherData& data, const RefineOptions& options);

/// Split segments exactly where they meet each other or a point (z is ignored). Triangulate the
/// convex hull of all points with the pieces as edges. Input points keep their ids; new ones are
/// appended. Of equal points the first one is used. Triangles are counter-clockwise; there are none
/// if all points are collinear. The job reports rounds.
/// If `grid` is above 0, it must be a power of two to which the points are already rounded. New
/// points are rounded to it, and edges are bent through the points that they pass at less than half
/// of it. The result has no finer details.
/// @return empty, or the reason for giving up.
std::string arrange(MesherData& data, double grid = 0.0);

struct FillOptions
{
  double min_angle = 30.0; ///< degrees
  double longest_edge = 0.0; ///< 0: no bound
  double floor = 0.0; ///< triangles with a shorter side are not refined for their angles
  double time_limit = 120.0; ///< seconds after which refinement stops
};

/// Mesh the region that the triangles of arrange() cover with quality triangles, by Delaunay
/// refinement. The outline and the segments remain edges, split where necessary; the segments must
/// be edges of the triangles. Points keep their ids; new ones are appended. If the angles cannot be
/// reached with a reasonable number of points, 20.6 degrees are tried. The job reports min_angle
/// (the bound in use) and stopped (1: the bounds do not hold everywhere).
/// @return empty, or the reason for giving up.
std::string fill_plane(MesherData& data, const FillOptions& options);

/// Compute the tets of the Delaunay triangulation of all points; facets are not constraints.
std::string delaunay(MesherData& data);

struct TetgenOptions
{
  std::string switches; ///< command-line switches of TetGen
  bool box = false; ///< surround the surface by 12 triangles, 10 % larger than its box
};

/// Compute tets of the points and triangles by TetGen (switch p). The first points of the result
/// are those of the input, with their ids; tets are positive.
std::string tetgen(MesherData& data, const TetgenOptions& options);

struct RemeshJobOptions
{
  double winding_threshold = 0.5;
  double smallest_edge = 0.0; ///< length, > 0; raised if there would be more tets than tet_limit
  double largest_edge = 0.0; ///< length, >= smallest_edge
  double growth = 0.3; ///< largest difference of lengths, relative to the distance
  double tet_limit = 5e5; ///< approximate
};

/// Compute tets of the region {winding number >= winding_threshold} of the surface data.triangles.
/// Vertices of the surface that are kept have their coordinates; ids are new. There are no tets if
/// nothing is enclosed. The job reports counts.boundary_vertices (of the surface, where it bounds
/// the inside) and seconds.* since the start.
/// @return empty, or the reason for giving up.
std::string remesh(MesherData& data, RemeshJobOptions options);

struct WrapJobOptions
{
  double alpha = 0.0; ///< length, > 0: radius of the carving ball, about the size of the edges
  double offset = 0.0; ///< length, > 0: distance of the wrap's vertices from the triangles,
                       ///< outwards
};

/// Compute a closed, orientable surface without crossings that strictly contains all triangles, for
/// any input, by CGAL's alpha wrap. Points and triangles become those of the wrap, oriented
/// outwards; ids are new.
/// @return empty, or the reason for giving up.
std::string wrap(MesherData& data, const WrapJobOptions& options);

struct SkeletonJobOptions
{
  double triangles = 1e4; ///< approximate number of triangles that are contracted, over all
                          ///< components
  double smallest_part = 1e-3; ///< components below this fraction of the largest one's volume are
                               ///< omitted
  Index iteration_limit = 500; ///< per component
};

/// Compute the curve skeleton of the inside of closed components, as points and segments, by CGAL's
/// mean curvature flow. It is a curve through the middle of each component, in pieces much shorter
/// than bones. It is connected like the component, with a cycle for each tunnel. The skeleton of a
/// ball is one point.
/// The job reports parts, the numbers of omitted components open (not closed), hollow (turned
/// inwards) and crumbs (too small), triangles (the number that was contracted), and iterations.
/// @return empty, or the reason for giving up.
std::string skeleton(MesherData& data, const SkeletonJobOptions& options);

} // namespace bindpose

#endif
