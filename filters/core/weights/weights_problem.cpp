#include "weights/weights_problem.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace bindpose
{

namespace
{
/// Rows that are known beforehand.
void collect_fixed(WeightsProblem& problem)
{
  const HandleConstraints& constraints = problem.constraints;
  const Index m = problem.handle_count();
  std::vector<Index> row_of(static_cast<std::size_t>(problem.vertex_count()), -1);
  for (std::size_t i = 0; i < constraints.vertices.size(); ++i)
  {
    row_of[constraints.vertices[i]] = static_cast<Index>(i);
  }
  for (Index v = 0; v < problem.vertex_count(); ++v)
  {
    if (constraints.roles[v] != VertexRole::solved)
    {
      problem.fixed.push_back(v);
    }
  }
  problem.fixed_values = Eigen::MatrixXd::Zero(static_cast<Index>(problem.fixed.size()), m);
  for (std::size_t i = 0; i < problem.fixed.size(); ++i)
  {
    const Index v = problem.fixed[i];
    const auto row = static_cast<Index>(i);
    if (constraints.roles[v] == VertexRole::handle)
    {
      problem.fixed_values.row(row) = constraints.values.row(row_of[v]);
    }
    else if (constraints.roles[v] == VertexRole::tethered)
    {
      problem.fixed_values(row, constraints.tether[constraints.components.of_vertex[v]]) = 1.0;
    }
  }
}

void report_problem(const WeightsProblem& problem, Status& status)
{
  const Domain& domain = problem.mesh.domain;
  const HandleConstraints& constraints = problem.constraints;
  Report& report = status.report;
  report.set("counts.vertices", Report::Value(problem.vertex_count()));
  report.set(
    domain.is_volume() ? "counts.tets" : "counts.triangles", Report::Value(domain.element_count()));
  report.set("counts.handles", Report::Value(problem.handle_count()));
  report.set("counts.components", Report::Value(constraints.components.count));
  report.set("counts.inserted_vertices",
    Report::Value(static_cast<std::int64_t>(problem.mesh.inserted.size())));
  const auto tethered = std::count_if(
    constraints.tether.begin(), constraints.tether.end(), [](Index handle) { return handle >= 0; });
  if (tethered > 0)
  {
    report.set("counts.components_without_handle", Report::Value(std::int64_t(tethered)));
  }
  const auto unreferenced =
    std::count(constraints.roles.begin(), constraints.roles.end(), VertexRole::unreferenced);
  if (unreferenced > 0)
  {
    report.set("counts.unreferenced_vertices", Report::Value(std::int64_t(unreferenced)));
    status.warnings.push_back(std::to_string(unreferenced) +
      (unreferenced == 1 ? " vertex is in no element; its weights are zero"
                         : " vertices are in no element; their weights are zero"));
  }
  report.set("largest_snap", Report::Value(problem.mesh.largest_snap));
  std::vector<std::string> names;
  std::vector<std::string> kinds;
  for (const Handle& handle : problem.handles)
  {
    names.push_back(handle.name);
    kinds.emplace_back(to_string(handle.kind));
  }
  report.set("handles[].name", names);
  report.set("handles[].kind", kinds);
  report.set("handles[].constrained_vertices", constraints.counts);
  std::vector<double> outside;
  for (const HandlePlacement& placement : problem.mesh.handles)
  {
    outside.push_back(placement.outside);
  }
  report.set("handles[].distance_outside", outside);
}
} // namespace

Status make_weights_problem(const Domain& domain, const std::vector<Index>& region_ids,
  const Handles& handles, const WeightsOptions& options, ExecutionContext& context,
  WeightsProblem& problem)
{
  problem = WeightsProblem();
  const Phase phase(context, "insert", 0.0, 0.04);
  if (!(options.tolerance > 0.0 && options.tolerance < 1.0) || options.maximum_iterations < 1)
  {
    return Status::invalid_input(
      "the tolerance must lie between 0 and 1, and the iterations must be at least 1");
  }
  if (!region_ids.empty() && static_cast<Index>(region_ids.size()) != domain.points.rows())
  {
    return Status::invalid_input("there are " + std::to_string(region_ids.size()) +
      " region labels for " + std::to_string(domain.points.rows()) + " vertices");
  }
  problem.handles = handles;
  Status status = insert_handles(domain, handles, options.insertion, context, problem.mesh);
  if (status.ok())
  {
    status = constrain_handles(problem.mesh, handles, region_ids, problem.constraints);
  }
  if (!status.ok())
  {
    return status;
  }
  status.warnings = problem.mesh.warnings;
  const std::string slow_blas = SparseSolver::blas_warning();
  if (!slow_blas.empty())
  {
    status.warnings.push_back(slow_blas);
  }
  status.warnings.insert(status.warnings.end(), problem.constraints.warnings.begin(),
    problem.constraints.warnings.end());

  // Scaled to diagonal 1 about its centre: units and place must not show in the weights.
  const Domain& refined = problem.mesh.domain;
  Box box;
  for (Index v = 0; v < problem.vertex_count(); ++v)
  {
    if (problem.constraints.roles[v] != VertexRole::unreferenced)
    {
      box.add(refined.points.row(v));
    }
  }
  Points scaled = refined.points;
  scaled.rowwise() -= box.center().transpose();
  problem.diagonal = box.diagonal();
  scaled /= problem.diagonal;
  problem.stiffness = refined.is_volume() ? stiffness_matrix(scaled, refined.tets, refined.shares)
                                          : stiffness_matrix(scaled, refined.triangles);
  problem.mass = refined.is_volume() ? lumped_mass(scaled, refined.tets, refined.shares)
                                     : lumped_mass(scaled, refined.triangles);
  problem.mass_unit = problem.mass.maxCoeff();
  problem.mass /= problem.mass_unit;
  problem.graph = vertex_graph(refined);
  collect_fixed(problem);
  report_problem(problem, status);
  problem.status = status;
  return context.cancelled() ? Status::cancelled() : status;
}

std::vector<BoxQpColumn> WeightsProblem::columns() const
{
  const Components& components = this->constraints.components;
  const Index m = this->handle_count();
  std::vector<BoxQpColumn> result(static_cast<std::size_t>(m));
  for (Index j = 0; j < m; ++j)
  {
    result[j].fixed_values = this->fixed_values.col(j);
    // NaN: several values in this part.
    std::vector<double> constant(static_cast<std::size_t>(components.count), -1.0);
    for (std::size_t i = 0; i < this->fixed.size(); ++i)
    {
      const Index c = components.of_vertex[this->fixed[i]];
      if (c >= 0)
      {
        const double value = this->fixed_values(static_cast<Index>(i), j);
        constant[c] = constant[c] == -1.0 || constant[c] == value ? value : std::nan("");
      }
    }
    std::vector<double> values;
    for (Index v = 0; v < this->vertex_count(); ++v)
    {
      if (this->constraints.roles[v] == VertexRole::solved &&
        !std::isnan(constant[components.of_vertex[v]]))
      {
        result[j].pinned.push_back(v);
        values.push_back(constant[components.of_vertex[v]]);
      }
    }
    result[j].pinned_values =
      Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Index>(values.size()));
  }
  return result;
}

Status finish_weights(const WeightsProblem& problem, const std::string& method, double tolerance,
  const std::vector<BoxQpSolution>& solutions, const Eigen::MatrixXd& fallback,
  ExecutionContext& context, WeightsResult& result)
{
  const Index n = problem.vertex_count();
  const Index m = problem.handle_count();
  const HandleConstraints& constraints = problem.constraints;
  Status status = problem.status;
  result.raw.resize(n, m);
  for (Index j = 0; j < m; ++j)
  {
    result.raw.col(j) = solutions[j].w;
  }
  result.weights = result.raw;
  result.row_sum_error = 0.0;
  Index thin_rows = 0;
  for (Index v = 0; v < n; ++v)
  {
    const VertexRole role = constraints.roles[v];
    if (role == VertexRole::follower || role == VertexRole::unreferenced)
    {
      continue;
    }
    const double sum = result.raw.row(v).sum();
    result.row_sum_error = std::max(result.row_sum_error, std::abs(1.0 - sum));
    if (std::abs(sum) >= 1e-3)
    {
      result.weights.row(v) /= sum;
      continue;
    }
    const Eigen::RowVectorXd row = fallback.row(v).cwiseMax(0.0);
    result.weights.row(v) = row / row.sum();
    ++thin_rows;
  }
  for (Index v = 0; v < n; ++v)
  {
    if (constraints.roles[v] == VertexRole::follower)
    {
      result.raw.row(v) = result.raw.row(constraints.leader[v]);
      result.weights.row(v) = result.weights.row(constraints.leader[v]);
    }
  }
  if (thin_rows > 0)
  {
    status.warnings.push_back(std::to_string(thin_rows) +
      " rows sum to almost nothing; they were taken from the weights without bounds");
  }

  std::vector<char> exempt(static_cast<std::size_t>(n), 0);
  for (Index v = 0; v < n; ++v)
  {
    exempt[v] = constraints.roles[v] != VertexRole::solved;
  }
  result.columns.assign(static_cast<std::size_t>(m), {});
  const bool whole = parallel_for(context, m, 1,
    [&](Index begin, Index end)
    {
      for (Index j = begin; j < end; ++j)
      {
        WeightsColumn& column = result.columns[j];
        const Eigen::VectorXd raw = result.raw.col(j);
        const Eigen::VectorXd normalised = result.weights.col(j);
        column.certificate = solutions[j].certificate;
        column.iterations = solutions[j].iterations;
        column.factorisations = solutions[j].factorisations;
        column.minimum = raw.minCoeff();
        column.maximum = raw.maxCoeff();
        column.zeros = static_cast<double>((raw.array() == 0.0).count()) / static_cast<double>(n);
        column.ones = static_cast<double>((raw.array() == 1.0).count()) / static_cast<double>(n);
        column.extrema = interior_extrema(problem.graph, raw, exempt);
        column.normalised_interior_extrema =
          static_cast<Index>(interior_extrema(problem.graph, normalised, exempt).size());
      }
    });
  if (!whole)
  {
    return Status::cancelled();
  }

  Report& report = status.report;
  std::vector<double> gaps, residuals, energies, zeros, ones;
  std::vector<std::int64_t> iterations, factorisations, extrema, normalised_extrema;
  double bounds = 0.0;
  std::int64_t total = 0;
  std::string late;
  for (Index j = 0; j < m; ++j)
  {
    const WeightsColumn& column = result.columns[j];
    gaps.push_back(column.certificate.relative_gap);
    residuals.push_back(column.certificate.kkt_residual);
    energies.push_back(column.certificate.energy);
    iterations.push_back(column.iterations);
    factorisations.push_back(column.factorisations);
    extrema.push_back(static_cast<std::int64_t>(column.extrema.size()));
    zeros.push_back(column.zeros);
    ones.push_back(column.ones);
    normalised_extrema.push_back(column.normalised_interior_extrema);
    bounds = std::max({ bounds, -column.minimum, column.maximum - 1.0 });
    total += column.iterations;
    context.add_seconds("factor", solutions[j].factor_seconds);
    context.add_seconds("solve", solutions[j].solve_seconds);
    if (!(std::max(gaps.back(), residuals.back()) <= tolerance))
    {
      late += (late.empty() ? "'" : ", '") + problem.handles[j].name + "'";
    }
  }
  const double worst_gap = *std::max_element(gaps.begin(), gaps.end());
  const double worst_residual = *std::max_element(residuals.begin(), residuals.end());
  report.set("method", method);
  report.set("kkt_residual", Report::Value(worst_residual));
  report.set("relative_gap", Report::Value(worst_gap));
  report.set("bounds_violation", Report::Value(bounds));
  report.set("row_sum_error", Report::Value(result.row_sum_error));
  report.set("iterations", Report::Value(total));
  report.set("handles[].relative_gap", gaps);
  report.set("handles[].kkt_residual", residuals);
  report.set("handles[].energy", energies);
  report.set("handles[].iterations", iterations);
  report.set("handles[].factorisations", factorisations);
  report.set("handles[].interior_extrema", extrema);
  report.set("handles[].interior_extrema_normalised", normalised_extrema);
  report.set("handles[].zeros", zeros);
  report.set("handles[].ones", ones);
  if (!late.empty())
  {
    char numbers[96];
    std::snprintf(numbers, sizeof(numbers), "relative gap %.2g, residual %.2g, asked for %.2g",
      worst_gap, worst_residual, tolerance);
    status.code = StatusCode::not_converged;
    status.message = "the weights of " + late + " are not certified (" + numbers + ")";
  }
  return status;
}

} // namespace bindpose
