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
// otherwise rows with small entries would lose their digits in single precision. Most entries of a
// factor are tiny: without FlushDenormals a factorization would take five times as long.
#include "linear/float_cholesky.h"

#include "base/flush_denormals.h"
#include "linear/supernode_solve.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <numeric>

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
/// The supernodes of a factor and the tree of their fronts.
struct Fronts
{
  Supernodes nodes;
  std::vector<int> parent; // parent of each supernode; -1: no parent
  // Depth of each supernode below its root, modulo 2. This is the index of the stack that stores
  // the supernode's update matrix.
  std::vector<unsigned char> depth;
  std::size_t stack_size[2] = { 0, 0 }; // capacity of the two stacks, in floats

  int count() const { return static_cast<int>(this->parent.size()); }
  int size() const { return static_cast<int>(this->nodes.order.size()); }
  int columns(int s) const { return this->nodes.first_column[s + 1] - this->nodes.first_column[s]; }
  int rows(int s) const { return this->nodes.first_row[s + 1] - this->nodes.first_row[s]; }
  int rows_below(int s) const { return this->rows(s) - this->columns(s); }
  std::size_t update_size(int s) const
  {
    return static_cast<std::size_t>(this->rows_below(s)) *
      static_cast<std::size_t>(this->rows_below(s));
  }
  void measure_stacks();
};

/// Compute the members `depth` and `stack_size` from `nodes` and `parent`.
void Fronts::measure_stacks()
{
  const int count = this->count();
  this->depth.assign(static_cast<std::size_t>(count), 0);
  for (int s = count; s-- > 0;)
  {
    this->depth[s] = this->parent[s] < 0 ? 0 : !this->depth[this->parent[s]];
  }
  this->stack_size[0] = this->stack_size[1] = 0;
  std::size_t top[2] = { 0, 0 };
  // Number of floats in the update matrices of each supernode's children.
  std::vector<std::size_t> stored(static_cast<std::size_t>(count), 0);
  for (int s = 0; s < count; ++s)
  {
    const int own_stack = this->depth[s];
    top[own_stack] += this->update_size(s);
    this->stack_size[own_stack] = std::max(this->stack_size[own_stack], top[own_stack]);
    top[!own_stack] -= stored[s];
    if (this->parent[s] >= 0)
    {
      stored[this->parent[s]] += this->update_size(s);
    }
  }
}

/// The analysis, which all clones share.
struct Analysis
{
  Fronts fronts; // supernodes of the whole matrix
  std::vector<int> node_of_column;
  // Stored entries of the matrix, grouped by the step that eliminates their column. The entries of
  // a step begin at first_entry[step]. `entry` contains the index of each entry in the matrix, and
  // `entry_row` the step that eliminates its row.
  std::vector<int> first_entry;
  std::vector<int> entry;
  std::vector<int> entry_row;
  Index stored_entries = 0; // number of stored entries of the matrix
  std::atomic<Index> factorizations{ 0 };

  int size() const { return this->fronts.size(); }
};

/// The supernodes of a block (principal submatrix) of the matrix. Its unknowns are eliminated in
/// the same order as in the whole matrix.
struct BlockFronts
{
  Fronts fronts;
  // For each elimination step of the whole matrix, the step of the same unknown in the block; -1 if
  // the unknown is not in the block.
  std::vector<int> step_in_block;
  std::vector<int> step_in_whole; // inverse of step_in_block
};

/// Return a list of children for each node, and the list of the roots as the last entry. Each list
/// is in ascending order.
std::vector<std::vector<int>> children_of(const std::vector<int>& parent)
{
  std::vector<std::vector<int>> children(parent.size() + 1);
  for (std::size_t s = 0; s < parent.size(); ++s)
  {
    children[parent[s] < 0 ? parent.size() : static_cast<std::size_t>(parent[s])].push_back(
      static_cast<int>(s));
  }
  return children;
}

/// Return the nodes of a forest in postorder.
std::vector<int> postorder(const std::vector<int>& parent)
{
  const std::vector<std::vector<int>> children = children_of(parent);
  std::vector<int> reversed;
  std::vector<int> stack = children.back();
  while (!stack.empty())
  {
    const int s = stack.back();
    stack.pop_back();
    reversed.push_back(s);
    stack.insert(stack.end(), children[s].begin(), children[s].end());
  }
  return { reversed.rbegin(), reversed.rend() };
}

/// The supernodes that have a column in a block, in a postorder of the block's tree.
struct BlockTree
{
  std::vector<int> node; // index of each supernode in the whole factor
  std::vector<int> parent; // index of the parent in `node`; -1: no parent
};

/// Return the elimination tree of a block. Consider the rows of a supernode s that are below its
/// own columns and whose unknowns are in the block. The parent of s is the supernode that
/// eliminates the first of these rows. Reason: if row i is in the pattern of column j, all later
/// rows of column j are also in the pattern of column i. The rule is also correct if the parent of
/// s in the whole factor has no column in the block.
/// @param in_block  whether the unknown of a step is in the block
template <typename InBlock>
BlockTree tree_of_block(const Analysis& analysis, const InBlock& in_block)
{
  const Supernodes& nodes = analysis.fronts.nodes;
  std::vector<int> kept;
  std::vector<int> kept_of_node(static_cast<std::size_t>(analysis.fronts.count()), -1);
  for (int j = 0; j < analysis.size(); ++j)
  {
    const int s = analysis.node_of_column[j];
    if (in_block(j) && kept_of_node[s] < 0)
    {
      kept_of_node[s] = static_cast<int>(kept.size());
      kept.push_back(s);
    }
  }
  std::vector<int> parent;
  for (const int s : kept)
  {
    const auto begin = nodes.rows.begin() + nodes.first_row[s] + analysis.fronts.columns(s);
    const auto end = nodes.rows.begin() + nodes.first_row[s + 1];
    const auto row = std::find_if(begin, end, in_block);
    parent.push_back(row == end ? -1 : kept_of_node[analysis.node_of_column[*row]]);
  }
  const std::vector<int> sorted = postorder(parent);
  std::vector<int> rank(sorted.size());
  for (std::size_t i = 0; i < sorted.size(); ++i)
  {
    rank[sorted[i]] = static_cast<int>(i);
  }
  BlockTree tree;
  for (const int k : sorted)
  {
    tree.node.push_back(kept[k]);
    tree.parent.push_back(parent[k] < 0 ? -1 : rank[parent[k]]);
  }
  return tree;
}

/// Restrict the supernodes to the unknowns that are not excluded.
void restrict_fronts(
  const Analysis& analysis, const std::vector<char>& excluded, BlockFronts& block)
{
  const Supernodes& nodes = analysis.fronts.nodes;
  const auto in_block = [&](int step) { return !excluded[nodes.order[step]]; };
  BlockTree tree = tree_of_block(analysis, in_block);
  block = BlockFronts();
  block.step_in_block.assign(static_cast<std::size_t>(analysis.size()), -1);
  Supernodes& block_nodes = block.fronts.nodes;
  block_nodes.first_column.push_back(0);
  for (const int s : tree.node)
  {
    for (int j = nodes.first_column[s]; j < nodes.first_column[s + 1]; ++j)
    {
      if (in_block(j))
      {
        block.step_in_block[j] = static_cast<int>(block_nodes.order.size());
        block.step_in_whole.push_back(j);
        block_nodes.order.push_back(nodes.order[j]);
      }
    }
    block_nodes.first_column.push_back(static_cast<int>(block_nodes.order.size()));
  }
  block_nodes.first_row.push_back(0);
  for (const int s : tree.node)
  {
    for (int r = nodes.first_row[s]; r < nodes.first_row[s + 1]; ++r)
    {
      const int row = block.step_in_block[nodes.rows[r]];
      if (row >= 0)
      {
        block_nodes.rows.push_back(row);
      }
    }
    block_nodes.first_row.push_back(static_cast<int>(block_nodes.rows.size()));
  }
  block.fronts.parent = std::move(tree.parent);
  block_nodes.first_value.push_back(0);
  for (int s = 0; s < block.fronts.count(); ++s)
  {
    block_nodes.first_value.push_back(
      block_nodes.first_value.back() + block.fronts.columns(s) * block.fronts.rows(s));
  }
  block.fronts.measure_stacks();
}

Status wrong_pattern()
{
  return Status::failure(StatusCode::internal_error,
    "the sparsity pattern of the matrix to factor differs from the analyzed pattern");
}

/// Consecutive rows of an update matrix that are also consecutive in the parent's front.
struct RowRun
{
  int from = 0;
  int to = 0;
  int length = 0;
};
} // namespace

struct FloatCholesky::Impl
{
  std::shared_ptr<Analysis> analysis;
  BlockFronts block_fronts; // supernodes of the block in the last factor_block()
  bool is_block = false; // whether the last factorization is that of a block
  std::vector<float> values;
  std::vector<float> stack[2];
  std::size_t top[2] = { 0, 0 };
  std::vector<int> stacked_supernodes[2]; // supernodes whose update matrices are on the stacks
  // For each step of elimination, the index of its row in the front that is being assembled.
  std::vector<int> front_index_of_row;
  std::vector<RowRun> runs;
  Eigen::VectorXd scale; // 1 / sqrt(diagonal entry), per unknown

  const Fronts& fronts() const
  {
    return this->is_block ? this->block_fronts.fronts : this->analysis->fronts;
  }
  Status factor(const ExecutionContext& context, const SparseMatrix& matrix, double shift);
  void scatter(const SparseMatrix& matrix, double shift, int s);
  int eliminate(const SparseMatrix& matrix, double shift, int s);
  void find_runs(int child, int columns);
  void solve(const double* rhs, int columns, double* x) const;
};

FloatCholesky::FloatCholesky() : impl_(new Impl) {}
FloatCholesky::~FloatCholesky() = default;
FloatCholesky::FloatCholesky(FloatCholesky&&) noexcept = default;
FloatCholesky& FloatCholesky::operator=(FloatCholesky&&) noexcept = default;

bool FloatCholesky::is_analyzed() const
{
  return this->impl_->analysis != nullptr;
}

FloatCholesky FloatCholesky::clone() const
{
  FloatCholesky copy;
  copy.impl_->analysis = this->impl_->analysis;
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
  const Analysis* analysis = this->impl_->analysis.get();
  return analysis ? sizeof(float) * static_cast<double>(analysis->fronts.nodes.first_value.back())
                  : 0.0;
}

double FloatCholesky::workspace_bytes() const
{
  const Analysis* analysis = this->impl_->analysis.get();
  return analysis ? sizeof(float) *
      static_cast<double>(analysis->fronts.stack_size[0] + analysis->fronts.stack_size[1])
                  : 0.0;
}

Index FloatCholesky::factorizations() const
{
  return this->impl_->analysis ? this->impl_->analysis->factorizations.load() : 0;
}

Status FloatCholesky::analyze(const SparseSolver& solver, const SparseMatrix& matrix)
{
  this->impl_ = std::make_unique<Impl>();
  const std::shared_ptr<const Supernodes> found = solver.supernodes();
  if (!found)
  {
    return Status::failure(StatusCode::unavailable,
      "the factorization in single precision needs a supernodal factor of CHOLMOD");
  }
  auto analysis = std::make_shared<Analysis>();
  analysis->fronts.nodes = *found;
  const Supernodes& nodes = analysis->fronts.nodes;
  const int n = analysis->size();
  if (matrix.rows() != n || matrix.cols() != n || !matrix.isCompressed())
  {
    return wrong_pattern();
  }
  const auto count = static_cast<int>(nodes.first_column.size()) - 1;
  analysis->node_of_column.resize(static_cast<std::size_t>(n));
  for (int s = 0; s < count; ++s)
  {
    for (int j = nodes.first_column[s]; j < nodes.first_column[s + 1]; ++j)
    {
      analysis->node_of_column[j] = s;
    }
  }
  analysis->fronts.parent.assign(static_cast<std::size_t>(count), -1);
  for (int s = 0; s < count; ++s)
  {
    const int next_row = nodes.first_row[s] + nodes.first_column[s + 1] - nodes.first_column[s];
    if (next_row < nodes.first_row[s + 1])
    {
      analysis->fronts.parent[s] = analysis->node_of_column[nodes.rows[next_row]];
    }
  }
  analysis->fronts.measure_stacks();

  std::vector<int> step_of(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i)
  {
    step_of[nodes.order[i]] = i;
  }
  analysis->first_entry.assign(static_cast<std::size_t>(n) + 1, 0);
  std::vector<int> column_of_entry(static_cast<std::size_t>(matrix.nonZeros()), -1);
  for (int j = 0; j < n; ++j)
  {
    for (int k = matrix.outerIndexPtr()[j]; k < matrix.outerIndexPtr()[j + 1]; ++k)
    {
      const int i = matrix.innerIndexPtr()[k];
      if (i < j)
      {
        continue;
      }
      const int column = std::min(step_of[i], step_of[j]);
      const int row = std::max(step_of[i], step_of[j]);
      const int s = analysis->node_of_column[column];
      const int* begin = nodes.rows.data() + nodes.first_row[s];
      const int* end = nodes.rows.data() + nodes.first_row[s + 1];
      if (!std::binary_search(begin, end, row))
      {
        return wrong_pattern();
      }
      column_of_entry[k] = column;
      analysis->first_entry[column + 1] += 1;
    }
  }
  std::partial_sum(
    analysis->first_entry.begin(), analysis->first_entry.end(), analysis->first_entry.begin());
  analysis->entry.resize(static_cast<std::size_t>(analysis->first_entry.back()));
  analysis->entry_row.resize(analysis->entry.size());
  std::vector<int> next(analysis->first_entry.begin(), analysis->first_entry.end() - 1);
  for (int j = 0; j < n; ++j)
  {
    for (int k = matrix.outerIndexPtr()[j]; k < matrix.outerIndexPtr()[j + 1]; ++k)
    {
      if (column_of_entry[k] >= 0)
      {
        const int at = next[column_of_entry[k]]++;
        analysis->entry[at] = k;
        analysis->entry_row[at] = std::max(step_of[matrix.innerIndexPtr()[k]], step_of[j]);
      }
    }
  }
  analysis->stored_entries = matrix.nonZeros();
  this->impl_->analysis = std::move(analysis);
  return {};
}

#ifdef BINDPOSE_HAS_CHOLMOD
/// Write the entries of the scaled matrix to the block of a supernode's columns. The caller must
/// have set front_index_of_row for the rows of this supernode.
void FloatCholesky::Impl::scatter(const SparseMatrix& matrix, double shift, int s)
{
  const Analysis& shared = *this->analysis;
  const std::vector<int>& order = shared.fronts.nodes.order;
  const Fronts& fronts = this->fronts();
  const auto rows = static_cast<std::size_t>(fronts.rows(s));
  float* block = this->values.data() + fronts.nodes.first_value[s];
  std::fill(block, block + rows * static_cast<std::size_t>(fronts.columns(s)), 0.0F);
  for (int c = 0; c < fronts.columns(s); ++c)
  {
    const int step = fronts.nodes.first_column[s] + c;
    const int column = this->is_block ? this->block_fronts.step_in_whole[step] : step;
    for (int e = shared.first_entry[column]; e < shared.first_entry[column + 1]; ++e)
    {
      const int factor_step = shared.entry_row[e];
      const int row = this->is_block ? this->block_fronts.step_in_block[factor_step] : factor_step;
      if (row < 0)
      {
        continue;
      }
      const double value = matrix.valuePtr()[shared.entry[e]] * this->scale[order[factor_step]] *
        this->scale[order[column]];
      block[static_cast<std::size_t>(c) * rows +
        static_cast<std::size_t>(this->front_index_of_row[row])] =
        static_cast<float>(factor_step == column ? value + shift * std::abs(value) : value);
    }
  }
}

/// Divide the rows of a child's update matrix into runs of rows that are also consecutive in the
/// front. The first `columns` rows of the front belong to the block of the supernode's own columns.
/// No run extends across the end of these rows.
void FloatCholesky::Impl::find_runs(int child, int columns)
{
  const Fronts& fronts = this->fronts();
  const int* row = fronts.nodes.rows.data() + fronts.nodes.first_row[child] + fronts.columns(child);
  this->runs.clear();
  for (int i = 0; i < fronts.rows_below(child); ++i)
  {
    const int to = this->front_index_of_row[row[i]];
    if (this->runs.empty() || to != this->runs.back().to + this->runs.back().length ||
      to == columns)
    {
      this->runs.push_back({ i, to, 0 });
    }
    this->runs.back().length += 1;
  }
}

/// Eliminate one supernode.
/// @return 0 on success. If a pivot is not positive, return the pivot's column in the block,
/// counted from 1.
int FloatCholesky::Impl::eliminate(const SparseMatrix& matrix, double shift, int s)
{
  const FlushDenormals flush;
  const Fronts& shared = this->fronts();
  const Supernodes& nodes = shared.nodes;
  const int columns = shared.columns(s);
  const int rows = shared.rows(s);
  const int below_count = shared.rows_below(s);
  const int* row = nodes.rows.data() + nodes.first_row[s];
  float* block = this->values.data() + nodes.first_value[s];
  for (int i = 0; i < rows; ++i)
  {
    this->front_index_of_row[row[i]] = i;
  }
  this->scatter(matrix, shift, s);
  const int own_stack = shared.depth[s];
  float* update_matrix = this->stack[own_stack].data() + this->top[own_stack];
  std::vector<int>& children = this->stacked_supernodes[!own_stack];
  std::size_t& end_of_children = this->top[!own_stack];

  const float one = 1.0F;
  const float minus_one = -1.0F;
  // The first columns of a child's update matrix belong to the block and are added now. The
  // remaining columns are added after this supernode's own update matrix has been computed.
  const auto add_children = [&](bool is_first_pass)
  {
    std::size_t at = end_of_children;
    for (auto child = children.rbegin(); child != children.rend() && shared.parent[*child] == s;
         ++child)
    {
      at -= shared.update_size(*child);
      const float* update = this->stack[!own_stack].data() + at;
      const auto size = static_cast<std::size_t>(shared.rows_below(*child));
      this->find_runs(*child, columns);
      for (std::size_t k = 0; k < this->runs.size(); ++k)
      {
        const RowRun& column_run = this->runs[k];
        if ((column_run.to < columns) != is_first_pass)
        {
          continue;
        }
        for (int c = 0; c < column_run.length; ++c)
        {
          const float* from = update + static_cast<std::size_t>(column_run.from + c) * size;
          const int column = column_run.to + c;
          float* target_column = is_first_pass
            ? block + static_cast<std::size_t>(column) * rows
            : update_matrix + static_cast<std::size_t>(column - columns) * below_count - columns;
          for (int i = c; i < column_run.length; ++i)
          {
            target_column[column_run.to + i] += from[column_run.from + i];
          }
          for (std::size_t r = k + 1; r < this->runs.size(); ++r)
          {
            const RowRun& run = this->runs[r];
            float* to = target_column + run.to;
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
    ssyrk_("L", "N", &below_count, &columns, &minus_one, block + columns, &rows, &zero,
      update_matrix, &below_count);
    add_children(false);
  }
  while (!children.empty() && shared.parent[children.back()] == s)
  {
    end_of_children -= shared.update_size(children.back());
    children.pop_back();
  }
  if (below_count > 0)
  {
    this->top[own_stack] += shared.update_size(s);
    this->stacked_supernodes[own_stack].push_back(s);
  }
  return 0;
}

Status FloatCholesky::Impl::factor(
  const ExecutionContext& context, const SparseMatrix& matrix, double shift)
{
  const Fronts& fronts = this->fronts();
  this->analysis->factorizations += 1;
  this->values.resize(static_cast<std::size_t>(fronts.nodes.first_value.back()) + factor_padding);
  for (const int k : { 0, 1 })
  {
    this->stack[k].resize(std::max(this->stack[k].size(), fronts.stack_size[k]));
    this->top[k] = 0;
    this->stacked_supernodes[k].clear();
  }
  this->front_index_of_row.resize(static_cast<std::size_t>(this->analysis->size()));
  this->scale.resize(this->analysis->size());
  for (int j = 0; j < this->analysis->size(); ++j)
  {
    const double diagonal = matrix.coeff(j, j);
    // If a diagonal entry is not positive, the factorization fails at its pivot.
    this->scale[j] = diagonal > 0.0 ? 1.0 / std::sqrt(diagonal) : 1.0;
  }
  const SerialBlas serial;
  for (int s = 0; s < fronts.count(); ++s)
  {
    if (context.canceled())
    {
      return Status::canceled();
    }
    const int failed_column = this->eliminate(matrix, shift, s);
    if (failed_column)
    {
      const int unknown = fronts.nodes.order[fronts.nodes.first_column[s] + failed_column - 1];
      return Status::invalid_input(
        "the matrix is not positive definite in single precision: the pivot of unknown " +
        std::to_string(unknown) + " is not positive");
    }
  }
  return {};
}
#else
void FloatCholesky::Impl::scatter(const SparseMatrix&, double, int) {}
int FloatCholesky::Impl::eliminate(const SparseMatrix&, double, int)
{
  return 0;
}
void FloatCholesky::Impl::find_runs(int, int) {}
Status FloatCholesky::Impl::factor(const ExecutionContext&, const SparseMatrix&, double)
{
  return Status::failure(StatusCode::unavailable, "this build has no BLAS");
}
#endif

bool FloatCholesky::has_pattern_of(const SparseMatrix& matrix) const
{
  const Analysis* analysis = this->impl_->analysis.get();
  return analysis && matrix.rows() == analysis->size() &&
    matrix.nonZeros() == analysis->stored_entries;
}

Status FloatCholesky::factor(
  const ExecutionContext& context, const SparseMatrix& matrix, double shift)
{
  if (!this->has_pattern_of(matrix))
  {
    return wrong_pattern();
  }
  this->impl_->is_block = false;
  return this->impl_->factor(context, matrix, shift);
}

Status FloatCholesky::factor_block(
  const ExecutionContext& context, const SparseMatrix& matrix, const std::vector<char>& excluded)
{
  if (!this->has_pattern_of(matrix) || static_cast<Index>(excluded.size()) != matrix.rows())
  {
    return wrong_pattern();
  }
  restrict_fronts(*this->impl_->analysis, excluded, this->impl_->block_fronts);
  this->impl_->is_block = true;
  return this->impl_->factor(context, matrix, 0.0);
}

/// Solve for several columns. rhs and x are #unknowns x columns, column-major.
void FloatCholesky::Impl::solve(const double* rhs, int columns, double* x) const
{
  const FlushDenormals flush;
  const Supernodes& nodes = this->fronts().nodes;
  const std::vector<int>& order = nodes.order;
  const std::size_t count = order.size();
  const auto n = static_cast<std::size_t>(this->analysis->size());
  std::vector<float> scaled;
  std::array<double, maximum_solve_columns> factor{};
  for (int done = 0; done < columns;)
  {
    const int left = columns - done;
    const int width = left == 1 ? 1 : left <= 4 ? 4 : maximum_solve_columns;
    const int used_columns = std::min(left, width);
    const auto stride = static_cast<std::size_t>(width);
    scaled.assign(count * stride, 0.0F);
    for (int c = 0; c < used_columns; ++c)
    {
      const double* from = rhs + static_cast<std::size_t>(done + c) * n;
      double size = 0.0;
      bool finite = true;
      for (const int i : order)
      {
        const double value = std::abs(from[i] * this->scale[i]);
        size = std::max(size, value);
        finite = finite && std::isfinite(value);
      }
      // Divide each right-hand side by its largest absolute entry, so that all entries are within
      // the range of floats.
      factor[c] = size > 0.0 && finite ? size : 1.0;
      float* target_column = scaled.data() + c;
      for (std::size_t i = 0; i < count; ++i)
      {
        target_column[i * stride] =
          static_cast<float>(from[order[i]] * this->scale[order[i]] / factor[c]);
      }
    }
    solve_with_supernodes(nodes, this->values.data(), scaled.data(), width);
    for (int c = 0; c < used_columns; ++c)
    {
      const float* from = scaled.data() + c;
      double* target_column = x + static_cast<std::size_t>(done + c) * n;
      if (count < n)
      {
        std::fill(target_column, target_column + n, 0.0); // the solution is 0 for excluded unknowns
      }
      for (std::size_t i = 0; i < count; ++i)
      {
        target_column[order[i]] =
          factor[c] * static_cast<double>(from[i * stride]) * this->scale[order[i]];
      }
    }
    done += used_columns;
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
