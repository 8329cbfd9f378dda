#ifndef app_volume_winding_volume_h
#define app_volume_winding_volume_h

#include "app/parts/kernel_job.h"

#include "vtkImageData.h"
#include "vtkSmartPointer.h"

#include <QObject>

#include <memory>

class Document;

namespace app::volume
{

class VolumePanel;

/// Computes the winding numbers of the open surface on a grid around it, as `bindpose winding`
/// does. The computation runs in the background. Its result becomes the document's volume, in one
/// undo step.
class WindingVolume : public QObject
{
  Q_OBJECT

public:
  /// `panel` requests the computation and shows its progress.
  WindingVolume(Document* document, VolumePanel* panel, QObject* parent);

  void start();
  void cancel() { this->job_.cancel(); }
  bool is_running() const { return this->job_.is_running(); }
  /// Update which widgets of the panel are enabled.
  void update();

Q_SIGNALS:
  void failed(const QString& message);
  void succeeded();

private:
  void finish();

  Document* document_;
  VolumePanel* panel_;
  const void* surface_ = nullptr; ///< the surface for which the volume is computed
  std::shared_ptr<vtkSmartPointer<vtkImageData>> new_volume_;
  parts::KernelJob
    job_; // last member, so that the job ends before the data that it uses is destroyed
};

} // namespace app::volume

#endif
