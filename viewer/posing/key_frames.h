#ifndef bindpose_posing_key_frames_h
#define bindpose_posing_key_frames_h

#include "posing/named_pose.h"

namespace bindpose
{

/// How pivots go between keys. Rotations always turn by the shorter arc (slerp), scale and shear,
/// stretch and twist change linearly, modes at the key.
enum class KeyInterpolation : int
{
  linear = 0,
  /// Cubic, through every key, with the slope of its neighbours (Catmull and Rom, times apart).
  spline = 1
};

/// Poses at times, and what is between them. At a key's time the pose is the key's, to the bit;
/// before the first and after the last it stays.
class KeyFrames
{
public:
  struct Key
  {
    double time = 0.0; ///< seconds, 0 or more
    NamedPose pose;
  };
  /// In the order of their times.
  const std::vector<Key>& keys() const { return this->keys_; }
  /// A key that is at this time already (to a millisecond) is replaced. Returns its number.
  std::size_t set(double time, NamedPose pose);
  /// To another time; a key that is there already goes. Returns its new number.
  std::size_t move(std::size_t key, double time);
  void remove(std::size_t key);
  void clear() { this->keys_.clear(); }
  void rename_handle(const std::string& from, const std::string& to);
  /// The key at a time, -1 for none.
  int at(double time) const;

  double duration() const { return this->keys_.empty() ? 0.0 : this->keys_.back().time; }
  double frames_per_second = 24.0; ///< of exports; 1 to 240
  KeyInterpolation interpolation = KeyInterpolation::linear;
  bool loop = true;

  /// @param base  the pose of handles that the keys do not know; returned where there is no key
  Pose pose_at(double time, const Handles& handles, const Pose& base) const;
  /// From 0 to duration(), both among them.
  std::vector<Pose> frames(const Handles& handles, const Pose& base) const;
  std::size_t frame_count() const;

private:
  std::vector<Key> keys_;
};

/// {"fps": 24, "interpolation": "linear", "loop": true, "keys": [{"time": 0, "handles": {…}}, …]}
nlohmann::ordered_json to_json(const KeyFrames& keys);
Status from_json(const nlohmann::ordered_json& json, KeyFrames& keys);

} // namespace bindpose

#endif
