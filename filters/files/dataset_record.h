#ifndef dataset_record_h
#define dataset_record_h

// The binary format in which bindpose-reader returns a dataset to its parent process.

#include "BindposeFiltersModule.h" // for export macro
#include "base/status.h"

#include "vtkSmartPointer.h"

class vtkDataSet;

namespace bindpose
{

/// Write a polydata, unstructured grid, image, rectilinear grid or structured grid to a file
/// descriptor: geometry, cells, and all numeric and string arrays. Polyhedra are refused.
/// @return invalid_input if the dataset cannot be written, internal_error if writing fails (for
/// example because memory ran out)
BINDPOSEFILTERS_EXPORT Status write_dataset_record(int file, vtkDataSet* data);

/// Read a record up to the end of the file. The record is validated, because the process that wrote
/// it has read an untrusted file: all sizes must match, offsets must ascend, and all point ids of
/// cells must be in range.
/// @return internal_error unless the record is valid
BINDPOSEFILTERS_EXPORT Status read_dataset_record(int file, vtkSmartPointer<vtkDataSet>& data);

} // namespace bindpose

#endif
