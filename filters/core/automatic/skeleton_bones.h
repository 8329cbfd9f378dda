#ifndef bindpose_automatic_skeleton_bones_h
#define bindpose_automatic_skeleton_bones_h

#include "automatic/curve_skeleton.h"
#include "handles/handles.h"

#include <functional>

namespace bindpose
{

/// Options of skeleton_bones().
struct SkeletonBonesOptions
{
  /// Largest distance of the curve from its bones, in bounding-box diagonals of the shape, from
  /// 0.001 to 1.
  double tolerance = 0.03;
  /// Maximum length of a bone, in bounding-box diagonals: at least 0.01, or 0 for no maximum.
  /// Longer bones are split, even if they are straight.
  double longest_bone = 0.0;
  /// Maximum number of bones, or 0 for no maximum. A component keeps at least one bone.
  Index maximum_bones = 0;
  /// Factor for pruning and merging, from 0 to 10. A branch is pruned if its length is below this
  /// factor times the radius at its junction. The radius is half of the shape's thickness. Two
  /// junctions are merged if the length of the branch between them is below this factor times the
  /// larger of their radii.
  double prune = 1.0;
  /// Callback that reports whether a point is inside the shape; must be thread-safe. If empty,
  /// every point counts as inside. Joints are placed inside the shape if possible. A bone that
  /// leaves the shape is split if the curve deviates from the bone by more than a quarter of the
  /// tolerance.
  std::function<bool(const Vec3&)> inside;
};

/// The result of skeleton_bones().
struct SkeletonBones
{
  /// Point handles p1, p2, … (for components that are balls), then bones b1, b2, …
  Handles handles;
  Points joints; ///< #J x 3: ends of bones, without duplicates
  std::vector<Index> roots; ///< joint index of the root of every component with bones
  Index junctions = 0; ///< number of joints of three bones or more
  Index cut_cycles = 0;
  Index pruned_branches = 0;
  Index merged_branches = 0; ///< number of branches between junctions that were contracted
};

/// Simplify a curve skeleton to bones. Ends and junctions are joints, and the branches between them
/// are split where they bend.
///
/// 1. A component with cycles gets a root: the end or junction nearest to its center of mass. If
///    the component has no end or junction (a ring), the root is the nearest point. Each cycle is
///    cut at the point farthest from the root along the curve, because a bone can have only one
///    parent.
/// 2. Let the relative length of a branch be its length divided by the radius at its junction. The
///    branch with the smallest relative length is pruned. If this branch is between two junctions,
///    it is contracted to one point instead. This is repeated until all relative lengths are at
///    least `prune`. While there are more branches than maximum_bones, the branch with a free end
///    and the smallest relative length is pruned.
/// 3. Branches are divided into pieces, one per bone. The piece that exceeds tolerance or
///    longest_bone by the largest factor is split first (Douglas and Peucker, 1973). The splitting
///    ends if no piece exceeds tolerance or longest_bone, or if there are maximum_bones pieces.
///    Points within the radius of a junction are ignored, because the curve turns there from one
///    limb to another. A bone that leaves the shape is also split (see
///    SkeletonBonesOptions::inside). Pieces are split only at points inside the shape.
/// 4. The root of a component without cycles is the joint nearest to the centroid. Bones are
///    directed away from the root: the parent of a bone is the bone whose tail is the head of this
///    bone. If several bones begin at a root, the bone with the largest volume is the parent of the
///    other bones.
/// 5. The component with the largest volume is the main component. Its first bone has no parent.
///    The parent of each point, and of the first bone of each other component, is the nearest bone
///    of the main component. Points come first in the list. Each bone comes after its parent.
///
/// @param diagonal  diagonal of the shape's bounding box, the unit of the options
/// @return invalid_input if an option is out of range. Otherwise ok, with a warning if cycles are
/// cut and a warning if maximum_bones is exceeded. Cost: O(#P x #branches).
Status skeleton_bones(const CurveSkeleton& skeleton, double diagonal,
  const SkeletonBonesOptions& options, SkeletonBones& bones);

} // namespace bindpose

#endif
