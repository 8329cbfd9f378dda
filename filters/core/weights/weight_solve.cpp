// The passes that solve all columns of bounded or monotone weights (see weight_solve.h). Columns
// are solved group by group (column_groups.h); without mirrors there is one group.
//
// A limit k on influences keeps the k largest weights of each normalized row. The other weights are
// fixed at 0 and all columns are solved again, so that the result is a minimizer among weights with
// these nonzero entries. The choice is greedy. The nonzero entries for a smaller k are a subset of
// the nonzero entries for a larger k, so a larger k never has a higher energy.
#include "weights/weight_solve.h"

#include "qp/coupled_qp.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bindpose
{

namespace
{
/// The quadratic form of one group, and the solver of this form. All passes use the same solver.
struct GroupSolver
{
  SparseMatrix q; // the quadratic form; stored only if columns are coupled
  std::unique_ptr<BoxQp> solver;
};

/// The results of one pass over all columns.
struct ColumnSolutions
{
  std::vector<BoxQpSolution> solutions; // one solution per handle, with one value per vertex
  Eigen::MatrixXd fallback; // minimizers without bounds
  double coupled_energy = 0.0;
};

class WeightSolver
{
public:
  WeightSolver(ExecutionContext& context, const WeightsProblem& problem, int order,
    const WeightsOptions& options, const std::function<Status(ColumnGroup&)>& guide)
    : problem_(problem), order_(order), options_(options), guide_(guide), context_(context)
  {
  }

  /// Make the column groups, add the ordered pairs of monotone weights if there is a guide, and in
  /// the first pass also make the solvers.
  Status prepare(const Exclusions& excluded)
  {
    const bool coupled = this->options_.partition == PartitionOfUnity::coupled;
    Status status = make_column_groups(this->problem_, excluded, coupled, this->groups_);
    if (status.ok() && coupled && this->groups_.size() + this->groups_.front().copies > 2)
    {
      status = Status::invalid_input(
        "mirrored weights cannot be combined with the coupled partition of unity");
    }
    if (status.ok() && this->guide_)
    {
      const Phase phase(this->context_, "guide", 0.04, 0.06);
      for (ColumnGroup& group : this->groups_)
      {
        status = status.ok() ? this->guide_(group) : status;
      }
    }
    if (!status.ok() || !this->solvers_.empty())
    {
      return status;
    }
    const SparseMatrix q = this->problem_.energy(this->order_);
    const ProgressRange range(this->context_, 0.06, 0.1);
    for (const ColumnGroup& group : this->groups_)
    {
      GroupSolver group_solver;
      group_solver.q = merge_form(group, q);
      group_solver.solver = std::make_unique<BoxQp>(group_solver.q, group.fixed,
        BoxQpOptions{
          this->options_.tolerance, this->options_.maximum_iterations, this->options_.solver });
      status = group_solver.solver->prepare(this->context_, group.columns);
      if (!status.ok())
      {
        return status;
      }
      if (!coupled)
      {
        group_solver.q.resize(0, 0);
      }
      this->solvers_.push_back(std::move(group_solver));
    }
    return {};
  }

  /// Solve all columns separately, each with its own certificate.
  Status solve_separately(double begin, double end, ColumnSolutions& round)
  {
    const Phase phase(this->context_, "weights", begin, end);
    const Index m = this->problem_.handle_count();
    round.solutions.assign(static_cast<std::size_t>(m), {});
    round.fallback.resize(this->problem_.vertex_count(), m);
    const double count = static_cast<double>(this->groups_.size());
    for (std::size_t g = 0; g < this->groups_.size(); ++g)
    {
      const ColumnGroup& group = this->groups_[g];
      const BoxQp& solver = *this->solvers_[g].solver;
      const ProgressRange range(this->context_, g / count, (g + 1) / count);
      std::vector<BoxQpSolution> solved = solver.solve_all(this->context_, group.columns);
      const Status status = first_failure(solved);
      if (!status.usable())
      {
        return status;
      }
      Eigen::MatrixXd fixed_values(
        static_cast<Index>(group.fixed.size()), static_cast<Index>(group.columns.size()));
      for (std::size_t c = 0; c < group.columns.size(); ++c)
      {
        fixed_values.col(static_cast<Index>(c)) = group.columns[c].fixed_values;
      }
      const Eigen::MatrixXd unconstrained = solver.unconstrained(fixed_values);
      this->expand_solutions(group, solved, &unconstrained, round);
    }
    return {};
  }

  /// Solve all columns together, starting from the separate solutions.
  Status solve_coupled(
    const Weights& normalized, double begin, double end, ColumnSolutions& round, Status& outcome)
  {
    const Phase phase(this->context_, "coupled", begin, end);
    const ColumnGroup& group = this->groups_.front();
    Eigen::MatrixXd start(group.count, normalized.cols());
    for (Index v = 0; v < normalized.rows(); ++v)
    {
      start.row(group.unknown(v, 0, normalized.rows())) = normalized.row(v);
    }
    CoupledSolution solved = solve_coupled_qp(this->context_, this->solvers_.front().q, group.fixed,
      group.columns, start, *this->solvers_.front().solver,
      { this->options_.tolerance, this->options_.maximum_iterations, this->options_.solver });
    outcome = solved.status;
    if (outcome.code == StatusCode::invalid_input && solved.vertex >= 0)
    {
      Index v = 0;
      while (group.unknown(v, 0, normalized.rows()) != solved.vertex)
      {
        ++v;
      }
      outcome.message += " at vertex " + std::to_string(v);
    }
    if (!outcome.usable())
    {
      return outcome;
    }
    this->expand_solutions(group, solved.columns, nullptr, round);
    round.coupled_energy = solved.certificate.energy;
    return {};
  }

  /// Return the estimated peak memory of the process in bytes: the largest estimate of all groups.
  double memory_estimate() const
  {
    double most = 0.0;
    for (const GroupSolver& solver : this->solvers_)
    {
      most = std::max(most, solver.solver->memory_estimate());
    }
    return most;
  }

  Index analyses() const
  {
    Index count = 0;
    for (const GroupSolver& solver : this->solvers_)
    {
      count += solver.solver->analyses();
    }
    return count;
  }

private:
  /// Copy solutions from the unknowns of a group to vertices and handles.
  void expand_solutions(const ColumnGroup& group, const std::vector<BoxQpSolution>& solved,
    const Eigen::MatrixXd* fallback, ColumnSolutions& round) const
  {
    const Index n = this->problem_.vertex_count();
    for (std::size_t c = 0; c < group.columns.size(); ++c)
    {
      for (Index k = 0; k < group.copies; ++k)
      {
        const Index handle = group.handles[c][k];
        BoxQpSolution& solution = round.solutions[handle];
        solution = solved[c];
        solution.w.resize(n);
        for (Index v = 0; v < n; ++v)
        {
          const Index u = group.unknown(v, k, n);
          solution.w[v] = solved[c].w[u];
          if (fallback)
          {
            round.fallback(v, handle) = (*fallback)(u, static_cast<Index>(c));
          }
        }
      }
    }
  }

  const WeightsProblem& problem_;
  const int order_;
  const WeightsOptions& options_;
  const std::function<Status(ColumnGroup&)>& guide_;
  ExecutionContext& context_;
  std::vector<ColumnGroup> groups_;
  std::vector<GroupSolver> solvers_;
};

Weights normalized(
  const WeightsProblem& problem, const ColumnSolutions& round, const Exclusions& excluded)
{
  Weights weights(problem.vertex_count(), problem.handle_count());
  for (Index j = 0; j < weights.cols(); ++j)
  {
    weights.col(j) = round.solutions[j].w;
  }
  normalize_rows(problem, round.fallback, excluded, weights);
  return weights;
}

/// Exclude the smallest weights, so that each vertex has at most `most` nonzero weights. Weights
/// are never excluded if they are pinned to a nonzero value or have a lower bound above 0.
/// @param capped_count set to the number of vertices at which a weight above 0 is excluded.
Status exclude_smallest(const WeightsProblem& problem, const Weights& weights, int most,
  Exclusions& excluded, Index& capped_count)
{
  const Index m = weights.cols();
  const WeightTerms& terms = problem.terms;
  excluded.assign(static_cast<std::size_t>(weights.size()), 0);
  capped_count = 0;
  std::vector<Index> order(static_cast<std::size_t>(m));
  for (Index v = 0; v < weights.rows(); ++v)
  {
    if (problem.constraints.roles[v] != VertexRole::solved)
    {
      continue;
    }
    const auto needed = [&](Index j)
    {
      if (terms.pinned.size() > 0 && !std::isnan(terms.pinned(v, j)))
      {
        return terms.pinned(v, j) != 0.0;
      }
      return terms.lower.size() > 0 && terms.lower(v, j) > 0.0;
    };
    const auto pinned_to_zero = [&](Index j)
    { return terms.pinned.size() > 0 && terms.pinned(v, j) == 0.0; };
    std::iota(order.begin(), order.end(), Index(0));
    std::sort(order.begin(), order.end(),
      [&](Index a, Index b)
      {
        const int rank_a = needed(a) ? 0 : pinned_to_zero(a) ? 2 : 1;
        const int rank_b = needed(b) ? 0 : pinned_to_zero(b) ? 2 : 1;
        if (rank_a != rank_b)
        {
          return rank_a < rank_b;
        }
        return weights(v, a) != weights(v, b) ? weights(v, a) > weights(v, b) : a < b;
      });
    bool any = false;
    for (Index i = most; i < m; ++i)
    {
      if (needed(order[i]))
      {
        return Status::invalid_input("more than " + std::to_string(most) +
          " influences are pinned to a value above 0 or have a lower bound above 0 at vertex " +
          std::to_string(v) + ", including the influence of '" + problem.handles[order[i]].name +
          "'");
      }
      excluded[v * m + order[i]] = 1;
      any = any || weights(v, order[i]) > 0.0;
    }
    capped_count += any;
  }
  return {};
}

/// Return the largest violation of the bounds by normalized weights, at vertices that are solved
/// for.
double normalized_violation(const WeightsProblem& problem, const Weights& weights)
{
  const WeightTerms& terms = problem.terms;
  double largest_violation = 0.0;
  for (Index v = 0; v < weights.rows(); ++v)
  {
    for (Index j = 0; j < weights.cols(); ++j)
    {
      if (problem.constraints.roles[v] != VertexRole::solved)
      {
        continue;
      }
      const auto [low, high] = terms.bounds_of(j, v);
      largest_violation =
        std::max({ largest_violation, low - weights(v, j), weights(v, j) - high });
    }
  }
  return largest_violation;
}

/// Report the name of each handle's mirror image.
void report_mirror(const WeightsProblem& problem, Status& status)
{
  const std::vector<Index> partner =
    mirrored_handles(problem.terms, problem.constraints, problem.handle_count());
  std::vector<std::string> names;
  for (const Index other : partner)
  {
    names.push_back(other >= 0 ? problem.handles[other].name : "");
  }
  status.report.set("handles[].mirror", names);
  if (std::all_of(partner.begin(), partner.end(), [](Index other) { return other < 0; }))
  {
    status.warnings.emplace_back(
      "the mirror has no effect because no handle is the mirror image of another handle");
  }
}

/// Report the largest and the root mean square difference between weights a and b, over all
/// vertices that have weights.
void report_difference(const WeightsProblem& problem, const Weights& a, const Weights& b,
  const std::string& key, Report& report)
{
  double largest = 0.0;
  double sum = 0.0;
  double count = 0.0;
  for (Index v = 0; v < a.rows(); ++v)
  {
    if (problem.constraints.roles[v] != VertexRole::unreferenced)
    {
      largest = std::max(largest, (a.row(v) - b.row(v)).cwiseAbs().maxCoeff());
      sum += (a.row(v) - b.row(v)).squaredNorm();
      count += static_cast<double>(a.cols());
    }
  }
  report.set(key + ".largest_difference", largest);
  report.set(key + ".rms_difference", count > 0.0 ? std::sqrt(sum / count) : 0.0);
}
} // namespace

Status solve_weights(ExecutionContext& context, const WeightsProblem& problem, int order,
  const std::string& method, const WeightsOptions& options,
  const std::function<Status(ColumnGroup&)>& guide, WeightsResult& result)
{
  result = {};
  const bool coupled = options.partition == PartitionOfUnity::coupled;
  const bool limits_influences =
    options.maximum_influences > 0 && options.maximum_influences < problem.handle_count();
  WeightSolver solver(context, problem, order, options, guide);
  Exclusions excluded;
  ColumnSolutions round;
  Status outcome; // status of the coupled quadratic program
  Weights separate;
  Weights unlimited;
  Index capped_count = 0;
  for (int pass = 0; pass < (limits_influences ? 2 : 1); ++pass)
  {
    // Each pass gets a progress range of the same length. Within a pass, the coupled program takes
    // most of the time.
    const double length = 0.85 / (limits_influences ? 2 : 1);
    const double begin = 0.1 + pass * length;
    const double middle = begin + (coupled ? 0.3 : 1.0) * length;
    Status status = solver.prepare(excluded);
    status = status.ok() ? solver.solve_separately(begin, middle, round) : status;
    if (status.ok() && coupled)
    {
      separate = normalized(problem, round, excluded);
      status = solver.solve_coupled(separate, middle, begin + length, round, outcome);
    }
    if (status.ok() && limits_influences && pass == 0)
    {
      unlimited = normalized(problem, round, excluded);
      status =
        exclude_smallest(problem, unlimited, options.maximum_influences, excluded, capped_count);
    }
    if (!status.ok())
    {
      return status;
    }
  }
  result.analyses = solver.analyses();
  Status status = finish_weights(
    context, problem, method, options.tolerance, round.solutions, round.fallback, result, excluded);
  if (!status.usable())
  {
    return status;
  }
  status.report.set("memory_estimate_bytes", static_cast<std::int64_t>(solver.memory_estimate()));
  if (problem.terms.has_bounds())
  {
    status.report.set("normalized_bounds_violation", normalized_violation(problem, result.weights));
  }
  if (problem.terms.has_mirror())
  {
    report_mirror(problem, status);
  }
  if (limits_influences)
  {
    status.report.set("counts.capped_vertices", capped_count);
    report_difference(problem, result.weights, unlimited, "influences", status.report);
  }
  if (coupled)
  {
    status.report.set("partition.of_unity", "coupled");
    status.report.set("partition.energy", round.coupled_energy);
    report_difference(problem, result.weights, separate, "partition", status.report);
  }
  return status;
}

} // namespace bindpose
