#ifndef bindpose_linear_symmetric_product_h
#define bindpose_linear_symmetric_product_h

#include "linear/sparse_matrix.h"

#include <Eigen/Core>

namespace bindpose
{

/// Return A x for a symmetric matrix A whose triangular halves are both stored. If most entries of
/// x are zero, the columns of A that belong to these entries are skipped.
Eigen::VectorXd symmetric_product(const SparseMatrix& a, const Eigen::VectorXd& x);

} // namespace bindpose

#endif
