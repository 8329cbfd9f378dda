#include "base/number_text.h"

#include <limits>
#include <sstream>

namespace bindpose
{

namespace
{
std::string with_digits(double x, int digits)
{
  std::ostringstream text;
  text.precision(digits);
  text << (x == 0.0 ? 0.0 : x); // no -0
  return text.str();
}
} // namespace

std::string short_number(double x, int digits)
{
  return with_digits(x, digits);
}

std::string exact_number(double x)
{
  return with_digits(x, std::numeric_limits<double>::max_digits10);
}

} // namespace bindpose
