// Dense Cholesky factorization by LAPACK, or by Eigen if the build has no LAPACK.
#include "linear/dense_cholesky.h"

#include <Eigen/Cholesky>

#ifdef BINDPOSE_HAS_CHOLMOD
#include "linear/serial_blas.h"

// NOLINTBEGIN(readability-identifier-naming): these are the names of LAPACK and BLAS functions
extern "C"
{
  void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);
  void dpocon_(const char* uplo, const int* n, const double* a, const int* lda, const double* anorm,
    double* rcond, double* work, int* iwork, int* info);
  void dtrsm_(const char* side, const char* uplo, const char* trans, const char* diag, const int* m,
    const int* n, const double* alpha, const double* a, const int* lda, double* b, const int* ldb);
}
// NOLINTEND(readability-identifier-naming)
#endif

namespace bindpose
{

namespace
{
double one_norm(const Eigen::MatrixXd& lower)
{
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(lower.rows());
  for (Index c = 0; c < lower.cols(); ++c)
  {
    for (Index r = c; r < lower.rows(); ++r)
    {
      const double size = std::abs(lower(r, c));
      sums[c] += size;
      sums[r] += r == c ? 0.0 : size;
    }
  }
  return lower.rows() > 0 ? sums.maxCoeff() : 0.0;
}
} // namespace

#ifdef BINDPOSE_HAS_CHOLMOD
bool DenseCholesky::factor(Eigen::MatrixXd a)
{
  const SerialBlas serial;
  this->norm_ = one_norm(a);
  this->l_ = std::move(a);
  const int n = static_cast<int>(this->l_.rows());
  int info = 0;
  dpotrf_("L", &n, this->l_.data(), &n, &info);
  return info == 0 && this->l_.diagonal().allFinite();
}

double DenseCholesky::reciprocal_condition() const
{
  const SerialBlas serial;
  const int n = static_cast<int>(this->l_.rows());
  std::vector<double> work(static_cast<std::size_t>(3 * n));
  std::vector<int> integers(static_cast<std::size_t>(n));
  double result = 0.0;
  int info = 0;
  dpocon_("L", &n, this->l_.data(), &n, &this->norm_, &result, work.data(), integers.data(), &info);
  return info == 0 ? result : 0.0;
}

void DenseCholesky::solve_right(Eigen::MatrixXd& x) const
{
  const SerialBlas serial;
  const int m = static_cast<int>(x.rows()), n = static_cast<int>(x.cols());
  const double one = 1.0;
  if (m > 0 && n > 0)
  {
    dtrsm_("R", "L", "T", "N", &m, &n, &one, this->l_.data(), &n, x.data(), &m);
  }
}
#else
bool DenseCholesky::factor(Eigen::MatrixXd a)
{
  this->norm_ = one_norm(a);
  const Eigen::LLT<Eigen::MatrixXd> llt(a);
  this->l_ = llt.matrixL();
  return llt.info() == Eigen::Success && this->l_.diagonal().allFinite();
}

double DenseCholesky::reciprocal_condition() const
{
  const auto l = this->l_.triangularView<Eigen::Lower>();
  const Eigen::MatrixXd inverse =
    l.transpose().solve(l.solve(Eigen::MatrixXd::Identity(this->l_.rows(), this->l_.rows())));
  return 1.0 / (this->norm_ * inverse.cwiseAbs().colwise().sum().maxCoeff());
}

void DenseCholesky::solve_right(Eigen::MatrixXd& x) const
{
  this->l_.transpose().triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(x);
}
#endif

} // namespace bindpose
