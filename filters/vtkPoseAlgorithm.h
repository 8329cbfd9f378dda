/**
 * @class   vtkPoseAlgorithm
 * @brief   what the filters of pose time share: ports, bind cache, output
 *
 * Ports, bind cache and errors: vtkBindAlgorithm; moving handles runs Deform() alone. The output is
 * the mesh with moved points (doubles); cells and arrays are the input's own objects. Point normals
 * of a vtkPolyData (the active ones, when it has some) follow. The field data array
 * `HandleTransforms` has the transforms that were used, #handles x 12 (3x4, row by row, rest to
 * posed): what a filter found for handles that are not in mode full.
 *
 * **Stretch.** The report of every pose says how much it stretches the mesh's tets, or its
 * triangles where there are none (cells of other kinds are split): counts.elements,
 * counts.inverted_elements (turned inside out; of triangles only in flat shapes, z = const),
 * counts.stretched_elements (beyond StretchLimit), largest_stretch and smallest_stretch (singular
 * values of the deformation gradient, 1 at rest). Inverted elements are a warning.
 *
 * The `Stretch` and `Twist` of bones are used by stretchable bones (vtkSkinningDeformation) only. A
 * warning says so if a pose has some and the method ignores them.
 */

#ifndef vtkPoseAlgorithm_h
#define vtkPoseAlgorithm_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkBindAlgorithm.h"
#include <memory> // for std::unique_ptr

namespace bindpose
{
enum class StretchUse : int;
} // namespace bindpose

class BINDPOSEFILTERS_EXPORT vtkPoseAlgorithm : public vtkBindAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkPoseAlgorithm, vtkBindAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * An element counts as stretched when some direction in it becomes more than StretchLimit times
   * as long, or less than 1 / StretchLimit. Default 2; at least 1, or 0: elements are not looked
   * at, which saves about 50 ns a tet and 10 ns a triangle.
   */
  vtkSetMacro(StretchLimit, double);
  vtkGetMacro(StretchLimit, double);
  ///@}

  ///@{
  /**
   * Whether the output gets the cell array `Stretch`: the largest and the smallest stretch of each
   * cell, the smallest less than zero where it is inverted. Default off; needs a StretchLimit.
   */
  vtkSetMacro(StretchArray, bool);
  vtkGetMacro(StretchArray, bool);
  vtkBooleanMacro(StretchArray, bool);
  ///@}

protected:
  vtkPoseAlgorithm();
  ~vtkPoseAlgorithm() override;

  /// A bindpose::Points, #V x 3, and the transforms that moved them.
  struct PosedPoints;

  /// Computes the posed points.
  virtual bindpose::Status Deform(
    const PoseInput& input, bindpose::ExecutionContext& context, PosedPoints& posed) = 0;

  /// Computes the posed normals of a vtkPolyData that has some, after Deform(). Here: area-weighted
  /// normals of the posed polygons.
  virtual bindpose::Status DeformNormals(const PoseInput& input,
    bindpose::ExecutionContext& context, const PosedPoints& posed, PosedPoints& normals);

  /// What the method does with `Stretch` and `Twist` of the bones; a warning tells when a pose has
  /// some that it ignores. Here: what methods that find transforms do.
  virtual bindpose::StretchUse GetStretchUse();

  bindpose::Status Execute(vtkInformationVector** input, vtkInformationVector* output,
    bindpose::ExecutionContext& context) override;

private:
  vtkPoseAlgorithm(const vtkPoseAlgorithm&) = delete;
  void operator=(const vtkPoseAlgorithm&) = delete;

  double StretchLimit = 2.0;
  bool StretchArray = false;
  struct BindParts;
  std::unique_ptr<BindParts> OfBind; ///< what is the same for all poses of a bind, once asked for
};

#endif
