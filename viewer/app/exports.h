#ifndef exports_h
#define exports_h

#include "base/status.h"

#include <QObject>

class MainWindow;
class NoticeBar;
class QFileDialog;

/// The exports of the menu File, except sessions: the visible shape, the rig (mesh, weights and
/// handles), the pose, an image of the 3D view, and key frames as a film or another animation. A
/// bar shows what was written and to which path, and can open the folder.
class Exports : public QObject
{
  Q_OBJECT

public:
  Exports(MainWindow* window, NoticeBar* bar);

  // ---- Ask for a path and write ----
  void ask_for_shape();
  void ask_for_rig();
  void ask_for_pose();
  void ask_for_picture();
  /// Ask for a path for a film. If there are no key frames, show a hint instead.
  void ask_for_film();

  // ---- Write, and replace an existing file ----
  // Return false, and show a sentence in the error bar, if nothing was written.
  bool save_shape(const QString& path);
  /// Write the mesh at rest with its skin (weights and joints). The joints have the pose of the
  /// handles.
  bool save_rig(const QString& path);
  bool save_pose(const QString& path);
  /// Write the image that Viewport::take_picture() returns to a .png file.
  bool save_picture(const QString& path, int scale, bool transparent);

private:
  QString ask(const QString& title, const QString& kinds, const QString& ending);
  bool finish(const QString& path, const bindpose::Status& status, const QString& remark = {});
  void tell(const QString& path, const QString& remark);
  void show_progress(double fraction);
  void film_finished();
  void show_in_folder(const QString& path);

  MainWindow* window_;
  NoticeBar* bar_;
  QString folder_; // folder of the last export
  bool tells_progress_ = false;
};

#endif
