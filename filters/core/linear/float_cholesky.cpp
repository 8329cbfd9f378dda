// Multifrontal Cholesky factorization in single precision (Duff and Reid 1983).
//
// Supernodes are groups of consecutive columns with the same pattern. They are eliminated one after
// another, children before parents. Each supernode has a dense matrix called the front. The front
// consists of two parts. The block of the supernode's own columns becomes part of the factor. The
// update matrix of the rows below the block is passed to the parent. Each supernode takes three
// steps:
// 1. The supernode's columns of the matrix and the columns of its children's update matrices are
//    added up.
// 2. The block is factored: spotrf on the square at the top, strsm on the rows below.
// 3. The update matrix is computed: minus the product of the rows below with their transpose
//    (ssyrk), plus the remaining columns of the children's update matrices.
//
// There are two stacks of update matrices, one for even and one for odd depth. Supernodes are in
// postorder. Therefore the children's matrices are on top of their stack when the parent needs
// them, and the parent's matrix is pushed onto the other stack.
//
// Compared with CHOLMOD's own method (left-looking, double precision), there are fewer and larger
// products, and the factor takes half the memory. The matrix is scaled to a unit diagonal, because
// otherwise rows with small entries would lose their digits in single precision.
#include "linear/float_cholesky.h"

#include "linear/supernode_solve.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>

#ifdef BINDPOSE_HAS_CHOLMOD
#include "linear/serial_blas.h"

// NOLINTBEGIN(readability-identifier-naming): these are the names of LAPACK and BLAS functions
extern "C"
{
  void spotrf_(const char* uplo, const int* n, float* a, const int* lda, int* info);
  void strsm_(const char* side, const char* uplo, const char* trans, const char* diag, const int* m,
    const int* n, const float* alpha, const float* a, const int* lda, float* b, const int* ldb);
  void ssyrk_(const char* uplo, const char* trans, const int* n, const int* k, const float* alpha,
    const float* a, const int* lda, const float* beta, float* c, const int* ldc);
}
// NOLINTEND(readability-identifier-naming)
#endif

namespace bindpose
{

namespace
{
/// The analysis, which all clones share.
struct Plan
{
  std::shared_ptr<const Supernodes> nodes;
  std::vector<int> parent; // parent of each supernode; -1: no parent
  std::vector<int> position; // per stored entry of the matrix: its index in the factor's values
  // Depth of each supernode below its root, modulo 2. This is the index of the stack that stores
  // the supernode's update matrix.
  std::vector<unsigned char> depth;
  std::size_t stack_size[2] = { 0, 0 }; // capacity of the two stacks, in floats
  std::atomic<Index> factorizations{ 0 };

  int count() const { return static_cast<int>(this->parent.size()); }
  int size() const { return static_cast<int>(this->nodes->order.size()); }
  int columns(int s) const
  {
    return this->nodes->first_column[s + 1] - this->nodes->first_column[s];
  }
  int rows(int s) const { return this->nodes->first_row[s + 1] - this->nodes->first_row[s]; }
  int below(int s) const { return this->rows(s) - this->columns(s); }
  std::size_t update_size(int s) const
  {
    return static_cast<std::size_t>(this->below(s)) * static_cast<std::size_t>(this->below(s));
  }
};

/// Consecutive rows of an update matrix that are also consecutive in the parent's front.
struct Run
{
  int from = 0;
  int to = 0;
  int length = 0;
};
} // namespace

struct FloatCholesky::Impl
{
  std::shared_ptr<Plan> plan;
  std::vector<float> values;
  std::vector<float> stack[2];
  std::size_t top[2] = { 0, 0 };
  std::vector<int> waiting[2]; // supernodes whose update matrices are on the stacks
  // Per row of the matrix: its index in the front that is being assembled.
  std::vector<int> row_in_front;
  std::vector<Run> runs;
  Eigen::VectorXd scale; // 1 / sqrt(diagonal entry), per unknown

  void scatter(const SparseMatrix& matrix, double shift);
  int eliminate(int s);
  void find_runs(int child, int columns);
  void solve(const double* rhs, int columns, double* x) const;
};

FloatCholesky::FloatCholesky() : impl_(new Impl) {}
FloatCholesky::~FloatCholesky() = default;
FloatCholesky::FloatCholesky(FloatCholesky&&) noexcept = default;
FloatCholesky& FloatCholesky::operator=(FloatCholesky&&) noexcept = default;

bool FloatCholesky::analyzed() const
{
  return this->impl_->plan != nullptr;
}

FloatCholesky FloatCholesky::clone() const
{
  FloatCholesky copy;
  copy.impl_->plan = this->impl_->plan;
  return copy;
}

void FloatCholesky::release_workspace()
{
  for (std::vector<float>& stack : this->impl_->stack)
  {
    std::vector<float>().swap(stack);
  }
}

double FloatCholesky::factor_bytes() const
{
  const Plan* plan = this->impl_->plan.get();
  return plan ? sizeof(float) * static_cast<double>(plan->nodes->first_value.back()) : 0.0;
}

double FloatCholesky::workspace_bytes() const
{
  const Plan* plan = this->impl_->plan.get();
  return plan ? sizeof(float) * static_cast<double>(plan->stack_size[0] + plan->stack_size[1])
              : 0.0;
}

Index FloatCholesky::factorizations() const
{
  return this->impl_->plan ? this->impl_->plan->factorizations.load() : 0;
}

Status FloatCholesky::analyze(const SparseSolver& solver, const SparseMatrix& matrix)
{
  this->impl_ = std::make_unique<Impl>();
  auto plan = std::make_shared<Plan>();
  plan->nodes = solver.supernodes();
  if (!plan->nodes)
  {
    return Status::failure(StatusCode::unavailable,
      "the factorization in single precision needs a supernodal factor of CHOLMOD");
  }
  const Supernodes& nodes = *plan->nodes;
  const int n = plan->size();
  if (matrix.rows() != n || matrix.cols() != n || !matrix.isCompressed())
  {
    return Status::failure(StatusCode::internal_error,
      "the sparsity pattern of the matrix to factor differs from the analyzed pattern");
  }
  const auto count = static_cast<int>(nodes.first_column.size()) - 1;
  std::vector<int> node_of_column(static_cast<std::size_t>(n));
  for (int s = 0; s < count; ++s)
  {
    for (int j = nodes.first_column[s]; j < nodes.first_column[s + 1]; ++j)
    {
      node_of_column[j] = s;
    }
  }
  plan->parent.assign(static_cast<std::size_t>(count), -1);
  for (int s = 0; s < count; ++s)
  {
    if (plan->rows(s) > plan->columns(s))
    {
      plan->parent[s] = node_of_column[nodes.rows[nodes.first_row[s] + plan->columns(s)]];
    }
  }
  plan->depth.assign(static_cast<std::size_t>(count), 0);
  for (int s = count; s-- > 0;)
  {
    plan->depth[s] = plan->parent[s] < 0 ? 0 : !plan->depth[plan->parent[s]];
  }
  std::size_t top[2] = { 0, 0 };
  // Number of floats in the update matrices of each supernode's children.
  std::vector<std::size_t> held(static_cast<std::size_t>(count), 0);
  for (int s = 0; s < count; ++s)
  {
    const int mine = plan->depth[s];
    top[mine] += plan->update_size(s);
    plan->stack_size[mine] = std::max(plan->stack_size[mine], top[mine]);
    top[!mine] -= held[s];
    if (plan->parent[s] >= 0)
    {
      held[plan->parent[s]] += plan->update_size(s);
    }
  }

  std::vector<int> elimination(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i)
  {
    elimination[nodes.order[i]] = i;
  }
  plan->position.assign(static_cast<std::size_t>(matrix.nonZeros()), -1);
  for (int j = 0; j < n; ++j)
  {
    for (int k = matrix.outerIndexPtr()[j]; k < matrix.outerIndexPtr()[j + 1]; ++k)
    {
      const int i = matrix.innerIndexPtr()[k];
      if (i < j)
      {
        continue;
      }
      const int column = std::min(elimination[i], elimination[j]);
      const int row = std::max(elimination[i], elimination[j]);
      const int s = node_of_column[column];
      const int* begin = nodes.rows.data() + nodes.first_row[s];
      const int* end = nodes.rows.data() + nodes.first_row[s + 1];
      const int* at = std::lower_bound(begin, end, row);
      if (at == end || *at != row)
      {
        return Status::failure(StatusCode::internal_error,
          "the sparsity pattern of the matrix to factor differs from the analyzed pattern");
      }
      plan->position[k] = nodes.first_value[s] + (column - nodes.first_column[s]) * plan->rows(s) +
        static_cast<int>(at - begin);
    }
  }
  this->impl_->plan = std::move(plan);
  return {};
}

#ifdef BINDPOSE_HAS_CHOLMOD
/// Write the entries of the scaled matrix to the blocks of the factor.
void FloatCholesky::Impl::scatter(const SparseMatrix& matrix, double shift)
{
  const int n = this->plan->size();
  this->scale.resize(n);
  for (int j = 0; j < n; ++j)
  {
    const double diagonal = matrix.coeff(j, j);
    // If a diagonal entry is not positive, the factorization fails at its pivot.
    this->scale[j] = diagonal > 0.0 ? 1.0 / std::sqrt(diagonal) : 1.0;
  }
  std::fill(this->values.begin(), this->values.end(), 0.0F);
  for (int j = 0; j < n; ++j)
  {
    for (int k = matrix.outerIndexPtr()[j]; k < matrix.outerIndexPtr()[j + 1]; ++k)
    {
      const int i = matrix.innerIndexPtr()[k];
      const double value = matrix.valuePtr()[k] * this->scale[i] * this->scale[j];
      if (i >= j)
      {
        this->values[this->plan->position[k]] =
          static_cast<float>(i == j ? value + shift * std::abs(value) : value);
      }
    }
  }
}

/// Find the rows of the front to which a child's update matrix is added. A run is either within the
/// columns of the block or within the rows below.
void FloatCholesky::Impl::find_runs(int child, int columns)
{
  const int* row = this->plan->nodes->rows.data() + this->plan->nodes->first_row[child] +
    this->plan->columns(child);
  this->runs.clear();
  for (int i = 0; i < this->plan->below(child); ++i)
  {
    const int to = this->row_in_front[row[i]];
    if (this->runs.empty() || to != this->runs.back().to + this->runs.back().length ||
      to == columns)
    {
      this->runs.push_back({ i, to, 0 });
    }
    this->runs.back().length += 1;
  }
}

/// Eliminate one supernode.
/// @return 0, or the 1-based column of the block whose pivot is not positive.
int FloatCholesky::Impl::eliminate(int s)
{
  const Plan& shared = *this->plan;
  const Supernodes& nodes = *shared.nodes;
  const int columns = shared.columns(s);
  const int rows = shared.rows(s);
  const int below_count = shared.below(s);
  const int* row = nodes.rows.data() + nodes.first_row[s];
  float* block = this->values.data() + nodes.first_value[s];
  for (int i = 0; i < rows; ++i)
  {
    this->row_in_front[row[i]] = i;
  }
  const int stack_of_mine = shared.depth[s];
  float* mine = this->stack[stack_of_mine].data() + this->top[stack_of_mine];
  std::vector<int>& children = this->waiting[!stack_of_mine];
  std::size_t& end_of_children = this->top[!stack_of_mine];

  const float one = 1.0F;
  const float minus_one = -1.0F;
  // The first columns of a child's update matrix belong to the block and are added now. The
  // remaining columns are added after this supernode's own update matrix has been computed.
  const auto add_children = [&](bool now)
  {
    std::size_t at = end_of_children;
    for (auto child = children.rbegin(); child != children.rend() && shared.parent[*child] == s;
         ++child)
    {
      at -= shared.update_size(*child);
      const float* update = this->stack[!stack_of_mine].data() + at;
      const auto size = static_cast<std::size_t>(shared.below(*child));
      this->find_runs(*child, columns);
      for (std::size_t k = 0; k < this->runs.size(); ++k)
      {
        const Run& column_run = this->runs[k];
        if ((column_run.to < columns) != now)
        {
          continue;
        }
        for (int c = 0; c < column_run.length; ++c)
        {
          const float* from = update + static_cast<std::size_t>(column_run.from + c) * size;
          const int column = column_run.to + c;
          float* into = now
            ? block + static_cast<std::size_t>(column) * rows
            : mine + static_cast<std::size_t>(column - columns) * below_count - columns;
          for (int i = c; i < column_run.length; ++i)
          {
            into[column_run.to + i] += from[column_run.from + i];
          }
          for (std::size_t r = k + 1; r < this->runs.size(); ++r)
          {
            const Run& run = this->runs[r];
            float* to = into + run.to;
            const float* source = from + run.from;
            for (int i = 0; i < run.length; ++i)
            {
              to[i] += source[i];
            }
          }
        }
      }
    }
  };
  add_children(true);

  int info = 0;
  spotrf_("L", &columns, block, &rows, &info);
  if (info != 0)
  {
    return info;
  }
  for (int j = 0; j < columns; ++j)
  {
    // LAPACK does not detect NaN.
    const float pivot = block[static_cast<std::size_t>(j) * rows + j];
    if (!(pivot > 0.0F) || !std::isfinite(pivot))
    {
      return j + 1;
    }
  }
  if (below_count > 0)
  {
    const float zero = 0.0F;
    strsm_("R", "L", "T", "N", &below_count, &columns, &one, block, &rows, block + columns, &rows);
    ssyrk_("L", "N", &below_count, &columns, &minus_one, block + columns, &rows, &zero, mine,
      &below_count);
    add_children(false);
  }
  while (!children.empty() && shared.parent[children.back()] == s)
  {
    end_of_children -= shared.update_size(children.back());
    children.pop_back();
  }
  if (below_count > 0)
  {
    this->top[stack_of_mine] += shared.update_size(s);
    this->waiting[stack_of_mine].push_back(s);
  }
  return 0;
}

Status FloatCholesky::factor(
  const ExecutionContext& context, const SparseMatrix& matrix, double shift)
{
  Impl& impl = *this->impl_;
  if (!impl.plan || matrix.rows() != impl.plan->size() ||
    matrix.nonZeros() != static_cast<Index>(impl.plan->position.size()))
  {
    return Status::failure(StatusCode::internal_error,
      "the sparsity pattern of the matrix to factor differs from the analyzed pattern");
  }
  Plan& plan = *impl.plan;
  plan.factorizations += 1;
  impl.values.resize(static_cast<std::size_t>(plan.nodes->first_value.back()));
  for (const int k : { 0, 1 })
  {
    impl.stack[k].resize(plan.stack_size[k]);
    impl.top[k] = 0;
    impl.waiting[k].clear();
  }
  impl.row_in_front.resize(static_cast<std::size_t>(plan.size()));
  impl.scatter(matrix, shift);
  const SerialBlas serial;
  for (int s = 0; s < plan.count(); ++s)
  {
    if (context.canceled())
    {
      return Status::canceled();
    }
    const int failed = impl.eliminate(s);
    if (failed)
    {
      const int unknown = plan.nodes->order[plan.nodes->first_column[s] + failed - 1];
      return Status::invalid_input(
        "the matrix is not positive definite in single precision: the pivot of unknown " +
        std::to_string(unknown) + " is not positive");
    }
  }
  return {};
}
#else
void FloatCholesky::Impl::scatter(const SparseMatrix&, double) {}
int FloatCholesky::Impl::eliminate(int)
{
  return 0;
}
void FloatCholesky::Impl::find_runs(int, int) {}
Status FloatCholesky::factor(const ExecutionContext&, const SparseMatrix&, double)
{
  return Status::failure(StatusCode::unavailable, "this build has no BLAS");
}
#endif

/// Solve for several columns. rhs and x are #unknowns x columns, column-major.
void FloatCholesky::Impl::solve(const double* rhs, int columns, double* x) const
{
  const std::vector<int>& order = this->plan->nodes->order;
  const std::size_t n = order.size();
  std::vector<float> scaled;
  std::array<double, most_solve_columns> factor{};
  for (int done = 0; done < columns;)
  {
    const int left = columns - done;
    const int width = left == 1 ? 1 : left <= 4 ? 4 : most_solve_columns;
    const int wanted = std::min(left, width);
    const auto stride = static_cast<std::size_t>(width);
    scaled.assign(n * stride, 0.0F);
    for (int c = 0; c < wanted; ++c)
    {
      const double* from = rhs + static_cast<std::size_t>(done + c) * n;
      double size = 0.0;
      bool finite = true;
      for (std::size_t i = 0; i < n; ++i)
      {
        const double value = std::abs(from[i] * this->scale[static_cast<Eigen::Index>(i)]);
        size = std::max(size, value);
        finite = finite && std::isfinite(value);
      }
      // Divide each right-hand side by its largest absolute entry, so that all entries are within
      // the range of floats.
      factor[c] = size > 0.0 && finite ? size : 1.0;
      float* into = scaled.data() + c;
      for (std::size_t i = 0; i < n; ++i)
      {
        into[i * stride] = static_cast<float>(from[order[i]] * this->scale[order[i]] / factor[c]);
      }
    }
    solve_with_supernodes(*this->plan->nodes, this->values.data(), scaled.data(), width);
    for (int c = 0; c < wanted; ++c)
    {
      const float* from = scaled.data() + c;
      double* into = x + static_cast<std::size_t>(done + c) * n;
      for (std::size_t i = 0; i < n; ++i)
      {
        into[order[i]] = factor[c] * static_cast<double>(from[i * stride]) * this->scale[order[i]];
      }
    }
    done += wanted;
  }
}

void FloatCholesky::solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) const
{
  x.resize(rhs.size());
  this->impl_->solve(rhs.data(), 1, x.data());
}

void FloatCholesky::solve(const Eigen::MatrixXd& rhs, Eigen::MatrixXd& x) const
{
  x.resize(rhs.rows(), rhs.cols());
  this->impl_->solve(rhs.data(), static_cast<int>(rhs.cols()), x.data());
}

} // namespace bindpose
