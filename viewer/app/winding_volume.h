#ifndef winding_volume_h
#define winding_volume_h

#include "kernel_job.h"

#include "vtkImageData.h"
#include "vtkSmartPointer.h"

#include <QObject>

#include <memory>

class Document;
class VolumePanel;

/// The winding numbers of the open surface on a grid around it, as `bindpose winding` computes
/// them: made beside the window, then opened as the document's volume, one step.
class WindingVolume : public QObject
{
  Q_OBJECT

public:
  /// The panel asks for it and says how far it is.
  WindingVolume(Document* document, VolumePanel* panel, QObject* parent);

  void start();
  void cancel() { this->job_.cancel(); }
  bool is_running() const { return this->job_.is_running(); }
  /// What the panel can do depends on what there is.
  void update();

Q_SIGNALS:
  void failed(const QString& sentence);
  void succeeded();

private:
  void finish();

  Document* document_;
  VolumePanel* panel_;
  const void* surface_ = nullptr; ///< that it is made for
  std::shared_ptr<vtkSmartPointer<vtkImageData>> made_;
  KernelJob job_; // last: it ends before what it works on
};

#endif
