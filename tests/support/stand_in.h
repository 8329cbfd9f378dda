#ifndef bindpose_tests_support_stand_in_h
#define bindpose_tests_support_stand_in_h

#include "support/environment.h"
#include "support/files.h"

#include <string>

#include <sys/stat.h>

namespace bindpose::test
{

/// Replaces a program by a shell script for the lifetime of the object. The caller names the
/// environment variable from which the path of the program is read. The constructor sets this
/// variable to the path of the script.
class FakeProgram
{
public:
  FakeProgram(const char* variable, const std::string& script)
    : path_(this->folder_.write("stand-in", "#!/bin/sh\n" + script)),
      program_(variable, this->path_)
  {
    ::chmod(this->path_.c_str(), 0755);
  }

  /// Return the folder that contains the script. The script may write into it.
  const Folder& folder() const { return this->folder_; }

private:
  Folder folder_;
  std::string path_;
  Environment program_;
};

} // namespace bindpose::test

#endif
