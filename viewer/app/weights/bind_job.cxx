// Computes weights in the background. The kernels work on copies of the surface and the handles, so
// the document can change during the computation.
#include "app/weights/bind_job.h"

#include "base/execution.h"

#include <functional>
#include <memory>

namespace app::weights
{

using namespace bindpose;

namespace
{
void run_bind(ExecutionContext& context, const BindInput& input,
  const std::function<void(const Weights&)>& preview, BindResult& result)
{
  SurfaceWeightsOptions options;
  options.keep_raw = true; // the weight panel shows row sums, which need the raw weights
  options.handle_elements = input.handle_elements;
  options.domain = input.domain;
  if (input.preview)
  {
    options.preview = preview;
  }
  const WeightsMethod method =
    [&](ExecutionContext& method_context, const WeightsProblem& problem, WeightsResult& weights)
  { return input.method->kernel(method_context, problem, {}, weights); };
  SurfaceWeights weights;
  result.status = surface_weights(context, input.surface.points, input.surface.triangles,
    input.region_of_vertex, input.handles, options, {}, method, weights);
  result.weights = std::move(weights.weights);
  result.raw = std::move(weights.raw);
  result.domain = weights.domain;
  result.mesh = std::move(weights.problem.mesh.domain);
  result.mesh.points = weights.problem.frame.from_frame(result.mesh.points);
  result.solved = std::move(weights.solved);
}
} // namespace

BindJob::BindJob(QObject* parent) : QObject(parent)
{
  QObject::connect(&this->job_, &parts::KernelJob::progress, this, &BindJob::progress);
}

void BindJob::start(BindInput input)
{
  if (this->is_running())
  {
    return;
  }
  auto bind_result = std::make_shared<BindResult>();
  QObject::disconnect(&this->job_, &parts::KernelJob::finished, this, nullptr);
  QObject::connect(&this->job_, &parts::KernelJob::finished, this,
    [this, bind_result]
    {
      this->result_ = BindResult();
      if (this->job_.status().code != StatusCode::canceled)
      {
        this->result_ = std::move(*bind_result);
      }
      this->result_.status = this->job_.status();
      Q_EMIT this->finished();
    });
  this->job_.start(
    [this, bind_result, input = std::move(input)](ExecutionContext& context)
    {
      run_bind(
        context, input,
        [this](const Weights& weights)
        {
          const auto copy = std::make_shared<const Weights>(weights);
          QMetaObject::invokeMethod(
            this, [this, copy] { Q_EMIT this->preview(*copy); }, Qt::QueuedConnection);
        },
        *bind_result);
      return bind_result->status;
    });
}

} // namespace app::weights
