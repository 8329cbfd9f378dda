#ifndef bindpose_geometry_line_pieces_h
#define bindpose_geometry_line_pieces_h

#include <functional>
#include <vector>

namespace bindpose
{

/// Cut the line from parameter `from` to parameter `to` into pieces, and return the parameters of
/// the cuts in ascending order. The desired size of a piece varies along the line and is called the
/// local length. All pieces have the same size, measured in local lengths. `from` must be less than
/// `to`. Cost: two calls of `length` per local length.
/// @param length function that returns the local length at a parameter, in units of the parameter;
/// the result must be greater than 0
/// @param pieces function that returns the number of pieces, at least 1; its argument is the length
/// of the line in local lengths
std::vector<double> line_cuts(double from, double to, const std::function<double(double)>& length,
  const std::function<int(double)>& pieces);

} // namespace bindpose

#endif
