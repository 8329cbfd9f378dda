#ifndef bindpose_cli_verbs_weights_stage_h
#define bindpose_cli_verbs_weights_stage_h

// The weights filter of the verbs that compute weights.

#include "vtkDataSet.h"
#include "vtkSmartPointer.h"

class vtkWeightsAlgorithm;

namespace bindpose::cli
{

class Session;

/// Return a shallow copy of the mesh to which arrays can be added.
vtkSmartPointer<vtkDataSet> shallow_copy(vtkDataSet* data);

/// Return the weights filter for the option --method, with all typed options. Return null on
/// failure: a typed option names an array that the mesh does not have.
/// @param mesh the input of the verb
vtkSmartPointer<vtkWeightsAlgorithm> make_weights(Session& session, vtkDataSet* mesh);

/// Transfer weights to the points of the input. A weights filter that solves on its input may add
/// points at handles. Return null on failure.
/// @param weights output of the filter
vtkSmartPointer<vtkDataSet> transfer_to_points(
  Session& session, vtkDataSet* mesh, vtkDataSet* weights);

} // namespace bindpose::cli

#endif
