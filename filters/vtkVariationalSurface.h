/**
 * @class   vtkVariationalSurface
 * @brief   smooth surfaces between constrained points: membranes, thin plates and smoother surfaces
 *
 * Each coordinate of the free points solves the equation Laplacian^Order x = 0 (Order 1, 2 or 3),
 * discretized by mixed finite elements (Jacobson, Tosun, Sorkine, Zorin 2010, Mixed finite elements
 * for variational surface modeling). The filter moves a patch (the region of free points) smoothly
 * with its handles. With Fair on, the patch is computed only from its surroundings, for example to
 * fill a hole or to blend two surfaces.
 *
 * **Ports**: those of vtkPoseAlgorithm. The mesh is a surface of triangles without weights, and the
 * handles are optional. **Fixed points** are the points that handles in mode `full` constrain. A
 * point or cage vertex constrains the point at its position, a bone constrains the points along it,
 * and a region constrains the points with its label in RegionArrayName. Points with a nonzero value
 * in the point array FixedArrayName are fixed too, and do not move. A handle in mode `position`
 * constrains the position of its pivot, which may be inside of a triangle. All other points are
 * free.
 *
 * **Boundary.** REGION: the fixed points are a band of `Order` layers of triangles around the
 * patch. At the band, the surface is continuous in position (order 1), tangent plane (order 2) or
 * curvature (order 3). Single points, curves and narrower bands work as well; the smoothness of the
 * surface across them then follows from the energy. Where the mesh ends, slopes perpendicular to
 * its border are zero. CURVE: only the positions on the patch's edge are fixed, and its bending
 * there is zero (simply supported). Without a Load this gives the surface of order 1 for any order.
 * TANGENT: the positions on the edge and the derivatives perpendicular to it (from TangentSource)
 * are fixed. Order 3 needs one more condition: the filter uses the natural boundary condition of
 * the energy and issues a warning.
 *
 * **Parameter domain.** The operator does not change with the pose. Its cotangents and areas are
 * those of the mesh at rest, or those of the positions in the point array ParameterArrayName. This
 * array has 2 or 3 components, for example texture coordinates of a flat patch, or positions on a
 * tube. The shape of the result depends on the domain: a round patch needs a domain with about the
 * same lengths.
 *
 * One factorization is cached until the mode of a handle changes. Moving a handle only needs a
 * solve with this factorization. The filter factors the condensed matrix (Cholesky) and refines
 * with residuals of the mixed equations. This is as accurate as solving the larger indefinite
 * system of the mixed equations, at a fraction of its cost.
 *
 * Report: method, order, boundary, counts (vertices, triangles, handles, free, constrained),
 * condition (a lower estimate of the condition number of the factored matrix, scaled to a unit
 * diagonal; the refinement compensates for condition numbers up to about 1e14), refinement (the
 * last correction, as a fraction of the largest coordinate), constraint_residual (in bounding-box
 * diagonals), seconds.bind, seconds.factor. Warnings: a result with few accurate digits, boundary
 * conditions that constrain fewer derivatives than requested, handles that are off the mesh,
 * redundant or contradictory.
 *
 * Errors: those of vtkPoseAlgorithm; cells that are not triangles; arrays of the wrong size or with
 * numbers that are not finite; a triangle of the patch without area; an edge of the patch with
 * three triangles; Fair with a component without fixed points. The status is UNAVAILABLE if the
 * system is too ill-conditioned for double precision (order 3 on patches that are about a thousand
 * points wide or wider).
 *
 * @sa vtkFullARAP
 */

#ifndef vtkVariationalSurface_h
#define vtkVariationalSurface_h

#include "BindposeFiltersModule.h" // for export macro
#include "block_caches.h" // for BlockCaches
#include "vtkPoseAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkVariationalSurface : public vtkPoseAlgorithm
{
public:
  static vtkVariationalSurface* New();
  vtkTypeMacro(vtkVariationalSurface, vtkPoseAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Exponent of the Laplacian in the equation Laplacian^Order x = 0: 1 (membrane), 2 (thin plate)
  /// or 3 (smoother than a thin plate). Default 2. This is a bind parameter: a change runs the bind
  /// again.
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
  /// Boundary condition at the border of the patch. Default REGION. This is a bind parameter.
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
   * Source of the derivatives perpendicular to the edge for TANGENT. SURROUNDINGS (default): the
   * triangles beyond the edge, where there are some. GIVEN: the point array TangentArrayName (3
   * components: derivative of the position outwards, per unit of the parameter domain). CLAMPED:
   * zero; displacements then keep the tangents of the rest pose. This is a bind parameter.
   */
  void SetTangentSource(int source);
  vtkGetMacro(TangentSource, int);
  ///@}

  ///@{
  /// Solve for positions instead of displacements, so that the rest shape of the patch has no
  /// effect. Default off. This is a bind parameter.
  void SetFair(bool fair);
  vtkGetMacro(Fair, bool);
  vtkBooleanMacro(Fair, bool);
  ///@}

  ///@{
  /// Name of the mesh's point array of region labels; points with label 0 belong to no region.
  /// Default "RegionId". This is a bind parameter.
  void SetRegionArrayName(const std::string& name);
  std::string GetRegionArrayName() { return this->RegionArrayName; }
  ///@}

  ///@{
  /// Name of the mesh's point array that is nonzero at fixed points. Default "Fixed"; the array is
  /// optional. This is a bind parameter.
  void SetFixedArrayName(const std::string& name);
  std::string GetFixedArrayName() { return this->FixedArrayName; }
  ///@}

  ///@{
  /// Name of the mesh's point array of positions in the parameter domain. Default
  /// "Parameterization"; the array is optional. This is a bind parameter.
  void SetParameterArrayName(const std::string& name);
  std::string GetParameterArrayName() { return this->ParameterArrayName; }
  ///@}

  ///@{
  /// Name of the mesh's point array of tangents. Default "Tangents". This is a bind parameter.
  void SetTangentArrayName(const std::string& name);
  std::string GetTangentArrayName() { return this->TangentArrayName; }
  ///@}

  ///@{
  /// Name of the mesh's point array of loads (3 components). The load is the right-hand side of the
  /// equation (-Laplacian)^Order x = load; it inflates the patch. Default "Load". If the mesh has
  /// no such array, the load is zero. This is a bind parameter.
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
  bindpose::Status Bind(
    bindpose::ExecutionContext& context, const bindpose::PoseInput& input) override;
  bindpose::Status Deform(bindpose::ExecutionContext& context, const bindpose::PoseInput& input,
    bindpose::PosedPoints& posed) override;

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
  bindpose::BlockCaches<Internals> Internal;
};

#endif
