/**
 * @class   vtkVariationalSurface
 * @brief   smooth surfaces between what is fixed: membranes, thin plates and smoother ones
 *
 * Each coordinate of the free points solves Laplace's equation of order 1, 2 or 3 by mixed finite
 * elements (Jacobson, Tosun, Sorkine, Zorin 2010, Mixed finite elements for variational surface
 * modeling): to move a patch smoothly with its handles, or (Fair) to make it anew from what is
 * around it, for holes and blends.
 *
 * **Ports**: those of vtkPoseAlgorithm; the mesh is a surface of triangles without weights, and the
 * handles may be left out. **Fixed** are the points that handles in mode `full` hold (a point or
 * cage vertex the point at its place, a bone those along it, a region those of its label in
 * RegionArrayName), and those where the point array FixedArrayName is not 0, which stay. Handles in
 * mode `position` hold the place of their pivot, and may lie inside of triangles. All other points
 * are free.
 *
 * **Boundary.** REGION: the fixed points are a band of `Order` layers of triangles around the
 * patch, which continues it: with its place for order 1, tangent planes for 2, curvatures for 3.
 * Single points, curves and narrower bands work as well; the surface is then as smooth across them
 * as the energy makes it. Where the mesh ends, slopes across its border are zero. CURVE: the places
 * on the patch's edge alone count, its bending there is zero (simply supported). Without a Load
 * that is the surface of order 1, whatever the order. TANGENT: the places on the edge and the
 * derivatives across it, from TangentSource. Order 3 has more to fix than that; its third condition
 * is then its energy's own, with a warning.
 *
 * **Parameter domain.** The operator is frozen: cotangents and areas are those of the mesh at rest,
 * or of the point array ParameterArrayName (2 or 3 components: texture coordinates of a flat patch,
 * the places on a tube). What the result looks like depends on it: a patch that is to be round
 * needs a domain of about its lengths.
 *
 * A factorisation for each choice of modes is kept between poses; moving a handle only solves with
 * it. The condensed matrix is factored (Cholesky), refined by residuals of the mixed equations: the
 * accuracy of the larger indefinite system at a fraction of its cost.
 *
 * Report: method, order, boundary, counts (vertices, triangles, handles, free, constrained),
 * condition (of the matrix that was factored, with ones on its diagonal, estimated from below; up
 * to about 1e14 the refinement makes up for it), refinement (the last correction, as a share of the
 * largest coordinate), constraint_residual (in diagonals), seconds.bind, seconds.factor. Warnings:
 * few digits, conditions that are less than they seem, handles beside the mesh, redundant or
 * contradicting.
 *
 * Errors: besides vtkPoseAlgorithm's: cells that are no triangles, arrays of the wrong size or with
 * numbers that are not finite, a triangle of the patch without area, an edge of it with three
 * triangles, Fair with a part in which nothing is fixed. Status UNAVAILABLE when the system is too
 * ill-conditioned for double precision (order 3 from about a thousand points across).
 *
 * @sa vtkFullARAP
 */

#ifndef vtkVariationalSurface_h
#define vtkVariationalSurface_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkPoseAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkVariationalSurface : public vtkPoseAlgorithm
{
public:
  static vtkVariationalSurface* New();
  vtkTypeMacro(vtkVariationalSurface, vtkPoseAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// 1: Laplacian = 0 (membrane), 2: its square (thin plate), 3: its cube. Default 2. A bind
  /// parameter.
  void SetOrder(int order);
  vtkGetMacro(Order, int);
  ///@}

  enum BoundaryType
  {
    REGION = 0,
    CURVE = 1,
    TANGENT = 2
  };

  ///@{
  /// What holds at the edge of the patch. Default REGION. A bind parameter.
  void SetBoundary(int boundary);
  vtkGetMacro(Boundary, int);
  ///@}

  enum TangentSourceType
  {
    SURROUNDINGS = 0,
    GIVEN = 1,
    CLAMPED = 2
  };

  ///@{
  /**
   * For TANGENT: derivatives across the edge of the triangles beyond it, where there are some
   * (default); of the point array TangentArrayName (3 components: derivative of the place outwards,
   * per unit of the parameter domain); or none (of displacements: tangents stay as they are at
   * rest). A bind parameter.
   */
  void SetTangentSource(int source);
  vtkGetMacro(TangentSource, int);
  ///@}

  ///@{
  /// Solve for places instead of displacements: what the patch was is forgotten. Default off. A
  /// bind parameter.
  void SetFair(bool fair);
  vtkGetMacro(Fair, bool);
  vtkBooleanMacro(Fair, bool);
  ///@}

  ///@{
  /// Name of the mesh's point array of region labels (0: free). Default "RegionId". A bind
  /// parameter.
  void SetRegionArrayName(const std::string& name);
  std::string GetRegionArrayName() { return this->RegionArrayName; }
  ///@}

  ///@{
  /// Name of the mesh's point array that is not 0 at points that stay. Default "Fixed"; need not be
  /// there. A bind parameter.
  void SetFixedArrayName(const std::string& name);
  std::string GetFixedArrayName() { return this->FixedArrayName; }
  ///@}

  ///@{
  /// Name of the mesh's point array of places in the parameter domain. Default "Parameterization";
  /// need not be there. A bind parameter.
  void SetParameterArrayName(const std::string& name);
  std::string GetParameterArrayName() { return this->ParameterArrayName; }
  ///@}

  ///@{
  /// Name of the mesh's point array of tangents. Default "Tangents". A bind parameter.
  void SetTangentArrayName(const std::string& name);
  std::string GetTangentArrayName() { return this->TangentArrayName; }
  ///@}

  ///@{
  /// Name of the mesh's point array (3 components) of what (-Laplacian)^Order is to be there
  /// instead of zero: it blows the patch up. Default "Load"; need not be there. A bind parameter.
  void SetLoadArrayName(const std::string& name);
  std::string GetLoadArrayName() { return this->LoadArrayName; }
  ///@}

protected:
  vtkVariationalSurface();
  ~vtkVariationalSurface() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  bool NeedsWeights() const override { return false; }
  bool NeedsHandles() const override { return false; }
  std::vector<std::string> BindArrays() override;
  bindpose::Status Bind(const PoseInput& input, bindpose::ExecutionContext& context) override;
  bindpose::Status Deform(
    const PoseInput& input, bindpose::ExecutionContext& context, PosedPoints& posed) override;

private:
  vtkVariationalSurface(const vtkVariationalSurface&) = delete;
  void operator=(const vtkVariationalSurface&) = delete;

  int Order = 2;
  int Boundary = REGION;
  int TangentSource = SURROUNDINGS;
  bool Fair = false;
  std::string RegionArrayName = "RegionId";
  std::string FixedArrayName = "Fixed";
  std::string ParameterArrayName = "Parameterization";
  std::string TangentArrayName = "Tangents";
  std::string LoadArrayName = "Load";
  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
