// Exchange of data with bindpose-mesher (see mesher_process.h). The helper reads its job from
// standard input and writes the result to standard output. Both are anonymous files, so that no
// pipe can block and no file must be removed. On standard error, the helper prints lines of these
// forms: "progress FRACTION", "report KEY NUMBER", "error TEXT". Any other line was printed by a
// library before a failure and is stored for the error message.
#include "helper/mesher_process.h"

#include "helper/child_process.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace bindpose
{

namespace
{
constexpr const char* missing_helper = "the helper executable bindpose-mesher is missing; building "
                                       "it needs the packages libcgal-dev and libtet1.5-dev";

/// Create an anonymous file that is closed on exec, with a descriptor other than 0, 1 and 2.
int anonymous_file(const char* name)
{
  const int file = ::memfd_create(name, MFD_CLOEXEC);
  if (file < 0 || file > 2)
  {
    return file;
  }
  const int moved = ::fcntl(file, F_DUPFD_CLOEXEC, 3);
  ::close(file);
  return moved;
}

std::string folder_of(const std::string& path)
{
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "." : path.substr(0, slash);
}

/// Parses the lines that the helper prints.
class HelperOutput
{
public:
  void parse_line(ExecutionContext& context, const std::string& line, Report& report)
  {
    std::istringstream words(line);
    std::string kind, key;
    double number = 0.0;
    words >> kind;
    if (kind == "progress" && words >> number)
    {
      context.progress(number);
    }
    else if (kind == "report" && words >> key >> number)
    {
      report.set(key, Report::Value(number));
    }
    else if (kind == "error")
    {
      this->error_ = line.size() > 6 ? line.substr(6) : std::string();
    }
    else if (!line.empty())
    {
      constexpr std::size_t maximum_message_length = 200;
      this->library_output_ = line.substr(0, maximum_message_length);
    }
  }

  std::string error() const { return this->error_; }
  std::string library_output() const { return this->library_output_; }

private:
  std::string error_;
  std::string library_output_;
};

Status check_end(const ChildEnd& end, const HelperOutput& lines, const MesherRequest& request,
  const std::string& job)
{
  if (end.failure.empty() && lines.error().empty())
  {
    return {};
  }
  const std::string limit = memory_limit_phrase(request.memory_limit);
  std::string message = job + " " + end.failure + limit;
  if (end.killed_by_signal)
  {
    message += lines.library_output().empty() ? "" : "; last output: " + lines.library_output();
  }
  else if (!lines.error().empty())
  {
    message = job + ": " + lines.error() + limit;
  }
  else
  {
    message += lines.library_output().empty() ? "" : ": " + lines.library_output();
  }
  return Status::failure(StatusCode::internal_error, message);
}
} // namespace

bool can_run_two_meshers(Index triangle_count, Index memory_limit)
{
  constexpr Index maximum_triangles = 1000000;
  return triangle_count <= maximum_triangles && memory_limit == 0;
}

std::string find_mesher()
{
  if (const char* chosen = std::getenv("BINDPOSE_MESHER"))
  {
    return is_executable_file(chosen) ? std::string(chosen) : std::string();
  }
  std::vector<std::string> folders;
  char executable_path[4096];
  const ssize_t length = ::readlink("/proc/self/exe", executable_path, sizeof(executable_path) - 1);
  if (length > 0)
  {
    folders.push_back(folder_of(std::string(executable_path, static_cast<std::size_t>(length))));
  }
  // Find the library that contains this function. The library is either in a plugin's folder or in
  // lib/ or lib/ARCHITECTURE/ of the installation.
  Dl_info info{};
  if (::dladdr(reinterpret_cast<void*>(&find_mesher), &info) && info.dli_fname)
  {
    const std::string library = folder_of(info.dli_fname);
    folders.push_back(library);
    folders.push_back(library + "/../bin");
    folders.push_back(library + "/../../bin");
  }
#ifdef BINDPOSE_MESHER_BUILD_FOLDER
  folders.emplace_back(BINDPOSE_MESHER_BUILD_FOLDER);
#endif
  for (const std::string& folder : folders)
  {
    std::string path = folder + "/bindpose-mesher";
    if (is_executable_file(path))
    {
      return path;
    }
  }
  return {};
}

Status run_mesher(ExecutionContext& context, const MesherRequest& request, const MesherData& input,
  MesherResult& answer)
{
  answer = MesherResult();
  if (context.canceled())
  {
    return Status::canceled();
  }
  const std::string path = find_mesher();
  if (path.empty())
  {
    const char* chosen = std::getenv("BINDPOSE_MESHER");
    return Status::failure(StatusCode::unavailable,
      chosen ? std::string("the environment variable BINDPOSE_MESHER must name an executable file, "
                           "but is set to ") +
          chosen
             : std::string(missing_helper));
  }
  const FileDescriptor input_file(anonymous_file("bindpose-mesher-input"));
  const FileDescriptor output_file(anonymous_file("bindpose-mesher-output"));
  if (input_file.get() < 0 || output_file.get() < 0 ||
    !write_mesher_data(input_file.get(), input) || ::lseek(input_file.get(), 0, SEEK_SET) != 0)
  {
    return Status::failure(StatusCode::internal_error,
      std::string("cannot write the temporary mesh for bindpose-mesher: ") + std::strerror(errno));
  }
  ChildRequest child;
  child.path = path;
  child.arguments = request.arguments;
  // The helper asks the system to kill it when its parent process dies. If the parent dies before
  // this request, the helper notices that the id of its parent differs from --parent.
  child.arguments.insert(child.arguments.end(), { "--parent", std::to_string(::getpid()) });
  child.input = input_file.get();
  child.output = output_file.get();
  child.time_limit = request.time_limit;
  child.processor_limit = request.processor_limit;
  child.name = "bindpose-mesher" +
    (request.arguments.empty() ? std::string() : " " + request.arguments.front());
  if (request.memory_limit > 0)
  {
    // The helper sets the memory limit itself, so that it can report that the limit was exceeded.
    child.arguments.insert(
      child.arguments.end(), { "--memory", std::to_string(request.memory_limit) });
  }
  HelperOutput lines;
  ChildEnd end;
  Status status = run_child(
    context, child,
    [&](const std::string& line) { lines.parse_line(context, line, answer.report); }, end);
  answer.seconds = end.seconds;
  answer.timed_out = end.timed_out;
  if (status.ok())
  {
    status = check_end(end, lines, request, child.name);
  }
  if (!status.ok())
  {
    return status;
  }
  if (::lseek(output_file.get(), 0, SEEK_SET) != 0 ||
    !read_mesher_data(output_file.get(), answer.data))
  {
    return Status::failure(StatusCode::internal_error, child.name + " did not write a valid mesh");
  }
  return {};
}

} // namespace bindpose
