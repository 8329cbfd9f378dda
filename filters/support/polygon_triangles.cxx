#include "polygon_triangles.h"

#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolygon.h"

namespace bindpose
{

void triangulate_polygon(
  const std::vector<Vec3>& polygon, std::vector<std::array<Index, 3>>& triangles)
{
  triangles.clear();
  const auto count = static_cast<vtkIdType>(polygon.size());
  if (count > 4)
  {
    vtkNew<vtkPolygon> cell;
    cell->GetPointIds()->SetNumberOfIds(count);
    cell->GetPoints()->SetDataTypeToDouble();
    cell->GetPoints()->SetNumberOfPoints(count);
    for (vtkIdType k = 0; k < count; ++k)
    {
      cell->GetPointIds()->SetId(k, k);
      cell->GetPoints()->SetPoint(k, polygon[k].data());
    }
    vtkNew<vtkIdList> ids;
    if (cell->Triangulate(ids) && ids->GetNumberOfIds() == 3 * (count - 2))
    {
      for (vtkIdType t = 0; t + 2 < ids->GetNumberOfIds(); t += 3)
      {
        triangles.push_back({ ids->GetId(t), ids->GetId(t + 1), ids->GetId(t + 2) });
      }
      return;
    }
  }
  for (vtkIdType k = 1; k + 1 < count; ++k)
  {
    triangles.push_back({ 0, k, k + 1 });
  }
}

} // namespace bindpose
