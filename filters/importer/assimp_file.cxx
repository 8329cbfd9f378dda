#include "assimp_file.h"

#include <stdexcept>

#ifdef BINDPOSE_HAS_ASSIMP
#include "scene_document.h"

#include "gltf/gltf_model.h"
#include "io/text_scanner.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
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

/// Throw std::runtime_error for a reference to a vertex that is missing.
/// @param name of the mesh, for the message
void check_vertex(unsigned int vertex, const aiMesh& mesh, const std::string& name)
{
  if (vertex >= mesh.mNumVertices)
  {
    throw std::runtime_error(name + " refers to vertex " + std::to_string(vertex) +
      ", but it has " + std::to_string(mesh.mNumVertices) + " vertices");
  }
}

/// Throw std::runtime_error for references to missing vertices, for coordinates that are not
/// finite, and for morph targets of another size. Processing steps of assimp would read out of
/// bounds.
void check_meshes(const aiScene& scene)
{
  for (unsigned int m = 0; m < scene.mNumMeshes; ++m)
  {
    const aiMesh& mesh = *scene.mMeshes[m];
    const std::string name = "the mesh '" + sanitize_line(mesh.mName.C_Str()) + "'";
    for (unsigned int v = 0; v < mesh.mNumVertices; ++v)
    {
      const aiVector3D& at = mesh.mVertices[v];
      if (!std::isfinite(at.x) || !std::isfinite(at.y) || !std::isfinite(at.z))
      {
        throw std::runtime_error(
          name + " has a coordinate that is not finite, at vertex " + std::to_string(v));
      }
    }
    for (unsigned int f = 0; f < mesh.mNumFaces; ++f)
    {
      const aiFace& face = mesh.mFaces[f];
      std::for_each(face.mIndices, face.mIndices + face.mNumIndices,
        [&](unsigned int vertex) { check_vertex(vertex, mesh, name); });
    }
    for (unsigned int b = 0; b < mesh.mNumBones; ++b)
    {
      const aiBone& bone = *mesh.mBones[b];
      std::for_each(bone.mWeights, bone.mWeights + bone.mNumWeights,
        [&](const aiVertexWeight& weight) { check_vertex(weight.mVertexId, mesh, name); });
    }
    for (unsigned int t = 0; t < mesh.mNumAnimMeshes; ++t)
    {
      if (mesh.mAnimMeshes[t]->mNumVertices != mesh.mNumVertices)
      {
        throw std::runtime_error(name + " has a morph target of " +
          std::to_string(mesh.mAnimMeshes[t]->mNumVertices) + " vertices; expected " +
          std::to_string(mesh.mNumVertices));
      }
    }
  }
}

/// Return the reason for which assimp cannot read a file. Its own text may be empty, or contain the
/// path.
std::string reason_of(const Assimp::Importer& importer, const std::string& path)
{
  std::string reason = importer.GetErrorString();
  const std::string name = std::filesystem::path(path).filename().string();
  for (auto at = reason.find(path); at != std::string::npos; at = reason.find(path, at))
  {
    reason.replace(at, path.size(), name);
    at += name.size();
  }
  return reason.empty() ? "assimp found no model in it" : reason;
}
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
  const aiScene* scene = importer.ReadFile(path, 0);
  if (scene)
  {
    check_meshes(*scene);
    scene = importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
      aiProcess_SortByPType | aiProcess_GlobalScale);
  }
  if (!scene || !scene->mRootNode)
  {
    throw std::runtime_error(reason_of(importer, path));
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
