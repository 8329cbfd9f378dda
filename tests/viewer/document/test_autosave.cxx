// Autosave: if a process is killed at any moment, no saved work is lost and no partial file is
// left.
#include "save_loop.h"

#include "support/files.h"

#include <QDir>
#include <QElapsedTimer>
#include <QFile>
#include <QProcess>
#include <QThread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <random>

using namespace bindpose;

namespace
{
void start(QProcess& process, const char* what, const std::string& where)
{
  process.setProcessChannelMode(QProcess::ForwardedErrorChannel);
  process.start(QCoreApplication::applicationFilePath(), { what, QString::fromStdString(where) });
  ASSERT_TRUE(process.waitForStarted());
}

void kill_now(QProcess& process)
{
  process.kill(); // this sends SIGKILL
  process.waitForFinished();
}
} // namespace

TEST(Saving, AKillAtAnyMomentLeavesAWholeSession)
{
  const test::Folder folder;
  const std::string path = folder / "work.bindpose";
  const std::string states[2] = { test::fingerprint(test::example_work(0)),
    test::fingerprint(test::example_work(1)) };
  std::mt19937 random(7);
  int found[2] = { 0, 0 };
  for (int kill = 0; kill < 40; ++kill)
  {
    QProcess process;
    start(process, "--save-for-ever", path);
    ASSERT_TRUE(process.waitForReadyRead(30000)); // the process has saved once
    QThread::usleep(random() % 100000);
    kill_now(process);
    Session session;
    const Status status = read_session(QString::fromStdString(path), session);
    ASSERT_TRUE(status.ok()) << status.message;
    EXPECT_TRUE(session.notes.isEmpty()) << session.notes.join(' ').toStdString();
    const std::string restored_state = test::fingerprint(session.work);
    ASSERT_TRUE(restored_state == states[0] || restored_state == states[1]);
    ++found[restored_state == states[1]];
  }
  // Each of the two states must be found after at least 6 of the 40 kills.
  EXPECT_GT(found[0], 5);
  EXPECT_GT(found[1], 5);
  // The next complete save removes the files that the killed processes left behind.
  Session session;
  session.work = test::example_work(0);
  ASSERT_TRUE(SessionFile().write(QString::fromStdString(path), session).ok());
  EXPECT_EQ(folder.number_of_files(), 2u);
}

TEST(Autosaving, WhatAKilledProcessHadIsFoundOnce)
{
  const test::Folder folder;
  const QString root = QString::fromStdString(folder / "recovery");
  qputenv("BINDPOSE_AUTOSAVE_SECONDS", "0.1");
  QProcess process;
  start(process, "--autosave-for-ever", root.toStdString());
  QElapsedTimer clock;
  clock.start();
  const auto sessions = [&root]
  {
    int count = 0;
    for (const QString& name : QDir(root).entryList(QDir::Dirs | QDir::NoDotAndDotDot))
    {
      count += QFile::exists(root + '/' + name + "/work.bindpose");
    }
    return count;
  };
  while (sessions() == 0 && clock.elapsed() < 30000)
  {
    QThread::msleep(10);
  }
  ASSERT_EQ(sessions(), 1);
  EXPECT_EQ(RecoveredWork::find(root), nullptr) << "its process lives";
  kill_now(process);
  {
    const auto found = RecoveredWork::find(root);
    ASSERT_NE(found, nullptr);
    Session session;
    const Status status = read_session(found->path(), session);
    ASSERT_TRUE(status.ok()) << status.message;
    EXPECT_EQ(test::fingerprint(session.work), test::fingerprint(test::example_work(1)));
    EXPECT_EQ(session.saved_as, "/somewhere/else.bindpose");
    EXPECT_LT(found->time().secsTo(QDateTime::currentDateTime()), 60);
    EXPECT_EQ(RecoveredWork::find(root), nullptr) << "somebody else has it already";
  }
  // The previous RecoveredWork object was destroyed, which has unlocked the work, so the work is
  // found again. After the work is removed, nothing is found.
  auto found = RecoveredWork::find(root);
  ASSERT_NE(found, nullptr);
  found->remove();
  found.reset();
  EXPECT_EQ(RecoveredWork::find(root), nullptr);
  EXPECT_TRUE(QDir(root).isEmpty());
}

TEST(Autosaving, TheIntervalIsAMinuteOrWhatTheEnvironmentSays)
{
  qunsetenv("BINDPOSE_AUTOSAVE_SECONDS");
  EXPECT_EQ(Autosave::interval(), 60.0);
  qputenv("BINDPOSE_AUTOSAVE_SECONDS", "2.5");
  EXPECT_EQ(Autosave::interval(), 2.5);
  for (const char* nonsense : { "soon", "-1", "nan" })
  {
    qputenv("BINDPOSE_AUTOSAVE_SECONDS", nonsense);
    EXPECT_EQ(Autosave::interval(), 60.0) << nonsense;
  }
}

TEST(Autosaving, AnEndAsItShouldBeLeavesNothing)
{
  const test::Folder folder;
  const QString root = QString::fromStdString(folder.path());
  {
    Autosave autosave([] { return Session(); }, root);
    EXPECT_EQ(folder.number_of_files(), 0u); // there is no work to back up yet
    EXPECT_EQ(autosave.path(), "");
    ASSERT_TRUE(autosave.save().ok());
    EXPECT_EQ(folder.number_of_files(), 1u);
    EXPECT_TRUE(QFile::exists(autosave.path()));
    EXPECT_EQ(RecoveredWork::find(root), nullptr);
  }
  EXPECT_EQ(folder.number_of_files(), 0u);
}

TEST(Autosaving, UnchangedWeightsAreNotWrittenAgain)
{
  const test::Folder folder;
  Session session;
  session.work = test::example_work(0);
  Autosave autosave([&session] { return session; }, QString::fromStdString(folder.path()));
  ASSERT_TRUE(autosave.save().ok());
  const QDir own_folder(QFileInfo(autosave.path()).absolutePath());
  const QStringList before = own_folder.entryList({ "work.surface-*" });
  ASSERT_EQ(before.size(), 1);
  const QDateTime time = QFileInfo(own_folder.filePath(before.front())).lastModified();
  QThread::msleep(20);
  session.work.pose[0].stretch = 1.5;
  ASSERT_TRUE(autosave.save().ok());
  EXPECT_EQ(own_folder.entryList({ "work.surface-*" }), before);
  EXPECT_EQ(QFileInfo(own_folder.filePath(before.front())).lastModified(), time);
  // After a change of the weights, new files replace the old ones.
  session.work = test::example_work(1);
  ASSERT_TRUE(autosave.save().ok());
  const QStringList after = own_folder.entryList({ "work.surface-*" });
  EXPECT_EQ(after.size(), 1);
  EXPECT_NE(after, before);
}

TEST(Autosaving, AFolderThatCannotBeWrittenIsToldAboutOnce)
{
  Autosave autosave([] { return Session(); }, "/proc/no/such/folder");
  QString message;
  QObject::connect(
    &autosave, &Autosave::failed, [&message](const QString& text) { message = text; });
  EXPECT_FALSE(autosave.save().ok());
  EXPECT_NE(message.indexOf("not being backed up"), -1) << message.toStdString();
}

namespace
{
/// Open a bound document with 82,000 triangles and 20 handles.
void open_large(Document& document)
{
  const TriangleMesh mesh = test::sphere(6);
  Handles handles(20);
  for (std::size_t k = 0; k < handles.size(); ++k)
  {
    handles[k].name = "p" + std::to_string(k);
    handles[k].head = handles[k].tail = Vec3(std::cos(k), std::sin(k), 0.01 * k);
  }
  ASSERT_TRUE(document.set_mesh(to_polydata(mesh.points, mesh.triangles), "ball").ok());
  ASSERT_TRUE(document.set_handles(to_polydata(handles), "handles").ok());
  test::bind(document, 0.0);
}

void make_large(Session& session)
{
  Document document;
  ASSERT_NO_FATAL_FAILURE(open_large(document));
  session.work = document.work();
}

/// Store messages about failures of the autosave in `message`.
void store_failures(Autosave& autosave, QString& message)
{
  QObject::connect(
    &autosave, &Autosave::failed, [&message](const QString& text) { message = text; });
}
} // namespace

/// Return the files with results below a folder, and the times of their last changes.
std::map<std::string, std::filesystem::file_time_type> companions_below(const std::string& folder)
{
  std::map<std::string, std::filesystem::file_time_type> times;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
  {
    if (entry.is_regular_file() && entry.path().extension() != ".bindpose")
    {
      times[entry.path().string()] = entry.last_write_time();
    }
  }
  return times;
}

/// Measures the times of a backup after a bind and after a drag. The weights are written once.
TEST(Autosaving, WritesWeightsOnce)
{
  const test::Folder folder;
  Document document;
  ASSERT_NO_FATAL_FAILURE(open_large(document));
  const auto session = [&document]
  {
    Session result;
    result.work = document.work();
    return result;
  };
  Autosave autosave(session, QString::fromStdString(folder.path()));
  ASSERT_TRUE(autosave.save().ok());
  const double after_a_bind = autosave.milliseconds();
  const double written_after_a_bind = autosave.writing_milliseconds();
  const auto companions = companions_below(folder.path());
  EXPECT_FALSE(companions.empty());
  document.set_mode(0, 1);
  ASSERT_TRUE(autosave.save().ok());
  std::printf("autosave after a bind: %.1f ms of the window, %.1f ms beside it; after a drag %.1f "
              "and %.1f ms\n",
    after_a_bind, written_after_a_bind, autosave.milliseconds(), autosave.writing_milliseconds());
  EXPECT_EQ(companions_below(folder.path()), companions);
}

TEST(Autosaving, WhatIsAskedForDuringACopyFollowsItAndTheLastStateIsKept)
{
  const test::Folder folder;
  Session session;
  ASSERT_NO_FATAL_FAILURE(make_large(session));
  Autosave autosave([&session] { return session; }, QString::fromStdString(folder.path()));
  autosave.begin_save();
  EXPECT_TRUE(autosave.is_saving());
  for (int change = 1; change <= 5; ++change)
  {
    session.work.name = QString("state %1").arg(change);
    session.work.pose[0].stretch = 1.0 + change;
    autosave.begin_save();
  }
  ASSERT_TRUE(autosave.wait().ok());
  EXPECT_FALSE(autosave.is_saving());
  Session found;
  ASSERT_TRUE(read_session(autosave.path(), found).ok());
  EXPECT_EQ(test::fingerprint(found.work), test::fingerprint(session.work));
  // The earlier writers have finished, but their events have not been processed. These events must
  // not affect the next writer.
  autosave.begin_save();
  QCoreApplication::processEvents();
  EXPECT_TRUE(autosave.wait().ok());
}

TEST(Autosaving, TheEndWaitsForWhatIsBeingWrittenAndLeavesNothing)
{
  const test::Folder folder;
  Session session;
  ASSERT_NO_FATAL_FAILURE(make_large(session));
  {
    Autosave autosave([&session] { return session; }, QString::fromStdString(folder.path()));
    autosave.begin_save();
  }
  EXPECT_EQ(folder.number_of_files(), 0u);
}

TEST(Autosaving, AWriterThatFailsIsToldAbout)
{
  const test::Folder folder;
  Session session;
  session.work = test::example_work(0);
  Autosave autosave([&session] { return session; }, QString::fromStdString(folder.path()));
  QString message;
  store_failures(autosave, message);
  ASSERT_TRUE(autosave.save().ok());
  EXPECT_EQ(message, "");
  // The backup folder is replaced by a file, so a backup fails.
  const QString own_folder = QFileInfo(autosave.path()).absolutePath();
  ASSERT_TRUE(QDir(own_folder).removeRecursively());
  folder.write(QFileInfo(own_folder).fileName().toStdString(), "no folder");
  autosave.begin_save();
  EXPECT_FALSE(autosave.wait().ok());
  EXPECT_NE(message.indexOf("not being backed up"), -1) << message.toStdString();
  std::filesystem::remove(folder / QFileInfo(own_folder).fileName().toStdString());
}

/// Measures how much work is lost when the process is killed. The work changes every 20 ms, and
/// backups are made at most 0.2 s after a change.
TEST(Autosaving, AKillLosesAtMostTheIntervalAndTheWriting)
{
  const test::Folder folder;
  qputenv("BINDPOSE_AUTOSAVE_SECONDS", "0.2");
  std::mt19937 random(11);
  double maximum_loss = 0.0;
  for (int kill = 0; kill < 12; ++kill)
  {
    const QString root = QString::fromStdString(folder / ("run" + std::to_string(kill)));
    QProcess process;
    start(process, "--change-for-ever", root.toStdString());
    ASSERT_TRUE(process.waitForReadyRead(30000));
    QThread::msleep(600 + random() % 500);
    const double kill_time = test::seconds_now();
    kill_now(process);
    const auto found = RecoveredWork::find(root);
    ASSERT_NE(found, nullptr);
    Session session;
    ASSERT_TRUE(read_session(found->path(), session).ok());
    maximum_loss = std::max(maximum_loss, kill_time - session.work.pose[0].stretch);
  }
  std::printf("lost at most %.2f s with copies every 0.2 s\n", maximum_loss);
  EXPECT_GT(maximum_loss, 0.0);
  EXPECT_LT(maximum_loss, 0.2 + 2.0); // a busy machine writes slowly
}
