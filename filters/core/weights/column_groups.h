#ifndef bindpose_weights_column_groups_h
#define bindpose_weights_column_groups_h

#include "weights/weights_problem.h"

namespace bindpose
{

/// Columns of the weights that share a quadratic form and its fixed unknowns. An unknown is a
/// vertex, or all vertices that must have the same weight: rigid sets, or a vertex and its mirror
/// vertex.
///
/// Let handles a and b mirror each other, so that w_a(v) = w_b(mirror of v). Their weights are one
/// column on two copies of the mesh, where the vertices (v, a) and (mirror of v, b) are one
/// unknown. A handle that is its own mirror image has one copy, where v and the mirror of v are one
/// unknown. Every equality is therefore exact, and the energy is the sum over both handles. If all
/// vertices have a mirror vertex, the number of unknowns stays #V.
struct ColumnGroup
{
  std::vector<std::vector<Index>> handles; ///< per column: one handle per copy
  Index copies = 1;
  Index count = 0; ///< number of unknowns
  /// Unknown of vertex v of copy k, at k * #V + v; empty: there is one copy and every vertex is an
  /// unknown.
  std::vector<Index> unknowns;
  std::vector<Index> fixed; ///< unknowns that are fixed in all columns, ascending
  std::vector<BoxQpColumn> columns;
  /// Per column: whether it pins unknowns in components where it is not constant.
  std::vector<char> own_pins;

  Index unknown(Index vertex, Index copy, Index vertex_count) const
  {
    return this->unknowns.empty() ? vertex : this->unknowns[copy * vertex_count + vertex];
  }
};

/// #V * #handles, row by row: 1 for pairs of vertex and handle whose weight must be 0, in addition
/// to the terms; empty: none. Applies to vertices that are solved for.
using Exclusions = std::vector<char>;

/// Make the columns of the problem's weights with all terms. Return invalid_input, naming handles
/// and vertex, if terms contradict handles or each other.
/// @param coupled rows must sum to one. A column is then constant in a component only if all
/// columns are. Otherwise it is constant if all its given values there agree and are within all
/// bounds.
Status make_column_groups(const WeightsProblem& problem, const Exclusions& excluded, bool coupled,
  std::vector<ColumnGroup>& groups);

/// Return the columns without any terms, over vertices.
std::vector<BoxQpColumn> plain_columns(const WeightsProblem& problem);

/// Convert a form over vertices to a form over the group's unknowns.
SparseMatrix merge_form(const ColumnGroup& group, const SparseMatrix& form);

/// Return the graph of the group's unknowns. Followers have no neighbors.
VertexGraph merge_graph(
  const ColumnGroup& group, const VertexGraph& graph, const std::vector<VertexRole>& roles);

} // namespace bindpose

#endif
