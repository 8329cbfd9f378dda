#ifndef bindpose_tests_fuzz_memory_file_h
#define bindpose_tests_fuzz_memory_file_h

#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include <sys/mman.h>
#include <unistd.h>

namespace bindpose::test
{

/// A file in memory, for readers that take a path.
class MemoryFile
{
public:
  explicit MemoryFile(std::string_view content) : file_(::memfd_create("fuzz", MFD_CLOEXEC))
  {
    const auto size = static_cast<ssize_t>(content.size());
    if (this->file_ < 0 || ::write(this->file_, content.data(), content.size()) != size)
    {
      std::perror("memory file");
      std::abort();
    }
  }
  ~MemoryFile() { ::close(this->file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int descriptor() const { return this->file_; }
  std::string path() const { return "/proc/self/fd/" + std::to_string(this->file_); }

private:
  int file_;
};

} // namespace bindpose::test

#endif
