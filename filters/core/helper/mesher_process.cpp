// Exchange of data with bindpose-mesher (see mesher_process.h). The helper reads its job from
// standard input and writes the result to standard output. Both are anonymous files, so that no
// pipe can block and no file must be removed.
#include "helper/mesher_process.h"

#include "helper/helper_process.h"

#include <cerrno>
#include <cstring>

#include <unistd.h>

namespace bindpose
{

namespace
{
constexpr Helper mesher{ "bindpose-mesher", "BINDPOSE_MESHER",
  "the helper executable bindpose-mesher is missing; building it needs the packages libcgal-dev "
  "and libtet1.5-dev" };
} // namespace

bool can_run_two_meshers(Index triangle_count, Index memory_limit)
{
  constexpr Index maximum_triangles = 1000000;
  return triangle_count <= maximum_triangles && memory_limit == 0;
}

std::string find_mesher()
{
  return find_helper(mesher);
}

Status run_mesher(ExecutionContext& context, const MesherRequest& request, const MesherData& input,
  MesherResult& answer)
{
  answer = MesherResult();
  const FileDescriptor input_file(anonymous_file("bindpose-mesher-input"));
  const FileDescriptor output_file(anonymous_file("bindpose-mesher-output"));
  if (input_file.get() < 0 || output_file.get() < 0 ||
    !write_mesher_data(input_file.get(), input) || ::lseek(input_file.get(), 0, SEEK_SET) != 0)
  {
    return Status::failure(StatusCode::internal_error,
      std::string("cannot write the temporary mesh for bindpose-mesher: ") + std::strerror(errno));
  }
  HelperRequest job;
  job.name = "bindpose-mesher" +
    (request.arguments.empty() ? std::string() : " " + request.arguments.front());
  job.arguments = request.arguments;
  job.input = input_file.get();
  job.time_limit = request.time_limit;
  job.processor_limit = request.processor_limit;
  job.memory_limit = request.memory_limit;
  HelperRun run;
  Status status = run_helper(context, mesher, job, output_file.get(), run);
  answer.report = run.report;
  answer.seconds = run.seconds;
  answer.timed_out = run.timed_out;
  if (status.ok() &&
    (::lseek(output_file.get(), 0, SEEK_SET) != 0 ||
      !read_mesher_data(output_file.get(), answer.data)))
  {
    status = Status::failure(StatusCode::internal_error, job.name + " did not write a valid mesh");
  }
  return status;
}

} // namespace bindpose
