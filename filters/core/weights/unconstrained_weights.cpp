// Weights by one linear solve per handle (see unconstrained_weights.h).
#include "weights/unconstrained_weights.h"

#include "weights/column_groups.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
/// Report whether the fixed vertices of every connected part span space (for a flat part: the
/// plane). If they do not, their values do not determine a linear function.
bool fixed_vertices_span(const WeightsProblem& problem)
{
  const Components& components = problem.constraints.components;
  const Points& points = problem.mesh.domain.points;
  const auto singular_values = [&](const std::vector<Index>& vertices) -> Eigen::Vector3d
  {
    Points centered(static_cast<Index>(vertices.size()), 3);
    for (Index i = 0; i < centered.rows(); ++i)
    {
      centered.row(i) = points.row(vertices[i]) / problem.diagonal;
    }
    centered.rowwise() -= centered.colwise().mean().eval();
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(centered.transpose() * centered)
      .eigenvalues()
      .cwiseMax(0.0)
      .cwiseSqrt();
  };
  std::vector<std::vector<Index>> fixed(static_cast<std::size_t>(components.count));
  std::vector<std::vector<Index>> all(fixed.size());
  for (const Index v : problem.fixed)
  {
    if (components.component_of_vertex[v] >= 0)
    {
      fixed[components.component_of_vertex[v]].push_back(v);
    }
  }
  for (Index v = 0; v < problem.vertex_count(); ++v)
  {
    if (components.component_of_vertex[v] >= 0)
    {
      all[components.component_of_vertex[v]].push_back(v);
    }
  }
  // Vertices count as flat in a direction if their extent in this direction is at most this
  // fraction of the mesh's diagonal.
  constexpr double flatness_tolerance = 1e-6;
  for (std::size_t c = 0; c < fixed.size(); ++c)
  {
    const auto dimensions = (singular_values(all[c]).array() > flatness_tolerance).count();
    if (fixed[c].size() < static_cast<std::size_t>(dimensions) + 1 ||
      (singular_values(fixed[c]).array() > flatness_tolerance).count() < dimensions)
    {
      return false;
    }
  }
  return true;
}

/// Return (K - N)' M^-1 (K - N), where K is the stiffness, M the mass and N the flux through the
/// boundary. This energy is zero for every linear function.
SparseMatrix linear_subspace_energy(const WeightsProblem& problem, bool spanned)
{
  const Domain& domain = problem.mesh.domain;
  const Points scaled = domain.points / problem.diagonal;
  const SparseMatrix flux = domain.is_volume() ? boundary_flux(scaled, domain.tets)
                                               : boundary_flux(scaled, domain.triangles);
  const SparseMatrix inside = problem.stiffness - flux;
  const Eigen::VectorXd inverse_mass =
    problem.mass.unaryExpr([](double m) { return m > 0.0 ? 1.0 / m : 0.0; });
  SparseMatrix q = SparseMatrix(inside.transpose()) * inverse_mass.asDiagonal() * inside;
  if (!spanned)
  {
    constexpr double biharmonic_factor = 1e-6;
    q += biharmonic_factor * harmonic_energy(problem.stiffness, problem.mass, 2);
  }
  return 0.5 * (q + SparseMatrix(q.transpose()));
}

/// Minimize 1/2 w' Q w for every handle.
Status minimize(ExecutionContext& context, const WeightsProblem& problem, const char* method,
  const SparseMatrix& q, const WeightsOptions& options, WeightsResult& result)
{
  BoxQp solver(q, problem.fixed, { options.tolerance, options.maximum_iterations, options.solver });
  Status status = solver.prepare(context);
  if (!status.ok())
  {
    return status;
  }
  const std::vector<BoxQpSolution> solutions =
    solver.solve_unbounded(context, columns_without_terms(problem));
  if (context.canceled())
  {
    return Status::canceled();
  }
  result.analyses = solver.analyses();
  Eigen::MatrixXd fallback(problem.vertex_count(), problem.handle_count());
  for (std::size_t j = 0; j < solutions.size(); ++j)
  {
    fallback.col(static_cast<Index>(j)) = solutions[j].w;
  }
  return finish_weights(context, problem, method, options.tolerance, solutions, fallback, result);
}

/// Minimize the k-harmonic energy of the given order k, computed with the given masses.
Status minimize_order(ExecutionContext& context, const WeightsProblem& problem, const char* method,
  int order, const Eigen::VectorXd& mass, const WeightsOptions& options, WeightsResult& result)
{
  result = {};
  const Status status = check_no_terms(problem);
  return status.ok() ? minimize(context, problem, method,
                         harmonic_energy(problem.stiffness, mass, order), options, result)
                     : status;
}
} // namespace

Status harmonic_weights(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, WeightsResult& result)
{
  return minimize_order(context, problem, "harmonic", 1, problem.mass, options, result);
}

Status biharmonic_weights(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, WeightsResult& result)
{
  return minimize_order(context, problem, "biharmonic", 2, problem.mass, options, result);
}

Status triharmonic_weights(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, WeightsResult& result)
{
  return minimize_order(context, problem, "triharmonic", 3, problem.mass, options, result);
}

Status graph_biharmonic_weights(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, WeightsResult& result)
{
  return minimize_order(context, problem, "graph-biharmonic", 2,
    Eigen::VectorXd::Ones(problem.vertex_count()), options, result);
}

Status linear_subspace_weights(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, WeightsResult& result)
{
  result = {};
  Status status = check_no_terms(problem);
  if (!status.ok())
  {
    return status;
  }
  const bool spanned = fixed_vertices_span(problem);
  status = minimize(
    context, problem, "linear-subspace", linear_subspace_energy(problem, spanned), options, result);
  if (!spanned && status.usable())
  {
    status.warnings.emplace_back(
      "the handles of a connected part lie in one plane (in a flat part: on one line), so they do "
      "not determine its weights; 1e-6 times the biharmonic energy is added");
  }
  return status;
}

} // namespace bindpose
