/**
 * @class   vtkBindAlgorithm
 * @brief   base class of the filters that bind a mesh to its handles: the bind cache
 *
 * Port 0 is the mesh at rest with its weights: any vtkPointSet with the point array `Weights`, one
 * component per handle. Port 1 is the handles with their pose (see filters/README.md).
 *
 * **Bind and pose.** Bind() does all work that depends only on the rest mesh, the weights and the
 * rest handles. Its result is cached. Moving handles (Transform, Mode, Stretch, Twist) does not run
 * Bind() again. A change of points, cells, the weights array, the handles' rest arrays or a bind
 * parameter of the filter runs Bind() again. Arrays are compared by their own modification times.
 * GetNumberOfBinds() returns the number of runs of Bind(). Each block of a composite mesh has its
 * own bind.
 *
 * **Errors**: no mesh, no handles, no weights array of the specified name, a weights array whose
 * number of tuples differs from the number of points or whose number of components differs from the
 * number of handles, a component that is named after a different handle, weights that are not
 * finite. Warnings: rows of weights that do not sum to one; the names of handles in mode full whose
 * transform is a reflection or scales a direction to zero.
 */

#ifndef vtkBindAlgorithm_h
#define vtkBindAlgorithm_h

#include "BindposeFiltersModule.h" // for export macro
#include "block_caches.h" // for BlockCaches
#include "vtkMeshAndHandlesAlgorithm.h"
#include <string> // for std::string
#include <vector> // for std::vector

namespace bindpose
{
struct PoseInput;
} // namespace bindpose

class BINDPOSEFILTERS_EXPORT vtkBindAlgorithm : public vtkMeshAndHandlesAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkBindAlgorithm, vtkMeshAndHandlesAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Name of the point array of weights. Default "Weights". This is a bind parameter: a change runs
  /// Bind() again.
  void SetArrayName(const std::string& name);
  std::string GetArrayName() { return this->ArrayName; }
  ///@}

  /// Number of times that Bind() has run.
  vtkGetMacro(NumberOfBinds, int);

protected:
  vtkBindAlgorithm();
  ~vtkBindAlgorithm() override;

  /// Report whether the mesh must have weights. Default: true. If false, PoseInput::weights is
  /// empty.
  virtual bool NeedsWeights() const { return true; }
  /// Report whether there must be handles. Default: true. If false, PoseInput::handles may be
  /// empty.
  virtual bool NeedsHandles() const { return true; }

  /// Return the names of the mesh's point arrays that the bind reads. By default it reads the
  /// weights if they are needed.
  virtual std::vector<std::string> BindArrays();

  /**
   * Compute everything that does not depend on the pose. A subclass stores what it needs later,
   * because views of the input are valid only during the call. The report is attached to every
   * output until the next bind.
   */
  virtual bindpose::Status Bind(
    bindpose::ExecutionContext& context, const bindpose::PoseInput& input) = 0;

  /// Report whether the method computes the rotations that a pose does not prescribe. If true,
  /// handles in mode automatic that are only translated get mode position.
  virtual bool FindsRotations() { return false; }

  /// Mark a bind parameter as modified; setters of bind parameters call this instead of Modified().
  void BindModified();
  /// Set a bind parameter, and mark it as modified if its value changes. Most setters call this
  /// function.
  template <typename Value>
  void SetBindParameter(Value& parameter, const Value& value)
  {
    if (parameter != value)
    {
      parameter = value;
      this->BindModified();
    }
  }

  /// Copy the time steps of the inputs to the output, so that animated handles animate the output.
  /// If several ports have time steps, those of the last port are used.
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

  ///@{
  /**
   * Convert the inputs, and run Bind() unless the last bind is still valid. Subclasses call this in
   * Execute(). If the status is usable, GetPoseInput() is valid until Execute() returns.
   * @param pose  text of a pose file (see vtkPoseHandles) with one pose, which is applied to the
   * pose of the handles; empty: none
   */
  bindpose::Status Prepare(bindpose::ExecutionContext& context, vtkInformationVector** input,
    const std::string& pose = {});
  const bindpose::PoseInput& GetPoseInput() const;
  ///@}

  /// Return a copy of the status of a pose. Its report starts with the entries of the bind's
  /// report. The warnings of a bind are issued only once, when the bind is computed.
  bindpose::Status WithBindReport(const bindpose::Status& posed) const;

private:
  vtkBindAlgorithm(const vtkBindAlgorithm&) = delete;
  void operator=(const vtkBindAlgorithm&) = delete;

  std::string ArrayName = "Weights";
  int NumberOfBinds = 0;
  vtkTimeStamp BindTime;
  struct Cache;
  bindpose::BlockCaches<Cache> BindCache;
};

#endif
