#ifndef bindpose_linear_supernodes_h
#define bindpose_linear_supernodes_h

#include <vector>

namespace bindpose
{

/// Positions of the nonzeros of a sparse Cholesky factor. Columns with (nearly) the same rows form
/// a supernode, a dense block stored column by column. Supernodes are in postorder: a supernode
/// comes after all supernodes that update it.
struct Supernodes
{
  std::vector<int> order; ///< #unknowns: order[k] is the unknown that step k eliminates
  /// #supernodes + 1: first column of each supernode, in order of elimination.
  std::vector<int> first_column;
  std::vector<int> first_row; ///< #supernodes + 1: index of each supernode's first row in `rows`
  /// #supernodes + 1: index of the first value of each supernode's block in the factor's values.
  std::vector<int> first_value;
  /// Rows of each supernode as positions in `order`, ascending. The first rows of a supernode are
  /// its own columns.
  std::vector<int> rows;
};

} // namespace bindpose

#endif
