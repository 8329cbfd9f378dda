#ifndef bindpose_tests_support_stand_in_h
#define bindpose_tests_support_stand_in_h

#include "support/environment.h"
#include "support/files.h"

#include <string>

#include <sys/stat.h>

namespace bindpose::test
{

/// For the life of a test, a shell script is the program that an environment variable names.
class StandIn
{
public:
  StandIn(const char* variable, const std::string& script)
    : path_(this->folder_.write("stand-in", "#!/bin/sh\n" + script)),
      program_(variable, this->path_)
  {
    ::chmod(this->path_.c_str(), 0755);
  }

  /// The script lies in it, and may write there.
  const Folder& folder() const { return this->folder_; }

private:
  Folder folder_;
  std::string path_;
  Environment program_;
};

} // namespace bindpose::test

#endif
