/**
 * @class   vtkRegionBrushWidget
 * @brief   paints regions on a surface
 *
 * The left button paints region labels on the surface under the mouse; see
 * vtkRegionBrushRepresentation. Away from the surface, all events are passed to the interactor's
 * style, so that the camera can still be moved.
 *
 * Mouse events can be changed through GetEventTranslator(). All events are in a table, which
 * GetBindingInput() and the functions next to it return:
 * <pre>
 *   MouseMoveEvent             the disc follows the mouse; with the button held it paints
 *   LeftButtonPressEvent       begin a stroke; with Ctrl: erase
 *   LeftButtonReleaseEvent     end the stroke
 *   MouseWheelForward/BackwardEvent
 *     with Shift, or in a stroke: a larger or smaller disc; else the camera zooms
 *   KeyPressEvent
 *     ] and [                  a larger or smaller disc
 *     Escape                   cancel the stroke: all labels are restored
 * </pre>
 * Events that it invokes:
 * <pre>
 *   StartInteractionEvent   a stroke begins; the labels are unchanged
 *   InteractionEvent        labels have changed (also when a cancel restores them)
 *   EndInteractionEvent     the stroke has ended; GetCanceled() is true if nothing has changed,
 *                           GetInteractionName() returns "paint region" or "erase region"
 *   StateChangedEvent       the radius of the disc has changed
 * </pre>
 */

#ifndef vtkRegionBrushWidget_h
#define vtkRegionBrushWidget_h

#include "BindposeWidgetsModule.h" // for export macro
#include "vtkAbstractWidget.h"
#include <string> // for std::string

class vtkPolyData;
class vtkRegionBrushRepresentation;

class BINDPOSEWIDGETS_EXPORT vtkRegionBrushWidget : public vtkAbstractWidget
{
public:
  static vtkRegionBrushWidget* New();
  vtkTypeMacro(vtkRegionBrushWidget, vtkAbstractWidget);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The representation. A default one is created on demand.
  void SetRepresentation(vtkRegionBrushRepresentation* representation);
  vtkRegionBrushRepresentation* GetRegionBrushRepresentation();
  void CreateDefaultRepresentation() override;
  ///@}

  /// The surface of the representation.
  void SetSurface(vtkPolyData* surface);

  /// Report whether a stroke is in progress.
  bool IsPainting() { return this->State == PAINTING; }
  /// Report whether the last stroke was canceled or changed nothing.
  vtkGetMacro(Canceled, bool);
  /// Return "paint region" or "erase region".
  std::string GetInteractionName();
  /// Cancel a stroke in progress, as the Escape key does.
  void CancelStroke();

  /// Enable or disable the widget. Disabling cancels a stroke in progress.
  void SetEnabled(int enabling) override;

  ///@{
  /// The table of buttons and keys, in rows; see vtkHandleSetWidget::GetNumberOfBindings().
  static int GetNumberOfBindings();
  static std::string GetBindingWhen(int row);
  static std::string GetBindingInput(int row);
  static std::string GetBindingText(int row);
  ///@}

protected:
  vtkRegionBrushWidget();
  ~vtkRegionBrushWidget() override;

private:
  vtkRegionBrushWidget(const vtkRegionBrushWidget&) = delete;
  void operator=(const vtkRegionBrushWidget&) = delete;

  enum StateType
  {
    HOVERING,
    PAINTING
  };
  static void MoveAction(vtkAbstractWidget* widget);
  static void SelectAction(vtkAbstractWidget* widget);
  static void EndSelectAction(vtkAbstractWidget* widget);
  static void GrowAction(vtkAbstractWidget* widget);
  static void ShrinkAction(vtkAbstractWidget* widget);
  static void KeyAction(vtkAbstractWidget* widget);
  bool Hover();
  void Resize(double factor);
  bool WheelResizesDisc();
  void Finish(bool canceled);

  int State = HOVERING;
  bool Canceled = false;
  bool Erased = false; // true if the last stroke erased
};

#endif
