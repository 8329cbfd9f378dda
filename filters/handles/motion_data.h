#ifndef motion_data_h
#define motion_data_h

#include "base/execution.h"
#include "cached_file.h"
#include "gltf/gltf_motion.h"
#include "gltf_data.h"
#include "pose/retarget.h"

#include <functional>
#include <string>
#include <vector>

namespace bindpose
{

/// Extensions of the files with motions.
inline const char* motion_extensions()
{
  return "glb gltf bvh fbx dae";
}

/// The motion of a file, as poses of certain handles.
struct HandleMotion
{
  int frames = 0;
  double frames_per_second = 24.0;
  bool sequence = false; ///< false: a single pose, that of the nodes of the file
  /// Compute the pose of a frame, 0 … frames - 1, from the pose of the handles without the motion.
  std::function<Status(const Pose& base, int frame, Pose& pose)> pose;
};

/// Reads motions for a filter that is updated frame by frame: glTF files by read_gltf() and
/// read_gltf_motion(); BVH, FBX and Collada (DAE) files by import_guarded().
class MotionFile
{
public:
  /// Read the number of frames and their rate, without handles.
  Status read(ExecutionContext& context, const std::string& path, HandleMotion& motion);

  /// Read the motion of the handles. If the joints of the file's first skin are at the handles with
  /// their names, within 1e-4 of the diagonal, the transforms of the joints are used unchanged.
  /// Otherwise the motion is retargeted (see Retarget). The motion refers to this object.
  ///
  /// Report: motion (exact, retargeted), handles_without_joint[], joints_without_handle[] (joints
  /// that the animation moves). Return invalid_input if the file cannot be read, has neither joints
  /// of a skin nor an animation, or if no handle has a joint. If the motion is retargeted, one
  /// warning lists the handles without a joint, and one names the animation that is used.
  Status fit(ExecutionContext& context, const std::string& path, const Handles& handles,
    HandleMotion& motion);

private:
  /// Use the transforms of the first skin's joints unchanged.
  Status fit_exactly(const std::string& path, const Handles& handles,
    const std::vector<MotionJoint>& joints, const std::vector<Index>& joint_of_handle,
    HandleMotion& motion) const;
  Status retarget(const std::string& path, const Handles& handles, HandleMotion& motion) const;

  CachedFile<GltfData> rig_{ &read_gltf };
  CachedFile<GltfMotion> motion_{ &read_motion };

  static Status read_motion(ExecutionContext& context, const std::string& path, GltfMotion& motion);
};

} // namespace bindpose

#endif
