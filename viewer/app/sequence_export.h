#ifndef sequence_export_h
#define sequence_export_h

#include "kernel_job.h"
#include "posing/sequence_maker.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <QObject>

class QImage;
class Viewport;

/// Writes an animation by the ending of its name: .json is a pose file, mesh endings numbered
/// datasets with a .pvd, .glb and .gltf an animated file, .png a strip of pictures, .gif, .webm,
/// .mp4 and .apng a moving one (by ffmpeg). Frames are posed and films encoded beside the window;
/// pictures are taken of the viewport. Files appear whole or not at all, and replace those that are
/// there: the dialog has asked.
class SequenceExport : public QObject
{
  Q_OBJECT

public:
  explicit SequenceExport(Viewport* viewport);
  ~SequenceExport() override;

  struct Input
  {
    std::shared_ptr<const bindpose::PoseSource> source;
    vtkSmartPointer<vtkPolyData> surface; ///< at rest
    vtkSmartPointer<vtkPolyData> handles; ///< at rest
    bindpose::PoseOptions options;
    std::vector<bindpose::Pose> poses; ///< a frame each, or
    bindpose::BodyRun run; ///< what a body did
    double frames_per_second = 24.0;
  };
  /// Endings, for the dialog: "*.json *.vtp …".
  static QString patterns();
  void start(const Input& input, const QString& path);
  void cancel();
  bool is_running() const { return this->job_.is_running() || this->encoder_.is_running(); }
  /// One sentence, or empty.
  const QString& error() const { return this->error_; }
  /// What was written, "24 frames"; empty when it was cancelled.
  const QString& said() const { return this->said_; }
  /// The file that is written, or was last.
  const QString& path() const { return this->path_; }

Q_SIGNALS:
  void progress(double fraction);
  /// The viewport is free again: the window's own shape has to be drawn.
  void pictures_taken();
  void finished();

private:
  void frames_made();
  bindpose::Status write();
  bindpose::Status write_datasets(const std::string& path);
  bindpose::Status write_rig(const std::string& path);
  bindpose::Status write_strip(const std::string& path);
  /// Begins to encode, or says why not.
  bindpose::Status write_moving(const std::string& path);
  void end(const bindpose::Status& status);
  vtkSmartPointer<vtkPolyData> posed(std::size_t frame) const;
  QImage picture(std::size_t frame);

  Viewport* viewport_;
  Input input_;
  QString path_;
  std::shared_ptr<bindpose::PosedFrames> frames_;
  QString error_;
  QString said_;
  KernelJob encoder_;
  KernelJob job_; // last: it ends before what it works on
};

#endif
