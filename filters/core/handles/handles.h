#ifndef bindpose_handles_handles_h
#define bindpose_handles_handles_h

#include "geometry/mesh.h"
#include "geometry/working_frame.h"

#include <array>
#include <string>
#include <vector>

namespace bindpose
{

/// The type of a handle. The integer values are stored in the cell array HandleKind.
enum class HandleKind : int
{
  /// An edge or face of a cage. It has no column in the weights, because weights are linear between
  /// its corners.
  cage_element = -1,
  point = 0,
  bone = 1,
  cage_vertex = 2,
  region = 3
};

/// Whether a bind assigns vertices to the handle. A handle without vertices has zero weights, and
/// its children in the hierarchy move with it. The integer values are stored in the cell array
/// Ownership.
enum class Ownership : int
{
  required = 0, ///< the bind fails if all vertices on the handle belong to other handles
  /// The handle is skipped with a warning if all its vertices belong to other handles. Used for
  /// joints of a rig that was read from a file.
  optional = 1,
  /// The handle is always skipped. Used for joints of a rig from a file that move no vertices
  /// (control bones).
  none = 2
};

/// The handles at the corners of an edge or face of a cage. The third index of an edge is -1.
using CageElement = std::array<Index, 3>;

/// One handle: one cell of the handle dataset. Each handle, except cage elements, has one column in
/// the weights. The columns are in the order of the cells.
struct Handle
{
  std::string name;
  HandleKind kind = HandleKind::point;
  /// Position of a point or cage vertex, head of a bone, rotation center (pivot) of a region.
  Vec3 head = Vec3::Zero();
  /// Tail of a bone. Equal to head for all other kinds.
  Vec3 tail = Vec3::Zero();
  /// Index of the parent in the handle list, or -1.
  Index parent = -1;
  /// Label of a region in the mesh's point array RegionId (> 0; 0 means that a vertex is in no
  /// region).
  Index region_id = 0;
  /// The cage elements (edges and faces) that have this cage vertex as their first corner. Weights
  /// are linear along cage elements.
  std::vector<CageElement> cage;
  Ownership ownership = Ownership::required;
};

using Handles = std::vector<Handle>;

/// Return "point", "bone", "cage_vertex", "region" or "cage_element".
const char* to_string(HandleKind kind);

/// Report whether any of the handles is a bone. Only bones stretch and twist.
bool has_bones(const Handles& handles);

/// Return the quoted names of the listed handles for use in a sentence: 'a', 'b'.
std::string quoted_names(const Handles& handles, const std::vector<Index>& list);
/// Like quoted_names(), but abbreviate a long list: 'a', 'b', 'c' and 12 more.
std::string abbreviated_names(const Handles& handles, const std::vector<Index>& list);

/// Convert the positions of handles to a frame, and back.
Handles to_frame(const WorkingFrame& frame, Handles handles);
Handles from_frame(const WorkingFrame& frame, Handles handles);

/// Check handles before a bind. Return invalid_input, naming the handle, if
/// - the list is empty;
/// - a name is empty, occurs twice, is not UTF-8, or contains control characters;
/// - a coordinate is not finite, or its absolute value is above 1e120;
/// - a bone has length zero;
/// - two points, two bones or two cage vertices coincide: their positions differ by at most 1e-9 of
///   the diagonal of all handles' bounding box. The direction of a bone does not matter;
/// - a parent is out of range or part of a cycle;
/// - the corners of a cage element are not two or three different cage vertices, or the first
///   corner is not the handle that stores the element.
Status check_handles(const Handles& handles);

/// Check the regions among the handles. Return invalid_input if region_ids is neither empty nor of
/// length `vertices`. Return invalid_input, naming the region, if a region has no label, if the
/// mesh has no labels, or if no vertex has the region's label.
/// @param region_ids label of every vertex, or empty.
Status check_regions(const Handles& handles, const std::vector<Index>& region_ids, Index vertices);

} // namespace bindpose

#endif
