#ifndef bindpose_weights_handles_h
#define bindpose_weights_handles_h

#include "base/mesh.h"

#include <array>
#include <string>
#include <vector>

namespace bindpose
{

/// The integers are those of the cell array HandleKind.
enum class HandleKind : int
{
  cage_element = -1, ///< a cage's edge or face: owns no column, ties its ends linearly together
  point = 0,
  bone = 1,
  cage_vertex = 2,
  region = 3
};

/// Whether a bind gives the handle vertices of its own. A handle without vertices has zero weights,
/// and its children follow it. The integers are those of the cell array Ownership.
enum class Ownership : int
{
  required = 0, ///< a bind is refused if all vertices on the handle belong to other handles
  optional = 1, ///< skipped then, with a warning: joints of a file's rig
  none = 2 ///< always skipped: joints of a file's rig that move nothing there (control bones)
};

/// A cage's edge (the third is -1) or face: the handles at its corners.
using CageElement = std::array<Index, 3>;

/// One handle: one cell of the handle dataset and, unless it is a cage element, one column of the
/// weights, in the order of the cells.
struct Handle
{
  std::string name;
  HandleKind kind = HandleKind::point;
  /// Point, cage vertex: its place. Bone: its head. Region: its pivot.
  Vec3 head = Vec3::Zero();
  /// Bone: its tail; all others: equal to head.
  Vec3 tail = Vec3::Zero();
  /// Index of the parent in the handle list, or -1.
  Index parent = -1;
  /// Region: the label in the mesh's point array RegionId (> 0; 0 means free).
  Index region_id = 0;
  /// Cage vertex: the cage's elements that begin at it. Weights are linear along them.
  std::vector<CageElement> cage;
  Ownership ownership = Ownership::required;
};

using Handles = std::vector<Handle>;

/// "point", "bone", "cage_vertex", "region", "cage_element".
const char* to_string(HandleKind kind);

/// 'a', 'b': the names of some, for a sentence.
std::string quoted_names(const Handles& handles, const std::vector<Index>& list);
/// 'a', 'b', 'c' and 12 more: the first names of many.
std::string first_names(const Handles& handles, const std::vector<Index>& list);

/// invalid_input, naming the handle, for: no handle at all, an empty or doubled name, a coordinate
/// that is not finite, a bone of length zero, two handles at the same place (closer than 1e-9 of
/// the handles' extent or exactly equal when they have none), a parent out of range or in a cycle,
/// a cage element whose corners are not two or three different cage vertices.
Status check_handles(const Handles& handles);

/// invalid_input for another number of labels (and not none) than of vertices, and, naming the
/// region, for one without a label, without labels to find it by, or with one that no vertex has.
/// @param region_ids label of every vertex, or empty.
Status check_regions(const Handles& handles, const std::vector<Index>& region_ids, Index vertices);

} // namespace bindpose

#endif
