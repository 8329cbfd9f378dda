#ifndef weights_arrays_h
#define weights_arrays_h

#include "BindposeFiltersModule.h" // for export macro
#include "weights/domain.h"
#include "weights/weights_problem.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkDataSet;
class vtkDoubleArray;
class vtkFieldData;
class vtkPolyData;

namespace bindpose
{

/// The array of weights: a component a handle, named after it.
BINDPOSEFILTERS_EXPORT vtkSmartPointer<vtkDoubleArray> to_weights_array(
  const std::string& name, const Weights& weights, const Handles& handles);

/// The certificates of a weights array as arrays of a value a column: NAME followed by RelativeGap,
/// KKTResidual, Minimum, Maximum, InteriorExtrema, Zeros, Ones, Iterations, and RowSumError (one
/// value).
BINDPOSEFILTERS_EXPORT std::vector<vtkSmartPointer<vtkDoubleArray>> to_certificate_arrays(
  const std::string& name, const WeightsResult& result);

/// The extrema of all columns: see output 1 of vtkWeightsAlgorithm.
vtkSmartPointer<vtkPolyData> to_extrema(const WeightsProblem& problem, const WeightsResult& result);

/// Hands the certificates of a weights array on from one dataset's field data to another's; what
/// the other had of that name goes.
void pass_certificates(vtkFieldData* from, vtkFieldData* to, const std::string& name);

} // namespace bindpose

#endif
