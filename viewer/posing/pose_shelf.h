#ifndef bindpose_posing_pose_shelf_h
#define bindpose_posing_pose_shelf_h

#include "posing/key_frames.h"
#include "posing/pose_library.h"

namespace bindpose
{

/// All stored poses, as a value for sessions and for undo.
struct PoseShelf
{
  PoseLibrary library;
  KeyFrames keys;
};

/// {"library": […], "key_frames": {…}}
nlohmann::ordered_json to_json(const PoseShelf& shelf);
/// Read a shelf. Missing parts are empty. On invalid_input the shelf is unchanged.
Status from_json(const nlohmann::ordered_json& json, PoseShelf& shelf);

} // namespace bindpose

#endif
