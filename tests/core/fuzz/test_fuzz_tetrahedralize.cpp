// Fuzz test of the tetrahedralization with small damaged surfaces. Each run must return valid tets
// or an error message of one sentence.
#include "inside/tetrahedralize.h"

#include "core/fuzz/hostile_surfaces.h"
#include "support/environment.h"
#include "support/fuzz.h"
#include "support/needs_mesher.h"
#include "support/sanitized.h"
#include "tets/tet_quality.h"
#include "winding/winding_number.h"

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace bindpose;

namespace
{
TriangleMesh random_solid(test::Random& random)
{
  switch (random.below(4))
  {
    case 0:
      return test::cube();
    case 1:
      return test::sphere(1);
    case 2:
      return test::torus(10, 6, 1.0, 0.45);
    default:
      return test::join(test::cube(-0.5, 0.5), test::flipped(test::cube(-0.25, 0.25)));
  }
}

/// Keep the triangles with the given ids, in this order.
void select(TriangleMesh& mesh, const std::vector<Index>& ids)
{
  Triangles kept(static_cast<Index>(ids.size()), 3);
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    kept.row(static_cast<Index>(i)) = mesh.triangles.row(ids[i]);
  }
  mesh.triangles = kept;
}

void drop_triangles(test::Random& random, TriangleMesh& mesh, double probability)
{
  std::vector<Index> ids;
  for (Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    if (!test::chance(random, probability))
    {
      ids.push_back(t);
    }
  }
  select(mesh, ids);
}

void duplicate_triangles(test::Random& random, TriangleMesh& mesh, double probability)
{
  std::vector<Index> ids(static_cast<std::size_t>(mesh.triangles.rows()));
  std::iota(ids.begin(), ids.end(), Index(0));
  for (Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    if (test::chance(random, probability))
    {
      ids.push_back(t);
    }
  }
  select(mesh, ids);
}

void flip_triangles(test::Random& random, TriangleMesh& mesh, double probability)
{
  for (Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    if (test::chance(random, probability))
    {
      std::swap(mesh.triangles(t, 1), mesh.triangles(t, 2));
    }
  }
}

void jitter(test::Random& random, TriangleMesh& mesh, double size)
{
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    mesh.points.row(v) +=
      size * random.in_box(Vec3::Constant(-1.0), Vec3::Constant(1.0)).transpose();
  }
}

/// Add triangles between random vertices of the surface. They may cross other triangles or be
/// degenerate.
void add_loose(test::Random& random, TriangleMesh& mesh)
{
  const Index count = 1 + random.below(4), before = mesh.triangles.rows();
  mesh.triangles.conservativeResize(before + count, 3);
  for (Index k = 0; k < 3 * count; ++k)
  {
    mesh.triangles(before + k / 3, k % 3) = random.below(mesh.points.rows());
  }
}

TriangleMesh defective_surface(test::Random& random)
{
  TriangleMesh mesh = random_solid(random);
  const Index count = random.below(4);
  for (Index k = 0; k < count && mesh.triangles.rows() > 0; ++k)
  {
    const double probability = test::chance(random, 0.8) ? 0.1 : 0.5;
    switch (random.below(8))
    {
      case 0:
        drop_triangles(random, mesh, probability);
        break;
      case 1:
        flip_triangles(random, mesh, probability);
        break;
      case 2:
        duplicate_triangles(random, mesh, probability);
        break;
      case 3:
        jitter(random, mesh, std::pow(10.0, random.uniform(-12.0, -0.7)));
        break;
      case 4:
        // Add another solid, which may cross, touch or nearly coincide with the surface.
        mesh = test::join(mesh,
          test::translated(random_solid(random),
            std::pow(10.0, random.uniform(-9.0, 0.0)) *
              random.in_box(-Vec3::Ones(), Vec3::Ones())));
        break;
      case 5:
        mesh = test::unwelded(mesh);
        break;
      case 6:
      {
        const double step = std::pow(2.0, -1.0 - static_cast<double>(random.below(8)));
        mesh.points = ((mesh.points / step).array().round() * step).matrix();
        break;
      }
      default:
        add_loose(random, mesh);
    }
  }
  if (test::chance(random, 0.3))
  {
    const double scale = std::pow(10.0, random.uniform(-9.0, 9.0));
    mesh.points *= scale;
    mesh = test::translated(mesh, scale * random.in_box(Vec3::Constant(-9.0), Vec3::Constant(9.0)));
  }
  return mesh;
}

/// Estimate the volume inside of the surface's bounding box where the winding number is at least
/// `threshold`. The estimate uses random points. At each point the winding number is the plain sum
/// over the triangles.
double sampled_volume(
  test::Random& random, const TriangleMesh& mesh, double threshold, Index samples)
{
  const Box box = bounding_box(mesh.points, mesh.triangles);
  Index hits = 0;
  for (Index i = 0; i < samples; ++i)
  {
    const Vec3 at = random.in_box(box.lower, box.upper);
    hits += winding_number_direct(mesh.points, mesh.triangles, at) >= threshold ? 1 : 0;
  }
  return box.size().prod() * static_cast<double>(hits) / static_cast<double>(samples);
}

/// Return the names of the attempted methods with their outcomes.
std::vector<std::pair<std::string, std::string>> attempts(const Status& status)
{
  std::vector<std::pair<std::string, std::string>> list;
  const auto* names = status.report.find("rungs[].name");
  const auto* outcomes = status.report.find("rungs[].outcome");
  if (names && outcomes)
  {
    const auto& first = std::get<std::vector<std::string>>(*names);
    const auto& second = std::get<std::vector<std::string>>(*outcomes);
    for (std::size_t i = 0; i < first.size(); ++i)
    {
      list.emplace_back(first[i], second[i]);
    }
  }
  return list;
}

/// Return the largest permitted displacement of input vertices, as a fraction of the bounding-box
/// diagonal. Some meshing attempts round the vertices or move them by a fixed amount. The name of
/// the attempt contains this amount.
double allowed_displacement(const Status& status)
{
  double allowed = 1e-12;
  for (const auto& [name, outcome] : attempts(status))
  {
    allowed = name.find("moved by 1e-4") != std::string::npos ? 2e-4
      : name.find("moved by 1e-5") != std::string::npos       ? std::max(allowed, 2e-5)
      : name.find("rounded") != std::string::npos             ? std::max(allowed, 4e-6)
                                                              : allowed;
  }
  return allowed;
}

void expect_kept_vertices(
  const TriangleMesh& surface, const TetrahedralizeResult& result, const Status& status)
{
  const TetMesh& mesh = result.mesh;
  const auto& ids = result.original_vertices;
  ASSERT_EQ(static_cast<Index>(ids.size()), mesh.points.rows());
  const double near =
    allowed_displacement(status) * bounding_box(surface.points, surface.triangles).diagonal();
  bool ended = false;
  Index last = -1;
  for (std::size_t v = 0; v < ids.size(); ++v)
  {
    ended = ended || ids[v] == -1;
    if (ended)
    {
      ASSERT_EQ(ids[v], -1);
      continue;
    }
    ASSERT_TRUE(ids[v] > last && ids[v] < surface.points.rows());
    last = ids[v];
    ASSERT_LE((mesh.points.row(static_cast<Index>(v)) - surface.points.row(last)).norm(), near);
  }
}

void expect_valid_tets(
  const TriangleMesh& surface, const TetrahedralizeResult& result, const Status& status)
{
  const TetMesh& mesh = result.mesh;
  ASSERT_GT(mesh.tets.rows(), 0);
  ASSERT_TRUE(mesh.points.allFinite());
  ASSERT_TRUE(check_mesh(mesh.points, mesh.tets).ok());
  const Status tets = check_tets(mesh.points, mesh.tets, !result.binding.tets.empty());
  EXPECT_TRUE(tets.ok()) << tets.message;
  EXPECT_GT(tet_volumes(mesh.points, mesh.tets).minCoeff(), 0.0);
  // The boundary of an embedding may be non-manifold, with several tets on one side of a facet.
  EXPECT_TRUE(!result.binding.tets.empty() || count_edges(boundary_triangles(mesh.tets)).closed);
  const Components components = connected_components(mesh.points.rows(), mesh.tets);
  EXPECT_EQ(
    std::count(components.component_of_vertex.begin(), components.component_of_vertex.end(), -1),
    0);
  ASSERT_EQ(result.winding_numbers.size(), mesh.tets.rows());
  EXPECT_TRUE(result.winding_numbers.allFinite());
  expect_kept_vertices(surface, result, status);
}

/// Expect that every point used by a triangle is inside of the tet that it is bound to.
void expect_bound(const TriangleMesh& surface, const TetrahedralizeResult& result)
{
  const PointBinding& binding = result.binding;
  ASSERT_EQ(static_cast<Index>(binding.tets.size()), surface.points.rows());
  const Box box = bounding_box(surface.points, surface.triangles);
  const double near = 1e-9 * box.diagonal() +
    1e-14 * std::max(box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff());
  for (Index k = 0; k < surface.triangles.size(); ++k)
  {
    const Index v = surface.triangles.data()[k];
    ASSERT_GE(binding.tets[v], 0) << "vertex " << v;
    Vec3 at = Vec3::Zero();
    for (int corner = 0; corner < 4; ++corner)
    {
      ASSERT_GE(binding.coordinates(v, corner), 0.0);
      at += binding.coordinates(v, corner) *
        result.mesh.points.row(result.mesh.tets(binding.tets[v], corner)).transpose();
    }
    ASSERT_LE((at - surface.points.row(v).transpose()).norm(), near) << "vertex " << v;
  }
}

/// Tetrahedralize a surface. Expect that an error message and each warning are one line of text.
Status fill(const TriangleMesh& surface, const TetrahedralizeOptions& options,
  TetrahedralizeResult& result, int threads = 0)
{
  ExecutionContext context;
  context.set_threads(threads);
  Status status = tetrahedralize(context, surface.points, surface.triangles, options, result);
  test::expect_valid_messages(status);
  return status;
}

/// Expect an embedding if the surface has a triangle with a positive area.
void expect_embedding(const TriangleMesh& surface, Index resolution)
{
  TetrahedralizeOptions options;
  options.method = TetMethod::embed;
  options.resolution = resolution;
  TetrahedralizeResult result;
  const Status status = fill(surface, options, result);
  SCOPED_TRACE("embed: " + status.message);
  if (surface_area(surface.points, surface.triangles) > 0.0)
  {
    ASSERT_TRUE(status.ok());
  }
  if (status.ok())
  {
    expect_valid_tets(surface, result, status);
    expect_bound(surface, result);
    EXPECT_GE(status.report.number("min_dihedral_angle", 0.0), 30.0);
  }
}

/// Run again with another number of threads, and expect the same bits. The results may differ if a
/// time limit ended a meshing attempt.
void expect_repeatable(const TriangleMesh& surface, const TetrahedralizeOptions& options,
  const TetrahedralizeResult& result, const Status& status)
{
  if (test::sanitized)
  {
    return; // a second run would take too long
  }
  const auto depends_on_time = [](const Status& run)
  {
    const auto of_run = attempts(run);
    return std::any_of(of_run.begin(), of_run.end(),
      [](const auto& attempt) { return attempt.second.find("time") != std::string::npos; });
  };
  if (depends_on_time(status))
  {
    return;
  }
  TetrahedralizeResult again;
  const Status second = fill(surface, options, again, 3);
  if (depends_on_time(second))
  {
    return;
  }
  EXPECT_EQ(second.code, status.code);
  EXPECT_EQ(second.message, status.message);
  EXPECT_EQ(second.warnings, status.warnings);
  EXPECT_TRUE(again.mesh.points == result.mesh.points && again.mesh.tets == result.mesh.tets);
  EXPECT_TRUE(again.winding_numbers == result.winding_numbers);
  EXPECT_EQ(again.original_vertices, result.original_vertices);
}

void expect_volume(test::Random& random, const TriangleMesh& surface,
  const TetrahedralizeOptions& options, const TetrahedralizeResult& result, const Status& status)
{
  const double volume = tet_volumes(result.mesh.points, result.mesh.tets).sum();
  EXPECT_NEAR(status.report.number("volume", -1.0), volume, 1e-9 * volume);
  const double winding = status.report.number("winding_volume", -1.0);
  ASSERT_GE(winding, 0.0);
  const double box = bounding_box(surface.points, surface.triangles).size().prod();
  if (winding > 0.01 * box && options.method != TetMethod::embed)
  {
    EXPECT_GT(volume, 0.45 * winding);
    EXPECT_LT(volume, 2.2 * winding);
    const bool warned = std::any_of(status.warnings.begin(), status.warnings.end(),
      [](const std::string& text)
      { return text.find("enclosed volume by winding number") != std::string::npos; });
    // The value of `winding` is an estimate from 20,000 samples inside of the surface, or from
    // fewer samples if the sampling takes too long.
    EXPECT_TRUE(warned || std::abs(volume / winding - 1.0) < 0.15)
      << volume << " instead of " << winding << " without a warning";
  }
  // Flipped components and ignored back sides change the winding number.
  const bool changed = std::any_of(status.warnings.begin(), status.warnings.end(),
    [](const std::string& text)
    {
      return text.find("flipped") != std::string::npos ||
        text.find("ignored; otherwise the surface would enclose nothing") != std::string::npos;
    });
  if (!changed)
  {
    // The volume `expected` is an estimate from samples. The volume `winding` may also be an
    // estimate. The tolerance exceeds six standard deviations of the difference of these volumes.
    constexpr Index samples = 2000;
    const double expected = sampled_volume(random, surface, options.winding_threshold, samples);
    EXPECT_NEAR(winding, expected, 0.1 * box);
  }
}

class FuzzWrap : public test::MesherTest
{
};
} // namespace

TEST(FuzzTetrahedralize, AbusedSurfaces)
{
  const bool helper = !find_mesher().empty();
  Index filled = 0;
  test::fuzz("surfaces", 30,
    [&](test::Random& random)
    {
      const TriangleMesh surface = defective_surface(random);
      TetrahedralizeOptions options;
      const Index method = random.below(8);
      options.method = method == 0 ? TetMethod::remesh
        : method == 1              ? TetMethod::embed
        : method == 2 && helper    ? TetMethod::cdt
                                   : TetMethod::automatic;
      options.resolution = 8 + random.below(9);
      options.time_limit = 20.0;
      options.interior_edge = 0.15;
      options.winding_threshold = test::chance(random, 0.7) ? 0.5 : random.uniform(0.2, 0.9);
      TetrahedralizeResult result;
      const Status status = fill(surface, options, result);
      SCOPED_TRACE(std::string(to_string(options.method)) + ": " + status.message);
      expect_repeatable(surface, options, result, status);
      expect_embedding(surface, options.resolution);
      if (!status.usable())
      {
        EXPECT_TRUE(status.code == StatusCode::invalid_input ||
          status.code == StatusCode::internal_error || status.code == StatusCode::unavailable);
        EXPECT_EQ(result.mesh.points.rows() + result.mesh.tets.rows(), 0);
        if (helper && options.method == TetMethod::automatic)
        {
          EXPECT_EQ(status.code, StatusCode::invalid_input) << "the ladder fell";
        }
        return;
      }
      ++filled;
      expect_valid_tets(surface, result, status);
      expect_volume(random, surface, options, result, status);
      if (options.method == TetMethod::embed)
      {
        expect_bound(surface, result);
      }
    });
  std::cout << "[ fuzz ] " << filled << " of them were filled\n";
}

/// This test hides the helper program, as in a build that does not contain it. It runs only the
/// methods remesh and embed, which do not need the program.
TEST(FuzzTetrahedralize, LatticesOfAbusedSurfaces)
{
  const test::Environment no_helper("BINDPOSE_MESHER", "/nowhere");
  Index filled = 0;
  test::fuzz("surfaces on lattices", 40,
    [&](test::Random& random)
    {
      const TriangleMesh surface = defective_surface(random);
      TetrahedralizeOptions options;
      options.method = test::chance(random, 0.6) ? TetMethod::remesh : TetMethod::embed;
      options.resolution = 4 + random.below(7);
      options.winding_threshold = test::chance(random, 0.7) ? 0.5 : random.uniform(0.2, 0.9);
      TetrahedralizeResult result;
      const Status status = fill(surface, options, result);
      SCOPED_TRACE(std::string(to_string(options.method)) + ": " + status.message);
      if (!status.usable())
      {
        const bool too_thin = status.code == StatusCode::unavailable &&
          options.method == TetMethod::remesh &&
          status.message.find("too thin for tets of this size") != std::string::npos;
        EXPECT_TRUE(too_thin || status.code == StatusCode::invalid_input ||
          status.code == StatusCode::internal_error);
        return;
      }
      ++filled;
      expect_valid_tets(surface, result, status);
      expect_volume(random, surface, options, result, status);
    });
  std::cout << "[ fuzz ] " << filled << " of them were filled\n";
}

/// Every surface that has an area can be wrapped.
TEST_F(FuzzWrap, AbusedSurfaces)
{
  test::fuzz("wraps", 24,
    [&](test::Random& random)
    {
      const TriangleMesh surface = defective_surface(random);
      TetrahedralizeOptions options;
      options.method = TetMethod::wrap;
      options.wrap_alpha = random.uniform(0.05, 0.3);
      options.wrap_offset = options.wrap_alpha * random.uniform(0.03, 0.5);
      options.interior_edge = 0.15;
      TetrahedralizeResult result;
      const Status status = fill(surface, options, result);
      SCOPED_TRACE(status.message);
      if (!status.usable())
      {
        EXPECT_EQ(status.code, StatusCode::invalid_input);
        return;
      }
      expect_valid_tets(surface, result, status);
      const double distance = status.report.number("distance_max", -1.0);
      EXPECT_GE(distance, 99.0 * options.wrap_offset);
      EXPECT_LE(distance, 100.0);
    });
}

/// Random triangles, needles, layers and similar surfaces of any size at any position. Most of them
/// enclose almost no volume.
TEST(FuzzTetrahedralize, HostileSurfaces)
{
  const bool helper = !find_mesher().empty();
  Index filled = 0;
  test::fuzz("hostile surfaces", 8,
    [&](test::Random& random)
    {
      const Index most = 80;
      const TriangleMesh surface = test::randomly_transformed(random,
        test::chance(random, 0.5) ? test::hostile_closed_surface(random, most)
                                  : test::hostile_surface(random, most));
      TetrahedralizeOptions options;
      options.resolution = 8;
      options.time_limit = 15.0;
      TetrahedralizeResult result;
      const Status status = fill(surface, options, result);
      SCOPED_TRACE(status.message);
      if (!status.usable())
      {
        EXPECT_TRUE(
          status.code == StatusCode::invalid_input || status.code == StatusCode::internal_error);
        EXPECT_EQ(result.mesh.points.rows() + result.mesh.tets.rows(), 0);
        EXPECT_TRUE(!helper || status.code == StatusCode::invalid_input) << "the ladder fell";
        return;
      }
      ++filled;
      expect_valid_tets(surface, result, status);
    });
  std::cout << "[ fuzz ] " << filled << " of them were filled\n";
}
