#ifndef weights_arrays_h
#define weights_arrays_h

#include "BindposeFiltersModule.h" // for export macro
#include "domain/domain.h"
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

// Conversion of computed weights, their optimality certificates (duality gap and residual per
// column) and their local extrema to VTK arrays and datasets.

/// Return the array of weights: one component per handle, named after the handle.
BINDPOSEFILTERS_EXPORT vtkSmartPointer<vtkDoubleArray> to_weights_array(
  const std::string& name, const Weights& weights, const Handles& handles);

/// Return the optimality certificates of a weights array as arrays with one value per column. Their
/// names are the array's name followed by RelativeGap, KKTResidual, Minimum, Maximum,
/// InteriorExtrema, Zeros, Ones, Iterations, and RowSumError (one value in total).
BINDPOSEFILTERS_EXPORT std::vector<vtkSmartPointer<vtkDoubleArray>> to_certificate_arrays(
  const std::string& name, const WeightsResult& result);

/// Return the extrema of all columns: see output 1 of vtkWeightsAlgorithm.
vtkSmartPointer<vtkPolyData> to_extrema(const WeightsProblem& problem, const WeightsResult& result);

/// Copy the certificate arrays of a weights array from one dataset's field data to another's. The
/// old certificate arrays of this weights array in `to` are removed first.
void pass_certificates(vtkFieldData* from, vtkFieldData* to, const std::string& name);

} // namespace bindpose

#endif
