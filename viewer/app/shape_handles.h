#ifndef shape_handles_h
#define shape_handles_h

#include "kernel_job.h"

#include "automatic/automatic_handles.h"

#include <QObject>

class Document;
class NoticeBar;
class QAction;
class QMenu;
class QWidget;

/// Makes handles that fit the shape, in the background: bones along its curve skeleton, or points
/// spread over it. They replace the existing handles in one step of the document.
class ShapeHandles : public QObject
{
  Q_OBJECT

public:
  /// The bar shows what is being made, and can cancel it.
  ShapeHandles(Document* document, NoticeBar* bar, QWidget* window);

  QAction* auto_rig_action() const { return this->auto_rig_; }
  void fill_menu(QMenu* menu);
  /// Update which actions are enabled, depending on whether there is a surface.
  void update();

  /// Make bones along the shape, or points spread over it if it has no bones, and emit rigged().
  void auto_rig();
  /// @param count  number of points, or maximum number of bones; 0: as many as the shape needs
  void start(bindpose::AutomaticMethod method, bindpose::Index count);
  void cancel() { this->job_.cancel(); }
  bool is_running() const { return this->job_.is_running(); }

Q_SIGNALS:
  /// auto_rig() has made its handles, which can now be bound.
  void rigged();
  void failed(const QString& sentence);

private:
  void ask_for_count();
  void make(bindpose::AutomaticHandlesOptions options);
  void finish();

  Document* document_;
  NoticeBar* bar_;
  QWidget* window_;
  QAction* auto_rig_;
  QMenu* menu_ = nullptr;
  bindpose::AutomaticMethod method_ = bindpose::AutomaticMethod::skeleton;
  bool rigging_ = false;
  std::shared_ptr<bindpose::Handles> made_;
  const void* surface_ = nullptr; ///< the surface for which handles are being made
  KernelJob job_; // last member, so that it ends before the data it works on is destroyed
};

#endif
