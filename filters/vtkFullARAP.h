/**
 * @class   vtkFullARAP
 * @brief   poses a mesh as rigidly as its handles allow, every vertex on its own: no weights
 *
 * As-rigid-as-possible deformation (Sorkine and Alexa 2007, As-rigid-as-possible surface modeling;
 * Liu et al. 2008; Chao et al. 2010): the energies and the handles' modes of vtkReducedARAP, but
 * every vertex is an unknown and every vertex or element has a rotation of its own. The result
 * bends less than the reduced one and may have kinks at handles; an iteration takes milliseconds
 * for each ten thousand vertices instead of microseconds. To compare with, and for meshes without
 * weights.
 *
 * A handle in mode `full` (0) takes its vertices with it: a point or cage vertex the vertex at its
 * place, a bone those along it, a region those of its label (point array RegionArrayName). In mode
 * `position` (1) its pivot goes where `Transform` takes it, of a region the middle of its vertices;
 * in mode `free` (2) nothing is asked. Where no vertex is, the point of the cell there is held;
 * beside the mesh the nearest point of the mesh, with a warning. Parts that nothing holds stay.
 *
 * A solve alternates best rotations and best positions (one sparse factorisation for each choice of
 * modes, kept between poses) with Anderson acceleration (Peng et al. 2018), and never raises the
 * energy.
 *
 * Ports, bind cache and errors: vtkPoseAlgorithm; the mesh needs no weights, and ArrayName is not
 * used. Port 0 is a surface (vtkPolyData, or a grid of 2D cells) or a vtkUnstructuredGrid of tets.
 *
 * Report: method (the energy), counts (rotations, constrained among them), energy, iterations,
 * microseconds_per_iteration, constraint_residual (in diagonals), seconds.bind, seconds.factor,
 * seconds.solve. Status NOT_CONVERGED, with an output, when MaximumIterations were not enough for
 * Tolerance. Warnings name handles that contradict each other or are redundant.
 *
 * Errors: besides vtkPoseAlgorithm's a mesh without area or volume, a region without vertices.
 *
 * @sa vtkReducedARAP
 */

#ifndef vtkFullARAP_h
#define vtkFullARAP_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkPoseAlgorithm.h"
#include "vtkReducedARAP.h" // for EnergyType

class BINDPOSEFILTERS_EXPORT vtkFullARAP : public vtkPoseAlgorithm
{
public:
  static vtkFullARAP* New();
  vtkTypeMacro(vtkFullARAP, vtkPoseAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum EnergyType
  {
    AUTO = vtkReducedARAP::AUTO,
    SPOKES_AND_RIMS = vtkReducedARAP::SPOKES_AND_RIMS,
    TETRAHEDRA = vtkReducedARAP::TETRAHEDRA,
    TRIANGLES = vtkReducedARAP::TRIANGLES,
    SPOKES = vtkReducedARAP::SPOKES
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
  /// Name of the mesh's point array of region labels (0: free). Default "RegionId". A bind
  /// parameter.
  void SetRegionArrayName(const std::string& name);
  std::string GetRegionArrayName() { return this->RegionArrayName; }
  ///@}

  ///@{
  /// Most iterations of a solve, 0 to 1e6. Default 500.
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
   * Whether the output gets the point arrays `RotationCluster`, the number of the rotation that a
   * vertex follows, and `Rotation`, its axis times its angle in degrees, 0 to 180: see
   * vtkReducedARAP. Default off.
   */
  vtkSetMacro(RotationArrays, bool);
  vtkGetMacro(RotationArrays, bool);
  vtkBooleanMacro(RotationArrays, bool);
  ///@}

protected:
  vtkFullARAP();
  ~vtkFullARAP() override;

  bool NeedsWeights() const override { return false; }
  std::vector<std::string> BindArrays() override;
  bindpose::Status Bind(const PoseInput& input, bindpose::ExecutionContext& context) override;
  bool FindsRotations() override { return true; }
  bindpose::Status Deform(
    const PoseInput& input, bindpose::ExecutionContext& context, PosedPoints& posed) override;

private:
  vtkFullARAP(const vtkFullARAP&) = delete;
  void operator=(const vtkFullARAP&) = delete;

  int Energy = AUTO;
  std::string RegionArrayName = "RegionId";
  int MaximumIterations = 500;
  double Tolerance = 1e-6;
  int AndersonWindow = 5;
  bool WarmStart = true;
  bool RotationArrays = false;
  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
