// Matches the current handles with the handles of a bind. Handles are matched by name first. If an
// unmatched current handle and an unmatched bound handle are at the same position, they are treated
// as one handle that was renamed.
#include "document/bound_columns.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <QCoreApplication>
#include <QStringList>

#include <algorithm>

using namespace bindpose;

namespace
{
bool same_rest_position(const Handle& a, const Handle& b)
{
  return a.kind == b.kind && a.head == b.head && a.tail == b.tail && a.region_id == b.region_id &&
    a.cage == b.cage;
}

QString count_phrase(int count, const char* singular, const char* plural)
{
  return count == 0
    ? QString()
    : QCoreApplication::translate("Document", count == 1 ? singular : plural).arg(count);
}

vtkSmartPointer<vtkDoubleArray> reordered_array(
  vtkDataArray* array, const std::vector<int>& columns, const std::vector<std::string>& names)
{
  auto result = vtkSmartPointer<vtkDoubleArray>::New();
  result->SetName(array->GetName());
  result->SetNumberOfComponents(static_cast<int>(columns.size()));
  result->SetNumberOfTuples(array->GetNumberOfTuples());
  for (std::size_t k = 0; k < columns.size(); ++k)
  {
    result->SetComponentName(static_cast<vtkIdType>(k), names[k].c_str());
    for (vtkIdType v = 0; v < array->GetNumberOfTuples(); ++v)
    {
      result->SetComponent(
        v, static_cast<int>(k), columns[k] < 0 ? 0.0 : array->GetComponent(v, columns[k]));
    }
  }
  return result;
}
} // namespace

BoundColumns::BoundColumns(const Handles& bound, const Handles& current)
  : column_of_handle_(current.size(), -1), column_count_(static_cast<int>(bound.size()))
{
  std::vector<bool> is_assigned(bound.size(), false);
  const auto assign = [&](const auto& fits)
  {
    for (std::size_t k = 0; k < current.size(); ++k)
    {
      for (std::size_t c = 0; c < bound.size() && this->column_of_handle_[k] < 0; ++c)
      {
        if (!is_assigned[c] && fits(bound[c], current[k]))
        {
          is_assigned[c] = true;
          this->column_of_handle_[k] = static_cast<int>(c);
        }
      }
    }
  };
  assign([](const Handle& a, const Handle& b) { return a.name == b.name && a.kind == b.kind; });
  assign(same_rest_position);
  bool in_order = current.size() == bound.size();
  for (std::size_t k = 0; k < current.size(); ++k)
  {
    const int column = this->column_of_handle_[k];
    this->names_.push_back(current[k].name);
    this->added_count_ += column < 0;
    this->moved_count_ += column >= 0 && !same_rest_position(bound[column], current[k]);
    this->same_names_ = this->same_names_ && column >= 0 && bound[column].name == current[k].name;
    in_order = in_order && column == static_cast<int>(k);
  }
  this->removed_count_ =
    static_cast<int>(std::count(is_assigned.begin(), is_assigned.end(), false));
  this->exact_ = in_order && this->added_count_ + this->moved_count_ + this->removed_count_ == 0;
}

bool BoundColumns::any() const
{
  return this->added_count_ < static_cast<int>(this->column_of_handle_.size());
}

QString BoundColumns::reason() const
{
  if (this->added_count_ + this->moved_count_ + this->removed_count_ == 0)
  {
    return {};
  }
  QStringList parts{ count_phrase(this->added_count_,
                       QT_TRANSLATE_NOOP("Document", "%1 handle was added and has no weights yet"),
                       QT_TRANSLATE_NOOP(
                         "Document", "%1 handles were added and have no weights yet")),
    count_phrase(this->moved_count_, QT_TRANSLATE_NOOP("Document", "%1 handle was moved"),
      QT_TRANSLATE_NOOP("Document", "%1 handles were moved")),
    count_phrase(this->removed_count_,
      QT_TRANSLATE_NOOP("Document", "%1 handle was removed and its part of the mesh stays at rest"),
      QT_TRANSLATE_NOOP(
        "Document", "%1 handles were removed and their parts of the mesh stay at rest")) };
  parts.removeAll(QString());
  return QCoreApplication::translate("Document", "Since the last bind, %1.").arg(parts.join(", "));
}

vtkSmartPointer<vtkPointSet> BoundColumns::reordered(vtkPointSet* data) const
{
  if (!data || (this->exact_ && this->same_names_))
  {
    return data;
  }
  vtkSmartPointer<vtkPointSet> result = vtk::TakeSmartPointer(data->NewInstance());
  result->ShallowCopy(data);
  for (const char* name : { "Weights", "RawWeights" })
  {
    vtkDataArray* array = data->GetPointData()->GetArray(name);
    if (array && array->GetNumberOfComponents() == this->column_count_)
    {
      result->GetPointData()->AddArray(
        reordered_array(array, this->column_of_handle_, this->names_));
    }
  }
  if (!this->exact_)
  {
    // a shallow copy shares the field data of the original, so give the copy its own field data
    vtkNew<vtkFieldData> fields;
    fields->ShallowCopy(data->GetFieldData());
    for (const char* name : { "WeightsRelativeGap", "WeightsKKTResidual", "WeightsIterations" })
    {
      fields->RemoveArray(name);
    }
    result->SetFieldData(fields);
  }
  return result;
}

bool weights_fit(vtkDataArray* weights, const Handles& handles, QString* mismatch)
{
  const int columns = weights->GetNumberOfComponents();
  QString reason;
  if (columns != static_cast<int>(handles.size()))
  {
    reason = QCoreApplication::translate(
      "Document", "The mesh has weights for %1 handles, but %2 handles are open: bind again.")
               .arg(columns)
               .arg(handles.size());
  }
  for (int c = 0; c < columns && reason.isEmpty(); ++c)
  {
    const char* name = weights->GetComponentName(c);
    if (name && handles[c].name != name)
    {
      reason = QCoreApplication::translate(
        "Document", "The mesh has weights for handles with other names: bind again.");
    }
  }
  if (mismatch)
  {
    *mismatch = reason;
  }
  return reason.isEmpty();
}
