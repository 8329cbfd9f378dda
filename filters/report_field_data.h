#ifndef report_field_data_h
#define report_field_data_h

#include "BindposeFiltersModule.h" // for export macro
#include "base/status.h"

#include <string>

class vtkDataObject;

namespace bindpose
{

class ExecutionContext;

/// Whether an entry of a report measures the run instead of its result: seconds, microseconds,
/// bytes of memory. All other entries are the same for every run with the same input.
BINDPOSEFILTERS_EXPORT bool measures_run(const std::string& key);

/// Replaces all `Report.*` field data arrays of the data by the report's entries: integers as
/// vtkIdTypeArray, numbers as vtkDoubleArray, texts as vtkStringArray, one tuple per value. Entries
/// that measure the run are left out, so that equal results are equal files.
BINDPOSEFILTERS_EXPORT void attach_report(vtkDataObject* data, const Report& report);

/// The report that a data object carries; empty when it carries none.
BINDPOSEFILTERS_EXPORT Report read_report(vtkDataObject* data);

/// A failure that repeats the one the data reports; ok when the data is null or reports a result.
BINDPOSEFILTERS_EXPORT Status upstream_failure(vtkDataObject* data);

/// Puts what every report starts and ends with into the status's report: status, message,
/// warnings in front, then its own entries, then seconds per phase, their total and the peak
/// memory.
BINDPOSEFILTERS_EXPORT void complete_report(Status& status, const ExecutionContext& context);

} // namespace bindpose

#endif
