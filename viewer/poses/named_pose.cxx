#include "poses/named_pose.h"

#include "pose/handle_hierarchy.h"
#include "poses/json_fields.h"

#include <algorithm>
#include <map>

namespace bindpose
{

NamedPose::NamedPose(const Handles& handles, Pose pose) : pose_(std::move(pose))
{
  for (const Handle& handle : handles)
  {
    this->names_.push_back(handle.name);
  }
}

Pose NamedPose::for_handles(const Handles& handles, const Pose& base) const
{
  std::map<std::string, std::size_t> index_of;
  for (std::size_t k = 0; k < this->names_.size(); ++k)
  {
    index_of[this->names_[k]] = k;
  }
  Pose result = base;
  for (const Index handle : parents_first(handles))
  {
    const auto k = static_cast<std::size_t>(handle);
    const auto found = index_of.find(handles[k].name);
    if (found != index_of.end() && k < result.size())
    {
      result[k] = this->pose_[found->second];
    }
    else if (base.size() == handles.size())
    {
      follow_parent(handles, base, handle, result);
    }
  }
  return result;
}

void NamedPose::rename(const std::string& from, const std::string& to)
{
  const auto found = std::find(this->names_.begin(), this->names_.end(), from);
  if (found == this->names_.end() || from == to)
  {
    return;
  }
  const auto renamed = found - this->names_.begin();
  *found = to;
  for (auto k = static_cast<std::ptrdiff_t>(this->names_.size()) - 1; k >= 0; --k)
  {
    if (k != renamed && this->names_[static_cast<std::size_t>(k)] == to)
    {
      this->names_.erase(this->names_.begin() + k);
      this->pose_.erase(this->pose_.begin() + k);
    }
  }
}

Json to_json(const NamedPose& pose)
{
  Json result = Json::object();
  for (std::size_t k = 0; k < pose.names_.size(); ++k)
  {
    const HandlePose& handle = pose.pose_[k];
    result[pose.names_[k]] = { { "mode", to_string(handle.mode) },
      { "transform", std::vector<double>(handle.transform.data(), handle.transform.data() + 12) },
      { "stretch", handle.stretch },
      { "twist", std::vector<double>{ handle.twist[0], handle.twist[1] } } };
  }
  return result;
}

Status from_json(const Json& json, NamedPose& pose)
{
  if (!json.is_object())
  {
    return Status::invalid_input("a pose must be an object with one key per handle");
  }
  NamedPose read;
  for (const auto& [name, entry] : json.items())
  {
    HandlePose handle;
    JsonFields fields(entry, "the pose of '" + name + "'");
    fields.read("mode", handle.mode, handle_mode_words);
    fields.read("transform", handle.transform.data(), 12);
    fields.read("stretch", handle.stretch, 1e-6, 1e6);
    fields.read("twist", handle.twist.data(), 2);
    if (!fields.status().ok())
    {
      return fields.status();
    }
    read.names_.push_back(name);
    read.pose_.push_back(handle);
  }
  pose = std::move(read);
  return {};
}

} // namespace bindpose
