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

/// Another shape of the viewport's surface: see-through over it, as far as it is elsewhere, or
/// beside it in a half of its own that is seen from the same place.
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

  /// The surface that has another shape; null: none.
  void set_surface(vtkPolyData* surface);
  /// With the shape that is to be seen there, and the one in the viewport; no points: the last one.
  void set_place(Place place, bindpose::PointsView points, bindpose::PointsView first);
  Place place() const { return this->place_; }
  void move(bindpose::PointsView points, bindpose::PointsView first);
  vtkRenderer* renderer() const { return this->renderer_; }
  /// As drawn; null before it was seen.
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
  vtkNew<vtkLookupTable> fading_; // over the surface: clear where both shapes coincide
  vtkNew<vtkDoubleArray> distances_; // of each drawn point, in diagonals
  vtkNew<vtkRenderer> renderer_; // of the half beside
  vtkSmartPointer<vtkPolyData> surface_;
  std::unique_ptr<bindpose::ShadedSurface> shaded_;
  std::unique_ptr<bindpose::Outline> outline_; ///< beside
  bool in_window_ = false;
  bool clips_ = false; // for both halves
};

#endif
