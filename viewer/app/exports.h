#ifndef exports_h
#define exports_h

#include "base/status.h"

#include <QObject>

class MainWindow;
class NoticeBar;
class QFileDialog;

/// What the menu File writes besides sessions: the shape as it is seen, the rig, the pose, the
/// picture, and key frames as a film or another animation. The bar says what was written and
/// where, and opens that folder.
class Exports : public QObject
{
  Q_OBJECT

public:
  Exports(MainWindow* window, NoticeBar* bar);

  // ---- Ask where to, and write ----
  void ask_for_shape();
  void ask_for_rig();
  void ask_for_pose();
  void ask_for_picture();
  /// Says that there are no key frames, if so.
  void ask_for_film();

  // ---- Write, in place of a file that is there ----
  // False, with a sentence in the error bar: nothing was written.
  bool save_shape(const QString& path);
  /// The mesh at rest with its skin; the joints stand as the handles do.
  bool save_rig(const QString& path);
  bool save_pose(const QString& path);
  /// As Viewport::take_picture() has it (.png).
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
  QString folder_; // of the last export
  bool tells_progress_ = false;
};

#endif
