// Prepare a mesh with handles for all weight methods, and finish their results (see
// weights_problem.h).
#include "weights/weights_problem.h"

#include "base/parallel.h"
#include "domain/scaled_mesh.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
/// Collect the rows that are not solved for.
void collect_fixed(WeightsProblem& problem)
{
  const HandleConstraints& constraints = problem.constraints;
  const Index m = problem.handle_count();
  std::vector<Index> constraint_row(static_cast<std::size_t>(problem.vertex_count()), -1);
  for (std::size_t i = 0; i < constraints.vertices.size(); ++i)
  {
    constraint_row[constraints.vertices[i]] = static_cast<Index>(i);
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
      problem.fixed_values.row(row) = constraints.values.row(constraint_row[v]);
    }
    else if (constraints.roles[v] == VertexRole::without_handle)
    {
      problem.fixed_values(
        row, constraints.nearest_handle[constraints.components.component_of_vertex[v]]) = 1.0;
    }
  }
}

/// Return for every element the mean painted rigidity of its corners, times the fraction of the
/// element that is inside the surface (Domain::inside_fractions).
Eigen::VectorXd element_rigidity(const Domain& domain, const Eigen::VectorXd& painted)
{
  Eigen::VectorXd result(domain.element_count());
  for (Index e = 0; e < result.size(); ++e)
  {
    double sum = 0.0;
    for (int k = 0; k < domain.corners(); ++k)
    {
      sum += painted[domain.element(e)[k]];
    }
    result[e] = sum / domain.corners() *
      (domain.inside_fractions.size() > 0 ? domain.inside_fractions[e] : 1.0);
  }
  return result;
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
  const auto without_handle = std::count_if(constraints.nearest_handle.begin(),
    constraints.nearest_handle.end(), [](Index handle) { return handle >= 0; });
  if (without_handle > 0)
  {
    report.set("counts.components_without_handle", Report::Value(std::int64_t(without_handle)));
  }
  const auto unreferenced =
    std::count(constraints.roles.begin(), constraints.roles.end(), VertexRole::unreferenced);
  if (unreferenced > 0)
  {
    report.set("counts.unreferenced_vertices", Report::Value(std::int64_t(unreferenced)));
    status.warnings.push_back(std::to_string(unreferenced) +
      (unreferenced == 1 ? " vertex is not part of any element; its weights are zero"
                         : " vertices are not part of any element; their weights are zero"));
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

namespace
{
/// Make the problem in the working frame of the domain.
Status make_problem_in_frame(ExecutionContext& context, const WorkingFrame& frame, Domain domain,
  const std::vector<Index>& region_ids, const Handles& handles, WeightsOptions options,
  WeightsProblem& problem)
{
  domain.points = frame.to_frame(domain.points);
  domain.embedded_points = frame.to_frame(domain.embedded_points);
  options.terms = to_frame(frame, std::move(options.terms));
  Status status = make_weights_problem_in_place(
    context, domain, region_ids, to_frame(frame, handles), options, problem);
  problem.frame = frame;
  convert_lengths(frame, status.report);
  convert_lengths(frame, problem.status.report);
  return status;
}
} // namespace

WeightTerms to_frame(const WorkingFrame& frame, WeightTerms terms)
{
  terms.mirror_origin = frame.point_to_frame(terms.mirror_origin);
  return terms;
}

void convert_lengths(const WorkingFrame& frame, Report& report)
{
  for (const char* key : { "largest_snap", "handles[].distance_outside" })
  {
    frame.convert_report(report, key, 1);
  }
}

Status make_weights_problem(ExecutionContext& context, const Domain& domain,
  const std::vector<Index>& region_ids, const Handles& handles, const WeightsOptions& options,
  WeightsProblem& problem)
{
  problem = WeightsProblem();
  WorkingFrame frame;
  const Status in_range =
    choose_working_frame(domain, std::string("the mesh of ") + element_name(domain) + "s", frame);
  if (!in_range.ok())
  {
    return in_range;
  }
  return frame.is_identity()
    ? make_weights_problem_in_place(context, domain, region_ids, handles, options, problem)
    : make_problem_in_frame(context, frame, domain, region_ids, handles, options, problem);
}

Status make_weights_problem_in_place(ExecutionContext& context, const Domain& domain,
  const std::vector<Index>& region_ids, const Handles& handles, const WeightsOptions& options,
  WeightsProblem& problem)
{
  problem = WeightsProblem();
  const Phase phase(context, "insert", 0.0, 0.04);
  if (!(options.tolerance > 0.0 && options.tolerance < 1.0) || options.maximum_iterations < 1)
  {
    return Status::invalid_input(
      "the tolerance must be between 0 and 1, and the number of iterations at least 1");
  }
  if (options.maximum_influences < 0)
  {
    return Status::invalid_input("the number of influences must be 0 or more");
  }
  problem.handles = handles;
  Status status = insert_handles(context, domain, handles, options.insertion, problem.mesh);
  if (status.ok())
  {
    status = check_terms(options.terms, domain.points.rows(), handles);
  }
  if (status.ok())
  {
    problem.terms = extend_terms(options.terms, problem.mesh);
    status = constrain_handles(
      problem.mesh, handles, region_ids, problem.constraints, problem.terms.rigid_sets);
  }
  if (!status.ok())
  {
    return status;
  }
  status.warnings = problem.mesh.warnings;
  Index ignored_pins = 0;
  for (Index v = 0; v < problem.terms.pinned.rows(); ++v)
  {
    const bool pinned = !problem.terms.pinned.row(v).array().isNaN().all();
    ignored_pins += pinned && problem.constraints.components.component_of_vertex[v] < 0;
  }
  if (ignored_pins > 0)
  {
    status.warnings.push_back(std::to_string(ignored_pins) +
      (ignored_pins == 1 ? " pinned vertex is" : " pinned vertices are") +
      " not part of any element with an area or volume and therefore ignored");
  }
  const std::string slow_blas = SparseSolver::blas_warning();
  if (!slow_blas.empty())
  {
    status.warnings.push_back(slow_blas);
  }
  status.warnings.insert(status.warnings.end(), problem.constraints.warnings.begin(),
    problem.constraints.warnings.end());

  const Domain& refined = problem.mesh.domain;
  std::vector<char> used(static_cast<std::size_t>(problem.vertex_count()));
  for (Index v = 0; v < problem.vertex_count(); ++v)
  {
    used[v] = problem.constraints.roles[v] != VertexRole::unreferenced;
  }
  ScaledMesh scaled = scale_mesh(refined, used);
  problem.diagonal = scaled.diagonal;
  problem.stiffness = std::move(scaled.stiffness);
  problem.mass = std::move(scaled.mass);
  problem.mass_unit = scaled.mass_unit;
  if (problem.terms.rigidity.size() > 0)
  {
    const Eigen::VectorXd rigidity = element_rigidity(refined, problem.terms.rigidity);
    problem.rigid_stiffness = refined.is_volume()
      ? stiffness_matrix(scaled.points, refined.tets, rigidity)
      : stiffness_matrix(scaled.points, refined.triangles, rigidity);
  }
  problem.graph = vertex_graph(refined);
  collect_fixed(problem);
  report_problem(problem, status);
  problem.status = status;
  return context.canceled() ? Status::canceled() : status;
}

SparseMatrix WeightsProblem::energy(int order) const
{
  SparseMatrix q = harmonic_energy(this->stiffness, this->mass, order);
  if (this->rigid_stiffness.size() > 0)
  {
    // Q is the energy of the scaled mesh times mass_unit^(order - 1), so the rigidity is multiplied
    // by the same factor.
    q += rigidity_unit(order) * std::pow(this->mass_unit, order - 1) * this->rigid_stiffness;
  }
  return q;
}

Status check_no_terms(const WeightsProblem& problem)
{
  return problem.terms.any()
    ? Status::invalid_input("rigidity, rigid sets, bounds, pins and mirrors can only be used "
                            "with bounded and monotone weights")
    : Status();
}

Index normalize_rows(const WeightsProblem& problem, const Eigen::MatrixXd& fallback,
  const std::vector<char>& excluded, Weights& weights)
{
  const Eigen::MatrixXd& pinned = problem.terms.pinned;
  const Index m = weights.cols();
  Index fallback_rows = 0;
  for (Index v = 0; v < weights.rows(); ++v)
  {
    const VertexRole role = problem.constraints.roles[v];
    if (role == VertexRole::follower || role == VertexRole::unreferenced)
    {
      continue;
    }
    double target_sum = 1.0;
    double sum = weights.row(v).sum();
    // For each weight of the row, 1 if it is scaled, 0 if it is pinned and does not change.
    Eigen::RowVectorXd scaled = Eigen::RowVectorXd::Ones(m);
    for (Index j = 0; j < m && pinned.size() > 0 && role == VertexRole::solved; ++j)
    {
      if (!std::isnan(pinned(v, j)))
      {
        scaled[j] = 0.0;
        target_sum -= weights(v, j);
        sum -= weights(v, j);
      }
    }
    if (std::abs(sum) >= 1e-3)
    {
      for (Index j = 0; j < m; ++j)
      {
        const double part =
          target_sum == 1.0 ? weights(v, j) / sum : weights(v, j) * (target_sum / sum);
        weights(v, j) = scaled[j] == 0.0 ? weights(v, j) : part;
      }
      continue;
    }
    if (scaled.isZero())
    {
      continue;
    }
    for (Index j = 0; j < m; ++j)
    {
      scaled[j] = !excluded.empty() && excluded[v * m + j] ? 0.0 : scaled[j];
    }
    Eigen::RowVectorXd row = fallback.row(v).cwiseMax(0.0).cwiseProduct(scaled);
    row = row.sum() > 0.0 ? row : scaled;
    for (Index j = 0; j < m && row.sum() > 0.0; ++j)
    {
      weights(v, j) = scaled[j] != 0.0 ? target_sum * row[j] / row.sum() : weights(v, j);
    }
    fallback_rows += std::abs(target_sum) > 1e-12;
  }
  return fallback_rows;
}

Status finish_weights(ExecutionContext& context, const WeightsProblem& problem,
  const std::string& method, double tolerance, const std::vector<BoxQpSolution>& solutions,
  const Eigen::MatrixXd& fallback, WeightsResult& result, const std::vector<char>& excluded)
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
  for (Index v = 0; v < n; ++v)
  {
    const VertexRole role = constraints.roles[v];
    if (role == VertexRole::follower || role == VertexRole::unreferenced)
    {
      continue;
    }
    result.row_sum_error = std::max(result.row_sum_error, std::abs(1.0 - result.raw.row(v).sum()));
  }
  const Index fallback_rows = normalize_rows(problem, fallback, excluded, result.weights);
  for (Index v = 0; v < n; ++v)
  {
    if (constraints.roles[v] == VertexRole::follower)
    {
      result.raw.row(v) = result.raw.row(constraints.leader[v]);
      result.weights.row(v) = result.weights.row(constraints.leader[v]);
    }
  }
  if (fallback_rows > 0)
  {
    status.warnings.push_back(std::to_string(fallback_rows) +
      " vertices have a sum of weights near 0; their weights were replaced by weights without "
      "bounds");
  }

  std::vector<char> exempt(static_cast<std::size_t>(n), 0);
  for (Index v = 0; v < n; ++v)
  {
    exempt[v] = constraints.roles[v] != VertexRole::solved;
  }
  result.columns.assign(static_cast<std::size_t>(m), {});
  const bool completed = parallel_for(context, m, 1,
    [&](Index begin, Index end)
    {
      for (Index j = begin; j < end; ++j)
      {
        WeightsColumn& column = result.columns[j];
        const Eigen::VectorXd raw = result.raw.col(j);
        const Eigen::VectorXd normalized = result.weights.col(j);
        column.certificate = solutions[j].certificate;
        column.iterations = solutions[j].iterations;
        column.factorizations = solutions[j].factorizations;
        column.minimum = raw.minCoeff();
        column.maximum = raw.maxCoeff();
        column.zero_fraction =
          static_cast<double>((raw.array() == 0.0).count()) / static_cast<double>(n);
        column.one_fraction =
          static_cast<double>((raw.array() == 1.0).count()) / static_cast<double>(n);
        column.extrema = interior_extrema(problem.graph, raw, exempt);
        column.normalized_interior_extrema =
          static_cast<Index>(interior_extrema(problem.graph, normalized, exempt).size());
      }
    });
  if (!completed)
  {
    return Status::canceled();
  }

  Report& report = status.report;
  std::vector<double> gaps, residuals, energies, zero_fractions, one_fractions;
  std::vector<std::int64_t> iterations, factorizations, extrema, normalized_extrema;
  double bounds = 0.0;
  std::int64_t total = 0;
  std::string unconverged_names;
  for (Index j = 0; j < m; ++j)
  {
    const WeightsColumn& column = result.columns[j];
    gaps.push_back(column.certificate.relative_gap);
    residuals.push_back(column.certificate.kkt_residual);
    energies.push_back(column.certificate.energy);
    iterations.push_back(column.iterations);
    factorizations.push_back(column.factorizations);
    extrema.push_back(static_cast<std::int64_t>(column.extrema.size()));
    zero_fractions.push_back(column.zero_fraction);
    one_fractions.push_back(column.one_fraction);
    normalized_extrema.push_back(column.normalized_interior_extrema);
    bounds = problem.terms.has_bounds()
      ? std::max(bounds, column.certificate.bounds_violation)
      : std::max({ bounds, -column.minimum, column.maximum - 1.0 });
    total += column.iterations;
    context.add_seconds("factor", solutions[j].factor_seconds);
    context.add_seconds("solve", solutions[j].solve_seconds);
    if (!(std::max(gaps.back(), residuals.back()) <= tolerance))
    {
      unconverged_names +=
        (unconverged_names.empty() ? "'" : ", '") + problem.handles[j].name + "'";
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
  report.set("handles[].factorizations", factorizations);
  report.set("handles[].interior_extrema", extrema);
  report.set("handles[].interior_extrema_normalized", normalized_extrema);
  report.set("handles[].zeros", zero_fractions);
  report.set("handles[].ones", one_fractions);
  if (!unconverged_names.empty())
  {
    status.code = StatusCode::not_converged;
    status.message = "the weights of " + unconverged_names + " " +
      certificate_message(worst_gap, worst_residual, tolerance);
  }
  return status;
}

} // namespace bindpose
