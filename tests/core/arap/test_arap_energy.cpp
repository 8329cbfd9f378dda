// As-rigid-as-possible (ARAP) energies of deformations with known values, for triangles and tets.
#include "arap/arap_energy.h"

#include "pose/rotation_fit.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <numeric>

using namespace bindpose;

namespace
{
template <typename Mesh>
std::vector<Index> own_labels(const Mesh& mesh)
{
  std::vector<Index> labels(static_cast<std::size_t>(mesh.points.rows()));
  std::iota(labels.begin(), labels.end(), Index(0));
  return labels;
}

const Triangles& elements_of(const TriangleMesh& mesh)
{
  return mesh.triangles;
}
const Tets& elements_of(const TetMesh& mesh)
{
  return mesh.tets;
}

/// Return the energy of an affine map with optimal rotations.
template <typename Mesh>
double energy_of(const Mesh& mesh, ArapEnergy energy, const Eigen::Matrix3d& map)
{
  const RotationGroups groups =
    rotation_groups(energy, elements_of(mesh), mesh.points.rows(), own_labels(mesh));
  const Points posed = mesh.points * map.transpose();
  const Eigen::MatrixXd s = covariance_matrix(mesh.points, elements_of(mesh), groups) * posed;
  std::vector<Eigen::Matrix3d> rotations(
    static_cast<std::size_t>(groups.count), Eigen::Matrix3d::Identity());
  for (Index k = 0; k < groups.count; ++k)
  {
    Eigen::Matrix3d covariance;
    covariance << s.row(k), s.row(groups.count + k), s.row(2 * groups.count + k);
    fit_rotation(covariance, rotations[static_cast<std::size_t>(k)]);
  }
  return arap_energy(mesh.points, elements_of(mesh), groups, posed, rotations);
}
} // namespace

// The energy of an affine map is half the integral of the squared distance between the map and its
// optimal rotation.
TEST(ArapEnergy, AffineMapsCostHalfTheIntegralOfTheDifferenceToTheirRotation)
{
  TriangleMesh square = test::grid(5, 4);
  TetMesh cube = test::tet_box(3, 2, 2);
  test::Random random(3);
  // Move the inner vertices, so that angles have no special values and cotangents have both signs.
  for (Index v = 0; v < square.points.rows(); ++v)
  {
    const Vec3 p = square.points.row(v);
    if (p.x() > 0 && p.x() < 1 && p.y() > 0 && p.y() < 1)
    {
      square.points.row(v) += random.in_box(Vec3(-0.06, -0.06, 0), Vec3(0.06, 0.06, 0)).transpose();
    }
  }
  const Eigen::Matrix3d turn =
    Eigen::AngleAxisd(2.0, Vec3(1, -2, 3).normalized()).toRotationMatrix();
  for (const ArapEnergy energy : { ArapEnergy::spokes_and_rims, ArapEnergy::elements })
  {
    EXPECT_NEAR(energy_of(square, energy, turn * 2.0), 1.0, 1e-12);
    EXPECT_NEAR(
      energy_of(square, energy, turn * Vec3(1.5, 1, 1).asDiagonal().toDenseMatrix()), 0.125, 1e-12);
    EXPECT_NEAR(energy_of(cube, energy, turn * 2.0), 1.5, 1e-12);
    EXPECT_NEAR(
      energy_of(cube, energy, turn * Vec3(1.5, 1, 1).asDiagonal().toDenseMatrix()), 0.125, 1e-12);
    EXPECT_LT(energy_of(square, energy, turn), 1e-25);
    EXPECT_LT(energy_of(cube, energy, turn), 1e-25);
  }
}

TEST(ArapEnergy, SpokesCostTheSameForACommonRotationAndForSimilarities)
{
  const TriangleMesh ball = test::sphere(2), square = test::grid(5, 4);
  const TetMesh cube = test::tet_box(3, 2, 2);
  const Eigen::Matrix3d turn =
    Eigen::AngleAxisd(2.0, Vec3(1, -2, 3).normalized()).toRotationMatrix();
  const double area = surface_area(ball.points, ball.triangles);
  Index ignored_edges = -1;
  arap_stiffness(ball.points, ball.triangles, ArapEnergy::spokes, &ignored_edges);
  EXPECT_EQ(ignored_edges, 0);
  for (const double scale : { 0.0, 0.5, 2.0 })
  {
    const double cost = (scale - 1.0) * (scale - 1.0);
    EXPECT_NEAR(energy_of(ball, ArapEnergy::spokes, turn * scale), area * cost, 1e-12 * area);
    EXPECT_NEAR(energy_of(square, ArapEnergy::spokes, turn * scale), cost, 1e-12);
    EXPECT_NEAR(energy_of(cube, ArapEnergy::spokes, turn * scale), 1.5 * cost, 1e-12);
  }
  const Eigen::Matrix3d stretch = turn * Vec3(1.5, 1, 1).asDiagonal();
  EXPECT_NEAR(energy_of(square, ArapEnergy::spokes, stretch), 0.125, 1e-12);
  EXPECT_NEAR(energy_of(cube, ArapEnergy::spokes, stretch), 0.125, 1e-12);
  // Compute the energy of an affine map when all groups have the same rotation. One optimal
  // rotation per group gives at most this energy.
  Eigen::Matrix3d map;
  map << 1.5, 0.2, 0.1, -0.3, 0.8, 0.4, 0.2, 0.1, 1.1;
  const RotationGroups groups =
    rotation_groups(ArapEnergy::spokes, cube.tets, cube.points.rows(), own_labels(cube));
  const Points posed = cube.points * map.transpose();
  const std::vector<Eigen::Matrix3d> common(static_cast<std::size_t>(cube.points.rows()), turn);
  EXPECT_NEAR(arap_energy(cube.points, cube.tets, groups, posed, common),
    0.5 * (map - turn).squaredNorm(), 1e-12);
  EXPECT_LE(
    energy_of(cube, ArapEnergy::spokes, map), energy_of(cube, ArapEnergy::elements, map) + 1e-12);
}

TEST(ArapEnergy, SpokesLeaveOutEdgesOfNegativeWeight)
{
  // Two flat triangles share an edge, and both angles opposite to the edge are obtuse.
  TriangleMesh kite;
  kite.points.resize(4, 3);
  kite.points << -1, 0, 0, 1, 0, 0, 0, 0.2, 0, 0, -0.2, 0;
  kite.triangles.resize(2, 3);
  kite.triangles << 0, 1, 2, 1, 0, 3;
  Index ignored_edges = -1;
  const SparseMatrix l =
    arap_stiffness(kite.points, kite.triangles, ArapEnergy::spokes, &ignored_edges);
  EXPECT_EQ(ignored_edges, 1);
  EXPECT_EQ(l.coeff(0, 1), 0.0);
  EXPECT_LT((l * Eigen::VectorXd::Ones(4)).norm(), 1e-15);
  EXPECT_FALSE(ignored_edges_warning(ignored_edges).empty());
  EXPECT_TRUE(ignored_edges_warning(0).empty());
  arap_stiffness(kite.points, kite.triangles, ArapEnergy::spokes_and_rims, &ignored_edges);
  EXPECT_EQ(ignored_edges, 0);
  // The rest shape has the energy 0, which is the minimum.
  EXPECT_LT(std::abs(energy_of(kite, ArapEnergy::spokes, Eigen::Matrix3d::Identity())), 1e-28);
}

TEST(ArapEnergy, CovariancesAreTheSumOverEdges)
{
  const TetMesh mesh = test::tet_box(2, 1, 1);
  std::vector<Index> labels(static_cast<std::size_t>(mesh.points.rows()));
  for (std::size_t v = 0; v < labels.size(); ++v)
  {
    labels[v] = static_cast<Index>(v % 3);
  }
  test::Random random(5);
  Points posed = mesh.points;
  for (Index v = 0; v < posed.rows(); ++v)
  {
    posed.row(v) += random.in_box(-Vec3::Ones(), Vec3::Ones()).transpose();
  }
  const auto c = cotangent_weights(mesh.points, mesh.tets);
  for (const ArapEnergy energy :
    { ArapEnergy::spokes_and_rims, ArapEnergy::elements, ArapEnergy::spokes })
  {
    const RotationGroups groups = rotation_groups(energy, mesh.tets, 3, labels);
    std::vector<Eigen::Matrix3d> sums(3, Eigen::Matrix3d::Zero());
    for (Index e = 0; e < mesh.tets.rows(); ++e)
    {
      for (int k = 0; k < 6; ++k)
      {
        const Index i = mesh.tets(e, tet_edges[k][0]), j = mesh.tets(e, tet_edges[k][1]);
        const Eigen::Matrix3d covariance = c(e, k) *
          (mesh.points.row(i) - mesh.points.row(j)).transpose() * (posed.row(i) - posed.row(j));
        for (int corner = 0; corner < 4; ++corner)
        {
          if (energy == ArapEnergy::spokes_and_rims)
          {
            sums[static_cast<std::size_t>(mesh.tets(e, corner) % 3)] += 0.25 * covariance;
          }
        }
        if (energy == ArapEnergy::spokes)
        {
          sums[static_cast<std::size_t>(i % 3)] += 0.5 * covariance;
          sums[static_cast<std::size_t>(j % 3)] += 0.5 * covariance;
        }
        if (energy == ArapEnergy::elements)
        {
          sums[static_cast<std::size_t>(groups.group_of_element[static_cast<std::size_t>(e)])] +=
            covariance;
        }
      }
    }
    const Eigen::MatrixXd s = covariance_matrix(mesh.points, mesh.tets, groups) * posed;
    for (Index k = 0; k < groups.count; ++k)
    {
      for (Index i = 0; i < 3; ++i)
      {
        EXPECT_LT((s.row(i * groups.count + k) - sums[static_cast<std::size_t>(k)].row(i))
                    .cwiseAbs()
                    .maxCoeff(),
          1e-13);
      }
    }
  }
}

TEST(ArapEnergy, ElementsTakeTheLabelOfMostVertices)
{
  Tets tets(3, 4);
  tets << 0, 1, 2, 3, 2, 3, 4, 5, 4, 5, 6, 7;
  const RotationGroups groups =
    rotation_groups(ArapEnergy::elements, tets, 4, { 3, 3, 1, 3, 1, 0, 0, 0 });
  // Each element takes the most frequent label of its vertices. The vertices of the three elements
  // have the labels 3 3 1 3, 1 3 1 0 and 1 0 0 0, so the elements take the labels 3, 1 and 0.
  // Groups are numbered in the order of their first appearance.
  EXPECT_EQ(groups.group_of_element, (std::vector<Index>{ 0, 1, 2 }));
  EXPECT_EQ(groups.count, 3);
  // A vertex takes the group of most of its elements, and the lowest group if two are equally
  // frequent.
  EXPECT_EQ(groups.group_of_vertex, (std::vector<Index>{ 0, 0, 0, 0, 1, 1, 2, 2 }));
  EXPECT_STREQ(to_string(ArapEnergy::elements, true), "tetrahedra");
  EXPECT_STREQ(to_string(ArapEnergy::elements, false), "triangles");
  EXPECT_STREQ(to_string(ArapEnergy::spokes_and_rims, true), "spokes_and_rims");
  EXPECT_STREQ(to_string(ArapEnergy::spokes, false), "spokes");
  EXPECT_STREQ(to_string(ArapEnergy::automatic, true), "tetrahedra");
  EXPECT_STREQ(to_string(ArapEnergy::automatic, false), "spokes_and_rims");
}
