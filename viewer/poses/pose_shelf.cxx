#include "poses/pose_shelf.h"

#include "poses/json_fields.h"

namespace bindpose
{

Json to_json(const PoseShelf& shelf)
{
  return { { "library", to_json(shelf.library) }, { "key_frames", to_json(shelf.keys) } };
}

Status from_json(const Json& json, PoseShelf& shelf)
{
  PoseShelf read;
  JsonFields fields(json, "the stored poses");
  const Json* library = fields.part("library", true);
  const Json* keys = fields.part("key_frames", false);
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
    shelf = std::move(read);
  }
  return status;
}

} // namespace bindpose
