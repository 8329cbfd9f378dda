#ifndef bindpose_weights_column_groups_h
#define bindpose_weights_column_groups_h

#include "weights/weights_problem.h"

namespace bindpose
{

/// Columns of the weight matrix with the same quadratic form and the same fixed unknowns. An
/// unknown is a vertex, or a set of vertices that must have the same weight: a rigid set, or a
/// vertex and its mirror vertex.
///
/// If handles a and b are mirror images of each other, w_a(v) = w_b(mirror of v) must hold. The
/// weights of a and b are therefore solved as one column on two copies of the mesh: copy 0 has the
/// weights of a, copy 1 the weights of b. Vertex v in copy 0 and the mirror vertex of v in copy 1
/// are one unknown, so mirrored weights are exactly equal. The energy is the sum over both copies.
/// If all vertices have a mirror vertex, the two copies have only #V unknowns in total. A handle
/// that is its own mirror image needs one copy, in which v and the mirror vertex of v are one
/// unknown.
struct ColumnGroup
{
  std::vector<std::vector<Index>> handles; ///< for each column: the handle of each copy of the mesh
  Index copies = 1; ///< number of copies of the mesh: 2 for pairs of mirrored handles, else 1
  Index count = 0; ///< number of unknowns
  /// The unknown of vertex v in copy k, at index k * #V + v. If empty, there is one copy, and every
  /// vertex is an unknown.
  std::vector<Index> unknowns;
  std::vector<Index> fixed; ///< unknowns that are fixed in all columns, ascending
  std::vector<BoxQpColumn> columns;
  /// For each column: 1 if it has pinned unknowns in a component in which the column is not
  /// constant.
  std::vector<char> has_pins;

  Index unknown(Index vertex, Index copy, Index vertex_count) const
  {
    return this->unknowns.empty() ? vertex : this->unknowns[copy * vertex_count + vertex];
  }
};

/// #V * #handles, row by row: 1 if the weight of this handle at this vertex must be 0; empty: no
/// such weight. These requirements are added to the terms of WeightTerms. They only affect weights
/// that are solved for.
using Exclusions = std::vector<char>;

/// Make the columns of the problem's weights, with all terms of WeightTerms. Return invalid_input,
/// naming handles and vertex, if terms contradict handles or each other.
/// @param coupled whether the columns will be solved together, with rows that sum to one. A column
/// can be constant in a component if its given values there are equal and within all bounds. If
/// `coupled` is false, every column is made constant in each component where it can be constant. If
/// true, columns are made constant only in the components where every column can be constant.
Status make_column_groups(const WeightsProblem& problem, const Exclusions& excluded, bool coupled,
  std::vector<ColumnGroup>& groups);

/// Return the quadratic problems of the weights of all handles, one per column. Optional terms are
/// ignored, and every vertex is an unknown.
std::vector<BoxQpColumn> columns_without_terms(const WeightsProblem& problem);

/// Convert a quadratic form over vertices to a form over the group's unknowns.
SparseMatrix merge_form(const ColumnGroup& group, const SparseMatrix& form);

/// Return the graph of the group's unknowns. Followers (see VertexRole) have no neighbors.
VertexGraph merge_graph(
  const ColumnGroup& group, const VertexGraph& graph, const std::vector<VertexRole>& roles);

} // namespace bindpose

#endif
