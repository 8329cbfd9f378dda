/**
 * @class   vtkBindAlgorithm
 * @brief   what the filters that bind a mesh to its handles share: the bind cache
 *
 * Port 0 is the mesh at rest with its weights (any vtkPointSet, point array `Weights` with a
 * component a handle), port 1 the handles with their pose (see filters/README.md).
 *
 * **Bind and pose.** What depends on the rest mesh, the weights or the rest handles only is done
 * once, in Bind(), and kept; moving handles (Transform, Mode, Stretch, Twist) does not run it. The
 * bind is made again when points, cells, the weights array or the handles' rest arrays change, told
 * by their own modification times, or a bind parameter of the filter. GetNumberOfBinds() counts.
 *
 * **Errors**: no mesh, no handles, no array of that name, an array with another number of tuples
 * than points or of components than handles, a component that is named after another handle than
 * its own, weights that are not finite. Warnings: rows that do not sum to one; handles in mode full
 * whose transform is a reflection or scales a direction to zero, by name.
 */

#ifndef vtkBindAlgorithm_h
#define vtkBindAlgorithm_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkMeshAndHandlesAlgorithm.h"
#include <memory> // for std::unique_ptr
#include <string> // for std::string
#include <vector> // for std::vector

class BINDPOSEFILTERS_EXPORT vtkBindAlgorithm : public vtkMeshAndHandlesAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkBindAlgorithm, vtkMeshAndHandlesAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Name of the point array of weights. Default "Weights". A bind parameter.
  void SetArrayName(const std::string& name);
  std::string GetArrayName() { return this->ArrayName; }
  ///@}

  /// How often Bind() has run.
  vtkGetMacro(NumberOfBinds, int);

protected:
  vtkBindAlgorithm();
  ~vtkBindAlgorithm() override;

  /// Whether the mesh must have weights. Default: yes. Without, PoseInput's are empty.
  virtual bool NeedsWeights() const { return true; }
  /// Whether there must be handles. Default: yes. Without, PoseInput's are empty.
  virtual bool NeedsHandles() const { return true; }

  /// The mesh's point arrays that a bind reads. Default: the weights, if it needs them.
  virtual std::vector<std::string> BindArrays();

  /// Mesh, weights, handles and pose as the kernels want them; valid during a call.
  struct PoseInput;

  /**
   * Takes what does not depend on the pose. What it needs later it keeps itself; views of the input
   * are valid during the call only. Its report is attached to every output until the next bind.
   */
  virtual bindpose::Status Bind(const PoseInput& input, bindpose::ExecutionContext& context) = 0;

  /// Whether the method finds rotations that a pose leaves free: handles in mode automatic that
  /// only move then have mode position.
  virtual bool FindsRotations() { return false; }

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

  /// Handles that move with time make the output do so; of several ports the last counts.
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

  ///@{
  /**
   * For Execute(): converts the inputs and binds them unless the last bind holds. When the status
   * is usable GetPoseInput() is valid until Execute() returns.
   */
  bindpose::Status Prepare(vtkInformationVector** input, bindpose::ExecutionContext& context);
  const PoseInput& GetPoseInput() const;
  ///@}

  /// A pose's status with what the bind reported in front; its warnings are said once, when it is
  /// made.
  bindpose::Status WithBindReport(const bindpose::Status& posed) const;

private:
  vtkBindAlgorithm(const vtkBindAlgorithm&) = delete;
  void operator=(const vtkBindAlgorithm&) = delete;

  std::string ArrayName = "Weights";
  int NumberOfBinds = 0;
  vtkTimeStamp BindTime;
  struct Cache;
  std::unique_ptr<Cache> Bound;
};

#endif
