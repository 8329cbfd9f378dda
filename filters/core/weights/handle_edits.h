#ifndef bindpose_weights_handle_edits_h
#define bindpose_weights_handle_edits_h

#include "surface/surface_probe.h"
#include "weights/handles.h"

#include <array>
#include <string>
#include <vector>

namespace bindpose
{

/// Handles after an edit, and where each comes from, so that whatever else is known of handles can
/// follow them.
struct EditedHandles
{
  Handles handles;
  std::vector<Index> source; ///< its number before the edit, or -1: a new one
  std::vector<Index> model; ///< the one it is a copy of, or its source; -1: of none
};

// Every edit below takes handles that pass check_handles(), or none at all, and gives handles that
// do, or none at all. On invalid_input, with one sentence that names the handle, `after` is as
// before the edit. Names of all other handles stay. `before` and `after.handles` may not be one.

/// The name, or with .001, .002, … where another handle has it; of an empty name the first free one
/// of p1, b1, c1 or r1 by kind.
std::string free_name(const Handles& handles, const std::string& wanted, HandleKind kind);

/// Adds a handle behind all others; its name is made free_name(). Its cage elements may name itself
/// by its number, the size of the list before.
Status add_handle(const Handles& before, Handle handle, EditedHandles& after);

/// Removes handles: what is below them hangs on the nearest that is left above; edges and faces of
/// a cage that lose a corner go.
Status remove_handles(const Handles& before, const std::vector<Index>& which, EditedHandles& after);

/// invalid_input for an empty name, or another handle's.
Status rename_handle(
  const Handles& before, Index which, const std::string& name, EditedHandles& after);

/// invalid_input for a parent that is the handle itself or below it. -1: none.
Status set_parent(const Handles& before, Index which, Index parent, EditedHandles& after);

/// Adds or takes away the edge of a cage between two cage vertices.
Status toggle_cage_edge(const Handles& before, Index a, Index b, EditedHandles& after);

/// One end of a handle; all but bones have only the first.
struct HandleEnd
{
  Index handle = -1;
  bool tail = false;
};
/// All ends of bones at the same place as this one (exactly, or within 1e-9 of the handles'
/// extent), this one first. Of anything but a bone itself alone.
std::vector<HandleEnd> joint_of(const Handles& handles, const HandleEnd& end);

/// Moves ends to places, each with its joint.
Status move_ends(const Handles& before, const std::vector<HandleEnd>& ends,
  const std::vector<Vec3>& places, EditedHandles& after);

/// The name on the other side, as Blender has it: an L or R, l or r, at the end behind '.', '_',
/// '-' or a blank, or at the beginning before one of these; left and right at the end or beginning,
/// in small letters, capitals, or with a capital; a number .001 at the end stays. Without a
/// side the name itself.
std::string mirrored_name(const std::string& name);

/// Copies handles to the other side of the plane through `place` across `normal` (of any length but
/// 0). The copy of a handle has mirrored_name(). Where a handle has that name already it is moved
/// instead, unless it is among those to be mirrored: then both stay. Handles that are their own
/// images, those whose image stands there already, and regions, which need labels on the mesh, are
/// not copied. A copy hangs on the copy of its handle's parent, or on the parent itself where that
/// has none. Edges and faces of cages between copies, or copies and vertices in the plane, are
/// copied, faces turned to keep their outsides out.
/// @param which  none: all
Status mirror_handles(const Handles& before, const std::vector<Index>& which, const Vec3& place,
  const Vec3& normal, EditedHandles& after);

/// Moves points, cage vertices and both ends of bones to the nearest place on a surface; regions
/// stay.
/// @param which  none: all
Status snap_to_surface(const Handles& before, const std::vector<Index>& which,
  const SurfaceProbe& surface, EditedHandles& after);

} // namespace bindpose

#endif
