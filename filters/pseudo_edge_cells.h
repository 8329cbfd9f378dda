#ifndef pseudo_edge_cells_h
#define pseudo_edge_cells_h

#include "BindposeFiltersModule.h" // for export macro
#include "conversion.h"
#include "pose/pseudo_edges.h"

namespace bindpose
{

/// The HandleKind of a pseudo-edge's cell, a line between two point handles. It is no handle: only
/// poses know it.
constexpr int pseudo_edge_kind = -2;

/// The pseudo-edges of a handle dataset, each once. Their points are those of point handles, or at
/// the same places; invalid_input, naming the cell, when they are not.
/// @param cells of the handles, from to_handles().
BINDPOSEFILTERS_EXPORT Status to_pseudo_edges(
  vtkPolyData* data, const Handles& handles, const std::vector<Index>& cells, PseudoEdges& edges);

/// Adds pseudo-edges to a handle dataset without polygons, behind its other cells.
void add_pseudo_edges(vtkPolyData* data, const std::vector<Index>& cells, const PseudoEdges& edges);

} // namespace bindpose

#endif
