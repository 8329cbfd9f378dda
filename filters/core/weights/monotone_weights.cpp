// The guide of a handle is harmonic for the cotangent Laplacian with negative weights raised to
// small positive ones: unlike the cotangent Laplacian itself on most tet meshes it obeys the
// maximum principle, so it has no extremum between handles that would be built into the weights.
// (Uniform weights would do that, too, but a guide closer to the mesh's geometry costs less
// energy.)
//
// Far from a handle a guide is tiny, far inside its reach it is 1 - tiny. Both are computed without
// cancellation: guides of positive right-hand sides come out with small relative errors, and
// 1 - u is the sum of the other handles' guides. Two vertices are compared by u where it is small
// and by 1 - u where that is small; ties go to the index, so the pairs cannot run in a circle.
//
// A prescribed extremum has the value 0 or 1, so that all edges at it are ordered by the bounds.
#include "weights/monotone_weights.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
/// Cotangent stiffness with every edge's weight raised to a small positive one. Followers have no
/// weights of their own: their edges must not pull.
SparseMatrix positive_stiffness(const WeightsProblem& problem)
{
  // As a share of the diagonals: small enough not to turn the guide, large enough to keep the
  // solution's rounding errors small.
  constexpr double least_weight = 1e-3;
  const VertexGraph& graph = problem.graph;
  const auto& roles = problem.constraints.roles;
  const Eigen::VectorXd diagonal = problem.stiffness.diagonal();
  const auto n = static_cast<int>(problem.vertex_count());
  std::vector<Eigen::Triplet<double, int>> entries;
  entries.reserve(graph.neighbours.size() + static_cast<std::size_t>(n));
  for (int v = 0; v < n; ++v)
  {
    double degree = 0;
    for (Index k = graph.begin[v]; k < graph.begin[v + 1]; ++k)
    {
      const Index other = graph.neighbours[k];
      if (roles[v] != VertexRole::follower && roles[other] != VertexRole::follower)
      {
        const double least = least_weight * std::sqrt(diagonal[v] * diagonal[other]);
        const double w = std::max(-problem.stiffness.coeff(v, other), least);
        entries.emplace_back(v, static_cast<int>(other), -w);
        degree += w;
      }
    }
    entries.emplace_back(v, v, degree);
  }
  SparseMatrix laplacian(n, n);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  return laplacian;
}
} // namespace

Status monotone_guide(const WeightsProblem& problem, const SparseSolver::Options& solver_options,
  ExecutionContext& context, MonotoneGuide& result, std::vector<BoxQpColumn>& columns)
{
  const Index n = problem.vertex_count();
  const Index m = problem.handle_count();
  const VertexGraph& graph = problem.graph;
  const auto& roles = problem.constraints.roles;
  const SparseMatrix laplacian = positive_stiffness(problem);
  BoxQp solver(laplacian, problem.fixed, { 1e-6, 1, solver_options });
  const Status status = solver.prepare(context);
  if (!status.ok())
  {
    return status;
  }
  result.guide = solver.unconstrained(problem.fixed_values, false);
  // Sums of the guides behind column j; those before it are summed up on the way.
  Eigen::MatrixXd behind = Eigen::MatrixXd::Zero(n, m);
  for (Index j = m - 1; j-- > 0;)
  {
    behind.col(j) = behind.col(j + 1) + result.guide.col(j + 1);
  }
  Eigen::VectorXd before = Eigen::VectorXd::Zero(n);
  result.pairs.assign(static_cast<std::size_t>(m), {});
  for (Index j = 0; j < m; ++j)
  {
    const Eigen::VectorXd u = result.guide.col(j);
    const Eigen::VectorXd rest = before + behind.col(j);
    before += u;
    const auto below = [&](Index a, Index b)
    {
      if (u[a] > 0.5 && u[b] > 0.5 && rest[a] != rest[b])
      {
        return rest[a] > rest[b];
      }
      return u[a] != u[b] ? u[a] < u[b] : a < b;
    };
    BoxQpColumn& column = columns[static_cast<std::size_t>(j)];
    std::vector<char> pinned(static_cast<std::size_t>(n), 0);
    for (const Index v : column.pinned)
    {
      pinned[v] = 1;
    }
    std::vector<double> values(
      column.pinned_values.data(), column.pinned_values.data() + column.pinned_values.size());
    for (Index v = 0; v < n; ++v)
    {
      if (roles[v] == VertexRole::solved && !pinned[v] && (u[v] == 0.0 || rest[v] == 0.0))
      {
        pinned[v] = 1;
        column.pinned.push_back(v);
        values.push_back(u[v] == 0.0 ? 0.0 : 1.0);
      }
    }
    column.pinned_values =
      Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Index>(values.size()));

    // Pairs that an end with the value 0 or 1 orders anyway are left out.
    const auto given = [&](Index v) { return roles[v] != VertexRole::solved || pinned[v]; };
    std::vector<OrderedPair>& pairs = result.pairs[static_cast<std::size_t>(j)];
    for (Index v = 0; v < n; ++v)
    {
      if (given(v))
      {
        continue;
      }
      Index lowest = v;
      Index highest = v;
      for (Index k = graph.begin[v]; k < graph.begin[v + 1]; ++k)
      {
        const Index other = graph.neighbours[k];
        if (roles[other] == VertexRole::follower)
        {
          continue;
        }
        lowest = below(other, lowest) ? other : lowest;
        highest = below(highest, other) ? other : highest;
      }
      if (lowest != v && !(given(lowest) && u[lowest] <= 0.0))
      {
        pairs.push_back({ lowest, v });
      }
      if (highest != v && !(given(highest) && u[highest] >= 1.0))
      {
        pairs.push_back({ v, highest });
      }
    }
    std::sort(pairs.begin(), pairs.end(),
      [](const OrderedPair& x, const OrderedPair& y)
      { return x.low != y.low ? x.low < y.low : x.high < y.high; });
    pairs.erase(std::unique(pairs.begin(), pairs.end(),
                  [](const OrderedPair& x, const OrderedPair& y)
                  { return x.low == y.low && x.high == y.high; }),
      pairs.end());
    column.pairs = pairs;
    if (context.cancelled())
    {
      return Status::cancelled();
    }
  }
  return {};
}

Status monotone_weights(const WeightsProblem& problem, const MonotoneWeightsOptions& options,
  ExecutionContext& context, WeightsResult& result)
{
  result = {};
  if (options.order != 2 && options.order != 3)
  {
    return Status::invalid_input("the order of monotone weights is 2 or 3");
  }
  std::vector<BoxQpColumn> columns = problem.columns();
  MonotoneGuide guide;
  Status status;
  {
    const Phase phase(context, "guide", 0.04, 0.06);
    status = monotone_guide(problem, options.solver, context, guide, columns);
  }
  if (!status.ok())
  {
    return status;
  }
  const SparseMatrix q = harmonic_energy(problem.stiffness, problem.mass, options.order);
  BoxQp solver(q, problem.fixed, { options.tolerance, options.maximum_iterations, options.solver });
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
    solutions = solver.solve_all(columns, context);
  }
  status = worst_of(solutions);
  if (!status.usable())
  {
    return status;
  }
  result.analyses = solver.analyses();
  return finish_weights(problem, options.order == 2 ? "monotone" : "monotone-triharmonic",
    options.tolerance, solutions, solver.unconstrained(problem.fixed_values), context, result);
}

} // namespace bindpose
