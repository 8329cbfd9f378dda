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
 * which is made when absent, and for bones that stretch or twist `Stretch` and `Twist`; all other
 * arrays are left alone.
 * - a ball (point, cage vertex, region) or a bone's body or head: translation in the plane through
 *   the grabbed place that faces the camera;
 * - a bone's tail: rotation about the bone's posed head, the shortest that turns the bone towards
 *   the mouse. The bone's length stays, unless Reach is on: then the tail stays under the mouse.
 * - a part of the gizmo (see SetGizmo()), which stands at the selected handle: arrows move along
 *   its axes, plates in its planes, rings turn about its axes and about the line of sight, boxes
 *   scale along its axes, the grey box or ring scales evenly; of a bone the box beyond its tail
 *   stretches it and the rings around it twist it.
 * - All selected handles move, turn and scale together, about the one that is grabbed. Tails,
 *   stretches and twists are of one bone alone.
 * - With MoveDescendants (on) the same motion is applied to all handles below them by `Parent`; of
 *   a stretched bone these move with the tail, of one twisted at its tail they turn with it.
 * - A handle whose Mode is position only moves: when others turn, it goes with its place. One whose
 *   Mode is free can be selected but not dragged, its place is for the solver to find; nor can one
 *   with a number other than 0 in the cell array `Locked` (it follows its parent). See
 *   GetDragRefusal().
 *
 * CancelWidgetInteraction() gives all poses back as they were, bit by bit.
 *
 * **Stretch and twist** are what vtkSkinningDeformation's stretchable bones read: `Stretch`, the
 * posed length over the rest length, and `Twist`, the angles in degrees at head and tail. Methods
 * that do not read them need StretchableBones off: then a stretch scales the transform along the
 * bone, and a twist, of one ring, turns it about the bone.
 *
 * **Scale** along an axis is exact in the 3x4 transform; in world space of a turned handle it
 * makes a shear, which pose files cannot hold.
 *
 * **Picking** happens on the screen, without rendering: a place counts when the mouse is within
 * its drawn radius plus PickTolerance. The order of priority is: boxes, cones and bone parts of the
 * gizmo, its plates, its shafts, its rings, its ring that faces the camera; then balls of points,
 * tails, heads, bodies; among equals the nearest to the mouse wins, then the one nearest to the
 * camera.
 *
 * **Edit modes** (SetEditMode()) show handles at rest and change what a bind depends on: points,
 * cells and the arrays HandleName, HandleKind, Parent and RegionId, in place. All other cell arrays
 * follow their handles, new ones are at rest with a free name (p1, b1, c1, …). What would not be a
 * valid handle dataset (two points at one place, a bone without length) is refused:
 * GetEditMessage(). Cells are numbered points first, so numbers of bones move when a point is
 * added; selected handles stay selected.
 * - MOVE_REST drags rest places in the plane that faces the camera: points, cage vertices, pivots,
 *   ends of bones with all bones that meet there, whole bones by their body; of several selected
 *   handles all.
 * - ADD_POINTS puts a point where the button is released: on the surface (SetSurface()) under the
 *   mouse or, with PlaceInside, halfway to where the line of sight comes out again, by winding
 *   number (overlapping and nested parts are one, a cavity ends it; an open surface: halfway to the
 *   second hit, or on the only one). Beside the surface the camera has the mouse.
 * - ADD_BONES draws a bone from where the button goes down to where it comes up, at the same
 * depths; beside the surface its tail stays in the plane through its head that faces the camera.
 * From the end of a bone it is that bone's child, so the next drag continues the chain.
 * - ADD_CAGE adds a cage vertex with every click, joined to the last one by a cage's edge; a click
 * on the first one closes the cage, one on another cage vertex joins it. The first lies on the
 *   surface under the mouse, if there is any, the others in the plane through it that faces the
 *   camera. FinishCage() leaves it open.
 * - Snap places on ends of other handles and on vertices of the surface, or, moving rest places
 * away from any, in steps.
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

namespace bindpose
{
struct DragSettings;
struct EditSettings;
struct GizmoSetup;
struct Hand;
struct HandlePlace;
} // namespace bindpose

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
    ON_BODY = 4, ///< a bone between its ends
    // parts of the gizmo at the selected handle
    MOVE_X = 10, ///< arrows
    MOVE_Y,
    MOVE_Z,
    MOVE_YZ, ///< plates
    MOVE_ZX,
    MOVE_XY,
    TURN_X = 20, ///< rings
    TURN_Y,
    TURN_Z,
    TURN_VIEW, ///< about the line of sight
    SCALE_X = 30, ///< boxes
    SCALE_Y,
    SCALE_Z,
    SCALE_ALL,
    STRETCH = 40, ///< the box beyond a bone's tail
    TWIST_HEAD, ///< rings around a bone
    TWIST_TAIL,
    PLACING = 50 ///< an edit mode has a place for what the button would add
  };

  /// What the hand does with handles.
  enum EditModeType
  {
    POSE = 0,
    MOVE_REST = 1,
    ADD_POINTS = 2,
    ADD_BONES = 3,
    ADD_CAGE = 4
  };

  /// What the gizmo at the selected handle does.
  enum GizmoType
  {
    GIZMO_NONE = 0, ///< handles are dragged by themselves
    GIZMO_MOVE = 1,
    GIZMO_TURN = 2,
    GIZMO_SCALE = 3,
    GIZMO_ALL = 4
  };

  enum SpaceType
  {
    WORLD = 0,
    LOCAL = 1 ///< the handle's own axes, turned with it; a bone's y axis is along it
  };

  /// Why a handle cannot be dragged.
  enum RefusalType
  {
    DRAGGABLE = 0,
    IS_FREE = 1, ///< its Mode is free
    IS_LOCKED = 2,
    IS_NO_HANDLE = 3, ///< no such cell, or a cage element
    IS_AT_REST = 4 ///< ShowRest is on
  };

  ///@{
  /// The handle dataset. It is edited in place: in POSE the pose arrays only.
  void SetHandles(vtkPolyData* handles);
  vtkPolyData* GetHandles();
  ///@}

  ///@{
  /// See EditModeType and the class's text. Default POSE. Changing it ends what was begun.
  void SetEditMode(int mode);
  vtkGetMacro(EditMode, int);
  ///@}
  ///@{
  /// In POSE: draw handles at rest, whatever their pose. They can be selected, not dragged. Default
  /// off. Changing it ends what was begun.
  void SetShowRest(vtkTypeBool show);
  vtkGetMacro(ShowRest, vtkTypeBool);
  vtkBooleanMacro(ShowRest, vtkTypeBool);
  ///@}
  ///@{
  /// The surface at rest that handles are placed on. Default none: they are placed at the depth of
  /// the camera's focal point.
  void SetSurface(vtkPolyData* surface);
  vtkPolyData* GetSurface();
  ///@}
  ///@{
  /// Whether points and bones are placed inside the surface, else on it. Default on.
  vtkSetMacro(PlaceInside, vtkTypeBool);
  vtkGetMacro(PlaceInside, vtkTypeBool);
  vtkBooleanMacro(PlaceInside, vtkTypeBool);
  ///@}
  ///@{
  /// The cage that ADD_CAGE is making: whether there is one; ends it, open; takes its last vertex
  /// away, with its edge. False when there is none.
  bool IsMakingCage();
  bool FinishCage();
  bool DropCageVertex();
  ///@}
  /// Why the last edit was refused, in one sentence; empty when it was not.
  std::string GetEditMessage();
  /// Whether the last press, release or drop has changed the handles.
  vtkGetMacro(Edited, bool);
  /// Whether the button that began a drag or a placing is held still.
  bool IsInteracting();

  ///@{
  /// The gizmo: see GizmoType. Default GIZMO_NONE.
  vtkSetClampMacro(Gizmo, int, GIZMO_NONE, GIZMO_ALL);
  vtkGetMacro(Gizmo, int);
  ///@}
  ///@{
  /// The axes of the gizmo, and of the keys X, Y and Z: see SpaceType. Default WORLD.
  vtkSetClampMacro(Space, int, WORLD, LOCAL);
  vtkGetMacro(Space, int);
  ///@}
  ///@{
  /// Length of the arrows of a gizmo that only moves, in pixels. Default 80, range 20 to 400.
  vtkSetClampMacro(GizmoSize, double, 20.0, 400.0);
  vtkGetMacro(GizmoSize, double);
  ///@}
  ///@{
  /// Whether stretches and twists are written to `Stretch` and `Twist`, else into `Transform`; see
  /// the class's text. Default on.
  vtkSetMacro(StretchableBones, vtkTypeBool);
  vtkGetMacro(StretchableBones, vtkTypeBool);
  vtkBooleanMacro(StretchableBones, vtkTypeBool);
  ///@}
  ///@{
  /// Steps of drags that snap: of lengths, along each axis, from where the drag began (0, the
  /// default: a round number near a fiftieth of what the renderer shows; see GetSnapLength()), of
  /// angles in degrees (default 15), of factors (default 0.1).
  vtkSetClampMacro(LengthStep, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(LengthStep, double);
  vtkSetClampMacro(DegreeStep, double, 0.0, 180.0);
  vtkGetMacro(DegreeStep, double);
  vtkSetClampMacro(FactorStep, double, 0.0, 10.0);
  vtkGetMacro(FactorStep, double);
  ///@}
  /// LengthStep, or the number that stands for 0.
  double GetSnapLength();
  ///@{
  /// How the drag that goes on takes the mouse, and may be changed at any time of it: Fine, a tenth
  /// of its motion from now on; Snap, in steps; Reach (from the next drag on), tails stretch their
  /// bones. Default off. The widget sets them by Shift, Ctrl and Alt.
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
  vtkSetClampMacro(PixelScale, double, 0.1, 64.0);
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
  /// Whether free handles can be dragged all the same: a body that moves is pulled by them and let
  /// go. Default off.
  vtkSetMacro(DragFree, vtkTypeBool);
  vtkGetMacro(DragFree, vtkTypeBool);
  vtkBooleanMacro(DragFree, vtkTypeBool);
  ///@}

  ///@{
  /// Draw handles in mode automatic as a method that finds rotations treats them (see
  /// vtkReducedARAP): those that are only translated as mode position. Off by default.
  vtkSetMacro(FindsRotations, vtkTypeBool);
  vtkGetMacro(FindsRotations, vtkTypeBool);
  vtkBooleanMacro(FindsRotations, vtkTypeBool);
  ///@}

  ///@{
  /// Colours by Mode (full: orange, position and ends: blue, free: grey) and of the outline; the
  /// selected handle's outline has its own, with the outline's colour around it.
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
  /// The handle that was selected last, at which the gizmo stands; -1: none. Setting it selects it
  /// alone.
  void SetSelectedHandle(vtkIdType handle);
  vtkIdType GetSelectedHandle();
  ///@}
  ///@{
  /// Several selected handles, in the order in which they were.
  void ToggleSelected(vtkIdType handle);
  bool IsSelected(vtkIdType handle);
  int GetNumberOfSelectedHandles();
  vtkIdType GetSelectedHandle(int number);
  void ClearSelection() { this->SetSelectedHandle(-1); }
  /// Selects all handles whose place (of a bone its middle) is in a rectangle of the display, and
  /// no others.
  void SelectInRectangle(const double corner[2], const double opposite[2]);
  ///@}
  /// Handle being dragged; -1: none.
  vtkGetMacro(ActiveHandle, vtkIdType);

  /// DRAGGABLE or why not: see RefusalType.
  int GetDragRefusal(vtkIdType handle);

  ///@{
  /// The pose of a handle with pivot c (its place at rest, of a bone its head), in numbers: x goes
  /// to c + translation + R S (x - c), R the rotation, S a scale along the handle's own axes at
  /// rest (the world's; of a bone y is along it). Each sets one part and keeps the others, a shear
  /// but goes when the scale is set; with MoveDescendants those below go along. False, and
  /// nothing changes, when there is no such handle, it is locked, or a number is not finite, the
  /// axis has no length, a factor is 0 or a stretch not positive.
  bool SetHandleTranslation(vtkIdType handle, const double translation[3]);
  bool SetHandleRotation(vtkIdType handle, const double axis[3], double degrees);
  bool SetHandleScale(vtkIdType handle, const double factors[3]);
  bool SetHandleScale(vtkIdType handle, double factor);
  bool SetHandleStretch(vtkIdType handle, double ratio);
  bool SetHandleTwist(vtkIdType handle, double headDegrees, double tailDegrees);
  void GetHandleTranslation(vtkIdType handle, double translation[3]);
  /// The angle in degrees, 0 to 180, about an axis of length 1.
  double GetHandleRotation(vtkIdType handle, double axis[3]);
  void GetHandleScale(vtkIdType handle, double factors[3]);
  double GetHandleStretch(vtkIdType handle);
  void GetHandleTwist(vtkIdType handle, double degrees[2]);
  /// Back to rest, with the mode kept.
  bool ResetHandle(vtkIdType handle);
  ///@}

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

  /// The mouse is on nothing.
  void LeaveHandles();

  ///@{
  /// One drag: grabs what the interaction state says (nothing when outside or free), follows the
  /// display position, ends. The state and hovered handle come from ComputeInteractionState().
  void StartWidgetInteraction(double eventPos[2]) override;
  void WidgetInteraction(double eventPos[2]) override;
  void EndWidgetInteraction(double eventPos[2]) override;
  ///@}
  /// Ends the drag and restores all poses as they were when it began.
  void CancelWidgetInteraction();
  /// Starts a drag of the selected handles without holding any part of them: a move in the plane
  /// that faces the camera, a turn about the line of sight, or an even scale. False when there is
  /// nothing that can be dragged, or it does not turn or scale.
  bool StartDrag(int gizmo, double eventPos[2]);

  ///@{
  /// While a drag goes on: holds it to an axis (0, 1, 2), or to the plane across it. The first time
  /// in Space, the second in the other space, the third not at all.
  void ConstrainDrag(int axis, bool plane);
  /// A key of a number that is taken in place of the mouse: a digit, '.', '-' (turns the sign), 'b'
  /// (takes the last one back). A length along the axis that the drag is held to (X when to none),
  /// degrees, or a factor. False for any other key.
  bool TypeIntoDrag(char key);
  ///@}
  ///@{
  /// What the drag does, or did last: "move", "turn", "scale", "stretch", "twist", or in edit modes
  /// "move rest", "add point", "add bone", "add cage vertex", "add cage edge", "close cage" or
  /// "remove cage vertex"; and how much, in words: "X 0.25", "30.0°".
  std::string GetInteractionName();
  std::string GetInteractionText();
  ///@}
  /// Where a part of the gizmo (see InteractionStateType) is best grabbed, in display coordinates.
  /// False when it is not shown: seen edge-on, or not of this gizmo.
  bool GetGizmoGrip(int part, double display[2]);

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

  bindpose::DragSettings MakeSettings();
  bindpose::GizmoSetup MakeGizmo(const bindpose::HandlePlace& place);
  bindpose::EditSettings MakeEditSettings();
  bindpose::Hand MakeHand(const double eventPos[2]);
  void TakeEdit();
  void BeginDrag(int part, const double eventPos[2]);
  void UpdateDrag();
  bool WriteHandle(vtkIdType handle, const bindpose::HandlePlace& posed);

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

  class Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
