#ifndef tour_player_h
#define tour_player_h

#include "window_hand.h"
#include "tour.h"

#include <QElapsedTimer>
#include <QImage>
#include <QObject>

#include <nlohmann/json.hpp>

#include <functional>
#include <memory>
#include <string>

class MainWindow;

/// What `bindpose view --play` is asked for.
struct TourRequest
{
  std::string path; ///< of the tour
  std::string folder; ///< for pictures and tour.json; empty: only checks are made
  double seconds = 0.0; ///< at most; 0: what the tour says
  bool overwrite = false;
};

/// Plays a tour in a window, as a person would, and says where it goes wrong: a step that cannot be
/// done, a picture with nothing in it, a check that misses, a dialog that nobody answers, too long
/// a time. Everything runs in the window's own event loop.
/// What the display's mouse and keyboard do meanwhile does not count; the window can be closed.
class TourPlayer
{
public:
  /// @param folder  of the tour: files to open are looked for there first, then where the program
  ///                was started
  TourPlayer(MainWindow* window, const bindpose::Tour& tour, const std::string& folder);

  /// invalid_input, one sentence that names the step, when something goes wrong; what was written
  /// before stays, tour.json included.
  bindpose::Status play(const TourRequest& request);

  /// Of tour.json.
  const nlohmann::ordered_json& record() const { return this->record_; }

private:
  QString perform(const bindpose::TourStep& step);
  QString answer_dialogs(const std::function<QString()>& what, const std::string& answer);
  QString find(const bindpose::TourPlace& place, QPoint& at) const;
  QString use_mouse(const bindpose::TourStep& step);
  QString open(const std::string& file);
  QString choose(const bindpose::TourStep& step);
  QString wait(const bindpose::TourStep& step);
  QString check(const bindpose::TourStep& step);
  QString screenshot(const bindpose::TourStep& step);
  QString film_frame();
  QString write(const QImage& picture, const std::string& name);
  nlohmann::ordered_json values() const;
  QImage grab(bindpose::TourPart part, int width);
  void let_draw();
  QString fit_view();
  double left() const;
  QString out_of_time() const;
  bindpose::Status write_record(const TourRequest& request) const;

  MainWindow* window_;
  const bindpose::Tour& tour_;
  std::string tour_folder_;
  std::string folder_;
  bool overwrite_ = false;
  WindowHand hand_;
  QElapsedTimer clock_;
  double seconds_ = 0.0;
  double last_seconds_ = 0.0, last_cpu_seconds_ = 0.0; ///< of the last step
  double first_picture_ = -1.0, first_picture_cpu_ = 0.0;
  bindpose::TourStep film_; ///< its text is empty when there is none
  int frames_ = 0;
  nlohmann::ordered_json record_;
  QObject context_; ///< of connections
  std::unique_ptr<QObject> hands_off_; ///< of the display's own mouse and keyboard
};

#endif
