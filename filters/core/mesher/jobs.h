#ifndef bindpose_mesher_jobs_h
#define bindpose_mesher_jobs_h

#include "helper/mesher_format.h"

#include <string>

namespace bindpose
{

/// One line to the parent process: progress of the job in [0, 1].
void tell_progress(double fraction);
/// One line to the parent process: a number of the report.
void tell_report(const char* key, double number);

struct RefineOptions
{
  double time_limit = 25.0; ///< seconds
  double growth_limit = 10.0; ///< largest number of faces, as a multiple of the input's
  int round_limit = 30;
};

/// Splits triangles along their intersections until they meet only in shared vertices and edges.
/// Input vertices keep their ids and coordinates, new ones come behind; triangles of zero area and
/// duplicates are dropped. Where that does not end, input vertices are rounded to about 2e-13 of
/// the diagonal first. Gives up at once when that will take longer than the time limit, or make
/// more faces than the growth limit. Reports self_intersections (pairs in the input), rounded (0 or
/// 1), rounds, too_many (1: it gave up because of the number of crossings).
/// @return empty, or why it gave up.
std::string refine(MesherData& data, const RefineOptions& options);

/// Splits segments where they meet each other or a point (z is ignored), exactly, and triangulates
/// the convex hull of all points with the pieces as edges. Input points keep their ids, new ones
/// come behind; of equal points the first one is used. Triangles are counter-clockwise; none when
/// all points lie on one line. Reports rounds.
/// With a grid above 0 (a power of two, to which the points are rounded already) new points are
/// rounded to it, and edges go through the points that they pass at less than half of it: nothing
/// finer is left.
/// @return empty, or why it gave up.
std::string arrange(MesherData& data, double grid = 0.0);

struct FillOptions
{
  double min_angle = 30.0; ///< degrees
  double longest_edge = 0.0; ///< 0: no bound
  double floor = 0.0; ///< triangles with a shorter side are not refined for their angles
  double time_limit = 120.0; ///< seconds after which it refines no further
};

/// Quality triangles of the region that triangles of arrange() cover, by Delaunay refinement: their
/// outline and the segments, which must be edges of them, stay edges, split where need be. Points
/// keep their ids, new ones come behind. Where the angles cannot be had with a reasonable number of
/// points, it is tried again with 20.6 degrees. Reports min_angle (the bound that was used),
/// stopped (1: the bounds do not hold everywhere).
/// @return empty, or why it gave up.
std::string fill_plane(MesherData& data, const FillOptions& options);

/// The tets of the Delaunay triangulation of all points; facets are not constraints.
std::string delaunay(MesherData& data);

struct TetgenOptions
{
  std::string switches; ///< TetGen's own
  bool box = false; ///< surround the surface by 12 triangles, 10 % larger than its box
};

/// Tets by TetGen of the points and triangles (switch p). The first points of the result are the
/// input's, with their ids; tets are positive.
std::string tetgen(MesherData& data, const TetgenOptions& options);

struct RemeshJobOptions
{
  double winding_threshold = 0.5;
  double smallest_edge = 0.0; ///< length, > 0; raised when the tets would be more than tet_limit
  double largest_edge = 0.0; ///< length, >= smallest_edge
  double growth = 0.3; ///< by how much lengths may differ, relative to the distance
  double tet_limit = 5e5; ///< about
};

/// Tets of {winding number >= winding_threshold} of the surface given by data.triangles. Vertices
/// of the surface that are kept have their coordinates; ids are new. No tets when nothing is
/// enclosed. Reports counts.boundary_vertices (of the surface, where it bounds the inside),
/// seconds.* since the start. @return empty, or why it gave up.
std::string remesh(MesherData& data, RemeshJobOptions options);

struct WrapJobOptions
{
  double alpha =
    0.0; ///< length, > 0: a ball of this radius carves, so this is about the edges' size
  double offset = 0.0; ///< length, > 0: how far outside of the triangles the wrap's vertices lie
};

/// A closed, orientable surface without crossings that strictly contains all triangles, whatever
/// they are: CGAL's alpha wrap. Points and triangles become the wrap's, outwards; ids are new.
/// @return empty, or why it gave up.
std::string wrap(MesherData& data, const WrapJobOptions& options);

struct SkeletonJobOptions
{
  double triangles = 1e4; ///< about as many are contracted, of all components
  double smallest_part = 1e-3; ///< components with less of the largest one's volume are left out
  Index iteration_limit = 500; ///< of each component
};

/// The curve skeleton of what closed components enclose, as points and segments, by CGAL's mean
/// curvature flow: a curve through the middle of each, in pieces much shorter than bones, connected
/// as the component is, with a cycle for each of its tunnels; one point of a ball. Reports parts,
/// open, hollow and crumbs (components that were left out: not closed, turned inwards, too small),
/// triangles (that were contracted), iterations. @return empty, or why it gave up.
std::string skeleton(MesherData& data, const SkeletonJobOptions& options);

} // namespace bindpose

#endif
