// Sparse Cholesky factorization with one interface and two backends, CHOLMOD and Eigen.
//
// CHOLMOD: cholmod_analyze returns a symbolic factor, which clones share. Each clone copies the
// symbolic factor at the first factorization. Each clone also has its own workspace
// (cholmod_common), so that clones can factor concurrently. The factor is always supernodal LL',
// because a simplicial LDL' would accept negative pivots silently.
//
// A factorization is serial: the caller solves for several handles in parallel, and a threaded BLAS
// would make results depend on the number of threads. CHOLMOD also assembles supernodes in OpenMP
// regions of four threads. The threads of concurrent factorizations would obstruct each other, so
// these regions are made inactive during a call. OpenBLAS should be the threaded build, configured
// to use one thread: the build without threads does not support concurrent calls (see SerialBlas).
#include "linear/sparse_solver.h"

#include "base/memory.h"
#include "linear/supernodes.h"

#include <Eigen/SparseCholesky>

#include <atomic>
#include <mutex>

#ifdef BINDPOSE_HAS_CHOLMOD
#include "linear/serial_blas.h"

#include <cholmod.h>
#include <dlfcn.h>
#endif

namespace bindpose
{

namespace
{
struct Counters
{
  std::atomic<Index> analyses{ 0 };
  std::atomic<Index> factorizations{ 0 };
};

/// Interface of a backend. SparseSolver counts factorizations and checks arguments.
class Factorization
{
public:
  virtual ~Factorization() = default;
  virtual const char* name() const = 0;
  virtual Status analyze(const SparseMatrix& matrix) = 0;
  virtual Status factor(const SparseMatrix& matrix) = 0;
  virtual Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) = 0;
  virtual void solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) = 0;
  virtual std::unique_ptr<Factorization> clone() const = 0;
  virtual std::shared_ptr<const Supernodes> supernodes() const { return nullptr; }
  virtual bool has_factor() const = 0;
  virtual double bytes() const = 0;
  virtual double nonzeros() const = 0;
  virtual double operations() const = 0;
};

Status not_positive_definite(Index unknown)
{
  return Status::invalid_input("the matrix is not positive definite: the pivot of unknown " +
    std::to_string(unknown) + " is not positive");
}

class EigenFactorization : public Factorization
{
public:
  using Solver = Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Eigen::AMDOrdering<int>>;

  const char* name() const override { return "eigen"; }

  Status analyze(const SparseMatrix& matrix) override
  {
    this->pattern_ = std::make_shared<SparseMatrix>(matrix);
    this->solver_.analyzePattern(matrix);
    return {};
  }

  Status factor(const SparseMatrix& matrix) override
  {
    this->solver_.factorize(matrix);
    const auto& d = this->solver_.vectorD();
    for (Eigen::Index i = 0; i < d.size(); ++i)
    {
      if (!(d[i] > 0.0))
      {
        return not_positive_definite(this->solver_.permutationPinv().indices()[i]);
      }
    }
    return {};
  }

  Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) override { return this->solver_.solve(rhs); }
  void solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) override
  {
    x = this->solver_.solve(rhs);
  }

  std::unique_ptr<Factorization> clone() const override
  {
    // Eigen's solver cannot be copied, so the analysis is repeated. An analysis takes little time
    // compared with a factorization.
    auto copy = std::make_unique<EigenFactorization>();
    copy->pattern_ = this->pattern_;
    if (copy->pattern_)
    {
      copy->solver_.analyzePattern(*copy->pattern_);
    }
    return copy;
  }

  // The analysis already allocates the factor.
  bool has_factor() const override { return true; }
  double bytes() const override
  {
    return this->nonzeros() * static_cast<double>(sizeof(double) + sizeof(int));
  }
  double nonzeros() const override
  {
    return static_cast<double>(this->solver_.matrixL().nestedExpression().nonZeros());
  }
  double operations() const override
  {
    const auto& l = this->solver_.matrixL().nestedExpression();
    double sum = 0.0;
    for (Eigen::Index j = 0; j < l.outerSize(); ++j)
    {
      const double n = l.outerIndexPtr()[j + 1] - l.outerIndexPtr()[j];
      sum += n * n;
    }
    return sum;
  }

private:
  std::shared_ptr<SparseMatrix> pattern_;
  Solver solver_;
};

#ifdef BINDPOSE_HAS_CHOLMOD
class CholmodFactorization : public Factorization
{
public:
  explicit CholmodFactorization(SparseSolver::Ordering ordering) : ordering_(ordering)
  {
    cholmod_start(&this->common_);
    this->common_.print = 0;
    this->common_.supernodal = CHOLMOD_SUPERNODAL;
    this->common_.final_ll = 1;
  }
  ~CholmodFactorization() override
  {
    cholmod_free_factor(&this->factor_, &this->common_);
    cholmod_free_dense(&this->x_, &this->common_);
    cholmod_free_dense(&this->y_, &this->common_);
    cholmod_free_dense(&this->e_, &this->common_);
    cholmod_finish(&this->common_);
  }
  CholmodFactorization(const CholmodFactorization&) = delete;
  CholmodFactorization& operator=(const CholmodFactorization&) = delete;

  const char* name() const override { return "cholmod"; }

  Status analyze(const SparseMatrix& matrix) override
  {
    const bool metis = this->ordering_ == SparseSolver::Ordering::metis ||
      (this->ordering_ == SparseSolver::Ordering::automatic && matrix.rows() > 500);
    this->common_.nmethods = 1;
    this->common_.method[0].ordering = metis ? CHOLMOD_METIS : CHOLMOD_AMD;
    this->common_.postorder = 1;
    cholmod_free_factor(&this->factor_, &this->common_);
    this->pattern_.reset();
    cholmod_sparse a = view(matrix);
    cholmod_factor* pattern = cholmod_analyze(&a, &this->common_);
    if (!pattern)
    {
      return this->failure("analyzed");
    }
    this->pattern_.reset(pattern, free_factor);
    this->copy_supernodes();
    this->nonzeros_ = this->common_.lnz;
    this->operations_ = this->common_.fl;
    return {};
  }

  Status factor(const SparseMatrix& matrix) override
  {
    const SerialBlas serial;
    if (!this->factor_ && this->pattern_)
    {
      this->factor_ = cholmod_copy_factor(this->pattern_.get(), &this->common_);
    }
    if (!this->factor_)
    {
      return this->failure("factored");
    }
    cholmod_sparse a = view(matrix);
    cholmod_factorize(&a, this->factor_, &this->common_);
    if (this->common_.status == CHOLMOD_NOT_POSDEF)
    {
      const auto* order = static_cast<const int*>(this->factor_->Perm);
      const auto failed_column = static_cast<Index>(this->factor_->minor);
      return not_positive_definite(
        failed_column < matrix.rows() ? order[failed_column] : failed_column);
    }
    if (this->common_.status < 0)
    {
      return this->failure("factored");
    }
    // LAPACK does not detect NaN in the matrix; the estimate of the condition is then 0 or NaN.
    return cholmod_rcond(this->factor_, &this->common_) > 0.0
      ? Status()
      : Status::invalid_input("the matrix to factor contains values that are not finite");
  }

  Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) override
  {
    const SerialBlas serial;
    cholmod_dense b = view(rhs);
    cholmod_dense* x = cholmod_solve(CHOLMOD_A, this->factor_, &b, &this->common_);
    Eigen::MatrixXd result =
      Eigen::Map<Eigen::MatrixXd>(static_cast<double*>(x->x), rhs.rows(), rhs.cols());
    cholmod_free_dense(&x, &this->common_);
    return result;
  }

  void solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) override
  {
    const SerialBlas serial;
    cholmod_dense b = view(rhs);
    cholmod_solve2(CHOLMOD_A, this->factor_, &b, nullptr, &this->x_, nullptr, &this->y_, &this->e_,
      &this->common_);
    x = Eigen::Map<Eigen::VectorXd>(static_cast<double*>(this->x_->x), rhs.size());
  }

  std::unique_ptr<Factorization> clone() const override
  {
    auto copy = std::make_unique<CholmodFactorization>(this->ordering_);
    copy->pattern_ = this->pattern_;
    copy->supernodes_ = this->supernodes_;
    copy->nonzeros_ = this->nonzeros_;
    copy->operations_ = this->operations_;
    return copy;
  }

  std::shared_ptr<const Supernodes> supernodes() const override { return this->supernodes_; }
  bool has_factor() const override { return this->factor_ != nullptr; }
  double bytes() const override
  {
    return this->pattern_ ? static_cast<double>(this->pattern_->xsize) * sizeof(double) +
        static_cast<double>(this->pattern_->ssize) * sizeof(int)
                          : 0.0;
  }
  double nonzeros() const override { return this->nonzeros_; }
  double operations() const override { return this->operations_; }

private:
  static void free_factor(cholmod_factor* factor)
  {
    cholmod_common common{};
    cholmod_start(&common);
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  void copy_supernodes()
  {
    const auto copy = [](const void* from, size_t count) {
      return std::vector<int>(static_cast<const int*>(from), static_cast<const int*>(from) + count);
    };
    const cholmod_factor& factor = *this->pattern_;
    auto nodes = std::make_shared<Supernodes>();
    nodes->order = copy(factor.Perm, factor.n);
    nodes->first_column = copy(factor.super, factor.nsuper + 1);
    nodes->first_row = copy(factor.pi, factor.nsuper + 1);
    nodes->first_value = copy(factor.px, factor.nsuper + 1);
    nodes->rows = copy(factor.s, factor.ssize);
    this->supernodes_ = std::move(nodes);
  }
  static cholmod_sparse view(const SparseMatrix& matrix)
  {
    cholmod_sparse a{};
    a.nrow = static_cast<size_t>(matrix.rows());
    a.ncol = static_cast<size_t>(matrix.cols());
    a.nzmax = static_cast<size_t>(matrix.nonZeros());
    a.p = const_cast<int*>(matrix.outerIndexPtr());
    a.i = const_cast<int*>(matrix.innerIndexPtr());
    a.x = const_cast<double*>(matrix.valuePtr());
    a.stype = -1;
    a.itype = CHOLMOD_INT;
    a.xtype = CHOLMOD_REAL;
    a.dtype = CHOLMOD_DOUBLE;
    a.sorted = 1;
    a.packed = 1;
    return a;
  }
  template <typename Matrix>
  static cholmod_dense view(const Matrix& matrix)
  {
    cholmod_dense b{};
    b.nrow = b.d = static_cast<size_t>(matrix.rows());
    b.ncol = static_cast<size_t>(matrix.cols());
    b.nzmax = b.nrow * b.ncol;
    b.x = const_cast<double*>(matrix.data());
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    return b;
  }

  Status failure(const char* operation) const
  {
    const std::string start = std::string("the matrix cannot be ") + operation + ": ";
    switch (this->common_.status)
    {
      case CHOLMOD_OUT_OF_MEMORY:
        return Status::failure(StatusCode::internal_error, start + "out of memory");
      case CHOLMOD_TOO_LARGE:
        return Status::invalid_input(start + "its factor is too large");
      case CHOLMOD_NOT_INSTALLED:
        return Status::failure(
          StatusCode::unavailable, start + "the installed CHOLMOD has no supernodal method");
      default:
        return Status::failure(StatusCode::internal_error,
          start + "CHOLMOD status " + std::to_string(this->common_.status));
    }
  }

  SparseSolver::Ordering ordering_;
  mutable cholmod_common common_{};
  std::shared_ptr<cholmod_factor> pattern_; // the analysis, shared by clones
  cholmod_factor* factor_ = nullptr; // numeric factor; null before the first factorization
  cholmod_dense* x_ = nullptr; // kept between solves to reuse its memory
  cholmod_dense* y_ = nullptr;
  cholmod_dense* e_ = nullptr;
  std::shared_ptr<const Supernodes> supernodes_;
  double nonzeros_ = 0.0;
  double operations_ = 0.0;
};
#endif
} // namespace

struct SparseSolver::Impl
{
  Options options;
  std::unique_ptr<Factorization> factorization; // null if the backend is not built in
  std::shared_ptr<Counters> counters = std::make_shared<Counters>();
  Index size = 0;
  Index nonzeros = 0;
};

SparseSolver::SparseSolver() : SparseSolver(Options()) {}

SparseSolver::SparseSolver(const Options& options) : impl_(new Impl)
{
  this->impl_->options = options;
  const bool cholmod = options.backend == Backend::cholmod ||
    (options.backend == Backend::automatic && SparseSolver::has_cholmod());
  if (!cholmod)
  {
    this->impl_->factorization = std::make_unique<EigenFactorization>();
  }
#ifdef BINDPOSE_HAS_CHOLMOD
  else
  {
    this->impl_->factorization = std::make_unique<CholmodFactorization>(options.ordering);
  }
#endif
}

SparseSolver::~SparseSolver() = default;
SparseSolver::SparseSolver(SparseSolver&&) noexcept = default;
SparseSolver& SparseSolver::operator=(SparseSolver&&) noexcept = default;

bool SparseSolver::has_cholmod()
{
#ifdef BINDPOSE_HAS_CHOLMOD
  return true;
#else
  return false;
#endif
}

std::string SparseSolver::blas_warning()
{
#ifdef BINDPOSE_HAS_CHOLMOD
  for (const char* fast :
    { "openblas_get_config", "MKL_Get_Version_String", "bli_info_get_version_str" })
  {
    if (dlsym(RTLD_DEFAULT, fast))
    {
      return {};
    }
  }
  return "the loaded BLAS may be slow (the reference BLAS is about 17 times slower than OpenBLAS); "
         "install libopenblas-pthread-dev";
#else
  return {};
#endif
}

const char* SparseSolver::backend_name() const
{
  return this->impl_->factorization ? this->impl_->factorization->name() : "cholmod";
}

Status SparseSolver::analyze(const SparseMatrix& matrix)
{
  if (!this->impl_->factorization)
  {
    return Status::failure(StatusCode::unavailable,
      "this build has no CHOLMOD; install the package libsuitesparse-dev and rebuild");
  }
  if (matrix.rows() != matrix.cols() || !matrix.isCompressed())
  {
    return Status::invalid_input("the matrix to factor must be square and compressed");
  }
  // METIS uses the random generator of the C library. Analyses never run concurrently, so that each
  // one is repeatable.
  static std::mutex serial_mutex;
  const std::lock_guard<std::mutex> lock(serial_mutex);
  this->impl_->size = matrix.rows();
  this->impl_->nonzeros = matrix.nonZeros();
  this->impl_->counters->analyses += 1;
  return this->impl_->factorization->analyze(matrix);
}

Status SparseSolver::factor(const SparseMatrix& matrix)
{
  if (matrix.rows() != this->impl_->size || matrix.nonZeros() != this->impl_->nonzeros ||
    this->impl_->counters->analyses == 0)
  {
    return Status::failure(StatusCode::internal_error,
      "the sparsity pattern of the matrix to factor differs from the analyzed pattern");
  }
  if (!this->impl_->factorization->has_factor())
  {
    Status status = check_memory("the factor of " + std::to_string(this->impl_->size) + " unknowns",
      this->factor_bytes(), this->impl_->options.memory_limit);
    if (!status.ok())
    {
      return status;
    }
  }
  this->impl_->counters->factorizations += 1;
  return this->impl_->factorization->factor(matrix);
}

Eigen::MatrixXd SparseSolver::solve(const Eigen::MatrixXd& rhs) const
{
  return rhs.size() ? this->impl_->factorization->solve(rhs) : rhs;
}

void SparseSolver::solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) const
{
  if (rhs.size() == 0)
  {
    x.resize(0);
    return;
  }
  this->impl_->factorization->solve(rhs, x);
}

SparseSolver SparseSolver::clone() const
{
  SparseSolver copy(this->impl_->options);
  copy.impl_->counters = this->impl_->counters;
  copy.impl_->size = this->impl_->size;
  copy.impl_->nonzeros = this->impl_->nonzeros;
  if (this->impl_->factorization)
  {
    copy.impl_->factorization = this->impl_->factorization->clone();
  }
  return copy;
}

std::shared_ptr<const Supernodes> SparseSolver::supernodes() const
{
  return this->impl_->factorization ? this->impl_->factorization->supernodes() : nullptr;
}

double SparseSolver::factor_bytes() const
{
  return this->impl_->factorization ? this->impl_->factorization->bytes() : 0.0;
}

Index SparseSolver::size() const
{
  return this->impl_->size;
}

double SparseSolver::factor_nonzeros() const
{
  return this->impl_->factorization ? this->impl_->factorization->nonzeros() : 0.0;
}

double SparseSolver::factor_operations() const
{
  return this->impl_->factorization ? this->impl_->factorization->operations() : 0.0;
}

Index SparseSolver::analyses() const
{
  return this->impl_->counters->analyses;
}

Index SparseSolver::factorizations() const
{
  return this->impl_->counters->factorizations;
}

} // namespace bindpose
