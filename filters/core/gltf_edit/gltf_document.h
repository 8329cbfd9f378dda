#ifndef bindpose_gltf_edit_gltf_document_h
#define bindpose_gltf_edit_gltf_document_h

// The JSON text and the binary data of a glTF file, for edits that keep everything else.

#include "base/status.h"
#include "geometry/mesh.h"
#include "gltf/gltf_images.h"
#include "gltf/gltf_transform.h"
#include "gltf/tiny_gltf.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

namespace bindpose
{

/// A glTF 2.0 file as a tree of JSON values and one buffer. Values that are not edited keep their
/// bits, and their order in the JSON text. Bytes of the buffer never change; new data is appended.
class GltfDocument
{
public:
  using Json = nlohmann::ordered_json;

  /// Create an empty document.
  /// @param convert converts pictures in formats that glTF does not allow; null: they are refused
  explicit GltfDocument(ConvertPicture convert = nullptr);
  /// Take over a file that parse_gltf() has accepted. All buffers are joined into one. External
  /// images are read from `folder` and stored in the buffer; those that cannot be read remain
  /// external, with a warning. Throw GltfError for an image outside of `folder`, and for one that
  /// is too large (see check_picture_header()).
  GltfDocument(const std::string& content, const tinygltf::Model& model, const std::string& folder,
    std::vector<std::string>& warnings, ConvertPicture convert = nullptr);

  /// References to values are not valid after a change that adds a list to the document.
  Json& json() { return this->json_; }
  const Json& json() const { return this->json_; }
  /// Return a list of the document, such as "nodes". Create it if it is missing.
  Json& list(const char* name);
  /// Append an element to a list and return its id.
  int append(const char* list, Json element);

  /// Append an accessor for `values` with its own buffer view, and return its id.
  /// @param components number of components per element: 1, 2, 3, 4 or 16
  /// @param target how GPUs use the data: array_buffer, element_array_buffer, or 0 for other data
  template <typename Number>
  int append_accessor(const std::vector<Number>& values, int components, int target)
  {
    static_assert(std::is_same_v<Number, float> || std::is_unsigned_v<Number>);
    constexpr int type = std::is_same_v<Number, float> ? TINYGLTF_COMPONENT_TYPE_FLOAT
      : sizeof(Number) == 1                            ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE
      : sizeof(Number) == 2                            ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT
                                                       : TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    return this->append_accessor(
      values.data(), sizeof(Number), values.size(), components, type, target);
  }
  /// Append an accessor for the rows of a matrix as floats, with the minimum and maximum of each
  /// column.
  template <typename Matrix>
  int append_rows(const Matrix& rows, int target = array_buffer);
  /// Append a buffer view for `bytes`, and return its id.
  int append_view(const void* bytes, std::size_t size, int target);

  /// Append a picture and return the id of the image, or -1 if its bytes are neither PNG nor JPEG
  /// and cannot be converted.
  /// @param name file name, whose extension may determine the format
  int append_image(std::string bytes, const std::string& name);

  /// Set `content` to the bytes of the document as .glb, or as .gltf with the buffer as base64.
  /// Return invalid_input if the file has more than 4 GB, or if a text is not UTF-8.
  Status to_bytes(bool binary, std::string& content) const;
  /// Write the document as .glb, or as .gltf with the buffer as base64 in the same file. Return
  /// invalid_input if the file cannot be written, has more than 4 GB, or if a text is not UTF-8.
  /// Report: file_bytes.
  Status write(const std::string& path, bool binary) const;

  /// Maximum size of a file in bytes; a .glb file stores its size in 32 bits.
  static constexpr std::size_t largest_file = 0xf0000000;
  static constexpr int array_buffer = TINYGLTF_TARGET_ARRAY_BUFFER;
  static constexpr int element_array_buffer = TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER;

private:
  /// @param count number of values, of `size` bytes each
  int append_accessor(
    const void* values, std::size_t size, std::size_t count, int components, int type, int target);
  void join_buffers(const tinygltf::Model& model);
  void embed_images(
    const tinygltf::Model& model, const std::string& folder, std::vector<std::string>& warnings);
  void remove_images(const std::vector<std::size_t>& ids);
  std::string use_format(std::string& bytes, const std::string& name) const;

  Json json_;
  std::string buffer_;
  ConvertPicture convert_; ///< may be null
  std::string further_chunks_; ///< chunks of a .glb file after the JSON text and the buffer
};

/// Report whether all values are finite and within the range of float.
template <typename Matrix>
bool fits_in_float(const Matrix& matrix)
{
  return matrix.size() == 0 ||
    (matrix.allFinite() &&
      matrix.cwiseAbs().maxCoeff() <= static_cast<double>(std::numeric_limits<float>::max()));
}

/// Return the components of a vector, or those of a quaternion in glTF's order x, y, z, w.
GltfDocument::Json to_gltf_json(const Vec3& v);
GltfDocument::Json to_gltf_json(const Eigen::Quaterniond& q);
/// Set translation, rotation and scale of a node.
void set_transform(GltfDocument::Json& node, const Trs& trs);

template <typename Matrix>
int GltfDocument::append_rows(const Matrix& rows, int target)
{
  std::vector<float> values(static_cast<std::size_t>(rows.size()));
  for (Index k = 0; k < rows.size(); ++k)
  {
    values[k] = static_cast<float>(rows.data()[k]);
  }
  const int accessor = this->append_accessor(values, static_cast<int>(rows.cols()), target);
  Json minimum = Json::array(), maximum = Json::array();
  for (Index c = 0; c < rows.cols() && rows.rows() > 0; ++c)
  {
    float low = values[c], high = values[c];
    for (std::size_t k = c; k < values.size(); k += static_cast<std::size_t>(rows.cols()))
    {
      low = std::min(low, values[k]);
      high = std::max(high, values[k]);
    }
    minimum.push_back(low);
    maximum.push_back(high);
  }
  this->list("accessors")[accessor]["min"] = std::move(minimum);
  this->list("accessors")[accessor]["max"] = std::move(maximum);
  return accessor;
}

} // namespace bindpose

#endif
