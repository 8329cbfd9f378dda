#ifndef bindpose_tests_core_linear_definite_matrix_h
#define bindpose_tests_core_linear_definite_matrix_h

#include "geometry/laplacian.h"
#include "support/meshes.h"

namespace bindpose::test
{

/// Return the biharmonic matrix of a box that is divided into n x n x n cells, each of which is
/// divided into tets. `shift` is added to the diagonal, which makes the matrix positive definite.
inline SparseMatrix definite_matrix(int n, double shift)
{
  const TetMesh box = tet_box(n, n, n);
  const SparseMatrix k = stiffness_matrix(box.points, box.tets);
  const Eigen::VectorXd m = lumped_mass(box.points, box.tets);
  SparseMatrix q = harmonic_energy(k, m / m.maxCoeff(), 2);
  for (int i = 0; i < q.rows(); ++i)
  {
    q.coeffRef(i, i) += shift;
  }
  q.makeCompressed();
  return q;
}

} // namespace bindpose::test

#endif
