// A temporary folder with a guard process (see scratch_folder.h). The guard is a shell that reads
// ids of process groups from a socket, line by line, until the socket closes. The socket closes
// when the object is destroyed or when this process dies for any reason. The guard then kills the
// last group that it has read (an empty line means no group) and removes the folder. The guard
// leads a separate process group, so that a Ctrl-C in the terminal does not end it.
#include "helper/scratch_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include <csignal>
#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace bindpose
{

namespace
{
constexpr const char* guard_script = "trap '' HUP INT TERM\n"
                                     "group=\n"
                                     "while read -r line; do group=$line; done\n"
                                     "[ -z \"$group\" ] || kill -s KILL -- \"-$group\"\n"
                                     "rm -rf -- \"$1\"\n";
} // namespace

ScratchFolder::ScratchFolder(const std::string& purpose)
{
  std::error_code failure;
  const std::filesystem::path parent = std::filesystem::temp_directory_path(failure);
  if (failure)
  {
    this->error_ = "cannot find the folder for temporary files: " + failure.message();
    return;
  }
  std::string pattern = (parent / ("bindpose-" + purpose + "-XXXXXX")).string();
  if (!::mkdtemp(pattern.data()))
  {
    this->error_ =
      "cannot create a temporary folder in " + parent.string() + ": " + std::strerror(errno);
    return;
  }
  this->path_ = pattern;
  this->start_guard();
}

ScratchFolder::~ScratchFolder()
{
  if (!this->path_.empty())
  {
    std::error_code ignored;
    std::filesystem::remove_all(this->path_, ignored);
  }
  if (this->socket_ >= 0)
  {
    ::close(this->socket_);
  }
  while (this->guard_ > 0 && ::waitpid(this->guard_, nullptr, 0) < 0 && errno == EINTR)
  {
  }
}

void ScratchFolder::guard_group(int group)
{
  if (this->socket_ >= 0)
  {
    const std::string line = group > 0 ? std::to_string(group) + "\n" : "\n";
    // If the guard has ended, sending fails; the flag MSG_NOSIGNAL then prevents a signal.
    static_cast<void>(::send(this->socket_, line.data(), line.size(), MSG_NOSIGNAL));
  }
}

void ScratchFolder::start_guard()
{
  int ends[2] = { -1, -1 };
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
  {
    return;
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], 0);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  std::string script = guard_script;
  std::string shell = "sh", option = "-c", name = "bindpose-guard";
  char* argv[] = { shell.data(), option.data(), script.data(), name.data(), this->path_.data(),
    nullptr };
  if (::posix_spawn(&this->guard_, "/bin/sh", &actions, &attributes, argv, environ) != 0)
  {
    this->guard_ = -1;
  }
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  this->socket_ = ends[0];
}

} // namespace bindpose
