#include "poses/stored_poses.h"

#include "poses/json_fields.h"

namespace bindpose
{

Json to_json(const StoredPoses& stored_poses)
{
  return { { "library", to_json(stored_poses.library) },
    { "key_frames", to_json(stored_poses.keys) } };
}

Status from_json(const Json& json, StoredPoses& stored_poses)
{
  StoredPoses read;
  JsonFields fields(json, "the stored poses");
  const Json* library = fields.member("library", true);
  const Json* keys = fields.member("key_frames", false);
  Status status = fields.status();
  if (status.ok() && library)
  {
    status = from_json(*library, read.library);
  }
  if (status.ok() && keys)
  {
    status = from_json(*keys, read.keys);
  }
  if (status.ok())
  {
    stored_poses = std::move(read);
  }
  return status;
}

} // namespace bindpose
