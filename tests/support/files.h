#ifndef bindpose_tests_support_files_h
#define bindpose_tests_support_files_h

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include <unistd.h>

namespace bindpose::test
{

/// A temporary folder for one test, removed by the destructor.
class Folder
{
public:
  Folder()
  {
    std::string pattern = (std::filesystem::temp_directory_path() / "bindpose-XXXXXX").string();
    if (mkdtemp(pattern.data()))
    {
      this->path_ = pattern;
    }
  }
  ~Folder() { std::filesystem::remove_all(this->path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string operator/(const std::string& name) const { return this->path_ + "/" + name; }
  std::string path() const { return this->path_; }

  /// Write a text to a file and return its path.
  std::string write(const std::string& name, const std::string& text) const
  {
    std::ofstream(*this / name, std::ios::binary) << text;
    return *this / name;
  }
  std::string read(const std::string& name) const
  {
    std::ifstream file(*this / name, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  std::size_t number_of_files() const
  {
    const auto files = std::filesystem::directory_iterator(this->path_);
    return static_cast<std::size_t>(std::distance(begin(files), end(files)));
  }

private:
  std::string path_;
};

} // namespace bindpose::test

#endif
