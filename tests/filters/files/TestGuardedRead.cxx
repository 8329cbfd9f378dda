// Reading by the helper executable bindpose-reader: datasets of all classes are unchanged. If the
// helper crashes, hangs or writes an invalid record, there is an error message of one sentence.
#include "filters/data_of.h"

#include "base/execution.h"
#include "dataset_record.h"
#include "file_stamp.h"
#include "guarded_read.h"
#include "helper/helper_process.h"
#include "vtkMeshFileReader.h"
#include "vtkMeshFileWriter.h"

#include "support/cancel_later.h"
#include "support/files.h"
#include "support/meshes.h"
#include "support/watched_stand_in.h"

#include "vtkBitArray.h"
#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkSphereSource.h"
#include "vtkStringArray.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVariant.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <initializer_list>
#include <iterator>
#include <string>
#include <vector>

#include <unistd.h>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
template <typename Array>
void add_array(vtkFieldData* fields, const char* name, vtkIdType tuples, int components)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  for (vtkIdType k = 0; k < array->GetNumberOfValues(); ++k)
  {
    array->SetValue(k, static_cast<typename Array::ValueType>(3 * k + 1));
  }
  fields->AddArray(array);
}

void add_arrays(vtkDataSet* data)
{
  add_array<vtkDoubleArray>(data->GetPointData(), "doubles", data->GetNumberOfPoints(), 3);
  data->GetPointData()->GetArray("doubles")->SetComponentName(1, "a & <b>");
  data->GetPointData()->SetActiveVectors("doubles");
  add_array<vtkFloatArray>(data->GetPointData(), "floats", data->GetNumberOfPoints(), 1);
  data->GetPointData()->SetActiveScalars("floats");
  add_array<vtkUnsignedCharArray>(data->GetCellData(), "bytes", data->GetNumberOfCells(), 3);
  add_array<vtkIdTypeArray>(data->GetFieldData(), "ids", 5, 1);
  vtkNew<vtkStringArray> names;
  names->SetName("names");
  names->InsertNextValue("é <&>");
  names->InsertNextValue("");
  data->GetFieldData()->AddArray(names);
}

void expect_equal(vtkFieldData* found, vtkFieldData* expected)
{
  ASSERT_EQ(found->GetNumberOfArrays(), expected->GetNumberOfArrays());
  for (int a = 0; a < expected->GetNumberOfArrays(); ++a)
  {
    vtkAbstractArray* x = found->GetAbstractArray(a);
    vtkAbstractArray* y = expected->GetAbstractArray(a);
    EXPECT_STREQ(x->GetName(), y->GetName());
    ASSERT_EQ(x->GetDataType(), y->GetDataType());
    ASSERT_EQ(x->GetNumberOfComponents(), y->GetNumberOfComponents());
    ASSERT_EQ(x->GetNumberOfTuples(), y->GetNumberOfTuples());
    for (vtkIdType k = 0; k < y->GetNumberOfValues(); ++k)
    {
      ASSERT_EQ(x->GetVariantValue(k), y->GetVariantValue(k)) << y->GetName() << " " << k;
    }
    for (int c = 0; y->HasAComponentName() && c < y->GetNumberOfComponents(); ++c)
    {
      EXPECT_EQ(std::string(x->GetComponentName(c) ? x->GetComponentName(c) : ""),
        std::string(y->GetComponentName(c) ? y->GetComponentName(c) : ""));
    }
  }
}

void expect_equal(vtkDataSet* found, vtkDataSet* expected)
{
  ASSERT_STREQ(found->GetClassName(), expected->GetClassName());
  ASSERT_EQ(found->GetNumberOfPoints(), expected->GetNumberOfPoints());
  ASSERT_EQ(found->GetNumberOfCells(), expected->GetNumberOfCells());
  for (vtkIdType p = 0; p < expected->GetNumberOfPoints(); ++p)
  {
    for (int c = 0; c < 3; ++c)
    {
      ASSERT_EQ(found->GetPoint(p)[c], expected->GetPoint(p)[c]);
    }
  }
  vtkNew<vtkIdList> x, y;
  for (vtkIdType cell = 0; cell < expected->GetNumberOfCells(); ++cell)
  {
    ASSERT_EQ(found->GetCellType(cell), expected->GetCellType(cell));
    found->GetCellPoints(cell, x);
    expected->GetCellPoints(cell, y);
    ASSERT_EQ(x->GetNumberOfIds(), y->GetNumberOfIds());
    for (vtkIdType k = 0; k < y->GetNumberOfIds(); ++k)
    {
      ASSERT_EQ(x->GetId(k), y->GetId(k));
    }
  }
  expect_equal(found->GetPointData(), expected->GetPointData());
  expect_equal(found->GetCellData(), expected->GetCellData());
  expect_equal(found->GetFieldData(), expected->GetFieldData());
  for (int a = 0; a < vtkDataSetAttributes::NUM_ATTRIBUTES; ++a)
  {
    vtkAbstractArray* x_active = found->GetPointData()->GetAbstractAttribute(a);
    vtkAbstractArray* y_active = expected->GetPointData()->GetAbstractAttribute(a);
    ASSERT_EQ(x_active == nullptr, y_active == nullptr) << a;
    EXPECT_TRUE(!y_active || std::string(x_active->GetName()) == y_active->GetName()) << a;
  }
}

std::vector<vtkSmartPointer<vtkDataSet>> datasets()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->Update();
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->DeepCopy(sphere->GetOutput());
  surface->GetPointData()->Initialize();
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 0, 1, 2 });
  surface->SetLines(lines);
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetExtent(-1, 2, 3, 5, 0, 1);
  image->SetOrigin(0.1, 0.2, 0.3);
  image->SetSpacing(1.5, 2.5, 1.0 / 3.0);
  image->SetDirectionMatrix(0, 1, 0, -1, 0, 0, 0, 0, 1);
  auto rectilinear = vtkSmartPointer<vtkRectilinearGrid>::New();
  rectilinear->SetDimensions(3, 2, 1);
  const auto axis = [](std::initializer_list<double> values)
  {
    auto array = vtkSmartPointer<vtkDoubleArray>::New();
    for (const double value : values)
    {
      array->InsertNextValue(value);
    }
    return array;
  };
  rectilinear->SetXCoordinates(axis({ 0.0, 0.1, 3.0 }));
  rectilinear->SetYCoordinates(axis({ -1.0, 2.0 }));
  rectilinear->SetZCoordinates(axis({ 7.0 }));
  auto structured = vtkSmartPointer<vtkStructuredGrid>::New();
  structured->SetDimensions(2, 2, 2);
  vtkNew<vtkPoints> corners;
  for (int k = 0; k < 8; ++k)
  {
    corners->InsertNextPoint(k % 2, k / 2 % 2, 2.0 * (k / 4));
  }
  structured->SetPoints(corners);
  std::vector<vtkSmartPointer<vtkDataSet>> all{ surface, test::data_of(test::tet_box(2, 1, 1)),
    image, rectilinear, structured };
  for (const auto& data : all)
  {
    add_arrays(data);
  }
  return all;
}

/// Replaces bindpose-reader by a shell script.
class FakeReader : public test::WatchedFakeProgram
{
public:
  explicit FakeReader(const std::string& script)
    : WatchedFakeProgram("BINDPOSE_READER", script),
      file_(this->files_.write("mesh.vtp", "<VTKFile></VTKFile>"))
  {
  }
  Status read()
  {
    ExecutionContext context;
    return this->read(context);
  }
  Status read(ExecutionContext& context)
  {
    vtkSmartPointer<vtkDataSet> data;
    Status status = read_guarded(context, this->file_, data);
    EXPECT_EQ(data != nullptr, status.ok());
    return status;
  }

private:
  test::Folder files_;
  std::string file_;
};
} // namespace

TEST(DatasetRecord, DatasetsOfAllClassesAreReadBack)
{
  for (const auto& data : datasets())
  {
    SCOPED_TRACE(data->GetClassName());
    const FileDescriptor file(anonymous_file("record"));
    ASSERT_TRUE(write_dataset_record(file.get(), data).ok());
    vtkSmartPointer<vtkDataSet> read;
    const Status status = read_dataset_record(file.get(), read);
    ASSERT_TRUE(status.ok()) << status.message;
    expect_equal(read, data);
  }
  vtkNew<vtkPolyData> empty;
  const FileDescriptor file(anonymous_file("record"));
  ASSERT_TRUE(write_dataset_record(file.get(), empty).ok());
  vtkSmartPointer<vtkDataSet> read;
  ASSERT_TRUE(read_dataset_record(file.get(), read).ok());
  expect_equal(read, empty);
}

TEST(DatasetRecord, TruncatedAndChangedRecordsAreRefusedOrValid)
{
  for (const auto& data : datasets())
  {
    SCOPED_TRACE(data->GetClassName());
    const FileDescriptor file(anonymous_file("record"));
    ASSERT_TRUE(write_dataset_record(file.get(), data).ok());
    const auto size = static_cast<std::size_t>(::lseek(file.get(), 0, SEEK_END));
    std::string bytes(size, '\0');
    ASSERT_EQ(::pread(file.get(), bytes.data(), size, 0), static_cast<ssize_t>(size));
    const auto read_bytes = [&](const std::string& changed)
    {
      const FileDescriptor other(anonymous_file("changed"));
      EXPECT_EQ(::pwrite(other.get(), changed.data(), changed.size(), 0),
        static_cast<ssize_t>(changed.size()));
      vtkSmartPointer<vtkDataSet> read;
      const bool is_read = read_dataset_record(other.get(), read).ok();
      EXPECT_EQ(is_read, read != nullptr);
      if (is_read && read->GetNumberOfCells() < 10000)
      {
        vtkNew<vtkIdList> ids;
        for (vtkIdType cell = 0; cell < read->GetNumberOfCells(); ++cell)
        {
          read->GetCellPoints(cell, ids);
        }
      }
      return is_read;
    };
    for (std::size_t end = 0; end < size; end += 1 + size / 500)
    {
      EXPECT_FALSE(read_bytes(bytes.substr(0, end))) << end;
    }
    EXPECT_FALSE(read_bytes(bytes + "x"));
    test::Random random(3);
    for (int k = 0; k < 2000; ++k)
    {
      std::string changed = bytes;
      const auto at = static_cast<std::size_t>(random.below(static_cast<Index>(size)));
      changed[at] = static_cast<char>(random.below(256));
      read_bytes(changed);
    }
  }
}

TEST(DatasetRecord, PolyhedraAreRefused)
{
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  for (int k = 0; k < 4; ++k)
  {
    points->InsertNextPoint(k == 1, k == 2, k == 3);
  }
  grid->SetPoints(points);
  const vtkIdType faces[] = { 3, 0, 1, 2, 3, 0, 1, 3, 3, 0, 2, 3, 3, 1, 2, 3 };
  grid->InsertNextCell(VTK_POLYHEDRON, 4, faces);
  const FileDescriptor file(anonymous_file("record"));
  EXPECT_THAT(write_dataset_record(file.get(), grid).message, HasSubstr("polyhedra"));
}

TEST(DatasetRecord, CellsWithTooFewPointsAreRefused)
{
  vtkNew<vtkPoints> points;
  for (int k = 0; k < 4; ++k)
  {
    points->InsertNextPoint(k == 1, k == 2, k == 3);
  }
  for (const int type : { VTK_TETRA, VTK_LINE, VTK_QUADRATIC_TRIANGLE, VTK_EMPTY_CELL })
  {
    vtkNew<vtkCellArray> cells;
    cells->InsertNextCell({ 0, 1, 2 });
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(points);
    grid->SetCells(type, cells);
    const FileDescriptor file(anonymous_file("record"));
    ASSERT_TRUE(write_dataset_record(file.get(), grid).ok());
    vtkSmartPointer<vtkDataSet> read;
    EXPECT_THAT(read_dataset_record(file.get(), read).message, HasSubstr("cell 0 of type "))
      << type;
  }
}

TEST(DatasetRecord, PolygonsWithTooFewPointsAreRefused)
{
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(4);
  vtkNew<vtkCellArray> polygons;
  polygons->InsertNextCell({ 0, 1, 2 });
  polygons->InsertNextCell({ 2, 3 });
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(polygons);
  const FileDescriptor file(anonymous_file("record"));
  ASSERT_TRUE(write_dataset_record(file.get(), data).ok());
  vtkSmartPointer<vtkDataSet> read;
  EXPECT_EQ(
    read_dataset_record(file.get(), read).message, "polygon 1 has 2 points; expected at least 3");
}

TEST(DatasetRecord, BitsBecomeBytes)
{
  vtkNew<vtkPolyData> data;
  vtkNew<vtkBitArray> bits;
  bits->SetName("bits");
  for (int k = 0; k < 11; ++k)
  {
    bits->InsertNextValue(k % 3 == 0);
  }
  data->GetFieldData()->AddArray(bits);
  const FileDescriptor file(anonymous_file("record"));
  ASSERT_TRUE(write_dataset_record(file.get(), data).ok());
  vtkSmartPointer<vtkDataSet> read;
  ASSERT_TRUE(read_dataset_record(file.get(), read).ok());
  auto* bytes = vtkUnsignedCharArray::SafeDownCast(read->GetFieldData()->GetAbstractArray("bits"));
  ASSERT_NE(bytes, nullptr);
  ASSERT_EQ(bytes->GetNumberOfValues(), 11);
  for (int k = 0; k < 11; ++k)
  {
    EXPECT_EQ(bytes->GetValue(k), k % 3 == 0) << k;
  }
}

TEST(GuardedRead, HeadersAreParsedWithoutVTK)
{
  const test::Folder folder;
  ImageHeader header;
  EXPECT_TRUE(
    read_image_header(folder.write("a.vti",
                        "<VTKFile type=\"ImageData\">\n<ImageData WholeExtent='-1 2 3 5 0 1'\n"
                        "Origin=\"0.5 1 -2e3\" Spacing=\"1 2 0.25\">"),
      header));
  EXPECT_EQ(header.extent, (std::array<int, 6>{ -1, 2, 3, 5, 0, 1 }));
  EXPECT_EQ(header.origin, (std::array<double, 3>{ 0.5, 1.0, -2000.0 }));
  EXPECT_EQ(header.spacing, (std::array<double, 3>{ 1.0, 2.0, 0.25 }));
  EXPECT_TRUE(read_image_header(
    folder.write("b.vti", "<ImageData WholeExtent=\"0 1 0 1 0 1\" Origin=\"x\">"), header));
  EXPECT_EQ(header.origin, (std::array<double, 3>{}));
  for (const char* text : { "", "<ImageData", "<ImageData WholeExtent=",
         "<ImageData WholeExtent=\"0 1", "<ImageData WholeExtent=\"0 1 0 1 0\">", "<PolyData>" })
  {
    EXPECT_FALSE(read_image_header(folder.write("c.vti", text), header)) << text;
  }

  const auto class_of = [&folder](const std::string& text)
  { return legacy_class(folder.write("d.vtk", "# vtk DataFile Version 3.0\n" + text)); };
  EXPECT_EQ(class_of("DATASET POLYDATA in a title\nASCII\nDATASET UNSTRUCTURED_GRID\n"),
    "vtkUnstructuredGrid");
  EXPECT_EQ(class_of("title\nBINARY\ndataset polydata\n"), "vtkPolyData");
  EXPECT_EQ(class_of("title\nASCII\nDATASET STRUCTURED_POINTS\n"), "vtkImageData");
  EXPECT_EQ(class_of("title\nASCII\nDATASET TABLE\n"), "");
  EXPECT_EQ(class_of("title\nASCII\n"), "");
}

TEST(FileStamp, DetectsChangedFiles)
{
  const test::Folder folder;
  const std::string path = folder.write("a.txt", "one");
  const FileStamp fresh(path);
  EXPECT_FALSE(FileStamp(path).has_content_of(fresh)) << "a later change could have the same time";
  const auto long_ago = std::filesystem::file_time_type::clock::now() - std::chrono::hours(1);
  std::filesystem::last_write_time(path, long_ago);
  const FileStamp stored(path);
  EXPECT_TRUE(FileStamp(path).has_content_of(stored));
  EXPECT_FALSE(FileStamp(folder.write("b.txt", "one")).has_content_of(stored));
  const FileStamp changed_during_read(path, long_ago - std::chrono::seconds(1));
  EXPECT_FALSE(FileStamp(path).has_content_of(changed_during_read));
  std::filesystem::last_write_time(path, long_ago + std::chrono::seconds(1));
  EXPECT_FALSE(FileStamp(path).has_content_of(stored));
  folder.write("a.txt", "three");
  std::filesystem::last_write_time(path, long_ago);
  EXPECT_FALSE(FileStamp(path).has_content_of(stored));
  std::filesystem::remove(path);
  EXPECT_FALSE(FileStamp(path).has_content_of(FileStamp(path)));
}

TEST(GuardedRead, ACrashOfTheHelperIsAnError)
{
  FakeReader reader("kill -SEGV $$\n");
  const Status status = reader.read();
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  EXPECT_THAT(status.message, HasSubstr("mesh.vtp cannot be read"));
  EXPECT_THAT(status.message, HasSubstr("signal 11"));
  EXPECT_EQ(status.message.find('\n'), std::string::npos);
}

TEST(GuardedRead, AnErrorOfTheHelperOrAnInvalidRecordIsAnError)
{
  EXPECT_THAT(FakeReader("echo 'error the file is damaged' >&2\nexit 1\n").read().message,
    HasSubstr("the file is damaged"));
  EXPECT_THAT(FakeReader("exit 0\n").read().message, HasSubstr("cannot be read"));
  EXPECT_THAT(FakeReader("echo BPDATA01garbage\n").read().message, HasSubstr("cannot be read"));
}

TEST(GuardedRead, CancelEndsTheHelper)
{
  FakeReader reader("sleep 60\n");
  ExecutionContext context;
  const test::DelayedCancel cancel(context, 100);
  EXPECT_EQ(reader.read(context).code, StatusCode::canceled);
}

TEST(GuardedRead, AMissingHelperIsNamed)
{
  const test::Environment variable("BINDPOSE_READER", "/nowhere/bindpose-reader");
  const test::Folder folder;
  ExecutionContext context;
  vtkSmartPointer<vtkDataSet> data;
  const Status status =
    read_guarded(context, folder.write("mesh.vtp", "<VTKFile></VTKFile>"), data);
  EXPECT_EQ(status.code, StatusCode::unavailable);
  EXPECT_THAT(status.message, HasSubstr("/nowhere/bindpose-reader"));
}

TEST(GuardedRead, NamesWithAnyCharacterAreReadBack)
{
  test::Random random(5);
  const std::string alphabet[] = { "a", "Z", "&", "<", ">", "\"", "'", " ", "é", "漢", "🦴", "%",
    "/", "\\", ";", "&amp;" };
  const test::Folder folder;
  for (int k = 0; k < 20; ++k)
  {
    auto data = test::data_of(test::cube());
    vtkNew<vtkDoubleArray> weights;
    std::string name = "w";
    for (Index c = random.below(12); c >= 0; --c)
    {
      name += alphabet[random.below(std::size(alphabet))];
    }
    weights->SetName(name.c_str());
    weights->SetNumberOfComponents(2);
    weights->SetNumberOfTuples(data->GetNumberOfPoints());
    weights->Fill(0.5);
    weights->SetComponentName(0, ("first " + name).c_str());
    weights->SetComponentName(1, (name + " second").c_str());
    data->GetPointData()->SetScalars(weights);
    for (const char* file : { "names.vtp", "names.vtk" })
    {
      vtkNew<vtkMeshFileWriter> writer;
      writer->SetInputData(data);
      writer->SetFileName((folder / file).c_str());
      writer->OverwriteOn();
      ASSERT_EQ(writer->Write(), 1) << writer->GetStatusMessage();
      vtkNew<vtkMeshFileReader> reader;
      reader->SetFileName((folder / file).c_str());
      reader->Update();
      ASSERT_EQ(reader->GetStatus(), vtkBindposeAlgorithm::OK) << reader->GetStatusMessage();
      vtkDataArray* read =
        vtkDataSet::SafeDownCast(reader->GetOutputDataObject(0))->GetPointData()->GetScalars();
      ASSERT_TRUE(read) << name;
      EXPECT_EQ(read->GetName(), name) << file;
      EXPECT_EQ(std::string(read->GetComponentName(0)), "first " + name) << file;
      EXPECT_EQ(std::string(read->GetComponentName(1)), name + " second") << file;
    }
    EXPECT_STREQ(data->GetPointData()->GetScalars()->GetName(), name.c_str())
      << "the input is unchanged";
  }
}
