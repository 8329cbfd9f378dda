/**
 * @class   vtkReducedPoseAlgorithm
 * @brief   base class of filters that pose by reduced as-rigid-as-possible deformation
 *
 * It has the parameters of the reduced space (Jacobson et al. 2012): the clusters of vertices that
 * share a rotation, and additional weight functions. Subclasses compute the transforms:
 * vtkReducedARAP without inertia, vtkReducedDynamics with inertia.
 */

#ifndef vtkReducedPoseAlgorithm_h
#define vtkReducedPoseAlgorithm_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkArapAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkReducedPoseAlgorithm : public vtkArapAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkReducedPoseAlgorithm, vtkArapAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Number of clusters. A cluster is a set of vertices with similar weights; one rotation is
  /// fitted per cluster and iteration. Default 0: four clusters per handle and per additional
  /// weight function (see NumberOfExtraWeights). This is a bind parameter.
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

protected:
  vtkReducedPoseAlgorithm() = default;
  ~vtkReducedPoseAlgorithm() override = default;

private:
  vtkReducedPoseAlgorithm(const vtkReducedPoseAlgorithm&) = delete;
  void operator=(const vtkReducedPoseAlgorithm&) = delete;

  int NumberOfClusters = 0;
  int NumberOfExtraWeights = 0;
  int ExtraWeightsKind = BUMPS;
};

#endif
