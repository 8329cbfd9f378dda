// Reads and writes handle datasets for the widgets. Arrays are looked up once per call instead of
// once per cell, because hundreds of handles are read at every move of the mouse. Nothing is cached
// between calls, so that changes of an array without Modified() take effect.
#include "handle_data.h"

#include "pose/found_rotations.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <map>

namespace bindpose
{
namespace
{
/// Reads a cell array that may be missing, too short or of another shape.
class CellNumbers
{
public:
  CellNumbers(vtkPolyData* data, const char* name, int components)
    : array_(data->GetCellData()->GetArray(name))
  {
    if (this->array_ && this->array_->GetNumberOfComponents() != components)
    {
      this->array_ = nullptr;
    }
  }
  bool has(vtkIdType cell) const
  {
    return this->array_ && cell < this->array_->GetNumberOfTuples();
  }
  void read(vtkIdType cell, double* numbers) const
  {
    if (this->has(cell))
    {
      this->array_->GetTuple(cell, numbers);
    }
  }
  double value(vtkIdType cell, double fallback) const
  {
    return this->has(cell) ? this->array_->GetComponent(cell, 0) : fallback;
  }

private:
  vtkDataArray* array_;
};

class Reader
{
public:
  Reader(vtkPolyData* data, bool at_rest)
    : data_(data), at_rest_(at_rest), kinds_(data, "HandleKind", 1), modes_(data, "Mode", 1),
      locks_(data, "Locked", 1), parents_(data, "Parent", 1), transforms_(data, "Transform", 12),
      stretches_(data, "Stretch", 1), twists_(data, "Twist", 2), colors_(data, "Color", 3)
  {
    vtkDataArray* colors = data->GetCellData()->GetArray("Color");
    this->color_unit_ = colors && colors->GetDataType() == VTK_UNSIGNED_CHAR ? 255.0 : 1.0;
    if (data->NeedToBuildCells())
    {
      data->BuildCells();
    }
  }

  HandleRecord record(vtkIdType cell) const
  {
    HandleRecord record;
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    this->data_->GetCellPoints(cell, size, ids);
    record.kind = static_cast<int>(this->kinds_.value(cell, size == 2 ? 1.0 : 0.0));
    record.mode = static_cast<int>(this->modes_.value(cell, record.mode));
    record.locked = this->locks_.value(cell, 0.0) != 0.0;
    record.parent = static_cast<vtkIdType>(this->parents_.value(cell, -1.0));
    this->transforms_.read(cell, record.transform.data());
    record.stretch = this->stretches_.value(cell, 1.0);
    this->twists_.read(cell, record.twist.data());
    if (this->colors_.has(cell))
    {
      Vec3 color;
      this->colors_.read(cell, color.data());
      if (color.allFinite())
      {
        record.color = color / this->color_unit_;
      }
    }
    if (size == 0)
    {
      return record;
    }
    this->data_->GetPoint(ids[0], record.rest_head.data());
    this->data_->GetPoint(ids[size == 2 ? 1 : 0], record.rest_tail.data());
    record.head = record.rest_head;
    record.tail = record.rest_tail;
    if (!this->at_rest_)
    {
      // `stretch` is the factor on the length of a bone; its head does not move
      const Vec3 tail = record.head + record.stretch * (record.tail - record.head);
      record.head = record.transform * record.rest_head.homogeneous();
      record.tail = record.transform * tail.homogeneous();
    }
    return record;
  }

private:
  vtkPolyData* data_;
  bool at_rest_;
  double color_unit_ = 1.0;
  CellNumbers kinds_, modes_, locks_, parents_, transforms_, stretches_, twists_, colors_;
};

/// Return an array that a drag can write to: doubles, one tuple per cell.
vtkDataArray* writable_array(
  vtkPolyData* data, const char* name, int components, const std::vector<double>& rest)
{
  const vtkIdType count = data->GetNumberOfCells();
  vtkDataArray* array = data->GetCellData()->GetArray(name);
  if (array && array->GetNumberOfComponents() == components && array->GetNumberOfTuples() == count)
  {
    return array;
  }
  const CellNumbers before(data, name, components);
  vtkNew<vtkDoubleArray> new_array;
  new_array->SetName(name);
  new_array->SetNumberOfComponents(components);
  new_array->SetNumberOfTuples(count);
  for (vtkIdType cell = 0; cell < count; ++cell)
  {
    std::vector<double> numbers = rest;
    before.read(cell, numbers.data());
    new_array->SetTuple(cell, numbers.data());
  }
  data->GetCellData()->AddArray(new_array);
  return data->GetCellData()->GetArray(name);
}
} // namespace

void HandleData::set(vtkPolyData* data)
{
  this->data_ = data;
}

vtkPolyData* HandleData::get() const
{
  return this->data_;
}

bool HandleData::exists(vtkIdType cell) const
{
  return cell >= 0 && cell < this->count();
}

vtkIdType HandleData::count() const
{
  return this->data_ ? this->data_->GetNumberOfCells() : 0;
}

std::string HandleData::name(vtkIdType cell) const
{
  if (!this->exists(cell))
  {
    return std::string();
  }
  auto* names =
    vtkStringArray::SafeDownCast(this->data_->GetCellData()->GetAbstractArray("HandleName"));
  if (names && cell < names->GetNumberOfValues() && !names->GetValue(cell).empty())
  {
    return names->GetValue(cell);
  }
  // Use the same default names as the filters: points are counted separately from bones.
  const std::vector<HandleRecord> all = this->records(true);
  const bool bone = all[static_cast<std::size_t>(cell)].is_bone();
  int number = 0;
  for (vtkIdType other = 0; other <= cell; ++other)
  {
    const HandleRecord& record = all[static_cast<std::size_t>(other)];
    number += record.is_handle() && record.is_bone() == bone;
  }
  return (bone ? "b" : "p") + std::to_string(number);
}

std::vector<HandleRecord> HandleData::records(bool at_rest) const
{
  std::vector<HandleRecord> records;
  if (this->data_)
  {
    const Reader reader(this->data_, at_rest);
    records.reserve(static_cast<std::size_t>(this->count()));
    for (vtkIdType cell = 0; cell < this->count(); ++cell)
    {
      records.push_back(reader.record(cell));
    }
  }
  return records;
}

void HandleData::resolve_modes(std::vector<HandleRecord>& records, bool finds_rotations)
{
  Handles handles(records.size());
  Pose pose(records.size());
  for (std::size_t k = 0; k < records.size(); ++k)
  {
    const HandleRecord& record = records[k];
    handles[k].kind = record.is_handle() ? static_cast<HandleKind>(record.kind) : HandleKind::point;
    handles[k].head = record.rest_head;
    handles[k].tail = record.rest_tail;
    const bool has_parent =
      record.parent >= 0 && record.parent < static_cast<vtkIdType>(records.size());
    handles[k].parent = has_parent ? static_cast<Index>(record.parent) : -1;
    pose[k].mode = static_cast<HandleMode>(record.mode);
    pose[k].transform = record.transform;
    pose[k].stretch = record.stretch;
    pose[k].twist = record.twist;
  }
  const Pose resolved = finds_rotations ? resolve_automatic_modes(handles, pose) : pose;
  for (std::size_t k = 0; k < records.size(); ++k)
  {
    const HandleMode mode = resolved[k].mode;
    records[k].mode = static_cast<int>(constrains_transform(mode) ? HandleMode::full : mode);
  }
}

HandleRecord HandleData::record(vtkIdType cell, bool at_rest) const
{
  return this->exists(cell) ? Reader(this->data_, at_rest).record(cell) : HandleRecord();
}

std::vector<HandleData::Bar> HandleData::bars(const std::vector<HandleRecord>& records) const
{
  std::map<vtkIdType, Vec3> position_of_point;
  std::vector<Bar> bars;
  vtkIdType size = 0;
  const vtkIdType* ids = nullptr;
  for (std::size_t i = 0; i < records.size(); ++i)
  {
    this->data_->GetCellPoints(static_cast<vtkIdType>(i), size, ids);
    if (size == 1 && records[i].is_handle())
    {
      position_of_point[ids[0]] = records[i].head;
    }
  }
  const auto end_of = [&](vtkIdType point)
  {
    const auto found = position_of_point.find(point);
    Vec3 rest;
    this->data_->GetPoint(point, rest.data());
    return found == position_of_point.end() ? rest : found->second;
  };
  for (std::size_t i = 0; i < records.size(); ++i)
  {
    const auto cell = static_cast<vtkIdType>(i);
    this->data_->GetCellPoints(cell, size, ids);
    for (vtkIdType k = 0; !records[i].is_handle() && k + 1 < size + (size > 2); ++k)
    {
      bars.push_back({ cell, end_of(ids[k]), end_of(ids[(k + 1) % size]) });
    }
  }
  return bars;
}

void HandleData::set_poses(const std::vector<vtkIdType>& cells, const std::vector<CellPose>& poses)
{
  vtkCellData* data = this->data_->GetCellData();
  bool stretches = data->GetArray("Stretch") != nullptr;
  bool twists = data->GetArray("Twist") != nullptr;
  for (const CellPose& pose : poses)
  {
    stretches = stretches || pose.stretch != 1.0;
    twists = twists || pose.twist != Eigen::Vector2d::Zero();
  }
  const Affine rest = identity_affine();
  vtkDataArray* arrays[3] = { writable_array(this->data_, "Transform", 12,
                                std::vector<double>(rest.data(), rest.data() + 12)),
    stretches ? writable_array(this->data_, "Stretch", 1, { 1.0 }) : nullptr,
    twists ? writable_array(this->data_, "Twist", 2, { 0.0, 0.0 }) : nullptr };
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    arrays[0]->SetTuple(cells[i], poses[i].transform.data());
    if (arrays[1])
    {
      arrays[1]->SetTuple(cells[i], &poses[i].stretch);
    }
    if (arrays[2])
    {
      arrays[2]->SetTuple(cells[i], poses[i].twist.data());
    }
  }
  for (vtkDataArray* array : arrays)
  {
    if (array)
    {
      array->Modified();
    }
  }
  this->data_->Modified();
}

} // namespace bindpose
