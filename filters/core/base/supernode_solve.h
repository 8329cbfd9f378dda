#ifndef bindpose_base_supernode_solve_h
#define bindpose_base_supernode_solve_h

#include "base/supernodes.h"

namespace bindpose
{

/// Largest number of right-hand sides that are solved together.
constexpr int most_solve_columns = 8;

/// Solve L L' x = b in place, with a Cholesky factor in supernodes. The time is that of reading the
/// factor twice, so several columns cost little more than one. The bits are the same on every
/// machine.
/// @param values blocks, column by column; entries above their diagonals are not read
/// @param x #unknowns x columns, row-major, in order of elimination
/// @param columns 1, 4 or 8.
void solve_with_supernodes(const Supernodes& nodes, const float* values, float* x, int columns);

} // namespace bindpose

#endif
