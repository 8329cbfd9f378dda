#ifndef bindpose_qp_pair_rows_h
#define bindpose_qp_pair_rows_h

#include "base/status.h"
#include "qp/column_problem.h"

#include <vector>

namespace bindpose
{

/// The ordered pairs of one column as constraints B x + h >= 0 on the free vertices. A row of B
/// contains 1 for the `high` vertex of its pair and -1 for the `low` vertex. The constant h
/// contains the given values and the minimum difference of the pair. Pairs of two given values have
/// no row.
class PairRows
{
public:
  PairRows(const SplitForm& matrices, const ColumnProblem& problem, const BoxQpColumn& column);

  /// Find the rows and sort the pairs. This must succeed before any other function is called.
  /// Return internal_error if a pair is not an entry of Q or if the pairs have a cycle.
  Status prepare();

  Index count() const { return static_cast<Index>(this->rows_.size()); }
  const Eigen::VectorXd& constants() const { return this->constants_; } ///< h, one entry per row

  /// Return B x, one entry per row.
  Eigen::VectorXd apply(const Eigen::VectorXd& x) const;
  /// Add B' y to x.
  void add_transposed(const Eigen::Ref<const Eigen::VectorXd>& y, Eigen::VectorXd& x) const;
  /// Add B' diag(weights) B p to y. p and y have one row per free vertex and any number of columns.
  void add_product(const Eigen::VectorXd& weights, const Eigen::Ref<const Eigen::MatrixXd>& p,
    Eigen::Ref<Eigen::MatrixXd> y) const;
  /// Add B' diag(weights) B to the values of a matrix with the pattern of SplitForm::lower.
  void add_to_matrix(const Eigen::Ref<const Eigen::VectorXd>& weights, SparseMatrix& matrix) const;
  /// Add the diagonal of B' diag(weights) B.
  void add_diagonal(const Eigen::VectorXd& weights, Eigen::VectorXd& diagonal) const;
  /// Return, for each row, the smallest diagonal entry of A at the free vertices of the row.
  Eigen::VectorXd smallest_diagonals() const;

  /// Convert multipliers from one entry per row to one entry per pair of the column.
  Eigen::VectorXd extend_to_all_pairs(const Eigen::Ref<const Eigen::VectorXd>& multipliers) const;
  /// Change values (#V) as little as necessary to satisfy every pair. Given values do not change.
  void enforce(Eigen::VectorXd& values) const;

private:
  struct Row
  {
    Index low = -1; // free index of the `low` vertex; -1: the value is given
    Index high = -1;
    int position = -1; // index of the entry (low, high) in the values of SplitForm::lower
    Index pair = 0; // index of the pair in BoxQpColumn::pairs
  };

  const SplitForm& matrices_;
  const ColumnProblem& problem_;
  const BoxQpColumn& column_;
  std::vector<Row> rows_;
  Eigen::VectorXd constants_;
  std::vector<OrderedPair> sorted_pairs_; // pairs in the order of sort_pairs_by_order()
};

} // namespace bindpose

#endif
