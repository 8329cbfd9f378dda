#ifndef weights_input_h
#define weights_input_h

#include "BindposeFiltersModule.h" // for export macro
#include "conversion.h"

#include <string>
#include <vector>

class vtkDataArray;
class vtkDataSet;
class vtkPointSet;
class vtkPolyData;

namespace bindpose
{

/// Check that weights were computed for a mesh and its handles: there is one row per point and one
/// column per handle, and named columns have the names of the handles.
BINDPOSEFILTERS_EXPORT Status check_weights(
  vtkDataArray* weights, vtkIdType points, const Handles& handles);

/// Weights of a mesh, and the handles for which they were computed.
struct WeightsInput
{
  SharedMatrix<Weights> weights; ///< #V x #handles
  Handles handles;
  std::vector<Index> cells; ///< cells of the handle dataset, one per handle
};

/// Convert the handles, and the mesh's point array `array_name` of weights. Return invalid_input
/// - if the mesh or the handle dataset is null, or the mesh has no points;
/// - if the mesh has no point array `array_name`; the message then lists the existing arrays;
/// - if the handles are invalid (to_handles), or the weights do not belong to these handles
///   (check_weights).
Status to_weights_input(
  vtkPointSet* mesh, const std::string& array_name, vtkPolyData* handles, WeightsInput& input);

/// Return the point array `name` of region labels, one per point; empty if there is no such array.
/// Return invalid_input for labels that are not integers.
BINDPOSEFILTERS_EXPORT Status to_region_ids(
  vtkDataSet* mesh, const std::string& name, std::vector<Index>& region_ids);

/// Return the error "the mesh has no point array 'W' with weights (its point arrays: A, B)".
Status missing_weights_error(vtkPointSet* mesh, const std::string& array_name);

} // namespace bindpose

#endif
