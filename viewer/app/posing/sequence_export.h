#ifndef app_posing_sequence_export_h
#define app_posing_sequence_export_h

#include "app/parts/kernel_job.h"
#include "poser/sequence_maker.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <QObject>

class QImage;

namespace app::view
{
class Viewport;
} // namespace app::view

namespace app::posing
{

/// Writes an animation in the format of the file name's extension:
/// - .json: a pose file
/// - extensions of mesh files: numbered datasets and a .pvd file
/// - .glb, .gltf: one animated file
/// - .png: one image with several frames
/// - .gif, .webm, .mp4, .apng: a film
///
/// A background thread poses the frames, and runs ffmpeg to encode a film. The viewport renders the
/// images. Files are written completely or not at all. They replace existing files, because the
/// file dialog has asked for confirmation.
class SequenceExport : public QObject
{
  Q_OBJECT

public:
  explicit SequenceExport(view::Viewport* viewport);
  ~SequenceExport() override;

  struct Input
  {
    std::shared_ptr<const bindpose::PoseSource> source;
    vtkSmartPointer<vtkPolyData> surface; ///< the surface at rest
    vtkSmartPointer<vtkPolyData> handles; ///< the handles at rest
    bindpose::PoseOptions options;
    std::vector<bindpose::Pose> poses; ///< one per frame; not used if `run` is not empty
    bindpose::BodyRun run; ///< the recorded motion of a body
    double frames_per_second = 24.0;
  };
  /// Return the file name patterns for the file dialog: "*.json *.vtp …".
  static QString patterns();
  void start(const Input& input, const QString& path);
  void cancel();
  bool is_running() const { return this->job_.is_running() || this->encoder_.is_running(); }
  /// Return the error of the last export: one sentence, or empty.
  const QString& error() const { return this->error_; }
  /// Return a description of the written data, such as "24 frames"; empty after a cancel.
  const QString& summary() const { return this->summary_; }
  /// Return the file that is being written, or was written last.
  const QString& path() const { return this->path_; }

Q_SIGNALS:
  void progress(double fraction);
  /// Emitted when the viewport is no longer used for the export. The window must then draw the
  /// current shape again, because the viewport may still show the last frame.
  void rendering_finished();
  void finished();

private:
  void frames_made();
  bindpose::Status write();
  bindpose::Status write_datasets(const std::string& path);
  bindpose::Status write_rig(const std::string& path);
  bindpose::Status write_contact_sheet(const std::string& path);
  /// Begin to encode a film, or return the reason why that is impossible.
  bindpose::Status begin_video(const std::string& path);
  void end(const bindpose::Status& status);
  vtkSmartPointer<vtkPolyData> posed_surface(std::size_t frame) const;
  QImage picture(std::size_t frame);

  view::Viewport* viewport_;
  Input input_;
  QString path_;
  std::shared_ptr<bindpose::PosedFrames> frames_;
  QString error_;
  QString summary_;
  parts::KernelJob encoder_;
  parts::KernelJob
    job_; // last member, so that the job ends before the data that it uses is destroyed
};

} // namespace app::posing

#endif
