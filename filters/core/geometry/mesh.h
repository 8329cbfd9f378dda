#ifndef bindpose_geometry_mesh_h
#define bindpose_geometry_mesh_h

// Basic operations of triangle and tet meshes.

#include "base/mesh_types.h"
#include "base/status.h"

#include <array>
#include <vector>

namespace bindpose
{

/// An axis-aligned box; empty (lower > upper) until a point is added.
struct Box
{
  Vec3 lower = Vec3::Constant(1e300);
  Vec3 upper = Vec3::Constant(-1e300);

  void add(const Vec3& p);
  bool empty() const { return (this->lower.array() > this->upper.array()).any(); }
  Vec3 size() const { return this->empty() ? Vec3::Zero() : Vec3(this->upper - this->lower); }
  Vec3 center() const { return 0.5 * (this->lower + this->upper); }
  /// Return the length of the diagonal, which is the unit of relative lengths in Bindpose; 0 for an
  /// empty box.
  double diagonal() const { return this->size().norm(); }
};

Box bounding_box(PointsView points);
/// Return the bounding box of the vertices that triangles use. Unused points do not affect it.
Box bounding_box(PointsView points, TrianglesView triangles);

/// Check that all used coordinates are finite and all vertex ids are in range; otherwise return
/// invalid_input with the first invalid coordinate or id. An empty mesh is valid; callers that need
/// triangles must check for them.
Status check_mesh(PointsView points, TrianglesView triangles);
Status check_mesh(PointsView points, TetsView tets);

/// Check that single precision is accurate enough for a shape. Return invalid_input if a coordinate
/// is not finite or above 3.4e38, or if neighboring floats near the shape differ by more than a
/// hundredth of the bounding-box diagonal. A shape whose points all coincide is valid.
Status check_float_range(PointsView points);

/// Return the signed volume by the divergence theorem, exact for closed, outward oriented surfaces.
double signed_volume(PointsView points, TrianglesView triangles);
double surface_area(PointsView points, TrianglesView triangles);

double tet_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
/// Return #T signed volumes.
Eigen::VectorXd tet_volumes(PointsView points, TetsView tets);

/// Return the facets that belong to exactly one tet, oriented outwards.
Triangles boundary_triangles(TetsView tets);

/// An edge of a triangle mesh and the number of triangles that use it.
struct Edge
{
  Index a = 0, b = 0; ///< vertex ids, a < b
  int triangle_count = 0; ///< number of triangles at the edge
  /// Number of triangles that use the edge from a to b, minus the number that use it from b to a.
  int net_direction = 0;
};

/// Return all edges, sorted by (a, b). Edges from a vertex to itself (degenerate triangles) are
/// omitted.
std::vector<Edge> mesh_edges(TrianglesView triangles);

/// Number of edges of a surface, in total and for several kinds of edges.
struct EdgeCounts
{
  Index edges = 0;
  Index boundary = 0; ///< number of edges that belong to one triangle only
  Index nonmanifold = 0; ///< number of edges that three or more triangles share
  Index misoriented = 0; ///< number of edges that two triangles use in the same direction
  /// Whether the surface is closed in the sense of the winding number: every edge is used equally
  /// often in both directions.
  bool closed = true;
};
EdgeCounts count_edges(TrianglesView triangles);

/// Connected components of a mesh. Triangles are connected if they share a vertex.
struct Components
{
  Index count = 0;
  std::vector<Index> component_of_vertex; ///< #V component ids from 0, -1 for an unused vertex
};
Components connected_components(Index vertex_count, TrianglesView triangles);
Components connected_components(Index vertex_count, TetsView tets);

} // namespace bindpose

#endif
