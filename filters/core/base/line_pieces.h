#ifndef bindpose_base_line_pieces_h
#define bindpose_base_line_pieces_h

#include <functional>
#include <vector>

namespace bindpose
{

/// Return the parameters, ascending between `from` < `to`, that cut a stretch of a line into pieces
/// of equal size, measured in local lengths.
/// @param length local length at a parameter, in units of the parameter, > 0
/// @param pieces number of pieces for a stretch that is this many local lengths long, >= 1
/// Cost: two calls of `length` per local length.
std::vector<double> line_cuts(double from, double to, const std::function<double(double)>& length,
  const std::function<int(double)>& pieces);

} // namespace bindpose

#endif
