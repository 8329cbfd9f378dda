#ifndef bindpose_base_line_pieces_h
#define bindpose_base_line_pieces_h

#include <functional>
#include <vector>

namespace bindpose
{

/// Return the parameters, ascending between `from` < `to`, that cut a line into pieces of equal
/// size. Sizes are measured in local lengths. Cost: two calls of `length` per local length.
/// @param length returns the local length at a parameter, in units of the parameter, > 0
/// @param pieces returns the number of pieces (>= 1) for a line that is this many local lengths
/// long
std::vector<double> line_cuts(double from, double to, const std::function<double(double)>& length,
  const std::function<int(double)>& pieces);

} // namespace bindpose

#endif
