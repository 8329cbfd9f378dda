#ifndef bindpose_scene_outline_h
#define bindpose_scene_outline_h

#include "scene/colours.h"
#include "scene/silhouette.h"

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

/// The silhouette of a shape that is bent and turned, drawn as lines on it: found anew for every
/// picture whose shape or view is another one.
class Outline
{
public:
  /// In this renderer, as long as the object lives.
  explicit Outline(vtkRenderer* renderer);
  ~Outline();

  /// The shape that is drawn, which must live as long; null: none.
  void set_shape(const ShadedSurface* shape);
  /// @param width  pixels of the window
  void show(bool shown, double width = 1.0);
  /// Edges of the last picture.
  const std::vector<Silhouette::Edge>& edges() const { return this->edges_; }

private:
  void before_drawing();

  vtkRenderer* renderer_;
  unsigned long observer_;
  const ShadedSurface* shape_ = nullptr;
  std::unique_ptr<Silhouette> silhouette_; ///< made for the first picture
  std::vector<Silhouette::Edge> edges_;
  vtkNew<vtkPolyData> lines_;
  vtkNew<vtkPolyDataMapper> mapper_;
  vtkNew<vtkActor> actor_;
  vtkMTimeType shape_time_ = 0; ///< of what is drawn
  vtkMTimeType view_time_ = 0;
};

} // namespace bindpose

#endif
