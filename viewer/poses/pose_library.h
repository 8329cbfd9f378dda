#ifndef bindpose_poses_pose_library_h
#define bindpose_poses_pose_library_h

#include "poses/named_pose.h"

namespace bindpose
{

/// A list of named poses, in the order in which they were stored.
class PoseLibrary
{
public:
  struct Entry
  {
    std::string name;
    NamedPose pose;
  };
  const std::vector<Entry>& entries() const { return this->entries_; }

  /// Store a pose under a unique name, and return that name: a second "pose" becomes "pose 2".
  std::string store(const std::string& name, NamedPose pose);
  /// Rename an entry. Return false and change nothing if the name is empty or belongs to another
  /// entry.
  bool rename(std::size_t entry, const std::string& name);
  void remove(std::size_t entry);
  void clear() { this->entries_.clear(); }
  void rename_handle(const std::string& from, const std::string& to);

private:
  bool has_name(const std::string& name) const;

  std::vector<Entry> entries_;
};

/// Return [{"name": …, "handles": {…}}, …].
nlohmann::ordered_json to_json(const PoseLibrary& library);
Status from_json(const nlohmann::ordered_json& json, PoseLibrary& library);

} // namespace bindpose

#endif
