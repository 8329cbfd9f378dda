// Reads and writes pseudo-edges: lines between point handles that determine how points rotate
// (Jacobson et al., "Bounded Biharmonic Weights", 2011). They are cells of the handle dataset, but
// they are not handles.
#include "pseudo_edge_cells.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <map>

namespace bindpose
{

Status to_pseudo_edges(
  vtkPolyData* data, const Handles& handles, const std::vector<Index>& cells, PseudoEdges& edges)
{
  edges.clear();
  vtkDataArray* kinds = data->GetCellData()->GetArray("HandleKind");
  std::map<vtkIdType, Index> handle_at_point;
  std::map<std::array<double, 3>, Index> handle_at_position;
  vtkNew<vtkIdList> ids;
  for (std::size_t h = 0; kinds && h < handles.size(); ++h)
  {
    if (handles[h].kind == HandleKind::point)
    {
      data->GetCellPoints(static_cast<vtkIdType>(cells[h]), ids);
      const Vec3& position = handles[h].head;
      handle_at_point[ids->GetId(0)] = static_cast<Index>(h);
      handle_at_position[{ position[0], position[1], position[2] }] = static_cast<Index>(h);
    }
  }
  for (vtkIdType cell = 0; kinds && cell < kinds->GetNumberOfTuples(); ++cell)
  {
    if (kinds->GetComponent(cell, 0) != pseudo_edge_kind)
    {
      continue;
    }
    data->GetCellPoints(cell, ids);
    PseudoEdge edge{ -1, -1 };
    for (vtkIdType k = 0; k < 2 && ids->GetNumberOfIds() == 2; ++k)
    {
      const vtkIdType point = ids->GetId(k);
      std::array<double, 3> position{};
      data->GetPoint(point, position.data());
      const auto handle_of_point = handle_at_point.find(point);
      const auto handle_of_position = handle_at_position.find(position);
      edge[static_cast<std::size_t>(k)] = handle_of_point != handle_at_point.end()
        ? handle_of_point->second
        : handle_of_position != handle_at_position.end() ? handle_of_position->second
                                                         : -1;
    }
    if (edge[0] < 0 || edge[1] < 0 || edge[0] == edge[1])
    {
      return Status::invalid_input("handle cell " + std::to_string(cell) +
        " is a pseudo-edge and must connect two point handles");
    }
    edges.push_back({ std::min(edge[0], edge[1]), std::max(edge[0], edge[1]) });
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return {};
}

void add_pseudo_edges(vtkPolyData* data, const std::vector<Index>& cells, const PseudoEdges& edges)
{
  // Collect the end points before the lines change, because the change invalidates VTK's index of
  // the cells, which GetCellPoints() uses.
  std::vector<std::array<vtkIdType, 2>> ends;
  vtkNew<vtkIdList> ids;
  for (const PseudoEdge& edge : edges)
  {
    std::array<vtkIdType, 2> points{};
    for (std::size_t k = 0; k < 2; ++k)
    {
      data->GetCellPoints(cells[static_cast<std::size_t>(edge[k])], ids);
      points[k] = ids->GetId(0);
    }
    ends.push_back(points);
  }
  vtkNew<vtkCellArray> lines;
  lines->DeepCopy(data->GetLines());
  for (const auto& points : ends)
  {
    lines->InsertNextCell(2, points.data());
  }
  data->SetLines(lines);
  data->DeleteCells(); // removes VTK's internal index of the old cells
  const vtkIdType count = data->GetNumberOfCells();
  for (int i = 0; i < data->GetCellData()->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetCellData()->GetAbstractArray(i);
    const vtkIdType old_count = array->GetNumberOfTuples();
    array->Resize(count);
    array->SetNumberOfTuples(count);
    auto* numbers = vtkDataArray::SafeDownCast(array);
    const std::string name = array->GetName() ? array->GetName() : "";
    for (vtkIdType cell = old_count; cell < count; ++cell)
    {
      if (auto* texts = vtkStringArray::SafeDownCast(array))
      {
        texts->SetValue(cell, "");
      }
      for (int c = 0; numbers && c < numbers->GetNumberOfComponents(); ++c)
      {
        const bool diagonal = name == "Transform" && c % 5 == 0;
        numbers->SetComponent(cell, c,
          name == "HandleKind"              ? pseudo_edge_kind
            : name == "Parent"              ? -1
            : name == "Stretch" || diagonal ? 1
                                            : 0);
      }
    }
  }
}

} // namespace bindpose
