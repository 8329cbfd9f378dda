#ifndef bindpose_tests_viewer_app_monkey_h
#define bindpose_tests_viewer_app_monkey_h

#include "window_hand.h"

#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace bindpose::test
{

/// Sends random events to a window: clicks, drags, keys, the wheel, menu entries, options, panels,
/// buttons, binds and cancels, undo and redo, other sizes, other files; everything except quitting
/// the program. The same seed gives the same events, except where timing decides. Dialogs are
/// closed.
class Monkey
{
public:
  Monkey(MainWindow* window, unsigned seed, std::vector<QString> files);

  /// Send this number of random events and process their effects.
  void play(int events);
  /// Release the buttons, stop playback and cancel all computations, so that the window can be
  /// inspected.
  void rest();

  long long events() const { return this->events_; }
  /// Return the number of events of each kind.
  const std::map<std::string, long long>& counts() const { return this->counts_; }
  /// Return the last events, the latest at the end.
  std::string story() const;

private:
  void act();
  int pick(int count) { return static_cast<int>(this->random_() % static_cast<unsigned>(count)); }
  double number(double lowest, double highest);
  QPoint anywhere();
  Qt::MouseButton any_button();
  Qt::KeyboardModifiers any_held();
  void note(const std::string& kind, const QString& what);
  void drag();
  void any_key();
  void any_action();
  void any_option();
  void any_button_of_panels();

  MainWindow* window_;
  WindowHand hand_;
  std::mt19937 random_;
  std::vector<QString> files_;
  long long events_ = 0;
  std::map<std::string, long long> counts_;
  std::vector<std::string> last_;
};

} // namespace bindpose::test

#endif
