#include "core/inside/tet_outcome.h"

#include "tets/tet_quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace bindpose::test
{

TetOutcome run(const TriangleMesh& mesh, TetrahedralizeOptions options, int threads)
{
  ExecutionContext context;
  context.set_threads(threads);
  TetOutcome outcome;
  outcome.status = tetrahedralize(context, mesh.points, mesh.triangles, options, outcome.result);
  return outcome;
}

TetOutcome run(const TriangleMesh& mesh, TetMethod method)
{
  TetrahedralizeOptions options;
  options.method = method;
  return run(mesh, options);
}

void expect_valid(const TetOutcome& outcome, const TriangleMesh& surface)
{
  ASSERT_TRUE(outcome.status.ok()) << outcome.status.message;
  const TetMesh& mesh = outcome.result.mesh;
  ASSERT_GT(mesh.tets.rows(), 0);
  ASSERT_TRUE(check_mesh(mesh.points, mesh.tets).ok());
  const bool branches = outcome.number("counts.branching_facets") > 0.0;
  EXPECT_TRUE(check_tets(mesh.points, mesh.tets, branches).ok());
  EXPECT_GT(tet_volumes(mesh.points, mesh.tets).minCoeff(), 0.0);
  if (!branches)
  {
    EXPECT_TRUE(count_edges(boundary_triangles(mesh.tets)).closed);
  }
  const Components components = connected_components(mesh.points.rows(), mesh.tets);
  EXPECT_EQ(
    std::count(components.component_of_vertex.begin(), components.component_of_vertex.end(), -1), 0)
    << "a stray vertex";
  const auto& ids = outcome.result.original_vertices;
  ASSERT_EQ(static_cast<Index>(ids.size()), mesh.points.rows());
  const auto first_new = std::find(ids.begin(), ids.end(), -1);
  EXPECT_TRUE(std::is_sorted(ids.begin(), first_new));
  EXPECT_TRUE(std::all_of(first_new, ids.end(), [](Index id) { return id == -1; }));
  for (auto id = ids.begin(); id != first_new; ++id)
  {
    const Index v = id - ids.begin();
    EXPECT_LT((mesh.points.row(v) - surface.points.row(*id)).norm(), 1e-3) << v;
  }
  ASSERT_EQ(outcome.result.winding_numbers.size(), mesh.tets.rows());
  EXPECT_TRUE(outcome.result.winding_numbers.allFinite());
  EXPECT_EQ(outcome.number("counts.tets"), mesh.tets.rows());
  EXPECT_DOUBLE_EQ(outcome.number("volume"), outcome.volume());
  EXPECT_GT(outcome.number("min_dihedral_angle"), 0.0);
  const auto column = [&](const char* key) { return outcome.status.report.find(key); };
  ASSERT_NE(column("quality[].tets"), nullptr);
  const auto& histogram = std::get<std::vector<std::int64_t>>(*column("quality[].tets"));
  EXPECT_EQ(std::accumulate(histogram.begin(), histogram.end(), std::int64_t(0)), mesh.tets.rows());
  EXPECT_EQ(histogram[0], outcome.number("counts.tets_below_5_degrees"));
}

HandleElements handle_elements_of(const std::vector<Vec3>& points)
{
  HandleElements handle_elements;
  handle_elements.points.resize(static_cast<Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    handle_elements.points.row(static_cast<Index>(i)) = points[i];
  }
  return handle_elements;
}

} // namespace bindpose::test
