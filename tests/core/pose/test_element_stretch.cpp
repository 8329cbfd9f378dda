// Stretches of elements (singular values of the deformation gradient), compared with known
// gradients and with singular values from Eigen.
#include "pose/element_stretch.h"

#include "support/affines.h"
#include "support/meshes.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include <gtest/gtest.h>

#include <cmath>

using namespace bindpose;
using test::rotation;

namespace
{
/// Return the points after a linear map and a translation.
Points mapped(const Points& points, const Eigen::Matrix3d& linear, const Vec3& by = Vec3::Zero())
{
  return test::moved(points, test::affine(linear, by));
}

template <typename Elements>
Status measure_stretch(const Points& rest, const Points& posed, const Elements& elements,
  ElementStretch& stretch, double limit = 2.0, int threads = 0)
{
  ExecutionContext context;
  context.set_threads(threads);
  ElementStretchOptions options;
  options.limit = limit;
  options.values = true;
  return element_stretch(context, options, rest, posed, MatrixView<Elements>(elements), stretch);
}

template <typename Elements>
Report report_of(
  const Points& rest, const Points& posed, const Elements& elements, double limit = 2.0)
{
  ElementStretch stretch;
  const Status status = measure_stretch(rest, posed, elements, stretch, limit);
  EXPECT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(status.warnings.empty(), status.report.number("counts.inverted_elements", -1) == 0);
  return status.report;
}

Points perturbed(Points points, double by, bool flat = false)
{
  test::Random random(3);
  for (Index v = 0; v < points.rows(); ++v)
  {
    Vec3 move = random.in_box(Vec3::Constant(-by), Vec3::Constant(by));
    move[2] *= flat ? 0.0 : 1.0;
    points.row(v) += move.transpose();
  }
  return points;
}
} // namespace

TEST(ElementStretch, RigidMotionsStretchNothing)
{
  const Eigen::Matrix3d turn = rotation(77, Vec3(1, -2, 0.5));
  const TetMesh box = test::tet_box(5, 4, 3);
  const TriangleMesh ball = test::sphere(3);
  const Report of_tets = report_of(box.points, mapped(box.points, turn, Vec3(3, 1, 7)), box.tets);
  const Report of_triangles =
    report_of(ball.points, mapped(ball.points, turn, Vec3(3, 1, 7)), ball.triangles);
  for (const Report& report : { of_tets, of_triangles })
  {
    EXPECT_EQ(report.number("counts.inverted_elements", -1), 0);
    EXPECT_EQ(report.number("counts.stretched_elements", -1), 0);
    EXPECT_NEAR(report.number("largest_stretch", 0), 1.0, 1e-13);
    EXPECT_NEAR(report.number("smallest_stretch", 0), 1.0, 1e-13);
    EXPECT_EQ(report.find("counts.degenerate_elements"), nullptr);
  }
  EXPECT_EQ(of_tets.number("counts.elements", 0), 360);
  EXPECT_EQ(of_triangles.number("counts.elements", 0), 1280);
}

TEST(ElementStretch, AffineMapsHaveTheirSingularValuesEverywhere)
{
  const TetMesh box = test::tet_box(3, 3, 3);
  const Eigen::Matrix3d stretch =
    rotation(30, Vec3(1, 1, 0)) * Vec3(3.0, 0.8, 0.25).asDiagonal() * rotation(-50, Vec3(0, 1, 2));
  const Report report = report_of(box.points, mapped(box.points, stretch), box.tets);
  EXPECT_NEAR(report.number("largest_stretch", 0), 3.0, 1e-12);
  EXPECT_NEAR(report.number("smallest_stretch", 0), 0.25, 1e-12);
  EXPECT_EQ(report.number("counts.stretched_elements", 0), box.tets.rows());
  EXPECT_EQ(report.number("counts.inverted_elements", -1), 0);
  // The square is in the plane z = 0, so only the first two columns of the map matter.
  const TriangleMesh square = test::grid(4, 4);
  const Eigen::Matrix3d in_plane = Vec3(1.5, 0.75, 9.0).asDiagonal();
  const Report flat = report_of(
    square.points, mapped(square.points, rotation(40, Vec3(1, 0, 1)) * in_plane), square.triangles);
  EXPECT_NEAR(flat.number("largest_stretch", 0), 1.5, 1e-13);
  EXPECT_NEAR(flat.number("smallest_stretch", 0), 0.75, 1e-13);
  EXPECT_EQ(flat.number("counts.stretched_elements", -1), 0);
}

TEST(ElementStretch, TheLimitSaysWhatIsStretched)
{
  const TetMesh box = test::tet_box(2, 2, 2);
  const auto stretched = [&](double factor, double limit)
  {
    return report_of(box.points, Points(factor * box.points), box.tets, limit)
      .number("counts.stretched_elements", -1);
  };
  EXPECT_EQ(stretched(1.999, 2.0), 0);
  EXPECT_EQ(stretched(2.001, 2.0), 48);
  EXPECT_EQ(stretched(0.501, 2.0), 0);
  EXPECT_EQ(stretched(0.499, 2.0), 48);
  EXPECT_EQ(stretched(2.001, 3.0), 0);
  EXPECT_EQ(stretched(0.334, 3.0), 0);
  EXPECT_EQ(stretched(0.332, 3.0), 48);
}

TEST(ElementStretch, OneReflectedTetIsFoundAndNamed)
{
  // Two tets share a triangle. The apex of the second tet moves through this triangle.
  Points rest(5, 3);
  rest << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, -1, 0, 0, 1;
  Tets tets(2, 4);
  tets << 0, 2, 1, 3, 0, 1, 2, 4;
  Points posed = rest;
  posed(4, 2) = -1.0;
  ElementStretch stretch;
  const Status status = measure_stretch(rest, posed, tets, stretch);
  EXPECT_EQ(status.report.number("counts.inverted_elements", 0), 1);
  EXPECT_EQ(status.report.number("counts.stretched_elements", -1), 0)
    << "mirrored, as long as it was";
  ASSERT_EQ(status.warnings.size(), 1u);
  EXPECT_EQ(status.warnings[0], "the pose inverts 1 of 2 tets");
  EXPECT_NEAR(stretch.smallest[0], 1.0, 1e-15);
  EXPECT_NEAR(stretch.smallest[1], -1.0, 1e-15);
  EXPECT_NEAR(stretch.largest[1], 1.0, 1e-15);
  // A mirror image inverts all tets. A tet with negative volume at rest counts as inverted if its
  // volume becomes positive.
  EXPECT_EQ(report_of(rest, Points(-rest), tets).number("counts.inverted_elements", 0), 2);
  Tets other = tets;
  std::swap(other(1, 0), other(1, 1));
  EXPECT_EQ(report_of(rest, rest, other).number("counts.inverted_elements", -1), 0);
}

TEST(ElementStretch, CollapseIsZeroNotInverted)
{
  const TetMesh box = test::tet_box(2, 2, 2);
  for (const Vec3& scale : { Vec3(1, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, 0) })
  {
    const Report report = report_of(box.points, mapped(box.points, scale.asDiagonal()), box.tets);
    EXPECT_EQ(report.number("counts.inverted_elements", -1), 0);
    EXPECT_EQ(report.number("counts.stretched_elements", -1), 48);
    EXPECT_NEAR(report.number("smallest_stretch", -1), 0.0, 1e-14);
    EXPECT_NEAR(report.number("largest_stretch", -1), scale[0], 1e-14);
  }
}

TEST(ElementStretch, TrianglesFlipInAPlaneOnly)
{
  const TriangleMesh square = test::grid(3, 2);
  Points mirrored = square.points;
  mirrored.col(0) *= -1.0;
  EXPECT_EQ(
    report_of(square.points, mirrored, square.triangles).number("counts.inverted_elements", 0), 12);
  const Points turned = mapped(square.points, rotation(180, Vec3(0, 0, 1)));
  EXPECT_EQ(
    report_of(square.points, turned, square.triangles).number("counts.inverted_elements", -1), 0);
  // The triangles of a closed surface have no common plane, so no orientation is defined for them.
  const TriangleMesh ball = test::sphere(1);
  EXPECT_EQ(report_of(ball.points, Points(-ball.points), ball.triangles)
              .number("counts.inverted_elements", -1),
    0);
}

TEST(ElementStretch, AreThoseOfEigenForRandomPoses)
{
  // The elements fill several blocks; the last block is partially filled.
  const TetMesh box = test::tet_box(9, 9, 9);
  const Points posed = perturbed(box.points, 0.06);
  ElementStretch stretch;
  const Status status = measure_stretch(box.points, posed, box.tets, stretch);
  Index inverted = 0, stretched = 0;
  double largest = 0.0, smallest = 1e300;
  for (Index t = 0; t < box.tets.rows(); ++t)
  {
    Eigen::Matrix3d rest_edges, posed_edges;
    for (int k = 0; k < 3; ++k)
    {
      rest_edges.col(k) = box.points.row(box.tets(t, k + 1)) - box.points.row(box.tets(t, 0));
      posed_edges.col(k) = posed.row(box.tets(t, k + 1)) - posed.row(box.tets(t, 0));
    }
    const Eigen::Matrix3d f = posed_edges * rest_edges.inverse();
    const Vec3 sigma = Eigen::JacobiSVD<Eigen::Matrix3d>(f).singularValues();
    const double sign = f.determinant() < 0.0 ? -1.0 : 1.0;
    ASSERT_NEAR(stretch.largest[static_cast<std::size_t>(t)], sigma[0], 1e-12 * sigma[0]);
    ASSERT_NEAR(stretch.smallest[static_cast<std::size_t>(t)], sign * sigma[2], 1e-12 * sigma[0]);
    inverted += sign < 0.0;
    stretched += sigma[0] > 2.0 || sigma[2] < 0.5;
    largest = std::max(largest, sigma[0]);
    smallest = std::min(smallest, sigma[2]);
  }
  EXPECT_GT(inverted, 0);
  EXPECT_LT(inverted, box.tets.rows() / 2);
  EXPECT_EQ(status.report.number("counts.inverted_elements", -1), inverted);
  EXPECT_EQ(status.report.number("counts.stretched_elements", -1), stretched);
  EXPECT_NEAR(status.report.number("largest_stretch", -1), largest, 1e-12 * largest);
  EXPECT_NEAR(status.report.number("smallest_stretch", -1), smallest, 1e-12 * largest);
}

TEST(ElementStretch, AreThoseOfEigenForRandomTriangles)
{
  const TriangleMesh ball = test::sphere(3);
  const Points posed = perturbed(ball.points, 0.2);
  ElementStretch stretch;
  measure_stretch(ball.points, posed, ball.triangles, stretch);
  for (Index t = 0; t < ball.triangles.rows(); ++t)
  {
    // Extend the gradient: it maps the normal at rest to the posed normal with a stretch of 1.
    Eigen::Matrix3d rest_edges, posed_edges;
    for (int k = 0; k < 2; ++k)
    {
      rest_edges.col(k) =
        ball.points.row(ball.triangles(t, k + 1)) - ball.points.row(ball.triangles(t, 0));
      posed_edges.col(k) = posed.row(ball.triangles(t, k + 1)) - posed.row(ball.triangles(t, 0));
    }
    rest_edges.col(2) = Vec3(rest_edges.col(0)).cross(Vec3(rest_edges.col(1))).normalized();
    posed_edges.col(2) = Vec3(posed_edges.col(0)).cross(Vec3(posed_edges.col(1))).normalized();
    Eigen::Matrix3d f = posed_edges * rest_edges.inverse();
    // Remove the part along the normal, which leaves a matrix of rank 2.
    f -= posed_edges.col(2) * rest_edges.col(2).transpose();
    const Vec3 sigma = Eigen::JacobiSVD<Eigen::Matrix3d>(f).singularValues();
    ASSERT_NEAR(stretch.largest[static_cast<std::size_t>(t)], sigma[0], 1e-12 * sigma[0]);
    ASSERT_NEAR(stretch.smallest[static_cast<std::size_t>(t)], sigma[1], 1e-12 * sigma[0]);
  }
}

TEST(ElementStretch, DoNotDependOnThreadsSizeOrPlace)
{
  const TetMesh box = test::tet_box(12, 12, 12);
  const Points posed = perturbed(box.points, 0.03);
  ElementStretch one_thread, many;
  const Status serial = measure_stretch(box.points, posed, box.tets, one_thread, 2.0, 1);
  const Status parallel = measure_stretch(box.points, posed, box.tets, many, 2.0, 4);
  EXPECT_EQ(one_thread.largest, many.largest);
  EXPECT_EQ(one_thread.smallest, many.smallest);
  EXPECT_EQ(serial.warnings, parallel.warnings);
  // Scaling by a power of two does not round.
  for (const double scale : { 0x1p-200, 0x1p200 })
  {
    ElementStretch scaled;
    measure_stretch(Points(scale * box.points), Points(scale * posed), box.tets, scaled);
    EXPECT_EQ(scaled.largest, one_thread.largest) << scale;
  }
}

TEST(ElementStretch, DegenerateElementsAreCountedApart)
{
  Points rest(5, 3);
  rest << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1;
  Tets tets(2, 4);
  tets << 0, 1, 2, 3, 0, 1, 2, 4;
  ElementStretch stretch;
  const Report report = measure_stretch(rest, rest, tets, stretch).report;
  EXPECT_EQ(report.number("counts.degenerate_elements", 0), 1);
  EXPECT_EQ(report.number("largest_stretch", 0), 1.0);
  EXPECT_TRUE(std::isnan(stretch.largest[0]));
  Triangles triangles(2, 3);
  triangles << 0, 1, 1, 0, 0, 0;
  const Report none = measure_stretch(rest, rest, triangles, stretch).report;
  EXPECT_EQ(none.number("counts.degenerate_elements", 0), 2);
  EXPECT_EQ(none.find("largest_stretch"), nullptr);
  EXPECT_EQ(
    measure_stretch(rest, rest, Triangles(0, 3), stretch).report.number("counts.elements", -1), 0);
}

TEST(ElementStretch, BadInputAndCancel)
{
  const TetMesh box = test::tet_box(1, 1, 1);
  ElementStretch stretch;
  EXPECT_EQ(measure_stretch(box.points, box.points, box.tets, stretch, 0.5).code,
    StatusCode::invalid_input);
  EXPECT_EQ(measure_stretch(box.points, box.points, box.tets, stretch, std::nan("")).code,
    StatusCode::invalid_input);
  EXPECT_EQ(measure_stretch(box.points, Points(Points::Zero(3, 3)), box.tets, stretch).code,
    StatusCode::invalid_input);
  ExecutionContext context;
  context.request_cancel();
  EXPECT_EQ(element_stretch(context, {}, box.points, box.points, TetsView(box.tets), stretch).code,
    StatusCode::canceled);
}
