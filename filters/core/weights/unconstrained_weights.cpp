#include "weights/unconstrained_weights.h"

namespace bindpose
{

Status unconstrained_weights(const WeightsProblem& problem,
  const UnconstrainedWeightsOptions& options, ExecutionContext& context, WeightsResult& result)
{
  result = {};
  if (options.order < 1 || options.order > 3)
  {
    return Status::invalid_input("the order of weights without bounds is 1, 2 or 3");
  }
  const SparseMatrix q = harmonic_energy(problem.stiffness, problem.mass, options.order);
  BoxQp solver(q, problem.fixed, { options.tolerance, options.maximum_iterations, options.solver });
  const Status status = solver.prepare(context);
  if (!status.ok())
  {
    return status;
  }
  const std::vector<BoxQpSolution> solutions = solver.solve_unbounded(problem.columns(), context);
  if (context.cancelled())
  {
    return Status::cancelled();
  }
  result.analyses = solver.analyses();
  constexpr const char* names[3] = { "harmonic", "biharmonic", "triharmonic" };
  Eigen::MatrixXd fallback(problem.vertex_count(), problem.handle_count());
  for (std::size_t j = 0; j < solutions.size(); ++j)
  {
    fallback.col(static_cast<Index>(j)) = solutions[j].w;
  }
  return finish_weights(
    problem, names[options.order - 1], options.tolerance, solutions, fallback, context, result);
}

} // namespace bindpose
