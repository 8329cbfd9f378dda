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
  /// The name of the job and its options, as on a command line: {"refine"}, {"tetgen",
  /// "--switches", "pY"}.
  std::vector<std::string> arguments;
  double time_limit = 120.0; ///< the helper is killed after this many seconds
  Index memory_limit = 0; ///< largest address space of the helper in MiB, 0: no limit
  /// The helper is killed after using this many seconds of processor time, 0: no limit.
  double processor_limit = 0.0;
};

/// The result of a job.
struct MesherResult
{
  MesherData data;
  Report report; ///< values that the helper reported, with the helper's keys
  double seconds = 0.0;
  bool timed_out = false; ///< whether the helper was stopped at one of its time limits
};

/// Return the path of bindpose-mesher, or an empty string if it is not found (see find_helper()).
std::string find_mesher();

/// Report whether two jobs for a surface may run at the same time without using too much memory.
/// @param memory_limit the user's limit in MiB, 0: no limit. With a limit, only one job may run.
bool can_run_two_meshers(Index triangle_count, Index memory_limit);

/// Run one job in a separate process and wait for its end. CGAL and TetGen may crash, hang or use
/// all memory if the input is bad. This function converts these failures to a status:
/// - unavailable: the helper is not found; the message contains the packages that are needed to
///   build it;
/// - canceled: the context was canceled (the helper is killed within 20 ms);
/// - internal_error: the helper crashed, ended with an error, ran out of time or memory, or wrote
///   an invalid mesh; the message contains the reason.
///
/// Input and output are anonymous memory files, so no file remains even if either process is
/// killed. Progress lines of the helper become progress of the current phase.
Status run_mesher(ExecutionContext& context, const MesherRequest& request, const MesherData& input,
  MesherResult& answer);

} // namespace bindpose

#endif
