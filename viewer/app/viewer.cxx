#include "viewer.h"

#include "main_window.h"
#include "style.h"
#include "window_sessions.h"

#include <QApplication>
#include <QSurfaceFormat>
#include <QVTKOpenGLNativeWidget.h>

int run_viewer(const std::vector<std::string>& files)
{
  // Qt wants these before the application.
  QApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
  QApplication::setAttribute(Qt::AA_UseHighDpiPixmaps);
  QSurfaceFormat::setDefaultFormat(QVTKOpenGLNativeWidget::defaultFormat());
  int argc = 1;
  char name[] = "bindpose";
  char* argv[] = { name, nullptr };
  QApplication application(argc, argv);
  QApplication::setApplicationName("bindpose"); // of the folder that recovered work is in
  QApplication::setApplicationDisplayName("Bindpose");
  apply_style(application);
  MainWindow window;
  window.show();
  window.sessions()->offer_recovery();
  for (const std::string& file : files)
  {
    window.open(QString::fromLocal8Bit(file.c_str()));
  }
  return QApplication::exec();
}
