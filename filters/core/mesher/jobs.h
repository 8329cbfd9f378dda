#ifndef bindpose_mesher_jobs_h
#define bindpose_mesher_jobs_h

// Jobs of the helper executable bindpose-mesher. Each job replaces the mesh in `data` by its
// result.

#include "helper/mesher_format.h"

#include <string>

namespace bindpose
{

/// Send the progress of the job, a fraction in [0, 1], to the parent process as one line of text.
void report_progress(double fraction);
/// Send a value of the job's report to the parent process as one line of text.
void report_value(const char* key, double number);

/// Options of refine().
struct RefineOptions
{
  double time_limit = 25.0; ///< seconds
  double growth_limit = 10.0; ///< maximum number of faces divided by the number of input faces
  int round_limit = 30;
};

/// Split triangles along their intersections until they intersect only in shared vertices and
/// edges. Input vertices keep their ids and coordinates; new vertices are appended. Triangles of
/// zero area and duplicates are removed. If the number of crossings increases, the job starts again
/// with input vertices rounded to about 2e-13 of the bounding-box diagonal. The job gives up if the
/// time limit or the growth limit is exceeded, or would be exceeded according to the number of
/// crossings. The job reports counts.self_intersections (number of crossing pairs in the input),
/// rounded (0 or 1), rounds, and too_many (1: the job gave up because of the number of crossings).
/// @return empty, or the reason for giving up.
std::string refine(MesherData& data, const RefineOptions& options);

/// Compute the arrangement of segments in the plane: split them exactly where they intersect each
/// other or a point (z is ignored). Triangulate the convex hull of all points with the parts of the
/// segments as edges. Input points keep their ids; new points are appended. If several points are
/// equal, the first one is used. Triangles are counter-clockwise; the list is empty if all points
/// are collinear. The job reports `rounds`. If `grid` is above 0, it is the spacing of a grid: a
/// power of two, of which all coordinates of the input must be multiples. New points are rounded to
/// the grid. An edge that passes a point at less than half of the grid spacing is replaced by two
/// edges through the point. The result has no details finer than the grid.
/// @return empty, or the reason for giving up.
std::string arrange(MesherData& data, double grid = 0.0);

/// Options of fill_plane().
struct FillOptions
{
  double min_angle = 30.0; ///< degrees
  double longest_edge = 0.0; ///< maximum edge length; 0: no bound
  /// Triangles with a side shorter than this are not refined for their angles.
  double smallest_side = 0.0;
  double time_limit = 120.0; ///< seconds after which refinement stops
};

/// Replace triangles from arrange() by well-shaped triangles of the same region, by Delaunay
/// refinement. The outline and the segments remain edges and are split where necessary; the
/// segments must be edges of the old triangles. Points keep their ids; new points are appended. If
/// min_angle cannot be reached with a reasonable number of points, a bound of 20.6 degrees is
/// tried. The job reports min_angle (the bound in use) and stopped (1: the bounds are not satisfied
/// everywhere).
/// @return empty, or the reason for giving up.
std::string fill_plane(MesherData& data, const FillOptions& options);

/// Compute the tets of the Delaunay triangulation of all points. Triangles are ignored.
std::string delaunay(MesherData& data);

/// Options of tetgen().
struct TetgenOptions
{
  std::string switches; ///< command-line switches of TetGen
  /// Surround the surface by the 12 triangles of a box that is 10 % larger than its bounding box.
  bool box = false;
};

/// Run TetGen (switch p) to compute tets that contain the points and triangles. The first points of
/// the result are the input points, with their ids. All tets are positively oriented.
std::string tetgen(MesherData& data, const TetgenOptions& options);

/// Options of remesh().
struct RemeshJobOptions
{
  double winding_threshold = 0.5;
  /// Smallest edge length (> 0). It is increased if there would be more tets than tet_limit.
  double smallest_edge = 0.0;
  double largest_edge = 0.0; ///< largest edge length, >= smallest_edge
  /// Maximum growth rate: the desired edge lengths at two points differ by at most `growth` times
  /// the distance of the points.
  double growth = 0.3;
  double tet_limit = 5e5; ///< approximate maximum number of tets
  /// Maximum fraction (0 to 1) of the boundary, by area, at which the region or the gap next to the
  /// region is thinner than smallest_edge. If the fraction is larger, the job fails before it
  /// refines.
  double maximum_thin_fraction = 1.0;
};

/// Compute tets of the region {winding number >= winding_threshold} of the surface data.triangles.
/// Surface vertices that are kept have the same coordinates but new ids. The list of tets is empty
/// if the surface encloses no volume. The job reports counts.boundary_vertices (the number of
/// surface vertices that bound the region), thin_fraction (see maximum_thin_fraction), and
/// seconds.* since the start of the job.
/// @return empty, or the reason for giving up.
std::string remesh(MesherData& data, RemeshJobOptions options);

/// Options of wrap().
struct WrapJobOptions
{
  double alpha = 0.0; ///< radius (> 0) of the carving ball, and approximate length of wrap edges
  /// Distance (> 0) between the wrap's vertices and the triangles. The wrap encloses the triangles.
  double offset = 0.0;
};

/// Compute a closed, orientable surface without crossings that strictly contains all triangles, for
/// any input, by CGAL's alpha wrap. The points and triangles in `data` are replaced by those of the
/// wrap, which are oriented outwards and have new ids.
/// @return empty, or the reason for giving up.
std::string wrap(MesherData& data, const WrapJobOptions& options);

/// Options of skeleton().
struct SkeletonJobOptions
{
  /// Approximate total number of triangles, over all components, to which the surface is remeshed
  /// before the flow.
  double triangles = 1e4;
  /// Components are omitted if their volume is below this fraction of the largest component's
  /// volume.
  double smallest_part = 1e-3;
  Index iteration_limit = 500; ///< maximum number of flow steps per component
};

/// Compute the curve skeleton of the inside of closed components, as points and segments, by CGAL's
/// mean curvature flow. The skeleton is a curve through the middle of each component, divided into
/// segments much shorter than bones. It has the topology of the component, with a cycle for each
/// tunnel. The skeleton of a ball is one point. The job reports parts (number of components),
/// triangles (number of triangles that were contracted), iterations, and the numbers of omitted
/// components: open (not closed), hollow (oriented inwards) and crumbs (too small).
/// @return empty, or the reason for giving up.
std::string skeleton(MesherData& data, const SkeletonJobOptions& options);

} // namespace bindpose

#endif
