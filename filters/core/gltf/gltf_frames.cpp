// Reader of the animations of joints in glTF files (see gltf_frames.h).
#include "gltf/gltf_frames.h"

#include "base/memory.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace bindpose
{

namespace
{
constexpr Index maximum_frames = 100000;
constexpr double default_frames_per_second = 24.0; // if the keys are not evenly spaced

/// A property of a node as a function of time.
struct Track
{
  int node;
  enum class Property
  {
    translation,
    rotation,
    scale
  } property;
  std::string interpolation;
  std::vector<double> times;
  /// One row per key; for cubic interpolation three rows per key: in-tangent, value, out-tangent.
  GltfNumbers values;

  bool is_cubic() const { return this->interpolation == "CUBICSPLINE"; }
  Eigen::VectorXd value(std::size_t key) const
  {
    return this->values.row(static_cast<Index>(this->is_cubic() ? 3 * key + 1 : key)).transpose();
  }

  Eigen::VectorXd at(double time) const
  {
    const auto after = std::upper_bound(this->times.begin(), this->times.end(), time);
    if (after == this->times.begin() || after == this->times.end())
    {
      return this->value(after == this->times.begin() ? 0 : this->times.size() - 1);
    }
    const auto key = static_cast<std::size_t>(after - this->times.begin()) - 1;
    const double step = this->times[key + 1] - this->times[key];
    const double u = (time - this->times[key]) / step;
    Eigen::VectorXd a = this->value(key);
    const Eigen::VectorXd b = this->value(key + 1);
    if (this->interpolation == "STEP")
    {
      return a;
    }
    if (this->is_cubic())
    {
      const auto row = static_cast<Index>(3 * key);
      const Eigen::VectorXd out = step * this->values.row(row + 2).transpose();
      const Eigen::VectorXd in = step * this->values.row(row + 3).transpose();
      const double u2 = u * u;
      const double u3 = u2 * u;
      return (2 * u3 - 3 * u2 + 1) * a + (u3 - 2 * u2 + u) * out + (3 * u2 - 2 * u3) * b +
        (u3 - u2) * in;
    }
    if (this->property == Property::rotation)
    {
      const Eigen::Quaterniond p(Eigen::Vector4d(a.normalized()));
      const Eigen::Quaterniond q(Eigen::Vector4d(b.normalized()));
      return p.slerp(u, q).coeffs();
    }
    return (1.0 - u) * a + u * b;
  }
};

std::optional<Track> read_track(const tinygltf::Model& model, const GltfAccessors& accessors,
  const tinygltf::Animation& animation, const tinygltf::AnimationChannel& channel)
{
  Track track;
  track.node = channel.target_node;
  if (channel.target_path == "rotation")
  {
    track.property = Track::Property::rotation;
  }
  else if (channel.target_path == "translation" || channel.target_path == "scale")
  {
    track.property =
      channel.target_path == "scale" ? Track::Property::scale : Track::Property::translation;
  }
  else
  {
    return {}; // the channel animates weights of morph targets, which are not read
  }
  if (track.node < 0)
  {
    return {}; // the channel belongs to an extension
  }
  gltf_element(model.nodes, track.node, "node");
  const tinygltf::AnimationSampler& sampler =
    gltf_element(animation.samplers, channel.sampler, "sampler");
  track.interpolation = sampler.interpolation;
  const GltfNumbers times = accessors.read_finite(sampler.input, TINYGLTF_TYPE_SCALAR, "key times");
  track.times.assign(times.data(), times.data() + times.size());
  for (std::size_t k = 1; k < track.times.size(); ++k)
  {
    if (!(track.times[k] > track.times[k - 1]))
    {
      throw GltfError("the key times of an animation must be strictly increasing");
    }
  }
  const bool rotates = track.property == Track::Property::rotation;
  track.values = accessors.read_finite(
    sampler.output, rotates ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3, "keys");
  if (track.values.rows() != times.rows() * (track.is_cubic() ? 3 : 1))
  {
    throw GltfError("the number of keys of an animation must match the number of key times");
  }
  return track;
}

/// Return the times of the frames: the times of the keys if these are evenly spaced, else the times
/// at 24 frames per second.
/// @param rate set to the number of frames per second.
std::vector<double> frame_times(const std::vector<Track>& tracks, double& rate)
{
  std::set<double> keys;
  for (const Track& track : tracks)
  {
    keys.insert(track.times.begin(), track.times.end());
  }
  const double first = *keys.begin();
  const double length = *keys.rbegin() - first;
  rate = default_frames_per_second;
  const double step = keys.size() > 1 ? length / static_cast<double>(keys.size() - 1) : 0.0;
  bool even = keys.size() > 1;
  Index k = 0;
  for (const double key : keys)
  {
    even = even && std::abs(key - first - step * static_cast<double>(k++)) < 1e-3 * step;
  }
  if (even)
  {
    // Times are stored as floats, so a rate close to an integer is rounded.
    rate = 1.0 / step;
    rate = std::abs(rate - std::round(rate)) < 1e-4 * rate ? std::round(rate) : rate;
    return { keys.begin(), keys.end() };
  }
  const double frames = std::round(length * rate) + 1.0;
  if (!(frames <= static_cast<double>(maximum_frames)))
  {
    throw GltfError("the animation is longer than " + std::to_string(maximum_frames) + " frames");
  }
  std::vector<double> times;
  for (Index frame = 0; frame < static_cast<Index>(frames); ++frame)
  {
    times.push_back(first + static_cast<double>(frame) / rate);
  }
  return times;
}
} // namespace

std::optional<std::string> read_gltf_frames(const tinygltf::Model& model,
  const GltfAccessors& accessors, GltfNodes nodes, const std::vector<int>& joint_nodes,
  std::vector<GltfFrame>& frames, double& frames_per_second, std::set<int>* animated_nodes)
{
  std::vector<char> moves_a_joint(model.nodes.size(), 0);
  for (int id : joint_nodes)
  {
    for (; id >= 0 && !moves_a_joint[id]; id = nodes.parents[id])
    {
      moves_a_joint[id] = 1;
    }
  }
  std::vector<Track> tracks;
  std::string name;
  for (const tinygltf::Animation& animation : model.animations)
  {
    std::vector<Track> found;
    for (const tinygltf::AnimationChannel& channel : animation.channels)
    {
      if (auto track = read_track(model, accessors, animation, channel);
          track && moves_a_joint[track->node])
      {
        found.push_back(*track);
      }
    }
    if (tracks.empty() && !found.empty())
    {
      tracks = std::move(found);
      name = sanitize_line(animation.name);
    }
  }
  if (tracks.empty())
  {
    return {};
  }
  for (const Track& track : tracks)
  {
    if (animated_nodes)
    {
      animated_nodes->insert(track.node);
    }
  }
  const std::vector<double> times = frame_times(tracks, frames_per_second);
  if (static_cast<double>(times.size() * joint_nodes.size() * sizeof(Eigen::Affine3d)) >
    available_memory())
  {
    throw GltfError("the animation needs more memory than is available");
  }
  for (const double time : times)
  {
    for (const Track& track : tracks)
    {
      GltfNodeTransform& node_transform = nodes.node_transforms[track.node];
      node_transform.has_matrix = false; // glTF does not allow animated nodes with a matrix
      const Eigen::VectorXd value = track.at(time);
      switch (track.property)
      {
        case Track::Property::translation:
          node_transform.trs.translation = value;
          break;
        case Track::Property::scale:
          node_transform.trs.scale = value;
          break;
        case Track::Property::rotation:
          set_rotation(value, node_transform.trs);
          break;
      }
    }
    const std::vector<Eigen::Affine3d> global = nodes.scene_transforms();
    GltfFrame frame;
    for (const int id : joint_nodes)
    {
      frame.posed.push_back(global[id]);
      if (!global[id].matrix().allFinite())
      {
        throw GltfError("the animation gives a joint a transform that is not finite");
      }
    }
    frames.push_back(std::move(frame));
  }
  return name;
}

} // namespace bindpose
