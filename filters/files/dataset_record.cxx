// The record (see dataset_record.h) starts with a magic word and the class of the dataset. Numbers
// have the machine's byte order. Lists start with their number of entries as 64 bits, and the
// record ends with the magic word, so that a truncated record is detected.
#include "dataset_record.h"

#include "cell_check.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkAbstractArray.h"
#include "vtkBitArray.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkStringArray.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace bindpose
{

namespace
{
constexpr std::array<char, 8> magic{ 'B', 'P', 'D', 'A', 'T', 'A', '0', '1' };

/// The kinds of datasets in a record. A file format may contain others, which are refused.
enum class Kind : std::int64_t
{
  polydata,
  unstructured_grid,
  image,
  rectilinear_grid,
  structured_grid
};

/// Thrown by RecordReader if the record is not valid. Caught in read_dataset_record().
struct InvalidRecord
{
  std::string what;
};

class RecordWriter
{
public:
  explicit RecordWriter(int file) : file_(file) {}
  ~RecordWriter() = default;
  RecordWriter(const RecordWriter&) = delete;
  RecordWriter& operator=(const RecordWriter&) = delete;

  template <typename Number>
  void number(Number value)
  {
    this->bytes(&value, sizeof(value));
  }
  void text(const std::string& value)
  {
    this->number(static_cast<std::int64_t>(value.size()));
    this->bytes(value.data(), value.size());
  }
  void bytes(const void* data, std::size_t size)
  {
    const char* from = static_cast<const char*>(data);
    if (this->buffer_.size() + size <= buffer_size)
    {
      this->buffer_.insert(this->buffer_.end(), from, from + size);
      return;
    }
    this->flush();
    this->write(from, size);
  }
  /// @return false if any write failed
  bool flush()
  {
    this->write(this->buffer_.data(), this->buffer_.size());
    this->buffer_.clear();
    return this->succeeded_;
  }

private:
  static constexpr std::size_t buffer_size = 65536;

  void write(const char* next, std::size_t size)
  {
    while (size > 0 && this->succeeded_)
    {
      const ssize_t written = ::write(this->file_, next, size);
      if (written < 0 && errno == EINTR)
      {
        continue;
      }
      this->succeeded_ = written > 0;
      next += written > 0 ? written : 0;
      size -= static_cast<std::size_t>(written > 0 ? written : 0);
    }
  }

  int file_;
  bool succeeded_ = true;
  std::vector<char> buffer_;
};

/// Reads a record in memory. Each function throws InvalidRecord instead of reading beyond the end.
class RecordReader
{
public:
  RecordReader(const char* begin, std::size_t size) : next_(begin), end_(begin + size) {}

  template <typename Number>
  Number number()
  {
    Number value;
    std::memcpy(&value, this->bytes(sizeof(value)), sizeof(value));
    return value;
  }
  /// Read the number of entries of a list whose entries have at least `entry_size` bytes.
  std::int64_t count(std::size_t entry_size)
  {
    const auto entries = this->number<std::int64_t>();
    if (entries < 0 || static_cast<std::size_t>(entries) > this->left() / entry_size)
    {
      throw InvalidRecord{ "a list is longer than the record" };
    }
    return entries;
  }
  std::string text()
  {
    const auto size = static_cast<std::size_t>(this->count(1));
    const char* from = this->bytes(size);
    return { from, size };
  }
  const char* bytes(std::size_t size)
  {
    if (size > this->left())
    {
      throw InvalidRecord{ "the record is truncated" };
    }
    const char* from = this->next_;
    this->next_ += size;
    return from;
  }
  std::size_t left() const { return static_cast<std::size_t>(this->end_ - this->next_); }

private:
  const char* next_;
  const char* end_;
};

// ---- Arrays ------------------------------------------------------------------------------------

/// Report whether an array consists of strings, or of numbers in one block of memory.
bool is_plain(vtkAbstractArray* array)
{
  const bool is_number = vtkDataArray::SafeDownCast(array) && !vtkBitArray::SafeDownCast(array) &&
    array->HasStandardMemoryLayout();
  return is_number || vtkStringArray::SafeDownCast(array);
}

/// Return an array in the form in which it is written, or null if its type is not
/// supported. Bits become bytes; arrays with other memory layouts become doubles.
vtkSmartPointer<vtkAbstractArray> written_form(vtkAbstractArray* array)
{
  if (is_plain(array))
  {
    return array;
  }
  auto* numbers = vtkDataArray::SafeDownCast(array);
  if (!numbers)
  {
    return nullptr;
  }
  vtkSmartPointer<vtkDataArray> copy;
  if (vtkBitArray::SafeDownCast(array))
  {
    copy = vtkSmartPointer<vtkUnsignedCharArray>::New();
  }
  else
  {
    copy = vtkSmartPointer<vtkDoubleArray>::New();
  }
  copy->DeepCopy(numbers);
  return copy;
}

void write_array(RecordWriter& to, vtkAbstractArray* array)
{
  to.text(array->GetName() ? array->GetName() : "");
  to.number(static_cast<std::int64_t>(array->GetDataType()));
  to.number(static_cast<std::int64_t>(array->GetNumberOfComponents()));
  to.number(static_cast<std::int64_t>(array->GetNumberOfTuples()));
  const bool is_named = array->HasAComponentName();
  to.number(static_cast<std::int64_t>(is_named));
  for (int c = 0; is_named && c < array->GetNumberOfComponents(); ++c)
  {
    to.text(array->GetComponentName(c) ? array->GetComponentName(c) : "");
  }
  if (auto* strings = vtkStringArray::SafeDownCast(array))
  {
    for (vtkIdType k = 0; k < strings->GetNumberOfValues(); ++k)
    {
      to.text(strings->GetValue(k));
    }
    return;
  }
  to.bytes(array->GetVoidPointer(0),
    static_cast<std::size_t>(array->GetNumberOfValues()) *
      static_cast<std::size_t>(array->GetDataTypeSize()));
}

vtkSmartPointer<vtkAbstractArray> read_array(RecordReader& from)
{
  const std::string name = from.text();
  const auto type = from.number<std::int64_t>();
  const auto components = from.number<std::int64_t>();
  const auto tuples = from.number<std::int64_t>();
  const bool is_named = from.number<std::int64_t>() != 0;
  constexpr std::int64_t largest_type = VTK_UNSIGNED_LONG_LONG;
  // Limit the components, because VTK allocates one tuple even for an empty array.
  constexpr std::int64_t largest_components = 1000000;
  if (type < VTK_CHAR || type > largest_type || type == VTK_OPAQUE || components < 1 ||
    components > largest_components || tuples < 0 ||
    tuples > static_cast<std::int64_t>(from.left()) / components)
  {
    throw InvalidRecord{ "the header of an array is not valid" };
  }
  auto array = vtk::TakeSmartPointer(vtkAbstractArray::CreateArray(static_cast<int>(type)));
  if (!array || !is_plain(array))
  {
    throw InvalidRecord{ "an array has an unknown type" };
  }
  if (!name.empty())
  {
    array->SetName(name.c_str());
  }
  array->SetNumberOfComponents(static_cast<int>(components));
  for (int c = 0; is_named && c < components; ++c)
  {
    const std::string component = from.text();
    if (!component.empty())
    {
      array->SetComponentName(c, component.c_str());
    }
  }
  if (auto* strings = vtkStringArray::SafeDownCast(array))
  {
    // Each string begins with its length.
    if (components * tuples > static_cast<std::int64_t>(from.left() / sizeof(std::int64_t)))
    {
      throw InvalidRecord{ "an array of strings is longer than the record" };
    }
    strings->SetNumberOfTuples(tuples);
    for (vtkIdType k = 0; k < strings->GetNumberOfValues(); ++k)
    {
      strings->SetValue(k, from.text());
    }
    return array;
  }
  const std::size_t size = static_cast<std::size_t>(components * tuples) *
    static_cast<std::size_t>(array->GetDataTypeSize());
  const char* values = from.bytes(size);
  array->SetNumberOfTuples(tuples);
  if (size > 0)
  {
    std::memcpy(array->GetVoidPointer(0), values, size);
  }
  return array;
}

vtkSmartPointer<vtkDataArray> read_numbers(RecordReader& from)
{
  auto array = read_array(from);
  auto* numbers = vtkDataArray::SafeDownCast(array);
  if (!numbers)
  {
    throw InvalidRecord{ "expected an array of numbers, found strings" };
  }
  return numbers;
}

/// Write the arrays. For each array, also write the ids of the attributes (scalars, normals, …) for
/// which it is the active array.
void write_attributes(RecordWriter& to, vtkFieldData* data)
{
  std::vector<std::pair<vtkAbstractArray*, vtkSmartPointer<vtkAbstractArray>>> arrays;
  for (int k = 0; k < data->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* array = data->GetAbstractArray(k);
    if (const auto form = written_form(array))
    {
      arrays.emplace_back(array, form);
    }
  }
  auto* attributes = vtkDataSetAttributes::SafeDownCast(data);
  to.number(static_cast<std::int64_t>(arrays.size()));
  for (const auto& [array, form] : arrays)
  {
    write_array(to, form);
    std::vector<std::int64_t> active;
    for (int a = 0; attributes && a < vtkDataSetAttributes::NUM_ATTRIBUTES; ++a)
    {
      if (attributes->GetAbstractAttribute(a) == array)
      {
        active.push_back(a);
      }
    }
    // Store a list of ids, because the number of attributes depends on the version of VTK.
    to.number(static_cast<std::int64_t>(active.size()));
    for (const std::int64_t attribute : active)
    {
      to.number(attribute);
    }
  }
}

/// @param tuples number of points or cells; -1: any number
void read_attributes(RecordReader& from, vtkIdType tuples, vtkFieldData* data)
{
  auto* attributes = vtkDataSetAttributes::SafeDownCast(data);
  const auto count = from.count(6 * sizeof(std::int64_t));
  for (std::int64_t k = 0; k < count; ++k)
  {
    const auto array = read_array(from);
    if (tuples >= 0 && array->GetNumberOfTuples() != tuples)
    {
      throw InvalidRecord{ "an array does not have one entry per point or cell" };
    }
    // AddArray() replaces an array of the same name, so use the index that it returns.
    const int index = data->AddArray(array);
    const auto active = from.count(sizeof(std::int64_t));
    for (std::int64_t a = 0; a < active; ++a)
    {
      const auto attribute = from.number<std::int64_t>();
      if (attributes && attribute >= 0 && attribute < vtkDataSetAttributes::NUM_ATTRIBUTES)
      {
        attributes->SetActiveAttribute(index, static_cast<int>(attribute));
      }
    }
  }
}

// ---- Geometry ----------------------------------------------------------------------------------

void write_points(RecordWriter& to, vtkPointSet* data)
{
  vtkNew<vtkPoints> none;
  vtkPoints* points = data->GetPoints() ? data->GetPoints() : none.Get();
  write_array(to, points->GetData());
}

void read_points(RecordReader& from, vtkPointSet* data)
{
  const auto coordinates = read_numbers(from);
  if (coordinates->GetNumberOfComponents() != 3)
  {
    throw InvalidRecord{ "the points do not have three coordinates" };
  }
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  data->SetPoints(points);
}

void write_cells(RecordWriter& to, vtkCellArray* cells)
{
  vtkNew<vtkCellArray> none;
  vtkCellArray* all = cells ? cells : none.Get();
  const bool is_wide = all->IsStorage64Bit();
  to.number(static_cast<std::int64_t>(is_wide));
  write_array(to, all->GetOffsetsArray());
  write_array(to, all->GetConnectivityArray());
}

/// Check that all ids are in range, and set the cells. require_valid_cells() checks the offsets.
template <typename Value>
void set_cells(
  vtkDataArray* offsets, vtkDataArray* connectivity, vtkIdType points, vtkCellArray* cells)
{
  using Array = vtkAOSDataArrayTemplate<Value>;
  auto* ends = vtkArrayDownCast<Array>(offsets);
  auto* ids = vtkArrayDownCast<Array>(connectivity);
  if (!ends || !ids || ends->GetNumberOfComponents() != 1 || ids->GetNumberOfComponents() != 1 ||
    ends->GetNumberOfValues() == 0)
  {
    throw InvalidRecord{ "the cells have no valid offsets" };
  }
  for (vtkIdType k = 0; k < ids->GetNumberOfValues(); ++k)
  {
    if (ids->GetValue(k) < 0 || ids->GetValue(k) >= points)
    {
      throw InvalidRecord{ "a cell references a point that does not exist" };
    }
  }
  if (!cells->SetData(offsets, connectivity))
  {
    throw InvalidRecord{ "the types of the offsets and the point ids differ" };
  }
}

vtkSmartPointer<vtkCellArray> read_cells(RecordReader& from, vtkIdType points)
{
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  const bool is_wide = from.number<std::int64_t>() != 0;
  const auto offsets = read_numbers(from);
  const auto connectivity = read_numbers(from);
  if (is_wide)
  {
    set_cells<vtkTypeInt64>(offsets, connectivity, points, cells);
  }
  else
  {
    set_cells<vtkTypeInt32>(offsets, connectivity, points, cells);
  }
  return cells;
}

// ---- Datasets ----------------------------------------------------------------------------------

void write_polydata(RecordWriter& to, vtkPolyData* data)
{
  write_points(to, data);
  for (vtkCellArray* cells :
    { data->GetVerts(), data->GetLines(), data->GetPolys(), data->GetStrips() })
  {
    write_cells(to, cells);
  }
}

/// Throw InvalidRecord if check_cells() fails.
void require_valid_cells(vtkDataObject* data)
{
  const Status status = check_cells(data);
  if (!status.ok())
  {
    throw InvalidRecord{ status.message };
  }
}

vtkSmartPointer<vtkDataSet> read_polydata(RecordReader& from)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  read_points(from, data);
  const vtkIdType points = data->GetNumberOfPoints();
  data->SetVerts(read_cells(from, points));
  data->SetLines(read_cells(from, points));
  data->SetPolys(read_cells(from, points));
  data->SetStrips(read_cells(from, points));
  require_valid_cells(data);
  return data;
}

bool has_polyhedra(vtkUnsignedCharArray* types)
{
  for (vtkIdType k = 0; types && k < types->GetNumberOfValues(); ++k)
  {
    if (types->GetValue(k) == VTK_POLYHEDRON)
    {
      return true;
    }
  }
  return false;
}

void write_grid(RecordWriter& to, vtkUnstructuredGrid* data)
{
  write_points(to, data);
  vtkNew<vtkUnsignedCharArray> none;
  write_array(to, data->GetCellTypesArray() ? data->GetCellTypesArray() : none.Get());
  write_cells(to, data->GetCells());
}

vtkSmartPointer<vtkDataSet> read_grid(RecordReader& from)
{
  auto data = vtkSmartPointer<vtkUnstructuredGrid>::New();
  read_points(from, data);
  const auto types = read_array(from);
  const auto cells = read_cells(from, data->GetNumberOfPoints());
  auto* bytes = vtkUnsignedCharArray::SafeDownCast(types);
  if (!bytes || bytes->GetNumberOfComponents() != 1 ||
    bytes->GetNumberOfValues() != cells->GetNumberOfCells())
  {
    throw InvalidRecord{ "the cells do not have one type each" };
  }
  if (has_polyhedra(bytes))
  {
    throw InvalidRecord{ "a polyhedron has no faces" };
  }
  if (cells->GetNumberOfCells() > 0)
  {
    data->SetCells(bytes, cells);
  }
  require_valid_cells(data);
  return data;
}

void write_extent(RecordWriter& to, const int* extent)
{
  for (int k = 0; k < 6; ++k)
  {
    to.number(static_cast<std::int64_t>(extent[k]));
  }
}

/// Read an extent. VTK multiplies the numbers of points along the axes, so each number must be at
/// least 0. It is 0 in an empty extent, whose upper end is the lower end minus 1.
std::array<int, 6> read_extent(RecordReader& from)
{
  std::array<int, 6> extent{};
  double points = 1.0;
  for (int& end : extent)
  {
    const auto value = from.number<std::int64_t>();
    if (value < VTK_INT_MIN / 2 || value > VTK_INT_MAX / 2)
    {
      throw InvalidRecord{ "an extent is out of range" };
    }
    end = static_cast<int>(value);
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    const double count = double(extent[2 * axis + 1]) - extent[2 * axis] + 1.0;
    if (count < 0.0)
    {
      throw InvalidRecord{ "an extent is out of range" };
    }
    points *= count;
  }
  constexpr double largest_count = 1e15;
  if (points > largest_count)
  {
    throw InvalidRecord{ "an extent has too many points" };
  }
  return extent;
}

void write_image(RecordWriter& to, vtkImageData* data)
{
  write_extent(to, data->GetExtent());
  for (int k = 0; k < 3; ++k)
  {
    to.number(data->GetOrigin()[k]);
    to.number(data->GetSpacing()[k]);
  }
  for (int k = 0; k < 9; ++k)
  {
    to.number(data->GetDirectionMatrix()->GetData()[k]);
  }
}

vtkSmartPointer<vtkDataSet> read_image(RecordReader& from)
{
  auto data = vtkSmartPointer<vtkImageData>::New();
  std::array<int, 6> extent = read_extent(from);
  std::array<double, 3> origin{}, spacing{};
  for (int k = 0; k < 3; ++k)
  {
    origin[k] = from.number<double>();
    spacing[k] = from.number<double>();
  }
  std::array<double, 9> direction{};
  for (double& entry : direction)
  {
    entry = from.number<double>();
  }
  data->SetExtent(extent.data());
  data->SetOrigin(origin.data());
  data->SetSpacing(spacing.data());
  data->SetDirectionMatrix(direction.data());
  return data;
}

void write_rectilinear(RecordWriter& to, vtkRectilinearGrid* data)
{
  write_extent(to, data->GetExtent());
  for (vtkDataArray* coordinates :
    { data->GetXCoordinates(), data->GetYCoordinates(), data->GetZCoordinates() })
  {
    write_array(to, coordinates);
  }
}

vtkSmartPointer<vtkDataSet> read_rectilinear(RecordReader& from)
{
  auto data = vtkSmartPointer<vtkRectilinearGrid>::New();
  std::array<int, 6> extent = read_extent(from);
  const std::array<vtkSmartPointer<vtkDataArray>, 3> axes{ read_numbers(from), read_numbers(from),
    read_numbers(from) };
  for (int axis = 0; axis < 3; ++axis)
  {
    const vtkIdType count = vtkIdType(extent[2 * axis + 1]) - extent[2 * axis] + 1;
    if (axes[axis]->GetNumberOfComponents() != 1 || axes[axis]->GetNumberOfTuples() != count)
    {
      throw InvalidRecord{ "the coordinates of a rectilinear grid do not match its extent" };
    }
  }
  data->SetExtent(extent.data());
  data->SetXCoordinates(axes[0]);
  data->SetYCoordinates(axes[1]);
  data->SetZCoordinates(axes[2]);
  return data;
}

void write_structured(RecordWriter& to, vtkStructuredGrid* data)
{
  write_extent(to, data->GetExtent());
  write_points(to, data);
}

vtkSmartPointer<vtkDataSet> read_structured(RecordReader& from)
{
  auto data = vtkSmartPointer<vtkStructuredGrid>::New();
  std::array<int, 6> extent = read_extent(from);
  data->SetExtent(extent.data());
  read_points(from, data);
  vtkIdType points = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    points *= vtkIdType(extent[2 * axis + 1]) - extent[2 * axis] + 1;
  }
  if (data->GetPoints()->GetNumberOfPoints() != points)
  {
    throw InvalidRecord{ "the points of a structured grid do not match its extent" };
  }
  return data;
}

vtkSmartPointer<vtkDataSet> read_geometry(RecordReader& from, Kind kind)
{
  switch (kind)
  {
    case Kind::polydata:
      return read_polydata(from);
    case Kind::unstructured_grid:
      return read_grid(from);
    case Kind::image:
      return read_image(from);
    case Kind::rectilinear_grid:
      return read_rectilinear(from);
    case Kind::structured_grid:
      return read_structured(from);
  }
  throw InvalidRecord{ "the class of the dataset is unknown" };
}

vtkSmartPointer<vtkDataSet> read_record(RecordReader& from)
{
  if (std::memcmp(from.bytes(magic.size()), magic.data(), magic.size()) != 0)
  {
    throw InvalidRecord{ "the record has no valid start" };
  }
  const auto kind = static_cast<Kind>(from.number<std::int64_t>());
  auto data = read_geometry(from, kind);
  read_attributes(from, data->GetNumberOfPoints(), data->GetPointData());
  read_attributes(from, data->GetNumberOfCells(), data->GetCellData());
  read_attributes(from, -1, data->GetFieldData());
  if (std::memcmp(from.bytes(magic.size()), magic.data(), magic.size()) != 0 || from.left() > 0)
  {
    throw InvalidRecord{ "the record has no valid end" };
  }
  return data;
}

/// A file in memory, for reading.
class MappedFile
{
public:
  explicit MappedFile(int file)
  {
    struct stat facts = {};
    if (::fstat(file, &facts) == 0 && facts.st_size > 0)
    {
      this->size_ = static_cast<std::size_t>(facts.st_size);
      this->data_ = ::mmap(nullptr, this->size_, PROT_READ, MAP_PRIVATE, file, 0);
    }
  }
  ~MappedFile()
  {
    if (this->data_ != MAP_FAILED)
    {
      ::munmap(this->data_, this->size_);
    }
  }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  const char* data() const
  {
    return this->data_ == MAP_FAILED ? nullptr : static_cast<const char*>(this->data_);
  }
  std::size_t size() const { return this->data_ == MAP_FAILED ? 0 : this->size_; }

private:
  void* data_ = MAP_FAILED;
  std::size_t size_ = 0;
};
} // namespace

Status write_dataset_record(int file, vtkDataSet* data)
{
  RecordWriter to(file);
  to.bytes(magic.data(), magic.size());
  if (auto* surface = vtkPolyData::SafeDownCast(data))
  {
    to.number(Kind::polydata);
    write_polydata(to, surface);
  }
  else if (auto* grid = vtkUnstructuredGrid::SafeDownCast(data))
  {
    if (has_polyhedra(grid->GetCellTypesArray()))
    {
      return Status::invalid_input("polyhedra are not supported");
    }
    to.number(Kind::unstructured_grid);
    write_grid(to, grid);
  }
  else if (auto* image = vtkImageData::SafeDownCast(data))
  {
    to.number(Kind::image);
    write_image(to, image);
  }
  else if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(data))
  {
    to.number(Kind::rectilinear_grid);
    write_rectilinear(to, rectilinear);
  }
  else if (auto* structured = vtkStructuredGrid::SafeDownCast(data))
  {
    to.number(Kind::structured_grid);
    write_structured(to, structured);
  }
  else
  {
    return Status::invalid_input(
      std::string("the file contains a ") + data->GetClassName() + ", which is not supported");
  }
  write_attributes(to, data->GetPointData());
  write_attributes(to, data->GetCellData());
  write_attributes(to, data->GetFieldData());
  to.bytes(magic.data(), magic.size());
  return to.flush()
    ? Status()
    : Status::failure(StatusCode::internal_error,
        std::string("cannot write the dataset to the memory file: ") + std::strerror(errno));
}

Status read_dataset_record(int file, vtkSmartPointer<vtkDataSet>& data)
{
  data = nullptr;
  const MappedFile record(file);
  try
  {
    RecordReader from(record.data(), record.size());
    data = read_record(from);
    return {};
  }
  catch (const InvalidRecord& invalid)
  {
    data = nullptr;
    return Status::failure(StatusCode::internal_error, invalid.what);
  }
  catch (const std::bad_alloc&)
  {
    data = nullptr;
    return Status::failure(StatusCode::internal_error, "out of memory");
  }
}

} // namespace bindpose
