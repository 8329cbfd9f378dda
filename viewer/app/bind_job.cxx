// The kernels, on copies, with one execution context.
#include "bind_job.h"

#include "base/execution.h"
#include "weights/bounded_biharmonic_weights.h"
#include "weights/monotone_weights.h"
#include "weights/surface_weights.h"

#include <functional>
#include <memory>

using namespace bindpose;

namespace
{
void run_bind(const BindInput& input, const std::function<void(const Weights&)>& preview,
  ExecutionContext& context, BindResult& result)
{
  SurfaceWeightsOptions options;
  options.places = input.handle_places;
  options.preview = preview;
  const WeightsMethod method =
    [&](const WeightsProblem& problem, ExecutionContext& of_method, WeightsResult& weights)
  {
    return input.monotone ? monotone_weights(problem, {}, of_method, weights)
                          : bounded_biharmonic_weights(problem, {}, of_method, weights);
  };
  SurfaceWeights weights;
  result.status = surface_weights(input.surface.points, input.surface.triangles,
    input.region_of_vertex, input.handles, options, {}, method, context, weights);
  result.weights = std::move(weights.weights);
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
    [this, made, input = std::move(input)](ExecutionContext& context)
    {
      run_bind(
        input,
        [this](const Weights& weights)
        {
          const auto copy = std::make_shared<const Weights>(weights);
          QMetaObject::invokeMethod(
            this, [this, copy] { Q_EMIT this->preview(*copy); }, Qt::QueuedConnection);
        },
        context, *made);
      return made->status;
    });
}
