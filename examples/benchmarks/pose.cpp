// Benchmarks of pose time on one thread:
// - Reduced as-rigid-as-possible (ARAP) deformation: time of an iteration, of the bind and of a
//   change of modes, and memory of the bind. The rows differ in the number of handles, the number
//   of clusters and the energy. Three mesh sizes show that the time of an iteration does not depend
//   on the mesh.
// - Full ARAP: time of an iteration, which depends only on the mesh.
// - Skinning of 100k vertices, the report of stretch, a crowd, and rotation fits.
//
// Weights are inverse distances, which need no solver. Only two benchmarks use bounded biharmonic
// weights: the crowd, and skinning if its argument `bounded` is 1. pose_table.py creates the tables
// of README.md from the results.
#include "surfaces.h"

#include "arap/crowd.h"
#include "arap/full_arap.h"
#include "arap/reduced_arap.h"
#include "base/memory.h"
#include "handles/farthest_points.h"
#include "pose/element_stretch.h"
#include "pose/rotation_fit.h"
#include "skinning/skinning.h"
#include "weights/bounded_biharmonic_weights.h"
#include "weights/surface_weights.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <limits>
#include <map>
#include <string>
#include <utility>

namespace
{
using namespace bindpose;

struct Rig
{
  TriangleMesh mesh;
  Handles handles;
  Weights weights;
};

/// Return weights 1 / distance^4, #V x #handles, with rows divided by their sums. At the position
/// of a handle, the weight of this handle is 1.
Weights distance_weights(const Points& points, const Handles& handles)
{
  Weights weights(points.rows(), static_cast<Index>(handles.size()));
  for (Index h = 0; h < weights.cols(); ++h)
  {
    weights.col(h) = (points.rowwise() - handles[static_cast<std::size_t>(h)].head.transpose())
                       .rowwise()
                       .squaredNorm()
                       .unaryExpr([](double d2) { return 1.0 / (d2 * d2 + 1e-12); });
  }
  return (weights.array().colwise() / weights.rowwise().sum().array()).matrix();
}

/// Return a closed surface with `count` point handles, without weights. Farthest-point sampling of
/// the surface gives the positions of the handles.
Rig make_bare_rig(Index triangles, Index count)
{
  Rig rig;
  rig.mesh = benchmarks::bumpy_sphere(triangles);
  ExecutionContext context;
  std::vector<Index> at;
  farthest_points(context, rig.mesh.points, rig.mesh.triangles, count, at);
  for (Index h = 0; h < count; ++h)
  {
    Handle handle;
    handle.name = "p" + std::to_string(h + 1);
    handle.head = handle.tail = rig.mesh.points.row(at[static_cast<std::size_t>(h)]);
    rig.handles.push_back(handle);
  }
  return rig;
}

Rig make_rig(Index triangles, Index count)
{
  Rig rig = make_bare_rig(triangles, count);
  rig.weights = distance_weights(rig.mesh.points, rig.handles);
  return rig;
}

/// Add bounded biharmonic weights, computed in a lattice around the surface.
Status add_bounded_weights(Rig& rig)
{
  ExecutionContext context;
  SurfaceWeightsOptions where;
  where.domain = WeightsDomain::embedding;
  const WeightsMethod method =
    [](ExecutionContext& method_context, const WeightsProblem& problem, WeightsResult& result)
  { return bounded_biharmonic_weights(method_context, problem, {}, result); };
  SurfaceWeights weights;
  const Status status = surface_weights(
    context, rig.mesh.points, rig.mesh.triangles, {}, rig.handles, where, {}, method, weights);
  rig.weights = std::move(weights.weights);
  return status;
}

/// Return a pose in which every second handle is in mode position and moved by the distance `by`.
/// All other handles are in mode free.
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

/// Return the median processor time of several calls, in seconds. Processor time does not depend on
/// other processes.
template <typename Call>
double processor_seconds(int calls, const Call& call)
{
  std::vector<double> seconds;
  for (int i = 0; i < calls; ++i)
  {
    const std::clock_t start = std::clock();
    call();
    seconds.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  std::nth_element(seconds.begin(), seconds.begin() + calls / 2, seconds.end());
  return seconds[static_cast<std::size_t>(calls / 2)];
}

/// Reset the peak of peak_memory() to the current memory (Linux only).
void reset_peak_memory()
{
  std::ofstream("/proc/self/clear_refs") << "5";
}

/// Measure one row of the table: the bind, iterations without and with acceleration, a cold solve
/// (from the rest pose) to convergence, and a change of modes. The counter converge_us is the time
/// of one cold solve. The time that Google Benchmark itself reports contains all repetitions of the
/// cold solve.
template <typename Elements>
void measure_reduced(benchmark::State& state, const Points& points, const Elements& elements,
  const Weights& weights, const Handles& handles, const ReducedArapOptions& options)
{
  ExecutionContext context;
  context.set_threads(1);
  ReducedArap arap;
  reset_peak_memory();
  const double before = resident_memory();
  const double bind = processor_seconds(1,
    [&]()
    { arap.bind(context, points, MatrixView<Elements>(elements), weights, handles, options); });
  state.counters["bind_MiB"] = (peak_memory() - before) / mebibyte;
  state.counters["bind_s"] = bind;

  Pose pose = dragged(handles, 0.3);
  const bool large = handles.size() >= 100;
  const int calls = large ? 5 : 15, solves = large ? 5 : 100;
  // The time per iteration is (time of 9 iterations - time of 2 iterations) / 7, which excludes the
  // work before the first and after the last iteration. All solves start at rest and end before
  // convergence.
  const auto seconds = [&](Index iterations, Index window, bool mixed)
  {
    const ReducedArap::SolveOptions solve{ 0.0, iterations, ReducedArap::Start::rest, window, 0.0,
      mixed };
    arap.solve(context, pose, solve); // computes the factorization, which is not measured
    return processor_seconds(calls,
      [&]()
      {
        for (int i = 0; i < solves; ++i)
        {
          arap.solve(context, pose, solve);
        }
      });
  };
  const auto microseconds = [&](Index window, bool mixed)
  { return 1e6 * (seconds(9, window, mixed) - seconds(2, window, mixed)) / (7.0 * solves); };
  state.counters["double_us"] = microseconds(0, false);
  state.counters["plain_us"] = microseconds(0, true);
  state.counters["us"] = microseconds(5, true);
  state.counters["modes_ms"] = 1e3 *
    processor_seconds(calls,
      [&]()
      {
        pose[0].mode = pose[0].mode == HandleMode::full ? HandleMode::position : HandleMode::full;
        arap.solve(context, pose, { 0.0, 0 });
      });
  pose = dragged(handles, 0.3);
  ReducedArap::SolveOptions converge;
  converge.max_iterations = 2000;
  converge.start = ReducedArap::Start::rest;
  arap.solve(context, pose, converge);
  for (auto _ : state)
  {
    state.counters["converge_us"] =
      1e6 * processor_seconds(calls, [&]() { arap.solve(context, pose, converge); });
  }
  state.counters["iterations"] = static_cast<double>(arap.energies().size() / 2);
  state.counters["clusters"] = static_cast<double>(arap.groups().count);
}

/// Measure reduced ARAP on a surface. Arguments: triangles, handles, clusters, energy
/// (bindpose::ArapEnergy).
void reduced_arap(benchmark::State& state)
{
  const Rig rig = make_rig(state.range(0), state.range(1));
  ReducedArapOptions options;
  options.clusters = state.range(2);
  options.energy = static_cast<ArapEnergy>(state.range(3));
  state.SetLabel(to_string(options.energy, false));
  measure_reduced(state, rig.mesh.points, rig.mesh.triangles, rig.weights, rig.handles, options);
}
BENCHMARK(reduced_arap)
  ->ArgNames({ "triangles", "handles", "clusters", "energy" })
  ->ArgsProduct({ { 86000 }, { 5 }, { 20 }, { 1, 2, 3 } })
  ->ArgsProduct({ { 86000 }, { 20 }, { 80 }, { 1, 2, 3 } })
  ->ArgsProduct({ { 86000 }, { 20 }, { 400 }, { 1, 2, 3 } })
  ->ArgsProduct({ { 86000 }, { 50 }, { 150 }, { 1, 2, 3 } })
  ->ArgsProduct({ { 86000 }, { 100 }, { 300 }, { 1, 2, 3 } })
  ->ArgsProduct({ { 86000 }, { 300 }, { 600 }, { 1, 2, 3 } })
  ->Args({ 5000, 20, 80, 1 })
  ->Args({ 20000, 20, 80, 1 })
  ->Iterations(1)
  ->Unit(benchmark::kMillisecond);

/// Return Kuhn's tets in a box, six per cube.
TetMesh tet_grid(Index side)
{
  TetMesh mesh;
  mesh.points.resize((side + 1) * (side + 1) * (side + 1), 3);
  mesh.tets.resize(6 * side * side * side, 4);
  const Index step[3] = { 1, side + 1, (side + 1) * (side + 1) };
  constexpr int order[6][3] = { { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 }, { 1, 0, 2 }, { 0, 2, 1 },
    { 2, 1, 0 } };
  Index tet = 0;
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    const Index at[3] = { v % step[1], v / step[1] % (side + 1), v / step[2] };
    mesh.points.row(v) = Vec3(at[0], at[1], at[2]).transpose() / static_cast<double>(side);
    for (int k = 0; k < 6 && std::max({ at[0], at[1], at[2] }) < side; ++k, ++tet)
    {
      const Index one = v + step[order[k][0]], two = one + step[order[k][1]];
      mesh.tets.row(tet) << v, one, two, two + step[order[k][2]];
      if (k >= 3)
      {
        std::swap(mesh.tets(tet, 1), mesh.tets(tet, 2));
      }
    }
  }
  return mesh;
}

/// Measure reduced ARAP with the energy of tets, in a box of 43k vertices. Arguments: handles,
/// clusters.
void reduced_arap_of_tets(benchmark::State& state)
{
  const TetMesh mesh = tet_grid(34);
  // Place the handles at random vertices of the box.
  Handles handles;
  const Index count = state.range(0);
  benchmarks::Random random;
  for (Index h = 0; h < count; ++h)
  {
    Handle handle;
    handle.name = "p" + std::to_string(h + 1);
    handle.head = handle.tail = mesh.points.row(random.below(mesh.points.rows()));
    handles.push_back(handle);
  }
  ReducedArapOptions options;
  options.clusters = state.range(1);
  state.SetLabel("tetrahedra");
  measure_reduced(
    state, mesh.points, mesh.tets, distance_weights(mesh.points, handles), handles, options);
}
BENCHMARK(reduced_arap_of_tets)
  ->ArgNames({ "handles", "clusters" })
  ->Args({ 5, 20 })
  ->Args({ 20, 80 })
  ->Args({ 20, 400 })
  ->Args({ 50, 150 })
  ->Args({ 100, 300 })
  ->Args({ 300, 600 })
  ->Iterations(1)
  ->Unit(benchmark::kMillisecond);

/// Return the number of iterations until the energy of a solve is at most `energy`. `energies` has
/// two entries per iteration, one after each half-step.
Index iterations_until(const std::vector<double>& energies, double energy)
{
  Index iterations = 0;
  while (2 * iterations + 1 < static_cast<Index>(energies.size()) &&
    energies[static_cast<std::size_t>(2 * iterations)] > energy)
  {
    ++iterations;
  }
  return iterations;
}

/// Measure a cold solve until its energy is within 1e-4 of the lowest energy that thousands of
/// iterations reach. Arguments: handles, clusters, number of iterates used by the acceleration,
/// distance of the drag in tenths of the radius.
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
  const auto iterations_to_tolerance = [&](double relative_excess)
  { return iterations_until(arap.energies(), (1.0 + relative_excess) * least); };
  const Index iterations = iterations_to_tolerance(1e-4);
  state.counters["to_1e-6"] = static_cast<double>(iterations_to_tolerance(1e-6));
  state.counters["to_1e-8"] = static_cast<double>(iterations_to_tolerance(1e-8));
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

/// Measure one iteration of full ARAP. Arguments: triangles, number of iterates used by the
/// acceleration.
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

/// Measure skinning of 100k vertices. Arguments: handles; method (0 linear blend, 1 dual
/// quaternions, 2 stretchable bones); 1 for single precision; 1 for bounded biharmonic weights
/// (otherwise no weight is zero). Weights of at most 1e-6 are dropped, and the largest sum of
/// dropped weights of a vertex is reported.
void skinning(benchmark::State& state)
{
  const Index count = state.range(0);
  // Handles and weights are cached between rows, because computing them for all three handle counts
  // takes a minute.
  static std::map<std::pair<Index, bool>, Rig> rigs;
  Rig& rig = rigs[{ count, state.range(3) != 0 }];
  if (rig.handles.empty())
  {
    rig = make_bare_rig(200000, count);
    for (Handle& handle : rig.handles)
    {
      handle.kind = HandleKind::bone;
      handle.tail = 0.5 * handle.head;
    }
    if (state.range(3) == 0)
    {
      rig.weights = distance_weights(rig.mesh.points, rig.handles);
    }
    else if (const Status solved = add_bounded_weights(rig); !solved.usable())
    {
      state.SkipWithError(solved.message.c_str());
      return;
    }
  }
  ExecutionContext context;
  context.set_threads(1);
  Skinning skin;
  SkinningOptions options;
  options.single_precision = state.range(2) != 0;
  options.smallest_weight = 1e-6;
  const Status bound = skin.bind(context, rig.weights, options);
  std::vector<Affine> transforms;
  std::vector<BoneChange> bones;
  for (Index h = 0; h < count; ++h)
  {
    const Handle& handle = rig.handles[static_cast<std::size_t>(h)];
    Affine t = identity_affine();
    t.leftCols<3>() = Eigen::AngleAxisd(0.1 * static_cast<double>(h), Vec3::UnitZ()).matrix();
    transforms.push_back(t);
    bones.push_back({ handle.head, handle.tail - handle.head, 1.2, Eigen::Vector2d(0.0, 30.0) });
  }
  const Points pivots = handle_pivots(rig.handles);
  Points posed;
  for (auto _ : state)
  {
    switch (state.range(1))
    {
      case 0:
        skin.linear_blend(context, rig.mesh.points, transforms, posed);
        break;
      case 1:
        skin.dual_quaternion(context, rig.mesh.points, transforms, pivots, posed);
        break;
      default:
        skin.stretchable_bones(context, rig.mesh.points, transforms, bones, Weights(), posed);
    }
    benchmark::DoNotOptimize(posed.data());
  }
  Skinning exact;
  Points reference;
  exact.bind(context, rig.weights);
  switch (state.range(1))
  {
    case 0:
      exact.linear_blend(context, rig.mesh.points, transforms, reference);
      break;
    case 1:
      exact.dual_quaternion(context, rig.mesh.points, transforms, pivots, reference);
      break;
    default:
      exact.stretchable_bones(context, rig.mesh.points, transforms, bones, Weights(), reference);
  }
  state.counters["error"] =
    (posed - reference).rowwise().norm().maxCoeff() / bounding_box(rig.mesh.points).diagonal();
  state.counters["weights_each"] =
    static_cast<double>(skin.weight_count()) / static_cast<double>(rig.mesh.points.rows());
  state.counters["dropped_share"] = bound.report.number("dropped_share", 0.0);
}
BENCHMARK(skinning)
  ->ArgNames({ "handles", "method", "single", "bounded" })
  ->ArgsProduct({ { 5, 20, 50 }, { 0, 1, 2 }, { 0, 1 }, { 0, 1 } })
  ->Unit(benchmark::kMillisecond);

/// Measure the report of stretch after a pose. The pose is a bend, so that few elements have equal
/// stretch.
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
  const RestElements shapes(rest, MatrixView<Elements>(elements));
  for (auto _ : state)
  {
    const Status status = shapes.stretch(context, {}, posed, stretch);
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

void stretch_of_tets(benchmark::State& state)
{
  const TetMesh mesh = tet_grid(45);
  measure(state, mesh.points, mesh.tets);
}
BENCHMARK(stretch_of_tets)->Unit(benchmark::kMillisecond);

/// Measure a crowd of 100 instances, each with its own pose that changes from frame to frame.
/// Arguments: triangles, handles, clusters. A frame consists of a warm solve (from the last frame)
/// with at most 10 iterations and the motion of all vertices. Weights are bounded biharmonic;
/// weights up to 1e-6 are dropped.
void crowd(benchmark::State& state)
{
  Rig rig = make_bare_rig(state.range(0), state.range(1));
  const Status solved = add_bounded_weights(rig);
  if (!solved.usable())
  {
    state.SkipWithError(solved.message.c_str());
    return;
  }
  ExecutionContext context;
  context.set_threads(1);
  Crowd crowd;
  ReducedArapOptions options;
  options.clusters = state.range(2);
  options.skinning.smallest_weight = 1e-6;
  crowd.bind(context, rig.mesh.points, rig.mesh.triangles, rig.weights, rig.handles, options);
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
    const std::clock_t start = std::clock();
    const Status status = crowd.solve(context, poses, solve);
    seconds += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
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

/// Measure the fit of rotations to 3x3 matrices. The reported time is the time of 1024 fits.
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
