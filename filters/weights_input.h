#ifndef weights_input_h
#define weights_input_h

#include "BindposeFiltersModule.h" // for export macro
#include "conversion.h"

#include <string>
#include <vector>

class vtkDataArray;
class vtkPointSet;
class vtkPolyData;

namespace bindpose
{

/// Weights that were made for this mesh and these handles: as many rows and columns, and columns
/// that have a name have the handle's.
BINDPOSEFILTERS_EXPORT Status check_weights(
  vtkDataArray* weights, vtkIdType points, const Handles& handles);

/// A mesh's weights and the handles that they belong to.
struct WeightsInput
{
  SharedMatrix<Weights> weights; ///< #V x #handles
  Handles handles;
  std::vector<Index> cells; ///< of the handle dataset, one a handle
};

/// invalid_input for: no mesh, no array of that name (with those that there are), no handles,
/// weights of others.
Status to_weights_input(
  vtkPointSet* mesh, const std::string& array_name, vtkPolyData* handles, WeightsInput& input);

/// The labels of regions, a number a point; empty when the mesh has no such array. invalid_input
/// for numbers that are not whole.
BINDPOSEFILTERS_EXPORT Status to_region_ids(
  vtkPointSet* mesh, const std::string& name, std::vector<Index>& region_ids);

/// "the mesh has no point array 'W' with weights (its point arrays: A, B)".
Status no_weights(vtkPointSet* mesh, const std::string& array_name);

} // namespace bindpose

#endif
