#ifndef pseudo_edge_cells_h
#define pseudo_edge_cells_h

#include "BindposeFiltersModule.h" // for export macro
#include "conversion.h"
#include "pose/pseudo_edges.h"

namespace bindpose
{

/// Return the pseudo-edges of a handle dataset without duplicates. Each end of a pseudo-edge must
/// be the point of a point handle, or have the same position as such a point. Otherwise return
/// invalid_input, with the index of the cell in the message.
/// @param cells  the cells of the handles, from to_handles()
BINDPOSEFILTERS_EXPORT Status to_pseudo_edges(
  vtkPolyData* data, const Handles& handles, const std::vector<Index>& cells, PseudoEdges& edges);

/// Add pseudo-edges to a handle dataset as its last cells. The dataset must not have polygons,
/// because the polygons of a polydata come after its lines.
void add_pseudo_edges(vtkPolyData* data, const std::vector<Index>& cells, const PseudoEdges& edges);

} // namespace bindpose

#endif
