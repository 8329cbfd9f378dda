// Edits a handle dataset: the dataset is converted to a list of handles, the list is edited, and a
// new dataset is created from the list. Then every array that the list does not contain is copied,
// cell by cell.
#include "handle_edit_cells.h"

#include "pseudo_edge_cells.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <limits>
#include <string>

namespace bindpose
{
namespace
{
// marks a handle without its own color
constexpr double none = std::numeric_limits<double>::quiet_NaN();

const char* const pose_arrays[4] = { "Mode", "Transform", "Stretch", "Twist" };

bool is_pose_array(const std::string& name)
{
  return std::find(std::begin(pose_arrays), std::end(pose_arrays), name) != std::end(pose_arrays);
}

/// Return the array Color as doubles with one tuple per cell; create or convert it if necessary.
vtkDataArray* colors_of(vtkPolyData* data)
{
  vtkDataArray* before = data->GetCellData()->GetArray("Color");
  const vtkIdType count = data->GetNumberOfCells();
  const bool fits = before && before->GetNumberOfComponents() == 3;
  if (fits && before->GetDataType() == VTK_DOUBLE && before->GetNumberOfTuples() == count)
  {
    return before;
  }
  vtkNew<vtkDoubleArray> new_array;
  new_array->SetName("Color");
  new_array->SetNumberOfComponents(3);
  new_array->SetNumberOfTuples(count);
  const double unit = fits && before->GetDataType() == VTK_UNSIGNED_CHAR ? 255.0 : 1.0;
  for (vtkIdType cell = 0; cell < count; ++cell)
  {
    for (int k = 0; k < 3; ++k)
    {
      const bool has_value = fits && cell < before->GetNumberOfTuples();
      new_array->SetComponent(cell, k, has_value ? before->GetComponent(cell, k) / unit : none);
    }
  }
  data->GetCellData()->AddArray(new_array);
  return data->GetCellData()->GetArray("Color");
}

/// Copy cell arrays from `before` to `edited`: arrays that `edited` does not have, and the values
/// of the pose arrays, so that each handle keeps its pose.
void carry_arrays(vtkPolyData* before, vtkPolyData* edited, const std::vector<Index>& source,
  const std::vector<Index>& copied_from)
{
  vtkCellData* from = before->GetCellData();
  if (from->GetArray("Color"))
  {
    colors_of(before); // convert to doubles: new handles get NaN, which unsigned chars cannot store
  }
  for (int a = 0; a < from->GetNumberOfArrays(); ++a)
  {
    vtkAbstractArray* array = from->GetAbstractArray(a);
    const std::string name = array->GetName() ? array->GetName() : "";
    const bool pose = is_pose_array(name);
    vtkAbstractArray* target = edited->GetCellData()->GetAbstractArray(name.c_str());
    if (name.empty() || (target && !pose))
    {
      continue;
    }
    if (!target || target->GetNumberOfComponents() != array->GetNumberOfComponents())
    {
      vtkSmartPointer<vtkAbstractArray> new_array;
      new_array.TakeReference(array->NewInstance());
      new_array->SetName(name.c_str());
      new_array->SetNumberOfComponents(array->GetNumberOfComponents());
      new_array->SetNumberOfTuples(edited->GetNumberOfCells());
      if (auto* numbers = vtkDataArray::SafeDownCast(new_array))
      {
        numbers->Fill(name == "Color" ? none : 0.0);
      }
      edited->GetCellData()->AddArray(new_array);
      target = new_array;
    }
    for (vtkIdType cell = 0; cell < edited->GetNumberOfCells(); ++cell)
    {
      const Index other = (pose ? source : copied_from)[static_cast<std::size_t>(cell)];
      if (other >= 0 && other < array->GetNumberOfTuples())
      {
        target->SetTuple(cell, other, array);
      }
    }
  }
}
} // namespace

Status to_editable(vtkPolyData* data, Handles& handles, std::vector<Index>& cells)
{
  handles.clear();
  cells.clear();
  return data && data->GetNumberOfCells() > 0 ? to_handles(data, handles, &cells) : Status();
}

Status edit_handles(vtkPolyData* data, const HandleListEdit& edit, std::vector<Index>* new_cell,
  std::vector<Index>* added)
{
  Handles before;
  std::vector<Index> cells;
  Status status = to_editable(data, before, cells);
  PseudoEdges edges;
  if (status.ok() && !cells.empty())
  {
    status = to_pseudo_edges(data, before, cells, edges);
  }
  EditedHandles after;
  if (status.ok())
  {
    status = edit(before, after);
  }
  if (!status.ok())
  {
    return status;
  }
  const vtkSmartPointer<vtkPolyData> edited = to_polydata(after.handles);
  // to_polydata() stores bones as the last cells, so the id of a cell is not the index of its
  // handle.
  std::vector<Index> cell_of_handle(after.handles.size(), -1);
  Index next = 0;
  for (const bool bones : { false, true })
  {
    for (std::size_t i = 0; i < after.handles.size(); ++i)
    {
      if ((after.handles[i].kind == HandleKind::bone) == bones)
      {
        cell_of_handle[i] = next++;
      }
    }
  }
  if (new_cell)
  {
    new_cell->assign(static_cast<std::size_t>(data->GetNumberOfCells()), -1);
  }
  if (added)
  {
    added->clear();
  }
  std::vector<Index> handle_now(before.size(), -1);
  std::vector<Index> source(static_cast<std::size_t>(edited->GetNumberOfCells()), -1);
  std::vector<Index> copied_from = source;
  for (std::size_t i = 0; i < after.handles.size(); ++i)
  {
    const auto cell = static_cast<std::size_t>(cell_of_handle[i]);
    if (after.copied_from[i] >= 0)
    {
      copied_from[cell] = cells[static_cast<std::size_t>(after.copied_from[i])];
    }
    if (after.source[i] >= 0)
    {
      const Index old_cell = cells[static_cast<std::size_t>(after.source[i])];
      source[cell] = old_cell;
      handle_now[static_cast<std::size_t>(after.source[i])] = static_cast<Index>(i);
      if (new_cell)
      {
        (*new_cell)[static_cast<std::size_t>(old_cell)] = static_cast<Index>(cell);
      }
    }
    else if (added)
    {
      added->push_back(static_cast<Index>(cell));
    }
  }
  carry_arrays(data, edited, source, copied_from);
  PseudoEdges kept;
  for (const PseudoEdge& edge : edges)
  {
    const Index a = handle_now[static_cast<std::size_t>(edge[0])];
    const Index b = handle_now[static_cast<std::size_t>(edge[1])];
    if (a >= 0 && b >= 0)
    {
      kept.push_back({ std::min(a, b), std::max(a, b) });
    }
  }
  if (!kept.empty() && edited->GetNumberOfPolys() == 0)
  {
    add_pseudo_edges(edited, cell_of_handle, kept);
  }
  edited->GetFieldData()->ShallowCopy(data->GetFieldData());
  data->ShallowCopy(edited);
  data->Modified();
  return status;
}

namespace
{
/// Set the value of one cell in an array with one value per cell. Create the array with zeros if it
/// is absent.
template <typename Array>
void set_number(vtkPolyData* data, const char* name, Index cell, double value)
{
  vtkDataArray* array = data->GetCellData()->GetArray(name);
  const vtkIdType count = data->GetNumberOfCells();
  if (!array || array->GetNumberOfTuples() != count)
  {
    vtkNew<Array> new_array;
    new_array->SetName(name);
    new_array->SetNumberOfTuples(count);
    new_array->Fill(0.0);
    data->GetCellData()->AddArray(new_array);
    array = data->GetCellData()->GetArray(name);
  }
  if (cell >= 0 && cell < count)
  {
    array->SetComponent(cell, 0, value);
    array->Modified();
    data->Modified();
  }
}
} // namespace

void set_handle_color(
  vtkPolyData* data, Index cell, const std::optional<std::array<double, 3>>& color)
{
  vtkDataArray* array = colors_of(data);
  for (int k = 0; k < 3 && cell >= 0 && cell < data->GetNumberOfCells(); ++k)
  {
    array->SetComponent(
      cell, k, color ? std::clamp((*color)[static_cast<std::size_t>(k)], 0.0, 1.0) : none);
  }
  array->Modified();
  data->Modified();
}

void set_handle_locked(vtkPolyData* data, Index cell, bool locked)
{
  set_number<vtkIntArray>(data, "Locked", cell, locked ? 1.0 : 0.0);
}

void set_handle_layer(vtkPolyData* data, Index cell, double layer)
{
  set_number<vtkDoubleArray>(data, "Layer", cell, layer);
}

} // namespace bindpose
