// bindpose-importer PATH > file.glb
// converts a file to glTF by the library assimp, in a separate process, because assimp may crash,
// hang or take all memory on a damaged file. Bindpose starts this program (see guarded_import.h);
// users do not call it.
#include "scene_document.h"

#include "gltf/gltf_model.h"
#include "helper/helper_start.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>

#include <unistd.h>

namespace
{
/// Opens only files in a folder, because a file may refer to any other file.
class FolderOnly : public Assimp::DefaultIOSystem
{
public:
  explicit FolderOnly(std::string folder) : folder_(std::move(folder)) {}

  bool Exists(const char* path) const override
  {
    return bindpose::is_in_folder(path, this->folder_);
  }
  Assimp::IOStream* Open(const char* path, const char* mode) override
  {
    return this->Exists(path) && mode[0] == 'r' ? DefaultIOSystem::Open(path, mode) : nullptr;
  }

private:
  std::string folder_;
};

class PrintProgress : public Assimp::ProgressHandler
{
public:
  bool Update(float fraction) override
  {
    std::fprintf(stderr, "progress %.4f\n", fraction);
    return true;
  }
};

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

void convert(const std::string& path, int result)
{
  const std::string folder = std::filesystem::path(path).parent_path().string();
  Assimp::Importer importer;
  importer.SetIOHandler(new FolderOnly(folder)); // the importer deletes both
  importer.SetProgressHandler(new PrintProgress);
  // Without this setting, FBX files have a chain of nodes for each joint.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  // Keep joints that move no vertices: their children and motions may need them.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_REMOVE_EMPTY_BONES, false);
  // Do not make a mesh of sticks for a file that has only a skeleton.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
  importer.SetPropertyInteger(
    AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene = importer.ReadFile(path,
    aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_SortByPType |
      aiProcess_GlobalScale);
  if (!scene || !scene->mRootNode)
  {
    bindpose::helper_fail(importer.GetErrorString());
  }
  std::string bytes;
  const bindpose::Status status = bindpose::to_gltf_document(*scene, folder).to_bytes(true, bytes);
  if (!status.ok() || !write_all(result, bytes))
  {
    bindpose::helper_fail(status.ok() ? "the result cannot be written" : status.message);
  }
}
} // namespace

int main(int argc, char* argv[])
{
  if (argc < 2)
  {
    bindpose::helper_fail("expected a path");
  }
  const int result = bindpose::start_helper(bindpose::helper_options(argc, argv, 1));
  try
  {
    convert(argv[1], result);
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
