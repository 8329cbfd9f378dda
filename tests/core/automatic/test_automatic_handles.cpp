// Automatic handles (bones along a curve skeleton, or spread points) of shapes with known limbs.
#include "automatic/automatic_handles.h"

#include "core/automatic/blocks.h"
#include "support/meshes.h"
#include "support/needs_mesher.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

using namespace bindpose;
using test::Block;
using testing::HasSubstr;

namespace
{
class AutomaticHandles : public test::MesherTest
{
};

Status run_automatic_handles(const TriangleMesh& mesh, const AutomaticHandlesOptions& options,
  Handles& handles, int threads = 0)
{
  ExecutionContext context;
  context.set_threads(threads);
  return automatic_handles(context, mesh.points, mesh.triangles, options, handles);
}

double number(const Status& status, const char* key)
{
  return status.report.number(key, -1.0);
}

/// Return the same surface with its vertices and triangles in another order.
TriangleMesh with_shuffled_ids(const TriangleMesh& mesh)
{
  test::Random random(11);
  std::vector<Index> vertex(static_cast<std::size_t>(mesh.points.rows()));
  std::vector<Index> triangle(static_cast<std::size_t>(mesh.triangles.rows()));
  for (std::vector<Index>* order : { &vertex, &triangle })
  {
    std::iota(order->begin(), order->end(), Index(0));
    for (std::size_t i = order->size(); i > 1; --i)
    {
      std::swap((*order)[i - 1], (*order)[random.below(static_cast<Index>(i))]);
    }
  }
  TriangleMesh result = mesh;
  for (std::size_t v = 0; v < vertex.size(); ++v)
  {
    result.points.row(vertex[v]) = mesh.points.row(static_cast<Index>(v));
  }
  for (std::size_t f = 0; f < triangle.size(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Index corner = mesh.triangles(static_cast<Index>(f), (k + static_cast<int>(f)) % 3);
      result.triangles(triangle[f], k) = vertex[corner];
    }
  }
  return result;
}

void expect_same(const Handles& a, const Handles& b)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    EXPECT_EQ(a[i].name, b[i].name);
    EXPECT_EQ(a[i].head, b[i].head);
    EXPECT_EQ(a[i].tail, b[i].tail);
    EXPECT_EQ(a[i].parent, b[i].parent);
  }
}

const std::vector<Block> cross_arms{ { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 } };
const std::vector<Block> t_arms{ { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 } };
} // namespace

TEST_F(AutomaticHandles, ABarIsOneBone)
{
  Handles handles;
  const Status status =
    run_automatic_handles(test::star({ { 1, 0, 0 } }, 7), AutomaticHandlesOptions(), handles);
  ASSERT_TRUE(status.ok()) << status.message;
  ASSERT_EQ(handles.size(), 1u);
  EXPECT_EQ(handles[0].kind, HandleKind::bone);
  EXPECT_EQ(number(status, "counts.joints_outside"), 0.0);
  EXPECT_EQ(number(status, "counts.bones_outside"), 0.0);
  EXPECT_NEAR(std::abs(handles[0].head.x() - handles[0].tail.x()), 7.0, 0.3);
}

TEST_F(AutomaticHandles, JunctionsHaveTheDegreeOfTheShape)
{
  for (const auto& arms : { cross_arms, t_arms })
  {
    Handles handles;
    const Status status =
      run_automatic_handles(test::star(arms, 4), AutomaticHandlesOptions(), handles);
    ASSERT_TRUE(status.ok()) << status.message;
    ASSERT_EQ(handles.size(), arms.size());
    EXPECT_EQ(number(status, "counts.junctions"), 1.0);
    EXPECT_EQ(number(status, "counts.joints"), static_cast<double>(arms.size()) + 1.0);
    EXPECT_EQ(number(status, "counts.joints_outside"), 0.0);
    for (const Handle& bone : handles)
    {
      // All bones begin in the cube in the middle and end near the ends of the arms.
      EXPECT_LT((bone.head - Vec3(0.5, 0.5, 0.5)).norm(), 0.5) << bone.name;
      EXPECT_EQ(bone.parent, &bone == &handles[0] ? -1 : 0);
      EXPECT_NEAR((bone.tail - Vec3(0.5, 0.5, 0.5)).norm(), 4.0, 0.3) << bone.name;
    }
  }
}

TEST_F(AutomaticHandles, ATorusIsCutOnce)
{
  Handles handles;
  const Status status =
    run_automatic_handles(test::torus(60, 24, 1.0, 0.3), AutomaticHandlesOptions(), handles);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(number(status, "counts.cut_cycles"), 1.0);
  EXPECT_EQ(number(status, "counts.joints"), static_cast<double>(handles.size()) + 1.0);
  EXPECT_EQ(number(status, "counts.joints_outside"), 0.0);
  EXPECT_THAT(status.warnings, testing::Contains(HasSubstr("1 loop")));
}

TEST_F(AutomaticHandles, DoNotDependOnOrderOrThreads)
{
  const TriangleMesh mesh = test::star(t_arms, 3);
  AutomaticHandlesOptions options;
  for (const AutomaticMethod method : { AutomaticMethod::skeleton, AutomaticMethod::points })
  {
    options.method = method;
    Handles plain, other, threads;
    ASSERT_TRUE(run_automatic_handles(mesh, options, plain).ok());
    ASSERT_TRUE(run_automatic_handles(with_shuffled_ids(mesh), options, other).ok());
    ASSERT_TRUE(run_automatic_handles(mesh, options, threads, 1).ok());
    expect_same(plain, other);
    expect_same(plain, threads);
  }
}

TEST(AutomaticPoints, NameTheVerticesOfTheInput)
{
  const TriangleMesh mesh = with_shuffled_ids(test::sphere(2));
  AutomaticHandlesOptions options;
  options.method = AutomaticMethod::points;
  options.points.inside = false;
  Handles handles;
  const Status status = run_automatic_handles(mesh, options, handles);
  ASSERT_TRUE(status.ok()) << status.message;
  ASSERT_EQ(handles.size(), 8u);
  const auto vertices =
    std::get<std::vector<std::int64_t>>(*status.report.find("handles[].vertex"));
  for (std::size_t i = 0; i < handles.size(); ++i)
  {
    EXPECT_EQ(handles[i].name, "p" + std::to_string(i + 1));
    EXPECT_EQ(handles[i].head, Vec3(mesh.points.row(vertices[i])));
  }
}

TEST(AutomaticPoints, BadInputLeavesNoHandles)
{
  AutomaticHandlesOptions options;
  options.method = AutomaticMethod::points;
  Handles handles(1);
  EXPECT_THAT(
    run_automatic_handles(TriangleMesh(), options, handles).message, HasSubstr("no triangles"));
  EXPECT_TRUE(handles.empty());
  TriangleMesh mesh = test::cube();
  mesh.points(0, 0) = std::nan("");
  EXPECT_EQ(run_automatic_handles(mesh, options, handles).code, StatusCode::invalid_input);
  mesh = test::cube();
  mesh.triangles(0, 0) = 99;
  EXPECT_EQ(run_automatic_handles(mesh, options, handles).code, StatusCode::invalid_input);
}
