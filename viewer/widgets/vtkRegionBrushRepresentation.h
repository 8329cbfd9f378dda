/**
 * @class   vtkRegionBrushRepresentation
 * @brief   a disc on a surface that paints region labels
 *
 * Paints the point array `RegionId` of a surface (vtkPolyData) in place. The vertices within Radius
 * of the point where the line of sight intersects the surface get the label RegionId, or 0 (no
 * region) while Erase is on. A handle of kind region with that RegionId then owns these vertices;
 * see vtkHandleFileReader. The class is the representation of vtkRegionBrushWidget.
 *
 * With Geodesic (on), the distance is measured along the surface, from triangle to triangle, so
 * that the brush does not reach through thin walls or over gaps. Otherwise the distance is measured
 * through space, and all vertices in the ball are painted.
 *
 * The array is an int array with one label per point, 0 where nothing is painted. It is created if
 * it is missing; an existing array of another type keeps its type. A stroke consists of all discs
 * from StartWidgetInteraction() to EndWidgetInteraction(); it is one step for undo. The discs are
 * placed densely along the mouse's path, so that no vertex is missed. CancelWidgetInteraction()
 * restores the labels.
 *
 * On a surface with 100,000 triangles, a disc of a tenth of the shape's size takes less than a
 * millisecond. The first use on a surface builds a tree over its triangles (about 0.1 s).
 */

#ifndef vtkRegionBrushRepresentation_h
#define vtkRegionBrushRepresentation_h

#include "BindposeWidgetsModule.h" // for export macro
#include "vtkWidgetRepresentation.h"
#include <memory> // for std::unique_ptr

class vtkPolyData;

class BINDPOSEWIDGETS_EXPORT vtkRegionBrushRepresentation : public vtkWidgetRepresentation
{
public:
  static vtkRegionBrushRepresentation* New();
  vtkTypeMacro(vtkRegionBrushRepresentation, vtkWidgetRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum InteractionStateType
  {
    OUTSIDE = 0,
    ON_SURFACE = 1
  };

  ///@{
  /// The surface to paint.
  void SetSurface(vtkPolyData* surface);
  vtkPolyData* GetSurface();
  ///@}
  ///@{
  /// The label to paint. Default 1, at least 1.
  vtkSetClampMacro(RegionId, int, 1, VTK_INT_MAX);
  vtkGetMacro(RegionId, int);
  ///@}
  ///@{
  /// Radius of the disc, world units. Default 0: a twentieth of the surface's diagonal; see
  /// GetDiscRadius().
  vtkSetClampMacro(Radius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Radius, double);
  ///@}
  /// Return Radius, or the automatic radius if Radius is 0.
  double GetDiscRadius();
  ///@{
  /// Measure distances along the surface; otherwise through space. Default on.
  vtkSetMacro(Geodesic, vtkTypeBool);
  vtkGetMacro(Geodesic, vtkTypeBool);
  vtkBooleanMacro(Geodesic, vtkTypeBool);
  ///@}
  ///@{
  /// Erase: paint the label 0. Default off.
  vtkSetMacro(Erase, vtkTypeBool);
  vtkGetMacro(Erase, vtkTypeBool);
  vtkBooleanMacro(Erase, vtkTypeBool);
  ///@}
  ///@{
  /// Factor on the width of the disc's outline. Default 1, range 0.1 to 64.
  vtkSetClampMacro(PixelScale, double, 0.1, 64.0);
  vtkGetMacro(PixelScale, double);
  ///@}
  ///@{
  /// Colors of the disc's outline while painting and while erasing.
  vtkSetVector3Macro(PaintColor, double);
  vtkGetVector3Macro(PaintColor, double);
  vtkSetVector3Macro(EraseColor, double);
  vtkGetVector3Macro(EraseColor, double);
  ///@}

  /// Return the number of labels that the current or last stroke has changed.
  vtkIdType GetNumberOfChangedPoints();
  /// Report whether a stroke is in progress.
  bool IsPainting();

  ///@{
  /// Overridden methods of vtkWidgetRepresentation and vtkProp.
  int ComputeInteractionState(int x, int y, int modify = 0) override;
  void StartWidgetInteraction(double eventPos[2]) override;
  void WidgetInteraction(double eventPos[2]) override;
  void EndWidgetInteraction(double eventPos[2]) override;
  void BuildRepresentation() override;
  void ReleaseGraphicsResources(vtkWindow* window) override;
  int RenderOverlay(vtkViewport* viewport) override;
  vtkTypeBool HasTranslucentPolygonalGeometry() override { return 0; }
  ///@}
  /// End the stroke and restore all labels to their state at its start.
  void CancelWidgetInteraction();
  /// Hide the disc. Call this when the mouse is not on the surface.
  void Leave();

protected:
  vtkRegionBrushRepresentation();
  ~vtkRegionBrushRepresentation() override;

private:
  vtkRegionBrushRepresentation(const vtkRegionBrushRepresentation&) = delete;
  void operator=(const vtkRegionBrushRepresentation&) = delete;

  bool FindHit(const double eventPos[2]);
  void PaintDisc();

  int RegionId = 1;
  double Radius = 0.0;
  vtkTypeBool Geodesic = 1;
  vtkTypeBool Erase = 0;
  double PixelScale = 1.0;
  double PaintColor[3] = { 0.95, 0.58, 0.13 };
  double EraseColor[3] = { 0.45, 0.46, 0.50 };

  class Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
