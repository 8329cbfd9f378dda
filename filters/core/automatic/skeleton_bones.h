#ifndef bindpose_automatic_skeleton_bones_h
#define bindpose_automatic_skeleton_bones_h

#include "automatic/curve_skeleton.h"
#include "weights/handles.h"

#include <functional>

namespace bindpose
{

struct SkeletonBonesOptions
{
  /// How far the curve may be from its bones, as a fraction of the shape's diagonal, 0.001 … 1.
  double tolerance = 0.03;
  /// Longer bones are split, as a fraction of the diagonal, 0.01 … ; 0: straight ones stay whole.
  double longest_bone = 0.0;
  /// At most, >= 0; 0: any number. A component keeps at least one.
  Index maximum_bones = 0;
  /// Branches that are shorter than this times half of the thickness where they begin are no limbs,
  /// 0 … 10; junctions that are nearer to each other are one.
  double prune = 1.0;
  /// Whether a point is within the shape; thread-safe. When given, bones that leave the shape are
  /// split where they bend by a quarter of the tolerance, and joints stay within it where they can.
  std::function<bool(const Vec3&)> inside;
};

struct SkeletonBones
{
  Handles handles; ///< points p1, p2, … (components like balls), then bones b1, b2, …
  Points joints; ///< #J x 3: ends of bones, each once
  std::vector<Index> roots; ///< of every component with bones: a joint
  Index junctions = 0; ///< joints of three bones or more
  Index cut_cycles = 0;
  Index pruned_branches = 0;
  Index merged_branches = 0; ///< between junctions that became one
};

/// Simplifies a curve skeleton to bones: ends and junctions are joints, the branches between them
/// are split where they bend.
///
/// 1. A component with cycles is rooted at its junction nearest to its centroid of mass (of a ring:
///    at any point as near), and each cycle is cut at the point farthest from there along the
///    curve: bones have one parent.
/// 2. The branch that is shortest beside the thickness is pruned, or, between two junctions,
///    contracted to one point, until none is short. With too many branches for maximum_bones, pruning
///    goes on with the limbs that reach least far out.
/// 3. The piece that is farthest from its bone, or longest, is split, until tolerance and
///    longest_bone are kept or there are maximum_bones (Douglas and Peucker, 1973, in the order of
///    need). What lies in the ball of a junction is no bend. A bone that leaves the shape is split,
///    too, where that can help; all are split at points within the shape only.
/// 4. The root of a component without cycles is its joint nearest to the centroid. Bones lead away
///    from it: a bone's parent is the one whose tail is its head. If several bones begin at a root,
///    the one with the largest volume is the parent of the others.
/// 5. The first bone of every other component, and every point, has as its parent the nearest bone
///    of the component with the largest volume. Exactly one bone has no parent. Parents come before
///    children, except for points, which come first.
///
/// @param diagonal  of the shape's box, the unit of the options
/// invalid_input: an option out of range. Warns where cycles are cut and where maximum_bones cannot
/// be kept. Cost: O(#P x branches).
Status skeleton_bones(const CurveSkeleton& skeleton, double diagonal,
  const SkeletonBonesOptions& options, SkeletonBones& bones);

} // namespace bindpose

#endif
