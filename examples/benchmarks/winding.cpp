// Winding numbers: build and evaluation by method and size, one thread. The yardstick row is the
// plain solid-angle sum, in seconds per triangle and point: compare ratios, not machines.
#include "surfaces.h"

#include "inside/winding_number.h"

#include <benchmark/benchmark.h>

#include <cmath>

namespace
{
using namespace bindpose;

enum Surface
{
  closed,
  open,
  soup
};

TriangleMesh surface(Index kind, Index triangles)
{
  switch (kind)
  {
    case closed:
      return benchmarks::bumpy_sphere(triangles);
    case open:
      return benchmarks::open_bumpy_sphere(triangles);
    default:
      return benchmarks::patches(triangles);
  }
}

WindingNumber build(const TriangleMesh& mesh, WindingMethod method)
{
  ExecutionContext context;
  context.set_threads(1);
  WindingNumber::Options options;
  options.method = method;
  WindingNumber winding;
  winding.build(mesh.points, mesh.triangles, context, options);
  return winding;
}

/// The formula as textbooks print it, nothing else: what one term of the sum costs here.
void winding_yardstick(benchmark::State& state)
{
  const TriangleMesh mesh = benchmarks::bumpy_sphere(state.range(0));
  const Points queries = benchmarks::scattered_points(64);
  Index q = 0;
  for (auto _ : state)
  {
    const Vec3 p = queries.row(q++ % queries.rows());
    double sum = 0.0;
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
    {
      const Vec3 a = mesh.points.row(mesh.triangles(t, 0)).transpose() - p;
      const Vec3 b = mesh.points.row(mesh.triangles(t, 1)).transpose() - p;
      const Vec3 c = mesh.points.row(mesh.triangles(t, 2)).transpose() - p;
      const double la = a.norm(), lb = b.norm(), lc = c.norm();
      sum +=
        std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    benchmark::DoNotOptimize(sum);
  }
  state.counters["per_triangle"] = benchmark::Counter(
    static_cast<double>(mesh.triangles.rows()) * static_cast<double>(state.iterations()),
    benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void winding_build(benchmark::State& state)
{
  const TriangleMesh mesh = surface(state.range(0), state.range(1));
  double bytes = 0.0;
  for (auto _ : state)
  {
    bytes = static_cast<double>(build(mesh, WindingMethod::automatic).memory());
  }
  state.counters["triangles"] = static_cast<double>(mesh.triangles.rows());
  state.counters["bytes_per_triangle"] = bytes / static_cast<double>(mesh.triangles.rows());
}

template <bool Grid>
void winding_evaluate(benchmark::State& state, WindingMethod method)
{
  const TriangleMesh mesh = surface(state.range(0), state.range(1));
  const WindingNumber winding = build(mesh, method);
  SampleGrid grid;
  grid.origin = Vec3::Constant(-1.2);
  grid.spacing = Vec3::Constant(2.4 / 11.0);
  grid.extent = { 0, 11, 0, 11, 0, 11 };
  const Points queries = benchmarks::scattered_points(grid.count());
  ExecutionContext context;
  context.set_threads(1);
  Eigen::VectorXd values;
  for (auto _ : state)
  {
    Grid ? winding.evaluate(grid, context, values) : winding.evaluate(queries, context, values);
  }
  state.SetLabel(to_string(winding.method()));
  state.counters["open_edges"] = winding.status().report.number("counts.open_edges", 0.0);
  state.counters["per_point"] =
    benchmark::Counter(static_cast<double>(grid.count()) * static_cast<double>(state.iterations()),
      benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

constexpr auto winding_points = winding_evaluate<false>;
constexpr auto winding_grid = winding_evaluate<true>;

BENCHMARK(winding_yardstick)->Arg(5000)->Unit(benchmark::kMicrosecond);
BENCHMARK(winding_build)
  ->ArgNames({ "surface", "triangles" })
  ->ArgsProduct({ { closed, open, soup }, { 5000, 86000 } })
  ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(winding_grid, automatic, WindingMethod::automatic)
  ->ArgNames({ "surface", "triangles" })
  ->ArgsProduct({ { closed, open, soup }, { 5000, 86000 } })
  ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(winding_points, automatic, WindingMethod::automatic)
  ->ArgNames({ "surface", "triangles" })
  ->ArgsProduct({ { closed, open, soup }, { 5000, 86000 } })
  ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(winding_points, hierarchical, WindingMethod::hierarchical)
  ->ArgNames({ "surface", "triangles" })
  ->ArgsProduct({ { closed, open, soup }, { 5000, 86000 } })
  ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(winding_points, crossings, WindingMethod::crossings)
  ->ArgNames({ "surface", "triangles" })
  ->ArgsProduct({ { open, soup }, { 5000, 86000 } })
  ->Unit(benchmark::kMillisecond);
} // namespace
