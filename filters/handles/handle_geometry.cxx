// Conversion of handle datasets to points, segments and triangles.
#include "handle_geometry.h"

#include "conversion.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

namespace bindpose
{

namespace
{
/// Return the bones, the edges of cages and the sides of cage faces as segments.
std::vector<std::array<Index, 2>> segments_of(const HandleGeometry& geometry)
{
  std::vector<std::array<Index, 2>> segments = geometry.bones;
  for (const std::vector<Index>& element : geometry.cage_elements)
  {
    const std::size_t count = element.size();
    for (std::size_t k = count > 2 ? 0 : 1; k < count; ++k)
    {
      segments.push_back({ element[k > 0 ? k - 1 : count - 1], element[k] });
    }
  }
  return segments;
}

Segments to_segments(const std::vector<std::array<Index, 2>>& list)
{
  Segments segments(static_cast<Index>(list.size()), 2);
  for (std::size_t i = 0; i < list.size(); ++i)
  {
    segments.row(static_cast<Index>(i)) << list[i][0], list[i][1];
  }
  return segments;
}
} // namespace

Status to_handle_geometry(vtkPolyData* data, HandleGeometry& geometry)
{
  Handles list;
  const Status status = to_handles(data, list);
  if (!status.ok())
  {
    return status;
  }
  const auto add = [&](const Vec3& position)
  {
    geometry.points.push_back(position);
    return static_cast<Index>(geometry.points.size()) - 1;
  };
  for (const Handle& handle : list)
  {
    geometry.names.push_back(handle.name);
    geometry.point_of_handle.push_back(handle.kind == HandleKind::region ? -1 : add(handle.head));
    if (handle.kind == HandleKind::bone)
    {
      geometry.bones.push_back({ geometry.point_of_handle.back(), add(handle.tail) });
    }
  }
  // Add the cage edges and cage faces. These cells are not handles, so to_handles() has not
  // returned them. Weights are linear on cage edges and faces, so the mesh must contain them.
  vtkDataArray* kinds = data->GetCellData()->GetArray("HandleKind");
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; kinds && cell < data->GetNumberOfCells(); ++cell)
  {
    if (kinds->GetComponent(cell, 0) != static_cast<double>(HandleKind::cage_element))
    {
      continue;
    }
    data->GetCellPoints(cell, ids);
    std::vector<Index> element;
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
    {
      element.push_back(add(Vec3(data->GetPoint(ids->GetId(k))))); // ids were checked by to_handles
    }
    geometry.cage_elements.push_back(std::move(element));
  }
  return {};
}

HandleElements to_handle_elements(const HandleGeometry& geometry)
{
  HandleElements handle_elements;
  handle_elements.points.resize(static_cast<Index>(geometry.points.size()), 3);
  for (std::size_t i = 0; i < geometry.points.size(); ++i)
  {
    handle_elements.points.row(static_cast<Index>(i)) = geometry.points[i];
  }
  handle_elements.segments = to_segments(segments_of(geometry));
  std::vector<std::array<Index, 3>> triangles;
  for (const std::vector<Index>& element : geometry.cage_elements)
  {
    for (std::size_t k = 2; k < element.size(); ++k)
    {
      triangles.push_back({ element[0], element[k - 1], element[k] });
    }
  }
  handle_elements.triangles.resize(static_cast<Index>(triangles.size()), 3);
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    handle_elements.triangles.row(static_cast<Index>(i)) << triangles[i][0], triangles[i][1],
      triangles[i][2];
  }
  return handle_elements;
}

PlanarHandles to_planar_handles(const HandleGeometry& geometry)
{
  PlanarHandles handles;
  handles.points.resize(static_cast<Index>(geometry.points.size()), 2);
  for (std::size_t i = 0; i < geometry.points.size(); ++i)
  {
    handles.points.row(static_cast<Index>(i)) = geometry.points[i].head<2>();
  }
  handles.bones = to_segments(segments_of(geometry));
  return handles;
}

void report_handles(
  const HandleGeometry& geometry, const std::vector<Index>& vertex_of_point, Report& report)
{
  std::vector<Index> vertices;
  for (const Index point : geometry.point_of_handle)
  {
    vertices.push_back(point < 0 ? -1 : vertex_of_point[point]);
  }
  report.set("handles[].name", geometry.names);
  report.set("handles[].vertex", vertices);
}

} // namespace bindpose
