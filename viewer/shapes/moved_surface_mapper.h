#ifndef bindpose_shapes_moved_surface_mapper_h
#define bindpose_shapes_moved_surface_mapper_h

#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkOpenGLPolyDataMapper.h"

#include <vector>

namespace bindpose
{

/// A mapper for a surface whose points move in every frame while its triangles do not change. If
/// only points, point normals and tangents have changed, the mapper uploads only these arrays to
/// the graphics card. VTK's own mapper also rebuilds the list of triangles, which takes most of the
/// time.
///
/// For the upload, VTK also shifts and scales the points unless the diagonal of their bounding box
/// is near 1. This mapper shifts points only if they are so far from the origin that rounding to
/// single precision would be visible. For such points, it uses VTK's upload, which rebuilds the
/// list of triangles.
///
/// The bounds include all points. Therefore a surface must use all of its points, as
/// ShadedSurface::polydata() does.
class MovedSurfaceMapper : public vtkOpenGLPolyDataMapper
{
public:
  static MovedSurfaceMapper* New();
  vtkTypeMacro(MovedSurfaceMapper, vtkOpenGLPolyDataMapper);

  /// Duration of the last upload in microseconds.
  double upload_microseconds() const { return this->microseconds_; }
  /// Number of uploads so far that contained only points and normals.
  int move_count() const { return this->move_count_; }

protected:
  MovedSurfaceMapper() = default;
  void BuildBufferObjects(vtkRenderer* renderer, vtkActor* actor) override;
  void ComputeBounds() override;

private:
  bool upload_moved();
  void choose_shift();

  /// Addresses and modification times of all inputs of the last upload, except the modification
  /// times of points and normals.
  std::vector<vtkMTimeType> uploaded_state_;
  vtkNew<vtkFloatArray> positions_; ///< positions of the points, as uploaded to the graphics card
  vtkMTimeType bounds_time_ = 0; ///< modification time of the points that Bounds was computed from
  double microseconds_ = 0.0;
  int move_count_ = 0;
};

} // namespace bindpose

#endif
