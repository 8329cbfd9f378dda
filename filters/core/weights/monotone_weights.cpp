// The ordered pairs of monotone weights (see monotone_weights.h). The guide of a handle (see
// MonotoneGuide) is harmonic for a modified cotangent Laplacian, in which edge weights below a
// small positive minimum are raised to this minimum. The modified Laplacian satisfies the maximum
// principle; the cotangent Laplacian of most tet meshes does not. Therefore the guide, and with it
// the weights, have no extremum between handles. (A matrix with uniform edge weights also satisfies
// the principle. However, weights have a lower energy if the guide is closer to the geometry of the
// mesh.)
//
// Far from its handle a guide u is tiny; near its handle 1 - u is tiny. Both values are computed
// without cancellation: guides for positive right-hand sides have small relative errors, and 1 - u
// is the sum of the other handles' guides. Two neighbors are compared by 1 - u if u > 1/2 at both,
// else by u. Ties are broken by index, so the pairs have no cycle.
//
// At a vertex on a handle, the value is 0 or 1. The bounds then already order this vertex and all
// its neighbors, so no pairs are needed.
//
// If a column has its own pinned vertices, its guide takes their values, too. The guide then
// satisfies pins and order, which proves that the problem is feasible. The vertices of one unknown
// (rigid sets, mirrors) are one vertex of the guide.
#include "weights/monotone_weights.h"

#include "qp/free_system.h"
#include "qp/ordered_pairs.h"
#include "weights/weight_solve.h"

#include <algorithm>

namespace bindpose
{

namespace
{
/// Compute the guide u of a column with pinned vertices, and the complement 1 - u. Each of the two
/// is solved from nonnegative boundary values, so that no cancellation occurs.
Status pinned_guide(ExecutionContext& context, const SparseMatrix& laplacian,
  const std::vector<Index>& fixed, const BoxQpColumn& column, const SparseSolver::Options& options,
  Eigen::VectorXd& u, Eigen::VectorXd& complement)
{
  std::vector<Index> known_vertices = fixed;
  known_vertices.insert(known_vertices.end(), column.pinned.begin(), column.pinned.end());
  Eigen::MatrixXd values(static_cast<Index>(known_vertices.size()), 2);
  values.col(0) << column.fixed_values, column.pinned_values;
  values.col(1) = 1.0 - values.col(0).array();
  FreeSystem solver(laplacian, known_vertices);
  const Status status = solver.factor(context, options);
  if (status.ok())
  {
    const Eigen::MatrixXd solutions = solver.minimizers(values);
    u = solutions.col(0);
    complement = solutions.col(1);
  }
  return status;
}

/// Return the handle and vertex that an unknown represents, for messages.
std::string vertex_name(const WeightsProblem& problem, const ColumnGroup& group, Index c, Index u)
{
  const Index n = problem.vertex_count();
  Index member = u;
  for (Index i = 0; i < group.copies * n && !group.unknowns.empty(); ++i)
  {
    if (group.unknowns[i] == u)
    {
      member = i;
      break;
    }
  }
  return "'" + problem.handles[group.handles[c][member / n]].name + "' at vertex " +
    std::to_string(member % n);
}
} // namespace

Status monotone_guide(ExecutionContext& context, const WeightsProblem& problem, ColumnGroup& group,
  const SparseSolver::Options& solver_options, MonotoneGuide& result)
{
  const Index n = group.count;
  const auto m = static_cast<Index>(group.columns.size());
  const bool merged = !group.unknowns.empty();
  VertexGraph own_graph;
  if (merged)
  {
    own_graph = merge_graph(group, problem.graph, problem.constraints.roles);
  }
  const VertexGraph& graph = merged ? own_graph : problem.graph;
  std::vector<char> is_fixed(static_cast<std::size_t>(n), 0);
  for (const Index u : group.fixed)
  {
    is_fixed[u] = 1;
  }
  std::vector<char> is_used(static_cast<std::size_t>(problem.vertex_count()));
  for (Index v = 0; v < problem.vertex_count(); ++v)
  {
    is_used[v] = problem.constraints.roles[v] != VertexRole::follower;
  }
  const SparseMatrix laplacian =
    merge_form(group, positive_stiffness(problem.stiffness, problem.graph, is_used));
  FreeSystem solver(laplacian, group.fixed);
  Status status = solver.factor(context, solver_options);
  if (!status.ok())
  {
    return status;
  }
  Eigen::MatrixXd fixed_values(static_cast<Index>(group.fixed.size()), m);
  for (Index j = 0; j < m; ++j)
  {
    fixed_values.col(j) = group.columns[j].fixed_values;
  }
  result.guide = solver.minimizers(fixed_values);
  // Let u be the guide of column j. If the group contains all columns, their guides sum to one.
  // Then 1 - u is the sum of two parts: the guides of all later columns (column j of `later_sum`)
  // and the guides of all earlier columns (`earlier_sum`). Otherwise, `earlier_sum` is zero, and
  // column j of `later_sum` is 1 - u.
  const bool has_all_handles = m == problem.handle_count();
  Eigen::MatrixXd later_sum = Eigen::MatrixXd::Zero(n, m);
  for (Index j = m - 1; j-- > 0 && has_all_handles;)
  {
    later_sum.col(j) = later_sum.col(j + 1) + result.guide.col(j + 1);
  }
  if (!has_all_handles)
  {
    later_sum = solver.minimizers((1.0 - fixed_values.array()).matrix());
  }
  Eigen::VectorXd earlier_sum = Eigen::VectorXd::Zero(n);
  result.pairs.assign(static_cast<std::size_t>(m), {});
  for (Index j = 0; j < m; ++j)
  {
    BoxQpColumn& column = group.columns[static_cast<std::size_t>(j)];
    Eigen::VectorXd u = result.guide.col(j);
    Eigen::VectorXd complement = earlier_sum + later_sum.col(j);
    if (has_all_handles)
    {
      earlier_sum += u;
    }
    const bool has_pins = group.has_pins[static_cast<std::size_t>(j)];
    if (has_pins)
    {
      status = pinned_guide(context, laplacian, group.fixed, column, solver_options, u, complement);
      if (!status.ok())
      {
        return status;
      }
      result.guide.col(j) = u;
    }
    const auto below = [&](Index a, Index b)
    {
      if (u[a] > 0.5 && u[b] > 0.5 && complement[a] != complement[b])
      {
        return complement[a] > complement[b];
      }
      return u[a] != u[b] ? u[a] < u[b] : a < b;
    };
    std::vector<char> pinned(static_cast<std::size_t>(n), 0);
    for (const Index v : column.pinned)
    {
      pinned[v] = 1;
    }
    std::vector<double> values(
      column.pinned_values.data(), column.pinned_values.data() + column.pinned_values.size());
    for (Index v = 0; v < n; ++v)
    {
      if (!is_fixed[v] && !pinned[v] && (u[v] == 0.0 || complement[v] == 0.0))
      {
        const double value = u[v] == 0.0 ? 0.0 : 1.0;
        if (value < column.bounds.low(v) || value > column.bounds.high(v))
        {
          return Status::invalid_input("the weight of " + vertex_name(problem, group, j, v) +
            " must be " + std::to_string(static_cast<int>(value)) +
            " to be monotone, which is outside its bounds");
        }
        pinned[v] = 1;
        column.pinned.push_back(v);
        values.push_back(value);
      }
    }
    column.pinned_values =
      Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Index>(values.size()));

    // Skip pairs that are implied by the bounds because one end has the value 0 or 1.
    const auto is_known = [&](Index v) { return is_fixed[v] || pinned[v]; };
    std::vector<OrderedPair>& pairs = result.pairs[static_cast<std::size_t>(j)];
    for (Index v = 0; v < n; ++v)
    {
      if (is_known(v))
      {
        continue;
      }
      Index lowest = v;
      Index highest = v;
      for (Index k = graph.begin[v]; k < graph.begin[v + 1]; ++k)
      {
        const Index other = graph.neighbors[k];
        if (!merged && problem.constraints.roles[other] == VertexRole::follower)
        {
          continue;
        }
        lowest = below(other, lowest) ? other : lowest;
        highest = below(highest, other) ? other : highest;
      }
      const bool at_least_zero = column.bounds.low(v) >= 0.0;
      const bool at_most_one = column.bounds.high(v) <= 1.0;
      if (lowest != v && !(at_least_zero && is_known(lowest) && u[lowest] <= 0.0))
      {
        pairs.push_back({ lowest, v });
      }
      if (highest != v && !(at_most_one && is_known(highest) && u[highest] >= 1.0))
      {
        pairs.push_back({ v, highest });
      }
    }
    sort_pairs(pairs);
    column.pairs = pairs;
    const Index infeasible = has_pins || column.bounds.lower.size() > 0
      ? find_infeasible_vertex(column, group.fixed, n)
      : Index(-1);
    if (infeasible >= 0)
    {
      return Status::invalid_input("the bounds and pins of " +
        vertex_name(problem, group, j, infeasible) + " allow no monotone weight there");
    }
    if (context.canceled())
    {
      return Status::canceled();
    }
  }
  return {};
}

Status monotone_weights(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, WeightsResult& result)
{
  result = {};
  if (options.order != 2 && options.order != 3)
  {
    return Status::invalid_input("the order of monotone weights must be 2 or 3");
  }
  if (options.partition == PartitionOfUnity::coupled)
  {
    return Status::invalid_input("only bounded weights can be coupled to sum to one");
  }
  const auto guide = [&](ColumnGroup& group)
  {
    MonotoneGuide guide_data;
    return monotone_guide(context, problem, group, options.solver, guide_data);
  };
  return solve_weights(context, problem, options.order,
    options.order == 2 ? "monotone" : "monotone-triharmonic", options, guide, result);
}

} // namespace bindpose
