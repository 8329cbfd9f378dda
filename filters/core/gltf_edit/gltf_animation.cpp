#include "gltf_edit/gltf_animation.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace bindpose
{

namespace
{
using Column = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Json = GltfDocument::Json;

int add_times(GltfDocument& document, const GltfSkin& skin)
{
  Column times(static_cast<Index>(skin.frames.size()), 1);
  for (Index k = 0; k < times.rows(); ++k)
  {
    times(k, 0) = static_cast<double>(k) / skin.frames_per_second;
  }
  return document.append_rows(times, 0);
}

void add_channel(Json& animation, int times, int values, int node, const char* path)
{
  const std::size_t sampler = animation["samplers"].size();
  animation["samplers"].push_back(
    { { "input", times }, { "output", values }, { "interpolation", "LINEAR" } });
  animation["channels"].push_back(
    { { "sampler", sampler }, { "target", { { "node", node }, { "path", path } } } });
}

/// Append the tracks of the joints. The quaternions q and -q represent the same rotation. The one
/// that is nearer to the quaternion of the previous key is stored, because programs interpolate
/// between keys.
void append_tracks(GltfDocument& document, const GltfSkin& skin, const GltfJointNodes& nodes,
  std::vector<std::vector<Trs>>& frames)
{
  const int times = add_times(document, skin);
  Json animation{ { "name", "poses" } };
  for (std::size_t j = 0; j < skin.joints.size(); ++j)
  {
    const auto count = static_cast<Index>(frames.size());
    Column translations(count, 3);
    Column rotations(count, 4);
    Column scales(count, 3);
    for (Index k = 0; k < count; ++k)
    {
      Trs& trs = frames[k][j];
      if (k > 0 && trs.rotation.dot(frames[k - 1][j].rotation) < 0.0)
      {
        trs.rotation.coeffs() *= -1.0;
      }
      translations.row(k) = trs.translation.transpose();
      rotations.row(k) = trs.rotation.coeffs().transpose();
      scales.row(k) = trs.scale.transpose();
    }
    const int node = nodes.joints[j];
    add_channel(animation, times, document.append_rows(translations, 0), node, "translation");
    add_channel(animation, times, document.append_rows(rotations, 0), node, "rotation");
    add_channel(animation, times, document.append_rows(scales, 0), node, "scale");
  }
  document.append("animations", std::move(animation));
}
} // namespace

Status check_frames(const GltfSkin& skin, GltfAnimation animation)
{
  const bool morph = animation == GltfAnimation::morph;
  for (std::size_t i = 0; i < skin.frames.size(); ++i)
  {
    const GltfFrame& frame = skin.frames[i];
    if ((!morph && frame.posed.size() != skin.joints.size()) ||
      (frame.points.rows() != skin.points.rows() && (morph || frame.points.rows() != 0)) ||
      (frame.normals.rows() != skin.points.rows() && frame.normals.rows() != 0))
    {
      return Status::invalid_input("animation frame " + std::to_string(i + 1) + " has " +
        std::to_string(frame.posed.size()) + " joints and " + std::to_string(frame.points.rows()) +
        " points; expected " + std::to_string(skin.joints.size()) + " joints and " +
        std::to_string(skin.points.rows()) + " points");
    }
    bool finite = fits_in_float(frame.points) && fits_in_float(frame.normals);
    for (const Eigen::Affine3d& map : frame.posed)
    {
      finite = finite && fits_in_float(map.matrix());
    }
    if (!finite)
    {
      return Status::invalid_input(
        "an animation frame contains a value that is not a finite float");
    }
  }
  if (!skin.frames.empty() && !(skin.frames_per_second > 0.0 && skin.frames_per_second < 1e6))
  {
    return Status::invalid_input("frames per second must be greater than 0 and less than 1000000");
  }
  return {};
}

Status append_joint_animation(ExecutionContext& context, GltfDocument& document,
  const GltfSkin& skin, const GltfJointNodes& nodes, const GltfStoredSkin& stored,
  double& largest_error)
{
  largest_error = 0.0;
  std::vector<std::vector<Trs>> frames;
  for (const GltfFrame& frame : skin.frames)
  {
    if (context.canceled())
    {
      return Status::canceled();
    }
    context.progress(static_cast<double>(frames.size()) / static_cast<double>(skin.frames.size()));
    std::vector<Eigen::Affine3d> stored_maps;
    frames.push_back(local_maps(skin.joints, frame.posed, stored_maps));
    largest_error =
      std::max(largest_error, largest_pose_error(stored, frame.posed, stored_maps, frame.points));
  }
  append_tracks(document, skin, nodes, frames);
  return {};
}

void append_shape_animation(GltfDocument& document, const GltfSkin& skin, int mesh, int node)
{
  Json targets = Json::array(), names = Json::array();
  const auto count = static_cast<Index>(skin.frames.size());
  for (Index k = 0; k < count; ++k)
  {
    const GltfFrame& frame = skin.frames[k];
    Json target;
    const Points moved = frame.points - skin.points;
    target["POSITION"] = document.append_rows(moved);
    if (frame.normals.rows() > 0 && skin.normals.rows() > 0)
    {
      const Points normal_offsets = frame.normals - skin.normals;
      target["NORMAL"] = document.append_rows(normal_offsets);
    }
    targets.push_back(std::move(target));
    names.push_back("frame " + std::to_string(k));
  }
  Json& json = document.list("meshes")[mesh];
  json["primitives"][0]["targets"] = std::move(targets);
  json["weights"] = std::vector<double>(static_cast<std::size_t>(count), 0.0);
  json["extras"]["targetNames"] = std::move(names);
  Column target_weights = Column::Identity(count, count);
  const Eigen::Map<Column> in_a_row(target_weights.data(), target_weights.size(), 1);
  Json animation{ { "name", "poses" } };
  add_channel(animation, add_times(document, skin), document.append_rows(Column(in_a_row), 0), node,
    "weights");
  document.append("animations", std::move(animation));
}

} // namespace bindpose
