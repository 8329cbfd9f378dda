#ifndef bindpose_base_number_text_h
#define bindpose_base_number_text_h

#include <string>

namespace bindpose
{

/// Format a number with few digits, for messages and legends: "0.5", "1.235e-07".
std::string short_number(double x, int digits = 4);
/// Format a number with enough digits to restore the same double.
std::string exact_number(double x);

} // namespace bindpose

#endif
