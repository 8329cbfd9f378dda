#ifndef binding_h
#define binding_h

#include "bind_job.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <QObject>

class Document;
class NoticeBar;
class SidePanel;

/// From the document's surface and handles to weights on it, beside the window: a preview to pose
/// with, then certified ones as a step of the document. To bind again is offered, never forced.
class Binding : public QObject
{
  Q_OBJECT

public:
  /// The panel says how far it is and what came of it; the bar offers to bind again.
  Binding(Document* document, SidePanel* panel, NoticeBar* bar, QObject* parent);

  /// By the panel's method, in its domain. Nothing without a surface and handles, or while it runs.
  void start();
  void cancel() { this->job_->cancel(); }
  bool is_running() const { return this->job_->is_running(); }

  /// What the kernels need of surface and handles; false, after failed(), when they cannot be used.
  bool make_input(BindInput& input);
  /// The handles may be others than were bound: says so, once for each reason.
  void offer_again();

Q_SIGNALS:
  /// It began or ended; before what came of it is shown.
  void changed();
  /// The document has new weights.
  void bound();
  void failed(const QString& sentence);
  /// It is bound, and this is to be known about it.
  void noticed(const QString& sentence);

private:
  vtkSmartPointer<vtkPolyData> with_weights(const BindResult& result) const;
  void show_preview(const bindpose::Weights& weights);
  void finish();

  Document* document_;
  SidePanel* panel_;
  NoticeBar* bar_;
  BindJob* job_;
  vtkSmartPointer<vtkPolyData> preview_; ///< of the job that runs
  QString reason_; ///< that was offered
};

#endif
