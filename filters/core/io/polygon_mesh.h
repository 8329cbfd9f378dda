#ifndef bindpose_io_polygon_mesh_h
#define bindpose_io_polygon_mesh_h

#include "base/mesh.h"

namespace bindpose
{

/// A surface as it is stored in files: polygon f has the corners [offsets[f], offsets[f + 1]).
struct PolygonMesh
{
  Points points;
  std::vector<Index> offsets{ 0 };
  std::vector<Index> corners; ///< vertex ids
  /// Polylines: line l has the vertices line_corners[line_offsets[l], line_offsets[l + 1]). They
  /// are read only from OBJ files without a face, which contain curves.
  std::vector<Index> line_offsets{ 0 };
  std::vector<Index> line_corners;
  /// Number of faces in the file with fewer than three corners, which are skipped.
  Index skipped = 0;

  Index polygon_count() const { return static_cast<Index>(this->offsets.size()) - 1; }
  Index line_count() const { return static_cast<Index>(this->line_offsets.size()) - 1; }
  void end_polygon() { this->offsets.push_back(static_cast<Index>(this->corners.size())); }
};

/// Triangulate each polygon as a fan from its first corner. This is correct for convex polygons.
/// For winding numbers, which are sums over the triangles, it is always correct.
Triangles fan_triangles(const PolygonMesh& mesh);

PolygonMesh to_polygons(PointsView points, TrianglesView triangles);

} // namespace bindpose

#endif
