#ifndef app_window_exports_h
#define app_window_exports_h

#include "base/status.h"

#include <QObject>

class Document;

namespace app::parts
{
class ErrorBar;
class NoticeBar;
} // namespace app::parts
namespace app::posing
{
class PoseController;
} // namespace app::posing
namespace app::view
{
class Viewport;
} // namespace app::view

namespace app::window
{

class WindowSessions;

/// The parts of the window that Exports uses.
struct ExportParts
{
  QWidget* window; ///< parent of the dialogs
  Document* document;
  view::Viewport* viewport;
  posing::PoseController* posing;
  const WindowSessions* sessions; ///< provides the name of the open data
  parts::ErrorBar* errors;
  parts::NoticeBar* bar; ///< shows the path of the written file
};

/// The exports of the menu File: the visible shape, the rig (mesh, weights and handles), the pose,
/// an image of the 3D view, and key frames as a film or another animation. After an export, a bar
/// shows the path of the file and a button that opens its folder.
class Exports : public QObject
{
  Q_OBJECT

public:
  explicit Exports(const ExportParts& parts);

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
  /// Write a .png file with the image that Viewport::take_picture() returns.
  bool save_picture(const QString& path, int scale, bool transparent);

Q_SIGNALS:
  /// Emitted when the user wants to see the key frames.
  void timeline_requested();

private:
  QString ask(const QString& title, const QString& filter, const QString& extension);
  bool finish(const QString& path, const bindpose::Status& status, const QString& remark = {});
  void show_result(const QString& path, const QString& remark);
  void show_progress(double fraction);
  void film_finished();
  void show_in_folder(const QString& path);

  ExportParts parts_;
  QString folder_; // folder of the last export
  bool is_showing_progress_ = false;
};

} // namespace app::window

#endif
