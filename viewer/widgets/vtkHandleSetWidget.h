/**
 * @class   vtkHandleSetWidget
 * @brief   one widget for all handles of a handle dataset
 *
 * The handle under the mouse is highlighted and named; the left button drags it, as
 * vtkHandleSetRepresentation says. Away from handles all events pass on to the interactor's style,
 * so the camera can still be moved.
 *
 * Event bindings, which can be changed through GetEventTranslator():
 * <pre>
 *   MouseMoveEvent          hover, or follow the drag
 *   LeftButtonPressEvent    select the handle under the mouse and start to drag it
 *   LeftButtonReleaseEvent  end the drag
 *   KeyPressEvent Escape    cancel the drag: every transform is as before it
 * </pre>
 * Events that it invokes:
 * <pre>
 *   HighlightEvent          another handle, or none, is under the mouse
 *   SelectionChangedEvent   another handle is selected
 *   StartInteractionEvent   a drag begins
 *   InteractionEvent        transforms have changed (also when a cancel restores them)
 *   EndInteractionEvent     the drag has ended; GetCancelled() tells how
 * </pre>
 * @code
 *   vtkNew<vtkHandleSetWidget> widget;
 *   widget->SetInteractor(interactor);
 *   widget->SetHandles(handles); // the polydata on port 1 of a pose filter
 *   widget->On();
 *   widget->AddObserver(vtkCommand::InteractionEvent, update_pose_filter);
 * @endcode
 */

#ifndef vtkHandleSetWidget_h
#define vtkHandleSetWidget_h

#include "BindposeWidgetsModule.h" // for export macro
#include "vtkAbstractWidget.h"

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

  /// Whether a drag is going on.
  bool IsDragging() { return this->State == DRAGGING; }
  /// Whether the last drag was cancelled.
  vtkGetMacro(Cancelled, bool);

  /// Cancels the drag that is going on, as the Escape key does; nothing otherwise.
  void CancelDrag();

  /// Disabling cancels a drag that is going on.
  void SetEnabled(int enabling) override;

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
  bool Hover();

  int State = HOVERING;
  bool Cancelled = false;
};

#endif
