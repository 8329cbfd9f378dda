#ifndef bindpose_linear_supernode_solve_h
#define bindpose_linear_supernode_solve_h

// Triangular solves with a supernodal Cholesky factor.

#include "linear/supernodes.h"

namespace bindpose
{

/// Maximum number of right-hand sides that are solved together.
constexpr int maximum_solve_columns = 8;

/// Number of floats that must be readable after the last block of a factor. Their values have no
/// effect.
constexpr int factor_padding = 15;

/// Solve L L' x = b in place, with a Cholesky factor in supernodes. Most of the time is spent on
/// reading the factor twice from memory, so several columns take little more time than one column.
/// The bits are the same on every machine.
/// @param values blocks of the factor, column by column, followed by `factor_padding` floats;
/// entries above the diagonal are not read
/// @param x #unknowns x columns, row-major, in order of elimination
/// @param columns 1, 4 or 8.
void solve_with_supernodes(const Supernodes& nodes, const float* values, float* x, int columns);

} // namespace bindpose

#endif
