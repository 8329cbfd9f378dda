#ifndef bind_job_h
#define bind_job_h

#include "base/mesh.h"
#include "base/status.h"
#include "inside/handle_places.h"
#include "kernel_job.h"
#include "weights/handles.h"
#include "weights/surface_weights.h"

#include <QObject>

/// The methods, bounded and monotone weights first, those to compare with after them. Others are
/// numbered as UnconstrainedMethod and BaselineMethod are.
enum class BindMethod
{
  bounded = -1,
  monotone = 0,
  harmonic = 1,
  biharmonic = 2,
  triharmonic = 3,
  graph_biharmonic = 4,
  linear_subspace = 5,
  inverse_distance = 6,
  smoothed_harmonic = 7,
  bone_heat = 8
};

/// What a bind needs: copies, so that nothing is shared with the window while it runs.
struct BindInput
{
  bindpose::TriangleMesh surface;
  bindpose::Handles handles;
  bindpose::HandlePlaces handle_places; ///< of these: what becomes part of the tets
  std::vector<bindpose::Index> region_of_vertex; ///< #V labels, empty without regions
  BindMethod method = BindMethod::bounded;
  bindpose::WeightsDomain domain = bindpose::WeightsDomain::automatic;
  bool preview = true; ///< weights to pose with meanwhile are wanted
};

/// What comes of it: weights at the surface's own vertices, and at those of what was solved on.
struct BindResult
{
  bindpose::Status status;
  bindpose::Weights weights; ///< #V x #handles
  bindpose::Weights raw; ///< the same before rows are divided by their sums
  bindpose::WeightsDomain domain = bindpose::WeightsDomain::surface;
  bindpose::Domain mesh; ///< with tets, unless it is the surface itself
  bindpose::WeightsResult solved; ///< at the mesh's vertices, with a certificate a column
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
