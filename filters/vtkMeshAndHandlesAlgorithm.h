/**
 * @class   vtkMeshAndHandlesAlgorithm
 * @brief   base class of the filters with a mesh and its handles: the ports
 *
 * **Input 0**: the mesh, any vtkPointSet. **Input 1**: the handles, a vtkPolyData (see
 * filters/README.md). **Output 0**: a dataset of the same class as the mesh.
 */

#ifndef vtkMeshAndHandlesAlgorithm_h
#define vtkMeshAndHandlesAlgorithm_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkBindposeAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkMeshAndHandlesAlgorithm : public vtkBindposeAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkMeshAndHandlesAlgorithm, vtkBindposeAlgorithm);

  /// Set the handles, like SetInputData(1, handles).
  void SetHandlesData(vtkDataObject* handles) { this->SetInputData(1, handles); }
  void SetHandlesConnection(vtkAlgorithmOutput* handles) { this->SetInputConnection(1, handles); }

protected:
  vtkMeshAndHandlesAlgorithm();
  ~vtkMeshAndHandlesAlgorithm() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

private:
  vtkMeshAndHandlesAlgorithm(const vtkMeshAndHandlesAlgorithm&) = delete;
  void operator=(const vtkMeshAndHandlesAlgorithm&) = delete;
};

#endif
