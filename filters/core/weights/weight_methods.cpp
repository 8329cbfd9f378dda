// The registry of weight methods.
#include "weights/weight_methods.h"

#include "weights/baseline_weights.h"
#include "weights/bounded_biharmonic_weights.h"
#include "weights/monotone_weights.h"
#include "weights/unconstrained_weights.h"

namespace bindpose
{

const std::vector<WeightMethod>& weight_methods()
{
  static const std::vector<WeightMethod> methods{
    { "bounded-biharmonic", "Bounded biharmonic", "Bounded", true, bounded_biharmonic_weights },
    { "monotone", "Monotone", "Monotone", true, monotone_weights },
    { "harmonic", "Harmonic", "Harmonic", false, harmonic_weights },
    { "biharmonic", "Biharmonic", "Biharmonic", false, biharmonic_weights },
    { "triharmonic", "Triharmonic", "Triharmonic", false, triharmonic_weights },
    { "graph-biharmonic", "Graph biharmonic", "Graph", false, graph_biharmonic_weights },
    { "linear-subspace", "Linear subspace", "Linear subspace", false, linear_subspace_weights },
    { "inverse-distance", "Inverse distance", "Distance", false, inverse_distance_weights },
    { "smoothed-harmonic", "Smoothed harmonic", "Smoothed", false, smoothed_harmonic_weights },
    { "bone-heat", "Bone heat", "Bone heat", false, bone_heat_weights },
  };
  return methods;
}

const WeightMethod* find_weight_method(std::string_view word)
{
  for (const WeightMethod& method : weight_methods())
  {
    if (word == method.word)
    {
      return &method;
    }
  }
  return nullptr;
}

std::string weight_method_words(bool constrained)
{
  std::string words;
  for (const WeightMethod& method : weight_methods())
  {
    if (constrained || !method.constrained)
    {
      words += (words.empty() ? "" : ", ") + std::string(method.word);
    }
  }
  return words;
}

} // namespace bindpose
