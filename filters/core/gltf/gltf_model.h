#ifndef bindpose_gltf_gltf_model_h
#define bindpose_gltf_gltf_model_h

// A parsed glTF file: checked access to the values of accessors and to the hierarchy of nodes.
// tinygltf parses the file. Its output is not trusted: every index, count and offset is checked
// before a value is read from a buffer.

#include "base/status.h"
#include "geometry/mesh.h"
#include "gltf/gltf_transform.h"
#include "gltf/tiny_gltf.h"

#include <array>
#include <cstddef>
#include <exception>
#include <string>
#include <utility>
#include <vector>

namespace bindpose
{

/// Exception for an error in a glTF file. The message of the status is the file's path followed by
/// `sentence`.
struct GltfError : std::exception
{
  explicit GltfError(std::string text) : sentence(std::move(text)) {}
  const char* what() const noexcept override { return this->sentence.c_str(); }
  std::string sentence;
};

/// The buffer files to which a glTF file refers.
struct GltfBufferFiles
{
  std::string folder; ///< the folder of the glTF file
  std::vector<std::string> paths; ///< the files that were read
};

/// Report whether a path is a regular file in a folder or below it; links are followed. Other files
/// are refused, because a glTF file is untrusted.
bool is_in_folder(const std::string& path, const std::string& folder);

/// Parse the content of a .gltf or .glb file. Buffers are read. Images in the JSON text are kept as
/// bytes; other images are not read. Throw GltfError for a file that is not valid, another version
/// than 2.0, and required extensions that could change the geometry.
tinygltf::Model parse_gltf(const std::string& content, GltfBufferFiles& files);

/// Return an element of a list. Throw GltfError if there is no such element.
template <typename Element>
const Element& gltf_element(const std::vector<Element>& list, int id, const char* item_name)
{
  if (id < 0 || static_cast<std::size_t>(id) >= list.size())
  {
    throw GltfError(std::string(item_name) + " " + std::to_string(id) +
      " does not exist; the file has " + std::to_string(list.size()));
  }
  return list[static_cast<std::size_t>(id)];
}

using GltfNumbers = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Reads the values of accessors. The model must outlive this object. All functions throw GltfError
/// for values that do not fit into the file.
class GltfAccessors
{
public:
  /// @param file_size size of the glTF file in bytes. No accessor may have more elements than the
  /// file and its buffers have bytes.
  GltfAccessors(const tinygltf::Model& model, std::size_t file_size);

  /// Return the number of elements of an accessor. Throw GltfError if it is zero or larger than the
  /// file.
  Index count(int id, const char* item_name) const;
  /// Read all values of an accessor, one element per row.
  /// @param type number of components, as a constant of tinygltf.
  /// @param item_name name of the values in error messages.
  GltfNumbers read(int id, int type, const char* item_name) const;
  /// Read an accessor and check that all values are finite.
  GltfNumbers read_finite(int id, int type, const char* item_name) const;
  /// Read an accessor and check that its values are unsigned integers.
  GltfNumbers read_ids(int id, int type, const char* item_name) const;

private:
  struct View
  {
    const unsigned char* data;
    std::size_t stride;
  };

  View view(
    int id, std::size_t offset, std::size_t count, std::size_t size, const char* item_name) const;
  void replace(const tinygltf::Accessor& accessor, int columns, std::size_t size,
    const char* item_name, GltfNumbers& numbers) const;

  const tinygltf::Model& model_;
  std::size_t bytes_ = 0;
};

/// Read an attribute with one row per vertex. Return a matrix without rows if it is missing. Throw
/// GltfError for another number of rows.
/// @param vertices expected number of rows; -1: any
/// @param ids whether the values are unsigned integers
GltfNumbers read_gltf_attribute(const GltfAccessors& accessors,
  const tinygltf::Primitive& primitive, const char* name, int type, Index vertices,
  bool ids = false);

/// Return the type of the attribute COLOR_0 of a primitive: VEC3 or VEC4, as a constant of
/// tinygltf.
int gltf_color_type(const tinygltf::Model& model, const tinygltf::Primitive& primitive);

/// Return the inverse bind matrices of a skin, one per joint. They are the identity if the skin has
/// none. Throw GltfError if there are fewer matrices than joints.
std::vector<Eigen::Affine3d> read_inverse_binds(
  const GltfAccessors& accessors, const tinygltf::Skin& skin);

/// Report whether a primitive consists of triangles: a list, a strip or a fan.
bool has_triangles(const tinygltf::Primitive& primitive);
/// Return the triangles of a primitive with `vertices` vertices. Throw GltfError if a triangle is
/// not complete or has an unknown vertex.
std::vector<std::array<Index, 3>> read_gltf_triangles(
  const GltfAccessors& accessors, const tinygltf::Primitive& primitive, Index vertices);

/// Return the triangles as a matrix.
Triangles to_matrix(const std::vector<std::array<Index, 3>>& triangles);

/// The local transform of a node: a matrix, or translation, rotation and scale.
struct GltfNodeTransform
{
  bool has_matrix = false;
  Eigen::Affine3d matrix = Eigen::Affine3d::Identity();
  Trs trs;

  Eigen::Affine3d affine() const { return this->has_matrix ? this->matrix : this->trs.affine(); }
};

/// Set the rotation to the normalized quaternion q (x, y, z, w). Throw GltfError if its length is
/// zero.
void set_rotation(const Eigen::Vector4d& q, Trs& trs);

/// The hierarchy of the nodes.
struct GltfNodes
{
  std::vector<GltfNodeTransform> node_transforms;
  std::vector<int> parents; ///< id of the parent node, or -1
  std::vector<int> order; ///< all nodes; parents come before their children

  /// Return the node-to-scene transforms.
  std::vector<Eigen::Affine3d> scene_transforms() const;
};

/// Read the nodes. Throw GltfError for invalid transforms, nodes with two parents, and cycles.
GltfNodes read_gltf_nodes(const tinygltf::Model& model);

} // namespace bindpose

#endif
