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

/// The surface on which handles are placed or regions are painted, and its SurfaceProbe, which
/// finds ray intersections and tests whether positions are inside. The probe is built on demand,
/// and built again after points or polygons have changed. The probe does not depend on data arrays,
/// which may change with every move of the mouse.
class RestSurface
{
public:
  RestSurface();
  ~RestSurface();
  void set(vtkPolyData* data);
  vtkPolyData* get() const;
  /// Return the probe. Return null without a surface, or if the surface has no triangle or cannot
  /// be read.
  const SurfaceProbe* probe();
  /// Number of times that a probe was built. It increases when points or triangles have changed.
  int build_count() const { return this->build_count_; }
  /// Return the points of the surface; valid after probe() has returned a probe.
  PointsView points() const { return this->input_.points.view(); }
  TrianglesView triangles() const { return this->input_.triangles.view(); }
  /// Return the position of the triangle's vertex that is nearest to `position`.
  Vec3 nearest_vertex(Index triangle, const Vec3& position) const;
  /// Return the center of the surface's bounding box; the origin without a surface.
  Vec3 center();

private:
  vtkSmartPointer<vtkPolyData> data_;
  // The objects from which the probe was built, and their modification times at that moment.
  std::vector<std::pair<const void*, vtkMTimeType>> probe_inputs_;
  SurfaceInput input_;
  int build_count_ = 0;
  std::unique_ptr<SurfaceProbe> probe_;
};

} // namespace bindpose

#endif
