/**
 * @class   vtkTransferWeights
 * @brief   transfers weights from one mesh to points in or near it
 *
 * The filter transfers the weights of a tet mesh or surface to any vtkPointSet: the surface of the
 * tets, another surface, a finer or finite-element mesh, a point cloud. A point at a vertex (within
 * 1e-9 of the mesh's diagonal) gets that vertex's row unchanged. If several vertices are at the
 * point, as on a mesh that is cut open, the vertex with the point's own id is used. A point in a
 * tet (or on a triangle) gets the barycentric mean of the corners' weights. A point outside gets
 * the weights at the nearest position of the mesh. If the rows of the mesh sum to one, the rows of
 * the target also sum to one.
 *
 * **Input 0**: the target, any vtkPointSet. **Input 1**: the mesh with the point array `Weights`
 * (see vtkWeightsAlgorithm). **Output**: input 0 with a double point array of the same name and
 * component names, and the optimality certificates of the weights as field data (see
 * vtkWeightsAlgorithm).
 *
 * **Pieces.** Each process transfers the weights to its own piece of the target, from the whole
 * mesh. Every point gets the same bits as on one process, except on a mesh that is cut open. There,
 * the id of a point in its piece differs from its id in the whole target, so the wrong one of
 * several vertices at the same position may be used. The report counts only the piece.
 *
 * The result is cached until points, cells or weights of the mesh or the points of the target
 * change. An unchanged transfer returns the same array. GetNumberOfBinds() counts the transfers.
 * Each block of a composite target has its own cached result.
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
#include "block_caches.h" // for BlockCaches
#include "vtkBindposeAlgorithm.h"

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

  /// Number of times that weights were transferred.
  vtkGetMacro(NumberOfBinds, int);

  /// Return the port of the target. Each process can transfer weights to its own piece of the
  /// target, because the weights of a point do not depend on other points of the target.
  int GetPiecePort() override { return 0; }

  /// Set the mesh with weights, like SetInputData(1, mesh).
  void SetMeshData(vtkDataObject* mesh) { this->SetInputData(1, mesh); }
  void SetMeshConnection(vtkAlgorithmOutput* mesh) { this->SetInputConnection(1, mesh); }

protected:
  vtkTransferWeights();
  ~vtkTransferWeights() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;

private:
  vtkTransferWeights(const vtkTransferWeights&) = delete;
  void operator=(const vtkTransferWeights&) = delete;

  std::string ArrayName = "Weights";
  int NumberOfBinds = 0;
  vtkTimeStamp BindTime;
  struct Cache;
  bindpose::BlockCaches<Cache> BindCache;
};

#endif
