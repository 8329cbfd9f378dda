/**
 * @class   vtkPoseAlgorithm
 * @brief   what the filters of pose time share: ports, bind cache, output
 *
 * Port 0 is the mesh at rest with its weights (any vtkPointSet, point array `Weights` with a
 * component a handle), port 1 the handles with their pose (see filters/README.md). The output is
 * the mesh with moved points (doubles); cells and arrays are the input's own objects. Point normals
 * of a vtkPolyData (the active ones, when it has some) follow. The field data array
 * `HandleTransforms` has the transforms that were used, #handles x 12 (3x4, row by row, rest to
 * posed): what a filter found for handles that are not in mode full.
 *
 * **Bind and pose.** What depends on the rest mesh, the weights or the rest handles only is done
 * once, in Bind(), and kept; moving handles (Transform, Mode, Stretch, Twist) runs Deform() alone.
 * The bind is made again when points, cells, the weights array or the handles' rest arrays change,
 * told by their own modification times, or a bind parameter of the filter. GetNumberOfBinds()
 * counts.
 *
 * **Stretch.** The report of every pose says how much it stretches the mesh's tets, or its
 * triangles where there are none (cells of other kinds are split): counts.elements,
 * counts.inverted_elements (turned inside out; of triangles only in flat shapes, z = const),
 * counts.stretched_elements (beyond StretchLimit), largest_stretch and smallest_stretch (singular
 * values of the deformation gradient, 1 at rest). Inverted elements are a warning.
 *
 * **Errors**: no mesh, no handles, no array of that name, an array with another number of tuples
 * than points or of components than handles, a component that is named after another handle than
 * its own, weights that are not finite. Rows that do not sum to one are a warning.
 */

#ifndef vtkPoseAlgorithm_h
#define vtkPoseAlgorithm_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkMeshAndHandlesAlgorithm.h"
#include <memory> // for std::unique_ptr
#include <string> // for std::string
#include <vector> // for std::vector

class vtkPointSet;

class BINDPOSEFILTERS_EXPORT vtkPoseAlgorithm : public vtkMeshAndHandlesAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkPoseAlgorithm, vtkMeshAndHandlesAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Name of the point array of weights. Default "Weights". A bind parameter.
  void SetArrayName(const std::string& name);
  std::string GetArrayName() { return this->ArrayName; }
  ///@}

  ///@{
  /**
   * An element counts as stretched when some direction in it becomes more than StretchLimit times
   * as long, or less than 1 / StretchLimit. Default 2; at least 1, or 0: elements are not looked
   * at, which saves about 60 ns a tet and 40 ns a triangle, several times what skinning takes.
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

  /// How often Bind() has run.
  vtkGetMacro(NumberOfBinds, int);

protected:
  vtkPoseAlgorithm();
  ~vtkPoseAlgorithm() override;

  /// Whether the mesh must have weights. Default: yes. Without, PoseInput's are empty.
  virtual bool NeedsWeights() const { return true; }
  /// Whether there must be handles. Default: yes. Without, PoseInput's are empty.
  virtual bool NeedsHandles() const { return true; }

  /// The mesh's point arrays that a bind reads. Default: the weights, if it needs them.
  virtual std::vector<std::string> BindArrays();

  /// Mesh, weights, handles and pose as the kernels want them; valid during a call.
  struct PoseInput;
  /// A bindpose::Points, #V x 3, and the transforms that moved them.
  struct PosedPoints;

  /**
   * Takes what does not depend on the pose. What it needs later it keeps itself; views of the input
   * are valid during the call only. Its report is attached to every output until the next bind.
   */
  virtual bindpose::Status Bind(const PoseInput& input, bindpose::ExecutionContext& context) = 0;

  /// Computes the posed points.
  virtual bindpose::Status Deform(
    const PoseInput& input, bindpose::ExecutionContext& context, PosedPoints& posed) = 0;

  /// Computes the posed normals of a vtkPolyData that has some, after Deform(). Here: area-weighted
  /// normals of the posed polygons.
  virtual bindpose::Status DeformNormals(const PoseInput& input,
    bindpose::ExecutionContext& context, const PosedPoints& posed, PosedPoints& normals);

  /// Setters of bind parameters call this instead of Modified().
  void BindModified();
  /// What most of them are.
  template <typename Value>
  void SetBindParameter(Value& parameter, const Value& value)
  {
    if (parameter != value)
    {
      parameter = value;
      this->BindModified();
    }
  }

  /// Handles that move with time make the output do so.
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

  bindpose::Status Execute(vtkInformationVector** input, vtkInformationVector* output,
    bindpose::ExecutionContext& context) override;

private:
  vtkPoseAlgorithm(const vtkPoseAlgorithm&) = delete;
  void operator=(const vtkPoseAlgorithm&) = delete;

  std::string ArrayName = "Weights";
  double StretchLimit = 2.0;
  bool StretchArray = false;
  int NumberOfBinds = 0;
  vtkTimeStamp BindTime;
  struct Cache;
  std::unique_ptr<Cache> Bound;
};

#endif
