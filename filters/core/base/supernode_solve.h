#ifndef bindpose_base_supernode_solve_h
#define bindpose_base_supernode_solve_h

#include "base/supernodes.h"

namespace bindpose
{

/// Right-hand sides that are solved for together at most.
constexpr int most_solve_columns = 8;

/// Solves L L' x = b in place, with a Cholesky factor in supernodes. Bound by the reading of the
/// factor, twice: several columns cost little more than one. The same bits on any machine.
/// @param values the blocks, column by column; what is above their diagonals is not read.
/// @param x #unknowns x columns, row by row, in order of elimination.
/// @param columns 1, 4 or 8.
void solve_with_supernodes(const Supernodes& nodes, const float* values, float* x, int columns);

} // namespace bindpose

#endif
