#ifndef bindpose_weights_weight_methods_h
#define bindpose_weights_weight_methods_h

#include "weights/weights_problem.h"

#include <string_view>

namespace bindpose
{

/// A kernel that computes weights.
using WeightsKernel = Status (*)(
  ExecutionContext&, const WeightsProblem&, const WeightsOptions&, WeightsResult&);

/// A method that computes weights. To add a method, write its kernel and add one row to
/// weight_methods(). The filter vtkUnconstrainedWeights, the window of the viewer and the command
/// line read this list.
struct WeightMethod
{
  const char* word; ///< name on the command line, in Python, in reports and in session files
  const char* label; ///< name in lists of the viewer's window
  const char* short_label; ///< name in narrow rows of the viewer's window
  /// Whether the method supports bounds, optional terms and a limit on influences. Methods without
  /// this support are for comparison.
  bool constrained;
  WeightsKernel kernel;
};

/// Return all methods: bounded biharmonic and monotone weights first.
const std::vector<WeightMethod>& weight_methods();
/// Return the method with the given `word`; null if there is none.
const WeightMethod* find_weight_method(std::string_view word);
/// Return the `word` of each method, separated by commas, for error messages.
/// @param constrained true: all methods; false: only methods with `constrained` == false
std::string weight_method_words(bool constrained);

} // namespace bindpose

#endif
