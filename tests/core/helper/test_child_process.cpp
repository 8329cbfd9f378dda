// Child processes. The tests check the reported exit codes and signals, the limits of memory and
// time, and that no process of the child's process group survives.
#include "helper/child_process.h"

#include "support/cancel_later.h"
#include "support/files.h"
#include "support/processes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

using namespace bindpose;
using testing::ElementsAre;
using testing::HasSubstr;

namespace
{
class Shell
{
public:
  explicit Shell(const std::string& script)
  {
    this->request.name = "the shell";
    this->request.path = "/bin/sh";
    this->request.arguments = { "-c", script };
  }

  Status run(ExecutionContext* context = nullptr)
  {
    ExecutionContext own;
    return run_child(
      context ? *context : own, this->request,
      [&](const std::string& line) { this->lines.push_back(line); }, this->end);
  }

  ChildRequest request;
  ChildEnd end;
  std::vector<std::string> lines;
};

bool wait_for_exit(const std::string& process)
{
  return test::wait_until([&] { return test::has_exited(std::stoi(process)); });
}
} // namespace

TEST(ChildProcess, LinesOfBothOutputsArrive)
{
  Shell shell("echo one; echo two >&2; printf three; cat; echo; printf 'no end'");
  ASSERT_TRUE(shell.run().ok());
  EXPECT_THAT(shell.lines, ElementsAre("one", "two", "three"));
  EXPECT_EQ(shell.end.failure, "");
}

TEST(ChildProcess, EndsAreTold)
{
  Shell seven("exit 7");
  ASSERT_TRUE(seven.run().ok());
  EXPECT_EQ(seven.end.failure, "failed with exit code 7");
  EXPECT_FALSE(seven.end.killed_by_signal);
  Shell crash("kill -SEGV $$");
  ASSERT_TRUE(crash.run().ok());
  EXPECT_THAT(crash.end.failure, HasSubstr("signal 11"));
  EXPECT_TRUE(crash.end.killed_by_signal);
  Shell nowhere("true");
  nowhere.request.path = "/nowhere/program";
  const Status status = nowhere.run();
  EXPECT_EQ(status.code, StatusCode::unavailable);
  EXPECT_THAT(status.message, HasSubstr("/nowhere/program cannot be started"));
}

TEST(ChildProcess, RunsInItsFolder)
{
  const test::Folder folder;
  Shell shell("pwd -P; cat /dev/stdin");
  shell.request.folder = folder.path();
  ASSERT_TRUE(shell.run().ok());
  EXPECT_THAT(shell.lines, ElementsAre(std::filesystem::canonical(folder.path()).string()));
}

TEST(ChildProcess, MemoryIsLimitedFromOutside)
{
  // The memory limit may take effect shortly after the start of the process.
  Shell shell("sleep 0.2; ulimit -v; ulimit -c");
  shell.request.memory_limit = 500;
  ASSERT_TRUE(shell.run().ok());
  EXPECT_THAT(shell.lines, ElementsAre("512000", "0"));
}

TEST(ChildProcess, ItsGroupIsKilledWhateverTheEnd)
{
  const std::string start_child_script = "sleep 60 & echo $!; ";
  std::vector<int> groups;
  {
    Shell shell(start_child_script + "exit 0");
    shell.request.started = [&](int group) { groups.push_back(group); };
    ASSERT_TRUE(shell.run().ok());
    ASSERT_EQ(shell.lines.size(), 1u);
    EXPECT_TRUE(wait_for_exit(shell.lines[0])) << "after its own end";
  }
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_GT(groups[0], 0);
  EXPECT_EQ(groups[1], 0) << "nothing is left";
  {
    Shell shell(start_child_script + "wait");
    shell.request.time_limit = 0.3;
    const Status status = shell.run();
    EXPECT_EQ(status.code, StatusCode::internal_error);
    EXPECT_EQ(status.message, "the shell was stopped at its time limit of 0.3 s");
    ASSERT_EQ(shell.lines.size(), 1u);
    EXPECT_TRUE(wait_for_exit(shell.lines[0])) << "after the time limit";
  }
  {
    Shell shell(start_child_script + "wait");
    ExecutionContext context;
    const test::DelayedCancel canceler(context, 300);
    EXPECT_EQ(shell.run(&context).code, StatusCode::canceled);
    ASSERT_EQ(shell.lines.size(), 1u);
    EXPECT_TRUE(wait_for_exit(shell.lines[0])) << "after a cancel";
    EXPECT_EQ(shell.run(&context).code, StatusCode::canceled);
    EXPECT_EQ(shell.lines.size(), 1u) << "canceled before: not started";
  }
}

TEST(ChildProcess, OnlyItsOwnProcessorTimeCounts)
{
  Shell idle("sleep 0.5");
  idle.request.processor_limit = 0.2;
  EXPECT_TRUE(idle.run().ok());
  EXPECT_FALSE(idle.end.timed_out);

  Shell busy("while :; do :; done");
  busy.request.processor_limit = 0.2;
  busy.request.time_limit = 60.0;
  const Status status = busy.run();
  EXPECT_EQ(status.code, StatusCode::internal_error);
  EXPECT_EQ(status.message, "the shell was stopped at its time limit of 0.2 s of processor time");
  EXPECT_TRUE(busy.end.timed_out);
  EXPECT_GE(busy.end.seconds, 0.19);
}
