// Winding numbers of surfaces, curves and clouds made to hurt: all methods against the plain sums,
// at points on, near and far from them.
//
// Tolerances are those of the documentation: exact methods keep 1e-14 and what the sum of unsigned
// shares makes of round-off, whole numbers are whole, the fast methods keep their tolerance, flags
// agree everywhere, and rows of grids and batches give the bits of single points.
#include "inside/curve_winding_number.h"
#include "inside/exact_frame.h"
#include "inside/point_cloud_winding_number.h"
#include "inside/solid_angle.h"
#include "inside/triangle_predicates.h"
#include "inside/winding_number.h"

#include "core/fuzz/hostile_surfaces.h"
#include "support/fuzz.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace bindpose;
using namespace bindpose::test;

namespace
{
struct OneThread : ExecutionContext
{
  OneThread() { this->set_threads(1); }
};

bool same_bits(double a, double b)
{
  return std::memcmp(&a, &b, sizeof a) == 0;
}

struct Way
{
  WindingMethod method;
  double tolerance;
};
constexpr Way ways[] = { { WindingMethod::automatic, 1e-3 }, { WindingMethod::exact, 1e-3 },
  { WindingMethod::direct, 1e-3 }, { WindingMethod::crossings, 1e-3 },
  { WindingMethod::hierarchical, 1e-3 }, { WindingMethod::fast, 1e-2 },
  { WindingMethod::fast, 1e-3 }, { WindingMethod::fast, 1e-5 } };

WindingNumber make(Random& random, const TriangleMesh& mesh, const Way& way)
{
  WindingNumber::Options options;
  options.method = way.method;
  options.tolerance = way.tolerance;
  options.max_leaf_size = chance(random, 0.5) ? 64 : 1 + random.below(8);
  OneThread context;
  WindingNumber winding;
  const Status status = winding.build(mesh.points, mesh.triangles, context, options);
  EXPECT_TRUE(status.ok()) << status.message;
  expect_spoken(status);
  return winding;
}

/// A triangle begins to touch here: rounding decides, and differently for the same triangle turned.
bool is_borderline(const TriangleMesh& mesh, const Vec3& point)
{
  const ExactFrame frame(bounding_box(mesh.points, mesh.triangles));
  const Vec3 p = frame(point);
  for (Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    const auto corner = [&](int k) { return frame(mesh.points.row(mesh.triangles(t, k))); };
    const auto touches = [&](double share)
    { return touches_triangle(p, corner(0), corner(1), corner(2), share * frame.tolerance); };
    if (touches(1.3) && !touches(0.7))
    {
      return true;
    }
  }
  return false;
}

/// Points and what the plain sum says there.
struct Truth
{
  Points points;
  std::vector<double> values;
  std::vector<bool> on_surface;
  std::vector<bool> borderline;

  template <typename PointAt>
  Truth(const TriangleMesh& mesh, Index count, const PointAt& point_at)
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

/// A grid whose samples share coordinates with vertices.
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

/// What has been seen in all rounds.
struct Tally
{
  Index queries = 0;
  Index touching = 0;
  Index borderline = 0; ///< nothing is known of these
  double exact_error = 0.0; ///< largest
  double fast_error = 0.0; ///< largest, in tolerances

  void add(const WindingNumber& winding, const Way& way, bool closed, const Truth& truth, Index i,
    double value, bool touches)
  {
    const auto where = [&]
    {
      std::ostringstream text;
      text.precision(17);
      text << to_string(way.method) << " " << way.tolerance << " (" << to_string(winding.method())
           << ") at " << truth.points.row(i) << ", touching " << truth.on_surface[i];
      return text.str();
    };
    ++this->queries;
    if (truth.borderline[i])
    {
      ++this->borderline;
      return;
    }
    this->touching += touches;
    if (!truth.points.row(i).allFinite()) // a grid that goes on beyond the largest double
    {
      EXPECT_TRUE(std::isnan(value) && std::isnan(truth.values[i]) && !touches) << where();
      return;
    }
    const double error = std::abs(value - truth.values[i]);
    EXPECT_EQ(touches, truth.on_surface[i]) << where();
    const bool fast = winding.method() == WindingMethod::fast;
    if (fast && !truth.on_surface[i])
    {
      EXPECT_LE(error, way.tolerance) << where();
      this->fast_error = std::max(this->fast_error, error / way.tolerance);
    }
    else
    {
      EXPECT_LE(error, 1e-10) << where();
      this->exact_error = std::max(this->exact_error, error);
    }
    if (closed && !truth.on_surface[i] && winding.method() != WindingMethod::direct)
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

/// One way of computing against the truth: all points at once, one by one, and on the grid.
void compare(Random& random, const TriangleMesh& mesh, const Way& way, const Truth& points,
  const SampleGrid& grid, const Truth& samples, Tally& tally)
{
  const WindingNumber winding = make(random, mesh, way);
  const bool closed = winding.boundary().edges.empty();
  OneThread context;
  for (const Truth* truth : { &points, &samples })
  {
    const bool on_grid = truth == &samples;
    const auto count = static_cast<Index>(truth->values.size());
    std::vector<double> values(truth->values.size());
    std::vector<unsigned char> flags(values.size());
    ASSERT_TRUE((on_grid ? winding.evaluate(grid, context, values.data(), flags.data())
                         : winding.evaluate(truth->points, context, values.data(), flags.data()))
                  .ok());
    for (Index i = 0; i < count; ++i)
    {
      const Vec3 p = truth->points.row(i);
      tally.add(winding, way, closed, *truth, i, values[i], flags[i] != 0);
      ASSERT_TRUE(same_bits(winding.evaluate_at(p), values[i]))
        << to_string(way.method) << (on_grid ? " on a grid" : " in a batch") << " at "
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
      mesh = placed(random, mesh);
      const Truth points(mesh, 64, [&](Index) { return hostile_point(random, mesh); });
      const SampleGrid grid = hostile_grid(random, mesh);
      const Truth samples(mesh, grid.count(), points_of(grid));
      for (const Way& way : ways)
      {
        compare(random, mesh, way, points, grid, samples, tally);
        if (testing::Test::HasFailure())
        {
          return;
        }
      }
    });
  tally.print();
}
