#include "report_field_data.h"

#include "base/execution.h"
#include "base/memory.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"

namespace bindpose
{

namespace
{
const std::string prefix = "Report.";

vtkSmartPointer<vtkAbstractArray> make_array(const Report::Value& value)
{
  return std::visit(
    [](const auto& v) -> vtkSmartPointer<vtkAbstractArray>
    {
      using T = std::decay_t<decltype(v)>;
      const auto fill = [](auto array, const auto& values)
      {
        for (const auto& x : values)
        {
          array->InsertNextValue(x);
        }
        return array;
      };
      if constexpr (std::is_same_v<T, std::int64_t>)
      {
        return fill(vtkSmartPointer<vtkIdTypeArray>::New(), std::vector<std::int64_t>{ v });
      }
      else if constexpr (std::is_same_v<T, double>)
      {
        return fill(vtkSmartPointer<vtkDoubleArray>::New(), std::vector<double>{ v });
      }
      else if constexpr (std::is_same_v<T, std::string>)
      {
        return fill(vtkSmartPointer<vtkStringArray>::New(), std::vector<std::string>{ v });
      }
      else if constexpr (std::is_same_v<T, std::vector<std::int64_t>>)
      {
        return fill(vtkSmartPointer<vtkIdTypeArray>::New(), v);
      }
      else if constexpr (std::is_same_v<T, std::vector<double>>)
      {
        return fill(vtkSmartPointer<vtkDoubleArray>::New(), v);
      }
      else
      {
        return fill(vtkSmartPointer<vtkStringArray>::New(), v);
      }
    },
    value);
}

/// Report whether the values of a key are lists, i.e. whether the key contains "[]". An array with
/// one value is then read as a list of length 1 instead of as a single value.
bool is_list(const std::string& key)
{
  return key.find("[]") != std::string::npos;
}

template <typename Value, typename Array>
Report::Value values_of(const std::string& key, Array* array)
{
  std::vector<Value> values;
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
  {
    values.push_back(array->GetValue(i));
  }
  if (values.size() == 1 && !is_list(key))
  {
    return values.front();
  }
  return values;
}
} // namespace

bool is_run_measurement(const std::string& key)
{
  const std::string name = key.substr(key.rfind('.') + 1);
  const auto ends_in = [&name](const std::string& end)
  {
    return name.size() >= end.size() &&
      name.compare(name.size() - end.size(), end.size(), end) == 0;
  };
  return key.compare(0, 8, "seconds.") == 0 || ends_in("seconds") ||
    name == "microseconds_per_iteration" || name == "peak_memory_bytes" ||
    name == "memory_estimate_bytes";
}

void attach_report(vtkDataObject* data, const Report& report)
{
  vtkFieldData* field = data->GetFieldData();
  if (!field)
  {
    vtkNew<vtkFieldData> fresh;
    data->SetFieldData(fresh);
    field = data->GetFieldData();
  }
  for (int i = field->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    const char* name = field->GetAbstractArray(i)->GetName();
    if (name && std::string(name).compare(0, prefix.size(), prefix) == 0)
    {
      field->RemoveArray(i);
    }
  }
  for (const auto& [key, value] : report.entries())
  {
    if (!is_run_measurement(key))
    {
      vtkSmartPointer<vtkAbstractArray> array = make_array(value);
      array->SetName((prefix + key).c_str());
      field->AddArray(array);
    }
  }
}

Report read_report(vtkDataObject* data)
{
  Report report;
  vtkFieldData* field = data ? data->GetFieldData() : nullptr;
  for (int i = 0; field && i < field->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = field->GetAbstractArray(i);
    const std::string name = array->GetName() ? array->GetName() : "";
    if (name.compare(0, prefix.size(), prefix) != 0)
    {
      continue;
    }
    const std::string key = name.substr(prefix.size());
    if (auto* texts = vtkStringArray::SafeDownCast(array))
    {
      report.set(key, values_of<std::string>(key, texts));
    }
    else if (auto* reals = vtkDoubleArray::SafeDownCast(array))
    {
      report.set(key, values_of<double>(key, reals));
    }
    else if (auto* numbers = vtkDataArray::SafeDownCast(array))
    {
      vtkNew<vtkIdTypeArray> integers; // files may store the array with another integer type
      integers->DeepCopy(numbers);
      report.set(key, values_of<std::int64_t>(key, integers.Get()));
    }
  }
  return report;
}

Status upstream_failure(vtkDataObject* data)
{
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    Status status;
    vtkSmartPointer<vtkCompositeDataIterator> block;
    block.TakeReference(composite->NewIterator());
    for (block->InitTraversal(); status.ok() && !block->IsDoneWithTraversal();
         block->GoToNextItem())
    {
      status = upstream_failure(block->GetCurrentDataObject());
    }
    if (!status.ok())
    {
      return status;
    }
  }
  const Report report = read_report(data);
  const std::string word = report.text("status", "ok");
  Status status;
  for (const StatusCode code : { StatusCode::invalid_input, StatusCode::canceled,
         StatusCode::unavailable, StatusCode::internal_error })
  {
    if (word == to_string(code))
    {
      status = Status::failure(code, report.text("message"));
    }
  }
  return status;
}

void add_outcome(Status& status)
{
  Report report;
  report.set("status", to_string(status.code));
  report.set("message", status.message);
  if (!status.warnings.empty())
  {
    report.set("warnings[]", status.warnings);
  }
  report.merge(status.report);
  status.report = std::move(report);
}

void complete_report(const ExecutionContext& context, Status& status)
{
  add_outcome(status);
  status.report.merge(context.seconds());
  status.report.set("seconds.total", context.elapsed_seconds());
  status.report.set("peak_memory_bytes", static_cast<std::int64_t>(peak_memory()));
}

} // namespace bindpose
