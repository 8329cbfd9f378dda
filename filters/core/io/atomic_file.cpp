// Atomic writing by renaming a temporary file (see atomic_file.h). The temporary file
// "STEM.part-PID-N.EXTENSION" is in the target's folder, so that the final rename is atomic. It has
// the target's extension, because some writers select the format by the extension.
#include "io/atomic_file.h"

#include "io/text_scanner.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <set>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace bindpose
{

namespace
{
/// Paths of all temporary files of the process that exist now, for discard_all(). This list is the
/// only state that the objects of the class share.
struct Registry
{
  std::mutex mutex;
  std::set<std::string> paths;
};

Registry& registry()
{
  static Registry instance;
  return instance;
}

Status cannot_write(const std::string& path, const std::string& reason)
{
  return Status::invalid_input("cannot write " + path + ": " + reason);
}

/// Wait until a file or a folder is on the disk. If that fails, return false and set errno.
bool sync_path(const std::string& path)
{
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0)
  {
    return false;
  }
  const bool done = ::fsync(descriptor) == 0;
  const int reason = errno;
  ::close(descriptor);
  errno = reason;
  return done;
}

Status check_target(const std::string& target, bool overwrite)
{
  struct stat info = {};
  if (target.empty())
  {
    return Status::invalid_input("the name of the output file is empty");
  }
  if (stat(target.c_str(), &info) != 0)
  {
    return errno == ENOENT ? Status() : cannot_write(target, std::strerror(errno));
  }
  if (S_ISDIR(info.st_mode))
  {
    return cannot_write(target, "it is a directory");
  }
  if (!S_ISREG(info.st_mode))
  {
    return cannot_write(target, "it is not a regular file");
  }
  if (!overwrite)
  {
    return cannot_write(target, "the file exists; turn on overwrite to replace it");
  }
  return {};
}
} // namespace

AtomicFile::~AtomicFile()
{
  this->discard();
}

Status AtomicFile::open(const std::string& target, bool overwrite)
{
  this->discard();
  Status status = check_target(target, overwrite);
  if (!status.ok())
  {
    return status;
  }
  static std::atomic<int> count{ 0 };
  const std::size_t name = target.find_last_of('/') + 1;
  const std::size_t dot = target.find_last_of('.');
  const std::size_t ending = dot == std::string::npos || dot <= name ? target.size() : dot;
  const std::string temporary = target.substr(0, ending) + ".part-" + std::to_string(getpid()) +
    "-" + std::to_string(++count) + target.substr(ending);
  Registry& files = registry();
  const std::lock_guard<std::mutex> lock(files.mutex);
  const int descriptor = ::open(temporary.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor < 0)
  {
    return cannot_write(target, std::strerror(errno));
  }
  ::close(descriptor);
  files.paths.insert(temporary);
  this->target_ = target;
  this->temporary_ = temporary;
  this->overwrite_ = overwrite;
  return {};
}

Status AtomicFile::commit()
{
  if (this->temporary_.empty())
  {
    return Status::failure(StatusCode::internal_error, "cannot commit a file that was not opened");
  }
  // The target may have been created since open().
  Status status = check_target(this->target_, this->overwrite_);
  if (status.ok())
  {
    Registry& files = registry();
    const std::lock_guard<std::mutex> lock(files.mutex);
    if (std::rename(this->temporary_.c_str(), this->target_.c_str()) != 0)
    {
      status = cannot_write(this->target_, std::strerror(errno));
    }
    else
    {
      files.paths.erase(this->temporary_);
      this->temporary_.clear();
    }
  }
  this->discard();
  return status;
}

Status AtomicFile::commit_synced()
{
  const std::string target = this->target_;
  if (!this->temporary_.empty() && !sync_path(this->temporary_))
  {
    const Status status = cannot_write(target, std::strerror(errno));
    this->discard();
    return status;
  }
  Status status = this->commit();
  if (status.ok())
  {
    // Sync the folder, because it stores the name of the file. Failure is ignored, because some
    // file systems cannot sync folders.
    const std::size_t name = target.find_last_of('/');
    sync_path(name == std::string::npos ? "." : target.substr(0, name + 1));
  }
  return status;
}

Status AtomicFile::commit_synced_as(const std::string& target)
{
  this->target_ = target;
  this->overwrite_ = true;
  return this->commit_synced();
}

void AtomicFile::discard()
{
  if (this->temporary_.empty())
  {
    return;
  }
  Registry& files = registry();
  const std::lock_guard<std::mutex> lock(files.mutex);
  ::unlink(this->temporary_.c_str());
  files.paths.erase(this->temporary_);
  this->temporary_.clear();
}

Status AtomicFile::check(const std::string& target, bool overwrite)
{
  AtomicFile file;
  return file.open(target, overwrite);
}

void AtomicFile::discard_all()
{
  Registry& files = registry();
  const std::lock_guard<std::mutex> lock(files.mutex);
  for (const std::string& path : files.paths)
  {
    ::unlink(path.c_str());
  }
  files.paths.clear();
}

Status write_file_atomically(const std::string& path, std::string_view content, bool overwrite)
{
  AtomicFile file;
  Status status = file.open(path, overwrite);
  if (status.ok())
  {
    status = write_file(file.temporary(), content);
  }
  return status.ok() ? file.commit() : status;
}

} // namespace bindpose
