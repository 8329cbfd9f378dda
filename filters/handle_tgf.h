#ifndef handle_tgf_h
#define handle_tgf_h

#include "BindposeFiltersModule.h" // for export macro
#include "io/tgf.h"
#include "weights/handles.h"

namespace bindpose
{

/// Points, bones and cage vertices with their edges as a graph for write_tgf(). Ends of bones at
/// the same place are one node: that is how a .tgf file tells parents. Names of bones are not kept,
/// nor the pose; a warning names the handles whose parents such a file cannot store.
/// invalid_input, naming it, for what such a file cannot hold: a region, a face of a cage.
BINDPOSEFILTERS_EXPORT Status to_tgf(const Handles& handles, Tgf& graph);

} // namespace bindpose

#endif
