#ifndef bindpose_io_polygon_mesh_h
#define bindpose_io_polygon_mesh_h

#include "geometry/mesh.h"

namespace bindpose
{

/// A polygon mesh as it is stored in files. The corners of polygon f are corners[offsets[f]] …
/// corners[offsets[f + 1] - 1].
struct PolygonMesh
{
  Points points;
  std::vector<Index> offsets{ 0 };
  std::vector<Index> corners; ///< vertex ids
  /// Polylines, stored like polygons: the vertices of line l begin at
  /// line_corners[line_offsets[l]]. Nonempty only for OBJ files that have lines but no faces.
  std::vector<Index> line_offsets{ 0 };
  std::vector<Index> line_corners;
  /// Number of faces in the file that are skipped because they have too few vertices.
  Index skipped = 0;

  Index polygon_count() const { return static_cast<Index>(this->offsets.size()) - 1; }
  Index line_count() const { return static_cast<Index>(this->line_offsets.size()) - 1; }
  void end_polygon() { this->offsets.push_back(static_cast<Index>(this->corners.size())); }
};

/// Triangulate each polygon as a fan from its first corner. This is correct for convex polygons.
/// Winding numbers are correct for any planar polygon, because they are sums over the triangles.
Triangles fan_triangles(const PolygonMesh& mesh);

/// Convert triangles to polygons.
PolygonMesh to_polygons(PointsView points, TrianglesView triangles);

} // namespace bindpose

#endif
