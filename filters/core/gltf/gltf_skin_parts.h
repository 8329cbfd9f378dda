#ifndef bindpose_gltf_gltf_skin_parts_h
#define bindpose_gltf_gltf_skin_parts_h

#include "gltf/gltf_model.h"
#include "gltf/gltf_skin.h"

#include <vector>

namespace bindpose
{

/// The primitives that read_gltf_skin() reads.
struct GltfSkinParts
{
  int skin = -1; ///< id of the first skin that a mesh uses; -1: no mesh has a skin
  /// Primitives with triangles. Primitives with the same accessors share vertices: then `first` is
  /// that of an earlier part.
  std::vector<GltfPart> parts;
  Index vertices = 0; ///< total number of vertices
  Index meshes = 0; ///< number of nodes with these primitives
  Index omitted_meshes = 0; ///< number of nodes with a mesh that does not use the skin
  Index skipped = 0; ///< number of primitives that consist of points or lines
};

/// Find the primitives of the first skin, or all primitives if no mesh has a skin. Throw GltfError
/// for a mesh or an accessor that does not exist, and for a primitive without positions.
GltfSkinParts find_skin_parts(const tinygltf::Model& model, const GltfAccessors& accessors);

} // namespace bindpose

#endif
