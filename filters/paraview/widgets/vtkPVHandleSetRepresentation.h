/**
 * @class   vtkPVHandleSetRepresentation
 * @brief   handles that are posed interactively, with the pose as a text
 *
 * The representation of vtkHandleSetWidget in the panel of Pose Handles. ParaView connects a 3D
 * widget with the properties of a filter, so the pose is available as the property PoseJSON of
 * vtkPoseHandles. SetPoseJSON() poses the handles. After a drag, GetPoseJSON() returns the new
 * pose.
 *
 * The text contains only the handles whose pose differs from the pose of the input. It is written
 * only after a change of the pose, so a text that was set is returned unchanged.
 *
 * A pose that cannot be dragged is **fixed**: it comes from a file (SetPoseFromFile()), or the text
 * is a sequence or has expressions. Then the handles of SetOutputHandles() are drawn and locked.
 *
 * The data is not a property, so the representation on a render server has no handles. Therefore
 * the proxy draws in ParaView's client-only renderer.
 *
 * @sa vtkPoseHandles vtkHandleSetWidget vtkPVPlacedHandlesRepresentation
 */

#ifndef vtkPVHandleSetRepresentation_h
#define vtkPVHandleSetRepresentation_h

#include "BindposeParaViewWidgetsModule.h" // for export macro
#include "vtkHandleSetRepresentation.h"
#include "vtkNew.h" // for vtkNew
#include "vtkSmartPointer.h" // for vtkSmartPointer
#include <string> // for std::string

class BINDPOSEPARAVIEWWIDGETS_EXPORT vtkPVHandleSetRepresentation
  : public vtkHandleSetRepresentation
{
public:
  static vtkPVHandleSetRepresentation* New();
  vtkTypeMacro(vtkPVHandleSetRepresentation, vtkHandleSetRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Set the handles before posing, i.e. the input of vtkPoseHandles. This class does not modify
  /// them. The selection is kept if the number of cells stays the same. Null: there are no handles.
  /// Nothing happens if the dataset has not changed since the last call.
  void SetInputHandles(vtkPolyData* handles);
  /// Set the posed handles, i.e. the output of vtkPoseHandles. They are drawn if the pose is fixed.
  /// Null: the input handles are drawn.
  void SetOutputHandles(vtkPolyData* handles);

  ///@{
  /// The pose as text, see vtkPoseHandles. A text that cannot be used does not change the handles,
  /// and GetPoseMessage() returns the reason.
  void SetPoseJSON(const char* text);
  const char* GetPoseJSON();
  ///@}

  ///@{
  /// Whether the pose comes from a file. If so, PoseJSON is not used. Default false.
  void SetPoseFromFile(bool fromFile);
  vtkGetMacro(PoseFromFile, bool);
  ///@}

  /// Report whether the pose is fixed; see the class documentation.
  bool IsPoseFixed();
  /// Return the drawn pose as text, even if the pose is fixed. Return an empty text if there are no
  /// handles.
  std::string GetDrawnPoseJSON();
  /// Return one sentence with the reason why the text cannot be used or is not exact; empty if
  /// there is none.
  std::string GetPoseMessage();

  ///@{
  /// Change all selected handles: set the mode (0 full, 1 position, 2 free, 3 tail, 4 ends, 5
  /// auto), or reset them to the rest pose and keep their modes. The modes tail and ends change
  /// bones only. Return false if nothing has changed.
  bool SetSelectedModes(int mode);
  bool ResetSelectedHandles();
  ///@}

protected:
  vtkPVHandleSetRepresentation();
  ~vtkPVHandleSetRepresentation() override;

private:
  vtkPVHandleSetRepresentation(const vtkPVHandleSetRepresentation&) = delete;
  void operator=(const vtkPVHandleSetRepresentation&) = delete;

  void DrawPose();
  void DrawHandles(vtkPolyData* handles);
  bool FormatPose(std::string& text);

  vtkSmartPointer<vtkPolyData> InputHandles; // a copy that shares the arrays
  /// The dataset that InputHandles copies. The pointer is compared but never dereferenced.
  const void* InputObject = nullptr;
  vtkMTimeType InputTime = 0; // modification time of InputObject
  vtkSmartPointer<vtkPolyData> OutputHandles;
  vtkNew<vtkPolyData> DrawnHandles; // edited by drags
  std::string PoseJSON;
  std::string PoseMessage;
  bool PoseFromFile = false;
  vtkMTimeType FormattedTime = 0; // modification time of DrawnHandles when PoseJSON was written
};

#endif
