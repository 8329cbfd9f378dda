#ifndef app_weights_bind_job_h
#define app_weights_bind_job_h

#include "app/parts/kernel_job.h"
#include "base/status.h"
#include "geometry/mesh.h"
#include "handles/handles.h"
#include "inside/handle_elements.h"
#include "weights/surface_weights.h"
#include "weights/weight_methods.h"

#include <QObject>

namespace app::weights
{

/// Input of a bind. It consists of copies, so that the bind and the window share no data.
struct BindInput
{
  bindpose::TriangleMesh surface;
  bindpose::Handles handles;
  /// Points, bones and cages of the handles, at which the mesher creates vertices of the tets.
  bindpose::HandleElements handle_elements;
  std::vector<bindpose::Index> region_of_vertex; ///< #V labels, empty without regions
  /// The method, a row of weight_methods(); never null.
  const bindpose::WeightMethod* method = bindpose::weight_methods().data();
  bindpose::WeightsDomain domain = bindpose::WeightsDomain::automatic;
  /// True: compute preliminary weights, with which the user can pose before the bind ends.
  bool preview = true;
};

/// Result of a bind: weights at the vertices of the surface, and at the vertices of the domain on
/// which the weights were solved.
struct BindResult
{
  bindpose::Status status;
  bindpose::Weights weights; ///< #V x #handles
  bindpose::Weights raw; ///< the weights before rows are divided by their sums
  bindpose::WeightsDomain domain = bindpose::WeightsDomain::surface;
  /// The domain on which the weights were solved: the surface, or a mesh of tets.
  bindpose::Domain mesh;
  /// Weights at the vertices of `mesh`, with one certificate per column.
  bindpose::WeightsResult solved;
};

/// Computes weights for a surface with the kernels on a separate thread (surface_weights). One job
/// runs at a time. Destroying the object cancels the job and waits for its end.
class BindJob : public QObject
{
  Q_OBJECT

public:
  explicit BindJob(QObject* parent = nullptr);

  void start(BindInput input);
  /// Request cancellation of the job. finished() is still emitted, with the status canceled.
  void cancel() { this->job_.cancel(); }
  bool is_running() const { return this->job_.is_running(); }
  /// Return the last result; valid after finished().
  const BindResult& result() const { return this->result_; }

Q_SIGNALS:
  /// Emitted on the thread of this object. `fraction` is the progress of the whole job in [0, 1].
  void progress(double fraction, const QString& phase);
  /// Emitted with preliminary weights, with which the user can pose until the certified weights are
  /// computed. Not emitted after a cancel.
  void preview(const bindpose::Weights& weights);
  void finished();

private:
  BindResult result_;
  parts::KernelJob job_;
};

} // namespace app::weights

#endif
