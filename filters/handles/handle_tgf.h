#ifndef handle_tgf_h
#define handle_tgf_h

#include "BindposeFiltersModule.h" // for export macro
#include "handles/handles.h"
#include "io/tgf.h"

#include <string>

class vtkPolyData;

namespace bindpose
{

// Conversion between handles and graphs in the Trivial Graph Format (.tgf).

/// Convert points, bones, cage vertices and cage edges to a graph. Ends of bones at the same
/// position become one node, because a .tgf file encodes parents by shared nodes. Names of bones
/// and the pose are not stored. A warning names the handles whose parents a .tgf file cannot store.
/// Return invalid_input, with the handle's name, for a region or a face of a cage.
BINDPOSEFILTERS_EXPORT Status to_tgf(const Handles& handles, Tgf& graph);

/// Convert a handle dataset, including its pseudo-edges, to a text in the format .tgf. The
/// restrictions of to_tgf(const Handles&, Tgf&) apply. If the dataset is null or has no cells, the
/// text is empty.
BINDPOSEFILTERS_EXPORT Status to_tgf(vtkPolyData* handles, std::string& text);

/// Convert a graph to a handle dataset, as documented in vtkHandleFileReader. A warning counts the
/// edges that are ignored. Return invalid_input for invalid handles (check_handles).
BINDPOSEFILTERS_EXPORT Status from_tgf(const Tgf& graph, vtkPolyData* handles);

/// Convert a text in the format .tgf to a handle dataset. Messages about the text name the line. If
/// the text contains only white space, the dataset is empty.
BINDPOSEFILTERS_EXPORT Status from_tgf(const std::string& text, vtkPolyData* handles);

} // namespace bindpose

#endif
