#ifndef bindpose_base_dense_product_h
#define bindpose_base_dense_product_h

#include "base/mesh.h"

namespace bindpose
{

/// A dense matrix of doubles anywhere in memory: entry (i, j) is at data[i * row + j * column].
struct StridedMatrix
{
  const double* data;
  Index rows, cols;
  Index row, column;
};

/// c += a b, for c of #a.rows x #b.cols row by row, c_stride apart; columns of b must lie side by
/// side (b.column = 1). With `lower` only entries (i, j) with j <= i are sure to be added to: for
/// results known to be symmetric, in half the time.
///
/// Why not Eigen's or BLAS's: release builds of Eigen's know no more than SSE2, and BLAS's bits
/// depend on the machine, its speed on whether it knows the processor. This is written for several
/// sizes of registers, and has the same bits in each that has fused operations. One thread.
void add_product(
  const StridedMatrix& a, const StridedMatrix& b, double* c, Index c_stride, bool lower = false);

/// C += A B.
void add_dense_product(const Eigen::Ref<const Eigen::MatrixXd>& a,
  const Eigen::Ref<const Eigen::MatrixXd>& b, Eigen::Ref<Eigen::MatrixXd> c);

/// A B.
Eigen::MatrixXd dense_product(
  const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b);

} // namespace bindpose

#endif
