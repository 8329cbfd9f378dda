#ifndef bindpose_weights_weight_methods_h
#define bindpose_weights_weight_methods_h

#include "weights/weights_problem.h"

#include <string_view>

namespace bindpose
{

/// A kernel that computes weights.
using WeightsKernel = Status (*)(
  const WeightsProblem&, const WeightsOptions&, ExecutionContext&, WeightsResult&);

/// A method that computes weights. A new method is its kernel and one row in weight_methods(); the
/// filter vtkUnconstrainedWeights, the window and the program find it there.
struct WeightMethod
{
  const char* word; ///< on the command line, in Python, in reports and in session files
  const char* label; ///< in lists of the window
  const char* short_label; ///< in narrow lines of the window
  bool constrained; ///< has bounds, terms and influences; otherwise it is for comparison
  WeightsKernel kernel;
};

/// Return all methods: bounded biharmonic and monotone weights first.
const std::vector<WeightMethod>& weight_methods();
/// Return the method of a word; null if it is unknown.
const WeightMethod* find_weight_method(std::string_view word);
/// Return the words, with commas between, for error messages.
/// @param constrained  whether constrained methods are included
std::string weight_method_words(bool constrained);

} // namespace bindpose

#endif
