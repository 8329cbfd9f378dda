// Colors of rotation clusters: clusters that touch have different colors, every cell belongs to the
// cluster of most of its points, and invalid cluster ids are refused.
#include "scene/rotation_colors.h"

#include "conversion.h"
#include "support/meshes.h"

#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
/// Return a sphere with `count` clusters, which are equal sectors around the z axis.
vtkSmartPointer<vtkPolyData> slices(const TriangleMesh& ball, int count)
{
  auto data = to_polydata(ball.points, ball.triangles);
  vtkNew<vtkIntArray> clusters;
  clusters->SetName("RotationCluster");
  for (Index v = 0; v < ball.points.rows(); ++v)
  {
    const double angle_fraction =
      std::atan2(ball.points(v, 1), ball.points(v, 0)) / (2.0 * EIGEN_PI) + 0.5;
    clusters->InsertNextValue(std::min(count - 1, static_cast<int>(angle_fraction * count)));
  }
  data->GetPointData()->AddArray(clusters);
  return data;
}
} // namespace

TEST(RotationColors, ACellHasTheClusterOfMostOfItsPoints)
{
  Points points(5, 3);
  points << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0;
  Triangles triangles(3, 3);
  triangles << 0, 1, 2, 1, 3, 2, 1, 4, 3;
  const auto data = to_polydata(points, triangles);
  vtkNew<vtkIntArray> clusters;
  clusters->SetName("RotationCluster");
  for (const int cluster : { 2, 1, 2, -1, -1 })
  {
    clusters->InsertNextValue(cluster);
  }
  data->GetPointData()->AddArray(clusters);
  const auto cell_clusters = clusters_of_cells(data);
  EXPECT_EQ(cell_clusters->GetValue(0), 2.0);
  EXPECT_EQ(cell_clusters->GetValue(1), 1.0); // two clusters tie, and the lower id wins
  EXPECT_EQ(cell_clusters->GetValue(2), 1.0); // points without a cluster do not count
  clusters->Fill(-1);
  EXPECT_EQ(clusters_of_cells(data)->GetValue(0), -1.0);
}

TEST(RotationColors, ClustersThatTouchDiffer)
{
  const TriangleMesh ball = test::sphere(4);
  // There are 24 colors, which repeat. With 25 or 49 clusters, the last cluster would have the
  // color of the first cluster. These two clusters touch, so the last cluster must get another
  // color.
  for (const int count : { 2, 5, 24, 25, 49 })
  {
    const auto data = slices(ball, count);
    ASSERT_TRUE(check_clusters({ data }).ok());
    const std::vector<Category> categories = cluster_categories({ data });
    ASSERT_EQ(categories.size(), static_cast<std::size_t>(count));
    Index cells = 0;
    for (const Category& category : categories)
    {
      cells += category.count;
    }
    EXPECT_EQ(cells, ball.triangles.rows());
    vtkDataArray* clusters = data->GetPointData()->GetArray("RotationCluster");
    for (Index t = 0; t < ball.triangles.rows(); ++t)
    {
      for (int k = 0; k < 3; ++k)
      {
        const auto a = static_cast<std::size_t>(clusters->GetComponent(ball.triangles(t, k), 0));
        const auto b =
          static_cast<std::size_t>(clusters->GetComponent(ball.triangles(t, (k + 1) % 3), 0));
        EXPECT_TRUE(a == b || categories[a].color != categories[b].color) << a << ' ' << b;
      }
    }
  }
}

TEST(RotationColors, WhatIsNoClusterIsNamed)
{
  const TriangleMesh ball = test::sphere(1);
  const auto plain = to_polydata(ball.points, ball.triangles);
  EXPECT_THAT(check_clusters({ plain, nullptr }).message, HasSubstr("--rotation-arrays"));
  vtkNew<vtkDoubleArray> clusters;
  clusters->SetName("RotationCluster");
  clusters->SetNumberOfValues(ball.points.rows());
  clusters->Fill(0.0);
  plain->GetPointData()->AddArray(clusters);
  EXPECT_TRUE(check_clusters({ plain }).ok());
  for (const double bad : { -2.0, 0.5, 1e9, std::numeric_limits<double>::infinity(),
         std::numeric_limits<double>::quiet_NaN() })
  {
    clusters->SetValue(3, bad);
    const Status status = check_clusters({ plain });
    EXPECT_EQ(status.code, StatusCode::invalid_input) << bad;
    EXPECT_THAT(status.message, HasSubstr("'RotationCluster' of point 3 is "));
  }
}

TEST(RotationColors, ScalesOfAnglesEndAtRoundOnes)
{
  EXPECT_EQ(angle_scale(0.0), 15.0);
  EXPECT_EQ(angle_scale(15.0), 15.0);
  EXPECT_EQ(angle_scale(15.1), 30.0);
  EXPECT_EQ(angle_scale(100.0), 120.0);
  EXPECT_EQ(angle_scale(121.0), 180.0);
  EXPECT_EQ(angle_scale(180.0), 180.0);
}
