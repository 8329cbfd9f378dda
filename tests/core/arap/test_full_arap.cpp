// Full as-rigid-as-possible deformation: equality with the reduced method if every vertex is a
// handle, rigid motions, and properties of the energy.
#include "arap/full_arap.h"

#include "core/arap/arap_cases.h"
#include "core/arap/full_arap_cases.h"

#include <gtest/gtest.h>

using namespace bindpose;
using namespace bindpose::test;

namespace
{
/// Return the gradient of the energy with optimal rotations, #V x 3.
template <typename Elements>
Eigen::MatrixXd gradient(const Points& rest, const Elements& elements, const FullArap& arap)
{
  const Index r = arap.groups().count;
  const std::vector<Eigen::Matrix3d> rotations = arap.rotations();
  Eigen::MatrixXd stacked(3 * r, 3);
  for (Index k = 0; k < r; ++k)
  {
    for (Index i = 0; i < 3; ++i)
    {
      stacked.row(i * r + k) = rotations[k].col(i).transpose();
    }
  }
  const SparseMatrix l = arap_stiffness(rest, elements, arap.groups().energy);
  const SparseMatrix k = covariance_matrix(rest, elements, arap.groups());
  return l * arap.posed() - k.transpose() * stacked;
}
} // namespace

// With one handle per vertex, the reduced method has the same iterates as the full method.
TEST(FullArap, IsTheReducedMethodInTheWholeSpaceIterateByIterate)
{
  TetMesh mesh = test::tet_box(2, 2, 2);
  test::Random random(3);
  Handles handles;
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    mesh.points.row(v) += random.in_box(Vec3::Constant(-0.1), Vec3::Constant(0.1)).transpose();
    handles.push_back(point_handle("v" + std::to_string(v), mesh.points.row(v)));
  }
  const Index n = mesh.points.rows();
  const Triangles skin = boundary_triangles(mesh.tets);
  Pose pose = posed(handles, HandleMode::free);
  for (const Index v : { 0, 1, 2, 25, 26 })
  {
    pose[v].mode = HandleMode::position;
    pose[v].transform = v < 3 ? identity_affine() : rigid(50, Vec3(1, 1, 0), Vec3(0.4, 0, 0.3));
  }
  ExecutionContext context;
  for (const ArapEnergy energy : every_energy)
  {
    for (const bool surface : { false, true })
    {
      ReducedArap reduced;
      FullArap full;
      const Weights unit = Weights::Identity(n, n);
      const ReducedArapOptions options{ energy, 4 * n, 0 };
      if (surface)
      {
        ASSERT_TRUE(reduced.bind(context, mesh.points, skin, unit, handles, options).ok());
        // Binding the surface must ignore the inner vertex, which belongs to no triangle.
        ASSERT_TRUE(full.bind(context, mesh.points, skin, handles, { energy, {} }).usable());
      }
      else
      {
        ASSERT_TRUE(reduced.bind(context, mesh.points, mesh.tets, unit, handles, options).ok());
        ASSERT_TRUE(full.bind(context, mesh.points, mesh.tets, handles, { energy, {} }).ok());
      }
      ASSERT_EQ(full.groups().count, reduced.groups().count);
      for (const Index count : { 0, 1, 2, 5, 20 })
      {
        reduced.solve(context, pose, iterations_from_rest(count));
        Points result;
        ASSERT_TRUE(reduced.deform(context, mesh.points, result).ok());
        ASSERT_TRUE(full.solve(context, pose, plain(count, FullArap::Start::rest)).ok());
        EXPECT_LT((full.posed() - result).cwiseAbs().maxCoeff(), 1e-10) << count;
        ASSERT_EQ(full.energies().size(), reduced.energies().size());
        for (std::size_t i = 0; i < full.energies().size(); ++i)
        {
          EXPECT_NEAR(full.energies()[i], reduced.energies()[i], 1e-12 * full.rest_energy());
        }
      }
    }
  }
}

// If all handles move by one rigid motion, the mesh moves rigidly.
TEST(FullArap, RigidHandlesMoveTheMeshRigidly)
{
  const LabeledBar bar = labeled_bar(6);
  const TriangleMesh ball = test::sphere(3);
  Handles poles;
  for (const Index v : { 0, 1, 2, 3 }) // four of the 12 vertices of the icosahedron
  {
    poles.push_back(point_handle("p" + std::to_string(v), ball.points.row(v)));
  }
  ExecutionContext context;
  for (const ArapEnergy energy : every_energy)
  {
    FullArap arap, skin;
    ASSERT_TRUE(bind(arap, bar, energy).usable());
    ASSERT_TRUE(skin.bind(context, ball.points, ball.triangles, poles, { energy, {} }).ok());
    for (const double degrees : { 0.0, 10.0, 90.0, 180.0 })
    {
      const Affine t = rigid(degrees, Vec3(1, 2, 3), Vec3(5, -2, 1));
      arap.discard_rotations();
      ASSERT_TRUE(arap.solve(context, posed(bar.handles, HandleMode::full, t)).ok());
      EXPECT_LT((arap.posed() - moved(bar.mesh.points, t)).cwiseAbs().maxCoeff(), 1e-9);
      for (const HandleMode mode : { HandleMode::full, HandleMode::position })
      {
        skin.discard_rotations();
        ASSERT_TRUE(skin.solve(context, posed(poles, mode, t)).ok());
        EXPECT_LT((skin.posed() - moved(ball.points, t)).cwiseAbs().maxCoeff(), 1e-9)
          << degrees << to_string(energy, false);
        EXPECT_LT(std::abs(arap_energy(
                    ball.points, ball.triangles, skin.groups(), skin.posed(), skin.rotations())),
          1e-20);
      }
    }
  }
}

// Neither a local nor a global step raises the energy. The last reported energy equals the energy
// that is computed as a sum over the edges.
TEST(FullArap, NoHalfStepRaisesTheEnergyAndTheLastIsTheEdgeSum)
{
  const LabeledBar bar = labeled_bar(6);
  ExecutionContext context;
  for (const ArapEnergy energy : every_energy)
  {
    FullArap arap;
    ASSERT_TRUE(bind(arap, bar, energy).usable());
    for (const HandleMode middle : { HandleMode::position, HandleMode::free, HandleMode::full })
    {
      for (const Index window : { 0, 5 })
      {
        FullArap::SolveOptions options = plain(60, FullArap::Start::rest);
        options.anderson_window = window;
        ASSERT_TRUE(arap.solve(context, bend(middle), options).ok());
        const std::vector<double>& e = arap.energies();
        ASSERT_EQ(e.size(), 121u);
        for (std::size_t i = 1; i < e.size(); ++i)
        {
          ASSERT_LE(e[i], e[i - 1] + 1e-12 * arap.rest_energy()) << i;
        }
        const double sum = arap_energy(
          bar.mesh.points, bar.mesh.tets, arap.groups(), arap.posed(), arap.rotations());
        EXPECT_NEAR(e.back(), sum, 1e-12 * arap.rest_energy());
      }
    }
  }
}

TEST(FullArap, AtTheEndNoFreeVertexIsPulled)
{
  const LabeledBar bar = labeled_bar(6);
  ExecutionContext context;
  for (const ArapEnergy energy : every_energy)
  {
    FullArap arap;
    ASSERT_TRUE(bind(arap, bar, energy).usable());
    FullArap::SolveOptions options;
    options.tolerance = 0.0;
    options.max_iterations = 600;
    ASSERT_TRUE(arap.solve(context, bend(HandleMode::free), options).ok());
    // Perform one more iteration, which makes the rotations optimal for these points.
    const Points last = arap.posed();
    options.max_iterations = 1;
    options.anderson_window = 0;
    ASSERT_TRUE(arap.solve(context, bend(HandleMode::free), options).ok());
    EXPECT_LT((arap.posed() - last).cwiseAbs().maxCoeff(), 1e-9);
    const Eigen::MatrixXd pull = gradient(bar.mesh.points, bar.mesh.tets, arap);
    for (Index v = 0; v < pull.rows(); ++v)
    {
      if (bar.labels[v] != 1 && bar.labels[v] != 3)
      {
        EXPECT_LT(pull.row(v).norm(), 1e-9);
      }
    }
  }
}

TEST(FullArap, AccelerationReachesTheSameEnergyInFewerIterations)
{
  const LabeledBar bar = labeled_bar(12);
  ExecutionContext context;
  for (const ArapEnergy energy : every_energy)
  {
    FullArap arap;
    ASSERT_TRUE(bind(arap, bar, energy).usable());
    const auto run = [&](Index window, Index count)
    {
      FullArap::SolveOptions options = plain(count, FullArap::Start::rest);
      options.anderson_window = window;
      EXPECT_TRUE(arap.solve(context, bend(HandleMode::free), options).ok());
      return arap.energies();
    };
    const std::vector<double> plain_energies = run(0, 2000), fast = run(5, 400);
    const double least = std::min(plain_energies.back(), fast.back());
    const auto needed = [&](const std::vector<double>& e)
    {
      std::size_t i = 0;
      while (i < e.size() && e[i] > least * (1.0 + 1e-6))
      {
        ++i;
      }
      return i / 2;
    };
    const std::size_t slow = needed(plain_energies), quick = needed(fast);
    RecordProperty(to_string(energy, true),
      std::to_string(slow) + " plain iterations, " + std::to_string(quick) + " accelerated");
    EXPECT_LT(2 * quick, slow);
    EXPECT_NEAR(fast.back(), plain_energies.back(), 1e-6 * least);
    // With acceleration, the energy is never higher than after the same number of plain iterations.
    for (std::size_t i = 0; i < fast.size(); i += 2)
    {
      EXPECT_LE(fast[i], plain_energies[i] + 1e-12 * arap.rest_energy()) << i;
    }
  }
}

// The reduced method has fewer degrees of freedom, so its energy is not lower.
TEST(FullArap, CostsNoMoreThanTheReducedMethodWithTheSameHandles)
{
  const test::Rig rig = test::bar();
  const LabeledBar bar = labeled_bar(8);
  ExecutionContext context;
  ReducedArap reduced;
  ASSERT_TRUE(reduced
                .bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles,
                  { ArapEnergy::elements, rig.mesh.tets.rows() * 4, 0 })
                .ok());
  FullArap full;
  ASSERT_TRUE(full
                .bind(context, bar.mesh.points, bar.mesh.tets, bar.handles,
                  { ArapEnergy::elements, bar.labels })
                .ok());
  ASSERT_TRUE(reduced.solve(context, bend(HandleMode::full), iterations(500)).ok());
  ASSERT_TRUE(full.solve(context, bend(HandleMode::full), plain(500, FullArap::Start::guess)).ok());
  EXPECT_LT(full.energies().back(), 0.99 * reduced.energies().back());
}
