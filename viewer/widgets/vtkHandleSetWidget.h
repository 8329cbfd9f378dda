/**
 * @class   vtkHandleSetWidget
 * @brief   one widget for all handles of a handle dataset
 *
 * The handle, or the part of the gizmo, under the mouse is highlighted and named; the left button
 * selects and drags it, as vtkHandleSetRepresentation says. Away from handles all events pass on to
 * the interactor's style, so the camera can still be moved.
 *
 * Mouse events can be changed through GetEventTranslator(); keys are in a table, which
 * GetBindingInput() and its neighbours read out:
 * <pre>
 *   MouseMoveEvent            hover, or follow the drag
 *   LeftButtonPressEvent      select the handle under the mouse and start to drag it;
 *                             with Shift: toggle its selection; with Alt on a tail: stretch, too;
 *                             on a part of the gizmo: drag all selected handles
 *   LeftButtonReleaseEvent    end the drag
 *   RightButtonPressEvent     cancel the drag
 *   KeyPressEvent
 *     G, R, S                 move, turn, scale the selected handles with the mouse, no button
 *                             held; the left button or Enter ends it
 *     X, Y, Z                 hold the drag to an axis; again: of the other space; again: to none
 *     Shift + X, Y, Z         hold it to the plane across the axis
 *     0-9 . - Backspace       type the length, degrees or factor in place of the mouse
 *     Enter                   end the drag
 *     Escape                  cancel the drag: every pose is as before it, bit by bit
 *     in edit modes (see vtkHandleSetRepresentation::SetEditMode()):
 *     Enter, double click     end a cage, open
 *     Escape                  cancel what the button has begun; take a cage's last vertex away;
 *                             else back to POSE
 *   Shift held in a drag      fine: a tenth of the mouse's motion
 *   Ctrl held in a drag       snap: see vtkHandleSetRepresentation::SetLengthStep()
 * </pre>
 * Events that it invokes:
 * <pre>
 *   HighlightEvent          another handle or part of the gizmo, or none, is under the mouse
 *   SelectionChangedEvent   other handles are selected
 *   StartInteractionEvent   a drag begins; GetInteractionName() says of what kind
 *   InteractionEvent        poses have changed (also when a cancel restores them)
 *   EndInteractionEvent     the drag has ended; GetCancelled() tells whether nothing has changed,
 *                           GetInteractionName() what it was, for an undo step's name
 *   PlacePointEvent         an edit mode has added or removed a handle or an edge, between
 *                           StartInteractionEvent (the dataset is as before) and InteractionEvent
 *   WarningEvent            an edit was refused; the call data is the sentence
 *   StateChangedEvent       Escape has left an edit mode
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
  /// The representation; a default one is made on demand.
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
  /// Whether the keys G, R and S start drags. Default on.
  vtkSetMacro(StartKeys, vtkTypeBool);
  vtkGetMacro(StartKeys, vtkTypeBool);
  vtkBooleanMacro(StartKeys, vtkTypeBool);
  ///@}

  /// Whether a drag is going on.
  bool IsDragging() { return this->State == DRAGGING; }
  ///@{
  /// The representation's edit mode. Changing it cancels a drag that is going on.
  void SetEditMode(int mode);
  int GetEditMode();
  ///@}

  /// Whether the last drag was cancelled, or changed nothing.
  vtkGetMacro(Cancelled, bool);
  /// What the drag does, or did last; see vtkHandleSetRepresentation::GetInteractionName().
  std::string GetInteractionName();

  /// Starts a drag of the selected handles that follows the mouse without a button, as the keys G,
  /// R and S do: GIZMO_MOVE, GIZMO_TURN or GIZMO_SCALE. False when nothing can be dragged so.
  bool StartDrag(int gizmo);
  /// Ends the drag that is going on, as Enter does; nothing otherwise.
  void EndDrag();
  /// Cancels the drag that is going on, as the Escape key does; nothing otherwise.
  void CancelDrag();

  /// Disabling cancels a drag that is going on.
  void SetEnabled(int enabling) override;

  ///@{
  /// The table of buttons and keys, a row each: when it applies ("pose", "drag" in any mode, or
  /// the edit modes), the input as people read it, and what it does.
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
  bool PressKeyInMode(const std::string& key);
  void PressInMode();
  bool Edits();
  void TellEdit();
  void ReadModifiers();
  void BeginDragging();
  void FinishDragging(bool cancelled);

  vtkTypeBool StartKeys = 1;
  int State = HOVERING;
  bool ByKey = false; // the drag is without a button
  bool Moved = false; // since the button was pressed
  bool Cancelled = false;
};

#endif
