#ifndef cached_file_h
#define cached_file_h

#include "base/execution.h"
#include "file_stamp.h"

#include <algorithm>
#include <string>
#include <vector>

namespace bindpose
{

/// Caches the content of a file for a filter that is updated frame by frame. The file is read again
/// if it or one of its buffer files has changed.
/// @tparam Data the content; its member `buffer_files` lists these other files
template <typename Data>
class CachedFile
{
public:
  /// Reads a file. Status reader(context, path, data).
  using Reader = Status (*)(ExecutionContext& context, const std::string& path, Data& data);

  explicit CachedFile(Reader reader) : reader_(reader) {}

  Status read(ExecutionContext& context, const std::string& path)
  {
    const FileStamp::Time read_begin = FileStamp::Time::clock::now();
    // Files that change during the read get stamps that are not valid for the next call.
    const auto stamps_of = [&](const std::vector<std::string>& buffer_files)
    {
      std::vector<FileStamp> stamps{ FileStamp(path, read_begin) };
      for (const std::string& file : buffer_files)
      {
        stamps.emplace_back(file, read_begin);
      }
      return stamps;
    };
    const std::vector<FileStamp> stamps = stamps_of(this->data_.buffer_files);
    const bool is_unchanged =
      std::equal(stamps.begin(), stamps.end(), this->stamps_.begin(), this->stamps_.end(),
        [](const FileStamp& now, const FileStamp& stored) { return now.has_content_of(stored); });
    if (!is_unchanged)
    {
      this->status_ = this->reader_(context, path, this->data_);
      this->stamps_ = stamps_of(this->data_.buffer_files);
      if (!this->status_.ok())
      {
        this->stamps_.clear();
      }
    }
    return this->status_;
  }

  /// Return the data of the last read(). It is shared and must not be modified.
  const Data& data() const { return this->data_; }

private:
  Reader reader_;
  /// Stamps of the file from which data_ was read and of its buffer files.
  std::vector<FileStamp> stamps_;
  Status status_;
  Data data_;
};

} // namespace bindpose

#endif
