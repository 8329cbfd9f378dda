#ifndef bindpose_look_mtl_materials_h
#define bindpose_look_mtl_materials_h

// Materials of OBJ and PLY files in a glTF document.

#include "gltf_edit/gltf_document.h"

#include <map>
#include <string>
#include <vector>

namespace bindpose
{

/// Append the materials of an MTL file, with their pictures, to a document. Colors and the
/// opacity become the base color; Pm, Pr (or the specular exponent), Ke, norm (or map_Bump) and the
/// pictures map_Kd, map_Ke become the properties of glTF with the same meaning. OBJ files do not
/// distinguish the sides of a face, so materials are double-sided. A picture is searched at its
/// path in the folder, then by its file name alone; if it is missing or cannot be read, it is left
/// out with a warning. Throw GltfError for a picture outside of the folder, and for one that is too
/// large (see check_picture_header()).
/// @param text content of the MTL file
/// @param folder folder of the MTL file
/// @param names names of the materials to append
/// @param ids ids of the materials in the document, by name; those that it contains are not
/// appended
void append_mtl_materials(const std::string& text, const std::string& folder,
  const std::vector<std::string>& names, GltfDocument& document, std::map<std::string, int>& ids,
  std::vector<std::string>& warnings);

/// Append a double-sided white material with a picture, and return its id. Pictures that are
/// missing, unknown or outside of the folder are handled as in append_mtl_materials().
int append_picture_material(const std::string& name, const std::string& picture,
  const std::string& folder, GltfDocument& document, std::vector<std::string>& warnings);

} // namespace bindpose

#endif
