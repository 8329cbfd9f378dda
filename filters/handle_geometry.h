#ifndef handle_geometry_h
#define handle_geometry_h

#include "BindposeFiltersModule.h" // for export macro
#include "base/status.h"
#include "inside/handle_places.h"
#include "planar/planar_shape.h"

#include <array>
#include <string>
#include <vector>

class vtkPolyData;

namespace bindpose
{

/// Positions of the handles of a dataset, for meshers that make them part of the mesh.
struct HandleGeometry
{
  std::vector<Vec3> points;
  std::vector<std::array<Index, 2>> bones; ///< ids of points
  std::vector<std::vector<Index>> cage_elements; ///< edges and faces of cages, ids of points
  std::vector<std::string> names; ///< names of all handles
  std::vector<Index> point_of; ///< the point of each handle, for a bone its head; -1 for regions
};

/// Convert all handles (see vtkHandleFileReader) and the cage elements, which are not handles.
BINDPOSEFILTERS_EXPORT Status to_handle_geometry(vtkPolyData* data, HandleGeometry& geometry);

/// Return faces of cages as triangles, and their sides and the bones as segments.
BINDPOSEFILTERS_EXPORT HandlePlaces to_handle_places(const HandleGeometry& geometry);

/// Return the handles without z; sides of cage elements and bones become segments.
PlanarHandles to_planar_handles(const HandleGeometry& geometry);

/// Report handles[].name and handles[].vertex: the vertex of each handle's point, -1 if there is
/// none.
void report_handles(
  const HandleGeometry& geometry, const std::vector<Index>& vertex_of_point, Report& report);

} // namespace bindpose

#endif
