// Division of a line into pieces. The desired size of a piece varies along the line and is called
// the local length. The integral of 1 / (local length) along a part of the line is the length of
// this part in local lengths. All pieces have the same length in local lengths.
#include "geometry/line_pieces.h"

#include <algorithm>
#include <cstddef>

namespace bindpose
{

std::vector<double> line_cuts(double from, double to, const std::function<double(double)>& length,
  const std::function<int(double)>& pieces)
{
  // passed[i] is the length of the line from its start to parameter at[i], in local lengths.
  std::vector<double> passed{ 0.0 };
  std::vector<double> at{ from };
  while (at.back() < to)
  {
    constexpr double part = 0.5; // step of the integration, in local lengths
    const double here = length(at.back());
    const double step = std::min(part * here, to - at.back());
    passed.push_back(passed.back() + step / here);
    at.push_back(to - at.back() - step < 1e-9 ? to : at.back() + step);
  }
  const int count = pieces(passed.back());
  std::vector<double> cuts;
  std::size_t next = 1;
  for (int piece = 1; piece < count; ++piece)
  {
    const double wanted = passed.back() * piece / count;
    while (passed[next] < wanted)
    {
      ++next;
    }
    const double f = (wanted - passed[next - 1]) / (passed[next] - passed[next - 1]);
    cuts.push_back(at[next - 1] + f * (at[next] - at[next - 1]));
  }
  return cuts;
}

} // namespace bindpose
