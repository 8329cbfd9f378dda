// Cut and shrunk tets are compared with their definitions.
#include "shapes/tet_cut.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace bindpose;

namespace
{
Vec3 center_of(const TetMesh& mesh, Index t)
{
  Vec3 center = Vec3::Zero();
  for (int k = 0; k < 4; ++k)
  {
    center += 0.25 * mesh.points.row(mesh.tets(t, k)).transpose();
  }
  return center;
}

std::vector<std::array<Index, 3>> sorted(const Triangles& triangles)
{
  std::vector<std::array<Index, 3>> result;
  for (Index f = 0; f < triangles.rows(); ++f)
  {
    // Rotate each face so that it begins with its lowest id. This preserves the orientation.
    std::array<Index, 3> face{ triangles(f, 0), triangles(f, 1), triangles(f, 2) };
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    result.push_back(face);
  }
  std::sort(result.begin(), result.end());
  return result;
}

TetMesh wavy_box()
{
  TetMesh mesh = test::tet_box(5, 4, 3);
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    mesh.points(v, 2) += 0.1 * std::sin(3.0 * mesh.points(v, 0));
  }
  return mesh;
}
} // namespace

TEST(TetCut, SidesAreTheBoundaryOfTheKeptTets)
{
  const TetMesh mesh = wavy_box();
  TetCut cut(mesh.points, mesh.tets);
  test::Random random(5);
  for (int trial = 0; trial < 20; ++trial)
  {
    const Vec3 origin = random.in_box(Vec3::Zero(), Vec3::Ones());
    const Vec3 normal = random.in_box(-Vec3::Ones(), Vec3::Ones());
    cut.keep_behind(origin, normal);
    Tets kept(mesh.tets.rows(), 4);
    Index count = 0;
    for (Index t = 0; t < mesh.tets.rows(); ++t)
    {
      const bool is_kept = (center_of(mesh, t) - origin).dot(normal) <= 0.0;
      EXPECT_EQ(cut.kept()[t], is_kept);
      if (is_kept)
      {
        kept.row(count++) = mesh.tets.row(t);
      }
    }
    EXPECT_EQ(cut.kept_count(), count);
    kept.conservativeResize(count, 4);
    // The outside facets and the exposed facets together are exactly the boundary of the remaining
    // tets, oriented outward.
    Triangles all(cut.boundary_faces().triangles.rows() + cut.exposed_faces().triangles.rows(), 3);
    all << cut.boundary_faces().triangles, cut.exposed_faces().triangles;
    EXPECT_EQ(sorted(all), sorted(boundary_triangles(kept)));
    const auto whole = sorted(boundary_triangles(mesh.tets));
    for (const auto& side : sorted(cut.boundary_faces().triangles))
    {
      EXPECT_TRUE(std::binary_search(whole.begin(), whole.end(), side));
    }
    for (const auto* sides : { &cut.boundary_faces(), &cut.exposed_faces() })
    {
      for (Index s = 0; s < sides->triangles.rows(); ++s)
      {
        const auto tet = mesh.tets.row(sides->tets[s]);
        EXPECT_TRUE(cut.kept()[sides->tets[s]]);
        for (int k = 0; k < 3; ++k)
        {
          EXPECT_TRUE((tet.array() == sides->triangles(s, k)).any());
        }
      }
    }
  }
  cut.keep_all();
  EXPECT_EQ(cut.kept_count(), mesh.tets.rows());
  EXPECT_EQ(cut.exposed_faces().triangles.rows(), 0);
}

TEST(TetCut, NothingIsLeftBeforeTheFirstCenter)
{
  const TetMesh mesh = test::tet_box(2, 2, 2);
  TetCut cut(mesh.points, mesh.tets);
  const auto [first, last] = cut.center_range(Vec3::UnitX());
  cut.keep_behind(Vec3(first - 1e-9, 0, 0), Vec3::UnitX());
  EXPECT_EQ(cut.kept_count(), 0);
  EXPECT_EQ(cut.boundary_faces().triangles.rows() + cut.exposed_faces().triangles.rows(), 0);
  cut.keep_behind(Vec3(last + 1e-9, 0, 0), Vec3::UnitX());
  EXPECT_EQ(cut.kept_count(), mesh.tets.rows());
}

TEST(TetCut, ShrunkTetsKeepTheirShapeAndCenter)
{
  const TetMesh mesh = wavy_box();
  std::vector<char> kept(static_cast<std::size_t>(mesh.tets.rows()), 0);
  Index count = 0;
  for (Index t = 0; t < mesh.tets.rows(); t += 3, ++count)
  {
    kept[t] = 1;
  }
  constexpr double factor = 0.6;
  const ShrunkTets shrunk = shrink_tets(mesh.points, mesh.tets, kept, factor);
  ASSERT_EQ(shrunk.points.rows(), 4 * count);
  ASSERT_EQ(shrunk.triangles.rows(), 4 * count);
  const Eigen::VectorXd volumes = tet_volumes(mesh.points, mesh.tets);
  for (Index i = 0; i < count; ++i)
  {
    const Index t = shrunk.tets[4 * i];
    EXPECT_EQ(t, 3 * i);
    // The facets of a shrunk tet are closed and oriented outward, so the divergence theorem gives
    // its volume.
    const Triangles sides = shrunk.triangles.middleRows(4 * i, 4);
    EXPECT_NEAR(signed_volume(shrunk.points, sides), std::pow(factor, 3.0) * volumes[t], 1e-15);
    const Eigen::RowVector3d center = shrunk.points.middleRows(4 * i, 4).colwise().mean();
    EXPECT_LT((center.transpose() - center_of(mesh, t)).norm(), 1e-14);
    for (int k = 0; k < 4; ++k)
    {
      EXPECT_EQ(shrunk.vertices[4 * i + k], mesh.tets(t, k));
    }
  }
}
