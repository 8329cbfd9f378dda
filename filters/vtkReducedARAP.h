/**
 * @class   vtkReducedARAP
 * @brief   poses a mesh as rigidly as its handles allow, in microseconds an iteration
 *
 * Fast Automatic Skinning Transformations (Jacobson et al. 2012). The posed mesh is a linear blend
 * of one affine transform a handle, as with vtkSkinningDeformation; but only what the user fixes is
 * given, the rest of the transforms is found so that the mesh bends as little as it can:
 * - a handle in mode `full` (0) has its `Transform`;
 * - a handle in mode `position` (1) has its pivot where `Transform` takes it, turns by itself;
 * - a bone in mode `tail` (3) has its tail where Transform and Stretch take it, in mode `ends` (4)
 *   both ends, and finds the rest (how it turns about itself, or about the end);
 * - a handle in mode `free` (2) finds itself;
 * - a handle in mode `automatic` (5, also without an array Mode) has mode position if it is a point
 *   or a cage vertex that is at most translated, in the world or relative to its parent, or a bone
 *   that is translated; else it has mode full.
 *
 * With every handle full the result is linear blend skinning. The energy is the sum over clusters
 * of vertices with similar weights of |e' - R e|^2 over their edges e; a solve alternates best
 * rotations R and best transforms, extrapolates between them (Anderson acceleration, Peng et al.
 * 2018) and never raises the energy. Its cost does not depend on the size of the mesh.
 *
 * Ports, arrays, bind cache and errors: vtkPoseAlgorithm. Port 0 is a surface (vtkPolyData, or a
 * grid of 2D cells) or a vtkUnstructuredGrid of tets: the energy is that of the mesh it is given,
 * tets keep volume, surfaces keep only their skin. The field data array `HandleTransforms` of the
 * output has the found transforms, #handles x 12 (3x4, row by row, rest to posed).
 *
 * Positions that contradict each other are met in the least-squares sense; these, redundant ones
 * and handles without any weight are named in warnings. Weight columns that are empty, doubled or
 * nearly dependent are harmless.
 *
 * Report: method (the energy), counts (clusters, extra_weights among them), energy, iterations,
 * single_precision_iterations, residual (share of the energy by which the last one lowered it),
 * microseconds_per_iteration, constraint_residual (in diagonals), row_sum_error, seconds.bind,
 * seconds.solve, seconds.skin. Status NOT_CONVERGED, with an output, when MaximumIterations or
 * TimeBudget were not enough for Tolerance.
 */

#ifndef vtkReducedARAP_h
#define vtkReducedARAP_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkPoseAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkReducedARAP : public vtkPoseAlgorithm
{
public:
  static vtkReducedARAP* New();
  vtkTypeMacro(vtkReducedARAP, vtkPoseAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum EnergyType
  {
    AUTO = 0,
    SPOKES_AND_RIMS = 1,
    TETRAHEDRA = 2,
    TRIANGLES = 3,
    SPOKES = 4
  };

  ///@{
  /**
   * Which edges share a rotation: those of the elements around a vertex (spokes and rims), those
   * that end at it (spokes, without edges of negative cotangent weight), of a tet or of a triangle.
   * Default AUTO: TETRAHEDRA on tets, SPOKES_AND_RIMS on surfaces. TETRAHEDRA on a surface and
   * TRIANGLES on tets are errors. A bind parameter.
   */
  void SetEnergy(int energy);
  vtkGetMacro(Energy, int);
  ///@}

  ///@{
  /// Rotations fitted in an iteration. Default 0: four a handle. A bind parameter.
  void SetNumberOfClusters(int clusters);
  vtkGetMacro(NumberOfClusters, int);
  ///@}

  ///@{
  /**
   * Extra weights that let the mesh bend where no handle is. Default 0; 15 is a good number. A bind
   * parameter.
   */
  void SetNumberOfExtraWeights(int extra);
  vtkGetMacro(NumberOfExtraWeights, int);
  ///@}

  enum ExtraWeightsType
  {
    BUMPS = 0,
    EIGENMODES = 1
  };

  ///@{
  /**
   * What they are: smooth bumps around places that are far apart in weights, or skinning eigenmodes
   * (Benchekroun et al. 2023), the smoothest weights that vanish at the handles. Default BUMPS. A
   * bind parameter.
   */
  void SetExtraWeightsKind(int kind);
  vtkGetMacro(ExtraWeightsKind, int);
  ///@}

  ///@{
  /// Most iterations of a solve, 0 to 1e6. Default 100.
  vtkSetClampMacro(MaximumIterations, int, 0, 1000000);
  vtkGetMacro(MaximumIterations, int);
  ///@}

  ///@{
  /**
   * A solve ends when an iteration lowers the energy by no more than this share of it (or of 1e-6
   * of the rest energy, when hardly anything bends). Default 1e-6; 0 runs all iterations.
   */
  vtkSetClampMacro(Tolerance, double, 0.0, 1.0);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * A solve ends after the iteration in which so many microseconds have passed. Default 0: no
   * limit. How many iterations that were is in the report; as MaximumIterations, with Tolerance 0
   * and from the same start, they give the same result again.
   */
  vtkSetClampMacro(TimeBudget, double, 0.0, 1e12);
  vtkGetMacro(TimeBudget, double);
  ///@}

  ///@{
  /// Iterates that the acceleration looks back on, 0 (none) to 50. Default 5.
  vtkSetClampMacro(AndersonWindow, int, 0, 50);
  vtkGetMacro(AndersonWindow, int);
  ///@}

  ///@{
  /**
   * Whether a solve starts from the rotations of the last one (default on: drags converge in few
   * iterations and keep their twists) or from a guess by the handles' own motions (off: the result
   * depends on the pose only).
   */
  vtkSetMacro(WarmStart, bool);
  vtkGetMacro(WarmStart, bool);
  vtkBooleanMacro(WarmStart, bool);
  ///@}

  ///@{
  /**
   * Whether a solve iterates in single precision until its round-off hides whether the energy still
   * falls, and in double precision from there, at least once (default on: an iteration takes a
   * third of the time). Off: in double precision from the start. Both end at the same Tolerance;
   * rest is at rest in both.
   */
  vtkSetMacro(MixedPrecision, bool);
  vtkGetMacro(MixedPrecision, bool);
  vtkBooleanMacro(MixedPrecision, bool);
  ///@}

  ///@{
  /**
   * Whether the output gets the point arrays `RotationCluster`, the number of the rotation that a
   * vertex follows, and `Rotation`, its axis times its angle in degrees, 0 to 180: of rotations of
   * elements the one that most of its elements have, -1 and 0 where it has none. Default off.
   */
  vtkSetMacro(RotationArrays, bool);
  vtkGetMacro(RotationArrays, bool);
  vtkBooleanMacro(RotationArrays, bool);
  ///@}

protected:
  vtkReducedARAP();
  ~vtkReducedARAP() override;

  bindpose::Status Bind(const PoseInput& input, bindpose::ExecutionContext& context) override;
  bool FindsRotations() override { return true; }
  bindpose::Status Deform(
    const PoseInput& input, bindpose::ExecutionContext& context, PosedPoints& posed) override;
  bindpose::Status DeformNormals(const PoseInput& input, bindpose::ExecutionContext& context,
    const PosedPoints& posed, PosedPoints& normals) override;

private:
  vtkReducedARAP(const vtkReducedARAP&) = delete;
  void operator=(const vtkReducedARAP&) = delete;

  int Energy = AUTO;
  int NumberOfClusters = 0;
  int NumberOfExtraWeights = 0;
  int ExtraWeightsKind = BUMPS;
  int MaximumIterations = 100;
  double Tolerance = 1e-6;
  double TimeBudget = 0.0;
  int AndersonWindow = 5;
  bool WarmStart = true;
  bool MixedPrecision = true;
  bool RotationArrays = false;
  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
