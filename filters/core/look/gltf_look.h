#ifndef bindpose_look_gltf_look_h
#define bindpose_look_gltf_look_h

// The look of the meshes in a glTF file.

#include "gltf/gltf_file.h"
#include "gltf/gltf_skin.h"
#include "look/surface_look.h"

#include <string>
#include <vector>

namespace bindpose
{

/// Read the materials, textures and vertex colors of primitives. Triangles of nodes that mirror
/// their mesh are flipped, so that their fronts stay outside. Throw GltfError for attributes that
/// do not match, for pictures outside of the folder, and for pictures that are too large
/// (see check_picture_header()). Pictures that cannot be read are left out,
/// with a warning. All textures of a material use the texture coordinates, and the transform of the
/// extension KHR_texture_transform, of its first texture in this order: base color, normal,
/// metallic and roughness, emission, occlusion.
/// @param parts the primitives; first + k is the point of the surface for vertex k
/// @param point_count number of points of the surface; all vertices of the parts are below it
SurfaceLook read_gltf_look(const GltfContent& content, const std::vector<GltfPart>& parts,
  Index point_count, std::vector<std::string>& warnings);

} // namespace bindpose

#endif
