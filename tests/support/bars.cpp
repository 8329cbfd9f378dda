#include "support/bars.h"

#include "geometry/laplacian.h"
#include "support/handles.h"
#include "support/meshes.h"

#include <Eigen/SparseCholesky>

#include <cmath>

namespace bindpose::test
{

Weights biharmonic(
  const TetMesh& mesh, const std::vector<Index>& vertices, const std::vector<Index>& handles)
{
  Index columns = 0;
  for (const Index h : handles)
  {
    columns = std::max(columns, h + 1);
  }
  const SparseMatrix q = harmonic_energy(
    stiffness_matrix(mesh.points, mesh.tets), lumped_mass(mesh.points, mesh.tets), 2);
  const Index n = mesh.points.rows();
  std::vector<Index> unknown(static_cast<std::size_t>(n), 0);
  Weights weights = Weights::Zero(n, columns);
  for (std::size_t i = 0; i < vertices.size(); ++i)
  {
    unknown[static_cast<std::size_t>(vertices[i])] = -1;
    weights(vertices[i], handles[i]) = 1.0;
  }
  Index count = 0;
  for (Index& u : unknown)
  {
    u = u < 0 ? -1 : count++;
  }
  std::vector<Eigen::Triplet<double, int>> entries;
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(count, columns);
  for (Index c = 0; c < n; ++c)
  {
    for (SparseMatrix::InnerIterator it(q, c); it; ++it)
    {
      const Index row = unknown[static_cast<std::size_t>(it.row())];
      const Index col = unknown[static_cast<std::size_t>(c)];
      if (row >= 0 && col >= 0)
      {
        entries.emplace_back(static_cast<int>(row), static_cast<int>(col), it.value());
      }
      else if (row >= 0)
      {
        right.row(row) -= it.value() * weights.row(c);
      }
    }
  }
  SparseMatrix inner(count, count);
  inner.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<SparseMatrix> solver(inner);
  const Eigen::MatrixXd solution = solver.solve(right);
  for (Index v = 0; v < n; ++v)
  {
    if (unknown[static_cast<std::size_t>(v)] >= 0)
    {
      weights.row(v) = solution.row(unknown[static_cast<std::size_t>(v)]);
      weights.row(v) /= weights.row(v).sum(); // this removes only round-off
    }
  }
  return weights;
}

Rig bar(int cells)
{
  Rig rig;
  rig.mesh = tet_box(cells, 2, 2, Vec3::Zero(), Vec3(4, 1, 1));
  rig.handles = { point_handle("left", Vec3(0, 0.5, 0.5)),
    point_handle("middle", Vec3(2, 0.5, 0.5)), point_handle("right", Vec3(4, 0.5, 0.5)) };
  std::vector<Index> vertices, owners;
  for (Index v = 0; v < rig.mesh.points.rows(); ++v)
  {
    for (Index h = 0; h < 3; ++h)
    {
      if (std::abs(rig.mesh.points(v, 0) - 2.0 * static_cast<double>(h)) < 1e-9)
      {
        vertices.push_back(v);
        owners.push_back(h);
      }
    }
  }
  rig.weights = biharmonic(rig.mesh, vertices, owners);
  return rig;
}

Rig box(int cells)
{
  Rig rig;
  rig.mesh = tet_box(cells, cells, cells);
  rig.handles = { point_handle("origin", Vec3(0, 0, 0)), point_handle("x", Vec3(1, 0, 0)),
    point_handle("y", Vec3(0, 1, 0)), point_handle("z", Vec3(0, 0, 1)),
    point_handle("core", Vec3(0.5, 0.5, 0.5)) };
  std::vector<Index> vertices, owners;
  for (Index h = 0; h < 5; ++h)
  {
    Index nearest = 0;
    (rig.mesh.points.rowwise() - rig.handles[static_cast<std::size_t>(h)].head.transpose())
      .rowwise()
      .squaredNorm()
      .minCoeff(&nearest);
    vertices.push_back(nearest);
    owners.push_back(h);
  }
  rig.weights = biharmonic(rig.mesh, vertices, owners);
  return rig;
}

} // namespace bindpose::test
