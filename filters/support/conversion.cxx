// Conversion between VTK's datasets and the kernels' matrices. Coordinates and connectivity are
// shared if the layout allows it: contiguous doubles, and 64-bit connectivity of only triangles or
// only tets.
#include "conversion.h"

#include "base/number_text.h"
#include "cell_check.h"
#include "geometry/working_frame.h"
#include "polygon_triangles.h"

#include "vtkCell.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellData.h"
#include "vtkCellTypes.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <cmath>
#include <map>
#include <utility>

namespace bindpose
{

namespace
{
static_assert(sizeof(Index) == sizeof(vtkTypeInt64), "connectivity is shared");

/// Share a cell array's connectivity if all its cells have as many points as `Matrix` has columns.
template <typename Matrix>
bool share_connectivity(vtkCellArray* cells, SharedMatrix<Matrix>& matrix)
{
  constexpr vtkIdType size = Matrix::ColsAtCompileTime;
  if (!cells || cells->GetNumberOfCells() == 0 || !cells->IsStorage64Bit() ||
    cells->IsHomogeneous() != size ||
    cells->GetNumberOfConnectivityIds() != size * cells->GetNumberOfCells())
  {
    return false;
  }
  auto* connectivity = cells->GetConnectivityArray64();
  matrix.set_shared(connectivity, reinterpret_cast<const Index*>(connectivity->GetPointer(0)),
    cells->GetNumberOfCells(), size);
  return true;
}

bool ids_in_range(vtkIdType count, const vtkIdType* ids, vtkIdType number_of_points)
{
  for (vtkIdType k = 0; k < count; ++k)
  {
    if (ids[k] < 0 || ids[k] >= number_of_points)
    {
      return false;
    }
  }
  return true;
}

Status split_cells(vtkPointSet* data, SurfaceInput& surface)
{
  vtkNew<vtkIdList> cell_points;
  std::vector<std::array<Index, 3>> triangles, corners;
  std::vector<Vec3> polygon;
  const vtkIdType cells = data->GetNumberOfCells();
  vtkPoints* points = data->GetPoints();
  const vtkIdType number_of_points = data->GetNumberOfPoints();
  for (vtkIdType cell = 0; cell < cells; ++cell)
  {
    const int type = data->GetCellType(cell);
    const bool strip = type == VTK_TRIANGLE_STRIP;
    const bool ring = type == VTK_TRIANGLE || type == VTK_QUAD || type == VTK_POLYGON;
    if (!strip && !ring && type != VTK_PIXEL)
    {
      surface.ignored_cells += 1;
      continue;
    }
    data->GetCellPoints(cell, cell_points);
    vtkIdType count = cell_points->GetNumberOfIds();
    std::vector<vtkIdType> ids(cell_points->GetPointer(0), cell_points->GetPointer(0) + count);
    if (!ids_in_range(count, ids.data(), number_of_points))
    {
      return Status::invalid_input("cell " + std::to_string(cell) +
        " references a point that does not exist (the mesh has " +
        std::to_string(number_of_points) + " points)");
    }
    if (strip)
    {
      for (vtkIdType k = 0; k + 2 < count; ++k)
      {
        const vtkIdType flip = k % 2;
        triangles.push_back({ ids[k], ids[k + 1 + flip], ids[k + 2 - flip] });
      }
    }
    else
    {
      if (type == VTK_PIXEL)
      {
        std::swap(ids[2], ids[3]);
      }
      polygon.clear();
      for (const vtkIdType id : ids)
      {
        polygon.emplace_back(points->GetPoint(id));
      }
      triangulate_polygon(polygon, corners);
      for (const std::array<Index, 3>& t : corners)
      {
        triangles.push_back({ ids[t[0]], ids[t[1]], ids[t[2]] });
      }
    }
    surface.triangulated_cells += count != 3;
    surface.cell_of_triangle.resize(triangles.size(), cell);
  }
  Triangles matrix(static_cast<Index>(triangles.size()), 3);
  for (Index t = 0; t < matrix.rows(); ++t)
  {
    matrix.row(t) << triangles[t][0], triangles[t][1], triangles[t][2];
  }
  surface.triangles.set_owned(std::move(matrix));
  return {};
}
} // namespace

SharedMatrix<Points> to_points(vtkDataSet* data)
{
  SharedMatrix<Points> matrix;
  auto* set = vtkPointSet::SafeDownCast(data);
  vtkDataArray* array = set && set->GetPoints() ? set->GetPoints()->GetData() : nullptr;
  if (auto* doubles = vtkDoubleArray::SafeDownCast(array))
  {
    matrix.set_shared(doubles, doubles->GetPointer(0), doubles->GetNumberOfTuples(), 3);
    return matrix;
  }
  const vtkIdType count = data ? data->GetNumberOfPoints() : 0;
  Points points(count, 3);
  for (vtkIdType v = 0; v < count; ++v)
  {
    data->GetPoint(v, points.data() + 3 * v);
  }
  matrix.set_owned(std::move(points));
  return matrix;
}

Status to_surface(vtkDataSet* data, SurfaceInput& surface)
{
  surface = SurfaceInput();
  auto* set = vtkPointSet::SafeDownCast(data);
  if (!set)
  {
    return Status::invalid_input(data
        ? std::string("the input must be a surface mesh, but is a ") + data->GetClassName()
        : "the input surface is missing");
  }
  if (set->GetNumberOfPoints() == 0 || set->GetNumberOfCells() == 0)
  {
    return Status::invalid_input("the surface is empty: it has " +
      std::to_string(set->GetNumberOfPoints()) + " points and " +
      std::to_string(set->GetNumberOfCells()) + " cells");
  }
  Status valid = check_cells(set);
  if (!valid.ok())
  {
    return valid;
  }
  surface.points = to_points(set);
  auto* polydata = vtkPolyData::SafeDownCast(set);
  const bool only_polys = polydata && polydata->GetNumberOfPolys() == polydata->GetNumberOfCells();
  if (!only_polys || !share_connectivity(polydata->GetPolys(), surface.triangles))
  {
    Status status = split_cells(set, surface);
    if (!status.ok())
    {
      return status;
    }
  }
  if (surface.triangles.view().rows() == 0)
  {
    return Status::invalid_input("the input has no triangles or polygons, only " +
      std::to_string(set->GetNumberOfCells()) + " cells of other types");
  }
  WorkingFrame frame;
  return WorkingFrame::choose(
    surface.points.view(), surface.triangles.view(), "the surface", frame);
}

Status to_tets(vtkDataSet* data, TetInput& tets)
{
  tets = TetInput();
  auto* grid = vtkUnstructuredGrid::SafeDownCast(data);
  if (!grid)
  {
    return Status::invalid_input(data
        ? std::string("the input must be a tet mesh, but is a ") + data->GetClassName()
        : "the input tet mesh is missing");
  }
  if (grid->GetNumberOfPoints() == 0 || grid->GetNumberOfCells() == 0)
  {
    return Status::invalid_input("the tet mesh is empty");
  }
  Status valid = check_cells(grid);
  if (!valid.ok())
  {
    return valid;
  }
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
  {
    if (grid->GetCellType(cell) != VTK_TETRA)
    {
      return Status::invalid_input("cell " + std::to_string(cell) + " is a " +
        vtkCellTypes::GetClassNameFromTypeId(grid->GetCellType(cell)) + "; expected only tets");
    }
  }
  tets.points = to_points(grid);
  if (!share_connectivity(grid->GetCells(), tets.tets))
  {
    Tets matrix(grid->GetNumberOfCells(), 4);
    vtkNew<vtkIdList> ids;
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
    {
      grid->GetCellPoints(cell, ids);
      for (int k = 0; k < 4; ++k)
      {
        matrix(cell, k) = ids->GetId(k);
      }
    }
    tets.tets.set_owned(std::move(matrix));
  }
  WorkingFrame frame;
  return WorkingFrame::choose(tets.points.view(), tets.tets.view(), "the tet mesh", frame);
}

namespace
{
bool has_volume_cell(vtkUnstructuredGrid* grid)
{
  vtkUnsignedCharArray* types = grid->GetCellTypesArray();
  for (vtkIdType i = 0; types && i < types->GetNumberOfValues(); ++i)
  {
    // The types of linear 3D cells start at VTK_TETRA.
    const int type = types->GetValue(i);
    if (type >= VTK_TETRA && type <= VTK_HEXAGONAL_PRISM)
    {
      return true;
    }
  }
  return false;
}
} // namespace

Status to_domain(vtkDataSet* data, Domain& domain, std::vector<Index>& cell_of_element)
{
  domain = Domain();
  cell_of_element.clear();
  auto* grid = vtkUnstructuredGrid::SafeDownCast(data);
  if (grid && has_volume_cell(grid))
  {
    TetInput tets;
    Status status = to_tets(grid, tets);
    if (status.ok())
    {
      domain.points = tets.points.view();
      domain.tets = tets.tets.view();
    }
    return status;
  }
  SurfaceInput surface;
  Status status = to_surface(data, surface);
  if (status.ok())
  {
    domain.points = surface.points.view();
    domain.triangles = surface.triangles.view();
    cell_of_element = std::move(surface.cell_of_triangle);
  }
  return status;
}

SharedMatrix<Weights> to_matrix(vtkDataArray* array)
{
  SharedMatrix<Weights> matrix;
  if (auto* doubles = vtkDoubleArray::SafeDownCast(array))
  {
    matrix.set_shared(doubles, doubles->GetPointer(0), doubles->GetNumberOfTuples(),
      doubles->GetNumberOfComponents());
    return matrix;
  }
  if (array)
  {
    Weights copy(array->GetNumberOfTuples(), array->GetNumberOfComponents());
    for (vtkIdType v = 0; v < array->GetNumberOfTuples(); ++v)
    {
      array->GetTuple(v, copy.data() + v * copy.cols());
    }
    matrix.set_owned(std::move(copy));
  }
  return matrix;
}

vtkSmartPointer<vtkPoints> to_vtk_points(PointsView points)
{
  auto result = vtkSmartPointer<vtkPoints>::New();
  result->SetDataTypeToDouble();
  result->SetNumberOfPoints(points.rows());
  for (Index v = 0; v < points.rows(); ++v)
  {
    result->SetPoint(v, points(v, 0), points(v, 1), points(v, 2));
  }
  return result;
}

namespace
{
template <typename View>
vtkSmartPointer<vtkCellArray> to_cell_array(const View& elements)
{
  vtkNew<vtkTypeInt64Array> offsets;
  vtkNew<vtkTypeInt64Array> connectivity;
  offsets->SetNumberOfValues(elements.rows() + 1);
  connectivity->SetNumberOfValues(elements.size());
  for (Index e = 0; e <= elements.rows(); ++e)
  {
    offsets->SetValue(e, e * elements.cols());
  }
  for (Index k = 0; k < elements.size(); ++k)
  {
    connectivity->SetValue(k, elements.data()[k]);
  }
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, connectivity);
  return cells;
}
} // namespace

vtkSmartPointer<vtkPolyData> to_polydata(PointsView points, TrianglesView triangles)
{
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(to_vtk_points(points));
  result->SetPolys(to_cell_array(triangles));
  return result;
}

vtkSmartPointer<vtkUnstructuredGrid> to_unstructured_grid(PointsView points, TetsView tets)
{
  auto result = vtkSmartPointer<vtkUnstructuredGrid>::New();
  result->SetPoints(to_vtk_points(points));
  result->SetCells(VTK_TETRA, to_cell_array(tets));
  return result;
}

vtkSmartPointer<vtkUnstructuredGrid> to_unstructured_grid(
  PointsView points, TrianglesView triangles)
{
  auto result = vtkSmartPointer<vtkUnstructuredGrid>::New();
  result->SetPoints(to_vtk_points(points));
  result->SetCells(VTK_TRIANGLE, to_cell_array(triangles));
  return result;
}

// ---- Handles -----------------------------------------------------------------------------------

namespace
{
double cell_value(vtkPolyData* data, const char* name, vtkIdType cell, double fallback)
{
  vtkDataArray* array = data->GetCellData()->GetArray(name);
  return array && cell < array->GetNumberOfTuples() ? array->GetComponent(cell, 0) : fallback;
}

/// Replace `value` by the value of a cell in an array, if the array has one. Return invalid_input
/// if this value is not an integer.
Status read_integer(vtkPolyData* data, const char* name, vtkIdType cell, Index& value)
{
  const double number = cell_value(data, name, cell, static_cast<double>(value));
  return to_integer(number, value)
    ? Status()
    : Status::invalid_input(std::string(name) + " of handle cell " + std::to_string(cell) +
        " must be an integer, not " + short_number(number));
}

/// Values of the cell arrays that describe a handle.
struct HandleCell
{
  Index kind = -1; ///< HandleKind or pseudo_edge_kind
  Index region_id = 0;
  Index ownership = 0;
  Index parent = -1; ///< a cell id
};

/// Read the values that describe the handle of a cell with `size` points.
Status read_handle_cell(vtkPolyData* data, vtkIdType cell, vtkIdType size, HandleCell& values)
{
  values.kind = static_cast<Index>(size == 2 ? HandleKind::bone : HandleKind::point);
  const std::pair<const char*, Index*> arrays[] = { { "HandleKind", &values.kind },
    { "RegionId", &values.region_id }, { "Ownership", &values.ownership },
    { "Parent", &values.parent } };
  for (const auto& [name, value] : arrays)
  {
    const Status status = read_integer(data, name, cell, *value);
    if (!status.ok())
    {
      return status;
    }
  }
  return {};
}

/// Add the edges and faces of cages as cells; split polygons into fans. The points of these cells
/// must be the points of cage vertices or have the same positions.
Status add_cages(vtkPolyData* data, const std::vector<Index>& handle_of_cell, Handles& handles)
{
  std::map<vtkIdType, Index> handle_at_point;
  std::map<std::array<double, 3>, Index> handle_at_position;
  vtkNew<vtkIdList> ids;
  for (std::size_t cell = 0; cell < handle_of_cell.size(); ++cell)
  {
    const Index handle = handle_of_cell[cell];
    if (handle >= 0 && handles[handle].kind == HandleKind::cage_vertex)
    {
      data->GetCellPoints(static_cast<vtkIdType>(cell), ids);
      const Vec3& position = handles[handle].head;
      handle_at_point[ids->GetId(0)] = handle;
      handle_at_position[{ position[0], position[1], position[2] }] = handle;
    }
  }
  for (std::size_t cell = 0; cell < handle_of_cell.size(); ++cell)
  {
    const auto id = static_cast<vtkIdType>(cell);
    if (cell_value(data, "HandleKind", id, 0) != static_cast<int>(HandleKind::cage_element))
    {
      continue;
    }
    data->GetCellPoints(id, ids);
    std::vector<Index> corners;
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
    {
      const vtkIdType point = ids->GetId(k);
      if (point < 0 || point >= data->GetNumberOfPoints())
      {
        return Status::invalid_input("cage element " + std::to_string(cell) + " references point " +
          std::to_string(point) + ", but there are " + std::to_string(data->GetNumberOfPoints()) +
          " points");
      }
      std::array<double, 3> position;
      data->GetPoint(point, position.data());
      const auto handle_of_point = handle_at_point.find(point);
      const auto handle_of_position = handle_at_position.find(position);
      if (handle_of_point == handle_at_point.end() &&
        handle_of_position == handle_at_position.end())
      {
        return Status::invalid_input("point " + std::to_string(point) + " of cage element " +
          std::to_string(cell) + " must be a cage vertex");
      }
      corners.push_back(handle_of_point != handle_at_point.end() ? handle_of_point->second
                                                                 : handle_of_position->second);
    }
    if (corners.size() < 2)
    {
      return Status::invalid_input(
        "cage element " + std::to_string(cell) + " has fewer than 2 points");
    }
    if (corners.size() == 2)
    {
      handles[corners[0]].cage.push_back({ corners[0], corners[1], -1 });
    }
    for (std::size_t k = 2; k < corners.size(); ++k)
    {
      handles[corners[0]].cage.push_back({ corners[0], corners[k - 1], corners[k] });
    }
  }
  return {};
}
} // namespace

bool to_integer(double number, Index& integer)
{
  constexpr double largest = 0x1p53; // doubles represent all integers up to this one
  if (!(std::abs(number) <= largest) || number != std::floor(number))
  {
    return false;
  }
  integer = static_cast<Index>(number);
  return true;
}

Status to_handles(vtkPolyData* data, Handles& handles, std::vector<Index>* cells)
{
  handles.clear();
  if (cells)
  {
    cells->clear();
  }
  if (!data || data->GetNumberOfCells() == 0)
  {
    return Status::invalid_input("the input has no handles");
  }
  auto* names = vtkStringArray::SafeDownCast(data->GetCellData()->GetAbstractArray("HandleName"));
  std::vector<Index> handle_of_cell(static_cast<std::size_t>(data->GetNumberOfCells()), -1);
  std::vector<Index> parents;
  vtkNew<vtkIdList> ids;
  int points = 0;
  int bones = 0;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    data->GetCellPoints(cell, ids);
    const vtkIdType size = ids->GetNumberOfIds();
    const std::string cell_name = "handle cell " + std::to_string(cell);
    HandleCell values;
    const Status status = read_handle_cell(data, cell, size, values);
    if (!status.ok())
    {
      return status;
    }
    if (values.kind == pseudo_edge_kind)
    {
      continue; // pseudo-edges are not handles
    }
    if (values.kind < -1 || values.kind > 3)
    {
      return Status::invalid_input(
        cell_name + " has the unknown HandleKind " + std::to_string(values.kind));
    }
    Handle handle;
    handle.kind = static_cast<HandleKind>(values.kind);
    if (handle.kind == HandleKind::cage_element)
    {
      continue;
    }
    const bool bone = handle.kind == HandleKind::bone;
    if (size != (bone ? 2 : 1) ||
      !ids_in_range(size, ids->GetPointer(0), data->GetNumberOfPoints()))
    {
      return Status::invalid_input(cell_name + " has " + std::to_string(size) +
        " points; expected 2 for a bone and 1 for any other handle");
    }
    data->GetPoint(ids->GetId(0), handle.head.data());
    data->GetPoint(ids->GetId(size - 1), handle.tail.data());
    handle.name =
      names && cell < names->GetNumberOfValues() ? names->GetValue(cell) : vtkStdString();
    const int number = bone ? ++bones : ++points;
    if (handle.name.empty())
    {
      handle.name = (bone ? "b" : "p") + std::to_string(number);
    }
    handle.region_id = values.region_id;
    if (values.ownership < 0 || values.ownership > 2)
    {
      return Status::invalid_input(cell_name + " has an unknown Ownership; expected 0, 1 or 2");
    }
    handle.ownership = static_cast<Ownership>(values.ownership);
    parents.push_back(values.parent);
    handle_of_cell[cell] = static_cast<Index>(handles.size());
    handles.push_back(handle);
    if (cells)
    {
      cells->push_back(cell);
    }
  }
  // The array Parent contains cell ids of the dataset; the kernel's `parent` is the index of a
  // handle.
  for (std::size_t i = 0; i < handles.size(); ++i)
  {
    const Index cell = parents[i];
    if (cell < -1 || cell >= static_cast<Index>(handle_of_cell.size()) ||
      (cell >= 0 && handle_of_cell[cell] < 0))
    {
      return Status::invalid_input("handle '" + handles[i].name + "' has the parent cell " +
        std::to_string(cell) + ", which is not a handle");
    }
    handles[i].parent = cell < 0 ? -1 : handle_of_cell[cell];
  }
  const Status status = add_cages(data, handle_of_cell, handles);
  return status.ok() ? check_handles(handles) : status;
}

vtkSmartPointer<vtkPolyData> to_polydata(const Handles& handles)
{
  const auto count = static_cast<vtkIdType>(handles.size());
  auto result = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> verts;
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkStringArray> names;
  vtkNew<vtkIntArray> kinds;
  vtkNew<vtkIdTypeArray> parents;
  vtkNew<vtkIdTypeArray> regions;
  names->SetName("HandleName");
  kinds->SetName("HandleKind");
  parents->SetName("Parent");
  regions->SetName("RegionId");
  vtkNew<vtkIntArray> ownerships;
  ownerships->SetName("Ownership");
  // A polydata numbers its vertices before its lines, so bones are the last cells.
  std::vector<Index> order;
  for (const bool bones : { false, true })
  {
    for (vtkIdType i = 0; i < count; ++i)
    {
      if ((handles[i].kind == HandleKind::bone) == bones)
      {
        order.push_back(i);
      }
    }
  }
  std::vector<Index> cell_of_handle(handles.size());
  std::vector<vtkIdType> point_of_handle(handles.size());
  for (std::size_t cell = 0; cell < order.size(); ++cell)
  {
    cell_of_handle[order[cell]] = static_cast<Index>(cell);
  }
  for (const Index i : order)
  {
    const Handle& handle = handles[i];
    const vtkIdType head = points->InsertNextPoint(handle.head.data());
    point_of_handle[i] = head;
    if (handle.kind == HandleKind::bone)
    {
      const vtkIdType ends[2] = { head, points->InsertNextPoint(handle.tail.data()) };
      lines->InsertNextCell(2, ends);
    }
    else
    {
      verts->InsertNextCell(1, &head);
    }
    names->InsertNextValue(handle.name);
    kinds->InsertNextValue(static_cast<int>(handle.kind));
    parents->InsertNextValue(handle.parent < 0 ? -1 : cell_of_handle[handle.parent]);
    regions->InsertNextValue(handle.region_id);
    ownerships->InsertNextValue(static_cast<int>(handle.ownership));
  }
  // Store the edges of cages after the bones, and the faces of cages after all lines.
  vtkNew<vtkCellArray> faces;
  for (const bool face : { false, true })
  {
    for (const Handle& handle : handles)
    {
      for (const CageElement& element : handle.cage)
      {
        if ((element[2] >= 0) != face)
        {
          continue;
        }
        const vtkIdType corners[3] = { point_of_handle[element[0]], point_of_handle[element[1]],
          face ? point_of_handle[element[2]] : -1 };
        (face ? faces : lines)->InsertNextCell(face ? 3 : 2, corners);
        names->InsertNextValue("");
        kinds->InsertNextValue(static_cast<int>(HandleKind::cage_element));
        parents->InsertNextValue(-1);
        regions->InsertNextValue(0);
        ownerships->InsertNextValue(0);
      }
    }
  }
  result->SetPoints(points);
  result->SetVerts(verts);
  result->SetLines(lines);
  result->SetPolys(faces);
  result->GetCellData()->AddArray(names);
  result->GetCellData()->AddArray(kinds);
  result->GetCellData()->AddArray(parents);
  result->GetCellData()->AddArray(regions);
  if (std::any_of(handles.begin(), handles.end(),
        [](const Handle& handle) { return handle.ownership != Ownership::required; }))
  {
    result->GetCellData()->AddArray(ownerships);
  }
  set_pose(result, {}, {});
  return result;
}

Status to_layers(vtkPolyData* data, const Handles& handles, const std::vector<Index>& cells,
  const std::string& name, Eigen::VectorXd& layers)
{
  layers = Eigen::VectorXd::Zero(static_cast<Index>(handles.size()));
  vtkDataArray* layer_array = data->GetCellData()->GetArray(name.c_str());
  if (layer_array && layer_array->GetNumberOfComponents() != 1)
  {
    return Status::invalid_input("the handles' cell array '" + name + "' of layers has " +
      std::to_string(layer_array->GetNumberOfComponents()) + " components; expected 1");
  }
  for (std::size_t h = 0; layer_array && h < handles.size(); ++h)
  {
    const double layer = layer_array->GetComponent(cells[h], 0);
    if (!std::isfinite(layer))
    {
      return Status::invalid_input(
        "the layer of handle '" + handles[h].name + "' is not a finite number");
    }
    layers[static_cast<Index>(h)] = layer;
  }
  return {};
}

Status to_pose(
  vtkPolyData* data, const Handles& handles, const std::vector<Index>& cells, Pose& pose)
{
  pose.assign(handles.size(), HandlePose());
  vtkDataArray* transforms = data->GetCellData()->GetArray("Transform");
  vtkDataArray* twists = data->GetCellData()->GetArray("Twist");
  if (transforms && transforms->GetNumberOfComponents() != 12)
  {
    return Status::invalid_input("the cell array Transform has " +
      std::to_string(transforms->GetNumberOfComponents()) +
      " components; expected 12 (3x4, row-major)");
  }
  if (twists && twists->GetNumberOfComponents() != 2)
  {
    return Status::invalid_input("the cell array Twist has " +
      std::to_string(twists->GetNumberOfComponents()) +
      " components; expected 2 (degrees at head and tail)");
  }
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    const vtkIdType cell = cells[i];
    constexpr auto automatic = static_cast<Index>(HandleMode::automatic);
    Index mode = automatic;
    Status status = read_integer(data, "Mode", cell, mode);
    if (!status.ok())
    {
      return status;
    }
    if (mode < 0 || mode > automatic)
    {
      return Status::invalid_input(
        "handle '" + handles[i].name + "' has the unknown Mode " + std::to_string(mode));
    }
    pose[i].mode = static_cast<HandleMode>(mode);
    if (transforms)
    {
      transforms->GetTuple(cell, pose[i].transform.data());
    }
    if (twists)
    {
      twists->GetTuple(cell, pose[i].twist.data());
    }
    pose[i].stretch = cell_value(data, "Stretch", cell, 1.0);
    status = check_pose_values(handles[i], pose[i]);
    if (!status.ok())
    {
      return status;
    }
  }
  return {};
}

void set_pose(vtkPolyData* data, const std::vector<Index>& cells, const Pose& pose)
{
  const vtkIdType count = data->GetNumberOfCells();
  vtkNew<vtkIntArray> modes;
  vtkNew<vtkDoubleArray> transforms;
  vtkNew<vtkDoubleArray> stretches;
  vtkNew<vtkDoubleArray> twists;
  modes->SetName("Mode");
  transforms->SetName("Transform");
  stretches->SetName("Stretch");
  twists->SetName("Twist");
  transforms->SetNumberOfComponents(12);
  twists->SetNumberOfComponents(2);
  modes->SetNumberOfTuples(count);
  transforms->SetNumberOfTuples(count);
  stretches->SetNumberOfTuples(count);
  twists->SetNumberOfTuples(count);
  Pose cell_poses(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    cell_poses[cells[i]] = pose[i];
  }
  for (vtkIdType cell = 0; cell < count; ++cell)
  {
    modes->SetValue(cell, static_cast<int>(cell_poses[cell].mode));
    transforms->SetTuple(cell, cell_poses[cell].transform.data());
    stretches->SetValue(cell, cell_poses[cell].stretch);
    twists->SetTuple(cell, cell_poses[cell].twist.data());
  }
  data->GetCellData()->AddArray(modes);
  data->GetCellData()->AddArray(transforms);
  data->GetCellData()->AddArray(stretches);
  data->GetCellData()->AddArray(twists);
}

std::vector<vtkObject*> bind_objects(vtkPolyData* handles)
{
  std::vector<vtkObject*> objects{ handles->GetPoints() ? handles->GetPoints()->GetData() : nullptr,
    handles->GetVerts(), handles->GetLines(), handles->GetPolys() };
  for (const char* name : { "HandleName", "HandleKind", "Parent", "RegionId", "Ownership" })
  {
    objects.push_back(handles->GetCellData()->GetAbstractArray(name));
  }
  return objects;
}

std::vector<vtkObject*> bind_objects(vtkPointSet* mesh, const std::vector<std::string>& array_names)
{
  std::vector<vtkObject*> objects{ mesh->GetPoints() ? mesh->GetPoints()->GetData() : nullptr };
  if (auto* polydata = vtkPolyData::SafeDownCast(mesh))
  {
    objects.push_back(polydata->GetPolys());
    objects.push_back(polydata->GetStrips());
  }
  else if (auto* grid = vtkUnstructuredGrid::SafeDownCast(mesh))
  {
    objects.push_back(grid->GetCells());
    objects.push_back(grid->GetCellTypesArray());
  }
  for (const std::string& name : array_names)
  {
    objects.push_back(mesh->GetPointData()->GetAbstractArray(name.c_str()));
  }
  return objects;
}

} // namespace bindpose
