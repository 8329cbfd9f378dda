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
bool same_place(const Handle& a, const Handle& b)
{
  return a.kind == b.kind && a.head == b.head && a.tail == b.tail && a.region_id == b.region_id &&
    a.cage == b.cage;
}

QString counted(int count, const char* one, const char* many)
{
  return count == 0 ? QString()
                    : QCoreApplication::translate("Document", count == 1 ? one : many).arg(count);
}

vtkSmartPointer<vtkDoubleArray> arranged_array(
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

BoundColumns::BoundColumns(const Handles& bound, const Handles& now)
  : column_of_(now.size(), -1), columns_(static_cast<int>(bound.size()))
{
  std::vector<bool> taken(bound.size(), false);
  const auto assign = [&](const auto& fits)
  {
    for (std::size_t k = 0; k < now.size(); ++k)
    {
      for (std::size_t c = 0; c < bound.size() && this->column_of_[k] < 0; ++c)
      {
        if (!taken[c] && fits(bound[c], now[k]))
        {
          taken[c] = true;
          this->column_of_[k] = static_cast<int>(c);
        }
      }
    }
  };
  assign([](const Handle& a, const Handle& b) { return a.name == b.name && a.kind == b.kind; });
  assign(same_place);
  bool in_order = now.size() == bound.size();
  for (std::size_t k = 0; k < now.size(); ++k)
  {
    const int column = this->column_of_[k];
    this->names_.push_back(now[k].name);
    this->new_ += column < 0;
    this->moved_ += column >= 0 && !same_place(bound[column], now[k]);
    this->same_names_ = this->same_names_ && column >= 0 && bound[column].name == now[k].name;
    in_order = in_order && column == static_cast<int>(k);
  }
  this->gone_ = static_cast<int>(std::count(taken.begin(), taken.end(), false));
  this->exact_ = in_order && this->new_ + this->moved_ + this->gone_ == 0;
}

bool BoundColumns::any() const
{
  return this->new_ < static_cast<int>(this->column_of_.size());
}

QString BoundColumns::reason() const
{
  if (this->new_ + this->moved_ + this->gone_ == 0)
  {
    return {};
  }
  QStringList parts{
    counted(this->new_, QT_TRANSLATE_NOOP("Document", "%1 handle was added and has no weights yet"),
      QT_TRANSLATE_NOOP("Document", "%1 handles were added and have no weights yet")),
    counted(this->moved_, QT_TRANSLATE_NOOP("Document", "%1 handle was moved"),
      QT_TRANSLATE_NOOP("Document", "%1 handles were moved")),
    counted(this->gone_,
      QT_TRANSLATE_NOOP("Document", "%1 handle was removed and its part of the mesh stays at rest"),
      QT_TRANSLATE_NOOP(
        "Document", "%1 handles were removed and their parts of the mesh stay at rest"))
  };
  parts.removeAll(QString());
  return QCoreApplication::translate("Document", "Since the last bind, %1.").arg(parts.join(", "));
}

vtkSmartPointer<vtkPointSet> BoundColumns::arranged(vtkPointSet* data) const
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
    if (array && array->GetNumberOfComponents() == this->columns_)
    {
      result->GetPointData()->AddArray(arranged_array(array, this->column_of_, this->names_));
    }
  }
  if (!this->exact_)
  {
    vtkNew<vtkFieldData> fields; // the shallow copy shares its field data with the original
    fields->ShallowCopy(data->GetFieldData());
    for (const char* name : { "WeightsRelativeGap", "WeightsKKTResidual", "WeightsIterations" })
    {
      fields->RemoveArray(name);
    }
    result->SetFieldData(fields);
  }
  return result;
}

bool weights_are_of(vtkDataArray* weights, const Handles& handles, QString* why_not)
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
  if (why_not)
  {
    *why_not = reason;
  }
  return reason.isEmpty();
}
