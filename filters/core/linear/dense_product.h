#ifndef bindpose_linear_dense_product_h
#define bindpose_linear_dense_product_h

// Products of dense matrices with the same bits on every machine.

#include "base/mesh_types.h"

namespace bindpose
{

/// A dense matrix of doubles in any layout: entry (i, j) is at data[i * row + j * column].
struct StridedMatrix
{
  const double* data;
  Index rows, cols;
  Index row, column;
};

/// Add the product of `a` and `b` to `c`. `c` is a row-major matrix of a.rows x b.cols whose rows
/// are `c_stride` apart. The rows of `b` must be contiguous (b.column = 1). If `lower` is true,
/// only entries (i, j) with j <= i are guaranteed to be added, which halves the time. This is
/// sufficient if the product is known to be symmetric.
///
/// Eigen is not used, because release builds of Eigen use only SSE2. BLAS is not used, because the
/// results of BLAS depend on the machine, and a BLAS library is slow on processors that it does not
/// support. This function is compiled for several register sizes. It computes the same bits with
/// all instruction sets that have fused multiply-add operations. It runs on one thread.
void add_product(
  const StridedMatrix& a, const StridedMatrix& b, double* c, Index c_stride, bool lower = false);

/// Add A B to C.
void add_dense_product(const Eigen::Ref<const Eigen::MatrixXd>& a,
  const Eigen::Ref<const Eigen::MatrixXd>& b, Eigen::Ref<Eigen::MatrixXd> c);

/// Return A B.
Eigen::MatrixXd dense_product(
  const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b);

} // namespace bindpose

#endif
