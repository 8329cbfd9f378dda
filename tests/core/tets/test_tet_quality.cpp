// Checks of tets, dihedral angles, histograms of angles, and removal of tiny components.
#include "tets/tet_quality.h"

#include "support/meshes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
/// Return one tet per apex, all on the same base triangle. The apices are above or below it.
TetMesh tet_fan(const std::vector<Vec3>& apices)
{
  TetMesh mesh;
  mesh.points.resize(3 + static_cast<Index>(apices.size()), 3);
  mesh.points.topRows(3) << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  mesh.tets.resize(static_cast<Index>(apices.size()), 4);
  for (std::size_t i = 0; i < apices.size(); ++i)
  {
    const auto t = static_cast<Index>(i);
    mesh.points.row(3 + t) = apices[i];
    mesh.tets.row(t) << 0, 1, 2, 3 + t;
    if (apices[i].z() < 0.0)
    {
      mesh.tets.row(t) << 1, 0, 2, 3 + t;
    }
  }
  return mesh;
}
} // namespace

TEST(TetQuality, TetsMeetAtMostInPairsOnOppositeSides)
{
  const TetMesh good = tet_fan({ Vec3(0.2, 0.2, 1), Vec3(0.2, 0.2, -1) });
  EXPECT_TRUE(check_tets(good.points, good.tets).ok());
  const TetMesh same_side = tet_fan({ Vec3(0.2, 0.2, 1), Vec3(0.3, 0.2, 0.5) });
  EXPECT_THAT(check_tets(same_side.points, same_side.tets).message, HasSubstr("overlap"));
  const TetMesh three = tet_fan({ Vec3(0.2, 0.2, 1), Vec3(0.2, 0.2, -1), Vec3(0.3, 0.2, 2) });
  EXPECT_THAT(check_tets(three.points, three.tets).message, HasSubstr("boundary is not closed"));
  EXPECT_TRUE(check_tets(three.points, three.tets, true).ok());
  TetMesh twice = three;
  twice.tets.row(2) << 1, 2, 0, 3; // this tet repeats the first one
  EXPECT_THAT(
    check_tets(twice.points, twice.tets, true).message, HasSubstr("tet 2 is a duplicate"));
  TetMesh turned = good;
  turned.tets.row(1).head<2>().reverseInPlace();
  EXPECT_THAT(
    check_tets(turned.points, turned.tets).message, HasSubstr("tet 1 must have a positive"));
}

TEST(TetQuality, AnglesOfVeryFlatTetsAreNotZero)
{
  for (const double height : { 1e-3, 1e-7, 1e-10, 1e-13 })
  {
    SCOPED_TRACE(height);
    // The projection of the apex onto the base has the distances 0.3, 0.3 and 0.2 sqrt(2) from the
    // edges of the base.
    const double degrees = 57.295779513082320877;
    const double angle =
      min_dihedral_angle(Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0.3, 0.3, -height));
    EXPECT_NEAR(angle / (degrees * std::atan(height / 0.3)), 1.0, 1e-6);
  }
}

TEST(TetQuality, TheHistogramCountsEveryTetOnce)
{
  // All dihedral angles of a regular tet are arccos(1/3) = 70.53 degrees.
  TetMesh regular;
  regular.points.resize(4, 3);
  regular.points << 1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1;
  regular.tets.resize(1, 4);
  regular.tets << 0, 2, 1, 3;
  if (tet_volumes(regular.points, regular.tets)[0] < 0.0)
  {
    regular.tets.row(0).head<2>().reverseInPlace();
  }
  const TetQuality best = measure_tets(regular.points, regular.tets);
  EXPECT_NEAR(best.min_dihedral_angle, 70.528779365509308, 1e-9);
  EXPECT_EQ(best.histogram.tets[14], 1);
  // The smallest dihedral angle in Kuhn's subdivision of a cube is 45 degrees.
  const TetMesh box = test::tet_box(2, 3, 4, Vec3::Zero(), Vec3(2, 3, 4));
  const TetQuality quality = measure_tets(box.points, box.tets);
  const auto& bins = quality.histogram.tets;
  EXPECT_EQ(std::accumulate(bins.begin(), bins.end(), Index(0)), box.tets.rows());
  EXPECT_EQ(bins[8] + bins[9], box.tets.rows());
}

TEST(TetQuality, CrumbsAndLoneTetsGo)
{
  // The mesh has a large component, a component of two small tets, and a single small tet.
  TetMesh mesh = test::tet_box(1, 1, 1);
  const Index n = mesh.points.rows();
  const Index m = mesh.tets.rows();
  mesh.points.conservativeResize(n + 9, 3);
  mesh.tets.conservativeResize(m + 3, 4);
  const double h = 0.02; // the volume of a tet is h^3 / 6 = 1.3e-6
  mesh.points.bottomRows(9) << 5, 0, 0, 5 + h, 0, 0, 5, h, 0, 5, 0, h, 5, 0, -h, //
    7, 0, 0, 7 + h, 0, 0, 7, h, 0, 7, 0, h;
  mesh.tets.row(m) << n, n + 1, n + 2, n + 3;
  mesh.tets.row(m + 1) << n + 1, n, n + 2, n + 4;
  mesh.tets.row(m + 2) << n + 5, n + 6, n + 7, n + 8;
  ASSERT_TRUE(check_tets(mesh.points, mesh.tets).ok());
  Tets tets = mesh.tets;
  std::vector<TetFacet> facets = tet_facets(tets);
  EXPECT_EQ(remove_small_components(mesh.points, tets, facets), 0);
  EXPECT_EQ(remove_small_components(mesh.points, tets, facets, 1e-4), 1);
  EXPECT_EQ(tets, mesh.tets.topRows(m + 2));
  EXPECT_EQ(facets.size(), static_cast<std::size_t>(4 * tets.rows()));
  EXPECT_TRUE(check_tets(mesh.points, tets, facets).ok());
}

TEST(TetQuality, TrianglesInFrontOfOthersForceFlatTets)
{
  // A tet is flat if a dihedral angle is below 5 degrees. The triangles on the top and bottom of
  // the plate have inscribed circles of radius 0.0488. If such a triangle is a face of a tet, the
  // tet is flat unless its height is at least 0.0488 tan(5 degrees) = 0.00427. In the plate of
  // height 0.004, all tets are therefore forced to be flat. In the plate of height 0.005, only tets
  // at the rim are forced to be flat, because the triangles of the rim are needles.
  for (const double height : { 0.004, 0.005 })
  {
    TetMesh plate = test::tet_box(6, 6, 1);
    plate.points.col(2) *= height;
    Eigen::VectorXd angles(plate.tets.rows());
    for (Index t = 0; t < plate.tets.rows(); ++t)
    {
      const auto tet = plate.tets.row(t);
      angles[t] = min_dihedral_angle(plate.points.row(tet[0]), plate.points.row(tet[1]),
        plate.points.row(tet[2]), plate.points.row(tet[3]));
    }
    ASSERT_LT(angles.maxCoeff(), 5.0);
    ExecutionContext context;
    const Index forced = count_forced_tets(context, plate.points, plate.tets, angles, 5.0);
    if (height < 0.00427)
    {
      EXPECT_EQ(forced, plate.tets.rows());
    }
    else
    {
      EXPECT_LT(forced, plate.tets.rows());
      EXPECT_GT(forced, 0);
    }
  }
}
