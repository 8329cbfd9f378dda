// Transfer of motions by the names of joints (see retarget.h).
#include "pose/retarget.h"

#include "pose/handle_hierarchy.h"
#include "pose/rotation_fit.h"
#include "pose/transform_parts.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace bindpose
{

namespace
{
/// Return the name in lower case, without a prefix that ends in a colon and without separators.
std::string plain_name(const std::string& name)
{
  const std::size_t colon = name.rfind(':');
  std::string result;
  for (const char c : name.substr(colon == std::string::npos ? 0 : colon + 1))
  {
    if (std::string(" _-.").find(c) == std::string::npos)
    {
      result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  return result;
}

/// Return the index of each item by its name. A name that occurs twice is left out.
template <typename Item>
std::map<std::string, Index> index_by_name(
  const std::vector<Item>& items, std::string (*convert)(const std::string&))
{
  std::map<std::string, Index> result;
  for (std::size_t k = 0; k < items.size(); ++k)
  {
    const auto [entry, is_new] = result.insert({ convert(items[k].name), static_cast<Index>(k) });
    entry->second = is_new ? entry->second : -1;
  }
  return result;
}

/// Return the root mean square distance of the points from their mean.
double size_of(const std::vector<Vec3>& points)
{
  Vec3 mean = Vec3::Zero();
  for (const Vec3& point : points)
  {
    mean += point / static_cast<double>(points.size());
  }
  double sum = 0.0;
  for (const Vec3& point : points)
  {
    sum += (point - mean).squaredNorm() / static_cast<double>(points.size());
  }
  return std::sqrt(sum);
}

Vec3 apply_affine(const Affine& transform, const Vec3& point)
{
  return transform.leftCols<3>() * point + transform.col(3);
}

/// Return the 24 rotations that map axes to axes.
std::vector<Eigen::Matrix3d> axis_rotations()
{
  std::vector<Eigen::Matrix3d> rotations;
  int order[] = { 0, 1, 2 };
  do
  {
    for (int signs = 0; signs < 8; ++signs)
    {
      Eigen::Matrix3d rotation = Eigen::Matrix3d::Zero();
      for (int k = 0; k < 3; ++k)
      {
        rotation(k, order[k]) = (signs >> k) % 2 == 0 ? 1.0 : -1.0;
      }
      if (rotation.determinant() > 0.0)
      {
        rotations.push_back(rotation);
      }
    }
  } while (std::next_permutation(order, order + 3));
  return rotations;
}

/// Return the rotation that best maps the first direction of each pair to the second. If it is not
/// unique, it is near the smallest rotation of the first pair.
Eigen::Matrix3d fit_directions(const std::vector<std::pair<Vec3, Vec3>>& pairs)
{
  Eigen::Matrix3d rotation = minimal_rotation(pairs[0].first, pairs[0].second).toRotationMatrix();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const auto& [from, to] : pairs)
  {
    covariance += from.stableNormalized() * to.stableNormalized().transpose();
  }
  fit_rotation(covariance, rotation);
  return rotation;
}
} // namespace

std::vector<Index> joints_of_handles(const Handles& handles, const std::vector<MotionJoint>& joints)
{
  std::vector<Index> joint_of_handle(handles.size(), -1);
  std::vector<char> taken(joints.size(), 0);
  const auto same = [](const std::string& name) { return name; };
  for (std::string (*convert)(const std::string&) : { +same, &plain_name })
  {
    const std::map<std::string, Index> joint_ids = index_by_name(joints, convert);
    for (const auto& [name, handle] : index_by_name(handles, convert))
    {
      const auto joint = joint_ids.find(name);
      if (handle >= 0 && joint_of_handle[handle] < 0 && joint != joint_ids.end() &&
        joint->second >= 0 && !taken[joint->second])
      {
        joint_of_handle[handle] = joint->second;
        taken[joint->second] = 1;
      }
    }
  }
  return joint_of_handle;
}

Retarget::Retarget(const Handles& handles, const std::vector<MotionJoint>& joints)
  : handles_(handles), joints_(joints), order_(parents_first(handles)),
    joint_of_handle_(joints_of_handles(handles, joints))
{
  this->find_parents();
  this->find_axes();
  this->find_alignments();
}

void Retarget::find_parents()
{
  this->matched_parent_.assign(this->handles_.size(), -1);
  this->matched_children_.assign(this->handles_.size(), {});
  for (const Index h : this->order_)
  {
    const Index parent = this->handles_[h].parent;
    if (parent >= 0)
    {
      this->matched_parent_[h] =
        this->joint_of_handle_[parent] >= 0 ? parent : this->matched_parent_[parent];
    }
    if (this->joint_of_handle_[h] >= 0 && this->matched_parent_[h] >= 0)
    {
      this->matched_children_[this->matched_parent_[h]].push_back(h);
    }
  }
}

void Retarget::find_axes()
{
  std::vector<Vec3> heads, joint_heads;
  for (const Index h : this->order_)
  {
    if (this->joint_of_handle_[h] >= 0)
    {
      heads.push_back(this->handles_[h].head);
      joint_heads.push_back(this->joints_[this->joint_of_handle_[h]].head);
    }
  }
  if (heads.size() < 2)
  {
    return;
  }
  const double size = size_of(heads);
  const double joint_size = size_of(joint_heads);
  if (!(size > 0.0 && joint_size > 0.0))
  {
    return;
  }
  this->scale_ = size / joint_size;
  Vec3 mean = Vec3::Zero(), joint_mean = Vec3::Zero();
  for (std::size_t k = 0; k < heads.size(); ++k)
  {
    mean += heads[k] / static_cast<double>(heads.size());
    joint_mean += joint_heads[k] / static_cast<double>(heads.size());
  }
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < heads.size(); ++k)
  {
    covariance +=
      (joint_heads[k] - joint_mean) / joint_size * ((heads[k] - mean) / size).transpose();
  }
  // The fit of equal skeletons is 1. Skeletons with other rest poses keep their axes.
  const auto fit = [&](const Eigen::Matrix3d& rotation)
  { return rotation.cwiseProduct(covariance).sum() / static_cast<double>(heads.size()); };
  constexpr double good = 0.9;
  constexpr double better = 0.05;
  double best = std::max(good, fit(this->axes_) + better);
  for (const Eigen::Matrix3d& rotation : axis_rotations())
  {
    if (fit(rotation) > best)
    {
      best = fit(rotation);
      this->axes_ = rotation;
    }
  }
}

void Retarget::find_alignments()
{
  this->alignment_.assign(this->handles_.size(), Eigen::Matrix3d::Identity());
  for (const Index h : this->order_)
  {
    const Handle& handle = this->handles_[h];
    if (handle.parent >= 0)
    {
      this->alignment_[h] = this->alignment_[handle.parent];
    }
    if (this->joint_of_handle_[h] < 0)
    {
      continue;
    }
    const Vec3 joint_head = this->joints_[this->joint_of_handle_[h]].head;
    std::vector<std::pair<Vec3, Vec3>> directions;
    for (const Index child : this->matched_children_[h])
    {
      const Vec3 from = this->handles_[child].head - handle.head;
      const Vec3 to =
        this->axes_.transpose() * (this->joints_[this->joint_of_handle_[child]].head - joint_head);
      if (!from.isZero() && !to.isZero())
      {
        directions.emplace_back(from, to);
      }
    }
    if (!directions.empty())
    {
      this->alignment_[h] = fit_directions(directions);
    }
  }
}

std::vector<Index> Retarget::handles_without_joint() const
{
  std::vector<Index> result;
  for (std::size_t h = 0; h < this->handles_.size(); ++h)
  {
    if (this->joint_of_handle_[h] < 0)
    {
      result.push_back(static_cast<Index>(h));
    }
  }
  return result;
}

Vec3 Retarget::displacement(Index handle, const std::vector<Affine>& frame) const
{
  const Index joint = this->joint_of_handle_[handle];
  const Vec3 head = this->joints_[joint].head;
  const Index parent = this->joints_[joint].parent;
  const bool is_top = this->matched_parent_[handle] < 0 || parent < 0;
  return apply_affine(frame[joint], head) - (is_top ? head : apply_affine(frame[parent], head));
}

Pose Retarget::apply(
  const Pose& base, const std::vector<Affine>& frame, const std::vector<Affine>& first_frame) const
{
  Pose pose = base;
  for (const Index h : this->order_)
  {
    const Index joint = this->joint_of_handle_[h];
    if (joint < 0)
    {
      follow_parent(this->handles_, base, h, pose);
      continue;
    }
    const Vec3 head = this->handles_[h].head;
    const Vec3 moved = this->displacement(h, frame) - this->displacement(h, first_frame);
    const Vec3 position = apply_affine(inherited_transform(this->handles_, pose, h), head) +
      this->scale_ * (this->axes_.transpose() * moved);
    const Eigen::Matrix3d rotation = this->axes_.transpose() *
      parts_of(frame[joint], this->joints_[joint].head).rotation * this->axes_ *
      this->alignment_[h];
    pose[h].mode = HandleMode::full;
    pose[h].transform = affine_about(head, rotation, position - head);
  }
  return pose;
}

} // namespace bindpose
