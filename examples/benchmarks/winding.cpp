// Benchmarks of winding numbers of closed surfaces, open surfaces and triangle soups:
// - Build of the acceleration structure: time, and bytes per triangle.
// - Evaluation on grids, at scattered points, near the surface and far from the origin: time per
//   point in nanoseconds (`ns`) and in yardsticks (`Y`).
//
// Every row reports median and spread of five repetitions. A yardstick is the time per triangle of
// the plain sum over all triangles, measured in the same run. Yardsticks are therefore comparable
// between machines. `error` is the largest difference from the plain sum in double precision. It is
// measured at 10,000 of the row's points, or at fewer points for more than 100,000 triangles.
//
//   build/bin/bindpose_benchmarks --benchmark_filter=winding
//
// The rows named `elephant` use the file refined_elephant.off, and the rows named `holes` use
// elephant-with-holes.off (from the Debian package libcgal-demo). The environment variable
// BINDPOSE_BENCHMARK_MESHES names the folder of these files. If it is not set, these rows are left
// out.
#include "surfaces.h"

#include "base/parallel.h"
#include "winding/winding_number.h"
#include "io/off.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <vector>

namespace
{
using namespace bindpose;
using benchmarks::Random;

/// Return the yardstick: the nanoseconds per triangle of the plain sum, measured once.
double direct_nanoseconds()
{
  static const double nanoseconds = []
  {
    const TriangleMesh mesh = benchmarks::bumpy_sphere(20000);
    const Points queries = benchmarks::scattered_points(60);
    double best = 1e300;
    for (int round = 0; round < 3; ++round)
    {
      const auto start = std::chrono::steady_clock::now();
      for (Index q = 0; q < queries.rows(); ++q)
      {
        const Vec3 p = queries.row(q);
        double sum = 0.0;
        for (Index t = 0; t < mesh.triangles.rows(); ++t)
        {
          const Vec3 a = mesh.points.row(mesh.triangles(t, 0)).transpose() - p;
          const Vec3 b = mesh.points.row(mesh.triangles(t, 1)).transpose() - p;
          const Vec3 c = mesh.points.row(mesh.triangles(t, 2)).transpose() - p;
          const double la = a.norm(), lb = b.norm(), lc = c.norm();
          sum += std::atan2(
            a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
        }
        benchmark::DoNotOptimize(sum);
      }
      const std::chrono::duration<double, std::nano> spent =
        std::chrono::steady_clock::now() - start;
      best = std::min(best,
        spent.count() / static_cast<double>(queries.rows()) /
          static_cast<double>(mesh.triangles.rows()));
    }
    return best;
  }();
  return nanoseconds;
}

/// Return `count` separate triangles with random positions and orientations in the box [-1, 1]^3.
/// Their size is proportional to 1 / sqrt(count), as in a surface of fixed area with `count`
/// triangles.
TriangleMesh random_triangles(Index count)
{
  Random random(3);
  const double length = 3.0 / std::sqrt(static_cast<double>(count));
  TriangleMesh mesh;
  mesh.points.resize(3 * count, 3);
  mesh.triangles.resize(count, 3);
  for (Index t = 0; t < count; ++t)
  {
    const Vec3 at(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    for (int k = 0; k < 3; ++k)
    {
      const Vec3 corner =
        at + length * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      mesh.points.row(3 * t + k) = corner.transpose();
      mesh.triangles(t, k) = 3 * t + k;
    }
  }
  return mesh;
}

/// Return a disconnected surface: each triangle is moved by about its own size, and about half of
/// the triangles, chosen at random, are flipped.
TriangleMesh soup(Index count)
{
  const TriangleMesh sphere = benchmarks::bumpy_sphere(count);
  Random random(4);
  TriangleMesh mesh;
  mesh.points.resize(3 * sphere.triangles.rows(), 3);
  mesh.triangles.resize(sphere.triangles.rows(), 3);
  for (Index t = 0; t < sphere.triangles.rows(); ++t)
  {
    const Vec3 a = sphere.points.row(sphere.triangles(t, 0));
    const Vec3 b = sphere.points.row(sphere.triangles(t, 1));
    const double length = (b - a).norm();
    const Vec3 away(random.uniform(-length, length), random.uniform(-length, length),
      random.uniform(-length, length));
    const bool turned = random.uniform(0.0, 1.0) < 0.5;
    for (int k = 0; k < 3; ++k)
    {
      mesh.points.row(3 * t + k) = sphere.points.row(sphere.triangles(t, k)) + away.transpose();
      mesh.triangles(t, k) = 3 * t + (turned ? 2 - k : k);
    }
  }
  return mesh;
}

/// Return a surface by its name. The surfaces closed, open, patches, soup and orderless are
/// generated with about `triangles` triangles; elephant and holes are read from files. Each surface
/// is created only once.
const TriangleMesh& surface(const std::string& name, Index triangles)
{
  static std::map<std::pair<std::string, Index>, TriangleMesh> surface_cache;
  const auto [entry, fresh] = surface_cache.try_emplace({ name, triangles });
  if (fresh)
  {
    if (name == "closed")
    {
      entry->second = benchmarks::bumpy_sphere(triangles);
    }
    else if (name == "open")
    {
      entry->second = benchmarks::open_bumpy_sphere(triangles);
    }
    else if (name == "patches")
    {
      entry->second = benchmarks::patches(triangles);
    }
    else if (name == "soup")
    {
      entry->second = soup(triangles);
    }
    else if (name == "orderless")
    {
      entry->second = random_triangles(triangles);
    }
    else if (const char* folder = std::getenv("BINDPOSE_BENCHMARK_MESHES"))
    {
      PolygonMesh mesh;
      const std::string file = name == "holes" ? "elephant-with-holes" : "refined_elephant";
      if (read_off(std::string(folder) + "/" + file + ".off", mesh).ok())
      {
        entry->second = { mesh.points, fan_triangles(mesh) };
      }
    }
  }
  return entry->second;
}

enum QueryKind
{
  grid,
  scattered,
  near, ///< 1e-4 bounding-box diagonals away from the surface
  far_from_origin ///< scattered; surface and points are moved by 1e6 bounding-box diagonals
};

struct Row
{
  const char* surface;
  Index triangles; ///< number of triangles; 0: as in the file
  QueryKind query_kind;
  Index samples; ///< number of samples along the grid's longest side
  WindingMethod method;
  double tolerance;
  int threads;
};

Points queries_for(const Row& row, const TriangleMesh& mesh, const Box& box)
{
  constexpr Index count = 50000;
  Random random(5);
  Points queries(count, 3);
  for (Index i = 0; i < count; ++i)
  {
    Vec3 p;
    for (int k = 0; k < 3; ++k)
    {
      p[k] = random.uniform(box.lower[k], box.upper[k]);
    }
    if (row.query_kind == near)
    {
      const Index t = random.below(mesh.triangles.rows());
      const Vec3 a = mesh.points.row(mesh.triangles(t, 0));
      const Vec3 u = Vec3(mesh.points.row(mesh.triangles(t, 1))) - a;
      const Vec3 v = Vec3(mesh.points.row(mesh.triangles(t, 2))) - a;
      double s = random.uniform(0.0, 1.0), r = random.uniform(0.0, 1.0);
      s = s + r > 1.0 ? 1.0 - s : s;
      r = s + r > 1.0 ? 1.0 - r : r;
      p =
        a + s * u + r * v + random.uniform(-1e-4, 1e-4) * box.diagonal() * u.cross(v).normalized();
    }
    queries.row(i) = p.transpose();
  }
  return queries;
}

SampleGrid grid_for(Index samples, const Box& box)
{
  const double padding = 0.1 * box.diagonal();
  const Vec3 size = box.size() + Vec3::Constant(2.0 * padding);
  const double step = size.maxCoeff() / static_cast<double>(samples - 1);
  SampleGrid cells;
  cells.origin = box.lower - Vec3::Constant(padding);
  cells.spacing.setConstant(step);
  for (int k = 0; k < 3; ++k)
  {
    cells.extent[2 * k] = 0;
    cells.extent[2 * k + 1] = static_cast<Index>(size[k] / step + 1e-9);
  }
  return cells;
}

/// Return the largest error at `count` points. All cores are used, because this part is not timed.
double largest_error(Index count, Index triangles, const std::function<double(Index)>& error_at)
{
  const Index tested_count = std::min<Index>(10000, 1000000000 / std::max<Index>(1, triangles));
  const Index step = std::max<Index>(1, count / tested_count);
  std::vector<double> errors(static_cast<std::size_t>((count + step - 1) / step));
  ExecutionContext context;
  parallel_for(context, static_cast<Index>(errors.size()), 16,
    [&](Index begin, Index end)
    {
      for (Index i = begin; i < end; ++i)
      {
        errors[i] = error_at(i * step);
      }
    });
  return *std::max_element(errors.begin(), errors.end());
}

void evaluate(benchmark::State& state, const Row& row)
{
  TriangleMesh mesh = surface(row.surface, row.triangles);
  if (row.query_kind == far_from_origin)
  {
    const double away = 1e6 * bounding_box(mesh.points).diagonal();
    mesh.points.rowwise() += Vec3(away, -away, away).transpose();
  }
  const Box box = bounding_box(mesh.points);
  ExecutionContext context;
  context.set_threads(row.threads);
  WindingNumber::Options options;
  options.method = row.method;
  options.tolerance = row.tolerance;
  WindingNumber winding;
  winding.build(context, mesh.points, mesh.triangles, options);
  const SampleGrid cells = grid_for(std::max<Index>(row.samples, 2), box);
  const Points queries = queries_for(row, mesh, box);
  const Index count = row.query_kind == grid ? cells.count() : queries.rows();
  // Initialize with a constant, so that the memory is allocated before the timing.
  Eigen::VectorXd values = Eigen::VectorXd::Constant(count, -1.0);
  double seconds = 0.0;
  for (auto _ : state)
  {
    const auto start = std::chrono::steady_clock::now();
    row.query_kind == grid ? winding.evaluate(context, cells, values.data())
                           : winding.evaluate(context, queries, values.data());
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    state.SetIterationTime(spent.count());
    seconds += spent.count();
  }
  // Cache the error, because all repetitions compute the same values.
  static std::map<const Row*, double> errors;
  const auto [found, is_new] = errors.emplace(&row, 0.0);
  if (is_new)
  {
    found->second = largest_error(count, mesh.triangles.rows(),
      [&](Index i)
      {
        const Vec3 p = row.query_kind == grid
          ? cells.point(i % cells.size(0), i / cells.size(0) % cells.size(1),
              i / cells.size(0) / cells.size(1))
          : Vec3(queries.row(i));
        return std::abs(values[i] - winding_number_direct(mesh.points, mesh.triangles, p));
      });
  }
  const double nanoseconds =
    1e9 * seconds / static_cast<double>(state.iterations()) / static_cast<double>(count);
  state.SetLabel(to_string(winding.method()));
  state.counters["ns"] = nanoseconds;
  state.counters["Y"] = nanoseconds / direct_nanoseconds();
  state.counters["error"] = found->second;
  state.counters["triangles"] = static_cast<double>(mesh.triangles.rows());
  state.counters["open_edges"] = winding.status().report.number("counts.open_edges", 0.0);
}

void build(benchmark::State& state, const std::string& name, Index triangles, int threads)
{
  const TriangleMesh& mesh = surface(name, triangles);
  double bytes = 0.0;
  for (auto _ : state)
  {
    ExecutionContext context;
    context.set_threads(threads);
    WindingNumber winding;
    const auto start = std::chrono::steady_clock::now();
    winding.build(context, mesh.points, mesh.triangles);
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    state.SetIterationTime(spent.count());
    bytes = static_cast<double>(winding.memory());
  }
  state.counters["triangles"] = static_cast<double>(mesh.triangles.rows());
  state.counters["bytes_per_triangle"] = bytes / static_cast<double>(mesh.triangles.rows());
}

void add(benchmark::internal::Benchmark* row)
{
  row->UseManualTime()->Repetitions(5)->ReportAggregatesOnly()->MinTime(0.05)->Unit(
    benchmark::kMillisecond);
}

const bool registered = []
{
  using M = WindingMethod;
  const char* const places[] = { "grid", "scattered", "near", "far_from_origin" };
  const std::vector<Row> rows{
    // Closed surfaces, for which the automatic method is exact.
    { "elephant", 0, grid, 64, M::automatic, 1e-3, 1 },
    { "elephant", 0, grid, 128, M::automatic, 1e-3, 1 },
    { "elephant", 0, grid, 256, M::automatic, 1e-3, 1 },
    { "elephant", 0, grid, 256, M::automatic, 1e-3, 2 },
    { "elephant", 0, scattered, 0, M::automatic, 1e-3, 1 },
    { "elephant", 0, scattered, 0, M::automatic, 1e-3, 2 },
    { "elephant", 0, near, 0, M::automatic, 1e-3, 1 },
    { "closed", 86000, grid, 128, M::automatic, 1e-3, 1 },
    { "closed", 86000, scattered, 0, M::automatic, 1e-3, 1 },
    { "closed", 86000, near, 0, M::automatic, 1e-3, 1 },
    { "closed", 86000, far_from_origin, 0, M::automatic, 1e-3, 1 },
    // Open surfaces, with the fast method at several tolerances, and with the exact method.
    { "holes", 0, grid, 128, M::fast, 1e-3, 1 },
    { "holes", 0, scattered, 0, M::fast, 1e-3, 1 },
    { "holes", 0, scattered, 0, M::fast, 1e-6, 1 },
    { "holes", 0, near, 0, M::fast, 1e-3, 1 },
    { "open", 39000, grid, 128, M::fast, 1e-3, 1 },
    { "open", 39000, scattered, 0, M::fast, 1e-3, 1 },
    { "open", 39000, scattered, 0, M::fast, 1e-6, 1 },
    { "open", 39000, scattered, 0, M::exact, 1e-3, 1 },
    { "patches", 4800, grid, 128, M::fast, 1e-3, 1 },
    { "patches", 4800, grid, 128, M::fast, 1e-4, 1 },
    // Unordered triangles: near a surface (soup), and throughout space (orderless).
    { "soup", 86000, grid, 128, M::fast, 2e-3, 1 },
    { "soup", 86000, scattered, 0, M::fast, 2e-3, 1 },
    { "orderless", 86000, grid, 128, M::fast, 2e-3, 1 },
    { "orderless", 86000, grid, 128, M::fast, 1e-4, 1 },
    { "orderless", 86000, scattered, 0, M::fast, 2e-3, 1 },
    // Growth of the time with the size: each row has four times as many triangles as the previous
    // one.
    { "closed", 20000, scattered, 0, M::automatic, 1e-3, 1 },
    { "closed", 80000, scattered, 0, M::automatic, 1e-3, 1 },
    { "closed", 320000, scattered, 0, M::automatic, 1e-3, 1 },
    { "closed", 1280000, scattered, 0, M::automatic, 1e-3, 1 },
  };
  const auto has_surface = [](const std::string& name, Index triangles)
  { return triangles > 0 || surface(name, triangles).triangles.rows() > 0; };
  for (const Row& row : rows)
  {
    if (!has_surface(row.surface, row.triangles))
    {
      continue;
    }
    std::string name = std::string("winding/") + places[row.query_kind] + "/" + row.surface;
    if (row.triangles > 0)
    {
      name += ":" + std::to_string(row.triangles);
    }
    if (row.query_kind == grid)
    {
      name += "/samples:" + std::to_string(row.samples);
    }
    if (row.method == M::fast)
    {
      char tolerance[32];
      std::snprintf(tolerance, sizeof(tolerance), "/tolerance:%.0e", row.tolerance);
      name += tolerance;
    }
    name += "/threads:" + std::to_string(row.threads);
    add(benchmark::RegisterBenchmark(
      name.c_str(), [row](benchmark::State& state) { evaluate(state, row); }));
  }
  for (const auto& [name, triangles] :
    std::vector<std::pair<std::string, Index>>{ { "elephant", 0 }, { "closed", 86000 },
      { "closed", 1380000 }, { "open", 86000 }, { "patches", 86000 }, { "orderless", 86000 } })
  {
    for (const int threads : { 1, 2 })
    {
      if (!has_surface(name, triangles))
      {
        continue;
      }
      add(benchmark::RegisterBenchmark(
        ("winding/build/" + name + (triangles ? ":" + std::to_string(triangles) : "") +
          "/threads:" + std::to_string(threads))
          .c_str(),
        [name = name, triangles = triangles, threads](benchmark::State& state)
        { build(state, name, triangles, threads); }));
    }
  }
  return true;
}();
} // namespace
