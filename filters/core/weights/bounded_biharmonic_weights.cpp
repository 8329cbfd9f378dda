#include "weights/bounded_biharmonic_weights.h"

namespace bindpose
{

Status bounded_biharmonic_weights(const WeightsProblem& problem,
  const BoundedWeightsOptions& options, ExecutionContext& context, WeightsResult& result)
{
  result = {};
  if (options.order != 2 && options.order != 3)
  {
    return Status::invalid_input("the order of bounded weights is 2 or 3");
  }
  const SparseMatrix q = harmonic_energy(problem.stiffness, problem.mass, options.order);
  BoxQp solver(q, problem.fixed, { options.tolerance, options.maximum_iterations, options.solver });
  Status status;
  {
    const ProgressRange range(context, 0.06, 0.1);
    status = solver.prepare(context);
  }
  if (!status.ok())
  {
    return status;
  }
  std::vector<BoxQpSolution> solutions;
  {
    const Phase phase(context, "weights", 0.1, 0.95);
    solutions = solver.solve_all(problem.columns(), context);
  }
  status = worst_of(solutions);
  if (!status.usable())
  {
    return status;
  }
  result.analyses = solver.analyses();
  return finish_weights(problem, options.order == 2 ? "bounded-biharmonic" : "bounded-triharmonic",
    options.tolerance, solutions, solver.unconstrained(problem.fixed_values), context, result);
}

} // namespace bindpose
