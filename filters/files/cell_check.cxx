#include "cell_check.h"

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
Status invalid_offsets()
{
  return Status::invalid_input("the offsets of the cells are not valid; they must ascend from 0 to "
                               "the number of the cells' point ids");
}

/// Check the offsets of cells, and call `is_valid(cell, size)` for each cell. If `is_valid` returns
/// false, return an error with the message `describe(cell, size)`.
template <typename Value, typename IsValid, typename Describe>
Status check_each(const Value* offsets, vtkIdType cells, vtkIdType ids, const IsValid& is_valid,
  const Describe& describe)
{
  if (offsets[0] != 0 || offsets[cells] != ids)
  {
    return invalid_offsets();
  }
  for (vtkIdType cell = 0; cell < cells; ++cell)
  {
    const auto size = static_cast<vtkIdType>(offsets[cell + 1] - offsets[cell]);
    if (size < 0)
    {
      return invalid_offsets();
    }
    if (!is_valid(cell, size))
    {
      return Status::invalid_input(describe(cell, size));
    }
  }
  return {};
}

template <typename IsValid, typename Describe>
Status check_each(vtkCellArray* cells, const IsValid& is_valid, const Describe& describe)
{
  const vtkIdType count = cells ? cells->GetNumberOfCells() : -1;
  if (count < 0) // without offsets
  {
    return {};
  }
  const vtkIdType ids = cells->GetNumberOfConnectivityIds();
  return cells->IsStorage64Bit()
    ? check_each(cells->GetOffsetsArray64()->GetPointer(0), count, ids, is_valid, describe)
    : check_each(cells->GetOffsetsArray32()->GetPointer(0), count, ids, is_valid, describe);
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
  for (const Kind& kind : kinds)
  {
    Status status = check_each(
      kind.cells, [&](vtkIdType, vtkIdType size) { return size >= kind.smallest_size; },
      [&](vtkIdType cell, vtkIdType size)
      {
        return std::string(kind.name) + ' ' + std::to_string(cell) + " has " + points_text(size) +
          "; expected at least " + std::to_string(kind.smallest_size);
      });
    if (!status.ok())
    {
      return status;
    }
  }
  return {};
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
  constexpr vtkIdType unknown = -2;
  std::array<vtkIdType, 256> required{};
  required.fill(unknown);
  return check_each(
    data->GetCells(),
    [&](vtkIdType cell, vtkIdType size)
    {
      if (!types)
      {
        return true;
      }
      const int type = types->GetValue(cell);
      if (required[type] == unknown)
      {
        required[type] = points_of_type(type);
      }
      return required[type] < 0 || required[type] == size;
    },
    [&](vtkIdType cell, vtkIdType size)
    {
      const int type = types->GetValue(cell);
      return "cell " + std::to_string(cell) + " of type " + std::to_string(type) + " has " +
        points_text(size) + "; expected " + std::to_string(required[type]);
    });
}
} // namespace

Status check_cells(vtkDataObject* data)
{
  if (auto* polydata = vtkPolyData::SafeDownCast(data))
  {
    return check_polydata(polydata);
  }
  auto* grid = vtkUnstructuredGrid::SafeDownCast(data);
  return grid ? check_grid(grid) : Status();
}

} // namespace bindpose
