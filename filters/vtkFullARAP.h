/**
 * @class   vtkFullARAP
 * @brief   poses a mesh as rigidly as its handles allow, without weights: every vertex is an
 *   unknown
 *
 * As-rigid-as-possible deformation (Sorkine and Alexa 2007, As-rigid-as-possible surface modeling;
 * Liu et al. 2008, A local/global approach to mesh parameterization; Chao et al. 2010, A simple
 * geometric model for elastic deformations). The energies and the handles' modes are those of
 * vtkReducedARAP, but every vertex is an unknown, and every vertex or element has its own rotation.
 * The result bends less than that of vtkReducedARAP and may have kinks at handles. An iteration
 * takes milliseconds per ten thousand vertices instead of microseconds. Use it for comparison and
 * for meshes without weights.
 *
 * A handle in mode `full` (0) moves its vertices. For a point or cage vertex this is the vertex at
 * its position, for a bone the vertices along the bone, and for a region the vertices with its
 * label (point array RegionArrayName). In mode `position` (1) the `Transform` gives the target of
 * the pivot; the pivot of a region is the mean of its vertices. In mode `free` (2) the handle
 * constrains nothing. If no vertex is at the position of a handle, the handle constrains the point
 * of the mesh at this position. If the handle is off the mesh, it constrains the nearest point of
 * the mesh, with a warning. Components without constraints do not move.
 *
 * A solve alternates between optimal rotations and optimal positions with Anderson acceleration
 * (Peng et al. 2018). It uses one sparse factorization, which is cached until the mode of a handle
 * changes. In exact arithmetic an iteration never raises the energy. If nearly dependent
 * constraints cause a rise, the solve ends with the points before that iteration and a warning.
 *
 * Ports, bind cache and errors: see vtkPoseAlgorithm. The mesh needs no weights, and ArrayName is
 * not used. Port 0 is a surface (vtkPolyData, or a grid of 2D cells) or a vtkUnstructuredGrid of
 * tets.
 *
 * Report: method (the energy), counts (including rotations and constrained), energy, iterations,
 * microseconds_per_iteration, constraint_residual (in bounding-box diagonals), seconds.bind,
 * seconds.factor, seconds.solve. The status is NOT_CONVERGED, with an output, if Tolerance was not
 * reached within MaximumIterations. Warnings name handles that contradict each other or are
 * redundant.
 *
 * Errors: those of vtkPoseAlgorithm, a mesh without area or volume, and a region without vertices.
 *
 * @sa vtkReducedARAP
 */

#ifndef vtkFullARAP_h
#define vtkFullARAP_h

#include "BindposeFiltersModule.h" // for export macro
#include "block_caches.h" // for BlockCaches
#include "vtkArapAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkFullARAP : public vtkArapAlgorithm
{
public:
  static vtkFullARAP* New();
  vtkTypeMacro(vtkFullARAP, vtkArapAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Name of the mesh's point array of region labels; vertices with label 0 belong to no region.
  /// Default "RegionId". This is a bind parameter.
  void SetRegionArrayName(const std::string& name);
  std::string GetRegionArrayName() { return this->RegionArrayName; }
  ///@}

  ///@{
  /// Maximum number of iterations per solve, 0 to 1e6. Default 500.
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

protected:
  vtkFullARAP();
  ~vtkFullARAP() override;

  bool NeedsWeights() const override { return false; }
  std::vector<std::string> BindArrays() override;
  bindpose::Status Bind(
    bindpose::ExecutionContext& context, const bindpose::PoseInput& input) override;
  bindpose::Status Deform(bindpose::ExecutionContext& context, const bindpose::PoseInput& input,
    bindpose::PosedPoints& posed) override;

private:
  vtkFullARAP(const vtkFullARAP&) = delete;
  void operator=(const vtkFullARAP&) = delete;

  std::string RegionArrayName = "RegionId";
  int MaximumIterations = 500;
  double Tolerance = 1e-6;
  int AndersonWindow = 5;
  bool WarmStart = true;
  struct Internals;
  bindpose::BlockCaches<Internals> Internal;
};

#endif
