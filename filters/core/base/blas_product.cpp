#include "base/blas_product.h"

#ifdef BINDPOSE_HAS_CHOLMOD
#include "base/serial_blas.h"

// NOLINTBEGIN(readability-identifier-naming): BLAS's name
extern "C"
{
  void dgemm_(const char* transa, const char* transb, const int* m, const int* n, const int* k,
    const double* alpha, const double* a, const int* lda, const double* b, const int* ldb,
    const double* beta, double* c, const int* ldc);
}
// NOLINTEND(readability-identifier-naming)
#else
#include "base/dense_product.h"
#endif

namespace bindpose
{

#ifdef BINDPOSE_HAS_CHOLMOD
namespace
{
/// C = factor A B + kept C
void multiply(double factor, const Eigen::Ref<const Eigen::MatrixXd>& a,
  const Eigen::Ref<const Eigen::MatrixXd>& b, double kept, Eigen::Ref<Eigen::MatrixXd> c)
{
  const SerialBlas serial;
  const int rows = static_cast<int>(a.rows()), inner = static_cast<int>(a.cols()),
            cols = static_cast<int>(b.cols()), a_stride = static_cast<int>(a.outerStride()),
            b_stride = static_cast<int>(b.outerStride()),
            stride = static_cast<int>(c.outerStride());
  dgemm_("N", "N", &rows, &cols, &inner, &factor, a.data(), &a_stride, b.data(), &b_stride, &kept,
    c.data(), &stride);
}
} // namespace

Eigen::MatrixXd blas_product(
  const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b)
{
  if (a.size() == 0 || b.size() == 0)
  {
    return Eigen::MatrixXd::Zero(a.rows(), b.cols());
  }
  Eigen::MatrixXd c(a.rows(), b.cols());
  multiply(1.0, a, b, 0.0, c);
  return c;
}

void subtract_blas_product(const Eigen::Ref<const Eigen::MatrixXd>& a,
  const Eigen::Ref<const Eigen::MatrixXd>& b, Eigen::Ref<Eigen::MatrixXd> c)
{
  if (a.size() > 0 && b.size() > 0)
  {
    multiply(-1.0, a, b, 1.0, c);
  }
}
#else
Eigen::MatrixXd blas_product(
  const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b)
{
  return dense_product(a, b);
}

void subtract_blas_product(const Eigen::Ref<const Eigen::MatrixXd>& a,
  const Eigen::Ref<const Eigen::MatrixXd>& b, Eigen::Ref<Eigen::MatrixXd> c)
{
  c -= dense_product(a, b);
}
#endif

} // namespace bindpose
