// Benchmarks of weights on boxes of tets with ten point handles: seconds for all handles, and for
// the parts of the computation. Times are also reported as multiples of F. F is the time of one
// factorization of the matrix Q of the biharmonic energy on the same mesh in the same run, so
// multiples of F are comparable between machines.
#include "qp/split_form.h"
#include "weights/bounded_biharmonic_weights.h"
#include "weights/monotone_weights.h"
#include "weights/preview_weights.h"
#include "transfer/transfer.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace
{
using namespace bindpose;

/// Return tets in a box of n^3 cells, six tets per cell. The box is sheared and stretched a little,
/// so that the tets do not have the regular angles of a grid.
Domain tet_box(Index n)
{
  Domain domain;
  const auto id = [n](Index i, Index j, Index k) { return (k * (n + 1) + j) * (n + 1) + i; };
  domain.points.resize((n + 1) * (n + 1) * (n + 1), 3);
  domain.tets.resize(6 * n * n * n, 4);
  Index tet = 0;
  for (Index k = 0; k <= n; ++k)
  {
    for (Index j = 0; j <= n; ++j)
    {
      for (Index i = 0; i <= n; ++i)
      {
        const Vec3 t = Vec3(double(i), double(j), double(k)) / double(n);
        domain.points.row(id(i, j, k)) << t.x() + 0.1 * std::sin(3.0 * t.y()),
          1.2 * t.y() + 0.05 * t.x() * t.z(), 0.9 * t.z();
        if (i == n || j == n || k == n)
        {
          continue;
        }
        constexpr int orders[6][3] = { { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 }, { 0, 2, 1 },
          { 2, 1, 0 }, { 1, 0, 2 } };
        for (int o = 0; o < 6; ++o)
        {
          Index at[3] = { i, j, k };
          Index ids[4] = { id(i, j, k), 0, 0, 0 };
          for (int s = 0; s < 3; ++s)
          {
            at[orders[o][s]] += 1;
            ids[s + 1] = id(at[0], at[1], at[2]);
          }
          if (o >= 3)
          {
            std::swap(ids[1], ids[2]);
          }
          domain.tets.row(tet++) << ids[0], ids[1], ids[2], ids[3];
        }
      }
    }
  }
  return domain;
}

/// Return handles at evenly spread vertices (farthest points).
Handles spread_handles(const Domain& domain, int count)
{
  Handles handles(static_cast<std::size_t>(count));
  Index next = 0;
  Eigen::VectorXd distance = Eigen::VectorXd::Constant(domain.points.rows(), 1e300);
  for (int i = 0; i < count; ++i)
  {
    handles[i].name = "p" + std::to_string(i + 1);
    handles[i].head = handles[i].tail = domain.points.row(next);
    const Eigen::VectorXd here =
      (domain.points.rowwise() - domain.points.row(next)).rowwise().squaredNorm();
    distance = distance.cwiseMin(here);
    distance.maxCoeff(&next);
  }
  return handles;
}

WeightsProblem problem_of(Index cells, int handles)
{
  ExecutionContext context;
  WeightsProblem problem;
  const Domain domain = tet_box(cells);
  make_weights_problem(context, domain, {}, spread_handles(domain, handles), {}, problem);
  return problem;
}

/// Return F in seconds: the time of one factorization by CHOLMOD in double precision. The matrix is
/// the biharmonic energy, restricted to the unconstrained vertices.
double seconds_of_f(const WeightsProblem& problem)
{
  const SplitForm form(harmonic_energy(problem.stiffness, problem.mass, 2), problem.fixed);
  SparseSolver solver;
  solver.analyze(form.lower);
  const auto start = std::chrono::steady_clock::now();
  solver.factor(form.lower);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  return seconds.count();
}

template <typename Options, typename Solve>
void run(benchmark::State& state, Solve solve)
{
  const int handles = static_cast<int>(state.range(1));
  const WeightsProblem problem = problem_of(state.range(0), handles);
  WeightsResult result;
  double analyze = 0.0;
  double factor = 0.0;
  double iterate = 0.0;
  for (auto _ : state)
  {
    ExecutionContext context;
    context.set_threads(1);
    const Status status = solve(context, problem, Options(), result);
    if (!status.ok())
    {
      state.SkipWithError(status.message.c_str());
      return;
    }
    analyze = context.seconds().number("seconds.analyze", 0.0);
    factor = context.seconds().number("seconds.factor", 0.0);
    iterate = context.seconds().number("seconds.solve", 0.0);
  }
  const double f = seconds_of_f(problem);
  double gap = 0.0;
  double residual = 0.0;
  double factorizations = 0.0;
  for (const WeightsColumn& column : result.columns)
  {
    gap = std::max(gap, column.certificate.relative_gap);
    residual = std::max(residual, column.certificate.kkt_residual);
    factorizations += column.factorizations;
  }
  state.counters["vertices"] = static_cast<double>(problem.vertex_count());
  state.counters["tets"] = static_cast<double>(problem.mesh.domain.tets.rows());
  state.counters["analyze_s"] = analyze;
  state.counters["factor_s_per_handle"] = factor / handles;
  state.counters["solve_s_per_handle"] = iterate / handles;
  state.counters["factorizations_per_handle"] = factorizations / handles;
  state.counters["F_s"] = f;
  state.counters["F_per_handle"] = (factor + iterate) / handles / f;
  state.counters["relative_gap"] = gap;
  state.counters["kkt_residual"] = residual;
}

void bounded_biharmonic(benchmark::State& state)
{
  run<WeightsOptions>(state, bounded_biharmonic_weights);
}

void monotone(benchmark::State& state)
{
  run<WeightsOptions>(state, monotone_weights);
}

/// Measure the time of a complete preview in units of F. A user waits this long for the first
/// weights.
void preview(benchmark::State& state)
{
  const WeightsProblem problem = problem_of(state.range(0), static_cast<int>(state.range(1)));
  WeightsResult result;
  double seconds = 0.0;
  for (auto _ : state)
  {
    ExecutionContext context;
    context.set_threads(1);
    const Status status = preview_weights(context, problem, {}, result);
    if (!status.ok())
    {
      state.SkipWithError(status.message.c_str());
      return;
    }
    seconds = context.seconds().number("seconds.preview", 0.0);
  }
  const double f = seconds_of_f(problem);
  state.counters["vertices"] = static_cast<double>(problem.vertex_count());
  state.counters["tets"] = static_cast<double>(problem.mesh.domain.tets.rows());
  state.counters["F_s"] = f;
  state.counters["F_in_all"] = seconds / f;
}

void transfer_weights(benchmark::State& state)
{
  const Domain coarse = tet_box(state.range(0));
  const Domain fine = tet_box(2 * state.range(0) + 1);
  const Weights values = Weights::Constant(coarse.points.rows(), 10, 0.1);
  Weights result;
  TransferCounts counts;
  ExecutionContext context;
  context.set_threads(1);
  for (auto _ : state)
  {
    transfer(context, coarse, values, fine.points, {}, result, counts);
  }
  state.SetItemsProcessed(state.iterations() * fine.points.rows());
}
} // namespace

BENCHMARK(bounded_biharmonic)
  ->Name("weights/bounded_biharmonic")
  ->ArgNames({ "cells", "handles" })
  ->Args({ 16, 10 })
  ->Args({ 22, 10 })
  ->Iterations(1)
  ->Unit(benchmark::kSecond);
BENCHMARK(monotone)
  ->Name("weights/monotone")
  ->ArgNames({ "cells", "handles" })
  ->Args({ 16, 10 })
  ->Iterations(1)
  ->Unit(benchmark::kSecond);
BENCHMARK(preview)
  ->Name("weights/preview")
  ->ArgNames({ "cells", "handles" })
  ->Args({ 16, 10 })
  ->Args({ 22, 10 })
  ->Args({ 22, 24 })
  ->Args({ 40, 4 })
  ->Iterations(1)
  ->Unit(benchmark::kSecond);
BENCHMARK(transfer_weights)->Name("weights/transfer")->Arg(16)->Unit(benchmark::kMillisecond);
