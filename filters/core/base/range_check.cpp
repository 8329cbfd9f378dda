#include "base/range_check.h"

#include "base/number_text.h"

#include <cmath>

namespace bindpose
{

Status check_positive(const char* name, double value)
{
  return value > 0.0 && std::isfinite(value)
    ? Status()
    : Status::invalid_input(std::string(name) + " must be positive, not " + short_number(value));
}

Status check_not_negative(const char* name, double value)
{
  return value >= 0.0 && std::isfinite(value)
    ? Status()
    : Status::invalid_input(std::string(name) + " must be 0 or more, not " + short_number(value));
}

} // namespace bindpose
