/**
 * @class   vtkRegionBrushRepresentation
 * @brief   a disc on a surface that paints region labels
 *
 * Paints the point array `RegionId` of a surface (vtkPolyData) in place: under the mouse, the
 * vertices within Radius of where the line of sight meets the surface get the label RegionId, or 0
 * (free) while Erase is on. A handle of kind region with that RegionId then owns them; see
 * vtkHandleFileReader. It is the representation of vtkRegionBrushWidget.
 *
 * With Geodesic (on) the distance is along the surface, grown from triangle to triangle, so that
 * the brush does not reach through thin walls or over gaps; else it is through space, and all
 * vertices in the ball are painted.
 *
 * The array is an int array of one number a point, 0 where nothing is painted; it is made when
 * absent, and an array of another kind is written into as it is. A stroke is one step: all discs
 * from StartWidgetInteraction() to EndWidgetInteraction(), placed so densely along the mouse's way
 * that none is missed. CancelWidgetInteraction() gives the labels back as they were.
 *
 * Cost: at 100,000 triangles below a millisecond a disc of a tenth of the shape's size; the first
 * use on a surface builds a tree over its triangles (about 0.1 s).
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
  /// The surface that is painted.
  void SetSurface(vtkPolyData* surface);
  vtkPolyData* GetSurface();
  ///@}
  ///@{
  /// The label that is painted. Default 1, at least 1.
  vtkSetClampMacro(RegionId, int, 1, VTK_INT_MAX);
  vtkGetMacro(RegionId, int);
  ///@}
  ///@{
  /// Radius of the disc, world units. Default 0: a twentieth of the surface's diagonal; see
  /// GetDiscRadius().
  vtkSetClampMacro(Radius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Radius, double);
  ///@}
  /// Radius, or the number that stands for 0.
  double GetDiscRadius();
  ///@{
  /// Distances along the surface, else through space. Default on.
  vtkSetMacro(Geodesic, vtkTypeBool);
  vtkGetMacro(Geodesic, vtkTypeBool);
  vtkBooleanMacro(Geodesic, vtkTypeBool);
  ///@}
  ///@{
  /// Paint 0. Default off.
  vtkSetMacro(Erase, vtkTypeBool);
  vtkGetMacro(Erase, vtkTypeBool);
  vtkBooleanMacro(Erase, vtkTypeBool);
  ///@}
  ///@{
  /// Factor on the width of the disc's outline. Default 1, range 0.1 to 16.
  vtkSetClampMacro(PixelScale, double, 0.1, 64.0);
  vtkGetMacro(PixelScale, double);
  ///@}
  ///@{
  /// Colours of the disc's outline while it paints and while it erases.
  vtkSetVector3Macro(PaintColor, double);
  vtkGetVector3Macro(PaintColor, double);
  vtkSetVector3Macro(EraseColor, double);
  vtkGetVector3Macro(EraseColor, double);
  ///@}

  /// How many labels the stroke that goes on, or the last one, has changed.
  vtkIdType GetNumberOfChangedPoints();
  /// Whether a stroke goes on.
  bool IsPainting();

  ///@{
  /// vtkWidgetRepresentation and vtkProp.
  int ComputeInteractionState(int x, int y, int modify = 0) override;
  void StartWidgetInteraction(double eventPos[2]) override;
  void WidgetInteraction(double eventPos[2]) override;
  void EndWidgetInteraction(double eventPos[2]) override;
  void BuildRepresentation() override;
  void ReleaseGraphicsResources(vtkWindow* window) override;
  int RenderOverlay(vtkViewport* viewport) override;
  vtkTypeBool HasTranslucentPolygonalGeometry() override { return 0; }
  ///@}
  /// Ends the stroke and gives all labels back as they were when it began.
  void CancelWidgetInteraction();
  /// The mouse is not on the surface.
  void Leave();

protected:
  vtkRegionBrushRepresentation();
  ~vtkRegionBrushRepresentation() override;

private:
  vtkRegionBrushRepresentation(const vtkRegionBrushRepresentation&) = delete;
  void operator=(const vtkRegionBrushRepresentation&) = delete;

  bool FindPlace(const double eventPos[2]);
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
