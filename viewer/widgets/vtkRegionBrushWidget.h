/**
 * @class   vtkRegionBrushWidget
 * @brief   paints regions on a surface
 *
 * The left button paints region labels on the surface under the mouse, as
 * vtkRegionBrushRepresentation says. Beside the surface all events pass on to the interactor's
 * style, so the camera can still be moved.
 *
 * Mouse events can be changed through GetEventTranslator(); all are in a table that
 * GetBindingInput() and its neighbours read out:
 * <pre>
 *   MouseMoveEvent             the disc follows the mouse; with the button held it paints
 *   LeftButtonPressEvent       begin a stroke; with Ctrl: erase
 *   LeftButtonReleaseEvent     end the stroke
 *   MouseWheelForward/BackwardEvent
 *     with Shift, or in a stroke: a larger or smaller disc; else the camera's
 *   KeyPressEvent
 *     ] and [                  a larger or smaller disc
 *     Escape                   cancel the stroke: all labels are as before it
 * </pre>
 * Events that it invokes:
 * <pre>
 *   StartInteractionEvent   a stroke begins: the labels are as before it
 *   InteractionEvent        labels have changed (also when a cancel restores them)
 *   EndInteractionEvent     the stroke has ended; GetCancelled() tells whether nothing has changed,
 *                           GetInteractionName() whether it was "paint region" or "erase region"
 *   StateChangedEvent       the disc has another radius
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
  /// The representation; a default one is made on demand.
  void SetRepresentation(vtkRegionBrushRepresentation* representation);
  vtkRegionBrushRepresentation* GetRegionBrushRepresentation();
  void CreateDefaultRepresentation() override;
  ///@}

  /// The surface of the representation.
  void SetSurface(vtkPolyData* surface);

  /// Whether a stroke is going on.
  bool IsPainting() { return this->State == PAINTING; }
  /// Whether the last stroke was cancelled, or changed nothing.
  vtkGetMacro(Cancelled, bool);
  /// "paint region" or "erase region".
  std::string GetInteractionName();
  /// Cancels the stroke that is going on, as the Escape key does; nothing otherwise.
  void CancelStroke();

  /// Disabling cancels a stroke that is going on.
  void SetEnabled(int enabling) override;

  ///@{
  /// The table of buttons and keys, a row each; see vtkHandleSetWidget::GetNumberOfBindings().
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
  bool TurnsWheel();
  void Finish(bool cancelled);

  int State = HOVERING;
  bool Cancelled = false;
  bool Erased = false; // by the last stroke
};

#endif
