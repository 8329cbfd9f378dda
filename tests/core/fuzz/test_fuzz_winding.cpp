// Fuzz test of winding numbers of difficult surfaces, curves and point clouds. All methods are
// compared with plain sums over the input, at points on, near and far from the input.
//
// The tolerances are those of the documentation. Exact methods have an error of at most 1e-14 plus
// the round-off of the sum of absolute contributions. If the winding number is an integer, its
// value is exact. Fast methods satisfy their tolerance. All methods agree on which points are on
// the input. Evaluation in rows of grids or in batches gives the same bits as evaluation of single
// points.
#include "solid_angle/solid_angle.h"
#include "surface/triangle_predicates.h"
#include "winding/curve_winding_number.h"
#include "winding/exact_frame.h"
#include "winding/point_cloud_winding_number.h"
#include "winding/winding_number.h"

#include "core/fuzz/hostile_surfaces.h"
#include "support/clouds.h"
#include "support/curves.h"
#include "support/fuzz.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iomanip>
#include <sstream>

using namespace bindpose;
using namespace bindpose::test;

namespace
{
struct SerialContext : ExecutionContext
{
  SerialContext() { this->set_threads(1); }
};

bool same_bits(double a, double b)
{
  return std::memcmp(&a, &b, sizeof a) == 0;
}

struct WindingCase
{
  WindingMethod method;
  double tolerance;
};
constexpr WindingCase winding_cases[] = { { WindingMethod::automatic, 1e-3 },
  { WindingMethod::exact, 1e-3 }, { WindingMethod::direct, 1e-3 },
  { WindingMethod::crossings, 1e-3 }, { WindingMethod::hierarchical, 1e-3 },
  { WindingMethod::fast, 1e-2 }, { WindingMethod::fast, 1e-3 }, { WindingMethod::fast, 1e-5 } };

WindingNumber random_winding(
  Random& random, const TriangleMesh& mesh, const WindingCase& winding_case)
{
  WindingNumber::Options options;
  options.method = winding_case.method;
  options.tolerance = winding_case.tolerance;
  options.max_leaf_size = chance(random, 0.5) ? 64 : 1 + random.below(8);
  SerialContext context;
  WindingNumber winding;
  const Status status = winding.build(context, mesh.points, mesh.triangles, options);
  EXPECT_TRUE(status.ok()) << status.message;
  expect_valid_messages(status);
  return winding;
}

/// Report whether the distance between the point and a triangle is close to the tolerance for
/// touching. In this case rounding and the order of the triangle's corners decide whether the point
/// touches the triangle.
bool is_borderline(const TriangleMesh& mesh, const Vec3& point)
{
  const ExactFrame frame(bounding_box(mesh.points, mesh.triangles));
  const Vec3 p = frame(point);
  for (Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    const auto corner = [&](int k) { return frame(mesh.points.row(mesh.triangles(t, k))); };
    const auto touches = [&](double tolerance_factor)
    {
      return touches_triangle(
        p, corner(0), corner(1), corner(2), tolerance_factor * frame.tolerance);
    };
    if (touches(1.3) && !touches(0.7))
    {
      return true;
    }
  }
  return false;
}

/// Points, and the plain sum (the true winding number) at each of them.
struct ReferenceValues
{
  Points points;
  std::vector<double> values;
  std::vector<bool> on_surface;
  std::vector<bool> borderline;

  template <typename PointAt>
  ReferenceValues(const TriangleMesh& mesh, Index count, const PointAt& point_at)
    : points(count, 3), values(count), on_surface(count), borderline(count)
  {
    for (Index i = 0; i < count; ++i)
    {
      const Vec3 p = point_at(i);
      bool touches = false;
      this->points.row(i) = p.transpose();
      this->values[i] = winding_number_direct(mesh.points, mesh.triangles, p, &touches);
      this->on_surface[i] = touches;
      this->borderline[i] = is_borderline(mesh, p);
    }
  }
};

/// Return a grid whose samples share coordinates with vertices.
SampleGrid hostile_grid(Random& random, const TriangleMesh& mesh)
{
  const auto vertex = [&]
  {
    return Vec3(
      mesh.points.row(mesh.triangles(random.below(mesh.triangles.rows()), int(random.below(3)))));
  };
  SampleGrid grid;
  grid.origin = vertex();
  const Box box = bounding_box(mesh.points, mesh.triangles);
  const Vec3 to = vertex();
  for (int k = 0; k < 3; ++k)
  {
    const Index steps = 1 + random.below(k == 0 ? 12 : 3);
    double span = to[k] - grid.origin[k];
    span = span == 0.0 || chance(random, 0.2) ? 0.5 * box.size().maxCoeff() : span;
    grid.spacing[k] = span / static_cast<double>(1 + random.below(steps));
    grid.extent[2 * k] = -random.below(3);
    grid.extent[2 * k + 1] = grid.extent[2 * k] + steps;
  }
  return grid;
}

/// Statistics of all rounds.
struct Tally
{
  Index queries = 0;
  Index touching = 0;
  /// Number of queries that were not compared, because rounding decides whether they touch a
  /// triangle.
  Index borderline = 0;
  double exact_error = 0.0; ///< largest absolute error of exact methods
  double fast_error = 0.0; ///< largest error of fast methods, divided by their tolerance

  void add(const WindingNumber& winding, const WindingCase& winding_case, bool closed,
    const ReferenceValues& reference, Index i, double value, bool touches)
  {
    const auto where = [&]
    {
      std::ostringstream text;
      text.precision(17);
      text << to_string(winding_case.method) << " " << winding_case.tolerance << " ("
           << to_string(winding.method()) << ") at " << reference.points.row(i) << ", touching "
           << reference.on_surface[i];
      return text.str();
    };
    ++this->queries;
    if (reference.borderline[i])
    {
      ++this->borderline;
      return;
    }
    this->touching += touches;
    if (!reference.points.row(i).allFinite()) // a grid may extend beyond the range of double
    {
      EXPECT_TRUE(std::isnan(value) && std::isnan(reference.values[i]) && !touches) << where();
      return;
    }
    const double error = std::abs(value - reference.values[i]);
    EXPECT_EQ(touches, reference.on_surface[i]) << where();
    const bool fast = winding.method() == WindingMethod::fast;
    if (fast && !reference.on_surface[i])
    {
      EXPECT_LE(error, winding_case.tolerance) << where();
      this->fast_error = std::max(this->fast_error, error / winding_case.tolerance);
    }
    else
    {
      EXPECT_LE(error, 1e-12) << where();
      this->exact_error = std::max(this->exact_error, error);
    }
    if (closed && !reference.on_surface[i] && winding.method() != WindingMethod::direct)
    {
      EXPECT_EQ(value, std::round(value)) << where();
    }
  }
  void print() const
  {
    std::cout << "[ fuzz ] " << this->queries << " queries, " << this->touching
              << " of them touching, " << this->borderline
              << " about to; largest error of exact methods " << this->exact_error
              << ", of fast ones " << this->fast_error << " tolerances\n";
  }
};

/// Compare one method with the true winding numbers: at all points in one call, at single points,
/// and on the grid.
void compare(Random& random, const TriangleMesh& mesh, const WindingCase& winding_case,
  const ReferenceValues& points, const SampleGrid& grid, const ReferenceValues& samples,
  Tally& tally)
{
  const WindingNumber winding = random_winding(random, mesh, winding_case);
  const bool closed = winding.boundary().edges.empty();
  SerialContext context;
  for (const ReferenceValues* reference : { &points, &samples })
  {
    const bool on_grid = reference == &samples;
    const auto count = static_cast<Index>(reference->values.size());
    std::vector<double> values(reference->values.size());
    std::vector<unsigned char> flags(values.size());
    ASSERT_TRUE(
      (on_grid ? winding.evaluate(context, grid, values.data(), flags.data())
               : winding.evaluate(context, reference->points, values.data(), flags.data()))
        .ok());
    for (Index i = 0; i < count; ++i)
    {
      const Vec3 p = reference->points.row(i);
      tally.add(winding, winding_case, closed, *reference, i, values[i], flags[i] != 0);
      ASSERT_TRUE(same_bits(winding.evaluate_at(p), values[i]))
        << to_string(winding_case.method) << (on_grid ? " on a grid" : " in a batch") << " at "
        << p.transpose() << ": " << values[i] << " and " << winding.evaluate_at(p);
    }
  }
}

auto points_of(const SampleGrid& grid)
{
  return [&grid](Index i)
  {
    return grid.point(grid.extent[0] + i % grid.size(0),
      grid.extent[2] + i / grid.size(0) % grid.size(1),
      grid.extent[4] + i / grid.size(0) / grid.size(1));
  };
}
} // namespace

TEST(FuzzWinding, AllMethodsOnSurfacesOfAllKinds)
{
  Tally tally;
  fuzz("surfaces", 900,
    [&](Random& random)
    {
      const Index most = chance(random, 0.1) ? 600 : 60;
      TriangleMesh mesh =
        chance(random, 0.3) ? hostile_closed_surface(random, most) : hostile_surface(random, most);
      if (mesh.triangles.rows() == 0)
      {
        return;
      }
      mesh = randomly_transformed(random, mesh);
      const ReferenceValues points(mesh, 64, [&](Index) { return hostile_point(random, mesh); });
      const SampleGrid grid = hostile_grid(random, mesh);
      const ReferenceValues samples(mesh, grid.count(), points_of(grid));
      for (const WindingCase& winding_case : winding_cases)
      {
        compare(random, mesh, winding_case, points, grid, samples, tally);
        if (testing::Test::HasFailure())
        {
          return;
        }
      }
    });
  tally.print();
}

namespace
{
/// Scatter copies of a surface in a box far larger than the surface, so that the search cells have
/// several levels.
TriangleMesh scattered(Random& random, const TriangleMesh& part, Index most)
{
  TriangleMesh mesh = part;
  while (mesh.triangles.rows() + part.triangles.rows() <= most && chance(random, 0.9))
  {
    TriangleMesh copy = part;
    copy.points *= std::pow(10.0, random.uniform(-4.0, 0.0));
    const Vec3 to = random.in_box(Vec3::Constant(-1.0), Vec3::Constant(1.0));
    mesh = join(mesh, translated(copy, std::pow(10.0, random.uniform(-3.0, 2.0)) * to));
  }
  return mesh;
}
} // namespace

// Integer winding numbers of method `crossings`, on grids and at points. They are compared with
// those of method `hierarchical`, because the two methods share no code. Some are also compared
// with the plain sum.
TEST(FuzzWinding, CellsOfLargeClosedSurfaces)
{
  Index queries = 0, compared = 0, touching = 0, direct_count = 0, largest = 0;
  fuzz("closed surfaces", 30,
    [&](Random& random)
    {
      const Index most = chance(random, 0.5) ? 12000 : 3000;
      TriangleMesh mesh = hostile_closed_surface(random, chance(random, 0.5) ? most : most / 8);
      if (mesh.triangles.rows() == 0)
      {
        return;
      }
      mesh =
        randomly_transformed(random, chance(random, 0.5) ? scattered(random, mesh, most) : mesh);
      largest = std::max(largest, mesh.triangles.rows());
      const WindingNumber cells = random_winding(random, mesh, { WindingMethod::crossings, 1e-3 });
      const WindingNumber tree =
        random_winding(random, mesh, { WindingMethod::hierarchical, 1e-3 });
      ASSERT_TRUE(cells.boundary().edges.empty());
      const auto expect_same = [&](const Vec3& p, double value, bool touches)
      {
        ++queries;
        touching += touches;
        ASSERT_TRUE(touches || value == std::round(value)) << p.transpose() << ": " << value;
        if (!chance(random, 1500.0 / static_cast<double>(mesh.triangles.rows())))
        {
          return; // `tree` is slow for many triangles, so fewer points are compared
        }
        bool expected_touch = false;
        const double expected = tree.evaluate_at(p, &expected_touch);
        ++compared;
        const bool same = touches == expected_touch &&
          (touches ? std::abs(value - expected) <= 1e-10 : value == expected);
        ASSERT_TRUE(same) << std::setprecision(17) << "at " << p.transpose() << ": " << value
                          << (touches ? " touching" : "") << ", expected " << expected
                          << (expected_touch ? " touching" : "");
        if (chance(random, 0.01))
        {
          const double sum = winding_number_direct(mesh.points, mesh.triangles, p);
          ASSERT_NEAR(value, sum, 1e-10) << p.transpose();
          ++direct_count;
        }
      };
      SerialContext context;
      Points points(1000, 3);
      for (Index i = 0; i < points.rows(); ++i)
      {
        points.row(i) = hostile_point(random, mesh).transpose();
      }
      std::vector<double> values(static_cast<std::size_t>(points.rows()));
      std::vector<unsigned char> flags(values.size());
      ASSERT_TRUE(cells.evaluate(context, points, values.data(), flags.data()).ok());
      for (Index i = 0; i < points.rows() && !testing::Test::HasFatalFailure(); ++i)
      {
        expect_same(points.row(i), values[i], flags[i] != 0);
      }
      for (int round = 0; round < 12 && !testing::Test::HasFatalFailure(); ++round)
      {
        const SampleGrid grid = hostile_grid(random, mesh);
        values.resize(static_cast<std::size_t>(grid.count()));
        flags.resize(values.size());
        ASSERT_TRUE(cells.evaluate(context, grid, values.data(), flags.data()).ok());
        for (Index i = 0; i < grid.count() && !testing::Test::HasFatalFailure(); ++i)
        {
          const Vec3 p = points_of(grid)(i);
          if (p.allFinite())
          {
            expect_same(p, values[i], flags[i] != 0);
          }
        }
      }
    });
  std::cout << "[ fuzz ] " << queries << " queries, " << touching << " of them touching, "
            << compared << " against the tree, " << direct_count << " against the plain sum; up to "
            << largest << " triangles\n";
}

// The surface is made of cubes of a lattice. The winding number is known at the corners of cubes,
// and at the centers of cubes, faces and edges.
TEST(FuzzWinding, CubesHoldTheirMiddles)
{
  Index queries = 0;
  fuzz("heaps of cubes", 40,
    [&](Random& random)
    {
      const Index n = 2 + random.below(10);
      std::vector<char> filled(static_cast<std::size_t>(n * n * n));
      TriangleMesh mesh;
      std::vector<TriangleMesh> rows;
      for (Index i = 0; i < n * n * n; ++i)
      {
        filled[i] = chance(random, 0.4);
      }
      const auto corner = [&](Index i)
      {
        return Vec3(static_cast<double>(i % n), static_cast<double>(i / n % n),
          static_cast<double>(i / n / n));
      };
      // The face between two adjacent cubes occurs twice, with opposite orientations.
      const TriangleMesh one = cube(0.0, 1.0);
      const auto count = static_cast<Index>(std::count(filled.begin(), filled.end(), 1));
      mesh.points.resize(8 * count, 3);
      mesh.triangles.resize(12 * count, 3);
      Index at = 0;
      for (Index i = 0; i < n * n * n; ++i)
      {
        if (filled[i])
        {
          mesh.points.middleRows(8 * at, 8) = one.points.rowwise() + corner(i).transpose();
          mesh.triangles.middleRows(12 * at, 12) = one.triangles.array() + 8 * at;
          ++at;
        }
      }
      const double unit = std::ldexp(1.0, static_cast<int>(random.below(100)) - 50);
      mesh.points *= unit;
      const WindingNumber winding =
        random_winding(random, mesh, { WindingMethod::crossings, 1e-3 });
      SampleGrid grid;
      grid.origin = Vec3::Constant(-1.5 * unit);
      grid.spacing = Vec3::Constant(0.5 * unit);
      grid.extent = { 0, 2 * n + 4, 0, 2 * n + 4, 0, 2 * n + 4 };
      Eigen::VectorXd values;
      SerialContext context;
      ASSERT_TRUE(winding.evaluate(context, grid, values).ok());
      const auto is_filled = [&](Index x, Index y, Index z)
      {
        return x >= 0 && y >= 0 && z >= 0 && x < n && y < n && z < n &&
          filled[(z * n + y) * n + x] != 0;
      };
      for (Index i = 0; i < grid.count(); ++i)
      {
        // A sample at the center of a cube has 1 adjacent cell, at the center of a face 2, at the
        // center of an edge 4, and at a corner 8.
        const std::array<Index, 3> place{ i % grid.size(0), i / grid.size(0) % grid.size(1),
          i / grid.size(0) / grid.size(1) };
        double expected = 0.0;
        for (int k = 0; k < 8; ++k)
        {
          std::array<Index, 3> cell;
          for (int axis = 0; axis < 3; ++axis)
          {
            // The coordinate of the sample along this axis, divided by half the side of a cube. The
            // corner of the lattice has the coordinate 0.
            const Index halves = place[axis] - 3;
            cell[axis] = halves % 2 == 0 ? halves / 2 - 1 + (k >> axis & 1) : (halves - 1) / 2;
          }
          expected += 0.125 * is_filled(cell[0], cell[1], cell[2]);
        }
        ASSERT_NEAR(values[i], expected, 1e-12) << grid.point(place[0], place[1], place[2]);
        ++queries;
      }
    });
  std::cout << "[ fuzz ] " << queries << " samples\n";
}

namespace
{
double distance_from_segment(const Vec3& p, const Vec3& a, const Vec3& b)
{
  const Vec3 ab = b - a;
  const double length = ab.squaredNorm();
  const double t = length > 0.0 ? std::clamp((p - a).dot(ab) / length, 0.0, 1.0) : 0.0;
  return (a + t * ab - p).norm();
}
} // namespace

TEST(FuzzWinding, GradientIsThatOfThePlainSum)
{
  Index queries = 0;
  double worst = 0.0, worst_fast = 0.0;
  fuzz("surfaces and their gradients", 400,
    [&](Random& random)
    {
      TriangleMesh mesh = hostile_surface(random, 80);
      if (chance(random, 0.3))
      {
        mesh.points *= std::ldexp(1.0, static_cast<int>(random.below(120)) - 60);
      }
      const double size = bounding_box(mesh.points, mesh.triangles).diagonal();
      constexpr double tolerance = 1e-4;
      const WindingNumber exact =
        random_winding(random, mesh, { WindingMethod::crossings, tolerance });
      const WindingNumber fast = random_winding(random, mesh, { WindingMethod::fast, tolerance });
      for (int q = 0; q < 12; ++q)
      {
        const Vec3 p = hostile_point(random, mesh);
        double off = 1e300; // distance of the point from the surface
        for (Index t = 0; t < mesh.triangles.rows(); ++t)
        {
          const auto corner = [&](int k) { return Vec3(mesh.points.row(mesh.triangles(t, k))); };
          off = std::min(off, (closest_point(p, corner(0), corner(1), corner(2)) - p).norm());
          // Degenerate triangles have no normal, so also measure the distance from the edges.
          for (int k = 0; k < 3; ++k)
          {
            off = std::min(off, distance_from_segment(p, corner(k), corner((k + 1) % 3)));
          }
        }
        if (!(off > 1e-4 * size && off < 100.0 * size))
        {
          continue;
        }
        // Compute the distance of the point from the boundary curve, and the sum of the
        // multiplicities of the boundary edges. Round-off and the error of the finite differences
        // are proportional to this sum.
        double rim = 1e300, weights = 0.0;
        for (const SurfaceBoundary::BoundaryEdge& edge : exact.boundary().edges)
        {
          const Vec3 a = mesh.points.row(edge.from), b = mesh.points.row(edge.to);
          rim = std::min(rim, distance_from_segment(p, a, b));
          weights += static_cast<double>(edge.multiplicity);
        }
        Vec3 expected;
        const double step = 0.02 * off;
        for (int k = 0; k < 3; ++k)
        {
          const auto at = [&](double steps) {
            return winding_number_direct(
              mesh.points, mesh.triangles, p + steps * step * Vec3::Unit(k));
          };
          expected[k] = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * step);
        }
        Vec3 gradient, fast_gradient;
        const Points point = p.transpose();
        SerialContext context;
        ASSERT_TRUE(exact.evaluate_gradient(context, point, gradient.data()).ok());
        ASSERT_TRUE(fast.evaluate_gradient(context, point, fast_gradient.data()).ok());
        const double error = (gradient - expected).norm() * off;
        ASSERT_LE(error, 1e-7 * (1.0 + weights)) << std::setprecision(17) << p.transpose();
        worst = std::max(worst, error / (1.0 + weights));
        if (exact.boundary().edges.empty())
        {
          ASSERT_EQ(gradient, Vec3::Zero());
          ASSERT_EQ(fast_gradient, Vec3::Zero());
        }
        else
        {
          const double fast_error = (fast_gradient - gradient).norm() * rim / tolerance;
          ASSERT_LE(fast_error, 10.0) << std::setprecision(17) << p.transpose();
          worst_fast = std::max(worst_fast, fast_error);
        }
        queries += 2;
      }
    });
  std::cout << "[ fuzz ] " << queries << " gradients; largest error " << worst
            << " an open edge over the distance, of fast ones " << worst_fast
            << " tolerances over the distance\n";
}

namespace
{
Curve hostile_curve(Random& random)
{
  const Index count = 1 + random.below(chance(random, 0.2) ? 400 : 30);
  const Index vertices = 1 + random.below(count + 2);
  Curve curve{ PlanePoints(vertices, 2), Segments(count, 2) };
  const Index lattice = chance(random, 0.5) ? 2 + random.below(6) : 0;
  const double flat = chance(random, 0.2) ? std::pow(10.0, random.uniform(-16.0, -1.0)) : 1.0;
  for (Index v = 0; v < vertices; ++v)
  {
    for (int k = 0; k < 2; ++k)
    {
      curve.points(v, k) =
        lattice ? static_cast<double>(random.below(lattice)) : random.uniform(-1.0, 1.0);
    }
    curve.points(v, 1) *= flat;
    if (v > 0 && chance(random, 0.1)) // this point nearly coincides with another one
    {
      curve.points.row(v) = curve.points.row(random.below(v)).eval();
      curve.points(v, random.below(2)) += std::pow(10.0, random.uniform(-16.0, -6.0));
    }
  }
  const bool closed = chance(random, 0.4);
  for (Index e = 0; e < count; ++e)
  {
    curve.segments(e, 0) = closed && e > 0 ? curve.segments(e - 1, 1) : random.below(vertices);
    curve.segments(e, 1) = closed && e + 1 == count ? curve.segments(0, 0) : random.below(vertices);
  }
  switch (random.below(6))
  {
    case 0:
      curve.points *= std::pow(10.0, random.uniform(-30.0, 30.0));
      break;
    case 1:
      curve.points *= std::ldexp(1.0, chance(random, 0.5) ? 1020 : -1060);
      break;
    case 2:
      curve.points.rowwise() += std::pow(10.0, random.uniform(0.0, 14.0)) *
        Eigen::RowVector2d(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
      break;
    default:
      break;
  }
  return curve;
}

Vec2 hostile_curve_point(Random& random, const Curve& curve)
{
  const Index e = random.below(curve.segments.rows());
  const Vec2 a = curve.points.row(curve.segments(e, 0)), b = curve.points.row(curve.segments(e, 1));
  const Vec2 other = curve.points.row(random.below(curve.points.rows()));
  const Vec2 lower = curve.points.colwise().minCoeff(), upper = curve.points.colwise().maxCoeff();
  const double size = (0.5 * upper - 0.5 * lower).maxCoeff();
  const auto direction = [&] { return Vec2(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)); };
  const double t =
    chance(random, 0.5) ? 0.25 * static_cast<double>(random.below(5)) : random.uniform(-0.5, 1.5);
  switch (random.below(7))
  {
    case 0:
      return a;
    case 1:
      return a + t * (b - a);
    case 2:
      return Vec2(a.x(), other.y());
    case 3:
      return Vec2(a.x() + size * random.uniform(-2.0, 2.0), a.y());
    case 4:
      return a + t * (b - a) + size * std::pow(10.0, random.uniform(-17.0, -2.0)) * direction();
    case 5:
      return lower + size * std::pow(10.0, random.uniform(0.0, 25.0)) * direction();
    default:
      return lower + size * (direction() + Vec2::Ones());
  }
}
} // namespace

TEST(FuzzWinding, CurvesAgainstThePlainSum)
{
  Index queries = 0, touching = 0;
  double worst = 0.0;
  fuzz("curves", 3000,
    [&](Random& random)
    {
      const Curve curve = hostile_curve(random);
      SerialContext context;
      CurveWindingNumber winding;
      const Status status = winding.build(context, curve.points, curve.segments);
      ASSERT_TRUE(status.ok()) << status.message;
      const bool closed = status.report.number("counts.open_ends", -1.0) == 0.0;
      PlanePoints points(60, 2);
      for (Index i = 0; i < points.rows();)
      {
        const Vec2 p = hostile_curve_point(random, curve);
        if (p.allFinite())
        {
          points.row(i++) = p.transpose();
        }
      }
      std::vector<double> values(static_cast<std::size_t>(points.rows()));
      std::vector<unsigned char> flags(values.size());
      ASSERT_TRUE(winding.evaluate(context, points, values.data(), flags.data()).ok());
      for (Index i = 0; i < points.rows(); ++i)
      {
        const Vec2 p = points.row(i);
        bool touches = false;
        const double expected =
          curve_winding_number_direct(curve.points, curve.segments, p, &touches);
        ++queries;
        touching += touches;
        const double error = std::abs(values[i] - expected);
        worst = std::max(worst, error);
        ASSERT_EQ(flags[i] != 0, touches) << std::setprecision(17) << p.transpose();
        ASSERT_LE(error, 1e-12) << std::setprecision(17) << p.transpose() << " " << touches;
        ASSERT_TRUE(same_bits(values[i], winding.evaluate_at(p)));
        ASSERT_TRUE(!closed || touches || values[i] == std::round(values[i])) << values[i];
      }
    });
  std::cout << "[ fuzz ] " << queries << " queries, " << touching
            << " of them touching; largest error " << worst << "\n";
}

namespace
{
Cloud hostile_cloud(Random& random)
{
  const Index count = 1 + random.below(chance(random, 0.1) ? 4000 : 200);
  Cloud cloud{ Points(count, 3), Points(count, 3), Eigen::VectorXd(count) };
  const Vec3 ones = Vec3::Ones();
  const Index lattice = chance(random, 0.3) ? 2 + random.below(8) : 0;
  Vec3 shape = ones;
  for (int k = 0; k < 3; ++k) // flatten the cloud to a plane or a line
  {
    shape[k] = chance(random, 0.2) ? 0.0 : chance(random, 0.2) ? 1e-9 : 1.0;
  }
  for (Index i = 0; i < count; ++i)
  {
    Vec3 at = random.in_box(-ones, ones);
    if (lattice)
    {
      at = (0.5 * static_cast<double>(lattice) * (at + ones)).array().floor();
    }
    else if (chance(random, 0.3)) // the sample is in a tight cluster
    {
      at = Vec3(0.3, 0.2, 0.1) + 1e-5 * at;
    }
    cloud.points.row(i) = at.cwiseProduct(shape).transpose();
    if (i > 0 && chance(random, 0.1))
    {
      cloud.points.row(i) = cloud.points.row(random.below(i)).eval();
    }
    const double length = chance(random, 0.1) ? 0.0 : std::pow(10.0, random.uniform(-3.0, 3.0));
    cloud.normals.row(i) = length * random.in_box(-ones, ones).transpose();
    cloud.areas[i] =
      chance(random, 0.1) ? 0.0 : random.uniform(0.0, 4.0 / static_cast<double>(count));
  }
  const double scale =
    chance(random, 0.3) ? std::ldexp(1.0, static_cast<int>(random.below(200)) - 100) : 1.0;
  cloud.points *= scale;
  cloud.areas *= scale * scale;
  if (chance(random, 0.3))
  {
    cloud.points.rowwise() +=
      scale * std::pow(10.0, random.uniform(0.0, 6.0)) * random.in_box(-ones, ones).transpose();
  }
  return cloud;
}

/// Evaluate the formula of the winding number, and the sum of the absolute values of its terms.
/// Samples of the cloud that are within the tolerance of the point are skipped.
void plain_sum_in_long_double(const Cloud& cloud, const Vec3& p, double tolerance, double& sum,
  double& unsigned_sum, bool& touches)
{
  long double signed_total = 0.0L, total = 0.0L;
  touches = false;
  for (Index i = 0; i < cloud.points.rows(); ++i)
  {
    using Long3 = Eigen::Matrix<long double, 3, 1>;
    const Long3 d = cloud.points.row(i).transpose().cast<long double>() - p.cast<long double>();
    const Long3 n = cloud.normals.row(i).transpose().cast<long double>();
    const long double length = n.norm(), r = d.norm();
    if (r <= static_cast<long double>(tolerance))
    {
      touches = true;
    }
    else if (length > 0.0L)
    {
      const long double scale = cloud.areas[i] / (12.566370614359172954L * r * r * r);
      signed_total += scale * n.dot(d) / length;
      total += scale * r;
    }
  }
  sum = static_cast<double>(signed_total);
  unsigned_sum = static_cast<double>(total);
}
} // namespace

TEST(FuzzWinding, CloudsAgainstThePlainSum)
{
  Index queries = 0, touching = 0;
  double worst = 0.0, worst_fast = 0.0;
  fuzz("clouds", 700,
    [&](Random& random)
    {
      const Cloud cloud = hostile_cloud(random);
      Box box;
      for (Index i = 0; i < cloud.points.rows(); ++i)
      {
        box.add(cloud.points.row(i));
      }
      const double size = box.diagonal() > 0.0 ? box.diagonal() : 1.0;
      const double reach =
        std::ldexp(std::max(box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff()), -49);
      Points points(40, 3);
      for (Index i = 0; i < points.rows(); ++i)
      {
        const Vec3 sample = cloud.points.row(random.below(cloud.points.rows()));
        const Vec3 off = random.in_box(Vec3::Constant(-1.0), Vec3::Constant(1.0));
        const double far = random.below(3) == 0 ? std::pow(10.0, random.uniform(0.0, 12.0))
                                                : std::pow(10.0, random.uniform(-9.0, 0.0));
        points.row(i) =
          (chance(random, 0.2) ? sample : Vec3(sample + far * size * off)).transpose();
      }
      for (const WindingCase& winding_case : { WindingCase{ WindingMethod::automatic, 1e-3 },
             WindingCase{ WindingMethod::direct, 1e-3 }, WindingCase{ WindingMethod::fast, 1e-2 },
             WindingCase{ WindingMethod::fast, 1e-3 }, WindingCase{ WindingMethod::fast, 1e-5 } })
      {
        PointCloudWindingNumber::Options options;
        options.method = winding_case.method;
        options.tolerance = winding_case.tolerance;
        SerialContext context;
        PointCloudWindingNumber winding;
        const Status status =
          winding.build(context, cloud.points, cloud.normals, cloud.areas, options);
        expect_valid_messages(status);
        if (!status.ok())
        {
          EXPECT_EQ(status.code, StatusCode::invalid_input);
          return;
        }
        std::vector<double> values(static_cast<std::size_t>(points.rows()));
        std::vector<unsigned char> flags(values.size());
        ASSERT_TRUE(winding.evaluate(context, points, values.data(), flags.data()).ok());
        for (Index i = 0; i < points.rows(); ++i)
        {
          const Vec3 p = points.row(i);
          double expected = 0.0, absolute_sum = 0.0;
          bool touches = false;
          plain_sum_in_long_double(cloud, p, reach, expected, absolute_sum, touches);
          ++queries;
          touching += touches;
          ASSERT_EQ(flags[i] != 0, touches) << std::setprecision(17) << p.transpose();
          ASSERT_TRUE(same_bits(values[i], winding.evaluate_at(p)));
          const bool fast = winding.method() == WindingMethod::fast;
          const double rounding = 1e-14 * (1.0 + absolute_sum);
          const double error = std::abs(values[i] - expected);
          ASSERT_LE(error, rounding + (fast ? winding_case.tolerance : 0.0))
            << std::setprecision(17) << to_string(winding_case.method) << winding_case.tolerance
            << " at " << p.transpose() << ": " << values[i] << ", unsigned " << absolute_sum;
          double& largest = fast ? worst_fast : worst;
          largest = std::max(largest,
            fast ? (error - rounding) / winding_case.tolerance : error / (1.0 + absolute_sum));
        }
      }
    });
  std::cout << "[ fuzz ] " << queries << " queries, " << touching
            << " of them touching; largest error of plain sums " << worst
            << " of the unsigned shares, of fast ones " << worst_fast << " tolerances\n";
}
