/**
 * @class   vtkMovingLeastSquaresWarp
 * @brief   poses a mesh by rigid motions that fit its handles, weighted by inverse distance
 *
 * This filter is the rigid warp of Schaefer, McPhail and Warren, "Image Deformation Using Moving
 * Least Squares", 2006. Each point moves by the rigid motion that best takes the handles to their
 * posed positions. Each handle is weighted by 1 / distance^(2 Exponent). The warp moves handles
 * exactly to their posed positions, reproduces rigid poses exactly and needs no weights. The method
 * ignores the shape: a hand next to a hip moves with the hip. Use it for comparison, and for images
 * that are bent as a whole.
 *
 * Points, cage vertices and regions (their pivots) contribute by their posed positions, bones by
 * their posed segments. The rotation of a point handle, and the rotation of a bone about itself,
 * have no effect. Handles in mode position contribute a translation; handles in mode free are
 * ignored. A flat mesh (z = const) whose handles all keep the same z is rotated within its plane;
 * all other meshes are rotated in space.
 *
 * Ports and bind cache: see vtkPoseAlgorithm. The mesh needs no weights, and ArrayName is not used.
 * The bind stores 24 bytes per point and handle. A pose costs one rotation fit per point.
 *
 * Report: seconds.bind, seconds.warp, counts, exponent, planar (1 if rotated within the plane).
 * Errors: no mesh, no handles, an exponent outside 1 to 8. A warning is issued if all handles are
 * free.
 *
 * @sa vtkSkinningDeformation vtkReducedARAP
 */

#ifndef vtkMovingLeastSquaresWarp_h
#define vtkMovingLeastSquaresWarp_h

#include "BindposeFiltersModule.h" // for export macro
#include "block_caches.h" // for BlockCaches
#include "vtkPoseAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkMovingLeastSquaresWarp : public vtkPoseAlgorithm
{
public:
  static vtkMovingLeastSquaresWarp* New();
  vtkTypeMacro(vtkMovingLeastSquaresWarp, vtkPoseAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Exponent of the weights 1 / distance^(2 Exponent) of the handles, 1 to 8; a larger exponent
  /// makes the surroundings of handles more rigid. Default 1. This is a bind parameter: a change
  /// runs the bind again.
  void SetExponent(double exponent);
  vtkGetMacro(Exponent, double);
  ///@}

protected:
  vtkMovingLeastSquaresWarp();
  ~vtkMovingLeastSquaresWarp() override;

  bool NeedsWeights() const override { return false; }
  bindpose::Status Bind(
    bindpose::ExecutionContext& context, const bindpose::PoseInput& input) override;
  bindpose::StretchUse GetStretchUse() override;
  bindpose::Status Deform(bindpose::ExecutionContext& context, const bindpose::PoseInput& input,
    bindpose::PosedPoints& posed) override;

private:
  vtkMovingLeastSquaresWarp(const vtkMovingLeastSquaresWarp&) = delete;
  void operator=(const vtkMovingLeastSquaresWarp&) = delete;

  double Exponent = 1.0;
  struct Internals;
  bindpose::BlockCaches<Internals> Internal;
};

#endif
