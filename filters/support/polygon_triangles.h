#ifndef polygon_triangles_h
#define polygon_triangles_h

#include "geometry/mesh.h"

#include <array>
#include <vector>

namespace bindpose
{

/// Triangulate a polygon: triangles and quads become fans, larger polygons are triangulated by ear
/// cutting. If ear cutting fails for a degenerate polygon, the polygon becomes a fan. The fan has
/// the boundary edges of the polygon, so closed surfaces stay closed.
/// @param polygon at least 3 corners
/// @param triangles is set to indices into `polygon`
void triangulate_polygon(
  const std::vector<Vec3>& polygon, std::vector<std::array<Index, 3>>& triangles);

} // namespace bindpose

#endif
