// The kernels in a row, on copies, with one execution context.
#include "bind_job.h"

#include "base/execution.h"
#include "inside/tetrahedralize.h"
#include "weights/bounded_biharmonic_weights.h"
#include "weights/monotone_weights.h"
#include "weights/transfer.h"

#include <memory>

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

BindJob::BindJob(QObject* parent) : QObject(parent)
{
  QObject::connect(&this->job_, &KernelJob::progress, this, &BindJob::progress);
}

void BindJob::start(BindInput input)
{
  if (this->is_running())
  {
    return;
  }
  auto made = std::make_shared<BindResult>();
  QObject::disconnect(&this->job_, &KernelJob::finished, this, nullptr);
  QObject::connect(&this->job_, &KernelJob::finished, this,
    [this, made]
    {
      this->result_ = { this->job_.status(), {} };
      if (this->result_.status.code != StatusCode::cancelled)
      {
        this->result_.weights = std::move(made->weights);
      }
      Q_EMIT this->finished();
    });
  this->job_.start(
    [made, input = std::move(input)](ExecutionContext& context)
    {
      run_bind(input, context, *made);
      return made->status;
    });
}
