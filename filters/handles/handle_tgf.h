#ifndef handle_tgf_h
#define handle_tgf_h

#include "BindposeFiltersModule.h" // for export macro
#include "handles/handles.h"
#include "io/tgf.h"

namespace bindpose
{

/// Convert points, bones and cage vertices with their edges to a graph for write_tgf() (Trivial
/// Graph Format). Ends of bones at the same position become one node, because a .tgf file encodes
/// parents by shared nodes. Names of bones and the pose are not stored. A warning names the handles
/// whose parents a .tgf file cannot store. Return invalid_input, with the handle's name, for a
/// region or a face of a cage.
BINDPOSEFILTERS_EXPORT Status to_tgf(const Handles& handles, Tgf& graph);

} // namespace bindpose

#endif
