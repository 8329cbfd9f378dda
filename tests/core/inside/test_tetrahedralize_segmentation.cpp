// Method cdt: the tets of the convex hull are labeled as inside or outside, by a graph cut or by
// the threshold.
#include "inside/tetrahedralize.h"

#include "tets/tet_quality.h"

#include "core/inside/tet_outcome.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

using namespace bindpose;
using test::Cdt;
using test::run;
using Outcome = test::TetOutcome;

namespace
{
/// Remove every fifth triangle of a surface.
TriangleMesh with_missing_triangles(TriangleMesh mesh)
{
  Index kept = 0;
  for (Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    if (t % 5 != 0)
    {
      mesh.triangles.row(kept++) = mesh.triangles.row(t).eval();
    }
  }
  mesh.triangles.conservativeResize(kept, 3);
  return mesh;
}
} // namespace

TEST_F(Cdt, AnOpenSurfaceIsCutWithLessEnergy)
{
  const TriangleMesh closed = test::sphere(3);
  const TriangleMesh mesh = with_missing_triangles(closed);
  TetrahedralizeOptions options;
  options.method = TetMethod::cdt;
  const Outcome cut = run(mesh, options);
  ASSERT_TRUE(cut.status.ok()) << cut.status.message;
  EXPECT_EQ(cut.status.report.text("segmentation"), "graph-cut");
  EXPECT_GT(cut.number("counts.changed_by_cut"), 0.0);
  EXPECT_LT(cut.number("energy"), cut.number("threshold_energy"));
  EXPECT_TRUE(check_tets(cut.result.mesh.points, cut.result.mesh.tets).ok());
  const double whole = signed_volume(closed.points, closed.triangles);
  EXPECT_NEAR(cut.volume(), whole, 0.02 * whole);

  options.segmentation = SegmentationMethod::threshold;
  const Outcome plain = run(mesh, options);
  ASSERT_TRUE(plain.status.ok()) << plain.status.message;
  EXPECT_EQ(plain.status.report.text("segmentation"), "threshold");
  EXPECT_EQ(plain.status.report.find("energy"), nullptr);
  // At holes of the surface, the graph cut gives a straight boundary, and the method
  // `threshold` gives a ragged one. The boundary of the graph cut therefore has the smaller area.
  const auto skin = [](const Outcome& outcome) {
    return surface_area(outcome.result.mesh.points, boundary_triangles(outcome.result.mesh.tets));
  };
  EXPECT_LT(skin(cut), skin(plain));
}

TEST_F(Cdt, TheWholeHullCanBeKept)
{
  // Two boxes with a gap between them. The gap is a fifth of their convex hull.
  const TriangleMesh closed =
    test::join(test::cube(0.0, 1.0), test::translated(test::cube(0.0, 1.0), Vec3(1.5, 0, 0)));
  TriangleMesh open = closed;
  open.triangles.conservativeResize(open.triangles.rows() - 2, 3);
  for (const TriangleMesh& mesh : { closed, open })
  {
    TetrahedralizeOptions options;
    options.method = TetMethod::cdt;
    const Outcome kept = run(mesh, options);
    ASSERT_TRUE(kept.status.ok()) << kept.status.message;
    options.keep_outside = true;
    const Outcome outcome = run(mesh, options);
    ASSERT_TRUE(outcome.status.ok()) << outcome.status.message;
    const TetrahedralizeResult& result = outcome.result;
    EXPECT_NEAR(outcome.volume(), 2.5, 1e-9) << "the hull";
    const Eigen::VectorXd volumes = tet_volumes(result.mesh.points, result.mesh.tets);
    ASSERT_EQ(static_cast<Index>(result.labels.size()), volumes.size());
    double inside = 0.0;
    Index count = 0;
    for (Index t = 0; t < volumes.size(); ++t)
    {
      const bool above = result.winding_numbers[t] >= options.winding_threshold;
      const int label = static_cast<int>(result.labels[t]);
      EXPECT_EQ(above, label == 1 || label == -1) << t;
      inside += label > 0 ? volumes[t] : 0.0;
      count += label > 0;
    }
    EXPECT_NEAR(inside, kept.volume(), 1e-9) << "what is inside is what is kept else";
    EXPECT_NEAR(outcome.number("volume"), inside, 1e-12);
    EXPECT_EQ(outcome.number("counts.tets_inside"), count);
    EXPECT_EQ(outcome.number("counts.tets"), volumes.size());
    // No vertex is added: all points are corners of the boxes.
    EXPECT_EQ(result.mesh.points.rows(), mesh.points.rows());
  }
  TetrahedralizeOptions options;
  options.keep_outside = true;
  EXPECT_EQ(run(closed, options).status.code, StatusCode::invalid_input);
}

TEST_F(Cdt, ACutThatLosesTheVolumeIsLeftForTheThreshold)
{
  const TriangleMesh mesh = with_missing_triangles(test::torus(40, 20, 1.0, 0.4));
  TetrahedralizeOptions options;
  options.method = TetMethod::cdt;
  options.segmentation = SegmentationMethod::threshold;
  const Outcome plain = run(mesh, options);
  ASSERT_TRUE(plain.status.ok()) << plain.status.message;
  options.segmentation = SegmentationMethod::graph_cut;
  // With such a large smoothness, the graph cut labels all tets of the hull as inside, or all as
  // outside.
  options.cut_smoothness = 1e6;
  options.cut_sigma = 10.0;
  const Outcome smooth = run(mesh, options);
  ASSERT_TRUE(smooth.status.ok()) << smooth.status.message;
  EXPECT_EQ(smooth.status.report.text("segmentation"), "threshold");
  EXPECT_EQ(smooth.volume(), plain.volume());
}

TEST_F(Cdt, AClosedSurfaceNeedsNoCut)
{
  const Outcome outcome = run(test::sphere(2), TetMethod::cdt);
  ASSERT_TRUE(outcome.status.ok()) << outcome.status.message;
  EXPECT_EQ(outcome.status.report.text("segmentation"), "threshold");
  EXPECT_EQ(outcome.status.report.find("counts.changed_by_cut"), nullptr);
}
