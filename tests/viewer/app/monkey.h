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

/// Plays with a window: clicks, drags, keys, the wheel, entries of the menus, options, panels,
/// buttons, binds and cancels, undo and redo, other sizes, other files; anything but the end of the
/// program. The same seed does the same, but for what time decides. Dialogs are closed.
class Monkey
{
public:
  Monkey(MainWindow* window, unsigned seed, std::vector<QString> files);

  /// So many random events, and what they have asked for.
  void play(int events);
  /// The buttons are let go, what plays stops, what runs has ended: the window is one to look at.
  void rest();

  long long events() const { return this->events_; }
  /// How often each kind of event came.
  const std::map<std::string, long long>& counts() const { return this->counts_; }
  /// What it did last, the latest at the end.
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
