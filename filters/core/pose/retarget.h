#ifndef bindpose_pose_retarget_h
#define bindpose_pose_retarget_h

#include "pose/pose.h"

#include <string>
#include <vector>

namespace bindpose
{

/// A joint of a skeleton that moves.
struct MotionJoint
{
  std::string name;
  Index parent = -1; ///< index of the parent joint, or -1
  Vec3 head = Vec3::Zero(); ///< position at rest
};

/// Transfers the motion of a skeleton to handles with the same names.
///
/// A handle follows the joint of the same name. Names are compared exactly first, then without
/// case, without the characters " _-." and without a prefix that ends in a colon:
/// "mixamorig:LeftArm" is "left_arm". Handles without a joint keep their pose relative to their
/// parents.
///
/// The motion is **retargeted**, because the skeletons may have different proportions, rest poses
/// and axes:
/// - If the positions at rest fit well after a turn by multiples of 90 degrees, such as from y up
///   to z up, and clearly better than without it, the motion is turned in the same way.
/// - Each handle points where its joint points and has its twist, but keeps its length. The
///   direction of a handle is that to the handles of its children.
/// - A handle stays attached to its parent, unless the animation moves its joint relative to the
///   parent joint. Then the handle is translated by this displacement since the first frame, times
///   the ratio of the sizes of both skeletons. The same applies to the displacement of the root.
///   Displacements count from the first frame, because many files have an arbitrary rest position
///   of the root.
/// - Scales of the joints are not used.
class Retarget
{
public:
  /// @param joints the skeleton of the motion, at rest.
  Retarget(const Handles& handles, const std::vector<MotionJoint>& joints);

  /// Return the joint of each handle; -1: none.
  const std::vector<Index>& joint_of_handle() const { return this->joint_of_handle_; }
  /// Return the handles that have no joint.
  std::vector<Index> handles_without_joint() const;

  /// Return the pose of the handles for a frame of the motion.
  /// @param base the pose of the handles without the motion
  /// @param frame, first_frame one transform per joint, from rest to posed positions
  Pose apply(const Pose& base, const std::vector<Affine>& frame,
    const std::vector<Affine>& first_frame) const;

private:
  void find_parents();
  void find_axes();
  void find_alignments();
  Vec3 displacement(Index handle, const std::vector<Affine>& frame) const;

  Handles handles_;
  std::vector<MotionJoint> joints_;
  std::vector<Index> order_; // parents first
  std::vector<Index> joint_of_handle_;
  std::vector<Index> matched_parent_; // #handles: the nearest ancestor with a joint; -1: none
  std::vector<std::vector<Index>> matched_children_; // #handles: handles with this matched_parent_
  /// #handles: the rotation from the rest pose of the handle to that of its joint, in the axes of
  /// the handles.
  std::vector<Eigen::Matrix3d> alignment_;
  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity(); // from the handles to the joints
  double scale_ = 1.0; // size of the handles, divided by the size of the joints
};

/// Return the joint of each handle by the rules of Retarget; -1: none.
std::vector<Index> joints_of_handles(
  const Handles& handles, const std::vector<MotionJoint>& joints);

} // namespace bindpose

#endif
