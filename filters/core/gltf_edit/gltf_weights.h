#ifndef bindpose_gltf_edit_gltf_weights_h
#define bindpose_gltf_edit_gltf_weights_h

// The weights of a skin in the form in which glTF stores them.

#include "geometry/mesh.h"
#include "gltf_edit/gltf_document.h"

#include <cstdint>
#include <vector>

namespace bindpose
{

/// The weights as stored in the file: `weights_per_vertex` weights per vertex, the largest first.
struct GltfWeights
{
  Index weights_per_vertex = 0; ///< number of stored weights per vertex, a multiple of 4
  std::vector<std::uint16_t> joints;
  std::vector<float> weights;
  bool rest_joint = false; ///< whether there is an additional joint "rest" after all others
  Index joint_count = 0; ///< number of joints, including "rest"
  Index dropped_weights = 0; ///< number of weights that were dropped
  double dropped_weight = 0.0; ///< largest sum of the dropped weights of one row
  Index negative_rows = 0; ///< number of rows with a negative weight or a sum above one
};

/// A weight of a joint at a vertex.
struct GltfInfluence
{
  double weight;
  Index joint;
};

/// Store the influences of each vertex. The weights of a vertex sum to one, and the largest is the
/// first.
/// @param joints number of joints; an influence of the joint with this index is that of "rest"
GltfWeights pack_influences(const std::vector<std::vector<GltfInfluence>>& rows, Index joints);

/// Convert weights (#V x #joints) to the form of glTF. Weights of at most 2^-24 are omitted. Rows
/// whose sum is below one get the joint "rest", with the index #joints. Negative weights are
/// omitted, and rows whose sum is above one are divided by it.
/// @param maximum_influences maximum number of weights kept per vertex; 0: no limit
GltfWeights to_gltf_weights(const Weights& weights, Index maximum_influences);

/// Report sets, counts.dropped_weights, dropped_share and rest_joint (see write_gltf_skin()). Add a
/// warning if weights were changed.
void report_weights(const GltfWeights& weights, Status& status);

/// Append accessors for the rows [begin, end) of the weights, and store their ids as the attributes
/// JOINTS_n and WEIGHTS_n of a primitive.
void append_weights(GltfDocument& document, const GltfWeights& weights, Index begin, Index end,
  GltfDocument::Json& attributes);

} // namespace bindpose

#endif
