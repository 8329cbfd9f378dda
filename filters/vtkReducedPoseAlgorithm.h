/**
 * @class   vtkReducedPoseAlgorithm
 * @brief   base class of filters that pose by reduced as-rigid-as-possible deformation
 *
 * It has the parameters of the reduced space (Jacobson et al. 2012): the energy, the clusters of
 * vertices that share a rotation, and additional weight functions. Subclasses compute the
 * transforms: vtkReducedARAP without inertia, vtkReducedDynamics with inertia.
 */

#ifndef vtkReducedPoseAlgorithm_h
#define vtkReducedPoseAlgorithm_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkArapEnergy.h"
#include "vtkPoseAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkReducedPoseAlgorithm : public vtkPoseAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkReducedPoseAlgorithm, vtkPoseAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum EnergyType
  {
    AUTO = vtkArapEnergy::AUTO,
    SPOKES_AND_RIMS = vtkArapEnergy::SPOKES_AND_RIMS,
    TETRAHEDRA = vtkArapEnergy::TETRAHEDRA,
    TRIANGLES = vtkArapEnergy::TRIANGLES,
    SPOKES = vtkArapEnergy::SPOKES
  };

  ///@{
  /**
   * Sets of edges that share a rotation. SPOKES_AND_RIMS: the edges of the elements around a
   * vertex. SPOKES: the edges that end at a vertex, without edges of negative cotangent weight.
   * TETRAHEDRA: the edges of a tet. TRIANGLES: the edges of a triangle. AUTO (default): TETRAHEDRA
   * on tets, SPOKES_AND_RIMS on surfaces. TETRAHEDRA on a surface and TRIANGLES on tets are errors.
   * This is a bind parameter: a change runs the bind again.
   */
  void SetEnergy(int energy);
  vtkGetMacro(Energy, int);
  ///@}

  ///@{
  /// Number of clusters, sets of vertices with similar weights; one rotation is fitted per cluster
  /// and iteration. Default 0: four clusters per handle and per additional weight function (see
  /// NumberOfExtraWeights). This is a bind parameter.
  void SetNumberOfClusters(int clusters);
  vtkGetMacro(NumberOfClusters, int);
  ///@}

  ///@{
  /**
   * Number of additional weight functions, which let the mesh bend away from the handles. Default
   * 0; 15 is a good value. This is a bind parameter.
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
   * Type of the extra weight functions: smooth bumps around vertices with very different weights
   * (BUMPS, default), or skinning eigenmodes (EIGENMODES; Benchekroun et al. 2023), the smoothest
   * functions that vanish at the handles. This is a bind parameter.
   */
  void SetExtraWeightsKind(int kind);
  vtkGetMacro(ExtraWeightsKind, int);
  ///@}

  ///@{
  /**
   * Add two point arrays to the output: `RotationCluster`, the index of the rotation that a vertex
   * follows, and `Rotation`, its axis times its angle in degrees, 0 to 180. If rotations belong to
   * elements, a vertex follows the rotation of most of its elements; a vertex without elements gets
   * the index -1 and the rotation 0. Default off.
   */
  vtkSetMacro(RotationArrays, bool);
  vtkGetMacro(RotationArrays, bool);
  vtkBooleanMacro(RotationArrays, bool);
  ///@}

protected:
  vtkReducedPoseAlgorithm() = default;
  ~vtkReducedPoseAlgorithm() override = default;

  bool FindsRotations() override { return true; }

private:
  vtkReducedPoseAlgorithm(const vtkReducedPoseAlgorithm&) = delete;
  void operator=(const vtkReducedPoseAlgorithm&) = delete;

  int Energy = AUTO;
  int NumberOfClusters = 0;
  int NumberOfExtraWeights = 0;
  int ExtraWeightsKind = BUMPS;
  bool RotationArrays = false;
};

#endif
