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
  FileStamp() = default;
  explicit FileStamp(const std::string& path);

  /// Report whether the file is unchanged since `stored` was made. The result is false if a file
  /// does not exist, or if `stored` was made within 0.1 s of a change of the file, because a
  /// further change could then have the same time.
  bool has_content_of(const FileStamp& stored) const;

private:
  std::string path_;
  std::uintmax_t size_ = 0;
  std::filesystem::file_time_type written_;
  bool is_settled_ = false;
};

} // namespace bindpose

#endif
