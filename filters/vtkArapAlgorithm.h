/**
 * @class   vtkArapAlgorithm
 * @brief   base class of filters that pose by as-rigid-as-possible deformation
 *
 * It has the parameters that all these filters share. Subclasses compute the pose: vtkFullARAP with
 * one position per vertex, the subclasses of vtkReducedPoseAlgorithm with one transform per handle.
 */

#ifndef vtkArapAlgorithm_h
#define vtkArapAlgorithm_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkArapEnergy.h"
#include "vtkPoseAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkArapAlgorithm : public vtkPoseAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkArapAlgorithm, vtkPoseAlgorithm);
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
  vtkArapAlgorithm() = default;
  ~vtkArapAlgorithm() override = default;

  bool FindsRotations() override { return true; }

private:
  vtkArapAlgorithm(const vtkArapAlgorithm&) = delete;
  void operator=(const vtkArapAlgorithm&) = delete;

  int Energy = AUTO;
  bool RotationArrays = false;
};

#endif
