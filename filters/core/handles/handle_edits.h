#ifndef bindpose_handles_handle_edits_h
#define bindpose_handles_handle_edits_h

#include "handles/handles.h"
#include "surface/surface_probe.h"

#include <array>
#include <string>
#include <vector>

namespace bindpose
{

/// Handles after an edit, and the index of each handle before the edit. Callers use these indices
/// to reorder other data that they store per handle.
struct EditedHandles
{
  Handles handles;
  std::vector<Index> source; ///< index before the edit; -1: new handle
  /// For a copy: the index of the copied handle before the edit. For other handles: equal to
  /// `source`. -1: the handle is new and not a copy.
  std::vector<Index> copied_from;
};

// Every edit below takes handles that pass check_handles(), or an empty list. The handles after the
// edit pass check_handles(), too, or the list is empty. On invalid_input, the message is one
// sentence that names the handle, and `after` equals the handles before the edit. Names of handles
// that are not edited do not change. `before` and `after.handles` must not be the same object.

/// Return the requested name. If another handle has this name, append a suffix .001, .002, …. If
/// the requested name is empty, return a letter for the kind (p, b, c or r) with the first free
/// number, for example p1.
std::string unique_name(const Handles& handles, const std::string& requested_name, HandleKind kind);

/// Append a handle. The new name is unique_name(handle.name). The cage elements of the handle may
/// refer to the new handle by its future index, which is the size of the list before the edit.
Status add_handle(const Handles& before, Handle handle, EditedHandles& after);

/// Remove handles. Children of a removed handle are attached to their nearest remaining ancestor.
/// Edges and faces of a cage are removed if one of their corners is removed.
Status remove_handles(
  const Handles& before, const std::vector<Index>& handle_indices, EditedHandles& after);

/// Rename a handle. Return invalid_input if the name is empty or belongs to another handle.
Status rename_handle(
  const Handles& before, Index handle_index, const std::string& name, EditedHandles& after);

/// Set the parent; -1: none. Return invalid_input if the parent is the handle itself or one of its
/// descendants.
Status set_parent(const Handles& before, Index handle_index, Index parent, EditedHandles& after);

/// Add the edge of a cage between two cage vertices, or remove it if it exists.
Status toggle_cage_edge(const Handles& before, Index a, Index b, EditedHandles& after);

/// One end of a handle. Only bones have a tail.
struct HandleEnd
{
  Index handle = -1;
  bool tail = false;
};
/// Return all bone ends at the position of `end`, with `end` first. The tolerance is 1e-9 times the
/// extent of the handles. If `end` is not an end of a bone, return only `end`.
std::vector<HandleEnd> ends_at_joint(const Handles& handles, const HandleEnd& end);

/// Move each end to its new position. All bone ends of the same joint (see ends_at_joint) move,
/// too.
Status move_ends(const Handles& before, const std::vector<HandleEnd>& ends,
  const std::vector<Vec3>& positions, EditedHandles& after);

/// Return the name of the mirrored handle, by Blender's conventions. The name contains a side, left
/// or right, in one of these forms:
/// - L or R, l or r, at the end after '.', '_', '-' or a blank, or at the beginning before one of
///   these characters;
/// - left or right at the end or the beginning, in lower case, in capitals or capitalized.
/// The result contains the opposite side. A numeric suffix such as .001 does not change. A name
/// without a side is returned unchanged.
std::string mirrored_name(const std::string& name);

/// Mirror handles at the plane through `position` with the given `normal` (of any nonzero length).
/// The copy of a handle is named by mirrored_name(). If a handle of the same kind already has this
/// name, no copy is made; instead, that existing handle is moved to the mirrored position. The
/// existing handle is not moved if it is itself one of the handles to mirror.
///
/// Three kinds of handles are not copied: handles that are their own mirror images, handles whose
/// mirror image exists already, and regions, because regions need labels on the mesh.
///
/// The parent of a copy is the mirror image of the original's parent, or the original's parent
/// itself if this parent has no image. Edges and faces of cages are copied if all of their corners
/// have images. The corners of copied faces are in reversed order, so that their outer sides stay
/// outside.
/// @param handle_indices  indices of the handles to mirror; empty: all
Status mirror_handles(const Handles& before, const std::vector<Index>& handle_indices,
  const Vec3& position, const Vec3& normal, EditedHandles& after);

/// Move points, cage vertices and both ends of bones to the nearest point of a surface. Regions do
/// not move.
/// @param handle_indices  indices of the handles to move; empty: all
Status snap_to_surface(const Handles& before, const std::vector<Index>& handle_indices,
  const SurfaceProbe& surface, EditedHandles& after);

} // namespace bindpose

#endif
