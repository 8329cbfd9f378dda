#include "poses/key_frames.h"

#include "pose/handle_hierarchy.h"
#include "poses/json_fields.h"
#include "poses/pose_blend.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
constexpr double time_tolerance = 5e-4; // seconds
constexpr double maximum_time = 36000.0;
constexpr const char* interpolation_words[] = { "linear", "spline" };

/// Return a handle's pivot, relative to its parent, at a time between keys 1 and 2. Key 0 precedes
/// key 1, and key 3 follows key 2. At the start of the sequence key 0 equals key 1; at the end key
/// 3 equals key 2.
Vec3 spline_point(const Vec3 (&p)[4], const double (&t)[4], double time)
{
  const double span = t[2] - t[1];
  // The slope at a key is the slope of the parabola through the key and its two neighbors.
  const auto slope = [&](int k, int before, int after) -> Vec3
  {
    const double h0 = t[k] - t[before], h1 = t[after] - t[k];
    if (h0 <= 0.0 || h1 <= 0.0)
    {
      const int one = h0 <= 0.0 ? k : before, other = h0 <= 0.0 ? after : k;
      return (p[other] - p[one]) / (t[other] - t[one]);
    }
    return ((p[k] - p[before]) / h0 * h1 + (p[after] - p[k]) / h1 * h0) / (h0 + h1);
  };
  const Vec3 m1 = slope(1, 0, 2) * span, m2 = slope(2, 1, 3) * span;
  const double s = (time - t[1]) / span;
  const double s2 = s * s, s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * p[1] + (s3 - 2 * s2 + s) * m1 + (3 * s2 - 2 * s3) * p[2] +
    (s3 - s2) * m2;
}

Vec3 pivot_of(const Handle& handle, const HandlePose& pose)
{
  return pose.transform.leftCols<3>() * handle.head + pose.transform.col(3);
}
} // namespace

int KeyFrames::index_at(double time) const
{
  for (std::size_t k = 0; k < this->keys_.size(); ++k)
  {
    if (std::abs(this->keys_[k].time - time) < time_tolerance)
    {
      return static_cast<int>(k);
    }
  }
  return -1;
}

std::size_t KeyFrames::set(double time, NamedPose pose)
{
  const double clamped_time = std::clamp(std::isfinite(time) ? time : 0.0, 0.0, maximum_time);
  const int existing = this->index_at(clamped_time);
  if (existing >= 0)
  {
    this->keys_[static_cast<std::size_t>(existing)].pose = std::move(pose);
    return static_cast<std::size_t>(existing);
  }
  const auto next = std::find_if(this->keys_.begin(), this->keys_.end(),
    [&](const Key& key) { return key.time > clamped_time; });
  const auto number = static_cast<std::size_t>(next - this->keys_.begin());
  this->keys_.insert(next, { clamped_time, std::move(pose) });
  return number;
}

std::size_t KeyFrames::move(std::size_t key, double time)
{
  NamedPose pose = this->keys_[key].pose;
  this->remove(key);
  return this->set(time, std::move(pose));
}

void KeyFrames::remove(std::size_t key)
{
  if (key < this->keys_.size())
  {
    this->keys_.erase(this->keys_.begin() + static_cast<std::ptrdiff_t>(key));
  }
}

void KeyFrames::rename_handle(const std::string& from, const std::string& to)
{
  for (Key& key : this->keys_)
  {
    key.pose.rename(from, to);
  }
}

Pose KeyFrames::pose_at(double time, const Handles& handles, const Pose& base) const
{
  if (this->keys_.empty())
  {
    return base;
  }
  const auto next = std::find_if(
    this->keys_.begin(), this->keys_.end(), [&](const Key& key) { return key.time > time; });
  if (next == this->keys_.begin())
  {
    return next->pose.for_handles(handles, base);
  }
  const auto before = next - 1;
  const Pose from = before->pose.for_handles(handles, base);
  if (next == this->keys_.end() || time == before->time)
  {
    return from;
  }
  const Pose to = next->pose.for_handles(handles, base);
  const double fraction = (time - before->time) / (next->time - before->time);
  if (fraction == 0.0 || this->interpolation == KeyInterpolation::linear || this->keys_.size() < 3)
  {
    return blend(handles, from, to, fraction);
  }
  const auto first = before == this->keys_.begin() ? before : before - 1;
  const auto last = next + 1 == this->keys_.end() ? next : next + 1;
  const double times[4] = { first->time, before->time, next->time, last->time };
  Pose keys[4] = { first->pose.for_handles(handles, base), from, to,
    last->pose.for_handles(handles, base) };
  for (Pose& key : keys)
  {
    key = relative_pose(handles, key);
  }
  Pose result = blend_relative(handles, keys[1], keys[2], fraction);
  for (std::size_t k = 0; k < result.size(); ++k)
  {
    const Vec3 pivots[4] = { pivot_of(handles[k], keys[0][k]), pivot_of(handles[k], keys[1][k]),
      pivot_of(handles[k], keys[2][k]), pivot_of(handles[k], keys[3][k]) };
    result[k].transform.col(3) +=
      spline_point(pivots, times, time) - pivot_of(handles[k], result[k]);
  }
  return absolute_pose(handles, result);
}

std::size_t KeyFrames::frame_count() const
{
  return this->keys_.empty()
    ? 0
    : 1 + static_cast<std::size_t>(std::lround(this->duration() * this->frames_per_second));
}

std::vector<Pose> KeyFrames::frames(const Handles& handles, const Pose& base) const
{
  std::vector<Pose> result;
  const std::size_t count = this->frame_count();
  for (std::size_t k = 0; k < count; ++k)
  {
    // If a frame's time equals a key's time up to round-off, use the key's time.
    const double time = static_cast<double>(k) / this->frames_per_second;
    const int key = this->index_at(time);
    result.push_back(this->pose_at(
      key >= 0 ? this->keys_[static_cast<std::size_t>(key)].time : time, handles, base));
  }
  return result;
}

Json to_json(const KeyFrames& keys)
{
  Json list = Json::array();
  for (const KeyFrames::Key& key : keys.keys())
  {
    list.push_back({ { "time", key.time }, { "handles", to_json(key.pose) } });
  }
  return { { "fps", keys.frames_per_second },
    { "interpolation", interpolation_words[static_cast<int>(keys.interpolation)] },
    { "loop", keys.loop }, { "keys", list } };
}

Status from_json(const Json& json, KeyFrames& keys)
{
  KeyFrames read;
  JsonFields fields(json, "the key frames");
  fields.read("fps", read.frames_per_second, 1.0, 240.0);
  fields.read("interpolation", read.interpolation, interpolation_words);
  fields.read("loop", read.loop);
  const Json* list = fields.member("keys", true);
  if (!fields.status().ok())
  {
    return fields.status();
  }
  for (const Json& entry : list ? *list : Json::array())
  {
    double time = -1.0;
    NamedPose pose;
    JsonFields key(entry, "a key frame");
    key.read("time", time, 0.0, maximum_time);
    const Json* handles = key.member("handles", false);
    Status status = key.status();
    if (status.ok() && (time < 0.0 || !handles))
    {
      status = Status::invalid_input("a key frame must have \"time\" and \"handles\"");
    }
    status = status.ok() ? from_json(*handles, pose) : status;
    if (!status.ok())
    {
      return status;
    }
    read.set(time, std::move(pose));
  }
  keys = std::move(read);
  return {};
}

} // namespace bindpose
