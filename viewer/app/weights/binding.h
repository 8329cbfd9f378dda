#ifndef app_weights_binding_h
#define app_weights_binding_h

#include "app/weights/bind_job.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <QObject>

class Document;

namespace app::handles
{
class SidePanel;
} // namespace app::handles
namespace app::parts
{
class NoticeBar;
} // namespace app::parts

namespace app::weights
{

/// Binds the document's surface to its handles in the background. The bind first computes
/// preliminary weights (the preview), then certified weights, which become an undo step of the
/// document. After changes of handles this class offers another bind to the user, but never starts
/// one automatically.
class Binding : public QObject
{
  Q_OBJECT

public:
  /// `panel` shows the progress and the result; `bar` offers another bind.
  Binding(Document* document, handles::SidePanel* panel, parts::NoticeBar* bar, QObject* parent);

  /// Start a bind with the panel's method and domain. Does nothing without a surface and handles,
  /// or while a bind runs.
  void start();
  void cancel() { this->job_->cancel(); }
  bool is_running() const { return this->job_->is_running(); }

  /// Convert the surface and the handles to the kernels' input. If the surface or the handles are
  /// invalid, emit failed() and return false.
  bool make_input(BindInput& input);
  /// Offer another bind, and state the reason, if the handles have changed since the last bind. An
  /// offer with the same reason is not repeated, because the user may have closed it.
  void offer_rebind();

Q_SIGNALS:
  /// Emitted when a bind has begun or ended, before its result is shown.
  void changed();
  /// Emitted when the document has new weights.
  void bound();
  void failed(const QString& message);
  /// Emitted with a message for the user after a bind has ended.
  void notice_requested(const QString& message);

private:
  vtkSmartPointer<vtkPolyData> with_weights(const BindResult& result) const;
  void show_preview(const bindpose::Weights& weights);
  void finish();

  Document* document_;
  handles::SidePanel* panel_;
  parts::NoticeBar* bar_;
  BindJob* job_;
  vtkSmartPointer<vtkPolyData> preview_; ///< preview of the running job
  QString reason_; ///< the last reason for which a bind was offered
};

} // namespace app::weights

#endif
