#include "surface_defects_data.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <array>
#include <unordered_map>

namespace bindpose
{

vtkSmartPointer<vtkPolyData> to_polydata(const std::vector<DefectOccurrence>& occurrences,
  PointsView points, const std::vector<Index>& cell_of_triangle)
{
  vtkNew<vtkPoints> used;
  used->SetDataTypeToDouble();
  vtkNew<vtkIdTypeArray> point_ids, cell_ids, crossed_ids, components, inward_indices;
  vtkNew<vtkIntArray> defects;
  vtkNew<vtkStringArray> names;
  point_ids->SetName("OriginalPointIds");
  defects->SetName("Defect");
  names->SetName("DefectName");
  cell_ids->SetName("OriginalCellIds");
  crossed_ids->SetName("CrossedCellIds");
  components->SetName("Component");
  inward_indices->SetName("InwardComponent");
  std::array<vtkNew<vtkCellArray>, 3> cells; // cells of each type: vertices, lines and triangles
  std::unordered_map<Index, vtkIdType> id_of;
  const auto cell_of = [&](Index triangle)
  { return triangle < 0 || cell_of_triangle.empty() ? triangle : cell_of_triangle[triangle]; };
  for (const DefectOccurrence& occurrence : occurrences)
  {
    std::array<vtkIdType, 3> ids{};
    for (std::size_t k = 0; k < occurrence.vertices.size(); ++k)
    {
      const Index v = occurrence.vertices[k];
      const auto [entry, fresh] = id_of.emplace(v, used->GetNumberOfPoints());
      if (fresh)
      {
        used->InsertNextPoint(points(v, 0), points(v, 1), points(v, 2));
        point_ids->InsertNextValue(v);
      }
      ids[k] = entry->second;
    }
    cells[occurrence.vertices.size() - 1]->InsertNextCell(
      static_cast<vtkIdType>(occurrence.vertices.size()), ids.data());
    defects->InsertNextValue(static_cast<int>(occurrence.defect));
    names->InsertNextValue(to_string(occurrence.defect));
    cell_ids->InsertNextValue(cell_of(occurrence.triangle));
    crossed_ids->InsertNextValue(cell_of(occurrence.crossed_triangle));
    components->InsertNextValue(occurrence.component);
    inward_indices->InsertNextValue(occurrence.inward_index);
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(used);
  result->SetVerts(cells[0]);
  result->SetLines(cells[1]);
  result->SetPolys(cells[2]);
  result->GetPointData()->AddArray(point_ids);
  result->GetCellData()->SetScalars(defects);
  for (vtkAbstractArray* array :
    { static_cast<vtkAbstractArray*>(names), static_cast<vtkAbstractArray*>(cell_ids),
      static_cast<vtkAbstractArray*>(crossed_ids), static_cast<vtkAbstractArray*>(components),
      static_cast<vtkAbstractArray*>(inward_indices) })
  {
    result->GetCellData()->AddArray(array);
  }
  return result;
}

} // namespace bindpose
