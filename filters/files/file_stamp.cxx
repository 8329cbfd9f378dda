#include "file_stamp.h"

#include <chrono>
#include <system_error>

namespace bindpose
{

FileStamp::FileStamp(const std::string& path, Time read_begin) : path_(path)
{
  constexpr std::chrono::milliseconds clock_step(100); // longer than the resolution of file times
  std::error_code no_size, no_time;
  this->size_ = std::filesystem::file_size(path, no_size);
  this->written_ = std::filesystem::last_write_time(path, no_time);
  this->is_settled_ = !no_size && !no_time && read_begin - this->written_ > clock_step;
}

bool FileStamp::has_content_of(const FileStamp& stored) const
{
  return stored.is_settled_ && stored.path_ == this->path_ && stored.size_ == this->size_ &&
    stored.written_ == this->written_;
}

} // namespace bindpose
