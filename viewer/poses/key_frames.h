#ifndef bindpose_poses_key_frames_h
#define bindpose_poses_key_frames_h

#include "poses/named_pose.h"

namespace bindpose
{

/// The interpolation of pivots between keys. Only pivots depend on this choice. Rotations are
/// interpolated along the shorter arc (slerp). Scale, shear, stretch and twist are interpolated
/// linearly. Between two keys, handles have the modes of the earlier key.
enum class KeyInterpolation : int
{
  linear = 0,
  /// Cubic through every key, with the slope of the parabola through the key and its neighbors
  /// (Catmull and Rom, for non-uniform times).
  spline = 1
};

/// An animation: poses at key times, and the interpolation between them. At a key's time the pose
/// equals the key's pose, bit for bit. The pose is constant before the first key and after the
/// last.
class KeyFrames
{
public:
  struct Key
  {
    double time = 0.0; ///< seconds, 0 or more
    NamedPose pose;
  };
  /// Return the keys in ascending order of their times.
  const std::vector<Key>& keys() const { return this->keys_; }
  /// Set the pose at a time and return the index of the key. If a key is less than 0.5 milliseconds
  /// away, its pose is replaced and its time is kept.
  std::size_t set(double time, NamedPose pose);
  /// Move a key to another time and return its new index. If another key is less than 0.5
  /// milliseconds away from the new time, the two keys become one key, with the moved pose and the
  /// time of the other key.
  std::size_t move(std::size_t key, double time);
  void remove(std::size_t key);
  void clear() { this->keys_.clear(); }
  void rename_handle(const std::string& from, const std::string& to);
  /// Return the index of the key at a time; -1: none.
  int index_at(double time) const;

  double duration() const { return this->keys_.empty() ? 0.0 : this->keys_.back().time; }
  double frames_per_second = 24.0; ///< frames per second of exported animations; 1 to 240
  KeyInterpolation interpolation = KeyInterpolation::linear;
  bool loop = true;

  /// @param base  the pose of handles that the keys do not contain; returned if there are no keys
  Pose pose_at(double time, const Handles& handles, const Pose& base) const;
  /// Return the poses of all frames from time 0 to duration(), both included.
  std::vector<Pose> frames(const Handles& handles, const Pose& base) const;
  std::size_t frame_count() const;

private:
  std::vector<Key> keys_;
};

/// Return {"fps": 24, "interpolation": "linear", "loop": true, "keys": [{"time": 0, "handles":
/// {…}}, …]}.
nlohmann::ordered_json to_json(const KeyFrames& keys);
Status from_json(const nlohmann::ordered_json& json, KeyFrames& keys);

} // namespace bindpose

#endif
