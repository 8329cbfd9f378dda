#ifndef bindpose_transfer_solved_mesh_h
#define bindpose_transfer_solved_mesh_h

#include "domain/scaled_mesh.h"
#include "transfer/surface_match.h"

#include <vector>

namespace bindpose
{

/// The mesh on which inpaint_weights() solves the rows. Points of a surface at the same position
/// are one vertex.
struct SolvedMesh
{
  Domain domain;
  /// #points; -1: the point of a surface is in no triangle with an area
  std::vector<Index> vertex_of_point;
  std::vector<Index> point_of_vertex; ///< one of the points at each vertex; a matched one, if any
  /// #V: 1 if one of the points at the vertex matches, and the vertex is in no small group
  std::vector<char> matched;
  Components parts;
  ScaledMesh
    scaled; ///< see scale_mesh(); the vertices of parts are in its box; empty without parts
  Index small_group_count = 0;
};

/// Make the mesh of a target. Triangles of a surface whose corners are collinear are left out.
/// Matched vertices that are connected by edges are a group; its size is the area (or volume)
/// around its vertices. A group does not match if its size is less than `smallest_group` times the
/// size of the largest group in its part. Return invalid_input if check_domain() refuses a target
/// of tets.
Status make_solved_mesh(
  const Domain& target, const SurfaceMatch& match, double smallest_group, SolvedMesh& mesh);

} // namespace bindpose

#endif
