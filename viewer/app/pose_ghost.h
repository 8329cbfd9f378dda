#ifndef pose_ghost_h
#define pose_ghost_h

#include "base/mesh.h"

#include "vtkDoubleArray.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <memory>

namespace bindpose
{
class Outline;
class MovedSurfaceMapper;
class ShadedSurface;
} // namespace bindpose
class Viewport;
class vtkActor;
class vtkRenderer;

/// A second shape of the viewport's surface. It is drawn semitransparent over the first shape where
/// they differ, or next to it in another half of the picture with the same camera.
class PoseGhost
{
public:
  enum Place
  {
    hidden,
    over,
    beside,
    in_colors ///< not drawn: the surface has the colors of the distance (DistanceView)
  };

  explicit PoseGhost(Viewport* viewport);
  ~PoseGhost();

  /// Set the surface of which the ghost is another shape; null: none.
  void set_surface(vtkPolyData* surface);
  /// Set the place, the points of the ghost, and those of the viewport's shape. Without points the
  /// ghost keeps its shape.
  void set_place(Place place, bindpose::PointsView points, bindpose::PointsView first);
  Place place() const { return this->place_; }
  void move(bindpose::PointsView points, bindpose::PointsView first);
  vtkRenderer* renderer() const { return this->renderer_; }
  /// Return the ghost as drawn; null before it was first shown.
  const bindpose::ShadedSurface* shaded() const { return this->shaded_.get(); }

private:
  bool is_drawn() const { return this->place_ == over || this->place_ == beside; }
  void make_shape();
  void fade(bindpose::PointsView points, bindpose::PointsView first);
  void update();
  void look_as_beside();
  void clipped();

  Viewport* viewport_;
  Place place_ = hidden;
  vtkNew<bindpose::MovedSurfaceMapper> mapper_;
  vtkNew<vtkActor> actor_;
  vtkNew<vtkLookupTable> fading_; // over the surface: transparent where both shapes coincide
  vtkNew<vtkDoubleArray> distances_; // per drawn point, in bounding-box diagonals
  vtkNew<vtkRenderer> renderer_; // of the second half
  vtkSmartPointer<vtkPolyData> surface_;
  std::unique_ptr<bindpose::ShadedSurface> shaded_;
  std::unique_ptr<bindpose::Outline> outline_; ///< in the second half
  bool in_window_ = false;
  bool clips_ = false; // clipped() is setting the range of both halves
};

#endif
