// Small surfaces, abused: whatever comes back holds what every result promises, or is one sentence.
#include "inside/tetrahedralize.h"

#include "inside/mesher_process.h"
#include "winding/winding_number.h"
#include "support/fuzz.h"

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace bindpose;

namespace
{
TriangleMesh shape(test::Random& random)
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

/// Keeps the triangles of the ids, in their order.
void select(TriangleMesh& mesh, const std::vector<Index>& ids)
{
  Triangles kept(static_cast<Index>(ids.size()), 3);
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    kept.row(static_cast<Index>(i)) = mesh.triangles.row(ids[i]);
  }
  mesh.triangles = kept;
}

void drop_some(test::Random& random, TriangleMesh& mesh, double share)
{
  std::vector<Index> ids;
  for (Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    if (!test::chance(random, share))
    {
      ids.push_back(t);
    }
  }
  select(mesh, ids);
}

void double_some(test::Random& random, TriangleMesh& mesh, double share)
{
  std::vector<Index> ids(static_cast<std::size_t>(mesh.triangles.rows()));
  std::iota(ids.begin(), ids.end(), Index(0));
  for (Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    if (test::chance(random, share))
    {
      ids.push_back(t);
    }
  }
  select(mesh, ids);
}

void flip_some(test::Random& random, TriangleMesh& mesh, double share)
{
  for (Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    if (test::chance(random, share))
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

TriangleMesh unwelded(const TriangleMesh& mesh)
{
  TriangleMesh soup;
  soup.points.resize(mesh.triangles.size(), 3);
  soup.triangles.resize(mesh.triangles.rows(), 3);
  for (Index k = 0; k < mesh.triangles.size(); ++k)
  {
    soup.points.row(k) = mesh.points.row(mesh.triangles.data()[k]);
    soup.triangles.data()[k] = k;
  }
  return soup;
}

/// Triangles between random vertices of the surface: crossing, degenerate, whatever.
void add_loose(test::Random& random, TriangleMesh& mesh)
{
  const Index count = 1 + random.below(4), before = mesh.triangles.rows();
  mesh.triangles.conservativeResize(before + count, 3);
  for (Index k = 0; k < 3 * count; ++k)
  {
    mesh.triangles(before + k / 3, k % 3) = random.below(mesh.points.rows());
  }
}

TriangleMesh abused(test::Random& random)
{
  TriangleMesh mesh = shape(random);
  const Index count = random.below(4);
  for (Index k = 0; k < count && mesh.triangles.rows() > 0; ++k)
  {
    const double share = test::chance(random, 0.8) ? 0.1 : 0.5;
    switch (random.below(8))
    {
      case 0:
        drop_some(random, mesh, share);
        break;
      case 1:
        flip_some(random, mesh, share);
        break;
      case 2:
        double_some(random, mesh, share);
        break;
      case 3:
        jitter(random, mesh, std::pow(10.0, random.uniform(-12.0, -0.7)));
        break;
      case 4:
        // A copy that crosses, touches or nearly coincides.
        mesh = test::join(mesh,
          test::translated(shape(random),
            std::pow(10.0, random.uniform(-9.0, 0.0)) *
              random.in_box(-Vec3::Ones(), Vec3::Ones())));
        break;
      case 5:
        mesh = unwelded(mesh);
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

/// {winding number >= threshold} in the surface's box, by the plain sum at random points.
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

void expect_valid(const TriangleMesh& surface, const TetrahedralizeResult& result)
{
  const TetMesh& mesh = result.mesh;
  ASSERT_GT(mesh.tets.rows(), 0);
  ASSERT_TRUE(mesh.points.allFinite());
  ASSERT_TRUE(check_mesh(mesh.points, mesh.tets).ok());
  EXPECT_GT(tet_volumes(mesh.points, mesh.tets).minCoeff(), 0.0);
  // An embedding may branch: several tets at one side of a facet.
  EXPECT_TRUE(!result.binding.tets.empty() || count_edges(boundary_triangles(mesh.tets)).closed);
  const Components components = connected_components(mesh.points.rows(), mesh.tets);
  EXPECT_EQ(std::count(components.of_vertex.begin(), components.of_vertex.end(), -1), 0);
  ASSERT_EQ(result.winding_numbers.size(), mesh.tets.rows());
  EXPECT_TRUE(result.winding_numbers.allFinite());
  const auto& ids = result.original_vertices;
  ASSERT_EQ(static_cast<Index>(ids.size()), mesh.points.rows());
  // Vertices are moved by a millionth where nothing else helps.
  const double near = 4e-6 * bounding_box(surface.points, surface.triangles).diagonal();
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
  }
  const bool turned = std::any_of(status.warnings.begin(), status.warnings.end(),
    [](const std::string& text) { return text.find("turned") != std::string::npos; });
  if (!turned)
  {
    // Six standard deviations of both samplings.
    constexpr Index samples = 2000;
    const double expected = sampled_volume(random, surface, options.winding_threshold, samples);
    EXPECT_NEAR(winding, expected, 0.1 * box);
  }
}
} // namespace

TEST(FuzzTetrahedralize, AbusedSurfaces)
{
  const bool helper = !find_mesher().empty();
  Index filled = 0;
  test::fuzz("surfaces", 30,
    [&](test::Random& random)
    {
      const TriangleMesh surface = abused(random);
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
      ExecutionContext context;
      const Status status =
        tetrahedralize(surface.points, surface.triangles, options, result, context);
      SCOPED_TRACE(std::string(to_string(options.method)) + ": " + status.message);
      test::expect_spoken(status);
      if (!status.usable())
      {
        EXPECT_TRUE(status.code == StatusCode::invalid_input ||
          status.code == StatusCode::internal_error || status.code == StatusCode::unavailable);
        EXPECT_EQ(result.mesh.points.rows() + result.mesh.tets.rows(), 0);
        return;
      }
      ++filled;
      expect_valid(surface, result);
      expect_volume(random, surface, options, result, status);
    });
  std::cout << "[ fuzz ] " << filled << " of them were filled\n";
}

/// No helper is started: many more cases of what surrounds it.
TEST(FuzzTetrahedralize, LatticesOfAbusedSurfaces)
{
  Index filled = 0;
  test::fuzz("surfaces on lattices", 40,
    [&](test::Random& random)
    {
      const TriangleMesh surface = abused(random);
      TetrahedralizeOptions options;
      options.method = test::chance(random, 0.6) ? TetMethod::remesh : TetMethod::embed;
      options.resolution = 4 + random.below(7);
      options.winding_threshold = test::chance(random, 0.7) ? 0.5 : random.uniform(0.2, 0.9);
      TetrahedralizeResult result;
      ExecutionContext context;
      const Status status =
        tetrahedralize(surface.points, surface.triangles, options, result, context);
      SCOPED_TRACE(std::string(to_string(options.method)) + ": " + status.message);
      test::expect_spoken(status);
      if (!status.usable())
      {
        EXPECT_TRUE(
          status.code == StatusCode::invalid_input || status.code == StatusCode::internal_error);
        return;
      }
      ++filled;
      expect_valid(surface, result);
      expect_volume(random, surface, options, result, status);
    });
  std::cout << "[ fuzz ] " << filled << " of them were filled\n";
}

/// A wrap is there for everything that has an area.
TEST(FuzzTetrahedralize, WrapsOfAbusedSurfaces)
{
  if (find_mesher().empty())
  {
    GTEST_SKIP() << "bindpose-mesher is not built: libcgal-dev, libtet1.5-dev";
  }
  test::fuzz("wraps", 24,
    [&](test::Random& random)
    {
      const TriangleMesh surface = abused(random);
      TetrahedralizeOptions options;
      options.method = TetMethod::wrap;
      options.wrap_alpha = random.uniform(0.05, 0.3);
      options.wrap_offset = options.wrap_alpha * random.uniform(0.03, 0.5);
      options.interior_edge = 0.15;
      TetrahedralizeResult result;
      ExecutionContext context;
      const Status status =
        tetrahedralize(surface.points, surface.triangles, options, result, context);
      SCOPED_TRACE(status.message);
      test::expect_spoken(status);
      if (!status.usable())
      {
        EXPECT_EQ(status.code, StatusCode::invalid_input);
        return;
      }
      expect_valid(surface, result);
      const double distance = status.report.number("distance_max", -1.0);
      EXPECT_GE(distance, 99.0 * options.wrap_offset);
      EXPECT_LE(distance, 100.0);
    });
}
