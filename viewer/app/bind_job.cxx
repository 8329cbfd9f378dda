// The kernels in a row, on copies, with one execution context: its progress goes to the window's
// thread as queued signals, its cancel is an atomic flag.
#include "bind_job.h"

#include "base/execution.h"
#include "inside/tetrahedralize.h"
#include "weights/bounded_biharmonic_weights.h"
#include "weights/monotone_weights.h"
#include "weights/transfer.h"

#include <QString>

using namespace bindpose;

namespace
{
/// Adds what a stage found to the whole; false when the bind cannot go on.
bool take(const Status& stage, BindResult& result)
{
  result.status.warnings.insert(
    result.status.warnings.end(), stage.warnings.begin(), stage.warnings.end());
  result.status.report.merge(stage.report);
  if (!stage.ok())
  {
    result.status.code = stage.code;
    result.status.message = stage.message;
  }
  return stage.usable();
}

void run_bind(const BindInput& input, ExecutionContext& context, BindResult& result)
{
  TetrahedralizeResult tets;
  {
    Phase phase(context, "tetrahedralize", 0.0, 0.3);
    TetrahedralizeOptions options;
    options.handles = input.handle_places;
    if (!take(tetrahedralize(input.surface.points, input.surface.triangles, options, tets, context),
          result))
    {
      return;
    }
  }
  std::vector<Index> regions;
  if (!input.region_of_vertex.empty())
  {
    for (const Index original : tets.original_vertices)
    {
      regions.push_back(original < 0 ? 0 : input.region_of_vertex[original]);
    }
  }
  Domain domain;
  domain.points = std::move(tets.mesh.points);
  domain.tets = std::move(tets.mesh.tets);
  WeightsProblem problem;
  WeightsResult weights;
  {
    Phase phase(context, "weights", 0.3, 0.98);
    BoundedWeightsOptions bounded;
    MonotoneWeightsOptions monotone;
    const WeightsOptions& options =
      input.monotone ? static_cast<const WeightsOptions&>(monotone) : bounded;
    if (!take(make_weights_problem(domain, regions, input.handles, options, context, problem),
          result) ||
      !take(input.monotone ? monotone_weights(problem, monotone, context, weights)
                           : bounded_biharmonic_weights(problem, bounded, context, weights),
        result))
    {
      return;
    }
  }
  Phase phase(context, "transfer", 0.98, 1.0);
  TransferCounts counts;
  take(transfer(problem.mesh.domain, weights.weights, input.surface.points, {}, context,
         result.weights, counts),
    result);
}
} // namespace

BindJob::BindJob(QObject* parent) : QObject(parent) {}

BindJob::~BindJob()
{
  this->cancel();
  if (this->thread_.joinable())
  {
    this->thread_.join();
  }
}

void BindJob::start(BindInput input)
{
  if (this->running_)
  {
    return;
  }
  if (this->thread_.joinable())
  {
    this->thread_.join();
  }
  this->running_ = true;
  this->cancel_ = false;
  this->thread_ = std::thread(
    [this, input = std::move(input)]
    {
      BindResult result;
      ExecutionContext context(
        [this](double fraction, const std::string& phase)
        {
          const QString name = QString::fromStdString(phase);
          QMetaObject::invokeMethod(
            this, [this, fraction, name] { Q_EMIT this->progress(fraction, name); },
            Qt::QueuedConnection);
        },
        [this] { return this->cancel_.load(); });
      try
      {
        run_bind(input, context, result);
      }
      catch (const std::exception& error)
      {
        result.status = Status::failure(StatusCode::internal_error, error.what());
      }
      result.status.report.merge(context.seconds());
      result.status.report.set("seconds.total", context.elapsed_seconds());
      QMetaObject::invokeMethod(
        this,
        [this, result]
        {
          this->result_ = result;
          if (this->cancel_) // after its end, but before anybody has seen it
          {
            this->result_ = { Status::failure(StatusCode::cancelled, "cancelled"), {} };
          }
          this->running_ = false;
          Q_EMIT this->finished();
        },
        Qt::QueuedConnection);
    });
}

void BindJob::cancel()
{
  this->cancel_ = true;
}
