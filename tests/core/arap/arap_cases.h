#ifndef bindpose_tests_core_arap_arap_cases_h
#define bindpose_tests_core_arap_arap_cases_h

// Poses and checks that the tests of reduced as-rigid-as-possible (ARAP) deformation share.

#include "arap/reduced_arap.h"
#include "support/affines.h"
#include "support/bars.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

namespace bindpose::test
{

inline Pose posed(const Handles& handles, HandleMode mode, const Affine& t = identity_affine())
{
  Pose pose(handles.size());
  for (HandlePose& handle : pose)
  {
    handle.mode = mode;
    handle.transform = t;
  }
  return pose;
}

/// Return options for iterations in double precision without acceleration. The iterations start
/// from the rest shape.
constexpr ReducedArap::SolveOptions iterations_from_rest(Index count)
{
  return { 0.0, count, ReducedArap::Start::rest, 0, 0.0, false };
}

/// Return options for accelerated iterations in double precision. The iterations start from
/// rotations that depend on the pose only (Start::guess).
constexpr ReducedArap::SolveOptions iterations(Index count)
{
  return { 0.0, count, ReducedArap::Start::guess, 5, 0.0, false };
}

/// Return a pose that bends a bar: the left end is fixed, the right end rotates and moves, the
/// middle handle has the given mode.
inline Pose bend(HandleMode middle)
{
  Pose pose(3);
  pose[1].mode = middle;
  pose[1].transform.col(3) << 0.0, 0.3, 0.0;
  pose[2].transform = affine_about(
    Vec3(4, 0.5, 0.5), rigid(70, Vec3(0, 0, 1), Vec3::Zero()).leftCols<3>(), Vec3(-1, 1.5, 0));
  return pose;
}

/// Expect that extra weights keep the rest shape, do not move handles, and lower the energy. Return
/// the status of the bind.
inline Status expect_that_extra_weights_help(ExtraWeights kind)
{
  const Rig rig = bar();
  ExecutionContext context;
  ReducedArap plain, wide;
  ReducedArapOptions options{ ArapEnergy::elements, rig.mesh.tets.rows() };
  EXPECT_TRUE(
    plain.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles, options).ok());
  options.extra_weights = 15;
  options.extra_kind = kind;
  const Status bound =
    wide.bind(context, rig.mesh.points, rig.mesh.tets, rig.weights, rig.handles, options);
  if (!bound.ok())
  {
    ADD_FAILURE() << bound.message;
    return bound;
  }
  Points result;
  EXPECT_TRUE(wide.solve(context, posed(rig.handles, HandleMode::full)).ok());
  EXPECT_TRUE(wide.deform(context, rig.mesh.points, result).ok());
  EXPECT_LT((result - rig.mesh.points).cwiseAbs().maxCoeff(), 1e-12);
  for (const HandleMode middle : { HandleMode::full, HandleMode::position, HandleMode::free })
  {
    EXPECT_TRUE(plain.solve(context, bend(middle), iterations(300)).ok());
    EXPECT_TRUE(wide.solve(context, bend(middle), iterations(300)).ok());
    EXPECT_LT(wide.energies().back(), plain.energies().back());
    // The left end is fixed. The extra weights are zero there, so its vertices must not move.
    EXPECT_TRUE(wide.deform(context, rig.mesh.points, result).ok());
    for (Index v = 0; v < rig.mesh.points.rows(); ++v)
    {
      if (rig.weights(v, 0) > 1.0 - 1e-13)
      {
        EXPECT_LT((result.row(v) - rig.mesh.points.row(v)).norm(), 1e-10);
      }
    }
  }
  return bound;
}

} // namespace bindpose::test

#endif
