#include "poses/pose_library.h"

#include "poses/json_fields.h"

namespace bindpose
{

bool PoseLibrary::has_name(const std::string& name) const
{
  for (const Entry& entry : this->entries_)
  {
    if (entry.name == name)
    {
      return true;
    }
  }
  return false;
}

std::string PoseLibrary::store(const std::string& name, NamedPose pose)
{
  const std::string base_name = name.empty() ? "pose" : name;
  std::string unique_name = base_name;
  for (int number = 2; this->has_name(unique_name); ++number)
  {
    unique_name = base_name + " " + std::to_string(number);
  }
  this->entries_.push_back({ unique_name, std::move(pose) });
  return unique_name;
}

bool PoseLibrary::rename(std::size_t entry, const std::string& name)
{
  if (entry >= this->entries_.size() || name.empty())
  {
    return false;
  }
  if (name != this->entries_[entry].name && this->has_name(name))
  {
    return false;
  }
  this->entries_[entry].name = name;
  return true;
}

void PoseLibrary::remove(std::size_t entry)
{
  if (entry < this->entries_.size())
  {
    this->entries_.erase(this->entries_.begin() + static_cast<std::ptrdiff_t>(entry));
  }
}

void PoseLibrary::rename_handle(const std::string& from, const std::string& to)
{
  for (Entry& entry : this->entries_)
  {
    entry.pose.rename(from, to);
  }
}

Json to_json(const PoseLibrary& library)
{
  Json result = Json::array();
  for (const PoseLibrary::Entry& entry : library.entries())
  {
    result.push_back({ { "name", entry.name }, { "handles", to_json(entry.pose) } });
  }
  return result;
}

Status from_json(const Json& json, PoseLibrary& library)
{
  if (!json.is_array())
  {
    return Status::invalid_input("the pose library must be a list");
  }
  PoseLibrary read;
  for (const Json& entry : json)
  {
    std::string name;
    NamedPose pose;
    JsonFields fields(entry, "a pose in the pose library");
    fields.read("name", name);
    const Json* handles = fields.member("handles", false);
    Status status = fields.status();
    if (status.ok() && handles)
    {
      status = from_json(*handles, pose);
    }
    if (!status.ok())
    {
      return status;
    }
    read.store(name, std::move(pose));
  }
  library = std::move(read);
  return {};
}

} // namespace bindpose
