#ifndef xml_names_h
#define xml_names_h

#include "BindposeFiltersModule.h" // for export macro
#include "base/status.h"

#include "vtkSmartPointer.h"

class vtkDataSet;

namespace bindpose
{

/// Prepare a dataset for VTK's XML writers, which write the names of arrays and components without
/// escaping them. The result is the dataset itself, or a shallow copy in which the characters & < >
/// " of these names are escaped. XML readers restore the names.
/// @return invalid_input, naming the array, if a name contains bytes that are not UTF-8 or a
/// control character, which XML cannot store
BINDPOSEFILTERS_EXPORT Status escape_names(vtkDataSet* data, vtkSmartPointer<vtkDataSet>& escaped);

} // namespace bindpose

#endif
