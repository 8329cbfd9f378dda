/**
 * @class   vtkHandleSetRepresentation
 * @brief   all handles of a handle dataset: drawn, picked and dragged
 *
 * Draws every handle of a handle polydata where its `Transform` takes it (points, cage vertices
 * and region pivots as balls, bones as elongated octahedra with a ball at each end), finds the
 * handle under the mouse, and turns a drag into a new `Transform`. It is the representation of
 * vtkHandleSetWidget; added to a renderer by itself it only draws.
 *
 * A handle is named by its cell id in the handle dataset; -1 means none. Cage elements (HandleKind
 * -1) are no handles: they are drawn as thin bars and cannot be picked.
 *
 * **Dragging** writes absolute transforms (3x4, rest to posed) into the cell array `Transform`,
 * which is made when absent; `Mode` and all other arrays are left alone.
 * - a ball (point, cage vertex, region) or a bone's body or head: translation in the plane through
 *   the grabbed place that faces the camera;
 * - a bone's tail: rotation about the bone's posed head, the shortest that turns the bone towards
 *   the mouse. The bone's length stays.
 * - With MoveDescendants (on) the same motion is applied to all handles below it by `Parent`.
 * - A handle whose Mode is free can be selected but not dragged: its place is for the solver to
 *   find.
 * CancelWidgetInteraction() gives all transforms back as they were, bit by bit.
 *
 * **Picking** happens on the screen, without rendering: a place counts when the mouse is within
 * its drawn radius plus PickTolerance. Balls of points win over bone ends, bone ends over bodies;
 * among equals the nearest to the mouse wins, then the one nearest to the camera.
 *
 * Sizes are in pixels of the window, multiplied by PixelScale (for pictures rendered larger than
 * they are shown). Handles are drawn over everything else unless DrawOnTop is off.
 */

#ifndef vtkHandleSetRepresentation_h
#define vtkHandleSetRepresentation_h

#include "BindposeWidgetsModule.h" // for export macro
#include "vtkWidgetRepresentation.h"
#include <memory> // for std::unique_ptr
#include <string> // for std::string

class vtkPolyData;
class vtkTextProperty;

class BINDPOSEWIDGETS_EXPORT vtkHandleSetRepresentation : public vtkWidgetRepresentation
{
public:
  static vtkHandleSetRepresentation* New();
  vtkTypeMacro(vtkHandleSetRepresentation, vtkWidgetRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// What the mouse is on: the interaction state.
  enum InteractionStateType
  {
    OUTSIDE = 0, ///< no handle
    ON_POINT = 1, ///< the ball of a point, cage vertex or region
    ON_HEAD = 2, ///< a bone's head
    ON_TAIL = 3, ///< a bone's tail
    ON_BODY = 4 ///< a bone between its ends
  };

  ///@{
  /// The handle dataset. It is edited in place: the pose arrays only.
  void SetHandles(vtkPolyData* handles);
  vtkPolyData* GetHandles();
  ///@}

  ///@{
  /// Radius of a ball in pixels. Default 7, range 1 to 100. Bone ends are 0.6 times as large.
  vtkSetClampMacro(PointSize, double, 1.0, 100.0);
  vtkGetMacro(PointSize, double);
  ///@}
  ///@{
  /// Half the width of a bone as a fraction of its length, kept between 0.5 and 2 ball radii.
  /// Default 0.08, range 0.001 to 0.5.
  vtkSetClampMacro(BoneWidth, double, 0.001, 0.5);
  vtkGetMacro(BoneWidth, double);
  ///@}
  ///@{
  /// Pixels beyond the drawn radius that still hit. Default 4, range 0 to 100.
  vtkSetClampMacro(PickTolerance, double, 0.0, 100.0);
  vtkGetMacro(PickTolerance, double);
  ///@}
  ///@{
  /// Factor on all pixel measures and on the font size. Default 1, range 0.1 to 16.
  vtkSetClampMacro(PixelScale, double, 0.1, 16.0);
  vtkGetMacro(PixelScale, double);
  ///@}
  ///@{
  /// Names of all handles. Default off.
  vtkSetMacro(ShowLabels, vtkTypeBool);
  vtkGetMacro(ShowLabels, vtkTypeBool);
  vtkBooleanMacro(ShowLabels, vtkTypeBool);
  ///@}
  ///@{
  /// The name of the handle under the mouse. Default on.
  vtkSetMacro(ShowHoverName, vtkTypeBool);
  vtkGetMacro(ShowHoverName, vtkTypeBool);
  vtkBooleanMacro(ShowHoverName, vtkTypeBool);
  ///@}
  ///@{
  /// Draw over everything else in the renderer, so that handles inside a shape are seen. Default
  /// on.
  vtkSetMacro(DrawOnTop, vtkTypeBool);
  vtkGetMacro(DrawOnTop, vtkTypeBool);
  vtkBooleanMacro(DrawOnTop, vtkTypeBool);
  ///@}
  ///@{
  /// Whether handles below the dragged one in the `Parent` hierarchy move with it. Default on.
  vtkSetMacro(MoveDescendants, vtkTypeBool);
  vtkGetMacro(MoveDescendants, vtkTypeBool);
  vtkBooleanMacro(MoveDescendants, vtkTypeBool);
  ///@}

  ///@{
  /// Colours by Mode (full: orange, position: blue, free: grey) and of the outline; the selected
  /// handle's outline has its own, with the outline's colour around it.
  vtkSetVector3Macro(FullColor, double);
  vtkGetVector3Macro(FullColor, double);
  vtkSetVector3Macro(PositionColor, double);
  vtkGetVector3Macro(PositionColor, double);
  vtkSetVector3Macro(FreeColor, double);
  vtkGetVector3Macro(FreeColor, double);
  vtkSetVector3Macro(OutlineColor, double);
  vtkGetVector3Macro(OutlineColor, double);
  vtkSetVector3Macro(SelectedColor, double);
  vtkGetVector3Macro(SelectedColor, double);
  ///@}

  /// Font of names; its size is multiplied by PixelScale. Default: Arial 13, dark on a light plate.
  vtkTextProperty* GetLabelTextProperty();

  ///@{
  /// Handle under the mouse, as found by ComputeInteractionState(); -1: none.
  void SetHoveredHandle(vtkIdType handle);
  vtkGetMacro(HoveredHandle, vtkIdType);
  ///@}
  ///@{
  /// Handle shown as selected; -1: none.
  void SetSelectedHandle(vtkIdType handle);
  vtkGetMacro(SelectedHandle, vtkIdType);
  ///@}
  /// Handle being dragged; -1: none.
  vtkGetMacro(ActiveHandle, vtkIdType);

  ///@{
  /// Name, mode (0 full, 1 position, 2 free) and posed ends of a handle. The tail of anything but
  /// a bone is its head.
  std::string GetHandleName(vtkIdType handle);
  int GetHandleMode(vtkIdType handle);
  bool IsBone(vtkIdType handle);
  void GetPosedHead(vtkIdType handle, double head[3]);
  void GetPosedTail(vtkIdType handle, double tail[3]);
  ///@}

  /// Finds what is under the display position and makes it the hovered handle. Returns one of
  /// InteractionStateType.
  int ComputeInteractionState(int x, int y, int modify = 0) override;

  ///@{
  /// One drag: grabs what the interaction state says (nothing when outside or free), follows the
  /// display position, ends. The state and hovered handle come from ComputeInteractionState().
  void StartWidgetInteraction(double eventPos[2]) override;
  void WidgetInteraction(double eventPos[2]) override;
  void EndWidgetInteraction(double eventPos[2]) override;
  ///@}
  /// Ends the drag and restores all transforms as they were when it began.
  void CancelWidgetInteraction();

  ///@{
  /// vtkWidgetRepresentation and vtkProp.
  void BuildRepresentation() override;
  double* GetBounds() VTK_SIZEHINT(6) override;
  vtkMTimeType GetMTime() override;
  void ReleaseGraphicsResources(vtkWindow* window) override;
  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  int RenderOverlay(vtkViewport* viewport) override;
  vtkTypeBool HasTranslucentPolygonalGeometry() override { return 0; }
  ///@}

protected:
  vtkHandleSetRepresentation();
  ~vtkHandleSetRepresentation() override;

private:
  vtkHandleSetRepresentation(const vtkHandleSetRepresentation&) = delete;
  void operator=(const vtkHandleSetRepresentation&) = delete;

  double PointSize = 7.0;
  double BoneWidth = 0.08;
  double PickTolerance = 4.0;
  double PixelScale = 1.0;
  vtkTypeBool ShowLabels = 0;
  vtkTypeBool ShowHoverName = 1;
  vtkTypeBool DrawOnTop = 1;
  vtkTypeBool MoveDescendants = 1;
  double FullColor[3] = { 0.95, 0.58, 0.13 };
  double PositionColor[3] = { 0.20, 0.56, 0.86 };
  double FreeColor[3] = { 0.66, 0.66, 0.68 };
  double OutlineColor[3] = { 0.13, 0.13, 0.15 };
  double SelectedColor[3] = { 1.0, 1.0, 1.0 };
  vtkIdType HoveredHandle = -1;
  vtkIdType SelectedHandle = -1;
  vtkIdType ActiveHandle = -1;
  double Bounds[6];

  class Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
