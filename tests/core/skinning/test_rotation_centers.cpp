// Optimized centers of rotation (Le, Hodgins 2016), compared with the sums in the paper. Skinning
// with these centers reproduces rigid motions exactly, and joints that are twisted do not become
// thinner.
#include "skinning/rotation_centers.h"

#include "base/constants.h"
#include "skinning/skinning.h"

#include "support/affines.h"
#include "support/differences.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace bindpose;
using test::affine;
using test::largest_distance;
using test::moved;
using test::rotation;

namespace
{
/// Return nonnegative weights. Rows sum to 1, and each row contains a zero.
Weights random_weights_with_zeros(Index rows, Index cols)
{
  test::Random random(8);
  Weights weights(rows, cols);
  for (Index v = 0; v < rows; ++v)
  {
    for (Index j = 0; j < cols; ++j)
    {
      weights(v, j) = (v + j) % cols == 0 ? 0.0 : random.uniform();
    }
    weights.row(v) /= weights.row(v).sum();
  }
  return weights;
}

/// Return normalized Gaussian bumps at equally spaced positions along x.
Weights smooth_weights(const Points& points, Index cols)
{
  const double length = points.col(0).maxCoeff();
  Weights weights(points.rows(), cols);
  for (Index v = 0; v < points.rows(); ++v)
  {
    for (Index j = 0; j < cols; ++j)
    {
      const double d =
        points(v, 0) / length - static_cast<double>(j) / static_cast<double>(cols - 1);
      weights(v, j) = std::exp(-12.0 * d * d);
    }
    weights.row(v) /= weights.row(v).sum();
  }
  return weights;
}

double similarity(const Eigen::RowVectorXd& a, const Eigen::RowVectorXd& b, double width)
{
  double sum = 0.0;
  for (Index j = 0; j < a.size(); ++j)
  {
    for (Index k = 0; k < a.size(); ++k)
    {
      const double d = a[j] * b[k] - a[k] * b[j];
      sum += j == k ? 0.0 : a[j] * a[k] * b[j] * b[k] * std::exp(-d * d / (width * width));
    }
  }
  return sum;
}

double size_of_element(const Points& p, const Tets& tets, Index e)
{
  return std::abs(
    tet_volume(p.row(tets(e, 0)), p.row(tets(e, 1)), p.row(tets(e, 2)), p.row(tets(e, 3))));
}

double size_of_element(const Points& p, const Triangles& triangles, Index e)
{
  const Vec3 a = p.row(triangles(e, 0)), b = p.row(triangles(e, 1)), c = p.row(triangles(e, 2));
  return 0.5 * (b - a).cross(c - a).norm();
}

template <typename Elements>
Points reference_centers(
  const Points& points, const Elements& elements, const Weights& weights, double width)
{
  Points centers = points;
  for (Index v = 0; v < points.rows(); ++v)
  {
    Vec3 moment = Vec3::Zero();
    double amount = 0.0;
    for (Index e = 0; e < elements.rows(); ++e)
    {
      Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(weights.cols());
      Vec3 centroid = Vec3::Zero();
      for (Index k = 0; k < elements.cols(); ++k)
      {
        mean += weights.row(elements(e, k)) / static_cast<double>(elements.cols());
        centroid += points.row(elements(e, k)).transpose() / static_cast<double>(elements.cols());
      }
      const double s =
        similarity(weights.row(v), mean, width) * size_of_element(points, elements, e);
      amount += s;
      moment += s * centroid;
    }
    if (amount > 0.0)
    {
      centers.row(v) = (moment / amount).transpose();
    }
  }
  return centers;
}

template <typename Elements>
Points computed_centers(const Points& points, const Elements& elements, const Weights& weights,
  const RotationCentersOptions& options = {}, int threads = 0)
{
  ExecutionContext context;
  context.set_threads(threads);
  Points centers;
  const Status status =
    rotation_centers(context, options, points, MatrixView<Elements>(elements), weights, centers);
  EXPECT_TRUE(status.ok()) << status.message;
  return centers;
}

RotationCentersOptions exact()
{
  RotationCentersOptions options;
  options.smallest_weight = 0.0;
  options.smallest_pair = 0.0;
  options.group_size = 0.0;
  return options;
}

/// A tube of radius 1 around z from -2 to 2. The weights change from the first to the second handle
/// within |z| < 1 and are equal on the ring at z = 0.
struct Tube
{
  TriangleMesh mesh = test::grid(24, 16, 2.0 * pi, 4.0);
  Weights weights;

  Tube()
  {
    // Close the tube: the last column of points is replaced by the first one.
    for (Index t = 0; t < this->mesh.triangles.size(); ++t)
    {
      Index& v = this->mesh.triangles.data()[t];
      v -= v % 25 == 24 ? 24 : 0;
    }
    this->weights.resize(this->mesh.points.rows(), 2);
    for (Index v = 0; v < this->mesh.points.rows(); ++v)
    {
      const double angle = this->mesh.points(v, 0), z = this->mesh.points(v, 1) - 2.0;
      this->mesh.points.row(v) << std::cos(angle), std::sin(angle), z;
      const double w = std::clamp(0.5 * (1.0 + z), 0.0, 1.0);
      this->weights.row(v) << 1.0 - w, w;
    }
  }

  /// Return the smallest and the largest radius of the ring at z = 0 after posing.
  std::pair<double, double> ring(const Points& posed) const
  {
    double minimum = 1e300, maximum = 0.0;
    for (Index v = 0; v < posed.rows(); ++v)
    {
      if (std::abs(this->mesh.points(v, 2)) < 1e-9)
      {
        const double radius = posed.row(v).head<2>().norm();
        minimum = std::min(minimum, radius);
        maximum = std::max(maximum, radius);
      }
    }
    return { minimum, maximum };
  }
};
} // namespace

TEST(RotationCenters, AreThePapersSums)
{
  const TetMesh box = test::tet_box(4, 3, 2, Vec3::Zero(), Vec3(4, 3, 2));
  const TriangleMesh ball = test::sphere(2);
  for (const double width : { 0.1, 0.02, 3.0 })
  {
    RotationCentersOptions options = exact();
    options.width = width;
    const Weights in_box = random_weights_with_zeros(box.points.rows(), 4);
    EXPECT_LT(largest_distance(computed_centers(box.points, box.tets, in_box, options),
                reference_centers(box.points, box.tets, in_box, width)),
      1e-11)
      << width;
    const Weights on_ball = random_weights_with_zeros(ball.points.rows(), 3);
    EXPECT_LT(largest_distance(computed_centers(ball.points, ball.triangles, on_ball, options),
                reference_centers(ball.points, ball.triangles, on_ball, width)),
      1e-11)
      << width;
  }
}

TEST(RotationCenters, GroupsMoveThemLittle)
{
  const TetMesh bar = test::tet_box(40, 4, 4, Vec3::Zero(), Vec3(10, 1, 1));
  const Weights weights = smooth_weights(bar.points, 5);
  const Points plain = computed_centers(bar.points, bar.tets, weights, exact());
  const Points grouped = computed_centers(bar.points, bar.tets, weights);
  EXPECT_LT(largest_distance(grouped, plain), 1e-3 * bounding_box(bar.points).diagonal());
  RotationCentersOptions coarse;
  coarse.group_size = 0.05;
  ExecutionContext context;
  Points centers;
  const Status few =
    rotation_centers(context, coarse, bar.points, TetsView(bar.tets), weights, centers);
  // The report contains the total number of groups of all ten pairs of handles.
  EXPECT_LT(few.report.number("counts.groups", 0), bar.tets.rows() / 10);
  EXPECT_EQ(few.report.number("counts.centers", 0), bar.points.rows());
}

TEST(RotationCenters, OfATubeLieOnItsAxis)
{
  const Tube tube;
  const Points centers = computed_centers(tube.mesh.points, tube.mesh.triangles, tube.weights);
  for (Index v = 0; v < centers.rows(); ++v)
  {
    if (std::abs(tube.mesh.points(v, 2)) < 0.9)
    {
      EXPECT_LT(centers.row(v).head<2>().norm(), 1e-12) << v;
    }
    else if (std::abs(tube.mesh.points(v, 2)) > 1.01)
    {
      EXPECT_EQ(centers.row(v), tube.mesh.points.row(v)) << "one handle: its own center";
    }
  }
}

TEST(RotationCenters, KeepTwistedJointsWide)
{
  const Tube tube;
  const Points centers = computed_centers(tube.mesh.points, tube.mesh.triangles, tube.weights);
  ExecutionContext context;
  for (const bool single : { false, true })
  {
    SkinningOptions options;
    options.single_precision = single;
    Skinning skinning;
    ASSERT_TRUE(skinning.bind(context, tube.weights, options).ok());
    const std::pair<double, double> shrunk[] = { { 90.0, std::sqrt(0.5) }, { 120.0, 0.5 },
      { 180.0, 0.0 } };
    for (const auto& [degrees, radius] : shrunk)
    {
      const std::vector<Affine> twist{ identity_affine(),
        affine(rotation(degrees, Vec3(0, 0, 1)), Vec3::Zero()) };
      Points posed;
      ASSERT_TRUE(skinning.linear_blend(context, tube.mesh.points, twist, posed).ok());
      EXPECT_NEAR(tube.ring(posed).second, radius, 1e-6);
      ASSERT_TRUE(
        skinning.centers_of_rotation(context, tube.mesh.points, twist, centers, posed).ok());
      EXPECT_NEAR(tube.ring(posed).first, 1.0, single ? 1e-6 : 1e-12) << degrees;
      EXPECT_NEAR(tube.ring(posed).second, 1.0, single ? 1e-6 : 1e-12) << degrees;
    }
  }
}

TEST(RotationCenters, SkinningIsExactForOneMapOfAllHandles)
{
  const TetMesh box = test::tet_box(4, 3, 3);
  const Weights weights = random_weights_with_zeros(box.points.rows(), 5);
  const Points centers = computed_centers(box.points, box.tets, weights);
  ExecutionContext context;
  Skinning skinning;
  ASSERT_TRUE(skinning.bind(context, weights).ok());
  Points posed;
  const std::vector<Affine> rest(5, identity_affine());
  ASSERT_TRUE(skinning.centers_of_rotation(context, box.points, rest, centers, posed).ok());
  EXPECT_EQ(posed, box.points) << "no bit moves at rest";
  Eigen::Matrix3d stretch = rotation(200, Vec3(3, 1, -2));
  stretch *= Vec3(2.0, 0.5, 1.25).asDiagonal();
  const Affine maps[] = { affine(Eigen::Matrix3d::Identity(), Vec3(3, -1, 2)),
    affine(rotation(140, Vec3(1, 2, 3)), Vec3(0.2, 5, 1)), affine(stretch, Vec3(1, 1, 1)) };
  for (const Affine& map : maps)
  {
    const std::vector<Affine> all(5, map);
    ASSERT_TRUE(skinning.centers_of_rotation(context, box.points, all, centers, posed).ok());
    EXPECT_LT(largest_distance(posed, moved(box.points, map)), 1e-13);
    Points normals = box.points.rowwise().normalized();
    normals.row(0) << 1, 0, 0;
    Points turned;
    ASSERT_TRUE(skinning.centers_of_rotation_normals(context, normals, all, turned).ok());
    const Eigen::Matrix3d cofactors =
      map.leftCols<3>().determinant() * map.leftCols<3>().inverse().transpose();
    const Points expected = (normals * cofactors.transpose()).rowwise().normalized();
    EXPECT_LT(largest_distance(turned, expected), 1e-12);
  }
}

TEST(RotationCenters, TurnsByTheBlendAboutTheCenterThatTheBlendMoves)
{
  const TetMesh box = test::tet_box(3, 3, 3);
  const Weights weights = random_weights_with_zeros(box.points.rows(), 3);
  const Points centers = computed_centers(box.points, box.tets, weights);
  const std::vector<Affine> maps{ affine(rotation(50, Vec3(1, 0, 1)), Vec3(1, 0, 0)),
    affine(rotation(-80, Vec3(0, 1, 1)), Vec3(0, 0.5, 0)),
    affine(rotation(100, Vec3(1, 1, 0)), Vec3(0, 0, -1)) };
  ExecutionContext context;
  Skinning skinning;
  ASSERT_TRUE(skinning.bind(context, weights).ok());
  Points posed;
  ASSERT_TRUE(skinning.centers_of_rotation(context, box.points, maps, centers, posed).ok());
  for (Index v = 0; v < box.points.rows(); ++v)
  {
    Index largest = 0;
    weights.row(v).maxCoeff(&largest);
    const Eigen::Quaterniond reference(Eigen::Matrix3d(maps[largest].leftCols<3>()));
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    Vec3 center = Vec3::Zero();
    for (std::size_t j = 0; j < 3; ++j)
    {
      const double w = weights(v, static_cast<Index>(j));
      const Eigen::Quaterniond q(Eigen::Matrix3d(maps[j].leftCols<3>()));
      sum += (q.dot(reference) < 0.0 ? -w : w) * q.coeffs();
      center += w * (maps[j] * Vec3(centers.row(v)).homogeneous());
    }
    const Eigen::Quaterniond blend(Eigen::Vector4d(sum.normalized()));
    const Vec3 expected = center + blend * Vec3(box.points.row(v) - centers.row(v));
    EXPECT_LT((posed.row(v).transpose() - expected).norm(), 1e-13) << v;
  }
}

TEST(RotationCenters, DoNotDependOnThreadsOrOrderAndFollowTheShape)
{
  const TetMesh bar = test::tet_box(16, 4, 4, Vec3::Zero(), Vec3(4, 1, 1));
  const Weights weights = smooth_weights(bar.points, 4);
  const Points one_thread = computed_centers(bar.points, bar.tets, weights, {}, 1);
  EXPECT_EQ(one_thread, computed_centers(bar.points, bar.tets, weights, {}, 4));
  const Affine motion = affine(8.0 * rotation(33, Vec3(1, 2, 0)), Vec3(5, 6, 7));
  EXPECT_LT(largest_distance(computed_centers(moved(bar.points, motion), bar.tets, weights),
              moved(one_thread, motion)),
    1e-11);
  const Tets reversed = bar.tets.colwise().reverse();
  EXPECT_LT(largest_distance(computed_centers(bar.points, reversed, weights), one_thread), 1e-12);
}

TEST(RotationCenters, BadInputAndCancel)
{
  const TetMesh box = test::tet_box(2, 2, 2);
  Weights weights = random_weights_with_zeros(box.points.rows(), 3);
  ExecutionContext context;
  Points centers;
  const auto code = [&](const RotationCentersOptions& options)
  {
    return rotation_centers(context, options, box.points, TetsView(box.tets), weights, centers)
      .code;
  };
  RotationCentersOptions options;
  options.width = 0.0;
  EXPECT_EQ(code(options), StatusCode::invalid_input);
  options = {};
  options.smallest_weight = 1.0;
  EXPECT_EQ(code(options), StatusCode::invalid_input);
  options = {};
  options.smallest_pair = -1.0;
  EXPECT_EQ(code(options), StatusCode::invalid_input);
  options = {};
  options.group_size = -1.0;
  EXPECT_EQ(code(options), StatusCode::invalid_input);
  EXPECT_EQ(code({}), StatusCode::ok);
  weights(3, 1) = std::nan("");
  EXPECT_EQ(code({}), StatusCode::invalid_input);
  weights = Weights::Zero(2, 3);
  EXPECT_EQ(code({}), StatusCode::invalid_input);
  weights = Weights::Zero(box.points.rows(), 1);
  EXPECT_EQ(code({}), StatusCode::ok) << "one handle has no pair";
  EXPECT_EQ(centers, box.points);
  Skinning skinning;
  ASSERT_TRUE(skinning.bind(context, weights).ok());
  Points posed;
  const std::vector<Affine> turn{ affine(rotation(90, Vec3(0, 0, 1)), Vec3(1, 0, 0)) };
  ASSERT_TRUE(skinning.centers_of_rotation(context, box.points, turn, centers, posed).ok());
  EXPECT_EQ(posed, box.points) << "rows of zeros rest";
  EXPECT_EQ(skinning.centers_of_rotation(context, box.points, turn, Points(2, 3), posed).code,
    StatusCode::invalid_input);
  context.request_cancel();
  EXPECT_EQ(code({}), StatusCode::canceled);
}
