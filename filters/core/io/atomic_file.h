#ifndef bindpose_io_atomic_file_h
#define bindpose_io_atomic_file_h

#include "base/status.h"

#include <string>
#include <string_view>

namespace bindpose
{

/// A file that is either complete or missing. Its content is written to a temporary file in the
/// target's folder, and commit() renames the temporary file to the target. Without a commit
/// (failure, cancel, exception) the temporary file is removed.
///
///     AtomicFile file;
///     Status status = file.open("out.vtu", false);
///     if (status.ok()) status = write_it(file.temporary());
///     if (status.ok()) status = file.commit();
///
/// commit() does not call fsync: after a power failure the target may be missing or empty. For a
/// user's work, use commit_synced(), which waits until the content is on the disk.
class AtomicFile
{
public:
  AtomicFile() = default;
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Create the empty temporary file. Return invalid_input, with a message of one sentence, if the
  /// target exists and must not be overwritten, if it is not a regular file, or if its folder is
  /// missing or not writable.
  Status open(const std::string& target, bool overwrite);

  /// Return the path of the temporary file, for writing. It is in the target's folder and has the
  /// target's extension.
  const std::string& temporary() const { return this->temporary_; }

  /// Rename the temporary file to the target.
  Status commit();

  /// Commit the file. On return, the contents and the name of the file are on the disk. Even a
  /// power failure leaves no partial file.
  Status commit_synced();

  /// Commit the file like commit_synced(), but under the name `target` in the same folder. This is
  /// used for files named by a hash of their contents. A file of that name is replaced.
  Status commit_synced_as(const std::string& target);

  /// Remove the temporary file, if there is one.
  void discard();

  /// Return the status that open() would return for the target, without leaving a file behind.
  static Status check(const std::string& target, bool overwrite);

  /// Remove the temporary files of all objects of this class in the process, for a program that
  /// must end immediately. Thread-safe, but not for use in a signal handler.
  static void discard_all();

private:
  std::string target_;
  std::string temporary_;
  bool overwrite_ = false;
};

/// Write a text to a file that is either complete or missing.
Status write_file_atomically(const std::string& path, std::string_view content, bool overwrite);

} // namespace bindpose

#endif
