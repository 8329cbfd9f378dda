#include "file_kind.h"

#include <algorithm>
#include <sstream>

namespace bindpose
{

std::string file_extension(const std::string& path)
{
  const std::size_t name = path.find_last_of('/') + 1; // start of the name; 0 if there is no '/'
  const std::size_t dot = path.find_last_of('.');
  if (dot == std::string::npos || dot < name)
  {
    return {};
  }
  std::string extension = path.substr(dot + 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return extension;
}

bool is_listed(const std::string& word, const std::string& list)
{
  std::istringstream words(list);
  for (std::string entry; words >> entry;)
  {
    if (entry == word)
    {
      return true;
    }
  }
  return false;
}

Status check_extension(const std::string& path, const std::string& list)
{
  if (path.empty())
  {
    return Status::invalid_input("the file name is empty");
  }
  const std::string extension = file_extension(path);
  if (is_listed(extension, list))
  {
    return {};
  }
  std::string expected;
  std::istringstream words(list);
  for (std::string entry; words >> entry;)
  {
    expected += (expected.empty() ? "." : ", .") + entry;
  }
  return Status::invalid_input(path +
    (extension.empty() ? " has no file name extension" : " has an unknown file name extension") +
    "; expected " + expected);
}

} // namespace bindpose
