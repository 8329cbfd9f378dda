#ifndef bindpose_tests_support_watched_stand_in_h
#define bindpose_tests_support_watched_stand_in_h

#include "support/environment.h"
#include "support/files.h"
#include "support/processes.h"
#include "support/stand_in.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include <sys/types.h>

namespace bindpose::test
{

/// A script that replaces a program (FakeProgram). The destructor expects no temporary files, and
/// as many open file descriptors as at construction.
class WatchedFakeProgram : public FakeProgram
{
public:
  WatchedFakeProgram(const char* variable, const std::string& script)
    : FakeProgram(variable, script), variable_("TMPDIR", this->temporary_.path()),
      descriptors_(open_descriptors())
  {
  }
  ~WatchedFakeProgram()
  {
    EXPECT_EQ(open_descriptors(), this->descriptors_) << "a file, pipe or socket was left open";
    EXPECT_EQ(this->temporary_.number_of_files(), 0u) << "a temporary file was left";
  }

  /// Return the process id that the script wrote into the file "pid" in its folder.
  pid_t process() const { return std::atoi(this->folder().read("pid").c_str()); }
  /// Return the folder for temporary files.
  const Folder& temporary() const { return this->temporary_; }

private:
  Folder temporary_;
  Environment variable_;
  std::size_t descriptors_;
};

} // namespace bindpose::test

#endif
