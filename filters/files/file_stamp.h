#ifndef file_stamp_h
#define file_stamp_h

#include <cstdint>
#include <filesystem>
#include <string>

namespace bindpose
{

/// Path, size and time of the last change of a file, for caches of its content.
class FileStamp
{
public:
  using Time = std::filesystem::file_time_type;

  FileStamp() = default;
  /// Make the stamp of a file whose content is read after `read_begin`.
  explicit FileStamp(const std::string& path, Time read_begin = Time::clock::now());

  /// Report whether the file has the content that was read for `stored`. The result is false if a
  /// file does not exist, or if the file was changed less than 0.1 s before the read began, or
  /// later: the content could then be of another change with the same time.
  bool has_content_of(const FileStamp& stored) const;

private:
  std::string path_;
  std::uintmax_t size_ = 0;
  Time written_;
  bool is_settled_ = false;
};

} // namespace bindpose

#endif
