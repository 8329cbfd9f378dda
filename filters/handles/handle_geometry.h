#ifndef handle_geometry_h
#define handle_geometry_h

#include "BindposeFiltersModule.h" // for export macro
#include "base/status.h"
#include "inside/handle_elements.h"
#include "planar/planar_shape.h"

#include <array>
#include <string>
#include <vector>

class vtkPolyData;

namespace bindpose
{

/// Points and elements of a handle dataset, for meshers whose meshes must contain the handles.
struct HandleGeometry
{
  std::vector<Vec3> points;
  std::vector<std::array<Index, 2>> bones; ///< head and tail of each bone, as ids of points
  std::vector<std::vector<Index>> cage_elements; ///< edges and faces of cages, as ids of points
  std::vector<std::string> names; ///< names of all handles
  std::vector<Index>
    point_of_handle; ///< the point of each handle; for a bone its head, for a region -1
};

/// Convert a handle dataset (see vtkHandleFileReader): all handles, and also the cells that are
/// edges or faces of cages.
BINDPOSEFILTERS_EXPORT Status to_handle_geometry(vtkPolyData* data, HandleGeometry& geometry);

/// Return cage faces as triangles. Return bones, cage edges and the sides of cage faces as
/// segments.
BINDPOSEFILTERS_EXPORT HandleElements to_handle_elements(const HandleGeometry& geometry);

/// Return the handles projected to the xy plane. Bones, cage edges and the sides of cage faces
/// become segments.
PlanarHandles to_planar_handles(const HandleGeometry& geometry);

/// Add handles[].name and handles[].vertex to a report. The vertex is the mesh vertex at the
/// handle's point, -1 if there is none.
void report_handles(
  const HandleGeometry& geometry, const std::vector<Index>& vertex_of_point, Report& report);

} // namespace bindpose

#endif
