#ifndef bindpose_weights_column_groups_h
#define bindpose_weights_column_groups_h

#include "weights/weights_problem.h"

namespace bindpose
{

/// Columns of the weights that share a quadratic form and its fixed unknowns. An unknown is a
/// vertex, or all vertices that must have the same weight: rigid sets, a vertex and its mirror.
///
/// Weights of two handles a and b that mirror each other, w_a(v) = w_b(mirror of v), are one column
/// of two copies of the mesh whose vertices (v, a) and (mirror of v, b) are one unknown; a handle
/// that is its own mirror image has one copy whose v and mirror of v are one. So every equality is
/// exact, the energy is the sum over both handles, and nothing but the size of the form changes: on
/// vertices that all have a mirror it stays #V unknowns.
struct ColumnGroup
{
  std::vector<std::vector<Index>> handles; ///< of each column, one a copy
  Index copies = 1;
  Index count = 0; ///< unknowns
  /// Unknown of vertex v of copy k at k * #V + v; empty: one copy, every vertex is an unknown.
  std::vector<Index> unknowns;
  std::vector<Index> fixed; ///< unknowns that all columns fix, ascending
  std::vector<BoxQpColumn> columns;
  std::vector<char> own_pins; ///< of each column: it pins what no constant explains

  Index unknown(Index vertex, Index copy, Index vertex_count) const
  {
    return this->unknowns.empty() ? vertex : this->unknowns[copy * vertex_count + vertex];
  }
};

/// Pairs of vertex and handle whose weight is 0 besides what the terms say, row by row, #V *
/// #handles; empty: none. On vertices that are solved for.
using Exclusions = std::vector<char>;

/// The columns of the problem's weights with all terms. invalid_input, naming handles and vertex,
/// where terms contradict handles or each other.
/// @param coupled rows are to sum to one: a column is then constant in a connected part only when
/// all are (otherwise wherever all its fixed values agree and nothing else is asked of it).
Status make_column_groups(const WeightsProblem& problem, const Exclusions& excluded, bool coupled,
  std::vector<ColumnGroup>& groups);

/// The columns without any terms, over vertices.
std::vector<BoxQpColumn> plain_columns(const WeightsProblem& problem);

/// A form over vertices as one over the group's unknowns.
SparseMatrix merge_form(const ColumnGroup& group, const SparseMatrix& form);

/// Who is joined by the group's unknowns to whom. Followers have no neighbours.
VertexGraph merge_graph(
  const ColumnGroup& group, const VertexGraph& graph, const std::vector<VertexRole>& roles);

} // namespace bindpose

#endif
