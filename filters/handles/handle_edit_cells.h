#ifndef handle_edit_cells_h
#define handle_edit_cells_h

#include "BindposeFiltersModule.h" // for export macro
#include "conversion.h"
#include "handles/handle_edits.h"

#include <array>
#include <functional>
#include <optional>

namespace bindpose
{

/// Convert like to_handles(), except that a dataset without cells gives no handles and is not an
/// error.
BINDPOSEFILTERS_EXPORT Status to_editable(
  vtkPolyData* data, Handles& handles, std::vector<Index>& cells);

/// An edit of a list of handles: a function of handle_edits.h whose other arguments are bound
/// (std::bind or a lambda).
using HandleListEdit = std::function<Status(const Handles& before, EditedHandles& after)>;

/// Edit a handle dataset in place. Its points, cells and handle arrays are replaced by new ones.
/// All other cell arrays (Mode, Transform, Stretch, Twist, Color, Locked and any others) keep their
/// values for each handle. A new handle is at rest with mode full. A copied handle gets Color,
/// Locked and all arrays unknown to Bindpose from the original handle. Any other new handle has no
/// color and zeros in the other arrays. A pseudo-edge is kept if both its points are kept. A
/// rejected edit changes nothing.
///
/// In the dataset the cells of points are before the cells of bones, so adding a point changes the
/// cell ids of the bones.
/// @param new_cell  for each cell before the edit, its id after the edit, or -1
/// @param added  ids of the new cells
BINDPOSEFILTERS_EXPORT Status edit_handles(vtkPolyData* data, const HandleListEdit& edit,
  std::vector<Index>* new_cell = nullptr, std::vector<Index>* added = nullptr);

/// Set the cell array `Color` of one handle: red, green and blue from 0 to 1. Without `color` the
/// cell gets three NaN: the handle is then drawn in the color of its mode. The array is created if
/// absent. An array of unsigned chars is converted to doubles.
BINDPOSEFILTERS_EXPORT void set_handle_color(
  vtkPolyData* data, Index cell, const std::optional<std::array<double, 3>>& color);

/// Set the cell array `Locked`: 1 for a handle that users cannot move interactively. The array is
/// created if absent.
BINDPOSEFILTERS_EXPORT void set_handle_locked(vtkPolyData* data, Index cell, bool locked);

/// Set the cell array `Layer` of one handle: handles with a larger layer are in front
/// (vtkDepthOrder). The array is created with zeros if absent.
BINDPOSEFILTERS_EXPORT void set_handle_layer(vtkPolyData* data, Index cell, double layer);

} // namespace bindpose

#endif
