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

  HandlePlace place(vtkIdType cell) const
  {
    HandlePlace place;
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    this->data_->GetCellPoints(cell, size, ids);
    place.kind = static_cast<int>(this->kinds_.value(cell, size == 2 ? 1.0 : 0.0));
    place.mode = static_cast<int>(this->modes_.value(cell, place.mode));
    place.locked = this->locks_.value(cell, 0.0) != 0.0;
    place.parent = static_cast<vtkIdType>(this->parents_.value(cell, -1.0));
    this->transforms_.read(cell, place.transform.data());
    place.stretch = this->stretches_.value(cell, 1.0);
    this->twists_.read(cell, place.twist.data());
    if (this->colors_.has(cell))
    {
      Vec3 color;
      this->colors_.read(cell, color.data());
      if (color.allFinite())
      {
        place.color = color / this->color_unit_;
      }
    }
    if (size == 0)
    {
      return place;
    }
    this->data_->GetPoint(ids[0], place.rest_head.data());
    this->data_->GetPoint(ids[size == 2 ? 1 : 0], place.rest_tail.data());
    place.head = place.rest_head;
    place.tail = place.rest_tail;
    if (!this->at_rest_)
    {
      // `stretch` is the factor on the length of a bone; its head does not move
      const Vec3 tail = place.head + place.stretch * (place.tail - place.head);
      place.head = place.transform * place.rest_head.homogeneous();
      place.tail = place.transform * tail.homogeneous();
    }
    return place;
  }

private:
  vtkPolyData* data_;
  bool at_rest_;
  double color_unit_ = 1.0;
  CellNumbers kinds_, modes_, locks_, parents_, transforms_, stretches_, twists_, colors_;
};

/// Return an array that a drag can write to: doubles, one tuple per cell.
vtkDataArray* writable(
  vtkPolyData* data, const char* name, int components, const std::vector<double>& rest)
{
  const vtkIdType count = data->GetNumberOfCells();
  vtkDataArray* array = data->GetCellData()->GetArray(name);
  if (array && array->GetNumberOfComponents() == components && array->GetNumberOfTuples() == count)
  {
    return array;
  }
  const CellNumbers before(data, name, components);
  vtkNew<vtkDoubleArray> fresh;
  fresh->SetName(name);
  fresh->SetNumberOfComponents(components);
  fresh->SetNumberOfTuples(count);
  for (vtkIdType cell = 0; cell < count; ++cell)
  {
    std::vector<double> numbers = rest;
    before.read(cell, numbers.data());
    fresh->SetTuple(cell, numbers.data());
  }
  data->GetCellData()->AddArray(fresh);
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
  const std::vector<HandlePlace> all = this->places(true);
  const bool bone = all[static_cast<std::size_t>(cell)].is_bone();
  int number = 0;
  for (vtkIdType other = 0; other <= cell; ++other)
  {
    const HandlePlace& place = all[static_cast<std::size_t>(other)];
    number += place.is_handle() && place.is_bone() == bone;
  }
  return (bone ? "b" : "p") + std::to_string(number);
}

std::vector<HandlePlace> HandleData::places(bool at_rest) const
{
  std::vector<HandlePlace> places;
  if (this->data_)
  {
    const Reader reader(this->data_, at_rest);
    places.reserve(static_cast<std::size_t>(this->count()));
    for (vtkIdType cell = 0; cell < this->count(); ++cell)
    {
      places.push_back(reader.place(cell));
    }
  }
  return places;
}

void HandleData::resolve_modes(std::vector<HandlePlace>& places, bool finds_rotations)
{
  Handles handles(places.size());
  Pose pose(places.size());
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    const HandlePlace& place = places[k];
    handles[k].kind = place.is_handle() ? static_cast<HandleKind>(place.kind) : HandleKind::point;
    handles[k].head = place.rest_head;
    handles[k].tail = place.rest_tail;
    const bool has_parent =
      place.parent >= 0 && place.parent < static_cast<vtkIdType>(places.size());
    handles[k].parent = has_parent ? static_cast<Index>(place.parent) : -1;
    pose[k].mode = static_cast<HandleMode>(place.mode);
    pose[k].transform = place.transform;
    pose[k].stretch = place.stretch;
    pose[k].twist = place.twist;
  }
  const Pose resolved = finds_rotations ? with_found_rotations(handles, pose) : pose;
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    const HandleMode mode = resolved[k].mode;
    places[k].mode = static_cast<int>(constrains_transform(mode) ? HandleMode::full : mode);
  }
}

HandlePlace HandleData::place(vtkIdType cell, bool at_rest) const
{
  return this->exists(cell) ? Reader(this->data_, at_rest).place(cell) : HandlePlace();
}

std::vector<HandleData::Bar> HandleData::bars(const std::vector<HandlePlace>& places) const
{
  std::map<vtkIdType, Vec3> at;
  std::vector<Bar> bars;
  vtkIdType size = 0;
  const vtkIdType* ids = nullptr;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    this->data_->GetCellPoints(static_cast<vtkIdType>(i), size, ids);
    if (size == 1 && places[i].is_handle())
    {
      at[ids[0]] = places[i].head;
    }
  }
  const auto end_of = [&](vtkIdType point)
  {
    const auto found = at.find(point);
    Vec3 rest;
    this->data_->GetPoint(point, rest.data());
    return found == at.end() ? rest : found->second;
  };
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const auto cell = static_cast<vtkIdType>(i);
    this->data_->GetCellPoints(cell, size, ids);
    for (vtkIdType k = 0; !places[i].is_handle() && k + 1 < size + (size > 2); ++k)
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
  vtkDataArray* arrays[3] = { writable(this->data_, "Transform", 12,
                                std::vector<double>(rest.data(), rest.data() + 12)),
    stretches ? writable(this->data_, "Stretch", 1, { 1.0 }) : nullptr,
    twists ? writable(this->data_, "Twist", 2, { 0.0, 0.0 }) : nullptr };
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
