// Handles become vertices of the domain. The insertion keeps volumes, orientations and the ids of
// original vertices. New vertices are at the handles, and every degenerate position has a defined
// result.
#include "domain/handle_constraints.h"

#include "weights_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace bindpose;

namespace
{
HandleInsertion inserted(
  const Domain& domain, const Handles& handles, const HandleInsertionOptions& options = {})
{
  ExecutionContext context;
  HandleInsertion result;
  const Status status = insert_handles(context, domain, handles, options, result);
  EXPECT_TRUE(status.ok()) << status.message;
  return result;
}

/// Expect the invariants that every insertion has.
void expect_sound(const Domain& before, const HandleInsertion& after)
{
  const Index n = before.points.rows();
  ASSERT_GE(after.domain.points.rows(), n);
  EXPECT_EQ(after.domain.points.topRows(n), before.points);
  EXPECT_EQ(after.domain.points.rows(), n + static_cast<Index>(after.inserted.size()));
  ASSERT_EQ(static_cast<Index>(after.parent_element.size()), after.domain.element_count());
  if (before.is_volume())
  {
    const Eigen::VectorXd old_volumes = tet_volumes(before.points, before.tets);
    const Eigen::VectorXd volumes = tet_volumes(after.domain.points, after.domain.tets);
    EXPECT_GT(volumes.minCoeff(), 0.0);
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(old_volumes.size());
    for (Index t = 0; t < volumes.size(); ++t)
    {
      sums[after.parent_element[t]] += volumes[t];
    }
    EXPECT_LT((sums - old_volumes).cwiseAbs().maxCoeff(), 1e-12 * old_volumes.maxCoeff());
    // The boundary encloses the same volume as before the insertion.
    EXPECT_NEAR(signed_volume(after.domain.points, boundary_triangles(after.domain.tets)),
      old_volumes.sum(), 1e-12 * old_volumes.sum());
  }
  else
  {
    EXPECT_NEAR(surface_area(after.domain.points, after.domain.triangles),
      surface_area(before.points, before.triangles), 1e-12);
    EXPECT_EQ(
      count_edges(after.domain.triangles).nonmanifold, count_edges(before.triangles).nonmanifold);
    EXPECT_EQ(count_edges(after.domain.triangles).misoriented, 0);
  }
  for (std::size_t i = 0; i < after.inserted.size(); ++i)
  {
    const InsertedVertex& vertex = after.inserted[i];
    Vec3 p = Vec3::Zero();
    double sum = 0.0;
    for (int k = 0; k < before.corners(); ++k)
    {
      EXPECT_GE(vertex.barycentric[k], 0.0);
      p += vertex.barycentric[k] * before.points.row(vertex.parents[k]).transpose();
      sum += vertex.barycentric[k];
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
    EXPECT_LT((p - after.domain.points.row(n + static_cast<Index>(i)).transpose()).norm(), 1e-12);
  }
}

Vec3 handle_position(const HandleInsertion& mesh, Index handle)
{
  return mesh.domain.points.row(mesh.handles[handle].vertices.at(0));
}
} // namespace

TEST(HandleInsertion, PointsInsideCellsFacesAndEdgesBecomeVertices)
{
  const Domain box = test::to_domain(test::tet_box(3, 3, 3));
  // The points are in a cell, in the interior of a face, in the middle of an edge, and at a vertex.
  const Handles handles = test::point_handles({ Vec3(0.55, 0.62, 0.41), Vec3(0.2, 0.1, 0.0),
    Vec3(0.5, 1.0, 1.0), Vec3(1.0 / 3.0, 2.0 / 3.0, 1.0 / 3.0) });
  const HandleInsertion mesh = inserted(box, handles);
  expect_sound(box, mesh);
  EXPECT_EQ(mesh.inserted.size(), 3u);
  const double edge = 1.3 / 3.0;
  for (Index h = 0; h < 4; ++h)
  {
    ASSERT_EQ(mesh.handles[h].vertices.size(), 1u);
    EXPECT_NEAR((handle_position(mesh, h) - handles[h].head).norm(), mesh.handles[h].snap, 1e-12);
    EXPECT_LE(mesh.handles[h].snap, 3 * 0.1 * edge);
    EXPECT_EQ(mesh.handles[h].outside, 0.0);
  }
  EXPECT_LT((handle_position(mesh, 2) - handles[2].head).norm(), 1e-12);
  EXPECT_LT(mesh.handles[3].vertices[0], box.points.rows());
}

TEST(HandleInsertion, ManyRandomHandlesKeepVolumesAndStayApart)
{
  const Domain box = test::to_domain(test::tet_box(2, 2, 2));
  test::Random random(11);
  std::vector<Vec3> positions;
  for (int i = 0; i < 60; ++i)
  {
    positions.push_back(random.in_box(Vec3::Zero(), Vec3::Ones()));
  }
  const HandleInsertion mesh = inserted(box, test::point_handles(positions));
  expect_sound(box, mesh);
  std::set<Index> vertices;
  for (const HandlePlacement& placement : mesh.handles)
  {
    ASSERT_EQ(placement.vertices.size(), 1u);
    vertices.insert(placement.vertices[0]);
  }
  EXPECT_EQ(vertices.size(), 60u) << "no two handles share a vertex";

  const Domain sheet = test::to_domain(test::grid(3, 3));
  for (Vec3& p : positions)
  {
    p.z() = 0.0;
  }
  const HandleInsertion flat = inserted(sheet, test::point_handles(positions));
  expect_sound(sheet, flat);
}

TEST(HandleInsertion, TwoHandlesInOneTetGetTheirOwnVertices)
{
  const Domain one = test::to_domain(test::tet_box(1, 1, 1));
  const Handles handles = test::point_handles(
    { Vec3(0.60, 0.30, 0.15), Vec3(0.62, 0.31, 0.16), Vec3(0.01, 0.0, 0.0), Vec3(0.0, 0.0, 0.0) });
  const HandleInsertion mesh = inserted(one, handles);
  expect_sound(one, mesh);
  std::set<Index> vertices;
  for (const HandlePlacement& placement : mesh.handles)
  {
    vertices.insert(placement.vertices.at(0));
  }
  EXPECT_EQ(vertices.size(), 4u);
}

TEST(HandleInsertion, BonesAreSampledAtTheLocalEdgeLength)
{
  const Domain box = test::to_domain(test::tet_box(8, 4, 4));
  const Handles handles{ test::bone_handle("b1", Vec3(0.07, 0.41, 0.33), Vec3(0.5, 0.45, 0.4)),
    test::bone_handle("b2", Vec3(0.5, 0.45, 0.4), Vec3(0.93, 0.8, 0.6)) };
  const HandleInsertion mesh = inserted(box, handles);
  expect_sound(box, mesh);
  for (Index h = 0; h < 2; ++h)
  {
    const Vec3 axis = (handles[h].tail - handles[h].head).normalized();
    std::vector<double> at;
    for (const Index v : mesh.handles[h].vertices)
    {
      const Vec3 d = mesh.domain.points.row(v).transpose() - handles[h].head;
      EXPECT_LE((d - axis.dot(d) * axis).norm(), mesh.handles[h].snap + 1e-12);
      at.push_back(axis.dot(d));
    }
    std::sort(at.begin(), at.end());
    for (std::size_t i = 1; i < at.size(); ++i)
    {
      EXPECT_LT(at[i] - at[i - 1], 2.0 * 0.3) << "no gap of two edges";
    }
    EXPECT_GE(at.size(), 3u);
  }
  // The joint is one vertex that belongs to both bones.
  std::vector<Index> joint;
  std::set_intersection(mesh.handles[0].vertices.begin(), mesh.handles[0].vertices.end(),
    mesh.handles[1].vertices.begin(), mesh.handles[1].vertices.end(), std::back_inserter(joint));
  EXPECT_EQ(joint.size(), 1u);
}

TEST(HandleInsertion, ABoneAlongVerticesTakesThemAsTheyAre)
{
  const Domain box = test::to_domain(test::tet_box(4, 4, 4));
  const HandleInsertion mesh =
    inserted(box, { test::bone_handle("b", Vec3(0, 0.5, 0.5), Vec3(1, 0.5, 0.5)) });
  EXPECT_TRUE(mesh.inserted.empty());
  EXPECT_EQ(mesh.handles[0].vertices.size(), 5u);
  EXPECT_EQ(mesh.domain.tets, box.tets);
}

TEST(HandleInsertion, OutsideIsMovedToTheSurfaceAndSaid)
{
  const Domain box = test::to_domain(test::tet_box(3, 3, 3));
  const Handles handles =
    test::point_handles({ Vec3(0.5, 0.5, 1.25), Vec3(0.4, 0.6, 0.5), Vec3(-0.3, -0.4, 0.5) });
  const HandleInsertion mesh = inserted(box, handles);
  expect_sound(box, mesh);
  EXPECT_NEAR(mesh.handles[0].outside, 0.25, 1e-12);
  EXPECT_EQ(mesh.handles[1].outside, 0.0);
  EXPECT_NEAR(mesh.handles[2].outside, 0.5, 1e-12);
  EXPECT_LE((handle_position(mesh, 0) - Vec3(0.5, 0.5, 1.0)).norm(), mesh.handles[0].snap + 1e-12);
  ASSERT_EQ(mesh.warnings.size(), 1u);
  EXPECT_NE(mesh.warnings[0].find("'p1' by 0.25"), std::string::npos) << mesh.warnings[0];
  EXPECT_NE(mesh.warnings[0].find("'p3' by 0.5"), std::string::npos);
  EXPECT_EQ(mesh.warnings[0].find("'p2'"), std::string::npos);
}

TEST(HandleInsertion, KeepMeshTakesTheCorners)
{
  const Domain box = test::to_domain(test::tet_box(2, 2, 2));
  HandleInsertionOptions options;
  options.keep_mesh = true;
  const Handles handles = test::point_handles({ Vec3(0.3, 0.2, 0.1), Vec3(0.32, 0.22, 0.12) });
  const HandleInsertion mesh = inserted(box, handles, options);
  EXPECT_TRUE(mesh.inserted.empty());
  EXPECT_EQ(mesh.handles[0].vertices.size(), 4u);
  HandleConstraints constraints;
  const Status same = constrain_handles(mesh, handles, {}, constraints);
  EXPECT_EQ(same.code, StatusCode::invalid_input) << "all corners shared: nothing is p1's own";
  EXPECT_NE(same.message.find("'p1'"), std::string::npos);

  // The handles are now joints of a rig. All corners of the first joint's tet are assigned to the
  // second joint. No vertex remains for the first joint, so it is skipped.
  Handles joints = handles;
  joints.push_back(test::point_handle("p3", Vec3(0.6, 0.2, 0.1)));
  for (Handle& joint : joints)
  {
    joint.ownership = Ownership::optional;
  }
  const HandleInsertion rig = inserted(box, joints, options);
  const Status skipped = constrain_handles(rig, joints, {}, constraints);
  ASSERT_TRUE(skipped.ok()) << skipped.message;
  EXPECT_EQ(constraints.counts[0], 0);
  EXPECT_EQ(constraints.values.colwise().maxCoeff(), Eigen::RowVector3d(0, 1, 1));
  EXPECT_LT((constraints.values.rowwise().sum().array() - 1.0).abs().maxCoeff(), 1e-12);
  ASSERT_EQ(constraints.warnings.size(), 2u);
  EXPECT_NE(constraints.warnings[0].find("joint 'p1' has no vertex"), std::string::npos);
  EXPECT_NE(constraints.warnings[1].find("'p2' and 'p3' share"), std::string::npos);

  const Handles apart = test::point_handles({ Vec3(0.3, 0.2, 0.1), Vec3(0.6, 0.2, 0.1) });
  const HandleInsertion two = inserted(box, apart, options);
  ASSERT_TRUE(constrain_handles(two, apart, {}, constraints).ok());
  ASSERT_EQ(constraints.warnings.size(), 1u);
  EXPECT_NE(constraints.warnings[0].find("'p1' and 'p2' share"), std::string::npos);
}

TEST(HandleConstraints, RowsSumToOneAndJointsAreShared)
{
  const Domain box = test::to_domain(test::tet_box(6, 3, 3));
  Handles handles{ test::bone_handle("upper", Vec3(0.1, 0.5, 0.5), Vec3(0.5, 0.5, 0.5)),
    test::bone_handle("lower", Vec3(0.5, 0.5, 0.5), Vec3(0.9, 0.5, 0.5)),
    test::point_handle("tip", Vec3(0.97, 0.9, 0.9)) };
  const HandleInsertion mesh = inserted(box, handles);
  HandleConstraints constraints;
  ASSERT_TRUE(constrain_handles(mesh, handles, {}, constraints).ok());
  EXPECT_TRUE(constraints.warnings.empty()) << "a joint is no conflict";
  EXPECT_LT((constraints.values.rowwise().sum().array() - 1.0).abs().maxCoeff(), 1e-12);
  EXPECT_EQ(constraints.values.colwise().maxCoeff(), Eigen::RowVector3d::Ones());
  EXPECT_EQ(constraints.values.colwise().minCoeff(), Eigen::RowVector3d::Zero());
  Index joints = 0;
  for (Index i = 0; i < constraints.values.rows(); ++i)
  {
    joints += constraints.values(i, 0) == 0.5 && constraints.values(i, 1) == 0.5;
  }
  EXPECT_EQ(joints, 1);
  EXPECT_EQ(constraints.counts[2], 1);
  EXPECT_EQ(constraints.counts[0] + constraints.counts[1],
    static_cast<Index>(constraints.vertices.size()) - 1 + 1);
}

TEST(HandleConstraints, APointOnABoneKeepsAVertex)
{
  const Domain box = test::to_domain(test::tet_box(4, 4, 4));
  const Handles handles{ test::bone_handle("bone", Vec3(0, 0.5, 0.5), Vec3(1, 0.5, 0.5)),
    test::point_handle("point", Vec3(0.5, 0.5, 0.5)) };
  const HandleInsertion mesh = inserted(box, handles);
  HandleConstraints constraints;
  ASSERT_TRUE(constrain_handles(mesh, handles, {}, constraints).ok());
  EXPECT_EQ(constraints.values.col(1).maxCoeff(), 1.0);
}

TEST(HandleConstraints, RegionsTakeLabeledVertices)
{
  test::Bar bar = test::bar(10, { 0.0, 1.0 });
  HandleInsertion mesh = inserted(bar.domain, bar.handles);
  HandleConstraints constraints;
  ASSERT_TRUE(constrain_handles(mesh, bar.handles, bar.region_ids, constraints).ok());
  EXPECT_EQ(constraints.counts, (std::vector<Index>{ 3, 3 }));
  bar.handles[1].region_id = 9;
  Status status = constrain_handles(mesh, bar.handles, bar.region_ids, constraints);
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  EXPECT_NE(status.message.find("'r2'"), std::string::npos);
  status = constrain_handles(mesh, bar.handles, {}, constraints);
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  bar.handles[1].region_id = 0;
  status = constrain_handles(mesh, bar.handles, bar.region_ids, constraints);
  EXPECT_NE(status.message.find("positive"), std::string::npos);
}

TEST(HandleConstraints, PartsWithoutHandlesFollowTheNearest)
{
  const TriangleMesh near = test::grid(3, 3);
  const TriangleMesh far = test::translated(test::grid(2, 2), Vec3(3, 0, 0));
  const Domain domain = test::to_domain(test::join(near, far));
  const Handles handles = test::point_handles({ Vec3(0, 0, 0), Vec3(1, 1, 0) });
  const HandleInsertion mesh = inserted(domain, handles);
  HandleConstraints constraints;
  ASSERT_TRUE(constrain_handles(mesh, handles, {}, constraints).ok());
  EXPECT_EQ(constraints.components.count, 2);
  EXPECT_EQ(constraints.nearest_handle, (std::vector<Index>{ -1, 1 }));
  ASSERT_EQ(constraints.warnings.size(), 1u);
  EXPECT_NE(constraints.warnings[0].find("'p2'"), std::string::npos);
  EXPECT_EQ(constraints.roles[domain.points.rows() - 1], VertexRole::without_handle);
}

TEST(HandleConstraints, OneWarningPerKind)
{
  // The mesh has five parts, two of which have handles. The other parts use the weights of the
  // nearest handles, p1 or p2.
  TriangleMesh mesh = test::grid(3, 3);
  for (const double x : { 3.0, 6.0, 9.0, 12.0 })
  {
    mesh = test::join(mesh, test::translated(test::grid(2, 2), Vec3(x, 0, 0)));
  }
  const Domain domain = test::to_domain(mesh);
  const Handles handles = test::point_handles({ Vec3(0, 0, 0), Vec3(13, 1, 0) });
  const HandleInsertion on_parts = inserted(domain, handles);
  HandleConstraints constraints;
  ASSERT_TRUE(constrain_handles(on_parts, handles, {}, constraints).ok());
  ASSERT_EQ(constraints.warnings.size(), 1u);
  EXPECT_EQ(constraints.warnings[0],
    "3 connected parts without a handle follow the nearest handles 'p1', 'p2'");

  // Six handles in one tet form fifteen pairs that share corners.
  const Domain box = test::to_domain(test::tet_box(1, 1, 1));
  HandleInsertionOptions options;
  options.keep_mesh = true;
  Handles crowd;
  for (int k = 0; k < 6; ++k)
  {
    crowd.push_back(test::point_handle("h" + std::to_string(k), Vec3(0.3 + 0.02 * k, 0.2, 0.1)));
    crowd.back().ownership = Ownership::optional;
  }
  const HandleInsertion shared = inserted(box, crowd, options);
  ASSERT_TRUE(constrain_handles(shared, crowd, {}, constraints).ok());
  Index skips = 0;
  for (const std::string& warning : constraints.warnings)
  {
    skips += warning.find("no vertex of their own") != std::string::npos;
    EXPECT_LT(warning.size(), 160u) << warning;
  }
  EXPECT_EQ(skips, 1);
  EXPECT_LE(constraints.warnings.size(), 2u);
}

TEST(HandleConstraints, FlatTrianglesFollowTheirNeighbors)
{
  TriangleMesh mesh = test::grid(3, 3);
  const Index n = mesh.points.rows();
  mesh.points.conservativeResize(n + 3, 3);
  mesh.points.row(n) << 0.5, 0.0, 0.0; // on the edge 1-2
  mesh.points.row(n + 1) << 9.0, 9.0, 9.0; // used by no triangle
  mesh.points.row(n + 2) << 0.6, 0.0, 0.0; // on the edge 1-2
  // Add two triangles without area: one joins vertex n + 2 to n, the other joins vertex n to 1.
  mesh.triangles.conservativeResize(mesh.triangles.rows() + 2, 3);
  mesh.triangles.row(mesh.triangles.rows() - 2) << n, n + 2, n;
  mesh.triangles.row(mesh.triangles.rows() - 1) << 1, n, 1;
  const Handles handles = test::point_handles({ Vec3(0, 0, 0), Vec3(1, 1, 0) });
  const HandleInsertion inserted_mesh = inserted(test::to_domain(mesh), handles);
  HandleConstraints constraints;
  ASSERT_TRUE(constrain_handles(inserted_mesh, handles, {}, constraints).ok());
  EXPECT_EQ(constraints.roles[n], VertexRole::follower);
  EXPECT_EQ(constraints.leader[n], 1);
  EXPECT_EQ(constraints.leader[n + 2], 1);
  EXPECT_EQ(constraints.roles[n + 1], VertexRole::unreferenced);
}

TEST(HandleInsertion, BadInputsAreNamed)
{
  ExecutionContext context;
  HandleInsertion result;
  const auto message = [&](const Domain& domain, const Handles& handles)
  {
    const Status status = insert_handles(context, domain, handles, {}, result);
    EXPECT_EQ(status.code, StatusCode::invalid_input);
    return status.message;
  };
  const Domain good = test::to_domain(test::tet_box(1, 1, 1));
  const Handles points = test::point_handles({ Vec3(0.1, 0.1, 0.1), Vec3(0.9, 0.9, 0.9) });
  EXPECT_NE(message(Domain(), points).find("empty"), std::string::npos);
  EXPECT_NE(message(good, {}).find("no handle"), std::string::npos);
  EXPECT_NE(
    message(good, test::point_handles({ Vec3::Zero(), Vec3::Zero() })).find("same position"),
    std::string::npos);
  EXPECT_NE(message(good, test::point_handles({ Vec3(0, std::nan(""), 0) })).find("'p1'"),
    std::string::npos);
  Domain bad = good;
  bad.points(3, 1) = std::nan("");
  EXPECT_NE(message(bad, points).find("vertex 3"), std::string::npos);
  bad = good;
  std::swap(bad.tets(2, 0), bad.tets(2, 1));
  EXPECT_NE(message(bad, points).find("the first is tet 2"), std::string::npos);
  bad = good;
  bad.tets(4, 2) = 99;
  EXPECT_NE(message(bad, points).find("vertex 99"), std::string::npos);
  Domain flat = test::to_domain(test::grid(1, 1));
  flat.points.setZero();
  EXPECT_NE(message(flat, points).find("area"), std::string::npos);
}
