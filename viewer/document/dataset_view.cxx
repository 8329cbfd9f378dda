// Creates views of datasets for use on another thread. VTK caches data about an array (its range,
// for example) in the array, and pipeline information in the dataset. A view therefore has its own
// arrays and dataset, and shares only the memory of the values.
#include "document/dataset_view.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

namespace
{
/// Return an array that shares the memory of the values. Strings and arrays without contiguous
/// memory are copied, because they are small.
vtkSmartPointer<vtkAbstractArray> view_of_array(vtkAbstractArray* array)
{
  auto view = vtkSmartPointer<vtkAbstractArray>::Take(array->NewInstance());
  if (!vtkDataArray::SafeDownCast(array) || !array->HasStandardMemoryLayout())
  {
    view->DeepCopy(array);
    return view;
  }
  constexpr int memory_is_shared = 1; // VTK must not free the memory
  view->SetNumberOfComponents(array->GetNumberOfComponents());
  view->SetVoidArray(array->GetVoidPointer(0), array->GetNumberOfValues(), memory_is_shared);
  view->SetName(array->GetName());
  for (int k = 0; array->HasAComponentName() && k < array->GetNumberOfComponents(); ++k)
  {
    if (const char* name = array->GetComponentName(k))
    {
      view->SetComponentName(k, name);
    }
  }
  return view;
}

vtkSmartPointer<vtkDataArray> view_of_numbers(vtkDataArray* array)
{
  return vtkDataArray::SafeDownCast(view_of_array(array));
}

vtkSmartPointer<vtkCellArray> view_of_cells(vtkCellArray* cells)
{
  auto view = vtkSmartPointer<vtkCellArray>::New();
  view->SetData(view_of_numbers(cells->GetOffsetsArray()).Get(),
    view_of_numbers(cells->GetConnectivityArray()).Get());
  return view;
}

void view_arrays(vtkFieldData* arrays, vtkFieldData* view)
{
  for (int k = 0; k < arrays->GetNumberOfArrays(); ++k)
  {
    view->AddArray(view_of_array(arrays->GetAbstractArray(k)));
  }
}

void view_attributes(vtkDataSetAttributes* arrays, vtkDataSetAttributes* view)
{
  view_arrays(arrays, view);
  for (int attribute = 0; attribute < vtkDataSetAttributes::NUM_ATTRIBUTES; ++attribute)
  {
    vtkAbstractArray* active = arrays->GetAbstractAttribute(attribute);
    if (active && active->GetName())
    {
      view->SetActiveAttribute(active->GetName(), attribute);
    }
  }
}
} // namespace

vtkSmartPointer<vtkDataSet> view_of(vtkDataSet* data)
{
  if (auto* image = vtkImageData::SafeDownCast(data))
  {
    auto view = vtkSmartPointer<vtkImageData>::New();
    view->SetOrigin(image->GetOrigin());
    view->SetSpacing(image->GetSpacing());
    view->SetDirectionMatrix(image->GetDirectionMatrix());
    view->SetExtent(image->GetExtent());
    view_attributes(image->GetPointData(), view->GetPointData());
    view_attributes(image->GetCellData(), view->GetCellData());
    view_arrays(image->GetFieldData(), view->GetFieldData());
    return view;
  }
  auto* polydata = vtkPolyData::SafeDownCast(data);
  auto* grid = vtkUnstructuredGrid::SafeDownCast(data);
  if (!polydata && !(grid && !grid->GetFaces()))
  {
    return nullptr;
  }
  auto view = vtkSmartPointer<vtkPointSet>::Take(vtkPointSet::SafeDownCast(data)->NewInstance());
  if (vtkPoints* points = vtkPointSet::SafeDownCast(data)->GetPoints())
  {
    vtkNew<vtkPoints> view_points;
    view_points->SetData(view_of_numbers(points->GetData()));
    view->SetPoints(view_points);
  }
  if (polydata)
  {
    auto* result = vtkPolyData::SafeDownCast(view);
    result->SetVerts(view_of_cells(polydata->GetVerts()));
    result->SetLines(view_of_cells(polydata->GetLines()));
    result->SetPolys(view_of_cells(polydata->GetPolys()));
    result->SetStrips(view_of_cells(polydata->GetStrips()));
  }
  else if (grid->GetCells() && grid->GetCellTypesArray())
  {
    auto* result = vtkUnstructuredGrid::SafeDownCast(view);
    const auto types = view_of_array(grid->GetCellTypesArray());
    result->SetCells(vtkUnsignedCharArray::SafeDownCast(types), view_of_cells(grid->GetCells()));
  }
  view_attributes(data->GetPointData(), view->GetPointData());
  view_attributes(data->GetCellData(), view->GetCellData());
  view_arrays(data->GetFieldData(), view->GetFieldData());
  return view;
}
