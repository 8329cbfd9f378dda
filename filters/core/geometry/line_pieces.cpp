// Division of a line into pieces. The desired size of a piece varies along the line and is called
// the local length. The integral of 1 / (local length) along a part of the line is the desired
// number of pieces in this part. This integral has the same value for all pieces.
#include "geometry/line_pieces.h"

#include <algorithm>
#include <cstddef>

namespace bindpose
{

std::vector<double> line_cuts(double from, double to, const std::function<double(double)>& length,
  const std::function<int(double)>& pieces)
{
  // cumulative_lengths[i] is the integral of 1 / (local length) from the start to parameters[i].
  std::vector<double> cumulative_lengths{ 0.0 };
  std::vector<double> parameters{ from };
  while (parameters.back() < to)
  {
    constexpr double part = 0.5; // step of the integration, as a fraction of the local length
    const double local_length = length(parameters.back());
    const double step = std::min(part * local_length, to - parameters.back());
    cumulative_lengths.push_back(cumulative_lengths.back() + step / local_length);
    parameters.push_back(to - parameters.back() - step < 1e-9 ? to : parameters.back() + step);
  }
  const int count = pieces(cumulative_lengths.back());
  std::vector<double> cuts;
  std::size_t next = 1;
  for (int piece = 1; piece < count; ++piece)
  {
    const double wanted = cumulative_lengths.back() * piece / count;
    while (cumulative_lengths[next] < wanted)
    {
      ++next;
    }
    const double f = (wanted - cumulative_lengths[next - 1]) /
      (cumulative_lengths[next] - cumulative_lengths[next - 1]);
    cuts.push_back(parameters[next - 1] + f * (parameters[next] - parameters[next - 1]));
  }
  return cuts;
}

} // namespace bindpose
