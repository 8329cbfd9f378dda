#ifndef bindpose_helper_mesher_process_h
#define bindpose_helper_mesher_process_h

#include "base/execution.h"
#include "helper/mesher_format.h"

#include <string>
#include <vector>

namespace bindpose
{

/// One job for the helper executable bindpose-mesher.
struct MesherRequest
{
  /// The job and its options, as on a command line: {"refine"}, {"tetgen", "--switches", "pY"}.
  std::vector<std::string> arguments;
  double time_limit = 120.0; ///< seconds after which the helper is killed
  Index memory_limit = 0; ///< MiB of address space that the helper may use, 0: no limit
  double processor_limit = 0.0; ///< seconds of processor time with the same effect, 0: no limit
};

/// What a job gave.
struct MesherAnswer
{
  MesherData data;
  Report report; ///< what the helper counted, by the helper's own keys
  double seconds = 0.0;
  bool at_limit = false; ///< it was stopped at one of its limits of time
};

/// Path of bindpose-mesher, empty when there is none. Looked for in the environment variable
/// BINDPOSE_MESHER (which alone counts when it is set), then beside the running executable, beside
/// the library, in the bin folder beside the library's, and in the build tree.
std::string find_mesher();

/// Runs one job in a process of its own and waits for it. CGAL and TetGen may crash, hang or eat
/// all memory on bad input; here that becomes a status:
/// - unavailable: there is no helper; the message names the packages it is built with;
/// - cancelled: the context was cancelled (the helper is killed within 20 ms);
/// - internal_error: the helper crashed, ended with an error, ran out of time or memory, or wrote
///   something that is no mesh; the message says which.
///
/// Input and output are anonymous memory files: nothing is left behind, whatever happens to either
/// process. Progress lines of the helper become progress of the current phase.
Status run_mesher(const MesherRequest& request, const MesherData& input, MesherAnswer& answer,
  ExecutionContext& context);

} // namespace bindpose

#endif
