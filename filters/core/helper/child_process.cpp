// Run a program in a process group (see child_process.h). The lines that the program prints are
// read from a pipe. The pipe is polled, so that cancel and time limits are checked every 20 ms. The
// group is killed before its leader is reaped, because until then the system cannot assign the
// group's id to another process.
#include "helper/child_process.h"

#include "base/number_text.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <sstream>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace bindpose
{

namespace
{
/// File actions of posix_spawn for standard input, output and error, and for the working folder.
class SpawnActions
{
public:
  SpawnActions(const ChildRequest& request, int lines)
  {
    posix_spawn_file_actions_init(&this->actions_);
    if (request.input >= 0)
    {
      posix_spawn_file_actions_adddup2(&this->actions_, request.input, 0);
    }
    else
    {
      posix_spawn_file_actions_addopen(&this->actions_, 0, "/dev/null", O_RDONLY, 0);
    }
    posix_spawn_file_actions_adddup2(
      &this->actions_, request.output >= 0 ? request.output : lines, 1);
    posix_spawn_file_actions_adddup2(&this->actions_, lines, 2);
    if (!request.folder.empty())
    {
      posix_spawn_file_actions_addchdir_np(&this->actions_, request.folder.c_str());
    }
  }
  ~SpawnActions() { posix_spawn_file_actions_destroy(&this->actions_); }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;
  const posix_spawn_file_actions_t* get() const { return &this->actions_; }

private:
  posix_spawn_file_actions_t actions_{};
};

/// Attributes of posix_spawn: a separate process group and default signal handling, so that signals
/// that the application blocks or ignores are delivered to the program.
class SpawnAttributes
{
public:
  SpawnAttributes()
  {
    posix_spawnattr_init(&this->attributes_);
    sigset_t none, defaults;
    sigemptyset(&none);
    sigemptyset(&defaults);
    for (const int signal : { SIGINT, SIGTERM, SIGPIPE, SIGSEGV, SIGABRT })
    {
      sigaddset(&defaults, signal);
    }
    posix_spawnattr_setsigmask(&this->attributes_, &none);
    posix_spawnattr_setsigdefault(&this->attributes_, &defaults);
    posix_spawnattr_setpgroup(&this->attributes_, 0);
    posix_spawnattr_setflags(
      &this->attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  }
  ~SpawnAttributes() { posix_spawnattr_destroy(&this->attributes_); }
  SpawnAttributes(const SpawnAttributes&) = delete;
  SpawnAttributes& operator=(const SpawnAttributes&) = delete;
  const posix_spawnattr_t* get() const { return &this->attributes_; }

private:
  posix_spawnattr_t attributes_{};
};

/// The process and its group. The destructor kills the group and reaps the process.
class Child
{
public:
  explicit Child(const ChildRequest& request) : request_(request) {}
  ~Child() { this->finish(); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Start the process.
  /// @param lines file descriptor to which the process prints its lines.
  /// @return an error number, 0 for success.
  int start(int lines)
  {
    const SpawnActions actions(this->request_, lines);
    const SpawnAttributes attributes;
    std::vector<char*> argv{ const_cast<char*>(this->request_.path.c_str()) };
    for (const std::string& argument : this->request_.arguments)
    {
      argv.push_back(const_cast<char*>(argument.c_str()));
    }
    argv.push_back(nullptr);
    const int error = ::posix_spawn(&this->id_, this->request_.path.c_str(), actions.get(),
      attributes.get(), argv.data(), environ);
    if (error)
    {
      this->id_ = -1;
      return error;
    }
    this->set_limits();
    this->notify_group(this->id_);
    return 0;
  }

  /// Report whether the process has ended.
  bool ended() const
  {
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(this->id_), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
      info.si_pid == this->id_;
  }

  /// Return the processor time of the child, without the child's own children, or 0 if it is not
  /// available.
  double processor_seconds() const
  {
    clockid_t clock{};
    timespec time{};
    const bool available =
      ::clock_getcpuclockid(this->id_, &clock) == 0 && ::clock_gettime(clock, &time) == 0;
    return available ? static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec)
                     : 0.0;
  }

  /// Kill the remaining processes of the group and reap the child.
  /// @return its status as defined by waitpid().
  int finish()
  {
    int status = 0;
    if (this->id_ > 0)
    {
      ::kill(-this->id_, SIGKILL);
      while (::waitpid(this->id_, &status, 0) < 0 && errno == EINTR)
      {
      }
      this->id_ = -1;
      this->notify_group(0);
    }
    return status;
  }

private:
  void set_limits() const
  {
    // This process sets the limits of the child, so that programs without an option for limits are
    // limited, too. The limits take effect some microseconds after the start. Memory that the
    // program has allocated before then counts toward the memory limit.
    const rlimit none{ 0, 0 };
    ::prlimit(this->id_, RLIMIT_CORE, &none, nullptr);
    if (this->request_.memory_limit > 0)
    {
      const auto bytes = static_cast<rlim_t>(this->request_.memory_limit) << 20;
      const rlimit memory{ bytes, bytes };
      ::prlimit(this->id_, RLIMIT_AS, &memory, nullptr);
    }
  }

  void notify_group(int group) const
  {
    if (this->request_.started)
    {
      this->request_.started(group);
    }
  }

  const ChildRequest& request_;
  pid_t id_ = -1;
};

/// Splits the output of the pipe into lines.
class LineReader
{
public:
  explicit LineReader(const std::function<void(const std::string&)>& on_line) : on_line_(on_line) {}

  /// Read from the pipe.
  /// @return false at the end of the output.
  bool read(int pipe)
  {
    char block[4096];
    const ssize_t byte_count = ::read(pipe, block, sizeof(block));
    if (byte_count <= 0)
    {
      return byte_count < 0 && (errno == EINTR || errno == EAGAIN);
    }
    this->pending_.append(block, static_cast<std::size_t>(byte_count));
    std::size_t end = 0;
    while ((end = this->pending_.find('\n')) != std::string::npos)
    {
      this->on_line_(this->pending_.substr(0, end));
      this->pending_.erase(0, end + 1);
    }
    constexpr std::size_t longest = 65536;
    if (this->pending_.size() > longest)
    {
      this->pending_.clear(); // discard output without line ends
    }
    return true;
  }

private:
  const std::function<void(const std::string&)>& on_line_;
  std::string pending_;
};

void describe_end(int status, ChildEnd& end)
{
  end.killed_by_signal = WIFSIGNALED(status);
  if (end.killed_by_signal)
  {
    end.failure = "was terminated by signal " + std::to_string(WTERMSIG(status)) + " (" +
      ::strsignal(WTERMSIG(status)) + ")";
  }
  else if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
  {
    end.failure = "failed with exit code " + std::to_string(WEXITSTATUS(status));
  }
}
} // namespace

void FileDescriptor::close()
{
  if (this->descriptor_ >= 0)
  {
    ::close(this->descriptor_);
  }
  this->descriptor_ = -1;
}

bool is_executable_file(const std::string& path)
{
  std::error_code none;
  return std::filesystem::is_regular_file(path, none) && ::access(path.c_str(), X_OK) == 0;
}

std::string find_on_path(const std::string& program)
{
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
  {
    std::string file = (folder.empty() ? "." : folder) + "/" + program;
    if (is_executable_file(file))
    {
      return file;
    }
  }
  return {};
}

Status check_limits(double time_limit, Index memory_limit)
{
  if (!(time_limit > 0.0))
  {
    return Status::invalid_input(
      "time_limit must be positive, not " + short_number(time_limit) + " s");
  }
  if (memory_limit < 0)
  {
    return Status::invalid_input("memory_limit must not be negative");
  }
  return {};
}

std::string memory_limit_phrase(Index memory_limit)
{
  return memory_limit > 0 ? " under a memory limit of " + std::to_string(memory_limit) + " MiB"
                          : std::string();
}

Status run_child(ExecutionContext& context, const ChildRequest& request,
  const std::function<void(const std::string&)>& on_line, ChildEnd& end)
{
  using Clock = std::chrono::steady_clock;
  end = ChildEnd();
  if (context.canceled())
  {
    return Status::canceled();
  }
  int ends[2] = { -1, -1 };
  if (::pipe2(ends, O_CLOEXEC) != 0)
  {
    return Status::failure(StatusCode::internal_error,
      "cannot create a pipe to " + request.name + ": " + std::strerror(errno));
  }
  const FileDescriptor lines_read(ends[0]);
  FileDescriptor lines_write(ends[1]);
  const Clock::time_point start = Clock::now();
  Child child(request);
  if (const int error = child.start(lines_write.get()))
  {
    return Status::failure(
      StatusCode::unavailable, request.path + " cannot be started: " + std::strerror(error));
  }
  lines_write.close();

  LineReader lines(on_line);
  bool open = true;
  for (;;)
  {
    pollfd poll_request{ open ? lines_read.get() : -1, POLLIN, 0 };
    // time between two checks of cancel and time limits
    const int poll_milliseconds = open ? 20 : 1;
    const int ready_count = ::poll(&poll_request, 1, poll_milliseconds);
    if (open && ready_count > 0)
    {
      open = lines.read(lines_read.get());
    }
    end.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (context.canceled())
    {
      return Status::canceled();
    }
    // Read all output before handling the end of the child, because the last line may explain a
    // failure. If a grandchild keeps the pipe open, reading never reaches the end of the output. In
    // this case, the loop ends as soon as the child has ended and no output is ready.
    if ((!open || ready_count == 0) && child.ended())
    {
      describe_end(child.finish(), end);
      return {};
    }
    const bool at_processor_limit =
      request.processor_limit > 0.0 && child.processor_seconds() > request.processor_limit;
    end.timed_out = at_processor_limit || end.seconds > request.time_limit;
    if (end.timed_out)
    {
      return Status::failure(StatusCode::internal_error,
        request.name + " was stopped at its time limit of " +
          (at_processor_limit ? short_number(request.processor_limit) + " s of processor time"
                              : short_number(request.time_limit) + " s"));
    }
  }
}

} // namespace bindpose
