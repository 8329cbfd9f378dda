#include "gltf_edit/gltf_weights.h"

#include <algorithm>
#include <string>

namespace bindpose
{

namespace
{
// Adding a weight of at most this size to a float of value 1 does not change the float.
constexpr float smallest_weight = 0x1p-24F;
constexpr double row_sum_tolerance = 1e-6; // tolerance of the row sums of weights

/// Return the influences that the file stores for one vertex. Their weights are at least 0 and sum
/// to one, including the weight of the joint "rest".
std::vector<GltfInfluence> influences_of(
  const Weights& weights, Index v, Index maximum_influences, GltfWeights& packed)
{
  const auto joints = weights.cols();
  std::vector<GltfInfluence> row;
  double missing_weight = 1.0;
  bool changed = false;
  for (Index j = 0; j < joints; ++j)
  {
    const double w = weights(v, j);
    missing_weight -= w;
    changed = changed || w < -row_sum_tolerance;
    if (w > smallest_weight)
    {
      row.push_back({ w, j });
    }
  }
  packed.negative_rows += changed || missing_weight < -row_sum_tolerance;
  // If the weights sum to less than one, the joint "rest" gets the missing weight. Negative weights
  // are included in this sum, but they are not stored.
  if (missing_weight > row_sum_tolerance)
  {
    row.push_back({ missing_weight, joints });
  }
  std::stable_sort(row.begin(), row.end(),
    [](const GltfInfluence& a, const GltfInfluence& b) { return a.weight > b.weight; });
  if (maximum_influences > 0 && static_cast<Index>(row.size()) > maximum_influences)
  {
    double dropped_sum = 0.0;
    for (std::size_t k = static_cast<std::size_t>(maximum_influences); k < row.size(); ++k)
    {
      dropped_sum += row[k].weight;
    }
    packed.dropped_weights += static_cast<Index>(row.size()) - maximum_influences;
    packed.dropped_weight = std::max(packed.dropped_weight, dropped_sum);
    row.resize(static_cast<std::size_t>(maximum_influences));
  }
  double sum = 0.0;
  for (const GltfInfluence& influence : row)
  {
    sum += influence.weight;
  }
  if (row.empty()) // the row sums to one, but no weight exceeds smallest_weight
  {
    return { { 1.0, joints } };
  }
  for (GltfInfluence& influence : row)
  {
    influence.weight /= sum;
  }
  return row;
}
} // namespace

GltfWeights pack_influences(const std::vector<std::vector<GltfInfluence>>& rows, Index joints)
{
  GltfWeights packed;
  std::size_t maximum_row_size = 1;
  for (const auto& row : rows)
  {
    maximum_row_size = std::max(maximum_row_size, row.size());
  }
  packed.weights_per_vertex = static_cast<Index>((maximum_row_size + 3) / 4 * 4);
  const std::size_t size = rows.size() * static_cast<std::size_t>(packed.weights_per_vertex);
  packed.joints.assign(size, 0);
  packed.weights.assign(size, 0.0F);
  for (std::size_t v = 0; v < rows.size(); ++v)
  {
    const std::size_t first_weight = v * static_cast<std::size_t>(packed.weights_per_vertex);
    float sum = 0.0F;
    for (std::size_t k = rows[v].size(); k-- > 0;)
    {
      const GltfInfluence& influence = rows[v][k];
      packed.joints[first_weight + k] = static_cast<std::uint16_t>(influence.joint);
      // The largest weight is computed from the others, so that the rounded row sums to one.
      packed.weights[first_weight + k] = k == 0 ? 1.0F - sum : static_cast<float>(influence.weight);
      sum += packed.weights[first_weight + k];
      packed.rest_joint = packed.rest_joint || influence.joint == joints;
    }
  }
  packed.joint_count = joints + (packed.rest_joint ? 1 : 0);
  return packed;
}

GltfWeights to_gltf_weights(const Weights& weights, Index maximum_influences)
{
  GltfWeights counts; // of weights that are changed or dropped
  std::vector<std::vector<GltfInfluence>> rows(static_cast<std::size_t>(weights.rows()));
  for (Index v = 0; v < weights.rows(); ++v)
  {
    rows[v] = influences_of(weights, v, maximum_influences, counts);
  }
  GltfWeights packed = pack_influences(rows, weights.cols());
  packed.dropped_weights = counts.dropped_weights;
  packed.dropped_weight = counts.dropped_weight;
  packed.negative_rows = counts.negative_rows;
  return packed;
}

void report_weights(const GltfWeights& weights, Status& status)
{
  Report& report = status.report;
  report.set("sets", weights.weights_per_vertex / 4);
  report.set("counts.dropped_weights", weights.dropped_weights);
  report.set("dropped_share", weights.dropped_weight);
  report.set("rest_joint", weights.rest_joint ? "yes" : "no");
  if (weights.negative_rows > 0)
  {
    status.warnings.push_back("the weights of " + std::to_string(weights.negative_rows) +
      " vertices were changed because glTF cannot store negative weights or weights with a sum "
      "above 1");
  }
}

void append_weights(GltfDocument& document, const GltfWeights& weights, Index begin, Index end,
  GltfDocument::Json& attributes)
{
  const bool bytes = weights.joint_count <= 256;
  for (Index set = 0; set < weights.weights_per_vertex / 4; ++set)
  {
    std::vector<std::uint8_t> small;
    std::vector<std::uint16_t> joints;
    std::vector<float> values;
    for (Index v = begin; v < end; ++v)
    {
      const Index first_weight = v * weights.weights_per_vertex + 4 * set;
      for (Index k = first_weight; k < first_weight + 4; ++k)
      {
        bytes ? small.push_back(static_cast<std::uint8_t>(weights.joints[k]))
              : joints.push_back(weights.joints[k]);
        values.push_back(weights.weights[k]);
      }
    }
    const int target = GltfDocument::array_buffer;
    attributes["JOINTS_" + std::to_string(set)] = bytes
      ? document.append_accessor(small, 4, target)
      : document.append_accessor(joints, 4, target);
    attributes["WEIGHTS_" + std::to_string(set)] = document.append_accessor(values, 4, target);
  }
}

} // namespace bindpose
