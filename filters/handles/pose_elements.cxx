// Splits the cells of a mesh into simplices to measure their stretch. Meshes with hexes and other
// finite elements can be posed too: VTK's triangulation splits each such cell.
#include "pose_elements.h"

#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bindpose
{

namespace
{
/// Return the simplices of all volume cells, and the cell of each simplex.
void split_volume_cells(vtkPointSet* mesh, std::vector<Index>& corners, std::vector<Index>& cells)
{
  vtkNew<vtkGenericCell> cell;
  vtkNew<vtkIdList> ids;
  vtkNew<vtkPoints> points;
  for (vtkIdType c = 0; c < mesh->GetNumberOfCells(); ++c)
  {
    mesh->GetCell(c, cell);
    if (cell->GetCellDimension() != 3 || !cell->Triangulate(0, ids, points))
    {
      continue;
    }
    for (vtkIdType k = 0; k + 3 < ids->GetNumberOfIds(); k += 4)
    {
      corners.insert(corners.end(), ids->GetPointer(k), ids->GetPointer(k) + 4);
      cells.push_back(c);
    }
  }
}

} // namespace

PoseElements to_pose_elements(vtkPointSet* mesh)
{
  PoseElements elements;
  TetInput tets;
  if (to_tets(mesh, tets).ok())
  {
    elements.volume = true;
    elements.tets = tets.tets;
    return elements;
  }
  if (vtkUnstructuredGrid::SafeDownCast(mesh))
  {
    std::vector<Index> corners;
    split_volume_cells(mesh, corners, elements.cell_of_element);
    if (!corners.empty())
    {
      elements.volume = true;
      elements.tets.set_owned(
        Eigen::Map<const Tets>(corners.data(), static_cast<Index>(corners.size() / 4), 4));
      return elements;
    }
  }
  SurfaceInput surface;
  if (to_surface(mesh, surface).ok())
  {
    elements.triangles = surface.triangles;
    elements.cell_of_element = surface.cell_of_triangle;
  }
  return elements;
}
RestElements to_rest_elements(const PoseElements& elements, PointsView rest)
{
  return elements.volume ? RestElements(rest, elements.tets.view())
                         : RestElements(rest, elements.triangles.view());
}

Status measure_stretch(ExecutionContext& context, const ElementStretchOptions& options,
  const PoseElements& elements, const RestElements& rest, PointsView posed, vtkDataSet* result)
{
  ElementStretch stretch;
  const Status status = rest.stretch(context, options, posed, stretch);
  if (!status.ok() || !options.values)
  {
    return status;
  }
  vtkNew<vtkDoubleArray> array;
  array->SetName("Stretch");
  array->SetNumberOfComponents(2);
  array->SetComponentName(0, "largest");
  array->SetComponentName(1, "smallest");
  array->SetNumberOfTuples(result->GetNumberOfCells());
  array->Fill(std::numeric_limits<double>::quiet_NaN());
  for (std::size_t e = 0; e < stretch.largest.size(); ++e)
  {
    const Index cell =
      elements.cell_of_element.empty() ? static_cast<Index>(e) : elements.cell_of_element[e];
    double* cell_stretch = array->GetPointer(2 * cell);
    cell_stretch[0] = std::fmax(cell_stretch[0], stretch.largest[e]); // fmax ignores NaN
    cell_stretch[1] = std::fmin(cell_stretch[1], stretch.smallest[e]);
  }
  result->GetCellData()->AddArray(array);
  return status;
}

} // namespace bindpose
