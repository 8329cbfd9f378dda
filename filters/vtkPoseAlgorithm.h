/**
 * @class   vtkPoseAlgorithm
 * @brief   base class of the filters that pose a mesh: ports, bind cache and output
 *
 * Ports, bind cache and errors: see vtkBindAlgorithm. Moving handles runs only Deform(). The output
 * is the mesh with moved points (doubles); its cells and arrays are the input's own objects. The
 * active point normals of a vtkPolyData are updated. The field data array `HandleTransforms`
 * contains the transforms that were used, #handles x 12 (3x4, row by row, rest to posed). For
 * handles that are not in mode full these are the transforms that the filter computed.
 *
 * **Stretch.** The report of every pose states how much the pose stretches the mesh's tets, or its
 * triangles if there are no tets (other cells are split): counts.elements, counts.inverted_elements
 * (inside out; triangles are counted only in flat shapes, z = const), counts.stretched_elements
 * (stretched or compressed beyond StretchLimit), largest_stretch and smallest_stretch (singular
 * values of the deformation gradient, 1 at rest). Inverted elements cause a warning.
 *
 * Only stretchable bones (vtkSkinningDeformation) use the `Stretch` and `Twist` of bones in all
 * modes. All other methods use no `Twist`. They use the `Stretch` of bones in mode tail;
 * as-rigid-as-possible methods also use it in mode ends. A pose with values that the method ignores
 * causes a warning.
 */

#ifndef vtkPoseAlgorithm_h
#define vtkPoseAlgorithm_h

#include "BindposeFiltersModule.h" // for export macro
#include "block_caches.h" // for BlockCaches
#include "vtkBindAlgorithm.h"

class vtkDoubleArray;

namespace bindpose
{
enum class StretchUse : int;
struct PosedPoints;
} // namespace bindpose

class BINDPOSEFILTERS_EXPORT vtkPoseAlgorithm : public vtkBindAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkPoseAlgorithm, vtkBindAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Stretch limit. An element counts as stretched if a direction in it becomes more than
   * StretchLimit times as long, or less than 1 / StretchLimit times. Default 2; at least 1. With 0
   * the stretch is not measured, which saves about 50 ns per tet and 10 ns per triangle.
   */
  vtkSetMacro(StretchLimit, double);
  vtkGetMacro(StretchLimit, double);
  ///@}

  ///@{
  /**
   * Add the cell array `Stretch` to the output: the largest and the smallest stretch of each cell.
   * The smallest is negative if the cell is inverted. Default off; needs a StretchLimit other than
   * 0.
   */
  vtkSetMacro(StretchArray, bool);
  vtkGetMacro(StretchArray, bool);
  vtkBooleanMacro(StretchArray, bool);
  ///@}

  /**
   * Compute only the points of a pose, for interactive use. The pipeline is not updated, and no
   * output, normals or stretch are computed. The points have the same bits as those of Update().
   * For as-rigid-as-possible methods, which start from their last result, this is true if both
   * start from the same result. The filter binds if the last bind is not valid. The inputs must be
   * up to date, because nothing before this filter is executed. Calls are not thread-safe.
   * @param pose  text of a pose file with one pose (see vtkPoseHandles), which is applied to the
   * pose of the handles at port 1; empty: the pose of the handles is used unchanged
   * @param points  the result, 3 components per point of the mesh. An array of another size is
   * reallocated, even if its memory belongs to the caller. The memory must not overlap that of the
   * mesh and its arrays.
   * @return whether there is a result; if not, see GetStatus() and GetStatusMessage(), which return
   * the outcome of this call until the next execution. No error or warning event is invoked.
   */
  bool PosePoints(const std::string& pose, vtkDoubleArray* points);

protected:
  vtkPoseAlgorithm();
  ~vtkPoseAlgorithm() override;

  /// Compute the posed points.
  virtual bindpose::Status Deform(bindpose::ExecutionContext& context,
    const bindpose::PoseInput& input, bindpose::PosedPoints& posed) = 0;

  /// Report whether PosePoints() is possible: whether a pose alone determines the points. Default:
  /// true.
  virtual bool CanPosePoints() { return true; }

  /// Compute the posed normals of a vtkPolyData with normals, after Deform(). The default
  /// implementation computes area-weighted normals of the posed polygons.
  virtual bindpose::Status DeformNormals(bindpose::ExecutionContext& context,
    const bindpose::PoseInput& input, const bindpose::PosedPoints& posed,
    bindpose::PosedPoints& normals);

  /// Return how the method uses the `Stretch` and `Twist` of bones. A warning is issued if the pose
  /// has values that the method ignores. The default implementation returns StretchUse::ends, the
  /// value for methods that compute the transforms of handles (as-rigid-as-possible).
  virtual bindpose::StretchUse GetStretchUse();

  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;

private:
  vtkPoseAlgorithm(const vtkPoseAlgorithm&) = delete;
  void operator=(const vtkPoseAlgorithm&) = delete;

  bindpose::Status PrepareRest(
    bindpose::ExecutionContext& context, vtkInformationVector** input, const std::string& pose);

  double StretchLimit = 2.0;
  bool StretchArray = false;
  struct RestData;
  /// Data shared by all poses of a bind; computed on first use.
  bindpose::BlockCaches<RestData> RestCache;
};

#endif
