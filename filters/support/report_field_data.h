#ifndef report_field_data_h
#define report_field_data_h

#include "BindposeFiltersModule.h" // for export macro
#include "base/status.h"

#include <string>

class vtkDataObject;

namespace bindpose
{

// Conversion between the report of a kernel (measurements by key) and the field data arrays
// `Report.KEY` of a dataset.

class ExecutionContext;

/// Report whether an entry of a report is a property of one run and not of the result: seconds,
/// microseconds, or bytes of memory. All other entries are the same for every run with the same
/// input.
BINDPOSEFILTERS_EXPORT bool is_run_measurement(const std::string& key);

/// Replace all `Report.*` field data arrays of the data by the report's entries: integers as
/// vtkIdTypeArray, floating-point values as vtkDoubleArray, texts as vtkStringArray, one tuple per
/// value. Entries that measure the run are left out, so that equal results give equal files.
BINDPOSEFILTERS_EXPORT void attach_report(vtkDataObject* data, const Report& report);

/// Return the report of a data object; empty if it has none.
BINDPOSEFILTERS_EXPORT Report read_report(vtkDataObject* data);

/// If the report of a data object contains a failure, return a status with this failure. For a
/// composite, the first failure of its blocks is returned. Return ok if the data is null or there
/// is no failure.
BINDPOSEFILTERS_EXPORT Status upstream_failure(vtkDataObject* data);

/// Insert the code, the message and the warnings of a status at the beginning of its report.
BINDPOSEFILTERS_EXPORT void add_outcome(Status& status);

/// Complete the status's report with the entries that all reports have. The entries of
/// add_outcome() are inserted at the beginning. The seconds per phase, the total seconds and the
/// peak memory are appended.
BINDPOSEFILTERS_EXPORT void complete_report(const ExecutionContext& context, Status& status);

} // namespace bindpose

#endif
