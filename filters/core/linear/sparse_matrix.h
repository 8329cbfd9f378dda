#ifndef bindpose_linear_sparse_matrix_h
#define bindpose_linear_sparse_matrix_h

#include <Eigen/SparseCore>

namespace bindpose
{

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

} // namespace bindpose

#endif
