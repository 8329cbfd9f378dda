#ifndef bindpose_io_polygon_mesh_h
#define bindpose_io_polygon_mesh_h

#include "base/mesh.h"

namespace bindpose
{

/// A surface as files hold it: polygon f has the corners [offsets[f], offsets[f + 1]).
struct PolygonMesh
{
  Points points;
  std::vector<Index> offsets{ 0 };
  std::vector<Index> corners; ///< vertex ids
  /// Polylines: line l has the vertices line_corners[line_offsets[l], line_offsets[l + 1]). Only of
  /// OBJ files without a face, which are curves.
  std::vector<Index> line_offsets{ 0 };
  std::vector<Index> line_corners;
  /// Entries of the file with fewer than three corners, which are left out.
  Index skipped = 0;

  Index polygon_count() const { return static_cast<Index>(this->offsets.size()) - 1; }
  Index line_count() const { return static_cast<Index>(this->line_offsets.size()) - 1; }
  void end_polygon() { this->offsets.push_back(static_cast<Index>(this->corners.size())); }
};

/// Fans each polygon from its first corner: right for convex ones, and always right for winding
/// numbers' sums.
Triangles fan_triangles(const PolygonMesh& mesh);

PolygonMesh to_polygons(PointsView points, TrianglesView triangles);

} // namespace bindpose

#endif
