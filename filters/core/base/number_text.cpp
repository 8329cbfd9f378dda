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
  text << x;
  return text.str();
}
} // namespace

std::string short_number(double x)
{
  return with_digits(x, 4);
}

std::string exact_number(double x)
{
  return with_digits(x, std::numeric_limits<double>::max_digits10);
}

} // namespace bindpose
