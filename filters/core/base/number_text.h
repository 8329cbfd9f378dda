#ifndef bindpose_base_number_text_h
#define bindpose_base_number_text_h

#include <string>

namespace bindpose
{

/// Few digits, as messages and legends show numbers: "0.5", "1.235e-07".
std::string short_number(double x, int digits = 4);
/// As many digits as give the same double back.
std::string exact_number(double x);

} // namespace bindpose

#endif
