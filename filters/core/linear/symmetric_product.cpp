// Products with symmetric sparse matrices (see symmetric_product.h).
#include "linear/symmetric_product.h"

namespace bindpose
{

Eigen::VectorXd symmetric_product(const SparseMatrix& a, const Eigen::VectorXd& x)
{
  // The sum over the columns of A adds each term to the result in memory. The transposed product
  // writes each row of the result only once. Therefore the sum is faster only if many columns are
  // skipped. It is used if at most this fraction of the entries of x is nonzero.
  constexpr double sparse_fraction = 0.4;
  const auto nonzeros = static_cast<double>((x.array() != 0.0).count());
  if (nonzeros > sparse_fraction * static_cast<double>(x.size()))
  {
    return a.transpose() * x;
  }
  Eigen::VectorXd product = Eigen::VectorXd::Zero(a.rows());
  for (int j = 0; j < a.cols(); ++j)
  {
    const double factor = x[j];
    for (SparseMatrix::InnerIterator entry(a, j); factor != 0.0 && entry; ++entry)
    {
      product[entry.row()] += factor * entry.value();
    }
  }
  return product;
}

} // namespace bindpose
