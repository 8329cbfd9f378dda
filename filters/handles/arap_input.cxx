// Input conversion and binding shared by the filters of as-rigid-as-possible (ARAP) deformation.
#include "arap_input.h"

#include "vtkArapEnergy.h"

#include "vtkCell.h"
#include "vtkUnstructuredGrid.h"

namespace bindpose
{

namespace
{
bool has_volume_cells(vtkDataSet* mesh)
{
  auto* grid = vtkUnstructuredGrid::SafeDownCast(mesh);
  for (vtkIdType c = 0; grid && c < grid->GetNumberOfCells(); ++c)
  {
    if (grid->GetCell(c)->GetCellDimension() == 3)
    {
      return true;
    }
  }
  return false;
}
} // namespace

Status to_arap(vtkPointSet* mesh, int energy, ArapElements& elements, ArapEnergy& result)
{
  elements.volume = has_volume_cells(mesh);
  const Status status =
    elements.volume ? to_tets(mesh, elements.tets) : to_surface(mesh, elements.surface);
  if (!status.ok())
  {
    return status;
  }
  if (elements.volume && energy == vtkArapEnergy::TRIANGLES)
  {
    return Status::invalid_input(
      "energy triangles needs a surface mesh, but the input is a tet mesh");
  }
  if (!elements.volume && energy == vtkArapEnergy::TETRAHEDRA)
  {
    return Status::invalid_input(
      "energy tetrahedra needs a tet mesh, but the input is a surface mesh");
  }
  result = energy == vtkArapEnergy::AUTO       ? ArapEnergy::automatic
    : energy == vtkArapEnergy::SPOKES_AND_RIMS ? ArapEnergy::spokes_and_rims
    : energy == vtkArapEnergy::SPOKES          ? ArapEnergy::spokes
                                               : ArapEnergy::elements;
  return {};
}

const char* arap_energy_name(int energy)
{
  switch (energy)
  {
    case vtkArapEnergy::SPOKES_AND_RIMS:
      return "spokes and rims";
    case vtkArapEnergy::TETRAHEDRA:
      return "tetrahedra";
    case vtkArapEnergy::TRIANGLES:
      return "triangles";
    case vtkArapEnergy::SPOKES:
      return "spokes";
    default:
      return "auto";
  }
}

} // namespace bindpose
