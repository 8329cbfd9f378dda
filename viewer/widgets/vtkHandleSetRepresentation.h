/**
 * @class   vtkHandleSetRepresentation
 * @brief   draws, picks and drags all handles of a handle dataset
 *
 * Draws every handle of a handle polydata at its posed position (points, cage vertices and region
 * pivots as balls, bones as elongated octahedra with a ball at each end), finds the handle under
 * the mouse, and converts a drag to a new `Transform`. It is the representation of
 * vtkHandleSetWidget. Added to a renderer without the widget, it only draws.
 *
 * A handle is identified by its cell id in the handle dataset; -1 means no handle. Cage elements
 * (HandleKind -1) are not handles: they are drawn as thin bars and cannot be picked.
 *
 * **Dragging** writes absolute transforms (3x4, rest to posed) into the cell array `Transform`,
 * which is created if it is missing. For bones that stretch or twist, it also writes `Stretch` and
 * `Twist`. All other arrays do not change.
 * - A ball (point, cage vertex, region) or a bone's body or head moves in the plane through the
 *   grabbed position that faces the camera.
 * - A bone's tail turns the bone about its posed head, by the shortest rotation toward the mouse.
 *   The bone keeps its length, unless Reach is on: then the tail stays under the mouse.
 * - The gizmo (see SetGizmo()) is drawn at the selected handle. Its arrows move the handle along
 *   axes, its plates (small squares) move it in planes, its rings rotate it about the axes and
 *   about the viewing direction. Its boxes scale along the axes; the gray box or ring scales
 *   uniformly. For a bone, the box beyond the tail stretches the bone and the rings around it twist
 *   the bone.
 * - All selected handles move, rotate and scale together, about the grabbed handle. Dragging a
 *   tail, stretching and twisting affect one bone only.
 * - With MoveDescendants (on), the same motion is applied to all handles below the dragged handles
 *   in the hierarchy of `Parent`. The descendants of a stretched bone move with its tail; the
 *   descendants of a bone twisted at its tail rotate with the tail.
 * - A handle whose Mode is position never rotates: when a group of handles rotates, only its
 *   position follows the rotation.
 * - A handle whose Mode is free can be selected but not dragged, because the solver determines its
 *   position. A handle with a nonzero value in the cell array `Locked` cannot be dragged either; it
 *   only follows its parent. See GetDragRefusal().
 *
 * CancelWidgetInteraction() restores all poses bit for bit.
 *
 * **Stretch and twist** are read by the stretchable bones of vtkSkinningDeformation: `Stretch`, the
 * posed length divided by the rest length, and `Twist`, the angles in degrees at head and tail. For
 * methods that do not read these arrays, set StretchableBones off. Then a stretch scales the
 * transform along the bone. The gizmo has only one twist ring, which rotates the transform about
 * the bone.
 *
 * **Scale** along an axis is exact in the 3x4 transform. Scaling a rotated handle along the world's
 * axes causes a shear, which pose files cannot store.
 *
 * **Picking** is computed on the screen, without rendering. A part is hit if the mouse is within
 * its drawn radius plus PickTolerance. The order of priority is: boxes, cones and bone parts of the
 * gizmo; its plates; its shafts; its rings; its ring that faces the camera; then balls of points,
 * tails, heads, bodies. Among parts of equal priority, the nearest to the mouse wins, then the
 * nearest to the camera.
 *
 * In **edit modes** (SetEditMode()) handles are shown at rest, and edits change inputs of a bind in
 * place: points, cells and the arrays HandleName, HandleKind, Parent and RegionId. All other cell
 * arrays keep their values for each handle. New handles are at rest and have an unused name (p1,
 * b1, c1, …). An edit that would give an invalid handle dataset (two points at one position, a bone
 * of length 0) is refused; see GetEditMessage(). Points come before bones in the dataset, so the
 * cell ids of bones change when a point is added. Selected handles stay selected.
 * - MOVE_REST drags rest positions in the plane that faces the camera: points, cage vertices,
 *   pivots, ends of bones with all bones that meet there, whole bones by their body. If the dragged
 *   handle is selected, all selected handles move.
 * - ADD_POINTS adds a point where the button is released, on the surface (SetSurface()) under the
 *   mouse. With PlaceInside, the point is halfway between this position and the position where the
 *   line of sight leaves the inside again. The winding number determines the inside: overlapping
 *   and nested components form one common inside, and a cavity is outside. On an open surface, the
 *   point is halfway to the second intersection of the line of sight, or on the only intersection.
 *   Outside the surface, mouse events go to the camera.
 * - ADD_BONES draws a bone from the position of the press to that of the release, at the same
 *   depths as in ADD_POINTS. Outside the surface, its tail is in the plane through its head that
 *   faces the camera. A bone that begins at the end of another bone is a child of that bone, so
 *   that the next drag continues the chain.
 * - ADD_CAGE adds a cage vertex with every click. A cage edge joins it to the previous one. A click
 *   on the first vertex closes the cage; a click on another cage vertex adds an edge to it. The
 *   first vertex is on the surface under the mouse, if there is any. Every other vertex is in the
 *   plane that goes through the previous vertex and faces the camera. FinishCage() ends the cage
 *   without closing it.
 * - Snap moves positions to ends of other handles and to vertices of the surface. If none is near,
 *   moved rest positions snap to multiples of LengthStep.
 *
 * Sizes are in pixels of the window, multiplied by PixelScale (for pictures that are rendered
 * larger than the window). Handles are drawn over everything else unless DrawOnTop is off.
 */

#ifndef vtkHandleSetRepresentation_h
#define vtkHandleSetRepresentation_h

#include "BindposeWidgetsModule.h" // for export macro
#include "vtkWidgetRepresentation.h"
#include <memory> // for std::unique_ptr
#include <string> // for std::string

class vtkPolyData;
class vtkTextProperty;

namespace bindpose
{
struct DragSettings;
struct EditSettings;
struct GizmoSetup;
struct MouseState;
struct HandleRecord;
struct HandleSetState;
} // namespace bindpose

class BINDPOSEWIDGETS_EXPORT vtkHandleSetRepresentation : public vtkWidgetRepresentation
{
public:
  static vtkHandleSetRepresentation* New();
  vtkTypeMacro(vtkHandleSetRepresentation, vtkWidgetRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Values of the interaction state, which is the part under the mouse.
  enum InteractionStateType
  {
    OUTSIDE = 0, ///< the mouse is on no handle
    ON_POINT = 1, ///< the ball of a point, cage vertex or region
    ON_HEAD = 2, ///< a bone's head
    ON_TAIL = 3, ///< a bone's tail
    ON_BODY = 4, ///< a bone between its ends
    // The states from MOVE_X to TWIST_TAIL are parts of the gizmo at the selected handle.
    MOVE_X = 10, ///< MOVE_X, MOVE_Y and MOVE_Z: arrows that move the handle along an axis
    MOVE_Y,
    MOVE_Z,
    MOVE_YZ, ///< MOVE_YZ, MOVE_ZX and MOVE_XY: plates that move the handle in a plane of two axes
    MOVE_ZX,
    MOVE_XY,
    TURN_X = 20, ///< TURN_X, TURN_Y and TURN_Z: rings that rotate the handle about an axis
    TURN_Y,
    TURN_Z,
    TURN_VIEW, ///< ring that rotates the handle about the viewing direction
    SCALE_X = 30, ///< SCALE_X, SCALE_Y and SCALE_Z: boxes that scale the handle along an axis
    SCALE_Y,
    SCALE_Z,
    SCALE_ALL, ///< gray box or ring that scales the handle uniformly
    STRETCH = 40, ///< box beyond a bone's tail that stretches the bone
    TWIST_HEAD, ///< TWIST_HEAD and TWIST_TAIL: rings around a bone that twist the bone
    TWIST_TAIL,
    /// In the modes ADD_POINTS, ADD_BONES and ADD_CAGE: a position at which a press would add
    /// something.
    PLACING = 50
  };

  /// The effect of the mouse on handles.
  enum EditModeType
  {
    POSE = 0,
    MOVE_REST = 1,
    ADD_POINTS = 2,
    ADD_BONES = 3,
    ADD_CAGE = 4
  };

  /// The effect of the gizmo at the selected handle.
  enum GizmoType
  {
    GIZMO_NONE = 0, ///< handles are dragged directly
    GIZMO_MOVE = 1,
    GIZMO_TURN = 2,
    GIZMO_SCALE = 3,
    GIZMO_ALL = 4
  };

  enum SpaceType
  {
    WORLD = 0,
    LOCAL = 1 ///< the handle's own axes, rotated with the handle; the y axis is along a bone
  };

  /// The reason why a handle cannot be dragged.
  enum RefusalType
  {
    DRAGGABLE = 0,
    IS_FREE = 1, ///< the handle is in mode free
    IS_LOCKED = 2,
    IS_NO_HANDLE = 3, ///< the cell does not exist, or is a cage element
    IS_AT_REST = 4 ///< ShowRest is on
  };

  ///@{
  /// The handle dataset. It is edited in place. In the edit mode POSE only the pose arrays change.
  void SetHandles(vtkPolyData* handles);
  vtkPolyData* GetHandles();
  ///@}

  ///@{
  /// The edit mode, see EditModeType and the class documentation. Default POSE. A change of the
  /// mode ends the current interaction.
  void SetEditMode(int mode);
  vtkGetMacro(EditMode, int);
  ///@}
  ///@{
  /// Draw handles at rest in the edit mode POSE, whatever their pose. They can be selected but not
  /// dragged. Default off. A change ends the current interaction.
  void SetShowRest(vtkTypeBool show);
  vtkGetMacro(ShowRest, vtkTypeBool);
  vtkBooleanMacro(ShowRest, vtkTypeBool);
  ///@}
  ///@{
  /// The surface at rest on which handles are placed. Default null: handles are placed at the depth
  /// of the camera's focal point.
  void SetSurface(vtkPolyData* surface);
  vtkPolyData* GetSurface();
  ///@}
  ///@{
  /// Place points and bones inside the surface; otherwise on the surface. Default on.
  vtkSetMacro(PlaceInside, vtkTypeBool);
  vtkGetMacro(PlaceInside, vtkTypeBool);
  vtkBooleanMacro(PlaceInside, vtkTypeBool);
  ///@}
  ///@{
  /// Operations on the unfinished cage of ADD_CAGE: report whether there is one; end it without
  /// closing it; remove its last vertex with its edge. Return false if there is no unfinished cage.
  bool IsMakingCage();
  bool FinishCage();
  bool DropCageVertex();
  ///@}
  /// Return one sentence with the reason why the last edit was refused; empty if it was not
  /// refused.
  std::string GetEditMessage();
  /// Report whether the last press, release or call of DropCageVertex() has changed the handles.
  vtkGetMacro(Edited, bool);
  /// Report whether the button that began a drag or a placement is still pressed.
  bool IsInteracting();

  ///@{
  /// The gizmo at the selected handle; see GizmoType. Default GIZMO_NONE.
  vtkSetClampMacro(Gizmo, int, GIZMO_NONE, GIZMO_ALL);
  vtkGetMacro(Gizmo, int);
  ///@}
  ///@{
  /// The space whose axes the gizmo and the keys X, Y and Z use; see SpaceType. Default WORLD.
  vtkSetClampMacro(Space, int, WORLD, LOCAL);
  vtkGetMacro(Space, int);
  ///@}
  ///@{
  /// Size of the gizmo in pixels: the distance of the boxes of GIZMO_SCALE from the handle. All
  /// other parts are scaled by the same factor. Default 80, range 20 to 400.
  vtkSetClampMacro(GizmoSize, double, 20.0, 400.0);
  vtkGetMacro(GizmoSize, double);
  ///@}
  ///@{
  /// Write stretches and twists to `Stretch` and `Twist`; otherwise multiply them into `Transform`.
  /// See the class documentation. Default on.
  vtkSetMacro(StretchableBones, vtkTypeBool);
  vtkGetMacro(StretchableBones, vtkTypeBool);
  vtkBooleanMacro(StretchableBones, vtkTypeBool);
  ///@}
  ///@{
  /// Steps of drags while Snap is on. The displacement along each axis snaps to multiples of
  /// LengthStep; 0, the default, selects a round length near a fiftieth of the size of the
  /// renderer's content (see GetSnapLength()). Rotations snap to multiples of DegreeStep, in
  /// degrees (default 15). Factors snap to multiples of FactorStep (default 0.1).
  vtkSetClampMacro(LengthStep, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(LengthStep, double);
  vtkSetClampMacro(DegreeStep, double, 0.0, 180.0);
  vtkGetMacro(DegreeStep, double);
  vtkSetClampMacro(FactorStep, double, 0.0, 10.0);
  vtkGetMacro(FactorStep, double);
  ///@}
  /// Return LengthStep, or the automatic length if LengthStep is 0.
  double GetSnapLength();
  ///@{
  /// Modifiers of drags, all off by default. The widget sets them from Shift, Ctrl and Alt.
  /// - Fine: only a tenth of each following mouse motion is applied.
  /// - Snap: values snap to multiples of LengthStep, DegreeStep or FactorStep.
  /// - Reach: dragging a tail also stretches the bone.
  ///
  /// Fine and Snap may change during a drag. A change of Reach applies to the next drag.
  vtkSetMacro(Fine, vtkTypeBool);
  vtkGetMacro(Fine, vtkTypeBool);
  vtkSetMacro(Snap, vtkTypeBool);
  vtkGetMacro(Snap, vtkTypeBool);
  vtkSetMacro(Reach, vtkTypeBool);
  vtkGetMacro(Reach, vtkTypeBool);
  ///@}

  ///@{
  /// Radius of a ball in pixels. Default 7, range 1 to 100. Bone ends are 0.6 times as large.
  vtkSetClampMacro(PointSize, double, 1.0, 100.0);
  vtkGetMacro(PointSize, double);
  ///@}
  ///@{
  /// Half of a bone's width as a fraction of its length. The drawn half width is limited to the
  /// range from 0.5 to 2 ball radii. Default 0.08, range 0.001 to 0.5.
  vtkSetClampMacro(BoneWidth, double, 0.001, 0.5);
  vtkGetMacro(BoneWidth, double);
  ///@}
  ///@{
  /// A handle or gizmo part is hit if the mouse is at most this far from the drawn shape, in
  /// pixels. Default 4, range 0 to 100.
  vtkSetClampMacro(PickTolerance, double, 0.0, 100.0);
  vtkGetMacro(PickTolerance, double);
  ///@}
  ///@{
  /// Factor on all pixel measures and on the font size. Default 1, range 0.1 to 64.
  vtkSetClampMacro(PixelScale, double, 0.1, 64.0);
  vtkGetMacro(PixelScale, double);
  ///@}
  ///@{
  /// Show the names of all handles. Default off.
  vtkSetMacro(ShowLabels, vtkTypeBool);
  vtkGetMacro(ShowLabels, vtkTypeBool);
  vtkBooleanMacro(ShowLabels, vtkTypeBool);
  ///@}
  ///@{
  /// Show the name of the handle under the mouse. Default on.
  vtkSetMacro(ShowHoverName, vtkTypeBool);
  vtkGetMacro(ShowHoverName, vtkTypeBool);
  vtkBooleanMacro(ShowHoverName, vtkTypeBool);
  ///@}
  ///@{
  /// Draw over everything else in the renderer, so that handles inside a shape are visible. Default
  /// on.
  vtkSetMacro(DrawOnTop, vtkTypeBool);
  vtkGetMacro(DrawOnTop, vtkTypeBool);
  vtkBooleanMacro(DrawOnTop, vtkTypeBool);
  ///@}
  ///@{
  /// Move the handles below the dragged handle in the `Parent` hierarchy together with it. Default
  /// on.
  vtkSetMacro(MoveDescendants, vtkTypeBool);
  vtkGetMacro(MoveDescendants, vtkTypeBool);
  vtkBooleanMacro(MoveDescendants, vtkTypeBool);
  ///@}

  ///@{
  /// Allow drags of handles in mode free. Turn this on while a body is simulated: a drag then pulls
  /// the body, and the end of the drag releases the body. Default off.
  vtkSetMacro(DragFree, vtkTypeBool);
  vtkGetMacro(DragFree, vtkTypeBool);
  vtkBooleanMacro(DragFree, vtkTypeBool);
  ///@}

  ///@{
  /// On if the pose method computes rotations itself (see vtkReducedARAP). Such a method uses mode
  /// position for some handles in mode automatic, for example translated points. These handles are
  /// then drawn in PositionColor; with this property off, in FullColor. Default off.
  vtkSetMacro(FindsRotations, vtkTypeBool);
  vtkGetMacro(FindsRotations, vtkTypeBool);
  vtkBooleanMacro(FindsRotations, vtkTypeBool);
  ///@}

  ///@{
  /// Colors of handles and outlines. FullColor (default orange) is for the mode full, PositionColor
  /// (blue) for position, tail and ends, and FreeColor (gray) for free. OutlineColor is the color
  /// of outlines. A selected handle has an outline in SelectedColor, which an outline in
  /// OutlineColor surrounds.
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

  /// Font of names. Its size is multiplied by PixelScale. Default: Arial 13, dark on a light plate.
  vtkTextProperty* GetLabelTextProperty();

  ///@{
  /// Handle under the mouse, as found by ComputeInteractionState(); -1 if there is none.
  void SetHoveredHandle(vtkIdType handle);
  vtkGetMacro(HoveredHandle, vtkIdType);
  ///@}
  ///@{
  /// The handle that was selected last, at which the gizmo is drawn; -1 if there is none. Setting
  /// it deselects all other handles.
  void SetSelectedHandle(vtkIdType handle);
  vtkIdType GetSelectedHandle();
  ///@}
  ///@{
  /// The selected handles, in the order of their selection.
  void ToggleSelected(vtkIdType handle);
  bool IsSelected(vtkIdType handle);
  int GetNumberOfSelectedHandles();
  vtkIdType GetSelectedHandle(int number);
  void ClearSelection() { this->SetSelectedHandle(-1); }
  /// Select all handles whose position (the middle of a bone) is in a rectangle of the display, and
  /// deselect the other handles.
  void SelectInRectangle(const double corner[2], const double opposite[2]);
  ///@}
  /// Handle being dragged; -1 if there is none.
  vtkGetMacro(ActiveHandle, vtkIdType);

  /// Return DRAGGABLE, or the reason why the handle cannot be dragged; see RefusalType.
  int GetDragRefusal(vtkIdType handle);

  ///@{
  /// Translation t, rotation R, scale S, stretch and twist of a handle. A point x moves to
  /// c + t + R S (x - c). The pivot c is the handle's rest position (for a bone, its head). The
  /// scale S is along the handle's own axes at rest: the y axis of a bone is along the bone; other
  /// handles have the world's axes.
  ///
  /// Each setter changes one part and keeps the other parts, but setting the scale removes a shear.
  /// With MoveDescendants on, the descendants of the handle move with the handle. A setter changes
  /// nothing and returns false in these cases: the handle does not exist or is locked; a value is
  /// not finite; the axis has length 0; a factor is 0; a stretch is not positive; the handle of a
  /// stretch or twist is not a bone.
  bool SetHandleTranslation(vtkIdType handle, const double translation[3]);
  bool SetHandleRotation(vtkIdType handle, const double axis[3], double degrees);
  bool SetHandleScale(vtkIdType handle, const double factors[3]);
  bool SetHandleScale(vtkIdType handle, double factor);
  bool SetHandleStretch(vtkIdType handle, double ratio);
  bool SetHandleTwist(vtkIdType handle, double headDegrees, double tailDegrees);
  void GetHandleTranslation(vtkIdType handle, double translation[3]);
  /// Return the rotation angle in degrees, 0 to 180, and the axis as a unit vector.
  double GetHandleRotation(vtkIdType handle, double axis[3]);
  void GetHandleScale(vtkIdType handle, double factors[3]);
  double GetHandleStretch(vtkIdType handle);
  void GetHandleTwist(vtkIdType handle, double degrees[2]);
  /// Reset the handle to its rest pose; its mode is kept.
  bool ResetHandle(vtkIdType handle);
  ///@}

  ///@{
  /// Return the name, the mode (0 full, 1 position, 2 free, 3 tail, 4 ends, 5 auto) and the posed
  /// ends of a handle. If the handle is not a bone, its tail equals its head.
  std::string GetHandleName(vtkIdType handle);
  int GetHandleMode(vtkIdType handle);
  bool IsBone(vtkIdType handle);
  void GetPosedHead(vtkIdType handle, double head[3]);
  void GetPosedTail(vtkIdType handle, double tail[3]);
  ///@}

  /// Find the part under the display position and set its handle as the hovered handle. Return one
  /// of InteractionStateType.
  int ComputeInteractionState(int x, int y, int modify = 0) override;

  /// Clear the highlight. Call this when the mouse is not on a handle.
  void LeaveHandles();

  ///@{
  /// Start, continue and end one drag of the part that ComputeInteractionState() has found under
  /// the mouse. Nothing happens if there is no part (state OUTSIDE) or the handle cannot be
  /// dragged.
  void StartWidgetInteraction(double eventPos[2]) override;
  void WidgetInteraction(double eventPos[2]) override;
  void EndWidgetInteraction(double eventPos[2]) override;
  ///@}
  /// End the drag and restore all poses to their state at its start.
  void CancelWidgetInteraction();
  /// Start a drag of the selected handles by their pivots: a move in the plane that faces the
  /// camera, a rotation about the viewing direction, or a uniform scale. Return false if the handle
  /// that was selected last cannot be dragged, or cannot rotate or scale.
  bool StartDrag(int gizmo, double eventPos[2]);

  ///@{
  /// Constrain the current drag to an axis (0, 1, 2) or to the plane perpendicular to it. The first
  /// call uses the axes of Space. A second call with the same arguments uses the axes of the other
  /// space. A third call removes the constraint.
  void ConstrainDrag(int axis, bool plane);
  /// Handle a key that edits a typed value, which replaces the mouse: a digit, '.', '-' (toggles
  /// the sign) or 'b' (deletes the last character). The value is a length along the axis of the
  /// constraint (X without a constraint), degrees, or a factor. Return false for any other key.
  bool TypeIntoDrag(char key);
  ///@}
  ///@{
  /// The type of the current or last drag: "move", "turn", "scale", "stretch", "twist", or in edit
  /// modes "move rest", "add point", "add bone", "add cage vertex", "add cage edge", "close cage"
  /// or "remove cage vertex". GetInteractionText() returns the amount: "X 0.25", "30.0°".
  std::string GetInteractionName();
  std::string GetInteractionText();
  ///@}
  /// Return a display position at which a part of the gizmo (see InteractionStateType) can be
  /// grabbed. Return false if the part is not shown, because it is seen edge-on or is not in this
  /// gizmo.
  bool GetGizmoGrip(int part, double display[2]);

  ///@{
  /// Overridden methods of vtkWidgetRepresentation and vtkProp.
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

  bindpose::DragSettings MakeSettings();
  bindpose::GizmoSetup MakeGizmo(const bindpose::HandleRecord& record);
  bindpose::EditSettings MakeEditSettings();
  bindpose::MouseState MakeMouseState(const double eventPos[2]);
  void ApplyEditResult();
  void BeginDrag(int part, const double eventPos[2]);
  void UpdateDrag();
  bool WriteHandle(vtkIdType handle, const bindpose::HandleRecord& posed);

  bool DrawsRest() const { return this->ShowRest || this->EditMode != POSE; }

  int EditMode = POSE;
  vtkTypeBool ShowRest = 0;
  vtkTypeBool PlaceInside = 1;
  bool Edited = false;
  int Gizmo = GIZMO_NONE;
  int Space = WORLD;
  double GizmoSize = 80.0;
  vtkTypeBool StretchableBones = 1;
  double LengthStep = 0.0;
  double DegreeStep = 15.0;
  double FactorStep = 0.1;
  vtkTypeBool Fine = 0;
  vtkTypeBool Snap = 0;
  vtkTypeBool Reach = 0;
  double PointSize = 7.0;
  double BoneWidth = 0.08;
  double PickTolerance = 4.0;
  double PixelScale = 1.0;
  vtkTypeBool ShowLabels = 0;
  vtkTypeBool ShowHoverName = 1;
  vtkTypeBool DrawOnTop = 1;
  vtkTypeBool MoveDescendants = 1;
  vtkTypeBool DragFree = 0;
  vtkTypeBool FindsRotations = 0;
  double FullColor[3] = { 0.95, 0.58, 0.13 };
  double PositionColor[3] = { 0.20, 0.56, 0.86 };
  double FreeColor[3] = { 0.66, 0.66, 0.68 };
  double OutlineColor[3] = { 0.13, 0.13, 0.15 };
  double SelectedColor[3] = { 1.0, 1.0, 1.0 };
  vtkIdType HoveredHandle = -1;
  vtkIdType ActiveHandle = -1;
  double Bounds[6];

  std::unique_ptr<bindpose::HandleSetState> Internal;
};

#endif
