#include "fuzz/filter_targets.h"

#include "conversion.h"
#include "dataset_record.h"
#include "xml_names.h"

#include "fuzz/memory_file.h"
#include "fuzz/status_checks.h"

#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <algorithm>

namespace bindpose::test
{

namespace
{
bool check_record(std::string_view input)
{
  const MemoryFile file(input);
  vtkSmartPointer<vtkDataSet> data;
  const Status status = read_dataset_record(file.descriptor(), data);
  if (!status.ok())
  {
    EXPECT_EQ(status.code, StatusCode::internal_error);
    expect_valid_messages(status);
    EXPECT_EQ(data, nullptr);
    return false;
  }
  constexpr vtkIdType maximum_cells = 10000; // images without arrays can have any number of cells
  const vtkIdType cells = std::min(data->GetNumberOfCells(), maximum_cells);
  for (vtkIdType cell = 0; cell < cells; ++cell)
  {
    // VTK's cells of higher order do not check the number of their points.
    if (data->GetCellType(cell) < VTK_LAGRANGE_CURVE)
    {
      data->GetCell(cell);
    }
  }
  SurfaceInput surface;
  expect_valid_messages(to_surface(data, surface));
  TetInput tets;
  expect_valid_messages(to_tets(data, tets));
  return true;
}

std::string name_of(vtkAbstractArray* array, int component)
{
  const char* name = component < 0 ? array->GetName() : array->GetComponentName(component);
  return name ? name : "";
}

/// Return a vertex with an array of three components. The first line of the input is the name of
/// the array; the next three lines are the names of its components.
vtkSmartPointer<vtkPolyData> named_array(std::string_view input)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.0, 0.0, 0.0);
  data->SetPoints(points);
  vtkNew<vtkDoubleArray> array;
  array->SetNumberOfComponents(3);
  array->InsertNextTuple3(1.0, 2.0, 3.0);
  for (int component = -1; component < 3; ++component)
  {
    const std::size_t end = std::min(input.find('\n'), input.size());
    const std::string name(input.substr(0, end));
    input.remove_prefix(std::min(end + 1, input.size()));
    if (component < 0)
    {
      array->SetName(name.c_str());
    }
    else
    {
      array->SetComponentName(component, name.c_str());
    }
  }
  data->GetPointData()->AddArray(array);
  return data;
}

bool check_xml_names(std::string_view input)
{
  const auto data = named_array(input);
  vtkSmartPointer<vtkDataSet> escaped;
  const Status status = escape_names(data, escaped);
  if (!status.ok())
  {
    expect_refused(status);
    return false;
  }
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(escaped);
  writer->WriteToOutputStringOn();
  EXPECT_EQ(writer->Write(), 1);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(writer->GetOutputString());
  reader->Update();
  vtkAbstractArray* before = data->GetPointData()->GetAbstractArray(0);
  vtkAbstractArray* after = reader->GetOutput()->GetPointData()->GetAbstractArray(0);
  if (name_of(before, -1).empty())
  {
    return true; // VTK's readers ignore an array whose name is empty.
  }
  EXPECT_NE(after, nullptr);
  for (int component = -1; after && component < 3; ++component)
  {
    EXPECT_EQ(name_of(after, component), name_of(before, component));
  }
  return true;
}
} // namespace

const std::vector<FuzzTarget>& filter_fuzz_targets()
{
  static const std::vector<FuzzTarget> targets{
    { "record", check_record, 6000 },
    { "xml_names", check_xml_names, 1000 },
  };
  return targets;
}

} // namespace bindpose::test
