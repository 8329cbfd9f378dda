#ifndef bindpose_base_supernodes_h
#define bindpose_base_supernodes_h

#include <vector>

namespace bindpose
{

/// Positions of the nonzeros of a sparse Cholesky factor. Columns with (nearly) the same rows form
/// a supernode, a dense block stored column by column. Supernodes are in postorder: each one comes
/// after all supernodes that update it.
struct Supernodes
{
  std::vector<int> order; ///< #unknowns, the unknown that each step eliminates
  std::vector<int> first_column; ///< #supernodes + 1, first column of each one, in order of
                                 ///< elimination
  std::vector<int> first_row; ///< #supernodes + 1, index of each one's first row in `rows`
  std::vector<int> first_value; ///< #supernodes + 1, index of each one's block in the values
  /// Rows of each supernode in order of elimination, ascending; the first ones are its own columns.
  std::vector<int> rows;
};

} // namespace bindpose

#endif
