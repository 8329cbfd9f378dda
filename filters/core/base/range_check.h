#ifndef bindpose_base_range_check_h
#define bindpose_base_range_check_h

#include "base/status.h"

namespace bindpose
{

/// Return invalid_input unless the option `name` is finite and greater than 0. The message is "NAME
/// must be positive, not VALUE".
Status check_positive(const char* name, double value);
/// Return invalid_input unless the option `name` is finite and at least 0.
Status check_not_negative(const char* name, double value);

} // namespace bindpose

#endif
