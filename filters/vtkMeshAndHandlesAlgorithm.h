/**
 * @class   vtkMeshAndHandlesAlgorithm
 * @brief   what the filters of a mesh and its handles share: their ports
 *
 * **Input 0**: the mesh, any vtkPointSet. **Input 1**: the handles, a vtkPolyData (see
 * filters/README.md). **Output 0**: of the mesh's own class.
 */

#ifndef vtkMeshAndHandlesAlgorithm_h
#define vtkMeshAndHandlesAlgorithm_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkBindposeAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkMeshAndHandlesAlgorithm : public vtkBindposeAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkMeshAndHandlesAlgorithm, vtkBindposeAlgorithm);

  /// The handles: SetInputData(1, handles).
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
