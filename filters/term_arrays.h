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

/// Names of the mesh's point arrays that say what is asked of weights (see vtkWeightsAlgorithm).
/// An empty name: not looked for.
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

/// What the mesh's arrays ask for; what is not there is off. invalid_input where an array has the
/// wrong number of components, or a label or id is no whole number.
Status to_terms(
  vtkDataSet* mesh, const TermArrayNames& names, Index handle_count, WeightTerms& terms);

/// The cell array of a handle dataset with two components: least and largest weight of a handle.
constexpr const char* handle_bounds_name = "WeightBounds";

/// Its values, `everywhere` where they are NaN; nothing where there is no array and `everywhere` is
/// 0, 1.
/// @param cells of the dataset, one a handle.
Status to_handle_bounds(vtkPolyData* handles, const std::vector<Index>& cells,
  const double (&everywhere)[2], WeightTerms& terms);

} // namespace bindpose

#endif
