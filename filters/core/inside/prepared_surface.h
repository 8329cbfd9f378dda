#ifndef bindpose_inside_prepared_surface_h
#define bindpose_inside_prepared_surface_h

#include "inside/enclosed_region.h"
#include "surface/surface_defects.h"

#include <vector>

namespace bindpose
{

/// A surface made ready for tetrahedralize(): welded and oriented, with its winding number. The
/// same object can be used for several calls, for example tets and then lattices of two
/// resolutions.
struct PreparedSurface
{
  RepairedSurface surface;
  EnclosedRegion inside;
  std::vector<DefectOccurrence> defects;
  double winding_threshold = 0.5;
  /// Contains the counts of the diagnosis of surface defects (counts.*), and counts.back_triangles,
  /// counts.turned_triangles and counts.turned_components.
  Report report;
  /// One sentence per type of triangles that were removed or flipped.
  std::vector<std::string> warnings;
};

/// Repair the surface (repair_surface), remove back-side triangles (back_sides) and build the
/// winding number (EnclosedRegion). Return invalid_input if an id is out of range, a coordinate is
/// not finite, or no triangle has an area. Cost: about 5 us per triangle.
Status prepare_surface(ExecutionContext& context, PointsView points, TrianglesView triangles,
  double winding_threshold, PreparedSurface& prepared);

} // namespace bindpose

#endif
