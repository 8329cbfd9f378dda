// Volumes, edge counts, connected components and input checks of triangle and tet meshes.
#include "geometry/mesh.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

#include <limits>

using namespace bindpose;

TEST(Mesh, SignedVolumeIsTheDivergenceTheorems)
{
  const TriangleMesh box = test::cube();
  EXPECT_NEAR(signed_volume(box.points, box.triangles), 8.0, 1e-13);
  const TriangleMesh inside_out = test::flipped(box);
  EXPECT_NEAR(signed_volume(inside_out.points, inside_out.triangles), -8.0, 1e-13);
  const TriangleMesh far = test::translated(box, Vec3(1e6, -1e6, 1e6));
  EXPECT_NEAR(signed_volume(far.points, far.triangles), 8.0, 1e-9);
  EXPECT_NEAR(surface_area(box.points, box.triangles), 24.0, 1e-12);
}

TEST(Mesh, TetBoxIsWholeAndPositive)
{
  const TetMesh box = test::tet_box(3, 2, 4, Vec3(-1, 0, 2), Vec3(2, 1, 3));
  const Eigen::VectorXd volumes = tet_volumes(box.points, box.tets);
  EXPECT_GT(volumes.minCoeff(), 0.0);
  EXPECT_NEAR(volumes.sum(), 3.0, 1e-12);
  const Triangles skin = boundary_triangles(box.tets);
  EXPECT_EQ(skin.rows(), 2 * 2 * (3 * 2 + 2 * 4 + 3 * 4));
  EXPECT_TRUE(count_edges(skin).closed);
  EXPECT_NEAR(signed_volume(box.points, skin), 3.0, 1e-12);
}

TEST(Mesh, EdgeCountsTellOpenFlippedAndNonManifold)
{
  const TriangleMesh closed = test::cube();
  EdgeCounts counts = count_edges(closed.triangles);
  EXPECT_EQ(counts.edges, 18);
  EXPECT_EQ(counts.boundary + counts.nonmanifold + counts.misoriented, 0);
  EXPECT_TRUE(counts.closed);

  counts = count_edges(test::open_cube().triangles);
  EXPECT_EQ(counts.boundary, 4);
  EXPECT_FALSE(counts.closed);

  TriangleMesh turned = closed;
  turned.triangles.row(0).reverseInPlace();
  EXPECT_EQ(count_edges(turned.triangles).misoriented, 3);

  TriangleMesh wall = closed; // the cube plus an inner wall through four corners
  wall.triangles.conservativeResize(14, 3);
  wall.triangles.row(12) << 0, 3, 7;
  wall.triangles.row(13) << 0, 7, 4;
  EXPECT_EQ(count_edges(wall.triangles).nonmanifold, 4);
}

TEST(Mesh, ComponentsAreNumberedByVertex)
{
  const TriangleMesh two = test::join(test::cube(), test::sphere(1, 1.0, Vec3(5, 0, 0)));
  const Components components = connected_components(two.points.rows() + 1, two.triangles);
  EXPECT_EQ(components.count, 2);
  EXPECT_EQ(components.component_of_vertex.front(), 0);
  EXPECT_EQ(components.component_of_vertex[8], 1);
  EXPECT_EQ(components.component_of_vertex.back(), -1);
}

TEST(Mesh, CheckNamesTheFirstOffender)
{
  TriangleMesh mesh = test::cube();
  EXPECT_TRUE(check_mesh(mesh.points, mesh.triangles).ok());
  mesh.points(5, 1) = std::numeric_limits<double>::quiet_NaN();
  Status status = check_mesh(mesh.points, mesh.triangles);
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  EXPECT_NE(status.message.find("vertex 5"), std::string::npos) << status.message;
  mesh = test::cube();
  mesh.triangles(7, 2) = 8;
  status = check_mesh(mesh.points, mesh.triangles);
  EXPECT_NE(status.message.find("triangle 7"), std::string::npos) << status.message;
  EXPECT_TRUE(check_mesh(Points(0, 3), Triangles(0, 3)).ok());
}

TEST(Mesh, ChecksTheRangeOfFloats)
{
  const auto error = [](const Vec3& offset, double size)
  {
    const Points points = (test::cube().points * size).rowwise() + offset.transpose();
    return check_float_range(points).message;
  };
  EXPECT_EQ(error(Vec3(0, 0, 0), 1.0), "");
  EXPECT_EQ(error(Vec3(0, 0, 0), 1e38), "");
  EXPECT_EQ(error(Vec3(1e4, 0, 0), 1.0), "");
  EXPECT_EQ(error(Vec3(5, 5, 5), 0.0), "");
  EXPECT_NE(
    error(Vec3(0, 0, 0), 1e39).find("single precision allows at most 3.4e38"), std::string::npos);
  EXPECT_NE(
    error(Vec3(0, 0, 0), 1e-100).find("expected at most 0.01 of the diagonal"), std::string::npos);
  EXPECT_NE(
    error(Vec3(0, 0, 0), 1e-200).find("expected at most 0.01 of the diagonal"), std::string::npos);
  EXPECT_NE(
    error(Vec3(0, 1e7, 0), 1.0).find("expected at most 0.01 of the diagonal"), std::string::npos);
}
