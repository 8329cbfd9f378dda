#ifndef bindpose_inside_tet_filling_h
#define bindpose_inside_tet_filling_h

#include "base/execution.h"
#include "base/mesh.h"
#include "inside/sizing_field.h"

#include <vector>

namespace bindpose
{

struct FillOptions
{
  /// Vertices are added until there are about this many tets, largest tets (relative to the sizing
  /// field) first. >= 0.
  Index most_tets = 1000000;
  /// Below this many tets, the sizing field is replaced by a smaller constant that gives about as
  /// many, and edges of the boundary longer than two of these lengths are split.
  Index fewest_tets = 0;
  /// Edges of the boundary longer than this are split first (a length). 0: none is.
  double longest_boundary_edge = 0.0;
  /// #H x 3 points inside that must become vertices (handles). They come first of the new ones.
  Points required;
};

/// The vertices that were added.
struct Filling
{
  Index inner_vertices = 0; ///< without the required ones
  Index boundary_vertices = 0; ///< on edges of the boundary
  std::vector<Index> required; ///< #H: the vertex, -1 where none could be added
};

/// Adds vertices inside of tets until no tet is larger than the sizing field asks for: at
/// circumcenters where these are visible from the tet and not too near to other vertices and to
/// the boundary, with the Delaunay cavity around them, shrunk until it is visible from the vertex
/// (Shewchuk, Constrained Delaunay Tetrahedralizations and Provably Good Boundary Recovery, 2002).
/// No new vertex is nearer to another one than 0.6 of the sizing field's length, so that the number
/// of tets is bounded whatever the shape of the boundary's triangles. Then the new inner vertices
/// are smoothed.
/// The tets must be positive and meet in common facets. Input vertices stay where they are, new
/// ones come behind; the boundary stays but for split edges. Cost: about 30 us per new vertex.
/// @return false when cancelled; the mesh is valid all the same.
bool fill_tets(TetMesh& mesh, const SizingField& sizes, const FillOptions& options, Filling& done,
  ExecutionContext& context);

} // namespace bindpose

#endif
