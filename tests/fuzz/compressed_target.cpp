#include "fuzz/compressed_target.h"

#include "decompressed_gltf.h"

#include "gltf/gltf_compression.h"
#include "gltf/gltf_file.h"
#include "gltf/gltf_scene_meshes.h"

#include "fuzz/memory_file.h"
#include "fuzz/status_checks.h"

namespace bindpose::test
{

bool check_compressed(std::string_view input)
{
  const MemoryFile file(input);
  std::string bytes;
  try
  {
    bytes = decompress_gltf(file.path());
  }
  catch (const GltfError& error)
  {
    expect_refused(Status::invalid_input(error.sentence));
    return false;
  }
  EXPECT_FALSE(find_compression(bytes, ".").is_required);
  const Status status = read_gltf_bytes("decompressed.glb", bytes,
    [](const GltfContent& content, Status& found)
    { read_gltf_scene(content.model, content.bytes.size(), found); });
  if (!status.ok())
  {
    expect_refused(status);
    return false;
  }
  expect_valid_messages(status);
  return true;
}

} // namespace bindpose::test
