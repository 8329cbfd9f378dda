#ifndef bindpose_io_atomic_file_h
#define bindpose_io_atomic_file_h

#include "base/status.h"

#include <string>
#include <string_view>

namespace bindpose
{

/// A file that appears whole or not at all: what is written goes to a temporary file beside the
/// target, and commit() renames it. Without a commit the temporary file is removed, whatever the
/// reason (failure, cancel, exception).
///
///     AtomicFile file;
///     Status status = file.open("out.vtu", false);
///     if (status.ok()) status = write_it(file.temporary());
///     if (status.ok()) status = file.commit();
///
/// commit() does no fsync: after a power failure the target may be missing or empty. Work that a
/// person would miss is committed by commit_synced(), which waits for the disk.
class AtomicFile
{
public:
  AtomicFile() = default;
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Makes the empty temporary file. invalid_input, one sentence, when the target exists and must
  /// not be overwritten, is no regular file, or its folder is missing or not writable.
  Status open(const std::string& target, bool overwrite);

  /// Path to write to, in the target's folder, with the target's ending.
  const std::string& temporary() const { return this->temporary_; }

  /// Gives the file its final name.
  Status commit();

  /// The same, with contents and name on the disk when it returns: not even a power failure leaves
  /// half a file.
  Status commit_synced();

  /// The same under another name in the same folder: for files that are named after what is in
  /// them. Replaces a file of that name.
  Status commit_synced_as(const std::string& target);

  /// Removes the temporary file; nothing when there is none.
  void discard();

  /// What open() would say about the target, leaving nothing behind.
  static Status check(const std::string& target, bool overwrite);

  /// Removes the temporary files of all AtomicFiles of this process that are not yet committed:
  /// for a program that must end at once. Thread-safe; not for a signal handler itself.
  static void discard_all();

private:
  std::string target_;
  std::string temporary_;
  bool overwrite_ = false;
};

/// A text as a file that appears whole or not at all.
Status write_whole_file(const std::string& path, std::string_view content, bool overwrite);

} // namespace bindpose

#endif
