#include "base/number_text.h"

#include <limits>
#include <sstream>

namespace bindpose
{

std::string short_number(double x, int digits)
{
  std::ostringstream text;
  text.precision(digits);
  text << (x == 0.0 ? 0.0 : x); // print -0 as 0
  return text.str();
}

std::string exact_number(double x)
{
  return short_number(x, std::numeric_limits<double>::max_digits10);
}

} // namespace bindpose
