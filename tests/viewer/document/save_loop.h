#ifndef bindpose_tests_viewer_document_save_loop_h
#define bindpose_tests_viewer_document_save_loop_h

// Functions that run in separate processes, which the autosave tests start and then kill.

#include "work_test.h"

#include "document/autosave.h"

#include <QCoreApplication>
#include <QDateTime>
#include <QTimer>

#include <cstdio>

namespace bindpose::test
{

/// Return one of two different states of the work, with different weights, poses and names. The
/// loops below save them alternately.
inline Work example_work(int index)
{
  Document document;
  open_bound_document(document);
  bind(document, index);
  document.set_mode(index, 1);
  Work work = document.work();
  work.name = index == 0 ? "even" : "odd";
  return work;
}

/// Save to a session file repeatedly until the process is killed.
inline int save_until_killed(const char* path)
{
  SessionFile file;
  Session sessions[2];
  sessions[0].work = example_work(0);
  sessions[1].work = example_work(1);
  for (int k = 0;; ++k)
  {
    if (!file.write(path, sessions[k % 2]).ok())
    {
      return 1;
    }
    if (k == 0)
    {
      std::puts("saved");
      std::fflush(stdout);
    }
  }
}

/// Save one unchanged session with Autosave in the folder `root`, then wait until the process is
/// killed.
inline int autosave_until_killed(const char* root)
{
  Session session;
  session.work = example_work(1);
  session.saved_as = "/somewhere/else.bindpose";
  Autosave autosave([&session] { return session; }, root);
  autosave.schedule_save();
  return QCoreApplication::exec();
}

inline double seconds_now()
{
  return 1e-3 * static_cast<double>(QDateTime::currentMSecsSinceEpoch() % (1LL << 40));
}

/// Change the work every 20 ms until the process is killed, while Autosave saves the work in the
/// folder `root`. A change sets the stretch of the first handle to the current time in seconds.
inline int change_until_killed(const char* root)
{
  Session session;
  session.work = example_work(1);
  Autosave autosave([&session] { return session; }, root);
  QTimer changes;
  QObject::connect(&changes, &QTimer::timeout,
    [&]
    {
      session.work.pose[0].stretch = seconds_now();
      autosave.schedule_save();
    });
  changes.start(20);
  std::puts("begun");
  std::fflush(stdout);
  return QCoreApplication::exec();
}

} // namespace bindpose::test

#endif
