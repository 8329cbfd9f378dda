#ifndef bindpose_base_line_pieces_h
#define bindpose_base_line_pieces_h

#include <functional>
#include <vector>

namespace bindpose
{

/// Where a stretch of a line is cut into pieces that are equal when measured in local lengths: the
/// parameters of the cuts between `from` < `to`, ascending.
/// @param length the local length at a parameter, in the line's parameter, > 0
/// @param pieces how many are wanted where this many local lengths fit into the stretch, >= 1
/// Cost: two calls of `length` for each that fits.
std::vector<double> line_cuts(double from, double to, const std::function<double(double)>& length,
  const std::function<int(double)>& pieces);

} // namespace bindpose

#endif
