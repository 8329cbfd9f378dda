#ifndef bindpose_tests_viewer_app_monkey_h
#define bindpose_tests_viewer_app_monkey_h

#include "app/tour/simulated_user.h"

#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace bindpose::test
{

/// Monkey test of a window. It sends random mouse, wheel and key events, and uses random menu
/// entries, options, panels and buttons. It also starts and cancels binds, undoes and redoes steps,
/// resizes the window and opens files. It does not quit the program, and it closes dialogs. The
/// same seed gives the same events, except if their effect depends on timing.
class Monkey
{
public:
  Monkey(app::window::MainWindow* window, unsigned seed, std::vector<QString> files);

  /// Send `events` random events and process their effects.
  void play(int events);
  /// Release the mouse buttons, stop playback and cancel all computations, so that the window can
  /// be inspected.
  void stop_activity();

  long long events() const { return this->events_; }
  /// Return the number of events of each kind.
  const std::map<std::string, long long>& counts() const { return this->counts_; }
  /// Return a text that lists the most recent events in the order in which they were sent.
  std::string event_log() const;

private:
  void perform_random_action();
  int pick(int count) { return static_cast<int>(this->random_() % static_cast<unsigned>(count)); }
  double number(double lowest, double highest);
  QPoint random_position();
  Qt::MouseButton random_button();
  Qt::KeyboardModifiers random_modifiers();
  void note(const std::string& kind, const QString& what);
  void drag();
  void press_random_key();
  void trigger_random_action();
  void choose_random_option();
  void click_random_button();

  app::window::MainWindow* window_;
  app::tour::SimulatedUser user_;
  std::mt19937 random_;
  std::vector<QString> files_;
  long long events_ = 0;
  std::map<std::string, long long> counts_;
  std::vector<std::string> last_events_;
};

} // namespace bindpose::test

#endif
