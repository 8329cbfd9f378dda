#ifndef bindpose_poses_stored_poses_h
#define bindpose_poses_stored_poses_h

#include "poses/key_frames.h"
#include "poses/pose_library.h"

namespace bindpose
{

/// All stored poses of a document: the library and the key frames. Copies are stored in sessions
/// and for undo.
struct StoredPoses
{
  PoseLibrary library;
  KeyFrames keys;
};

/// Return {"library": […], "key_frames": {…}}.
nlohmann::ordered_json to_json(const StoredPoses& stored_poses);
/// Read stored poses. A missing member gives an empty library or empty key frames. If the result is
/// invalid_input, `stored_poses` is unchanged.
Status from_json(const nlohmann::ordered_json& json, StoredPoses& stored_poses);

} // namespace bindpose

#endif
