// Cotangent Laplacian, lumped mass and harmonic energies on triangles and tets.
#include "geometry/laplacian.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

using namespace bindpose;

namespace
{
/// Shear the mesh and move its vertices, so that no angle has a special value.
void disturb(Points& points)
{
  test::Random random(7);
  for (Index v = 0; v < points.rows(); ++v)
  {
    points.row(v) += 0.02 * random.in_box(-Vec3::Ones(), Vec3::Ones()).transpose();
  }
}
} // namespace

TEST(Laplacian, CotangentWeightsSumToMeasure)
{
  TriangleMesh surface = test::sphere(2);
  disturb(surface.points);
  const auto c3 = cotangent_weights(surface.points, surface.triangles);
  for (Index t = 0; t < surface.triangles.rows(); ++t)
  {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      const auto e = surface.points.row(surface.triangles(t, (k + 1) % 3)) -
        surface.points.row(surface.triangles(t, (k + 2) % 3));
      sum += c3(t, k) * e.squaredNorm();
    }
    const Triangles one = surface.triangles.row(t);
    EXPECT_NEAR(sum, 2.0 * surface_area(surface.points, one), 1e-12);
  }

  TetMesh tets = test::tet_box(3, 3, 3);
  disturb(tets.points);
  const auto c6 = cotangent_weights(tets.points, tets.tets);
  const Eigen::VectorXd volumes = tet_volumes(tets.points, tets.tets);
  for (Index t = 0; t < tets.tets.rows(); ++t)
  {
    double sum = 0.0;
    for (int k = 0; k < 6; ++k)
    {
      const auto e = tets.points.row(tets.tets(t, tet_edges[k][0])) -
        tets.points.row(tets.tets(t, tet_edges[k][1]));
      sum += c6(t, k) * e.squaredNorm();
    }
    EXPECT_NEAR(sum, 3.0 * volumes[t], 1e-12);
  }
}

TEST(Laplacian, LinearFunctionsAreHarmonicAndHaveTheirDirichletEnergy)
{
  TetMesh tets = test::tet_box(4, 3, 3);
  const SparseMatrix k = stiffness_matrix(tets.points, tets.tets);
  const Eigen::VectorXd f = tets.points * Vec3(1, 2, -3);
  EXPECT_NEAR(f.dot(k * f), 14.0, 1e-10); // squared gradient length 14, multiplied by the volume 1
  EXPECT_LT((k * Eigen::VectorXd::Ones(k.rows())).cwiseAbs().maxCoeff(), 1e-12);

  TriangleMesh plane = test::grid(5, 4);
  const SparseMatrix k2 = stiffness_matrix(plane.points, plane.triangles);
  const Eigen::VectorXd f2 = plane.points * Vec3(1, 2, 0);
  EXPECT_NEAR(f2.dot(k2 * f2), 5.0, 1e-12);
}

TEST(Laplacian, WithWhatFlowsOutNothingIsLeftOfALinearFunction)
{
  TetMesh tets = test::tet_box(4, 3, 3);
  disturb(tets.points);
  const Eigen::VectorXd f =
    tets.points * Vec3(1, 2, -3) + 4.0 * Eigen::VectorXd::Ones(tets.points.rows());
  const SparseMatrix k = stiffness_matrix(tets.points, tets.tets);
  EXPECT_GT((k * f).cwiseAbs().maxCoeff(), 0.01);
  EXPECT_LT((k * f - boundary_flux(tets.points, tets.tets) * f).cwiseAbs().maxCoeff(), 1e-13);

  TriangleMesh plane = test::grid(5, 4);
  disturb(plane.points);
  plane.points.col(2).setZero();
  const Eigen::VectorXd f2 = plane.points * Vec3(1, 2, 0);
  const SparseMatrix k2 = stiffness_matrix(plane.points, plane.triangles);
  EXPECT_GT((k2 * f2).cwiseAbs().maxCoeff(), 0.01);
  EXPECT_LT(
    (k2 * f2 - boundary_flux(plane.points, plane.triangles) * f2).cwiseAbs().maxCoeff(), 1e-13);

  const TriangleMesh closed = test::sphere(2);
  EXPECT_EQ(boundary_flux(closed.points, closed.triangles).nonZeros(), 0);
}

TEST(Laplacian, MassSumsToMeasure)
{
  TriangleMesh surface = test::torus(12, 9, 1.0, 0.4);
  disturb(surface.points);
  EXPECT_NEAR(lumped_mass(surface.points, surface.triangles).sum(),
    surface_area(surface.points, surface.triangles), 1e-12);
  EXPECT_GT(lumped_mass(surface.points, surface.triangles).minCoeff(), 0.0);
  const TetMesh tets = test::tet_box(2, 2, 2);
  EXPECT_NEAR(lumped_mass(tets.points, tets.tets).sum(), 1.0, 1e-13);
}

TEST(Laplacian, EnergyIsSymmetricAndSeesNoConstant)
{
  const TetMesh tets = test::tet_box(3, 2, 2);
  const SparseMatrix k = stiffness_matrix(tets.points, tets.tets);
  const Eigen::VectorXd m = lumped_mass(tets.points, tets.tets);
  for (int power = 1; power <= 3; ++power)
  {
    const SparseMatrix q = harmonic_energy(k, m, power);
    const double scale = Eigen::MatrixXd(q).cwiseAbs().maxCoeff();
    EXPECT_LT(
      (Eigen::MatrixXd(q) - Eigen::MatrixXd(q).transpose()).cwiseAbs().maxCoeff(), 1e-13 * scale);
    EXPECT_LT((q * Eigen::VectorXd::Ones(q.rows())).cwiseAbs().maxCoeff(), 1e-11 * scale);
  }
}

TEST(Laplacian, DegenerateElementsAreSilent)
{
  TriangleMesh mesh = test::cube();
  mesh.triangles.row(3) << 2, 2, 5;
  EXPECT_TRUE(cotangent_weights(mesh.points, mesh.triangles).allFinite());
  EXPECT_TRUE(lumped_mass(mesh.points, mesh.triangles).allFinite());
  TetMesh tets = test::tet_box(1, 1, 1);
  tets.tets.row(2) << 0, 1, 1, 3;
  EXPECT_TRUE(cotangent_weights(tets.points, tets.tets).allFinite());
}
