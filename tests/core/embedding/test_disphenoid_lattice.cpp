// Lattice of congruent tets (disphenoids): location of points, tets that a triangle crosses, and
// exact nodes.
#include "embedding/disphenoid_lattice.h"

#include "tets/tet_quality.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace bindpose;

namespace
{
using Key = DisphenoidLattice::Key;

std::array<Vec3, 4> tet_at(const DisphenoidLattice& lattice, Key tet)
{
  std::array<Vec3, 4> points;
  const auto nodes = DisphenoidLattice::corners(tet);
  for (int k = 0; k < 4; ++k)
  {
    points[k] = lattice.node_point(nodes[k]);
  }
  return points;
}

DisphenoidLattice unit_lattice()
{
  Box box;
  box.add(Vec3::Zero());
  box.add(Vec3::Constant(8.0));
  return DisphenoidLattice(box, 1.0);
}
} // namespace

TEST(DisphenoidLattice, EveryPlaceIsInItsTet)
{
  const DisphenoidLattice lattice = unit_lattice();
  test::Random random(1);
  for (int round = 0; round < 2000; ++round)
  {
    Vec3 position = random.in_box(Vec3::Constant(2.0), Vec3::Constant(5.0));
    if (round % 4 == 0)
    {
      // Round the point so that it is on a node, an edge or a facet.
      position = (4.0 * position).array().round() / 4.0;
    }
    const auto at = DisphenoidLattice::locate(position);
    const auto corners = tet_at(lattice, at.tet);
    Vec3 sum = Vec3::Zero();
    double ones = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      EXPECT_GE(at.coordinates[k], 0.0);
      sum += at.coordinates[k] * corners[k];
      ones += at.coordinates[k];
    }
    EXPECT_NEAR(ones, 1.0, 1e-15);
    EXPECT_LT((sum - lattice.world_point(position)).norm(), 1e-13);
    EXPECT_NEAR(tet_volume(corners[0], corners[1], corners[2], corners[3]), 1.0 / 12.0, 1e-14)
      << "twelve tets a cube, all positive";
    EXPECT_NEAR(min_dihedral_angle(corners[0], corners[1], corners[2], corners[3]), 60.0, 1e-9);
    const auto cube = DisphenoidLattice::cube_of(position);
    EXPECT_EQ(DisphenoidLattice::tet_of_half(cube, DisphenoidLattice::half_of(position)), at.tet);
  }
}

TEST(DisphenoidLattice, PiecesAreWhatATriangleGoesThrough)
{
  test::Random random(2);
  for (int round = 0; round < 50; ++round)
  {
    std::array<Vec3, 3> corners;
    for (Vec3& corner : corners)
    {
      corner = random.in_box(Vec3::Constant(2.0), Vec3::Constant(5.0));
    }
    std::set<Key> found;
    DisphenoidLattice::for_each_piece(corners,
      [&](const Vec3& middle, const Vec3& lower, const Vec3& upper)
      {
        found.insert(DisphenoidLattice::locate(middle).tet);
        EXPECT_TRUE((lower.array() <= middle.array() + 1e-12).all());
        EXPECT_TRUE((upper.array() >= middle.array() - 1e-12).all());
      });
    for (int sample = 0; sample < 500; ++sample)
    {
      double s = random.uniform(), r = random.uniform();
      s = s + r > 1.0 ? 1.0 - s : s;
      r = s + r > 1.0 ? 1.0 - s : r;
      const Vec3 position =
        corners[0] + s * (corners[1] - corners[0]) + r * (corners[2] - corners[0]);
      EXPECT_EQ(found.count(DisphenoidLattice::locate(position).tet), 1u);
    }
  }
}

TEST(DisphenoidLattice, NodesAreExactFarFromTheOrigin)
{
  Box box;
  box.add(Vec3::Constant(1e9));
  box.add(Vec3::Constant(1e9 + 1.0));
  const DisphenoidLattice lattice(box, DisphenoidLattice::minimum_spacing(1e9 + 1.0));
  const auto at = DisphenoidLattice::locate(lattice.lattice_position(Vec3::Constant(1e9 + 0.4)));
  const auto corners = tet_at(lattice, at.tet);
  const double cube = lattice.spacing() * lattice.spacing() * lattice.spacing();
  EXPECT_DOUBLE_EQ(tet_volume(corners[0], corners[1], corners[2], corners[3]), cube / 12.0);
}
