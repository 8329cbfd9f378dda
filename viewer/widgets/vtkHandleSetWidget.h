/**
 * @class   vtkHandleSetWidget
 * @brief   one widget for all handles of a handle dataset
 *
 * The handle, or the part of the gizmo, under the mouse is highlighted and named. The left button
 * selects and drags it; see vtkHandleSetRepresentation. Away from handles, all events are passed to
 * the interactor's style, so that the camera can still be moved.
 *
 * Mouse events can be changed through GetEventTranslator(). Keys are in a table, which
 * GetBindingInput() and the functions next to it return:
 * <pre>
 *   MouseMoveEvent            hover, or follow the drag
 *   LeftButtonPressEvent      select the handle under the mouse and start to drag it;
 *                             with Shift: toggle its selection; with Alt on a tail: also stretch;
 *                             on a part of the gizmo: drag all selected handles
 *   LeftButtonReleaseEvent    end the drag
 *   RightButtonPressEvent     cancel the drag
 *   KeyPressEvent
 *     G, R, S                 move, turn, scale the selected handles with the mouse, no button
 *                             held; the left button or Enter ends it
 *     X, Y, Z                 constrain the drag to an axis; again: in the other space;
 *                             a third time: no constraint
 *     Shift + X, Y, Z         constrain it to the plane perpendicular to the axis
 *     0-9 . - Backspace       type the length, degrees or factor in place of the mouse
 *     Enter                   end the drag
 *     Escape                  cancel the drag: every pose is restored bit for bit
 *     in edit modes (see vtkHandleSetRepresentation::SetEditMode()):
 *     Enter, double click     end a cage without closing it
 *     Escape                  cancel the current interaction; else remove a cage's last vertex;
 *                             else return to POSE
 *   Shift held in a drag      fine: a tenth of the mouse's motion
 *   Ctrl held in a drag       snap: see vtkHandleSetRepresentation::SetLengthStep()
 * </pre>
 * Events that it invokes:
 * <pre>
 *   HighlightEvent          the handle or part of the gizmo under the mouse has changed
 *   SelectionChangedEvent   the selection has changed
 *   StartInteractionEvent   a drag begins; GetInteractionName() returns its type
 *   InteractionEvent        poses have changed (also when a cancel restores them)
 *   EndInteractionEvent     the drag has ended; GetCanceled() reports whether nothing has changed,
 *                           GetInteractionName() returns a name for an undo step
 *   PlacePointEvent         an edit mode has added or removed a handle or an edge; invoked between
 *                           StartInteractionEvent (the dataset is unchanged) and InteractionEvent
 *   WarningEvent            an edit was refused; the call data is a sentence with the reason
 *   StateChangedEvent       Escape has ended an edit mode
 * </pre>
 * @code
 *   vtkNew<vtkHandleSetWidget> widget;
 *   widget->SetInteractor(interactor);
 *   widget->SetHandles(handles); // the polydata on port 1 of a pose filter
 *   widget->GetHandleSetRepresentation()->SetGizmo(vtkHandleSetRepresentation::GIZMO_MOVE);
 *   widget->On();
 *   widget->AddObserver(vtkCommand::InteractionEvent, update_pose_filter);
 * @endcode
 */

#ifndef vtkHandleSetWidget_h
#define vtkHandleSetWidget_h

#include "BindposeWidgetsModule.h" // for export macro
#include "vtkAbstractWidget.h"
#include <string> // for std::string

class vtkHandleSetRepresentation;
class vtkPolyData;

class BINDPOSEWIDGETS_EXPORT vtkHandleSetWidget : public vtkAbstractWidget
{
public:
  static vtkHandleSetWidget* New();
  vtkTypeMacro(vtkHandleSetWidget, vtkAbstractWidget);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The representation. A default one is created on demand.
  void SetRepresentation(vtkHandleSetRepresentation* representation);
  vtkHandleSetRepresentation* GetHandleSetRepresentation();
  void CreateDefaultRepresentation() override;
  ///@}

  ///@{
  /// The handle dataset of the representation.
  void SetHandles(vtkPolyData* handles);
  vtkPolyData* GetHandles();
  ///@}

  ///@{
  /// Allow the keys G, R and S to start drags. Default on.
  vtkSetMacro(StartKeys, vtkTypeBool);
  vtkGetMacro(StartKeys, vtkTypeBool);
  vtkBooleanMacro(StartKeys, vtkTypeBool);
  ///@}

  /// Report whether a drag is in progress.
  bool IsDragging() { return this->State == DRAGGING; }
  ///@{
  /// The representation's edit mode. Changing it cancels a drag in progress.
  void SetEditMode(int mode);
  int GetEditMode();
  ///@}

  /// Report whether the last drag was canceled or changed nothing.
  vtkGetMacro(Canceled, bool);
  /// Return the type of the current or last drag; see
  /// vtkHandleSetRepresentation::GetInteractionName().
  std::string GetInteractionName();

  /// Start a drag of the selected handles that follows the mouse without a pressed button, as the
  /// keys G, R and S do.
  /// @param gizmo  GIZMO_MOVE, GIZMO_TURN or GIZMO_SCALE
  /// @return false if no drag was started; see vtkHandleSetRepresentation::StartDrag()
  bool StartDrag(int gizmo);
  /// End a drag in progress, as Enter does.
  void EndDrag();
  /// Cancel a drag in progress, as the Escape key does.
  void CancelDrag();

  /// Enable or disable the widget. Disabling cancels a drag in progress.
  void SetEnabled(int enabling) override;

  ///@{
  /// The table of buttons and keys. Each row contains the state in which it applies, the button or
  /// key in the form shown to users, and the action. The state is "pose", "drag" (in any mode) or a
  /// list of edit modes.
  static int GetNumberOfBindings();
  static std::string GetBindingWhen(int row);
  static std::string GetBindingInput(int row);
  static std::string GetBindingText(int row);
  ///@}

protected:
  vtkHandleSetWidget();
  ~vtkHandleSetWidget() override;

private:
  vtkHandleSetWidget(const vtkHandleSetWidget&) = delete;
  void operator=(const vtkHandleSetWidget&) = delete;

  enum StateType
  {
    HOVERING,
    DRAGGING
  };
  static void MoveAction(vtkAbstractWidget* widget);
  static void SelectAction(vtkAbstractWidget* widget);
  static void EndSelectAction(vtkAbstractWidget* widget);
  static void CancelAction(vtkAbstractWidget* widget);
  static void KeyAction(vtkAbstractWidget* widget);
  static void DoubleClickAction(vtkAbstractWidget* widget);
  bool Hover();
  bool PressKey(const std::string& key);
  bool PressKeyInDrag(const std::string& key);
  bool PressKeyInEditMode(const std::string& key);
  void PressInEditMode();
  bool IsEditing();
  void InvokeEditEvents();
  void ReadModifiers();
  void BeginDragging();
  void FinishDragging(bool canceled);

  vtkTypeBool StartKeys = 1;
  int State = HOVERING;
  bool StartedByKey = false; // the drag was started by a key and needs no button
  bool Moved = false; // the mouse has moved since the button was pressed
  bool Canceled = false;
};

#endif
