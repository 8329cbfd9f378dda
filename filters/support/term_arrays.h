#ifndef term_arrays_h
#define term_arrays_h

#include "BindposeFiltersModule.h" // for export macro
#include "weights/weight_terms.h"

#include <string>
#include <vector>

class vtkDataSet;
class vtkPolyData;

namespace bindpose
{

/// Names of the mesh's point arrays that contain terms. Terms are optional constraints and energies
/// that a user adds to the optimization problem of weights: rigidity, rigid sets, bounds, pinned
/// weights and mirror symmetry (see vtkWeightsAlgorithm). An empty name disables the array.
struct TermArrayNames
{
  std::string rigidity = "Rigidity";
  std::string rigid_sets = "RigidSet";
  std::string lower = "WeightsLower";
  std::string upper = "WeightsUpper";
  std::string pinned = "PinnedWeights";
  std::string mirror = "SymmetricPoint";

  std::vector<std::string> all() const;
};

/// Convert the mesh's arrays to terms of the weights problem (see TermArrayNames); a missing array
/// disables its term. Return invalid_input if an array has the wrong number of components, or a
/// label or id is not an integer.
Status to_terms(
  vtkDataSet* mesh, const TermArrayNames& names, Index handle_count, WeightTerms& terms);

/// Name of a cell array of handle datasets. Its two components are the smallest and the largest
/// weight of each handle.
constexpr const char* handle_bounds_name = "WeightBounds";

/// Read the bounds of the handles' weights from the array handle_bounds_name. NaN, or a missing
/// array, is replaced by the default `everywhere` (lower, upper). If there is no array and
/// `everywhere` is (0, 1), the terms have no bounds.
/// @param cells  cells of the dataset, one per handle
Status to_handle_bounds(vtkPolyData* handles, const std::vector<Index>& cells,
  const double (&everywhere)[2], WeightTerms& terms);

} // namespace bindpose

#endif
