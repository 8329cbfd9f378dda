/**
 * @class   vtkMovingLeastSquaresWarp
 * @brief   poses a mesh by the rigid motions that fit its handles best, near ones most
 *
 * The rigid warp of Schaefer, McPhail and Warren, "Image Deformation Using Moving Least Squares",
 * 2006: each point moves by the rigid motion that takes the handles nearest to where they are
 * posed, each counting by 1 / distance^(2 Exponent). Handles are interpolated, rigid poses are
 * exact, and no weights are needed. What it does not know is the shape: a hand beside a hip moves
 * with it. It is here to compare with, and for images that are bent as a whole.
 *
 * Points, cage vertices and regions (their pivots) count by where they go, bones by where their
 * segment goes; how a point turns, and how a bone turns about itself, is not asked. Handles in mode
 * position count as a translation, those in mode free do not count. A flat mesh (z = const) whose
 * handles stay at one z is turned within its plane, all else in space.
 *
 * Ports and bind cache: vtkPoseAlgorithm; the mesh needs no weights, and ArrayName is not used.
 * Bind: handles' shares at every point, 24 bytes each. Cost of a pose: one rotation fit a point.
 *
 * Report: seconds.bind, seconds.warp, counts, exponent, planar (1 when turned within the plane).
 * Errors: no mesh, no handles, an exponent outside 1 to 8. All handles free is a warning.
 *
 * @sa vtkSkinningDeformation vtkReducedARAP
 */

#ifndef vtkMovingLeastSquaresWarp_h
#define vtkMovingLeastSquaresWarp_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkPoseAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkMovingLeastSquaresWarp : public vtkPoseAlgorithm
{
public:
  static vtkMovingLeastSquaresWarp* New();
  vtkTypeMacro(vtkMovingLeastSquaresWarp, vtkPoseAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Handles count by 1 / distance^(2 Exponent): more makes their surroundings more rigid. 1 to 8.
  /// Default 1. A bind parameter.
  void SetExponent(double exponent);
  vtkGetMacro(Exponent, double);
  ///@}

protected:
  vtkMovingLeastSquaresWarp();
  ~vtkMovingLeastSquaresWarp() override;

  bool NeedsWeights() const override { return false; }
  bindpose::Status Bind(const PoseInput& input, bindpose::ExecutionContext& context) override;
  bindpose::StretchUse GetStretchUse() override;
  bindpose::Status Deform(
    const PoseInput& input, bindpose::ExecutionContext& context, PosedPoints& posed) override;

private:
  vtkMovingLeastSquaresWarp(const vtkMovingLeastSquaresWarp&) = delete;
  void operator=(const vtkMovingLeastSquaresWarp&) = delete;

  double Exponent = 1.0;
  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
