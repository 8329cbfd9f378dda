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
 * Use the method INPAINT if the target is a different surface, such as clothes over a body. Points
 * that match the surface of the mesh by distance and normal get the weights of its nearest point.
 * The weights of all other points are solved for: the smoothest weights that agree with the matched
 * points within their bounds, with a certificate (see inpaint_weights). Parts that are near
 * each other but not connected, such as a sleeve and the side of the body, do not exchange weights.
 * The target must have triangles or tets.
 *
 * **Input 0**: the target, any vtkPointSet. **Input 1**: the mesh with the point array `Weights`
 * (see vtkWeightsAlgorithm). **Output**: input 0 with a double point array of the same name and
 * component names, and the optimality certificates of the weights as field data (see
 * vtkWeightsAlgorithm). With INPAINT, these are the relative gaps and residuals of the inpainted
 * columns, and the output also has the point array `Matched` (1 for matched points, else 0).
 *
 * **Pieces.** Each process transfers the weights to its own piece of the target, from the whole
 * mesh. Every point gets the same bits as on one process, except on a mesh that is cut open. There,
 * the id of a point in its piece differs from its id in the whole target, so the wrong one of
 * several vertices at the same position may be used. The report counts only the piece. INPAINT
 * needs the whole target: the first process does the work.
 *
 * The result is cached until an option, points, cells or weights of the mesh, or the points of the
 * target change; with INPAINT, also until the cells of the target change. An unchanged transfer
 * returns the same array. GetNumberOfBinds() counts the transfers. Each block of a composite target
 * has its own cached result.
 *
 * Report: transfer (exact, barycentric or mixed), counts.{transferred_exact,
 * transferred_barycentric, transferred_nearest, transfer_misses} (a miss is farther from the mesh
 * than 5 % of its diagonal, or not finite), transfer_largest_distance, seconds.transfer. INPAINT:
 * the entries of inpaint_weights().
 * Errors: no array of that name, a mesh without tets or triangles; for INPAINT, also a target
 * without tets or triangles.
 *
 * Abdrashitov, Raichstat, Monsen, Hill 2023, Robust skin weights transfer via weight inpainting.
 *
 * @sa vtkBoundedBiharmonicWeights vtkProbeFilter
 */

#ifndef vtkTransferWeights_h
#define vtkTransferWeights_h

#include "BindposeFiltersModule.h" // for export macro
#include "block_caches.h" // for BlockCaches
#include "vtkBindposeAlgorithm.h"

class vtkPointSet;

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

  /// Methods of transfer.
  enum TransferMethod
  {
    NEAREST = 0, ///< each point gets the weights of the nearest point of the mesh
    INPAINT = 1 ///< matched points do; the weights of all other points are solved for
  };

  ///@{
  /// Method of transfer. Default NEAREST. Values out of range are clamped.
  void SetMethod(int method);
  int GetMethod() { return this->Method; }
  void SetMethodToNearest() { this->SetMethod(NEAREST); }
  void SetMethodToInpaint() { this->SetMethod(INPAINT); }
  ///@}

  ///@{
  /// INPAINT: largest distance of a matched point from the mesh, at least 0, as a fraction of the
  /// mesh's diagonal. Default 0.05.
  void SetMaximumDistance(double distance);
  double GetMaximumDistance() { return this->MaximumDistance; }
  ///@}

  ///@{
  /// INPAINT: largest angle between the normals at a matched point and at the nearest point of the
  /// mesh, in degrees from 0 to 180. Default 30. At 180, normals are ignored.
  void SetMaximumAngle(double degrees);
  double GetMaximumAngle() { return this->MaximumAngle; }
  ///@}

  ///@{
  /// INPAINT: smallest area of a group of matched points that are connected by edges, from 0 to 1,
  /// as a fraction of the largest group in the same part of the target. Points of smaller groups
  /// count as unmatched. Default 0.01. At 0, all groups count.
  void SetSmallestGroup(double fraction);
  double GetSmallestGroup() { return this->SmallestGroup; }
  ///@}

  ///@{
  /// INPAINT: largest number of weights above 0 at a point. The largest weights are kept. Default
  /// 0: the largest number at a point of the mesh.
  void SetMaximumInfluences(int influences);
  int GetMaximumInfluences() { return this->MaximumInfluences; }
  ///@}

  ///@{
  /// INPAINT: number of smoothing steps near inpainted points. Default 0.
  void SetSmoothingSteps(int steps);
  int GetSmoothingSteps() { return this->SmoothingSteps; }
  ///@}

  /// Number of times that weights were transferred.
  vtkGetMacro(NumberOfBinds, int);

  /// NEAREST: return the port of the target. Each process can transfer weights to its own piece of
  /// the target, because the weights of a point do not depend on other points of the target.
  /// INPAINT: return -1.
  int GetPiecePort() override { return this->Method == NEAREST ? 0 : -1; }

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

  /// Set a parameter on which the transferred weights depend.
  template <typename Value>
  void SetBindParameter(Value& parameter, const Value& value)
  {
    if (parameter != value)
    {
      parameter = value;
      this->BindTime.Modified();
      this->Modified();
    }
  }
  struct Cache;
  bindpose::Status Transfer(
    bindpose::ExecutionContext& context, vtkPointSet* target, vtkPointSet* mesh, Cache& cache);
  bindpose::Status Inpaint(
    bindpose::ExecutionContext& context, vtkPointSet* target, vtkPointSet* mesh, Cache& cache);

  std::string ArrayName = "Weights";
  int Method = NEAREST;
  double MaximumDistance = 0.05;
  double MaximumAngle = 30.0;
  double SmallestGroup = 0.01;
  int MaximumInfluences = 0;
  int SmoothingSteps = 0;
  int NumberOfBinds = 0;
  vtkTimeStamp BindTime;
  bindpose::BlockCaches<Cache> BindCache;
};

#endif
