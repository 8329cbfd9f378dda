// The helper reads its job from standard input and writes the result to standard output; both are
// anonymous files, so that no pipe can block and nothing has to be removed. Standard error is a
// pipe of lines: "progress FRACTION", "report KEY NUMBER", "error TEXT"; anything else is what a
// library printed before it died, and is kept for the message.
#include "inside/mesher_process.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace bindpose
{

namespace
{
constexpr const char* missing_helper =
  "the helper executable bindpose-mesher is missing; the packages libcgal-dev and libtet1.5-dev "
  "are needed to build it";

/// Closes itself.
class File
{
public:
  explicit File(int descriptor = -1) : descriptor_(descriptor) {}
  ~File() { this->close(); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  int get() const { return this->descriptor_; }
  void close()
  {
    if (this->descriptor_ >= 0)
    {
      ::close(this->descriptor_);
    }
    this->descriptor_ = -1;
  }
  void reset(int descriptor)
  {
    this->close();
    this->descriptor_ = descriptor;
  }

private:
  int descriptor_;
};

/// A file without a name, closed on exec, on a descriptor that cannot collide with 0, 1 and 2.
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

bool executable_file(const std::string& path)
{
  return !path.empty() && ::access(path.c_str(), X_OK) == 0;
}

std::string folder_of(const std::string& path)
{
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "." : path.substr(0, slash);
}

/// The child process; killed and reaped on every way out.
class Child
{
public:
  Child() = default;
  ~Child() { this->kill(); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  int start(const std::string& path, const std::vector<std::string>& arguments, int input,
    int output, int lines)
  {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input, 0);
    posix_spawn_file_actions_adddup2(&actions, output, 1);
    posix_spawn_file_actions_adddup2(&actions, lines, 2);
    // Signals that the application blocks or ignores must not make the helper deaf.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none, defaults;
    sigemptyset(&none);
    sigemptyset(&defaults);
    for (const int signal : { SIGINT, SIGTERM, SIGPIPE, SIGSEGV, SIGABRT })
    {
      sigaddset(&defaults, signal);
    }
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    std::vector<char*> words{ const_cast<char*>(path.c_str()) };
    for (const std::string& argument : arguments)
    {
      words.push_back(const_cast<char*>(argument.c_str()));
    }
    words.push_back(nullptr);
    const int error =
      ::posix_spawn(&this->id_, path.c_str(), &actions, &attributes, words.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (error)
    {
      this->id_ = -1;
    }
    return error;
  }

  /// True once it has ended; status as of waitpid.
  bool ended(int& status)
  {
    if (this->id_ > 0 && ::waitpid(this->id_, &status, WNOHANG) == this->id_)
    {
      this->id_ = -1;
      return true;
    }
    return false;
  }

  void kill()
  {
    if (this->id_ > 0)
    {
      ::kill(this->id_, SIGKILL);
      int status = 0;
      while (::waitpid(this->id_, &status, 0) < 0 && errno == EINTR)
      {
      }
      this->id_ = -1;
    }
  }

private:
  pid_t id_ = -1;
};

/// Takes the helper's lines apart.
class Lines
{
public:
  /// @return false at the end of the pipe.
  bool read(int pipe, ExecutionContext& context, Report& report)
  {
    char block[4096];
    const ssize_t got = ::read(pipe, block, sizeof(block));
    if (got <= 0)
    {
      return got < 0 && (errno == EINTR || errno == EAGAIN);
    }
    this->pending_.append(block, static_cast<std::size_t>(got));
    std::size_t end = 0;
    while ((end = this->pending_.find('\n')) != std::string::npos)
    {
      this->take(this->pending_.substr(0, end), context, report);
      this->pending_.erase(0, end + 1);
    }
    constexpr std::size_t longest = 65536;
    if (this->pending_.size() > longest)
    {
      this->pending_.clear(); // noise without line ends
    }
    return true;
  }

  std::string error() const { return this->error_; }
  std::string noise() const { return this->noise_; }

private:
  void take(const std::string& line, ExecutionContext& context, Report& report)
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
      constexpr std::size_t enough = 200;
      this->noise_ = line.substr(0, enough);
    }
  }

  std::string pending_;
  std::string error_;
  std::string noise_;
};

std::string limit_words(const MesherRequest& request)
{
  return request.memory_limit > 0
    ? " under a memory limit of " + std::to_string(request.memory_limit) + " MiB"
    : std::string();
}

std::string seconds_words(double seconds)
{
  std::ostringstream text;
  text.precision(3);
  text << seconds << " s";
  return text.str();
}

Status judge_end(
  int status, const Lines& lines, const MesherRequest& request, const std::string& job)
{
  std::string message;
  if (WIFSIGNALED(status))
  {
    message = job + " was ended by signal " + std::to_string(WTERMSIG(status)) + " (" +
      ::strsignal(WTERMSIG(status)) + ")" + limit_words(request);
    if (!lines.noise().empty())
    {
      message += "; its last words: " + lines.noise();
    }
  }
  else if (!lines.error().empty())
  {
    message = job + ": " + lines.error() + limit_words(request);
  }
  else if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
  {
    message = job + " ended with code " + std::to_string(WEXITSTATUS(status)) +
      limit_words(request) + (lines.noise().empty() ? "" : ": " + lines.noise());
  }
  else
  {
    return {};
  }
  return Status::failure(StatusCode::internal_error, message);
}
} // namespace

std::string find_mesher()
{
  if (const char* chosen = std::getenv("BINDPOSE_MESHER"))
  {
    return executable_file(chosen) ? std::string(chosen) : std::string();
  }
  std::vector<std::string> folders;
  char self[4096];
  const ssize_t length = ::readlink("/proc/self/exe", self, sizeof(self) - 1);
  if (length > 0)
  {
    folders.push_back(folder_of(std::string(self, static_cast<std::size_t>(length))));
  }
  // The library that holds this function: a plugin's folder, lib/libX.so, or
  // lib/ARCHITECTURE/libX.so.
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
    if (executable_file(path))
    {
      return path;
    }
  }
  return {};
}

Status run_mesher(const MesherRequest& request, const MesherData& input, MesherAnswer& answer,
  ExecutionContext& context)
{
  using Clock = std::chrono::steady_clock;
  answer = MesherAnswer();
  if (context.cancelled())
  {
    return Status::cancelled();
  }
  const std::string path = find_mesher();
  if (path.empty())
  {
    const char* chosen = std::getenv("BINDPOSE_MESHER");
    return Status::failure(StatusCode::unavailable,
      chosen ? std::string("BINDPOSE_MESHER names no executable file: ") + chosen
             : std::string(missing_helper));
  }
  File input_file(anonymous_file("bindpose-mesher-input"));
  File output_file(anonymous_file("bindpose-mesher-output"));
  int ends[2] = { -1, -1 };
  if (input_file.get() < 0 || output_file.get() < 0 || ::pipe2(ends, O_CLOEXEC) != 0 ||
    !write_mesher_data(input_file.get(), input) || ::lseek(input_file.get(), 0, SEEK_SET) != 0)
  {
    const std::string reason = std::strerror(errno);
    File close_read(ends[0]), close_write(ends[1]);
    return Status::failure(
      StatusCode::internal_error, "no room to hand the mesh to bindpose-mesher: " + reason);
  }
  File lines_read(ends[0]), lines_write(ends[1]);

  std::vector<std::string> arguments = request.arguments;
  if (request.memory_limit > 0)
  {
    arguments.insert(arguments.end(), { "--memory", std::to_string(request.memory_limit) });
  }
  const std::string job =
    "bindpose-mesher" + (arguments.empty() ? std::string() : " " + arguments.front());
  const Clock::time_point start = Clock::now();
  Child child;
  const int error =
    child.start(path, arguments, input_file.get(), output_file.get(), lines_write.get());
  if (error)
  {
    return Status::failure(
      StatusCode::unavailable, path + " cannot be started: " + std::strerror(error));
  }
  lines_write.close();
  input_file.close();

  Lines lines;
  int end_status = 0;
  bool open = true;
  for (;;)
  {
    pollfd wait{ open ? lines_read.get() : -1, POLLIN, 0 };
    const int patience = open ? 20 : 1; // ms between looks at cancel and clock
    const int ready = ::poll(&wait, 1, patience);
    if (open && ready > 0)
    {
      open = lines.read(lines_read.get(), context, answer.report);
    }
    answer.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (context.cancelled())
    {
      return Status::cancelled();
    }
    // The pipe is read to its end first: the last line may be the one that explains the end. A
    // grandchild could hold it open, so the end of the child itself counts when nothing is ready.
    if ((!open || ready == 0) && child.ended(end_status))
    {
      break;
    }
    if (answer.seconds > request.time_limit)
    {
      return Status::failure(StatusCode::internal_error,
        job + " was stopped at its time limit of " + seconds_words(request.time_limit));
    }
  }
  Status status = judge_end(end_status, lines, request, job);
  if (!status.ok())
  {
    return status;
  }
  if (::lseek(output_file.get(), 0, SEEK_SET) != 0 ||
    !read_mesher_data(output_file.get(), answer.data))
  {
    return Status::failure(StatusCode::internal_error, job + " wrote no readable mesh");
  }
  return {};
}

} // namespace bindpose
