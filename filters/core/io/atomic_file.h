#ifndef bindpose_io_atomic_file_h
#define bindpose_io_atomic_file_h

#include "base/status.h"

#include <string>
#include <string_view>

namespace bindpose
{

/// A file that is either complete or missing. The content is written to a temporary file in the
/// target's folder, and commit() renames it. Without a commit (failure, cancel, exception) the
/// temporary file is removed.
///
///     AtomicFile file;
///     Status status = file.open("out.vtu", false);
///     if (status.ok()) status = write_it(file.temporary());
///     if (status.ok()) status = file.commit();
///
/// commit() does not call fsync: after a power failure the target may be missing or empty. Use
/// commit_synced(), which waits for the disk, for work that a person would miss.
class AtomicFile
{
public:
  AtomicFile() = default;
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Create the empty temporary file. Return invalid_input with one sentence if the target exists
  /// and must not be overwritten, if it is not a regular file, or if its folder is missing or not
  /// writable.
  Status open(const std::string& target, bool overwrite);

  /// Return the path to write to. It is in the target's folder and has the target's extension.
  const std::string& temporary() const { return this->temporary_; }

  /// Rename the file to its final name.
  Status commit();

  /// Commit the file; its contents and its name are on the disk on return. Even a power failure
  /// leaves no partial file.
  Status commit_synced();

  /// Commit the file as commit_synced() does, under another name in the same folder, for files
  /// named after their contents. It replaces a file of that name.
  Status commit_synced_as(const std::string& target);

  /// Remove the temporary file, if there is one.
  void discard();

  /// Return the status of open() for the target, without leaving a file behind.
  static Status check(const std::string& target, bool overwrite);

  /// Remove the temporary files of all AtomicFiles of this process that are not yet committed, for
  /// a program that must end immediately. Thread-safe, but not for use in a signal handler.
  static void discard_all();

private:
  std::string target_;
  std::string temporary_;
  bool overwrite_ = false;
};

/// Write a text to a file that is either complete or missing.
Status write_whole_file(const std::string& path, std::string_view content, bool overwrite);

} // namespace bindpose

#endif
