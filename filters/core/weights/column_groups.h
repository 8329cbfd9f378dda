#ifndef bindpose_weights_column_groups_h
#define bindpose_weights_column_groups_h

#include "weights/weights_problem.h"

namespace bindpose
{

/// Columns of the weights that have a common quadratic form and the same fixed unknowns. An unknown
/// is a vertex, or a set of vertices that must have the same weight: a rigid set, or a vertex and
/// its mirror vertex.
///
/// Let handles a and b be mirror images of each other, so that w_a(v) = w_b(mirror of v). Their
/// weights are one column on two copies of the mesh, one for each handle. Vertex v in a's copy and
/// the mirror vertex of v in b's copy are one unknown. A handle that is its own mirror image has
/// one copy, where v and the mirror of v are one unknown. Every equality is therefore exact, and
/// the energy is the sum over both handles. If all vertices have a mirror vertex, the number of
/// unknowns is still #V.
struct ColumnGroup
{
  std::vector<std::vector<Index>> handles; ///< for each column, one handle per copy
  Index copies = 1;
  Index count = 0; ///< number of unknowns
  /// The unknown of vertex v in copy k, at index k * #V + v. If empty, there is one copy, and every
  /// vertex is an unknown.
  std::vector<Index> unknowns;
  std::vector<Index> fixed; ///< unknowns that are fixed in all columns, ascending
  std::vector<BoxQpColumn> columns;
  /// For each column, 1 if it pins unknowns in a component where the column is not constant.
  std::vector<char> own_pins;

  Index unknown(Index vertex, Index copy, Index vertex_count) const
  {
    return this->unknowns.empty() ? vertex : this->unknowns[copy * vertex_count + vertex];
  }
};

/// #V * #handles, row by row: 1 for each pair of vertex and handle whose weight must be 0, in
/// addition to the terms of WeightTerms; empty: no such pair. Only vertices that are solved for are
/// affected.
using Exclusions = std::vector<char>;

/// Make the columns of the problem's weights, with all terms of WeightTerms. Return invalid_input,
/// naming handles and vertex, if terms contradict handles or each other.
/// @param coupled rows must sum to one. A column is then constant in a component only if all
/// columns are constant there. Otherwise, a column is constant in a component if all its given
/// values there are equal and are within all bounds.
Status make_column_groups(const WeightsProblem& problem, const Exclusions& excluded, bool coupled,
  std::vector<ColumnGroup>& groups);

/// Return the columns for weights without optional terms. Every vertex is an unknown.
std::vector<BoxQpColumn> plain_columns(const WeightsProblem& problem);

/// Convert a quadratic form over vertices to a form over the group's unknowns.
SparseMatrix merge_form(const ColumnGroup& group, const SparseMatrix& form);

/// Return the graph of the group's unknowns. Followers (see VertexRole) have no neighbors.
VertexGraph merge_graph(
  const ColumnGroup& group, const VertexGraph& graph, const std::vector<VertexRole>& roles);

} // namespace bindpose

#endif
