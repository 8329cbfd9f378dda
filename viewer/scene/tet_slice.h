#ifndef bindpose_scene_tet_slice_h
#define bindpose_scene_tet_slice_h

#include "base/mesh.h"

#include "vtkSmartPointer.h"

#include <vector>

class vtkPolyData;
class vtkUnstructuredGrid;

namespace bindpose
{

struct TetInput;

/// Where a plane goes through tets: triangles that carry the tets' point arrays, linear between
/// points, and cell arrays. Tets that the plane only touches from the side its normal points to
/// have none. 100,000 tets take about 10 ms.
vtkSmartPointer<vtkPolyData> slice_tets(
  vtkUnstructuredGrid* tets, const Vec3& origin, const Vec3& normal);

/// The tets with corners on both sides of a plane, or on it and behind it.
std::vector<Index> tets_at_plane(const TetInput& tets, const Vec3& origin, const Vec3& normal);

/// What of a surface lies on the side that the normal does not point to; triangles that the plane
/// goes through are cut there, with their arrays.
vtkSmartPointer<vtkPolyData> part_behind(
  vtkPolyData* surface, const Vec3& origin, const Vec3& normal);

} // namespace bindpose

#endif
