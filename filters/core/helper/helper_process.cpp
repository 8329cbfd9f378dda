// Runs of helper executables (see helper_process.h).
#include "helper/helper_process.h"

#include <cstdlib>
#include <sstream>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace bindpose
{

namespace
{
std::string folder_of(const std::string& path)
{
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "." : path.substr(0, slash);
}

/// Parses the lines that a helper prints.
class HelperOutput
{
public:
  void parse_line(ExecutionContext& context, const std::string& line, HelperRun& run)
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
      run.report.set(key, Report::Value(number));
    }
    else if (kind == "warning")
    {
      run.warnings.push_back(rest_of(line, kind));
    }
    else if (kind == "error")
    {
      this->error_ = rest_of(line, kind);
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
  /// Return the text after the first word and a blank.
  static std::string rest_of(const std::string& line, const std::string& word)
  {
    return line.size() > word.size() + 1 ? line.substr(word.size() + 1) : std::string();
  }

  std::string error_;
  std::string library_output_;
};

Status check_end(const ChildEnd& end, const HelperOutput& lines, const HelperRequest& request)
{
  if (end.failure.empty() && lines.error().empty())
  {
    return {};
  }
  // The message contains the memory limit only if the limit can be the cause of the failure: after
  // a crash, or if memory ran out.
  const std::string limit = memory_limit_phrase(request.memory_limit);
  std::string message = request.name + " " + end.failure + (end.killed_by_signal ? limit : "");
  if (end.killed_by_signal)
  {
    message += lines.library_output().empty() ? "" : "; last output: " + lines.library_output();
  }
  else if (!lines.error().empty())
  {
    message = request.name + ": " + lines.error() + (lines.error() == "out of memory" ? limit : "");
  }
  else
  {
    message += lines.library_output().empty() ? "" : ": " + lines.library_output();
  }
  return Status::failure(StatusCode::internal_error, message);
}
} // namespace

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

std::string find_helper(const Helper& helper)
{
  if (const char* chosen = std::getenv(helper.variable))
  {
    return is_executable_file(chosen) ? std::string(chosen) : std::string();
  }
  std::vector<std::string> folders;
  // First search near the library that contains this function, because the helper belongs to this
  // library. The library is either in a plugin's folder, or in lib/ or lib/ARCHITECTURE/ of the
  // installation. The folder of the executable comes later, because the executable may be a
  // program of another installation, such as python3.
  Dl_info info{};
  if (::dladdr(reinterpret_cast<void*>(&find_helper), &info) && info.dli_fname)
  {
    const std::string library = folder_of(info.dli_fname);
    folders.push_back(library);
    folders.push_back(library + "/../bin");
    folders.push_back(library + "/../../bin");
  }
  char executable_path[4096];
  const ssize_t length = ::readlink("/proc/self/exe", executable_path, sizeof(executable_path) - 1);
  if (length > 0)
  {
    folders.push_back(folder_of(std::string(executable_path, static_cast<std::size_t>(length))));
  }
#ifdef BINDPOSE_PROGRAM_BUILD_FOLDER
  folders.emplace_back(BINDPOSE_PROGRAM_BUILD_FOLDER);
#endif
  for (const std::string& folder : folders)
  {
    std::string path = folder + "/" + helper.program;
    if (is_executable_file(path))
    {
      return path;
    }
  }
  return {};
}

Status run_helper(ExecutionContext& context, const Helper& helper, const HelperRequest& request,
  int output, HelperRun& run)
{
  run = HelperRun();
  if (context.canceled())
  {
    return Status::canceled();
  }
  ChildRequest child;
  child.path = find_helper(helper);
  if (child.path.empty())
  {
    const char* chosen = std::getenv(helper.variable);
    return Status::failure(StatusCode::unavailable,
      chosen ? std::string("the environment variable ") + helper.variable +
          " must name an executable file, but is set to " + chosen
             : std::string(helper.missing));
  }
  child.name = request.name;
  child.arguments = request.arguments;
  // The helper asks the system to kill it when its parent process dies. If the parent dies before
  // this request, the helper notices that the id of its parent differs from --parent.
  child.arguments.insert(child.arguments.end(), { "--parent", std::to_string(::getpid()) });
  if (request.memory_limit > 0)
  {
    // The helper sets the memory limit itself, so that it can report that the limit was exceeded.
    child.arguments.insert(
      child.arguments.end(), { "--memory", std::to_string(request.memory_limit) });
  }
  child.input = request.input;
  child.output = output;
  child.time_limit = request.time_limit;
  child.processor_limit = request.processor_limit;
  HelperOutput lines;
  ChildEnd end;
  Status status = run_child(
    context, child, [&](const std::string& line) { lines.parse_line(context, line, run); }, end);
  run.seconds = end.seconds;
  run.timed_out = end.timed_out;
  return status.ok() ? check_end(end, lines, request) : status;
}

} // namespace bindpose
