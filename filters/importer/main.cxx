// bindpose-importer convert|decompress PATH > file.glb
// converts a file of assimp's formats to glTF, or decompresses the meshes of a glTF file, in a
// separate process, because the libraries may crash, hang or take all memory on a damaged file.
// Bindpose starts this program (see guarded_import.h); users do not call it.
#include "assimp_file.h"
#include "decompressed_gltf.h"

#include "helper/helper_start.h"

#include <exception>
#include <new>
#include <string>

#include <unistd.h>

namespace
{
std::string run(const std::string& command, const std::string& path)
{
  return command == "decompress" ? bindpose::decompress_gltf(path)
                                 : bindpose::convert_by_assimp(path);
}

bool write_all(int file, const std::string& bytes)
{
  for (std::size_t done = 0; done < bytes.size();)
  {
    const ssize_t written = ::write(file, bytes.data() + done, bytes.size() - done);
    if (written <= 0)
    {
      return false;
    }
    done += static_cast<std::size_t>(written);
  }
  return true;
}
} // namespace

int main(int argc, char* argv[])
{
  if (argc < 3)
  {
    bindpose::helper_fail("expected a command and a path");
  }
  const int result = bindpose::start_helper(bindpose::helper_options(argc, argv, 2));
  try
  {
    if (!write_all(result, run(argv[1], argv[2])))
    {
      bindpose::helper_fail("the result cannot be written");
    }
  }
  catch (const std::bad_alloc&)
  {
    bindpose::helper_fail("out of memory");
  }
  catch (const std::exception& error)
  {
    bindpose::helper_fail(error.what());
  }
  bindpose::end_helper();
}
