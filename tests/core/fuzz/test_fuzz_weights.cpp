// Fuzz test of weights for handles at random positions: on, in and outside of the mesh, and
// touching each other. Each problem is refused with an error message of one sentence, or its
// weights satisfy their definition.
#include "weights/weight_methods.h"

#include "core/weights/weights_shapes.h"
#include "support/fuzz.h"

#include <cmath>

using namespace bindpose;
using namespace bindpose::test;

namespace
{
/// Return a small random domain. In about half of the cases its vertices are perturbed.
Domain random_domain(Random& random)
{
  Domain domain;
  switch (random.below(4))
  {
    case 0:
      domain = to_domain(sphere(1));
      break;
    case 1:
      domain = to_domain(grid(5, 4));
      break;
    default:
    {
      const Index n = 1 + random.below(3);
      domain = to_domain(tet_box(static_cast<int>(n) + 1, 2, static_cast<int>(n)));
    }
  }
  if (chance(random, 0.5))
  {
    const Points before = domain.points;
    for (Index v = 0; v < domain.points.rows(); ++v)
    {
      domain.points.row(v) += random.in_cube(0.03).transpose();
    }
    domain.points = check_domain(domain).ok() ? domain.points : before;
  }
  if (chance(random, 0.2))
  {
    domain.points *= std::pow(10.0, random.uniform(-6.0, 6.0));
  }
  return domain;
}

/// Return a random point in a special position: at or near a vertex, on an edge, in an element,
/// outside of the domain, or at or near another handle.
Vec3 hostile_position(Random& random, const Domain& domain, const Handles& others)
{
  const Box box = bounding_box(domain.points);
  const double size = box.diagonal();
  const Index* corners = domain.element(random.below(domain.element_count()));
  const auto corner = [&](Index k) { return Vec3(domain.points.row(corners[k])); };
  const double small_length = size * std::pow(10.0, random.uniform(-16.0, -2.0));
  switch (random.below(9))
  {
    case 0:
      return corner(0);
    case 1:
      return corner(0) + small_length * random.in_cube();
    case 2:
      return 0.5 * (corner(0) + corner(1));
    case 3:
      return corner(0) + random.uniform() * (corner(1) - corner(0));
    case 4:
      return (corner(0) + corner(1) + corner(2)) / 3.0;
    case 5:
      return box.center() + random.in_cube(size);
    case 6:
    {
      if (!others.empty())
      {
        const Handle& other =
          others[static_cast<std::size_t>(random.below(static_cast<Index>(others.size())))];
        const Vec3 at = chance(random, 0.5) ? other.head : other.tail;
        return chance(random, 0.5) ? at : Vec3(at + small_length * random.in_cube());
      }
      [[fallthrough]];
    }
    default:
    {
      Vec3 sum = Vec3::Zero();
      double total = 0.0;
      for (int k = 0; k < domain.corners(); ++k)
      {
        const double weight = random.uniform();
        sum += weight * corner(k);
        total += weight;
      }
      return sum / total;
    }
  }
}

Handles handles_in(Random& random, const Domain& domain)
{
  Handles handles;
  const Index count = 1 + random.below(5);
  for (Index h = 0; h < count; ++h)
  {
    const std::string name = "h" + std::to_string(h);
    const Vec3 head = hostile_position(random, domain, handles);
    handles.push_back(chance(random, 0.6)
        ? point_handle(name, head)
        : bone_handle(name, head, hostile_position(random, domain, handles)));
    if (handles.back().kind == HandleKind::point && chance(random, 0.1))
    {
      handles.back().kind = HandleKind::cage_vertex;
    }
  }
  return handles;
}

double size_of_domain(const Domain& domain)
{
  return domain.is_volume() ? tet_volumes(domain.points, domain.tets).sum()
                            : surface_area(domain.points, domain.triangles);
}

/// Return the smallest height of an element, as a fraction of the bounding-box diagonal. The height
/// is tiny if two handles almost touch.
double smallest_height(const Domain& domain)
{
  const double size = bounding_box(domain.points).diagonal();
  double smallest = 1.0;
  for (Index e = 0; e < domain.element_count(); ++e)
  {
    const Index* ids = domain.element(e);
    const auto corner = [&](int k) { return Vec3(domain.points.row(ids[k])); };
    double largest_facet = 0.0, measure = 0.0;
    for (int k = 0; k < domain.corners(); ++k)
    {
      const Vec3 a = corner((k + 1) % domain.corners()), b = corner((k + 2) % domain.corners());
      largest_facet = std::max(largest_facet,
        domain.is_volume() ? 0.5 * (b - a).cross(corner((k + 3) % 4) - a).norm() : (b - a).norm());
    }
    measure = domain.is_volume() ? 3.0 * tet_volume(corner(0), corner(1), corner(2), corner(3))
                                 : (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
    smallest = std::min(smallest, measure / largest_facet / size);
  }
  return smallest;
}

/// Expect that the insertion of handles only splits elements and does not change the shape.
void expect_same_shape(const Domain& before, const HandleInsertion& after)
{
  const Domain& domain = after.domain;
  ASSERT_TRUE(check_domain(domain).ok()) << check_domain(domain).message;
  EXPECT_EQ(domain.points.topRows(before.points.rows()), before.points);
  EXPECT_NEAR(size_of_domain(domain), size_of_domain(before), 1e-9 * size_of_domain(before));
}

Status solve_with_random_options(
  Random& random, const WeightsProblem& problem, const WeightMethod& method, WeightsResult& result)
{
  ExecutionContext context;
  context.set_threads(1);
  WeightsOptions options;
  options.order = 2 + static_cast<int>(random.below(4)) / 3;
  options.smoothing = random.below(2) == 0 ? 0.0 : random.uniform(1e-3, 1.0);
  options.power = random.uniform(0.1, 9.0);
  options.heat = std::exp(random.uniform(-7.0, 7.0));
  return method.kernel(context, problem, options, result);
}

void expect_weights_of_method(const WeightsProblem& problem, const WeightMethod& method,
  const Status& status, const WeightsResult& result)
{
  ASSERT_EQ(result.weights.rows(), problem.vertex_count());
  ASSERT_EQ(result.weights.cols(), problem.handle_count());
  ASSERT_TRUE(result.weights.allFinite() && result.raw.allFinite());
  if (method.constrained)
  {
    for (const Weights* weights : { &result.raw, &result.weights })
    {
      EXPECT_GE(weights->minCoeff(), 0.0);
      EXPECT_LE(weights->maxCoeff(), 1.0);
    }
  }
  for (Index v = 0; v < problem.vertex_count(); ++v)
  {
    const bool empty = problem.constraints.roles[v] == VertexRole::unreferenced;
    // Without bounds, a row may have large weights of both signs. Then the sum of the row has more
    // round-off.
    const double size = std::max(1.0, result.weights.row(v).cwiseAbs().sum());
    ASSERT_NEAR(result.weights.row(v).sum(), empty ? 0.0 : 1.0, 1e-12 * size) << v;
  }
  for (std::size_t i = 0; i < problem.constraints.vertices.size(); ++i)
  {
    const Index v = problem.constraints.vertices[i];
    ASSERT_LE((result.weights.row(v) - problem.constraints.values.row(static_cast<Index>(i)))
                .cwiseAbs()
                .maxCoeff(),
      1e-12);
  }
  for (const WeightsColumn& column : result.columns)
  {
    if (status.ok())
    {
      EXPECT_LE(column.certificate.relative_gap, WeightsOptions().tolerance);
      EXPECT_LE(column.certificate.kkt_residual, WeightsOptions().tolerance);
    }
  }
}
} // namespace

TEST(FuzzWeights, HandlesAnywhere)
{
  Index refused = 0, unsolvable = 0, late = 0;
  fuzz("sets of handles", 1500,
    [&](Random& random)
    {
      const Domain domain = random_domain(random);
      const Handles handles = handles_in(random, domain);
      WeightsOptions options;
      options.insertion.keep_mesh = chance(random, 0.15);
      WeightsProblem problem;
      ExecutionContext context;
      context.set_threads(1);
      const Status made = make_weights_problem(context, domain, {}, handles, options, problem);
      expect_valid_messages(made);
      if (!made.ok())
      {
        EXPECT_EQ(made.code, StatusCode::invalid_input) << made.message;
        ++refused;
        return;
      }
      expect_same_shape(domain, problem.mesh);
      for (Index h = 0; h < problem.handle_count(); ++h)
      {
        EXPECT_EQ(problem.constraints.values.col(h).maxCoeff(), 1.0) << "a handle without a vertex";
      }
      // Half of the cases use bounded or monotone weights, the other half use the other methods.
      const std::vector<WeightMethod>& methods = weight_methods();
      const WeightMethod& method =
        methods[random.below(2) == 0 ? random.below(2)
                                     : 2 + random.below(static_cast<int>(methods.size()) - 2)];
      SCOPED_TRACE(method.word);
      WeightsResult result;
      const Status status = solve_with_random_options(random, problem, method, result);
      expect_valid_messages(status);
      if (!status.usable())
      {
        // The solver may fail only if an element is almost flat. Then the energy may have no unique
        // minimum in double precision.
        EXPECT_EQ(status.code, StatusCode::invalid_input);
        EXPECT_LT(smallest_height(problem.mesh.domain), 1e-4) << status.message;
        ++unsolvable;
        return;
      }
      late += status.ok() ? 0 : 1;
      expect_weights_of_method(problem, method, status, result);
    });
  std::cout << "[ fuzz ] " << refused << " of them were refused, " << unsolvable
            << " had no unique minimum, " << late << " not certified in time\n";
}
