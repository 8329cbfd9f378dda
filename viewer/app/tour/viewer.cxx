#include "app/tour/viewer.h"

#include "app/handles/shape_handles.h"
#include "app/parts/style.h"
#include "app/window/main_window.h"
#include "app/window/window_sessions.h"

#include <QApplication>
#include <QFileInfo>
#include <QSurfaceFormat>
#include <QTemporaryDir>
#include <QVTKOpenGLNativeWidget.h>

namespace app::tour
{

namespace
{
/// Owns the QApplication, with the settings that the window needs.
class Application
{
public:
  Application()
  {
    QApplication::setApplicationName("bindpose"); // the recovery folder's path contains this name
    QApplication::setApplicationDisplayName("Bindpose");
    parts::apply_style(this->application_);
  }

private:
  /// Set the attributes that Qt requires before the application object is created.
  static int prepare()
  {
    QApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
    QApplication::setAttribute(Qt::AA_UseHighDpiPixmaps);
    QSurfaceFormat::setDefaultFormat(QVTKOpenGLNativeWidget::defaultFormat());
    return 1;
  }
  int argc_ = prepare();
  char name_[9] = "bindpose";
  char* argv_[2] = { name_, nullptr };
  QApplication application_{ argc_, argv_ };
};
} // namespace

void open_initial_files(window::MainWindow& window, const std::vector<InitialFile>& files)
{
  // Collect the errors, because opening the next file hides the error of the previous file.
  QStringList errors;
  for (const InitialFile& file : files)
  {
    if (!file.error.empty())
    {
      errors << QString::fromStdString(file.error);
    }
    else if (!window.open(
               QString::fromLocal8Bit(file.path.c_str()), file.data ? &*file.data : nullptr))
    {
      errors << window.error();
    }
  }
  if (!errors.isEmpty())
  {
    window.show_error(errors.join('\n'));
  }
}

int run_viewer(const std::vector<InitialFile>& files, bool auto_rig)
{
  const Application application;
  window::MainWindow window;
  window.show();
  window.findChild<window::WindowSessions*>()->offer_recovery();
  open_initial_files(window, files);
  if (auto_rig)
  {
    window.findChild<handles::ShapeHandles*>()->auto_rig();
  }
  return QApplication::exec();
}

bindpose::Status play_tour(
  const std::vector<InitialFile>& files, bool auto_rig, const TourRequest& request)
{
  Tour tour;
  const bindpose::Status status = read_tour(request.path, tour);
  if (!status.ok())
  {
    return status;
  }
  const QTemporaryDir settings_folder;
  for (const char* variable : { "XDG_CONFIG_HOME", "XDG_DATA_HOME" })
  {
    qputenv(variable, settings_folder.path().toLocal8Bit());
  }
  QApplication::setAttribute(Qt::AA_DontUseNativeDialogs);
  const Application application;
  window::MainWindow window;
  window.resize(tour.size[0], tour.size[1]);
  TourPlayer player(
    &window, tour, QFileInfo(QString::fromStdString(request.path)).path().toStdString());
  window.show();
  open_initial_files(window, files);
  if (!files.empty() && !window.error().isEmpty())
  {
    return bindpose::Status::invalid_input(window.error().toStdString());
  }
  if (auto_rig)
  {
    window.findChild<handles::ShapeHandles*>()->auto_rig();
  }
  return player.play(request);
}

} // namespace app::tour
