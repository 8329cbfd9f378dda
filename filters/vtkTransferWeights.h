/**
 * @class   vtkTransferWeights
 * @brief   carries weights from one mesh to points in or near it
 *
 * Puts the weights of a tet mesh or surface onto any vtkPointSet: the surface that the tets were
 * made from, another one, a finer or FE mesh, a point cloud. A point that lies on a vertex (within
 * 1e-9 of the mesh's diagonal) takes that vertex's row as it is (of several the one of its own
 * number, as on a mesh that is cut open); a point in a tet (or on a
 * triangle) takes the barycentric mean of the corners; a point outside takes the weights of the
 * nearest place. Rows that sum to one still do.
 *
 * **Input 0**: the target, any vtkPointSet. **Input 1**: the mesh with the point array `Weights`
 * (see vtkWeightsAlgorithm). **Output**: input 0 with a double point array of the same name and
 * component names, and the certificates that travel with it.
 *
 * The result is kept while points, cells and weights of the mesh and the points of the target stay:
 * an unchanged transfer hands on the same array. GetNumberOfBinds() counts.
 *
 * Report: transfer (exact, barycentric or mixed), counts.{transferred_exact,
 * transferred_barycentric, transferred_nearest, transfer_misses} (a miss is farther from the mesh
 * than 5 % of its diagonal, or not finite), transfer_largest_distance, seconds.transfer.
 * Errors: no array of that name, a mesh without tets or triangles.
 *
 * @sa vtkBoundedBiharmonicWeights vtkProbeFilter
 */

#ifndef vtkTransferWeights_h
#define vtkTransferWeights_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkBindposeAlgorithm.h"
#include <memory> // for std::unique_ptr

class BINDPOSEFILTERS_EXPORT vtkTransferWeights : public vtkBindposeAlgorithm
{
public:
  static vtkTransferWeights* New();
  vtkTypeMacro(vtkTransferWeights, vtkBindposeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Name of the point array of weights. Default "Weights".
  void SetArrayName(const std::string& name);
  std::string GetArrayName() { return this->ArrayName; }
  ///@}

  /// How often weights were transferred.
  vtkGetMacro(NumberOfBinds, int);

  /// The mesh with weights: SetInputData(1, mesh).
  void SetMeshData(vtkDataObject* mesh) { this->SetInputData(1, mesh); }
  void SetMeshConnection(vtkAlgorithmOutput* mesh) { this->SetInputConnection(1, mesh); }

protected:
  vtkTransferWeights();
  ~vtkTransferWeights() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  bindpose::Status Execute(vtkInformationVector** input, vtkInformationVector* output,
    bindpose::ExecutionContext& context) override;

private:
  vtkTransferWeights(const vtkTransferWeights&) = delete;
  void operator=(const vtkTransferWeights&) = delete;

  std::string ArrayName = "Weights";
  int NumberOfBinds = 0;
  vtkTimeStamp BindTime;
  struct Cache;
  std::unique_ptr<Cache> Bound;
};

#endif
