#ifndef bind_job_h
#define bind_job_h

#include "base/mesh.h"
#include "base/status.h"
#include "inside/handle_places.h"
#include "kernel_job.h"
#include "weights/handles.h"

#include <QObject>

/// What a bind needs: copies, so that nothing is shared with the window while it runs.
struct BindInput
{
  bindpose::TriangleMesh surface;
  bindpose::Handles handles;
  bindpose::HandlePlaces handle_places; ///< of these: what becomes part of the tets
  std::vector<bindpose::Index> region_of_vertex; ///< #V labels, empty without regions
  bool monotone = false; ///< monotone weights instead of bounded ones
};

/// What comes of it: weights at the surface's own vertices.
struct BindResult
{
  bindpose::Status status;
  bindpose::Weights weights; ///< #V x #handles
};

/// Surface to weights, by the kernels, on a thread of its own (surface_weights). One at a time;
/// destroying the job cancels it and waits.
class BindJob : public QObject
{
  Q_OBJECT

public:
  explicit BindJob(QObject* parent = nullptr);

  void start(BindInput input);
  /// Ends the job soon; finished() still comes, with the status cancelled.
  void cancel() { this->job_.cancel(); }
  bool is_running() const { return this->job_.is_running(); }
  /// The last result; to be read after finished().
  const BindResult& result() const { return this->result_; }

Q_SIGNALS:
  /// Fraction of the whole in [0, 1] and the name of the phase. On the thread of this object.
  void progress(double fraction, const QString& phase);
  /// Weights to pose with until the certified ones are there; not where the bind was cancelled.
  void preview(const bindpose::Weights& weights);
  void finished();

private:
  BindResult result_;
  KernelJob job_;
};

#endif
