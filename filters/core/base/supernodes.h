#ifndef bindpose_base_supernodes_h
#define bindpose_base_supernodes_h

#include <vector>

namespace bindpose
{

/// Where the nonzeros of a sparse Cholesky factor are: columns with (nearly) the same rows form a
/// supernode, a dense block stored column by column. Supernodes are in postorder: each comes after
/// all that update it.
struct Supernodes
{
  std::vector<int> order; ///< #unknowns: which unknown is eliminated when
  std::vector<int> first_column; ///< #supernodes + 1, in order of elimination
  std::vector<int> first_row; ///< #supernodes + 1, where each one's rows begin in rows
  std::vector<int> first_value; ///< #supernodes + 1, where each one's block begins
  /// Rows of each supernode in order of elimination, ascending; the first are its own columns.
  std::vector<int> rows;
};

} // namespace bindpose

#endif
