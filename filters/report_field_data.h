#ifndef report_field_data_h
#define report_field_data_h

#include "BindposeFiltersModule.h" // for export macro
#include "base/status.h"

class vtkDataObject;

namespace bindpose
{

class ExecutionContext;

/// Replaces all `Report.*` field data arrays of the data by the report's entries: integers as
/// vtkIdTypeArray, numbers as vtkDoubleArray, texts as vtkStringArray, one tuple a value.
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
