#ifndef app_tour_tour_player_h
#define app_tour_tour_player_h

#include "app/tour/tour.h"
#include "app/tour/simulated_user.h"

#include <QElapsedTimer>
#include <QImage>
#include <QObject>

#include <nlohmann/json.hpp>

#include <functional>
#include <memory>
#include <string>

namespace app::window
{
class MainWindow;
} // namespace app::window

namespace app::tour
{

/// The arguments of `bindpose view --play`.
struct TourRequest
{
  std::string path; ///< path of the tour file
  std::string folder; ///< folder for screenshots and tour.json; empty: only the checks are run
  double seconds = 0.0; ///< maximum duration; 0: the maximum duration that the tour specifies
  bool overwrite = false;
};

/// Plays a tour in a window with simulated user input, and reports the first failure. Failures are:
/// a step that is impossible, an empty screenshot, a failed check, a dialog without an answer, or a
/// timeout.
/// Everything runs in the window's own event loop. Events of the real mouse and keyboard are
/// ignored, but the window can be closed.
class TourPlayer
{
public:
  /// @param folder  the folder of the tour file. Files to open are searched there first, then in
  /// the working directory.
  TourPlayer(window::MainWindow* window, const Tour& tour, const std::string& folder);

  /// Play the tour. At the first failure, stop and return invalid_input with a sentence that names
  /// the step. Screenshots that were already written are kept, and tour.json is written.
  bindpose::Status play(const TourRequest& request);

  /// Return the contents of tour.json.
  const nlohmann::ordered_json& record() const { return this->record_; }

private:
  QString perform(const TourStep& step);
  QString answer_dialogs(const std::function<QString()>& perform_step, const std::string& answer);
  QString find(const TourPosition& mouse_position, QPoint& position) const;
  QString use_mouse(const TourStep& step);
  QString open(const std::string& file);
  QString choose(const TourStep& step);
  QString wait(const TourStep& step);
  QString check(const TourStep& step);
  QString screenshot(const TourStep& step);
  QString film_frame();
  QString write(const QImage& picture, const std::string& name);
  nlohmann::ordered_json values() const;
  QImage grab(TourPart part, int width);
  void process_drawing();
  QString fit_view();
  double left() const;
  QString timeout_message() const;
  bindpose::Status write_record(const TourRequest& request) const;

  window::MainWindow* window_;
  const Tour& tour_;
  std::string tour_folder_;
  std::string folder_;
  bool overwrite_ = false;
  SimulatedUser user_;
  QElapsedTimer clock_;
  double time_limit_ = 0.0;
  /// Elapsed time and CPU time of the last step, in seconds.
  double last_seconds_ = 0.0, last_cpu_seconds_ = 0.0;
  double first_picture_ = -1.0, first_picture_cpu_ = 0.0;
  /// The step that began the current film. Its text is empty if no film is being recorded.
  TourStep film_;
  int frames_ = 0;
  nlohmann::ordered_json record_;
  QObject context_; ///< signal connections with this context end with the TourPlayer
  std::unique_ptr<QObject>
    real_input_filter_; ///< filters out events of the real mouse and keyboard
};

} // namespace app::tour

#endif
