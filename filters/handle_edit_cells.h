#ifndef handle_edit_cells_h
#define handle_edit_cells_h

#include "BindposeFiltersModule.h" // for export macro
#include "conversion.h"
#include "weights/handle_edits.h"

#include <array>
#include <functional>
#include <optional>

namespace bindpose
{

/// to_handles(), but a dataset without cells is no handles, and no error.
BINDPOSEFILTERS_EXPORT Status to_editable(
  vtkPolyData* data, Handles& handles, std::vector<Index>& cells);

/// One of the functions of handle_edits.h, with everything but the first and last argument bound.
using HandleListEdit = std::function<Status(const Handles& before, EditedHandles& after)>;

/// Edits a handle dataset in place: its points and cells and the arrays of its handles are made
/// anew. All other cell arrays (Mode, Transform, Stretch, Twist, Color, Locked and any others)
/// follow their handles; a new handle is at rest with mode full, and has Color, Locked and unknown
/// arrays of the one it is a copy of, or no colour and zeros. Pseudo-edges stay while both their
/// points do. Nothing changes when the edit is refused.
///
/// Cells are numbered points first, then bones, so a new point moves the numbers of bones.
/// @param cell_of  of each cell before, its number now, or -1
/// @param added    cells that are new
BINDPOSEFILTERS_EXPORT Status edit_handles(vtkPolyData* data, const HandleListEdit& edit,
  std::vector<Index>* cell_of = nullptr, std::vector<Index>* added = nullptr);

/// The cell array `Color`: red, green and blue from 0 to 1 where a handle has a colour of its own,
/// three NaN where it is drawn in the colour of its mode. Made when absent; one of unsigned chars
/// becomes one of doubles.
BINDPOSEFILTERS_EXPORT void set_handle_colour(
  vtkPolyData* data, Index cell, const std::optional<std::array<double, 3>>& colour);

/// The cell array `Locked`: 1 for a handle that no hand moves. Made when absent.
BINDPOSEFILTERS_EXPORT void set_handle_locked(vtkPolyData* data, Index cell, bool locked);

/// The cell array `Layer`: what is larger is in front (vtkDepthOrder). Made when absent, of zeros.
BINDPOSEFILTERS_EXPORT void set_handle_layer(vtkPolyData* data, Index cell, double layer);

} // namespace bindpose

#endif
