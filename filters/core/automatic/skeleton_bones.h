#ifndef bindpose_automatic_skeleton_bones_h
#define bindpose_automatic_skeleton_bones_h

#include "automatic/curve_skeleton.h"
#include "weights/handles.h"

#include <functional>

namespace bindpose
{

struct SkeletonBonesOptions
{
  /// Largest distance of the curve from its bones, in bounding-box diagonals of the shape, 0.001 …
  /// 1.
  double tolerance = 0.03;
  /// Bones longer than this are split, in bounding-box diagonals, >= 0.01; 0: straight bones are
  /// not split.
  double longest_bone = 0.0;
  /// Largest number of bones, >= 0; 0: any number. A component keeps at least one bone.
  Index maximum_bones = 0;
  /// A branch shorter than this many times half of the thickness at its start is pruned, 0 … 10.
  /// Junctions that are nearer to each other than that are merged.
  double prune = 1.0;
  /// Report whether a point is inside the shape; must be thread-safe. If given, bones that leave
  /// the shape are split where they bend by a quarter of the tolerance, and joints are placed
  /// inside the shape if possible.
  std::function<bool(const Vec3&)> inside;
};

struct SkeletonBones
{
  Handles handles; ///< points p1, p2, … (components like balls), then bones b1, b2, …
  Points joints; ///< #J x 3: ends of bones, without duplicates
  std::vector<Index> roots; ///< joint index of the root of every component with bones
  Index junctions = 0; ///< joints of three bones or more
  Index cut_cycles = 0;
  Index pruned_branches = 0;
  Index merged_branches = 0; ///< branches between junctions that were merged
};

/// Simplify a curve skeleton to bones. Ends and junctions are joints, and the branches between them
/// are split where they bend.
///
/// 1. A component with cycles is rooted at the junction nearest to its center of mass (a ring: at
///    the nearest point). Each cycle is cut at the point farthest from the root along the curve,
///    because a bone has only one parent.
/// 2. The branch that is shortest relative to the thickness is pruned or, if it is between two
///    junctions, contracted to one point. This is repeated until no branch is short. If there are
///    more branches than maximum_bones, the limbs that are shortest relative to the thickness are
///    pruned too.
/// 3. The piece that is farthest from its bone, or longest, is split until tolerance and
///    longest_bone are satisfied or there are maximum_bones pieces (Douglas and Peucker, 1973, worst
///    piece first). Points within the ball of a junction are not bends. A bone that leaves the
///    shape is also split if that can help. Pieces are split only at points inside the shape.
/// 4. The root of a component without cycles is the joint nearest to the centroid. Bones are
///    directed away from the root: the parent of a bone is the bone whose tail is its head. If
///    several bones begin at a root, the one with the largest volume is the parent of the others.
/// 5. The parent of the first bone of every other component, and of every point, is the nearest
///    bone of the component with the largest volume. Exactly one bone has no parent. Parents
///    precede their children, except for points, which come first.
///
/// @param diagonal  of the shape's bounding box, the unit of the options
/// invalid_input: an option out of range. There is a warning if cycles are cut, and if maximum_bones
/// is exceeded. Cost: O(#P x branches).
Status skeleton_bones(const CurveSkeleton& skeleton, double diagonal,
  const SkeletonBonesOptions& options, SkeletonBones& bones);

} // namespace bindpose

#endif
