// Pose time, one thread: microseconds per iteration of reduced ARAP by handles and clusters (the
// mesh does not matter: two sizes show it) and of full ARAP (by the mesh alone), bind and
// re-factor, skinning of 100k vertices with dense weights. Weights are made up (inverse distances),
// so that no solver is waited for; those of the crowd are bounded biharmonic.
#include "surfaces.h"

#include "pose/crowd.h"
#include "pose/element_stretch.h"
#include "pose/full_arap.h"
#include "pose/reduced_arap.h"
#include "pose/rotation_fit.h"
#include "pose/skinning.h"
#include "weights/bounded_biharmonic_weights.h"
#include "weights/farthest_points.h"
#include "weights/surface_weights.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace
{
using namespace bindpose;

struct Rig
{
  TriangleMesh mesh;
  Handles handles;
  Weights weights;
};

/// Point handles at farthest points, weights 1 / distance^4, normalised: 1 at the own handle.
Rig make_rig(Index triangles, Index count)
{
  Rig rig;
  rig.mesh = benchmarks::bumpy_sphere(triangles);
  ExecutionContext context;
  std::vector<Index> at;
  farthest_points(rig.mesh.points, rig.mesh.triangles, count, context, at);
  rig.weights.resize(rig.mesh.points.rows(), count);
  for (Index h = 0; h < count; ++h)
  {
    Handle handle;
    handle.name = "p" + std::to_string(h + 1);
    handle.head = handle.tail = rig.mesh.points.row(at[static_cast<std::size_t>(h)]);
    rig.weights.col(h) = (rig.mesh.points.rowwise() - handle.head.transpose())
                           .rowwise()
                           .squaredNorm()
                           .unaryExpr([](double d2) { return 1.0 / (d2 * d2 + 1e-12); });
    rig.handles.push_back(handle);
  }
  rig.weights = (rig.weights.array().colwise() / rig.weights.rowwise().sum().array()).matrix();
  return rig;
}

/// Every second handle dragged by its position, the others free.
Pose dragged(const Handles& handles, double by)
{
  Pose pose(handles.size());
  for (std::size_t h = 0; h < pose.size(); ++h)
  {
    pose[h].mode = h % 2 == 0 ? HandleMode::position : HandleMode::free;
    pose[h].transform.col(3) = by * handles[h].head.reverse();
  }
  return pose;
}

/// Arguments: triangles, handles, clusters, iterates that acceleration looks back on.
void reduced_arap_iteration(benchmark::State& state)
{
  const Rig rig = make_rig(state.range(0), state.range(1));
  ExecutionContext context;
  context.set_threads(1);
  ReducedArap arap;
  ReducedArapOptions options;
  options.clusters = state.range(2);
  arap.bind(context, rig.mesh.points, rig.mesh.triangles, rig.weights, rig.handles, options);
  const Pose pose = dragged(rig.handles, 0.3);
  double microseconds = 0.0, solves = 0.0;
  for (auto _ : state)
  {
    const Status status =
      arap.solve(context, pose, { 0.0, 200, ReducedArap::Start::rest, state.range(3) });
    microseconds += status.report.number("microseconds_per_iteration", 0.0);
    solves += 1.0;
  }
  state.counters["us_per_iteration"] = microseconds / solves;
  state.counters["clusters"] = static_cast<double>(arap.groups().count);
}
BENCHMARK(reduced_arap_iteration)
  ->ArgNames({ "triangles", "handles", "clusters", "window" })
  ->ArgsProduct({ { 20000 }, { 5 }, { 20 }, { 0, 5 } })
  ->ArgsProduct({ { 20000 }, { 20 }, { 80 }, { 0, 5 } })
  ->ArgsProduct({ { 20000 }, { 50 }, { 150 }, { 0, 5 } })
  ->Args({ 86000, 20, 80, 5 })
  ->Unit(benchmark::kMillisecond);

/// Arguments: handles, clusters, iterates that acceleration looks back on, drag in tenths of the
/// radius. A cold solve to within 1e-4 of the least energy that thousands of iterations reach.
void reduced_arap_to_energy(benchmark::State& state)
{
  const Rig rig = make_rig(20000, state.range(0));
  ExecutionContext context;
  context.set_threads(1);
  ReducedArap arap;
  ReducedArapOptions options;
  options.clusters = state.range(1);
  arap.bind(context, rig.mesh.points, rig.mesh.triangles, rig.weights, rig.handles, options);
  const Pose pose = dragged(rig.handles, 0.1 * static_cast<double>(state.range(3)));
  double least = std::numeric_limits<double>::infinity();
  for (const Index window : { 0, 5, 10 })
  {
    arap.solve(context, pose, { 0.0, 5000, ReducedArap::Start::rest, window });
    least = std::min(least, arap.energies().back());
  }
  arap.solve(context, pose, { 0.0, 5000, ReducedArap::Start::rest, state.range(2) });
  const auto iterations_to = [&](double share)
  {
    Index iterations = 0;
    while (2 * iterations + 1 < static_cast<Index>(arap.energies().size()) &&
      arap.energies()[static_cast<std::size_t>(2 * iterations)] > (1.0 + share) * least)
    {
      ++iterations;
    }
    return iterations;
  };
  const Index iterations = iterations_to(1e-4);
  state.counters["to_1e-6"] = static_cast<double>(iterations_to(1e-6));
  state.counters["to_1e-8"] = static_cast<double>(iterations_to(1e-8));
  for (auto _ : state)
  {
    arap.solve(context, pose, { 0.0, iterations, ReducedArap::Start::rest, state.range(2) });
  }
  state.counters["iterations"] = static_cast<double>(iterations);
  state.counters["least_energy"] = least;
}
BENCHMARK(reduced_arap_to_energy)
  ->ArgNames({ "handles", "clusters", "window", "drag" })
  ->ArgsProduct({ { 5 }, { 20 }, { 0, 5, 10 }, { 3, 10, 20 } })
  ->ArgsProduct({ { 20 }, { 80 }, { 0, 5, 10 }, { 3, 10, 20 } })
  ->ArgsProduct({ { 50 }, { 150 }, { 0, 5, 10 }, { 3, 10, 20 } })
  ->Unit(benchmark::kMicrosecond);

/// Arguments: triangles, handles. Clusters: automatic.
void reduced_arap_bind(benchmark::State& state)
{
  const Rig rig = make_rig(state.range(0), state.range(1));
  for (auto _ : state)
  {
    ExecutionContext context;
    context.set_threads(1);
    ReducedArap arap;
    const Status status =
      arap.bind(context, rig.mesh.points, rig.mesh.triangles, rig.weights, rig.handles);
    benchmark::DoNotOptimize(status.ok());
  }
}
BENCHMARK(reduced_arap_bind)
  ->ArgNames({ "triangles", "handles" })
  ->Args({ 20000, 20 })
  ->Args({ 86000, 20 })
  ->Unit(benchmark::kMillisecond);

/// Arguments: handles. A change of modes and a solve of one iteration.
void reduced_arap_change_of_modes(benchmark::State& state)
{
  const Rig rig = make_rig(5000, state.range(0));
  ExecutionContext context;
  context.set_threads(1);
  ReducedArap arap;
  arap.bind(context, rig.mesh.points, rig.mesh.triangles, rig.weights, rig.handles);
  Pose pose = dragged(rig.handles, 0.1);
  for (auto _ : state)
  {
    pose[0].mode = pose[0].mode == HandleMode::full ? HandleMode::position : HandleMode::full;
    arap.solve(context, pose, { 0.0, 1, ReducedArap::Start::last });
  }
}
BENCHMARK(reduced_arap_change_of_modes)
  ->ArgName("handles")
  ->Arg(20)
  ->Arg(50)
  ->Unit(benchmark::kMillisecond);

/// Arguments: triangles, iterates that acceleration looks back on.
void full_arap_iteration(benchmark::State& state)
{
  const Rig rig = make_rig(state.range(0), 20);
  ExecutionContext context;
  context.set_threads(1);
  FullArap arap;
  arap.bind(context, rig.mesh.points, rig.mesh.triangles, rig.handles);
  const Pose pose = dragged(rig.handles, 0.3);
  FullArap::SolveOptions options;
  options.tolerance = 0.0;
  options.max_iterations = 20;
  options.start = FullArap::Start::rest;
  options.anderson_window = state.range(1);
  double microseconds = 0.0, solves = 0.0;
  for (auto _ : state)
  {
    const Status status = arap.solve(context, pose, options);
    microseconds += status.report.number("microseconds_per_iteration", 0.0);
    solves += 1.0;
  }
  state.counters["us_per_iteration"] = microseconds / solves;
}
BENCHMARK(full_arap_iteration)
  ->ArgNames({ "triangles", "window" })
  ->Args({ 20000, 5 })
  ->Args({ 86000, 5 })
  ->Args({ 86000, 0 })
  ->Unit(benchmark::kMillisecond);

/// Arguments: handles, 0 linear blend or 1 dual quaternions, 1 for single precision. 100k vertices,
/// no weight is zero; in single precision those up to 1e-6 are dropped.
void skinning(benchmark::State& state)
{
  const Rig rig = make_rig(200000, state.range(0));
  ExecutionContext context;
  context.set_threads(1);
  Skinning skin;
  SkinningOptions options;
  options.single_precision = state.range(2) != 0;
  options.smallest_weight = options.single_precision ? 1e-6 : 0.0;
  skin.bind(context, rig.weights, options);
  std::vector<Affine> transforms;
  for (Index h = 0; h < state.range(0); ++h)
  {
    Affine t = identity_affine();
    t.leftCols<3>() = Eigen::AngleAxisd(0.1 * static_cast<double>(h), Vec3::UnitZ()).matrix();
    transforms.push_back(t);
  }
  const Points pivots = handle_pivots(rig.handles);
  Points posed;
  for (auto _ : state)
  {
    if (state.range(1) == 0)
    {
      skin.linear_blend(context, rig.mesh.points, transforms, posed);
    }
    else
    {
      skin.dual_quaternion(context, rig.mesh.points, transforms, pivots, posed);
    }
    benchmark::DoNotOptimize(posed.data());
  }
  state.counters["vertices"] = static_cast<double>(rig.mesh.points.rows());
  state.counters["weights"] = static_cast<double>(skin.weight_count());
}
BENCHMARK(skinning)
  ->ArgNames({ "handles", "dual", "single" })
  ->ArgsProduct({ { 5, 20, 50 }, { 0, 1 }, { 0, 1 } })
  ->Unit(benchmark::kMillisecond);

/// What the report says of elements after each pose; a bend, so that few elements are alike.
template <typename Elements>
void measure(benchmark::State& state, const Points& rest, const Elements& elements)
{
  Points posed = rest;
  for (Index v = 0; v < rest.rows(); ++v)
  {
    posed.row(v) = Eigen::AngleAxisd(rest(v, 0), Vec3::UnitZ()) * Vec3(rest.row(v));
  }
  ExecutionContext context;
  context.set_threads(1);
  ElementStretch stretch;
  for (auto _ : state)
  {
    const Status status =
      element_stretch(context, {}, rest, posed, MatrixView<Elements>(elements), stretch);
    benchmark::DoNotOptimize(status.ok());
  }
  state.counters["elements"] = static_cast<double>(elements.rows());
}

void stretch_of_triangles(benchmark::State& state)
{
  const TriangleMesh mesh = benchmarks::bumpy_sphere(200000);
  measure(state, mesh.points, mesh.triangles);
}
BENCHMARK(stretch_of_triangles)->Unit(benchmark::kMillisecond);

/// A box of Kuhn's tets.
void stretch_of_tets(benchmark::State& state)
{
  constexpr Index side = 45;
  Points points((side + 1) * (side + 1) * (side + 1), 3);
  Tets tets(6 * side * side * side, 4);
  const Index step[3] = { 1, side + 1, (side + 1) * (side + 1) };
  constexpr int order[6][3] = { { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 }, { 1, 0, 2 }, { 0, 2, 1 },
    { 2, 1, 0 } };
  Index tet = 0;
  for (Index v = 0; v < points.rows(); ++v)
  {
    const Index at[3] = { v % step[1], v / step[1] % (side + 1), v / step[2] };
    points.row(v) = Vec3(at[0], at[1], at[2]).transpose() / static_cast<double>(side);
    for (int k = 0; k < 6 && std::max({ at[0], at[1], at[2] }) < side; ++k, ++tet)
    {
      const Index one = v + step[order[k][0]], two = one + step[order[k][1]];
      tets.row(tet) << v, one, two, two + step[order[k][2]];
    }
  }
  measure(state, points, tets);
}
BENCHMARK(stretch_of_tets)->Unit(benchmark::kMillisecond);

/// Arguments: triangles, handles, clusters. 100 instances, each with a pose of its own that moves
/// on from frame to frame: solved warm with at most 10 iterations, and all vertices. Weights are
/// bounded biharmonic, those up to 1e-6 dropped.
void crowd(benchmark::State& state)
{
  Rig rig = make_rig(state.range(0), state.range(1));
  ExecutionContext context;
  SurfaceWeightsOptions where;
  where.domain = WeightsDomain::embedding;
  const WeightsMethod method =
    [](const WeightsProblem& problem, ExecutionContext& of_method, WeightsResult& result)
  { return bounded_biharmonic_weights(problem, {}, of_method, result); };
  SurfaceWeights weights;
  const Status solved = surface_weights(
    rig.mesh.points, rig.mesh.triangles, {}, rig.handles, where, {}, method, context, weights);
  if (!solved.usable())
  {
    state.SkipWithError(solved.message.c_str());
    return;
  }
  context.set_threads(1);
  Crowd crowd;
  ReducedArapOptions options;
  options.clusters = state.range(2);
  options.skinning.smallest_weight = 1e-6;
  crowd.bind(context, rig.mesh.points, rig.mesh.triangles, weights.weights, rig.handles, options);
  ReducedSolveOptions solve;
  solve.tolerance = 1e-4;
  solve.max_iterations = 10;
  std::vector<Pose> poses(100, dragged(rig.handles, 0.0));
  std::vector<FloatPoints> posed;
  double seconds = 0.0, iterations = 0.0, frames = 0.0;
  for (auto _ : state)
  {
    for (std::size_t i = 0; i < poses.size(); ++i)
    {
      const double angle = 0.05 * frames + 0.3 * static_cast<double>(i);
      for (std::size_t h = 0; h < rig.handles.size(); h += 2)
      {
        poses[i][h].transform.col(3) =
          0.2 * std::sin(angle + static_cast<double>(h)) * rig.handles[h].head.reverse();
      }
    }
    const auto start = std::chrono::steady_clock::now();
    const Status status = crowd.solve(context, poses, solve);
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    crowd.deform(context, rig.mesh.points, posed);
    iterations += status.report.number("iterations", 0.0);
    frames += 1.0;
    benchmark::DoNotOptimize(posed.data());
  }
  state.counters["frames_per_second"] = benchmark::Counter(frames, benchmark::Counter::kIsRate);
  state.counters["ms_of_solves"] = 1e3 * seconds / frames;
  state.counters["iterations_each"] = iterations / frames / 100.0;
}
BENCHMARK(crowd)
  ->ArgNames({ "triangles", "handles", "clusters" })
  ->Args({ 86000, 5, 20 })
  ->Args({ 86000, 20, 80 })
  ->Unit(benchmark::kMillisecond);

/// 1024 random 3x3 matrices; time per matrix is the time divided by 1024.
void rotation_fit(benchmark::State& state)
{
  constexpr Index count = 1024;
  const Points noise = benchmarks::scattered_points(3 * count);
  std::vector<double> s(9 * count), r(9 * count, 0.0);
  for (Index k = 0; k < count; ++k)
  {
    for (Index e = 0; e < 9; ++e)
    {
      const auto at = static_cast<std::size_t>(e * count + k);
      s[at] = 0.3 * noise(3 * k + e / 3, e % 3) + (e % 4 == 0 ? 1.0 : 0.0);
      r[at] = e % 4 == 0 ? 1.0 : 0.0;
    }
  }
  for (auto _ : state)
  {
    fit_rotations(count, count, s.data(), r.data());
    benchmark::DoNotOptimize(r.data());
  }
}
BENCHMARK(rotation_fit)->Unit(benchmark::kMicrosecond);
} // namespace
