// split_sharp_edges() duplicates vertices along the same edges as vtkPolyDataNormals.
#include "conversion.h"
#include "shapes/sharp_edges.h"
#include "support/meshes.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkPolyDataNormals.h"

#include <gtest/gtest.h>

#include <map>

using namespace bindpose;

namespace
{
/// Return the triangles after vtkPolyDataNormals has split the vertices along edges that are
/// sharper than `angle` degrees.
Triangles split_by_vtk(const TriangleMesh& mesh, double angle)
{
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(to_polydata(mesh.points, mesh.triangles));
  normals->SetFeatureAngle(angle);
  normals->ConsistencyOff();
  normals->NonManifoldTraversalOff();
  normals->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  normals->Update();
  Triangles result(mesh.triangles.rows(), 3);
  vtkNew<vtkIdList> corners;
  for (Index t = 0; t < result.rows(); ++t)
  {
    normals->GetOutput()->GetPolys()->GetCellAtId(t, corners);
    result.row(t) << corners->GetId(0), corners->GetId(1), corners->GetId(2);
  }
  return result;
}

void expect_the_same_split(const TriangleMesh& mesh, double angle)
{
  Triangles our_split = mesh.triangles;
  const SplitVertices split = split_sharp_edges(mesh.points, angle, our_split);
  const std::vector<Index>& originals = split.originals;
  EXPECT_TRUE(std::is_sorted(originals.begin(), originals.end()));
  const Triangles vtk_split = split_by_vtk(mesh, angle);
  // Each vertex of our split corresponds to exactly one vertex of VTK's split, and vice versa.
  std::map<Index, Index> vtk_vertex_of, our_vertex_of;
  for (Index k = 0; k < our_split.size(); ++k)
  {
    const Index a = our_split.data()[k], b = vtk_split.data()[k];
    EXPECT_EQ(originals[a], mesh.triangles.data()[k]);
    EXPECT_EQ(vtk_vertex_of.insert({ a, b }).first->second, b) << "corner " << k;
    EXPECT_EQ(our_vertex_of.insert({ b, a }).first->second, a) << "corner " << k;
  }
  EXPECT_EQ(our_vertex_of.size(), originals.size()) << "unused vertices are dropped";
}
} // namespace

TEST(SharpEdges, SplitsLikeVtk)
{
  TriangleMesh soup = test::sphere(2);
  for (Index t = 0; t < soup.triangles.rows(); t += 3) // every third triangle is inside out
  {
    std::swap(soup.triangles(t, 0), soup.triangles(t, 1));
  }
  // Forty triangles are added below. Each shares an edge with two existing triangles.
  TriangleMesh fins = test::torus(24, 12, 1.0, 0.4);
  const Index count = fins.triangles.rows();
  fins.points.conservativeResize(fins.points.rows() + 1, 3);
  fins.points.row(fins.points.rows() - 1) << 0.0, 0.0, 2.0;
  fins.triangles.conservativeResize(count + 40, 3);
  for (Index t = 0; t < 40; ++t)
  {
    fins.triangles.row(count + t) << fins.triangles(5 * t, 0), fins.triangles(5 * t, 1),
      fins.points.rows() - 1;
  }
  TriangleMesh flat = test::grid(6, 5); // two bad triangles and an unused vertex are added below
  const Index flat_count = flat.triangles.rows();
  flat.points.conservativeResize(flat.points.rows() + 1, 3);
  flat.points.row(flat.points.rows() - 1).setZero();
  flat.triangles.conservativeResize(flat_count + 2, 3);
  flat.triangles.row(flat_count) = flat.triangles.row(3);
  flat.triangles.row(flat_count + 1) << 7, 8, 8;
  for (const double angle : { 5.0, 50.0, 120.0 })
  {
    for (const TriangleMesh& mesh : { test::cube(), test::sphere(2),
           test::join(test::cube(), test::sphere(2)), soup, fins, flat })
    {
      SCOPED_TRACE(std::to_string(angle) + " degrees, " + std::to_string(mesh.triangles.rows()) +
        " triangles");
      expect_the_same_split(mesh, angle);
    }
  }
}

TEST(SharpEdges, NothingIsHarmless)
{
  Triangles none(0, 3);
  EXPECT_TRUE(split_sharp_edges(Points(0, 3), 50.0, none).originals.empty());
  EXPECT_TRUE(split_sharp_edges(Points(Points::Zero(4, 3)), 50.0, none).originals.empty());
}
