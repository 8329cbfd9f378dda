#include "assimp_file.h"

#include <stdexcept>

#ifdef BINDPOSE_HAS_ASSIMP
#include "scene_document.h"

#include "gltf/gltf_model.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <cstdio>
#include <filesystem>
#endif

namespace bindpose
{

#ifdef BINDPOSE_HAS_ASSIMP

namespace
{
/// Opens only files in a folder, because a file may refer to any other file.
class FolderOnly : public Assimp::DefaultIOSystem
{
public:
  explicit FolderOnly(std::string folder) : folder_(std::move(folder)) {}

  bool Exists(const char* path) const override { return is_in_folder(path, this->folder_); }
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
} // namespace

std::string convert_by_assimp(const std::string& path)
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
    throw std::runtime_error(importer.GetErrorString());
  }
  std::string bytes;
  const Status status = to_gltf_document(*scene, folder).to_bytes(true, bytes);
  if (!status.ok())
  {
    throw std::runtime_error(status.message);
  }
  return bytes;
}

#else

std::string convert_by_assimp(const std::string&)
{
  throw std::runtime_error("Bindpose was built without assimp (Debian package libassimp-dev)");
}

#endif

} // namespace bindpose
