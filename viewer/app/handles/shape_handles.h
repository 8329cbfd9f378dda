#ifndef app_handles_shape_handles_h
#define app_handles_shape_handles_h

#include "app/parts/kernel_job.h"

#include "automatic/automatic_handles.h"

#include <QObject>

class Document;
class QAction;
class QMenu;
class QWidget;

namespace app::parts
{
class NoticeBar;
} // namespace app::parts

namespace app::handles
{

/// Creates handles that fit the shape, in the background: bones along the curve skeleton of the
/// shape, or points spread over the shape. The new handles replace the existing handles in one undo
/// step of the document.
class ShapeHandles : public QObject
{
  Q_OBJECT

public:
  /// `bar` shows which handles are being created, and has a button to cancel.
  ShapeHandles(Document* document, parts::NoticeBar* bar, QWidget* window);

  QAction* auto_rig_action() const { return this->auto_rig_; }
  void fill_menu(QMenu* menu);
  /// Update which actions are enabled, depending on whether there is a surface.
  void update();

  /// Create bones along the shape. If no bones are found, create points spread over the shape. Emit
  /// rigged() at the end.
  void auto_rig();
  /// Create handles.
  /// @param count  for points: their number; for bones: their maximum number, or 0 for no maximum
  void start(bindpose::AutomaticMethod method, bindpose::Index count);
  void cancel() { this->job_.cancel(); }
  bool is_running() const { return this->job_.is_running(); }

Q_SIGNALS:
  /// Emitted when auto_rig() has created its handles, which can now be bound.
  void rigged();
  void failed(const QString& message);

private:
  void ask_for_count();
  void start_job(bindpose::AutomaticHandlesOptions options);
  void finish();

  Document* document_;
  parts::NoticeBar* bar_;
  QWidget* window_;
  QAction* auto_rig_;
  QMenu* menu_ = nullptr;
  bindpose::AutomaticMethod method_ = bindpose::AutomaticMethod::skeleton;
  bool rigging_ = false;
  std::shared_ptr<bindpose::Handles> new_handles_;
  const void* surface_ = nullptr; ///< the surface for which handles are being created
  parts::KernelJob
    job_; // last member, so that the job ends before the data that it uses is destroyed
};

} // namespace app::handles

#endif
