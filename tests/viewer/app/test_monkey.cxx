// Monkey test: a window under random events stays responsive, all its numbers are finite, and no
// dialog stays open. Undoing all steps restores the initial state bit by bit.
#include "monkey.h"

#include "app/view/viewport.h"
#include "app/window/main_window.h"

#include "support/sanitized.h"
#include "viewer/document/work_test.h"

#include "vtkHandleSetWidget.h"
#include "vtkRenderWindow.h"

#include <QApplication>
#include <QElapsedTimer>
#include <QUndoStack>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

using namespace bindpose;
using test::fingerprints;

namespace
{
/// Return the number in an environment variable, or a default.
double setting(const char* name, double default_value)
{
  const char* text = std::getenv(name);
  return text ? std::atof(text) : default_value;
}

QString data(const char* name)
{
  return QString(BINDPOSE_TOURS) + "/data/" + name;
}

bool is_finite(const Pose& pose)
{
  return std::all_of(pose.begin(), pose.end(),
    [](const HandlePose& each) {
      return each.transform.allFinite() && std::isfinite(each.stretch) && each.twist.allFinite();
    });
}

bool is_finite(vtkPolyData* data)
{
  return !data || to_points(data).view().allFinite();
}

/// Reset the transforms of free handles, because these transforms are results of the solver, not
/// input of the user.
Pose without_free_transforms(Pose pose)
{
  for (HandlePose& each : pose)
  {
    if (each.mode == HandleMode::free)
    {
      each.transform = identity_affine();
    }
  }
  return pose;
}

/// Options that the program also sets by itself. A change of such an option is not an undo step, so
/// undo does not revert it.
const char* const automatic_options[] = { "show.column", "weights.column", "weights.what",
  "weights.raw", "tets.shown", "tets.colors", "defects.shown", "volume.level",
  "volume.isosurface" };

using Fingerprints = std::map<std::string, std::string>;

/// Return fingerprints of everything that the user has made or chosen.
Fingerprints user_fingerprints(const Document& document)
{
  Work work = document.work();
  for (const char* key : automatic_options)
  {
    work.options.remove(key);
  }
  return fingerprints(work);
}

/// Check the invariants of a window without pending work.
void check_window(app::window::MainWindow& window)
{
  const Document& document = *window.document();
  EXPECT_TRUE(is_finite(document.pose()));
  EXPECT_TRUE(is_finite(document.work().pose));
  EXPECT_TRUE(is_finite(document.handle_data()));
  EXPECT_TRUE(is_finite(window.shown()));
  EXPECT_EQ(document.pose().size(), document.handles().size());
  EXPECT_TRUE(same_pose(
    without_free_transforms(document.pose()), without_free_transforms(document.work().pose)))
    << "a pose that is in no step";
  EXPECT_EQ(QApplication::activeModalWidget(), nullptr);
  EXPECT_FALSE(window.findChild<app::view::Viewport*>()->handle_widget()->IsDragging());
  EXPECT_TRUE(window.isVisible());
}

/// Return a text that lists the fingerprints that differ.
std::string changed_parts(const Fingerprints& before, const Fingerprints& now)
{
  const auto fingerprint_of = [](const Fingerprints& all, const std::string& name)
  {
    const auto found = all.find(name);
    return found == all.end() ? std::string("nothing") : found->second;
  };
  Fingerprints all = before;
  all.insert(now.begin(), now.end());
  std::string text;
  for (const auto& [name, part] : all)
  {
    const std::string old_value = fingerprint_of(before, name),
                      new_value = fingerprint_of(now, name);
    text += old_value != new_value ? "  " + name + ": " + old_value + " to " + new_value : "";
  }
  return text;
}

std::string steps_of(const QUndoStack* history)
{
  std::string text;
  for (int k = 0; k < history->count(); ++k)
  {
    text += (k == history->index() ? " | " : ", ") + history->text(k).toStdString();
  }
  return text;
}

/// Return fingerprints without those of options that the program may set when it opens a file.
/// These options are `tets.other_side`, and the orientation and the normal of each plane. A plane
/// whose orientation is the same in `other` keeps its fingerprints.
Fingerprints without_options_of_opening(Fingerprints all, const Fingerprints& other)
{
  all.erase("option tets.other_side");
  for (const char* plane : { "volume", "tets", "weights" })
  {
    const std::string prefix = std::string("option ") + plane + ".";
    const auto own = all.find(prefix + "orientation");
    const auto others = other.find(prefix + "orientation");
    if (own == all.end() || others == other.end() || own->second != others->second)
    {
      all.erase(prefix + "orientation");
      all.erase(prefix + "normal");
    }
  }
  return all;
}

/// Undo all steps and redo them again; both must restore every bit.
void check_history(app::window::MainWindow& window, const Fingerprints& initial_fingerprints)
{
  QUndoStack* history = window.document()->history();
  SCOPED_TRACE("steps" + steps_of(history));
  const Fingerprints now = user_fingerprints(*window.document());
  const int index = history->index();
  history->setIndex(0);
  const Fingerprints undone = user_fingerprints(*window.document());
  EXPECT_EQ(changed_parts(without_options_of_opening(initial_fingerprints, undone),
              without_options_of_opening(undone, initial_fingerprints)),
    "")
    << "undo of everything";
  history->setIndex(index);
  EXPECT_EQ(changed_parts(now, user_fingerprints(*window.document())), "") << "redo of everything";
}
} // namespace

/// BINDPOSE_MONKEY_SECONDS is the duration in seconds (default 60). BINDPOSE_MONKEY_SEED is the
/// first seed.
TEST(Monkey, AWindowThatIsPlayedWithStaysSound)
{
  const double seconds = setting("BINDPOSE_MONKEY_SECONDS", 60.0);
  const auto first = static_cast<unsigned>(setting("BINDPOSE_MONKEY_SEED", 1.0));
  const std::vector<QString> files{ data("figure.off"), data("figure.tgf"),
    data("figure_weights.vtp"), data("figure_tets.vtu"), data("figure_winding.vti"),
    data("doll.png"), data("doll.tgf"), data("no_such.off") };
  long long events = 0;
  int bursts = 0, steps = 0;
  double slowest = 0.0;
  std::map<std::string, long long> counts;
  QElapsedTimer clock;
  clock.start();
  unsigned seed = first;
  for (; 1e-3 * static_cast<double>(clock.elapsed()) < seconds && !testing::Test::HasFailure();
       ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    app::window::MainWindow window;
    window.resize(720, 560);
    window.show();
    QApplication::setActiveWindow(&window);
    QApplication::processEvents();
    if (seed % 4 != 0) // every fourth window starts without a mesh
    {
      ASSERT_TRUE(window.open(data("figure_weights.vtp")));
      ASSERT_TRUE(window.open(data("figure.tgf")));
    }
    window.document()->history()->clear();
    const Fingerprints initial_fingerprints = user_fingerprints(*window.document());
    test::Monkey monkey(&window, seed, files);
    for (int burst = 0; burst < 6 && !testing::Test::HasFailure() &&
         1e-3 * static_cast<double>(clock.elapsed()) < seconds;
         ++burst)
    {
      monkey.play(50);
      monkey.stop_activity();
      EXPECT_TRUE(app::tour::wait_until([&] { return app::tour::is_idle(&window); }, 60.0))
        << "it never rests";
      QElapsedTimer answer; // time to process all pending events and draw one frame
      answer.start();
      QApplication::processEvents();
      window.findChild<app::view::Viewport*>()->renderWindow()->Render();
      slowest = std::max(slowest, 1e-3 * static_cast<double>(answer.elapsed()));
      check_window(window);
      check_history(window, initial_fingerprints);
      ++bursts;
      steps = std::max(steps, window.document()->history()->count());
      if (testing::Test::HasFailure())
      {
        std::printf("seed %u, after:\n%s", seed, monkey.event_log().c_str());
      }
    }
    events += monkey.events();
    for (const auto& [kind, count] : monkey.counts())
    {
      counts[kind] += count;
    }
  }
  std::printf("%lld events in %d bursts, seeds %u to %u, %.0f s; the longest history %d steps, the "
              "slowest answer %.2f s\n",
    events, bursts, first, seed - 1, 1e-3 * static_cast<double>(clock.elapsed()), steps, slowest);
  for (const auto& [kind, count] : counts)
  {
    std::printf("  %-14s %lld\n", kind.c_str(), count);
  }
  EXPECT_GT(events, 100);
  EXPECT_LT(slowest, test::sanitized ? 20.0 : 5.0);
}
