#ifndef bindpose_shapes_outline_h
#define bindpose_shapes_outline_h

#include "scene/colors.h"
#include "shapes/silhouette.h"

#include "vtkNew.h"
#include "vtkPolyData.h"

#include <memory>
#include <vector>

class vtkActor;
class vtkPolyDataMapper;
class vtkRenderer;

namespace bindpose
{

class ShadedSurface;

constexpr double outline_width = 1.3; ///< pixels

/// Draws the silhouette of a moving shape as lines on the shape. The lines are computed again for
/// every picture in which the shape or the view has changed.
class Outline
{
public:
  /// Draw in this renderer as long as the object exists.
  explicit Outline(vtkRenderer* renderer);
  ~Outline();

  /// Set the shape, which must exist until another shape is set or this object is destroyed; null:
  /// no shape.
  void set_shape(const ShadedSurface* shape);
  /// Show or hide the lines.
  /// @param width  line width in pixels of the window
  void show(bool shown, double width = 1.0);
  /// Return the silhouette edges of the last picture.
  const std::vector<Silhouette::Edge>& edges() const { return this->edges_; }

private:
  void before_drawing();

  vtkRenderer* renderer_;
  unsigned long observer_;
  const ShadedSurface* shape_ = nullptr;
  std::unique_ptr<Silhouette> silhouette_; ///< created for the first picture
  std::vector<Silhouette::Edge> edges_;
  vtkNew<vtkPolyData> lines_;
  vtkNew<vtkPolyDataMapper> mapper_;
  vtkNew<vtkActor> actor_;
  vtkMTimeType shape_time_ = 0; ///< modification time of the drawn shape
  vtkMTimeType view_time_ = 0;
};

} // namespace bindpose

#endif
