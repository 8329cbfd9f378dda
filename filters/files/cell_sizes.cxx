#include "cell_sizes.h"

#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkGenericCell.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <array>
#include <string>

namespace bindpose
{

namespace
{
/// Call `visit(cell, size)` for each cell until it returns false.
template <typename Value, typename Visit>
void visit_sizes(const Value* offsets, vtkIdType cells, const Visit& visit)
{
  for (vtkIdType cell = 0; cell < cells; ++cell)
  {
    if (!visit(cell, static_cast<vtkIdType>(offsets[cell + 1] - offsets[cell])))
    {
      return;
    }
  }
}

template <typename Visit>
void visit_sizes(vtkCellArray* cells, const Visit& visit)
{
  const vtkIdType count = cells ? cells->GetNumberOfCells() : 0;
  if (count == 0)
  {
    return;
  }
  if (cells->IsStorage64Bit())
  {
    visit_sizes(cells->GetOffsetsArray64()->GetPointer(0), count, visit);
  }
  else
  {
    visit_sizes(cells->GetOffsetsArray32()->GetPointer(0), count, visit);
  }
}

std::string points_text(vtkIdType count)
{
  return std::to_string(count) + (count == 1 ? " point" : " points");
}

Status check_polydata(vtkPolyData* data)
{
  struct Kind
  {
    const char* name;
    vtkCellArray* cells;
    vtkIdType smallest_size;
  };
  const std::array<Kind, 4> kinds{ { { "vertex cell", data->GetVerts(), 1 },
    { "line", data->GetLines(), 2 }, { "polygon", data->GetPolys(), 3 },
    { "triangle strip", data->GetStrips(), 3 } } };
  Status status;
  for (const Kind& kind : kinds)
  {
    visit_sizes(kind.cells,
      [&](vtkIdType cell, vtkIdType size)
      {
        if (size < kind.smallest_size)
        {
          status =
            Status::invalid_input(std::string(kind.name) + ' ' + std::to_string(cell) + " has " +
              points_text(size) + "; expected at least " + std::to_string(kind.smallest_size));
        }
        return status.ok();
      });
  }
  return status;
}

/// Return the number of points that every cell of a type has, or -1 if it varies.
vtkIdType points_of_type(int type)
{
  switch (type)
  {
    case VTK_EMPTY_CELL:
      return 0;
    case VTK_POLY_VERTEX:
    case VTK_POLY_LINE:
    case VTK_TRIANGLE_STRIP:
    case VTK_POLYGON:
    case VTK_CONVEX_POINT_SET:
    case VTK_QUADRATIC_POLYGON:
      return -1;
    default:
      break;
  }
  const bool is_linear_or_quadratic =
    type <= VTK_HEXAGONAL_PRISM || (type >= VTK_QUADRATIC_EDGE && type <= VTK_TRIQUADRATIC_PYRAMID);
  if (!is_linear_or_quadratic)
  {
    return -1;
  }
  vtkNew<vtkGenericCell> cell;
  cell->SetCellType(type);
  return cell->GetCellType() == type ? cell->GetNumberOfPoints() : -1;
}

Status check_grid(vtkUnstructuredGrid* data)
{
  vtkUnsignedCharArray* types = data->GetCellTypesArray();
  if (!types)
  {
    return {};
  }
  std::array<vtkIdType, 256> required{};
  required.fill(-2); // not known yet
  Status status;
  visit_sizes(data->GetCells(),
    [&](vtkIdType cell, vtkIdType size)
    {
      const int type = types->GetValue(cell);
      if (required[type] == -2)
      {
        required[type] = points_of_type(type);
      }
      if (required[type] >= 0 && required[type] != size)
      {
        status = Status::invalid_input("cell " + std::to_string(cell) + " of type " +
          std::to_string(type) + " has " + points_text(size) + "; expected " +
          std::to_string(required[type]));
      }
      return status.ok();
    });
  return status;
}
} // namespace

Status check_cell_sizes(vtkDataObject* data)
{
  if (auto* polydata = vtkPolyData::SafeDownCast(data))
  {
    return check_polydata(polydata);
  }
  auto* grid = vtkUnstructuredGrid::SafeDownCast(data);
  return grid ? check_grid(grid) : Status();
}

} // namespace bindpose
