// Conversion between polygons and triangles (see polygon_mesh.h).
#include "io/polygon_mesh.h"

namespace bindpose
{

Triangles fan_triangles(const PolygonMesh& mesh)
{
  const Index polygons = mesh.polygon_count();
  Triangles triangles(static_cast<Index>(mesh.corners.size()) - 2 * polygons, 3);
  Index t = 0;
  for (Index f = 0; f < polygons; ++f)
  {
    const Index first = mesh.offsets[f];
    for (Index k = first + 1; k + 1 < mesh.offsets[f + 1]; ++k)
    {
      triangles.row(t++) << mesh.corners[first], mesh.corners[k], mesh.corners[k + 1];
    }
  }
  return triangles;
}

PolygonMesh to_polygons(PointsView points, TrianglesView triangles)
{
  PolygonMesh mesh;
  mesh.points = points;
  mesh.corners.assign(triangles.data(), triangles.data() + triangles.size());
  for (Index t = 1; t <= triangles.rows(); ++t)
  {
    mesh.offsets.push_back(3 * t);
  }
  return mesh;
}

} // namespace bindpose
