#ifndef rest_surface_h
#define rest_surface_h

#include "conversion.h"
#include "surface/surface_probe.h"

#include "vtkSmartPointer.h"

#include <memory>
#include <utility>
#include <vector>

class vtkPolyData;

namespace bindpose
{

/// The surface that handles are placed on, or regions painted: its probe is built when it is asked
/// for, and again when points or cells have changed (arrays may change at every move of the mouse).
class RestSurface
{
public:
  RestSurface();
  ~RestSurface();
  void set(vtkPolyData* data);
  vtkPolyData* get() const;
  /// Null without a surface, or for one that has no triangle or cannot be read.
  const SurfaceProbe* probe();
  /// After probe() was not null.
  PointsView points() const { return this->input_.points.view(); }
  TrianglesView triangles() const { return this->input_.triangles.view(); }
  /// The vertex of a triangle nearest to a place.
  Vec3 nearest_vertex(Index triangle, const Vec3& place) const;
  /// The middle of its box; the origin without a surface.
  Vec3 center();

private:
  vtkSmartPointer<vtkPolyData> data_;
  std::vector<std::pair<const void*, vtkMTimeType>> read_; // what the probe was built of
  SurfaceInput input_;
  std::unique_ptr<SurfaceProbe> probe_;
};

} // namespace bindpose

#endif
