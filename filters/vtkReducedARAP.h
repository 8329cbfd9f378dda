/**
 * @class   vtkReducedARAP
 * @brief   poses a mesh as rigidly as its handles allow, in microseconds per iteration
 *
 * Fast Automatic Skinning Transformations (Jacobson et al. 2012). The posed mesh is a linear blend
 * of one affine transform per handle, as in vtkSkinningDeformation. The user prescribes only some
 * of the transforms, and the filter computes the others so that the mesh bends as little as
 * possible:
 * - a handle in mode `full` (0) keeps its `Transform`;
 * - a handle in mode `position` (1) has its pivot at the position given by `Transform`; the filter
 *   computes its rotation;
 * - a bone in mode `tail` (3) has its tail at the position given by Transform and Stretch, and a
 *   bone in mode `ends` (4) has both ends at such positions; the filter computes the remaining
 *   rotation (about the tail in mode `tail`, about the bone in mode `ends`);
 * - the filter computes the whole transform of a handle in mode `free` (2);
 * - a handle in mode `automatic` (5, the default if there is no array Mode) gets mode position in
 *   two cases, otherwise mode full. In the first case, the handle is a point or cage vertex that is
 *   at rest or only translated (in the world or relative to its parent). In the second case, the
 *   handle is a bone that is only translated.
 *
 * If every handle is in mode full, the result is linear blend skinning. The energy is a weighted
 * sum of |e' - R e|^2 over the edges e at rest, where e' is the posed edge and R the rotation of
 * its cluster. A cluster is a set of vertices with similar weights. A solve alternates between
 * optimal rotations R and optimal transforms, with Anderson acceleration (Peng et al. 2018). A
 * solve never raises the energy. Its cost does not depend on the size of the mesh.
 *
 * Ports, arrays, bind cache and errors: see vtkPoseAlgorithm. Port 0 is a surface (vtkPolyData, or
 * a grid of 2D cells) or a vtkUnstructuredGrid of tets. The energy is that of the input mesh: an
 * energy of tets resists changes of volume, an energy of a surface only changes of the surface. The
 * field data array `HandleTransforms` of the output contains the computed transforms, #handles x 12
 * (3x4, row by row, rest to posed).
 *
 * Contradictory positions are satisfied in the least-squares sense. Warnings name handles with
 * contradictory or redundant positions, and handles without any weight. Weight columns may be zero,
 * duplicate or nearly linearly dependent.
 *
 * Report: method (the energy), counts (including clusters and extra_weights), energy, iterations,
 * single_precision_iterations, residual (fraction of the energy by which the last iteration lowered
 * it), microseconds_per_iteration, constraint_residual (in bounding-box diagonals), row_sum_error,
 * seconds.bind, seconds.solve, seconds.skin. The status is NOT_CONVERGED, with an output, if
 * Tolerance was not reached within MaximumIterations or TimeBudget.
 */

#ifndef vtkReducedARAP_h
#define vtkReducedARAP_h

#include "BindposeFiltersModule.h" // for export macro
#include "block_caches.h" // for BlockCaches
#include "vtkReducedPoseAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkReducedARAP : public vtkReducedPoseAlgorithm
{
public:
  static vtkReducedARAP* New();
  vtkTypeMacro(vtkReducedARAP, vtkReducedPoseAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Maximum number of iterations per solve, 0 to 1e6. Default 100.
  vtkSetClampMacro(MaximumIterations, int, 0, 1000000);
  vtkGetMacro(MaximumIterations, int);
  ///@}

  ///@{
  /**
   * Convergence tolerance: a solve ends when an iteration lowers the energy by no more than this
   * fraction of the energy. An energy below 1e-6 of the rest energy is replaced by 1e-6 of the rest
   * energy. Default 1e-6; 0 runs all iterations.
   */
  vtkSetClampMacro(Tolerance, double, 0.0, 1.0);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Time limit of a solve in microseconds: a solve ends after the iteration that exceeds it.
   * Default 0: no limit. To reproduce a result, set MaximumIterations to the number of iterations
   * in its report and Tolerance to 0, and start from the same rotations.
   */
  vtkSetClampMacro(TimeBudget, double, 0.0, 1e12);
  vtkGetMacro(TimeBudget, double);
  ///@}

  ///@{
  /// Number of previous iterates that the acceleration uses, 0 (none) to 50. Default 5.
  vtkSetClampMacro(AndersonWindow, int, 0, 50);
  vtkGetMacro(AndersonWindow, int);
  ///@}

  ///@{
  /**
   * Initial rotations of a solve. On (the default): the rotations of the last solve, so that drags
   * converge in few iterations and keep their twists. Off: an estimate based on the handles' own
   * motions, so that the result depends only on the pose.
   */
  vtkSetMacro(WarmStart, bool);
  vtkGetMacro(WarmStart, bool);
  vtkBooleanMacro(WarmStart, bool);
  ///@}

  ///@{
  /**
   * On (the default): iterate in single precision until its round-off hides the decrease of the
   * energy, and then in double precision for at least one iteration. A single-precision iteration
   * takes a third of the time. Off: iterate in double precision from the start. Both settings reach
   * the same tolerance and reproduce the rest pose.
   */
  vtkSetMacro(MixedPrecision, bool);
  vtkGetMacro(MixedPrecision, bool);
  vtkBooleanMacro(MixedPrecision, bool);
  ///@}

protected:
  vtkReducedARAP();
  ~vtkReducedARAP() override;

  bindpose::Status Bind(
    bindpose::ExecutionContext& context, const bindpose::PoseInput& input) override;
  bindpose::Status Deform(bindpose::ExecutionContext& context, const bindpose::PoseInput& input,
    bindpose::PosedPoints& posed) override;
  bindpose::Status DeformNormals(bindpose::ExecutionContext& context,
    const bindpose::PoseInput& input, const bindpose::PosedPoints& posed,
    bindpose::PosedPoints& normals) override;

private:
  vtkReducedARAP(const vtkReducedARAP&) = delete;
  void operator=(const vtkReducedARAP&) = delete;

  int MaximumIterations = 100;
  double Tolerance = 1e-6;
  double TimeBudget = 0.0;
  int AndersonWindow = 5;
  bool WarmStart = true;
  bool MixedPrecision = true;
  struct Internals;
  bindpose::BlockCaches<Internals> Internal;
};

#endif
