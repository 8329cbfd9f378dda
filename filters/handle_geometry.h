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

/// Where the handles of a dataset are, for meshers that make them part of the mesh.
struct HandleGeometry
{
  std::vector<Vec3> points;
  std::vector<std::array<Index, 2>> bones; ///< ids of points
  std::vector<std::vector<Index>> cage_elements; ///< edges and faces of cages, ids of points
  std::vector<std::string> names; ///< of every handle
  std::vector<Index> point_of; ///< of every handle: its point, of a bone its head; -1 for regions
};

/// All handles (see vtkHandleFileReader), and the cage elements, which are none.
BINDPOSEFILTERS_EXPORT Status to_handle_geometry(vtkPolyData* data, HandleGeometry& geometry);

/// Faces of cages as triangles, their sides and bones as segments.
BINDPOSEFILTERS_EXPORT HandlePlaces to_handle_places(const HandleGeometry& geometry);

/// z is left out; sides of cage elements and bones are segments.
PlanarHandles to_planar_handles(const HandleGeometry& geometry);

/// handles[].name and handles[].vertex: of each handle's point, -1 for none.
void report_handles(
  const HandleGeometry& geometry, const std::vector<Index>& vertex_of_point, Report& report);

} // namespace bindpose

#endif
