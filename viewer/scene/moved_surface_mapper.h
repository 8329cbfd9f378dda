#ifndef bindpose_scene_moved_surface_mapper_h
#define bindpose_scene_moved_surface_mapper_h

#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkOpenGLPolyDataMapper.h"

#include <vector>

namespace bindpose
{

/// A mapper for a surface whose points move in every frame while its triangles stay. Where only
/// points and point normals have changed, it brings these to the graphics card and keeps
/// everything else there; VTK's own mapper builds the list of triangles again as well, which takes
/// most of the time. VTK also shifts and scales points on the way to the graphics card unless their
/// bounding box has a diagonal near 1; here that is done only for points so far from the origin
/// that single precision would show, and then the slow way is taken.
///
/// Bounds are those of all points: a surface must use all of its points, as
/// ShadedSurface::polydata() does.
class MovedSurfaceMapper : public vtkOpenGLPolyDataMapper
{
public:
  static MovedSurfaceMapper* New();
  vtkTypeMacro(MovedSurfaceMapper, vtkOpenGLPolyDataMapper);

  /// Time that the last upload took. Unit: microseconds.
  double upload_microseconds() const { return this->microseconds_; }
  /// Number of uploads until now that brought points and normals only.
  int moves() const { return this->moves_; }

protected:
  MovedSurfaceMapper() = default;
  void BuildBufferObjects(vtkRenderer* renderer, vtkActor* actor) override;
  void ComputeBounds() override;

private:
  bool upload_moved();
  void choose_shift();

  /// Addresses and times of all that an upload depends on but points and normals.
  std::vector<vtkMTimeType> drawn_;
  vtkNew<vtkFloatArray> places_; ///< of the points, as the graphics card takes them
  vtkMTimeType bounds_time_ = 0; ///< of the points that Bounds is of
  double microseconds_ = 0.0;
  int moves_ = 0;
};

} // namespace bindpose

#endif
